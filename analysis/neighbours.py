"""Neighbours in space that are none in time (Theiler's window), and whether neighbours on a section stay neighbours.

Neighbours stay neighbours on a torus, and nowhere else that is not periodic. A motion whose section map keeps nearby
points nearby for all time (equicontinuity) is conjugate to a rotation: it is periodic or quasi-periodic (Halmos & von
Neumann 1942). So instead of a curve fitted through the points, which needs to know how many curves there are, how
wrinkled they are and of which dimension the torus is, pairs of neighbours are followed:

    d(n) = geometric mean over k of |s_{k+n} - s_{j(k)+n}|,    s_{j(k)} nearest to s_k outside Theiler's window.

On a torus d is constant: the pair keeps its distance in the angle, and the mean over k of ln|ds/dangle| does not depend
on n. In chaos it grows by lambda a step up to the size of the attractor (or of its bands); in noise it jumps to that
size at once. Noise of a record on a torus lifts d at n = 1, since the nearest pair was chosen for its noise, and not
further: growth is counted from the mean over n = 1, 2, 3.
"""

import numpy as np
from numpy.typing import ArrayLike

from analysis.sampling import checked_columns, in_deviations, record, rows_of_state, states_of

LEAST_POINTS = 40
EARLY = slice(1, 4)
THEILER = 1  # periods of a section within which points are no neighbours


def nearest_outside(
    points: np.ndarray, theiler: int, rows: ArrayLike | None = None, count: int = 1
) -> tuple[np.ndarray, np.ndarray]:
    """The nearest neighbours of chosen points that lie more than `theiler` samples away in time.

    points (n, m)    delay vectors in the order of time
    theiler          points with |i - j| <= theiler are no neighbours (Theiler 1986) [samples]
    rows (r,)        indices of the points asked about; None: all
    count            neighbours per point
    Returns (index (r, count) int, distance (r, count)); index -1 and distance inf where there are not so many. Ties at
    distance 0 count as neighbours. Exact: the search widens until enough are found.
    """
    from scipy.spatial import cKDTree

    n = len(points)
    rows = np.arange(n) if rows is None else np.asarray(rows)
    index, distance = np.full((len(rows), count), -1), np.full((len(rows), count), np.inf)
    tree, missing = cKDTree(points, balanced_tree=False), np.arange(len(rows))
    width = min(count + min(2 * theiler + 1, 7), n)
    while len(missing):
        d, j = tree.query(points[rows[missing]], range(1, width + 1))
        near_in_time = np.abs(j - rows[missing, None]) <= theiler
        d[near_in_time], j[near_in_time] = np.inf, -1
        order = np.argsort(d, axis=1, kind="stable")[:, :count]
        d, j = np.take_along_axis(d, order, axis=1), np.take_along_axis(j, order, axis=1)
        enough = (np.sum(j >= 0, axis=1) >= count) | (width == n)
        index[missing[enough], : j.shape[1]], distance[missing[enough], : j.shape[1]] = j[enough], d[enough]
        missing, width = missing[~enough], min(2 * width, n)
    return index, distance


@record
class NeighbourGrowth:
    """How far pairs of neighbours part.

    growth           ln of mean distance over the later half of the horizon less that over n = 1, 2, 3 [nats]; NaN where
                     there is no answer
    late             mean distance over the later half of the horizon, in rms distances of unrelated points
    rate             growth per forcing period, over the mean time between the two [nats/period]: a bound on an exponent
    distance (h+1,)  d(n), in rms distances of unrelated points
    reason           one sentence
    """

    growth: float
    late: float
    rate: float
    distance: np.ndarray
    reason: str


def neighbour_growth(section: ArrayLike) -> NeighbourGrowth:
    """Growth of the distance between neighbours on a section over a quarter of the record (head of this file).

    section (m,) or (m, d)   one row a forcing period, 40 at least
    Returns a NeighbourGrowth; NaN with the reason for a short record or one without motion. An exponent below 4/m nats
    per period does not show in a record of m periods: a weakly chaotic motion passes for a torus as long as that.
    Raises ValueError for values that are not finite.
    Source: the pairs are those of M. T. Rosenstein, J. J. Collins & C. J. De Luca, Physica D 65 (1993) 117.
    """
    x = checked_columns(section, "section")
    z = in_deviations(x)
    why_not = "no motion: the section is one point to the last digits" if z.shape[1] == 0 else ""
    if len(x) < LEAST_POINTS:
        why_not = f"too short: {LEAST_POINTS} strobed points are needed, given {len(x)}"
    if why_not:
        return NeighbourGrowth(np.nan, np.nan, np.nan, np.zeros(0), why_not)
    state = states_of(z, rows_of_state(x.shape[1]))
    horizon = len(state) // 4
    distance = _distance(state, horizon) / np.sqrt(2.0 * np.sum(state.var(axis=0)))
    early, late = np.log(distance[EARLY]).mean(), np.log(distance[horizon // 2 :]).mean()
    later = f"are {np.exp(late):.2g} apart {horizon // 2} and more periods on"
    reason = f"neighbours {np.exp(early):.2g} of the section apart {later}"
    rate = (late - early) / (0.75 * horizon - 2.0)
    return NeighbourGrowth(late - early, np.exp(late), rate, distance, reason)


def _distance(state, horizon):
    """d(n) for n = 0 ... horizon."""
    pool = state[: len(state) - horizon]
    partner = nearest_outside(pool, THEILER)[0][:, 0]
    # The logarithm of a distance needs a least one: half a step of a record that takes few values, else rounding.
    least = np.sqrt(state.shape[1]) * max(1e-14, 0.5 * min(_resolution(column) for column in state.T))
    logarithm = [
        np.mean(np.log(np.maximum(np.linalg.norm(state[n : n + len(pool)] - state[partner + n], axis=1), least)))
        for n in range(horizon + 1)
    ]
    return np.exp(logarithm)


def _resolution(column):
    """Least distance of two different values of a column (n,) in standard deviations; beyond rounding."""
    gaps = np.diff(np.sort(column))
    return np.min(gaps, initial=np.inf, where=gaps > 64 * np.finfo(float).eps * np.abs(column).max())
