"""Does a motion forget where it was? The correlation of a section with itself, many periods later.

A chaotic motion forgets (it is mixing, in each of the bands that it visits in turn). A torus does not: it returns close
to where it was, again and again, and so does every motion that a quasi-periodic forcing rules, the strange nonchaotic
attractors among them, whose neighbours part without an exponent (Grebogi, Ott, Pelikan & Yorke 1984). So

    R = max over n of |sum_k u_k u_{k+n}| / sqrt(sum_k u_k^2 sum_k u_{k+n}^2),     m/8 <= n < m/2,     u = z and |z|,

z being each coordinate less its mean in each band, and u less its own there. |z| is for motions whose sign alone is
irregular. In m rounds of the bands of a chaotic motion R is the largest of many values that scatter by (2/m)^(1/2). On
a torus R is near 1; with noise as large as the motion it is near 0.5.
Noise forgets as well: what it lacks is a map that predicts it (`surrogates`).
"""

import numpy as np
from numpy.typing import ArrayLike

from analysis.sampling import checked_columns, in_deviations

LEAST_POINTS = 40
# Bands of a section: how many at most, and the points each must have.
MOST_BANDS = 32
BAND_POINTS = 50


def long_memory(section: ArrayLike) -> float:
    """R, the largest correlation of a section with itself from an eighth to half of the record later (head of file).

    section (m,) or (m, d)   one row a forcing period, 40 at least
    Returns a number from 0 to 1: near 1 for a motion that returns; NaN for a shorter record, or one without motion.
    Raises ValueError for values that are not finite.
    """
    x = checked_columns(section, "section")
    bands, points = bands_in_turn(x), len(x)
    z = within_bands(in_deviations(x), bands)
    if points < LEAST_POINTS or z.shape[1] == 0:
        return float("nan")
    u = within_bands(np.hstack([z, np.abs(z)]), bands)
    lags = np.arange(points // 8, points // 2)
    length = 1 << int(np.ceil(np.log2(2 * points)))
    product = np.fft.irfft(np.abs(np.fft.rfft(u, length, axis=0)) ** 2, length, axis=0)[lags]
    square = np.vstack([np.zeros(u.shape[1]), np.cumsum(u**2, axis=0)])
    size = np.sqrt(square[points - lags] * (square[-1] - square[lags]))
    return float(np.max(np.abs(product) / np.where(size > 0.0, size, np.inf)))


def within_bands(x: np.ndarray, bands: int) -> np.ndarray:
    """A section (m, d) less the mean of each coordinate in each of the bands that it visits in turn."""
    z = x.copy()
    for first in range(bands):
        z[first::bands] -= z[first::bands].mean(axis=0)
    return z


def widest_band(section: np.ndarray) -> tuple[np.ndarray, int]:
    """The points of a section (m, d) that lie in the widest of the bands visited in turn, and the number of bands.

    The map of so many periods has this band for a section of its own. In the others the same motion is hidden more
    deeply in noise.
    """
    bands, z = bands_in_turn(section), in_deviations(section)
    widths = [z[first::bands].var(axis=0).sum() for first in range(bands)]
    return section[int(np.argmax(widths)) :: bands], bands


def bands_in_turn(section: np.ndarray) -> int:
    """The number of bands that a section visits in turn, 1 without any; 32 at most, each of 50 points or more.

    N bands: the means of every N-th point carry half of a coordinate's variance. Where those of every kN-th carry half
    of what is left, each band is k bands, and so on (chaos after period doubling has 2, 4, 8 ... bands).
    """
    left, bands, tried = in_deviations(section, centred=True), 1, 2
    while tried <= MOST_BANDS and tried * BAND_POINTS <= len(left):
        narrower = within_bands(left, tried)
        if np.any(narrower.var(axis=0) < 0.5 * left.var(axis=0)):
            left, bands = narrower, tried
        tried += bands
    return bands
