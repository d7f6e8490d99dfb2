"""Does a motion forget where it was? The correlation of a section with itself, many periods later.

A chaotic motion forgets (it is mixing, in each of the bands that it visits in turn). A torus does not: it returns close
to where it was, again and again, and so does every motion that a quasi-periodic forcing rules, the strange nonchaotic
attractors among them, whose neighbours part without an exponent (Grebogi, Ott, Pelikan & Yorke 1984). So

    R = max over n of |sum_k u_k u_{k+n}| / sqrt(sum_k u_k^2 sum_k u_{k+n}^2),     m/8 <= n < m/2,     u = z and |z|,

z being each coordinate less its mean in each band. |z| is for motions whose sign alone is irregular. In m points of
chaos R is the largest of m/3 values that scatter by (2/m)^(1/2); on tori it is near 1, in noise of their own size 0.5.
Noise forgets as well: what it lacks is a map that predicts it (`surrogates`).
"""

import numpy as np
from numpy.typing import ArrayLike

from analysis.sampling import checked_columns, in_deviations

LEAST_POINTS = 40
# Bands of a section: how many at most, and the points each must have.
MOST_BANDS = 8
BAND_POINTS = 100


def long_memory(section: ArrayLike) -> float:
    """R, the largest correlation of a section with itself from an eighth to half of the record later (head of file).

    section (m,) or (m, d)   one row a forcing period, 40 at least
    Returns a number from 0 to 1: near 1 for a motion that returns; NaN for a shorter record, or one without motion.
    Raises ValueError for values that are not finite.
    """
    x = checked_columns(section, "section")
    bands, points = bands_in_turn(x), len(x)
    z = in_deviations(x, centred=True)
    if points < LEAST_POINTS or z.shape[1] == 0:
        return float("nan")
    for first in range(bands):
        z[first::bands] -= z[first::bands].mean(axis=0)
    u = np.hstack([z, np.abs(z)])
    u -= u.mean(axis=0)
    lags = np.arange(points // 8, points // 2)
    length = 1 << int(np.ceil(np.log2(2 * points)))
    product = np.fft.irfft(np.abs(np.fft.rfft(u, length, axis=0)) ** 2, length, axis=0)[lags]
    square = np.vstack([np.zeros(u.shape[1]), np.cumsum(u**2, axis=0)])
    size = np.sqrt(square[points - lags] * (square[-1] - square[lags]))
    return float(np.max(np.abs(product) / np.where(size > 0.0, size, np.inf)))


def bands_in_turn(section: np.ndarray) -> int:
    """The least N <= 8 of which the means of every N-th point carry half of a coordinate's variance, 1 without any.

    One coordinate that tells the bands apart is enough; N is looked at only where every band has 100 points.
    """
    z = in_deviations(section, centred=True)
    for n in range(2, MOST_BANDS + 1):
        if len(z) < n * BAND_POINTS or z.shape[1] == 0:
            break
        means = np.array([z[first::n].mean(axis=0) for first in range(n)])
        if np.max(np.mean(means**2, axis=0)) > 0.5:
            return n
    return 1
