"""Lines of a discrete spectrum: the part of a record that is a sum of a few steady oscillations.

A periodic or quasi-periodic motion is such a sum and nothing else; chaos and noise have a continuous spectrum between
and below their lines. Lines are found one at a time, largest above its surroundings first, refined in frequency, and
all fitted together after each (as CLEAN does, so that side lobes of a strong line do not pass for weaker ones).
"""

import numpy as np
from numpy.typing import ArrayLike
from threadpoolctl import threadpool_limits

from analysis.sampling import checked_columns, record

# Noise exceeds this many times its local mean once in e^12 bins.
LINE_ABOVE_FLOOR = 12.0
# Points per line at least: two coefficients and a frequency each must not explain broad-band motion by their number.
POINTS_PER_LINE = 6
# Half the width of a line under the Hann window is two bins; nearer lines are seen as one.
SEPARATION_BINS = 1.5
MOST_LINES = 64
_PADDING = 8
_NEGLIGIBLE = 1e-12


@record
class LineSpectrum:
    """Lines of a record and what they leave.

    frequency (l,)     cycles per sample, in (0, 1/2], in the order found
    amplitude (l, d)   of each line in each column, in its unit
    fitted (n, d)      mean plus all lines, at the samples; (n,) for a record given so
    unexplained (d,)   share of each column's variance that the lines leave; 0 for a column that does not move
    """

    frequency: np.ndarray
    amplitude: np.ndarray
    fitted: np.ndarray
    unexplained: np.ndarray


