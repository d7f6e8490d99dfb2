"""The 0-1 test of Gottwald & Melbourne: does a strobed motion, read as steps of a walk in the plane, stay or spread?

With phi_j once per forcing period and an angle c,

    p_n + i q_n = sum_{j<=n} phi_j e^{i j c},        M_c(n) = mean over j of |(p + i q)_{j+n} - (p + i q)_j|^2,
    D_c(n) = M_c(n) - <phi>^2 (1 - cos n c)/(1 - cos c),
    K_c = correlation of (1 ... n_cut) with (D_c(1) ... D_c(n_cut)),        n_cut = N/10,        K = median over c.

Quasi-periodic steps add up to a bounded walk (K near 0), chaotic ones to a diffusing walk (K near 1). The mean of phi
is removed before the sum, so that the term subtracted in D_c is zero: the same quantity up to O(1/N), without the
cancellation that costs all digits when the mean (a buoy 21 m from its anchor) is large against the motion.
Sampled many times per period, any smooth motion looks regular to this test, chaos included; and K near 1 says
"irregular", not "chaotic": noise passes as well. Hence the section only, and the nulls of `surrogates` beside it.
"""

import numpy as np
from numpy.typing import ArrayLike

from analysis.sampling import checked_count, checked_series, record

LEAST_POINTS = 100
# Range over mean step: a sine sampled P times a cycle has pi/2/sin(pi/P), which is 10 at P = 20.
MOST_RANGE_PER_STEP = 10.0


@record
class ZeroOneTest:
    """Outcome of the 0-1 test.

    value            K, the median of K_c: near 0 regular, near 1 irregular; NaN where the test does not apply
    reason           one sentence: what was found, or why the value is NaN
    angles_rad (a,)  the angles c, all within (pi/5, 4 pi/5)
    growth (a,)      K_c, the correlation of each walk's mean square distance with time
    points           length of the section
    """

    value: float
    reason: str
    angles_rad: np.ndarray
    growth: np.ndarray
    points: int


def zero_one_test(section: ArrayLike, angles: int = 200, seed: int | list[int] = 0) -> ZeroOneTest:
    """K of the 0-1 test for chaos on one strobed coordinate, by the correlation method.

        K = median over c of corr(n, D_c(n)),   1 <= n <= N/10       (formulas at the head of this file)

    section (m,)   one coordinate once per forcing period, transient left out; 100 points at least, 1000 are comfortable
    angles         how many c: one at random in each of that many equal parts of (pi/5, 4 pi/5), which leaves out the
                   resonances of period-1 and period-2 parts; a median of 100 or more ignores the others
    seed           of those random angles
    Returns a ZeroOneTest. Its value is NaN, with the reason, for fewer than 100 points, for a section without motion,
    and for a series that is obviously oversampled (range above ten mean steps, as of a sine seen 20 times a cycle): a
    slow torus is refused by that, too, rather than judged.
    Raises ValueError for values that are not finite or more than one coordinate.
    Source: G. A. Gottwald & I. Melbourne, Proc. R. Soc. A 460 (2004) 603; SIAM J. Appl. Dyn. Syst. 8 (2009) 129.
    """
    phi = checked_series(section, "section")
    angles = checked_count(angles, "angles")
    width = 0.6 * np.pi / angles
    c = 0.2 * np.pi + width * (np.arange(angles) + np.random.default_rng(seed).random(angles))
    why_not = _why_not(phi)
    if why_not:
        return ZeroOneTest(np.nan, why_not, c, np.full(angles, np.nan), len(phi))
    growth = _growth((phi - phi.mean()) / np.ptp(phi), c)
    value = np.median(growth)
    reason = f"median of {angles} walks over {len(phi)} points: K = {value:.3f}"
    return ZeroOneTest(value, reason, c, growth, len(phi))


def _why_not(phi):
    """Why the test says nothing about this series; empty where it does."""
    if len(phi) < LEAST_POINTS:
        return f"too short: {LEAST_POINTS} strobed points are needed, given {len(phi)}"
    span = np.ptp(phi)
    if span <= 64 * np.finfo(float).eps * np.max(np.abs(phi)):
        return "no motion: the section is one point to the last digits"
    per_step = span / np.mean(np.abs(np.diff(phi)))
    if per_step > MOST_RANGE_PER_STEP:
        reason = f"the range is {per_step:.3g} mean steps, more than {MOST_RANGE_PER_STEP:g}"
        return f"oversampled: {reason}; the test needs the motion once per forcing period, not every sample of it"
    return ""


def _growth(phi, c):
    """K_c for each angle. The sums over j are correlations, so transforms do them all in m log m."""
    points, cut = len(phi), len(phi) // 10
    walk = np.cumsum(phi * np.exp(1j * np.outer(c, np.arange(1, points + 1))), axis=1)
    length = 1 << int(np.ceil(np.log2(2 * points)))
    start = walk[:, : points - cut]
    cross = np.fft.ifft(np.conj(np.fft.fft(start, length)) * np.fft.fft(walk, length))[:, 1 : cut + 1].real
    square = np.concatenate([np.zeros((len(c), 1)), np.cumsum(np.abs(walk) ** 2, axis=1)], axis=1)
    lag = np.arange(1, cut + 1)
    moved = square[:, points - cut + lag] - square[:, lag]
    distance = (moved + square[:, [points - cut]] - 2.0 * cross) / (points - cut)
    lag = lag - lag.mean()
    distance = distance - distance.mean(axis=1, keepdims=True)
    with np.errstate(invalid="ignore", divide="ignore"):
        growth = distance @ lag / np.sqrt(np.sum(lag**2) * np.sum(distance**2, axis=1))
    return np.nan_to_num(growth, nan=0.0)  # a walk that keeps its distance exactly does not grow
