"""How far apart two clouds of points are, by the scatter each has of its own: do two motions share a section?

    E(X, Y) = 2 <|x - y|> - <|x - x'|> - <|y - y'|>,      D = sqrt(E/(2 <|x - y|>)),      0 <= D <= 1

the energy distance of Szekely & Rizzo (2004), which is 0 only for equal distributions, made free of units. Points of
one motion are not independent, so D has no table of significance here; its measure is the distance between the halves
of one record, taken with as many points.
"""

import numpy as np
from numpy.typing import ArrayLike

from analysis.sampling import checked_series, record_of_numbers

LEAST_POINTS = 20


@record_of_numbers
class SectionDistance:
    """Distances of two sections, from halves of equal size.

    across   mean D of a half of the one from a half of the other (four pairs); NaN where a section is too short
    within   mean D of the two halves of each
    reason   one sentence
    """

    across: float
    within: float
    reason: str


def section_distance(first: ArrayLike, second: ArrayLike) -> SectionDistance:
    """Distance of two sections, and of the halves of each for comparison.

    first (m, d), second (k, d)   points in the order of time, any units: each coordinate is divided by its standard
                                  deviation over both. The longer is cut at its start
    Returns a SectionDistance: two records of one stationary motion have `across` about as large as `within`; of
    pairs of Henon orbits of 200 points one in twenty-five has more than 1.5 times as much.
    Raises ValueError for values that are not finite, or another number of coordinates.
    """
    a, b = (checked_series(points, name, dimensions=(2,)) for points, name in ((first, "first"), (second, "second")))
    if a.shape[1] != b.shape[1]:
        raise ValueError(f"first and second: as many coordinates are needed, given {a.shape[1]} and {b.shape[1]}")
    half = min(len(a), len(b)) // 2
    if half < LEAST_POINTS:
        reason = f"too short: {2 * LEAST_POINTS} points are needed, given {len(a)} and {len(b)}"
        return SectionDistance(np.nan, np.nan, reason)
    a, b = a[-2 * half :], b[-2 * half :]
    scale = np.concatenate([a, b]).std(axis=0)
    scale[scale == 0.0] = 1.0
    halves = [part / scale for part in (a[:half], a[half:], b[:half], b[half:])]
    within = [energy_distance(halves[0], halves[1]), energy_distance(halves[2], halves[3])]
    across = [energy_distance(early_part, late_part) for early_part in halves[:2] for late_part in halves[2:]]
    return SectionDistance(np.mean(across), np.mean(within), f"halves of {half} points")


def energy_distance(first: np.ndarray, second: np.ndarray) -> float:
    """D of two clouds (m, d) and (k, d): 0 for the same cloud, 1 for two that are each a single point."""
    from scipy.spatial.distance import cdist

    across = cdist(first, second).mean()
    if across == 0.0:
        return 0.0
    distance = 2.0 * across - cdist(first, first).mean() - cdist(second, second).mean()
    return float(np.sqrt(max(distance, 0.0) / (2.0 * across)))