# Libraries of linear algebra hand even a fit of 50 lines to 300 points to all cores, which on a busy machine wait for
# each other: 20 times the time beside one other process.
@threadpool_limits.wrap(limits=1)
def spectral_lines(series: ArrayLike) -> LineSpectrum:
    """The steady oscillations in a record: frequencies, amplitudes and their sum.

        fitted_k = mean + sum_l a_l cos(2 pi f_l k) + b_l sin(2 pi f_l k),    least squares over k, all lines together

    A line is a maximum of the Hann-windowed spectrum (columns by their standard deviations, summed) 12 times above the
    floor around it; floor: running median over an eighth of the band. At most one line per 6 samples.

    series (n,) or (n, d)   any unit; 32 samples at least
    Returns a LineSpectrum, without lines where none stands out.
    Raises ValueError for values that are not finite or fewer than 32 samples.
    Source: J. A. Hogbom (CLEAN), Astron. Astrophys. Suppl. 15 (1974) 417; frequency refinement by a windowed transform:
    J. Laskar, Physica D 67 (1993) 257.
    """
    columns = checked_columns(series)
    if len(columns) < 32:
        raise ValueError(f"series: 32 samples at least are needed to find lines, given {len(columns)}")
    mean, size = columns.mean(axis=0), columns.std(axis=0)
    size = np.where(size > 64 * np.finfo(float).eps * np.abs(columns).max(axis=0), size, np.inf)
    z = (columns - mean) / size
    frequency, fitted = [], np.zeros_like(z)
    amplitude = np.zeros((0, z.shape[1]))
    while len(frequency) < min(MOST_LINES, len(z) // POINTS_PER_LINE) and np.mean((z - fitted) ** 2) > _NEGLIGIBLE:
        peak = _next_line(z - fitted, frequency)
        if peak is None:
            break
        frequency.append(peak)
        frequency, fitted, amplitude = _fit(z, frequency)
    unit = np.where(np.isinf(size), 0.0, size)
    reconstructed = mean + fitted * unit
    variance = z.var(axis=0)
    unexplained = np.mean((z - fitted) ** 2, axis=0) / np.where(variance > 0.0, variance, 1.0)
    reconstructed = reconstructed[:, 0] if np.ndim(series) == 1 else reconstructed
    return LineSpectrum(np.array(frequency), amplitude * unit, reconstructed, unexplained)


def _next_line(rest, known):
    """Frequency of the highest line above its surroundings, or None; what is left beside a known line is no line."""
    points = len(rest)
    window = np.hanning(points + 2)[1:-1]
    weighted = rest * window[:, None]
    length = 1 << int(np.ceil(np.log2(_PADDING * points)))
    power = np.sum(np.abs(np.fft.rfft(weighted, length, axis=0)) ** 2, axis=1)
    floor = _floor(power, length // 16)
    # Below one and a half cycles in the record a line cannot be told from a trend.
    lowest = int(np.ceil(1.5 * length / points))
    ratio = power / np.maximum(floor, power.max() * 1e-13)
    ratio[:lowest] = 0.0
    for frequency in known:
        ratio[np.abs(np.arange(len(ratio)) - frequency * length) < SEPARATION_BINS * length / points] = 0.0
    best = int(np.argmax(ratio))
    if ratio[best] < LINE_ABOVE_FLOOR:
        return None
    return _refine(weighted, best / length, 1.0 / length)


def _floor(power, width):
    """Running median over `width` bins of the two-sided spectrum; an exponential's mean is its median over ln 2."""
    from scipy.ndimage import median_filter

    step = max(width // 64, 1)  # the spectrum is padded: every few bins carry all there is to know
    coarse = median_filter(power[::step], size=max(width // step, 3), mode="reflect") / np.log(2.0)
    return np.interp(np.arange(len(power)), np.arange(0, len(power), step), coarse)


def _refine(weighted, start, bin_width):
    """The maximum of the windowed power nearest to a bin, by golden section to a millionth of the bin."""
    from scipy.optimize import minimize_scalar

    k = np.arange(len(weighted))

    def minus_power(f):
        return -np.sum(np.abs(np.exp(-2j * np.pi * f * k) @ weighted) ** 2)

    high = min(start + bin_width, 0.5)
    fine = {"xatol": 1e-6 * bin_width}
    refined = minimize_scalar(minus_power, bounds=(start - bin_width, high), method="bounded", options=fine)
    return 0.5 if 0.5 - refined.x < 0.25 / len(weighted) else float(refined.x)


def _fit(z, frequency):
    """Least squares over coefficients and frequencies: the frequencies moved, the sum of lines, the amplitudes.

    The windowed maximum of one line is pulled by its neighbours; left so, it would leave a false line beside itself.
    Gauss-Newton on the frequencies with the coefficients projected out (Golub & Pereyra 1973); three rounds settle it.
    """
    k = np.arange(len(z)) - 0.5 * len(z)
    frequency = np.array(frequency)
    for last in (False, False, False, True):
        turn = 2.0 * np.pi * np.outer(k, frequency)
        cosine, sine = np.cos(turn), np.sin(turn)
        inner = frequency != 0.5  # half the sampling rate has no sine, and no neighbours to move to
        basis = np.hstack([cosine, sine[:, inner], np.ones((len(z), 1))])
        q, r = np.linalg.qr(basis)
        solved = np.linalg.solve(r, q.T @ z)
        fitted = basis @ solved
        a, b = solved[: len(frequency)], np.zeros((len(frequency), z.shape[1]))
        b[inner] = solved[len(frequency) : -1]
        if last:
            return list(frequency), fitted, np.hypot(a, b)
        slope = 2.0 * np.pi * k[:, None, None] * (cosine[:, :, None] * b - sine[:, :, None] * a)[:, inner]
        free = slope.reshape(len(z), -1)
        free = (free - q @ (q.T @ free)).reshape(len(z), -1, z.shape[1])
        system = free.transpose(0, 2, 1).reshape(z.size, -1)
        shift = np.linalg.lstsq(system, (z - fitted).ravel(), rcond=1e-6)[0]
        frequency[inner] += np.clip(shift, -0.5 / len(z), 0.5 / len(z))
        frequency = np.clip(frequency, 0.25 / len(z), 0.5)
