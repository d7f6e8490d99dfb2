"""Correlation dimension of Grassberger & Procaccia: how the number of close pairs of points grows with distance.

    C(r) = share of the pairs |i - j| > w with |x_i - x_j| < r  ~  r^D      as r -> 0

D is the slope of ln C over ln r in the scaling region: radii large enough for hundreds of pairs, small against the set,
between which the slope is constant. Without such a region there is no dimension. Pairs close in time are close because
the motion is smooth, not because it returns: Theiler's window w leaves them out, else every smooth curve has D = 1.
"""

from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from analysis.compiled import kernel
from analysis.sampling import checked_columns, checked_count, in_deviations, record

LEAST_POINTS = 300
BINS_PER_NAT = 20
# The smallest radius looked at, as a share of the largest distance possible: e^-14 = 1e-6.
_NATS = 14
# A local slope is taken over half a nat of radius; the region spans three of these at least.
_SLOPE_BINS = BINS_PER_NAT // 2
LEAST_SPAN_NATS = 1.5
LEAST_PAIRS = 500
LARGEST_SHARE = 0.03
SLOPE_TOLERANCE = 0.08
LEAST_SLOPE = 0.2
QUARTERS = 4


@record
class CorrelationDimension:
    """The correlation dimension of a set of points, or why there is none.

    value            D; NaN where no scaling region was found
    error            standard error: from the slopes in four parts of the record, and the largest deviation of the slope
                     over a quarter of the region, because the surface of a torus is curved and a finite set is uneven
    reason           one sentence
    region           (r_low, r_high), the scaling region, in standard deviations of the coordinates; (NaN, NaN) without
    radius (b,)      radii, in the same unit
    correlation_sum (b,)   C(r)
    slope (b,)       d ln C/d ln r about each radius over half a nat; NaN where fewer than 500 pairs are nearer
    points           points used
    """

    value: float
    error: float
    reason: str
    region: tuple[float, float]
    radius: np.ndarray
    correlation_sum: np.ndarray
    slope: np.ndarray
    points: int


def correlation_dimension(points: ArrayLike, theiler: int = 0) -> CorrelationDimension:
    """Correlation dimension of a set of points, with the scaling region it was read from (head of this file).

    points (m, d) or (m,)   states in the order visited: a section, or an embedding of a series; 300 at least. Each
                            coordinate is measured in its standard deviation
    theiler                 pairs at most this many places apart in the order do not count: for a flow about the time in
                            which its correlation is lost, for a section 0 or 1
    Returns a CorrelationDimension. The region is the longest range of radii, over 1.5 nats at least, with 500 pairs
    below it, at most 3 % of all pairs within it, and local slopes within 8 % of their mean. NaN, with the reason, when
    there is none (too few points for the dimension, noise that fills the embedding, several scales), when points are
    too few, or when D exceeds what so many points can show, 2 ln m/ln(size/r_high) (Eckmann & Ruelle). White noise
    gives d where d is small and no value where it is not. Time grows with m^2 (10,000 points: under a second).
    Raises ValueError for values that are not finite.
    Source: P. Grassberger & I. Procaccia, Physica D 9 (1983) 189; window: J. Theiler, Phys. Rev. A 34 (1986) 2427;
    limit: J.-P. Eckmann & D. Ruelle, Physica D 56 (1992) 185.
    """
    x = checked_columns(points, "points")
    theiler = checked_count(theiler, "theiler", least=0)
    z = np.ascontiguousarray(in_deviations(x))
    needed, empty, none = max(LEAST_POINTS, 4 * theiler), np.zeros(0), (np.nan, np.nan)
    reason = ""
    if len(x) < needed:
        reason = f"too short: {needed} points are needed, given {len(x)}"
    elif z.shape[1] == 0:
        reason = "no motion: all points are one to the last digits"
    if reason:
        return CorrelationDimension(np.nan, np.nan, reason, none, empty, empty, empty, len(x))
    largest = np.log(np.linalg.norm(np.ptp(z, axis=0)))
    bins = (largest - _NATS, BINS_PER_NAT, _NATS * BINS_PER_NAT + 1)
    pairs = np.cumsum(_pairs_by_distance(z, theiler, *bins))[:-1]
    total = (len(z) - theiler) * (len(z) - theiler - 1) // 2
    logarithm = largest - _NATS + np.arange(len(pairs)) / BINS_PER_NAT
    slope, (value, error, reason, region) = _read(pairs, total, logarithm, len(z))
    radius = np.exp(logarithm)
    if value > 0.0:
        quarters = []
        for part in np.array_split(z, QUARTERS):
            quarters.append(np.cumsum(_pairs_by_distance(part, theiler, *bins))[:-1])
        inside = (radius >= region[0]) & (radius <= region[1])
        error = np.hypot(error, _sampling_error(quarters, logarithm, inside))
    return CorrelationDimension(value, error, reason, region, radius, pairs / total, slope, len(x))


@kernel
def _pairs_by_distance(z, theiler, lowest, per_nat, bins):
    """Pairs more than `theiler` places apart, counted by ln of their distance; bin 0 holds all below `lowest`."""
    counts = np.zeros(bins, np.int64)
    m, d = z.shape
    for i in range(m):
        for j in range(i + theiler + 1, m):
            square = 0.0
            for c in range(d):
                square += (z[i, c] - z[j, c]) ** 2
            place = 0
            if square > 0.0:
                place = min(max(int(np.floor((0.5 * np.log(square) - lowest) * per_nat)) + 1, 0), bins - 1)
            counts[place] += 1
    return counts


def _read(pairs, total, logarithm, points):
    """Local slopes; and value, error, reason, region from the numbers of pairs within each radius."""
    enough, none = pairs >= LEAST_PAIRS, (np.nan, np.nan)
    ln_share = np.log(np.where(enough, pairs, 1) / total)
    half = _SLOPE_BINS // 2
    slope = np.full(len(pairs), np.nan)
    rise = (ln_share[2 * half :] - ln_share[: -2 * half]) / (logarithm[2 * half :] - logarithm[: -2 * half])
    slope[half:-half] = np.where(enough[: -2 * half], rise, np.nan)
    usable = np.flatnonzero(np.isfinite(slope))
    top = np.append(pairs[half:], np.full(half, total)) <= LARGEST_SHARE * total
    usable = usable[top[usable]]
    if pairs[0] > LARGEST_SHARE * total:
        return slope, (0.0, 0.0, "the points repeat: a finite set, as of a period", none)
    # A gap between the distances of a lattice (a torus of nearly rational frequencies) is no scaling of the set.
    region = _longest(slope, usable[slope[usable] > LEAST_SLOPE])
    if region is None:
        alike = f"nowhere are the slopes within {SLOPE_TOLERANCE:.0%} over {LEAST_SPAN_NATS} nats of radius"
        reason = f"no scaling region: {alike} between {LEAST_PAIRS} pairs and {LARGEST_SHARE:.0%} of all"
        return slope, (np.nan, np.nan, reason, none)
    first, last = region[0] - half, region[1] + half
    ends = np.linspace(first, last, QUARTERS + 1).astype(int)
    slopes = []
    for begin, end in ((first, last), *pairwise(ends)):
        part = slice(begin, end + 1)
        slopes.append(float(np.polyfit(logarithm[part], ln_share[part], 1)[0]))
    value, *of_quarters = slopes
    limit = 2.0 * np.log(points) / (logarithm[-1] - logarithm[last])
    if value > limit:
        reason = f"too few points: {points} cannot show a dimension above {limit:.2f}, the slope is {value:.2f}"
        return slope, (np.nan, np.nan, reason, none)
    edges = (float(np.exp(logarithm[first])), float(np.exp(logarithm[last])))
    span = logarithm[last] - logarithm[first]
    reason = f"slope {value:.3f} over {span:.1f} nats of radius, {edges[0]:.2g} to {edges[1]:.2g}"
    return slope, (value, max(abs(quarter - value) for quarter in of_quarters), reason, edges)


def _sampling_error(quarters, logarithm, inside):
    """Standard error from the slopes of four parts of the record: how evenly the set was visited."""
    slopes = []
    for pairs in quarters:
        used = inside & (pairs >= LEAST_PAIRS // QUARTERS**2)
        if used.sum() > 2:
            slopes.append(np.polyfit(logarithm[used], np.log(pairs[used]), 1)[0])
    if len(slopes) < 3:
        return 0.0
    return np.std(slopes, ddof=1) / np.sqrt(QUARTERS)


def _longest(slope, usable):
    """First and last bin of the longest range of usable slopes that agree; the flattest of equally long ones."""
    best, best_key = None, (0, 0.0)
    span = int(LEAST_SPAN_NATS * BINS_PER_NAT) - _SLOPE_BINS
    for first in usable:
        low = high = slope[first]
        for last in range(first + 1, len(slope)):
            if not np.isfinite(slope[last]) or last not in usable:
                break
            low, high = min(low, slope[last]), max(high, slope[last])
            if high - low > SLOPE_TOLERANCE * (high + low):
                break
            key = (last - first, -(high - low))
            if last - first >= span and key > best_key:
                best, best_key = (int(first), last), key
    return best
