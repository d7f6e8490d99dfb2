"""Neighbours in delay space that are near in space only, not in time (Theiler's window), and the noise they see."""

from math import comb

import numpy as np
from numpy.typing import ArrayLike

from analysis.embedding_delay import delay_vectors
from analysis.sampling import checked_series

# Neighbourhoods looked at where a statistic over the attractor is enough; drawn with a fixed seed, so that the same
# record gives the same answer.
_SEED = 1


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
    tree, missing, width = cKDTree(points, balanced_tree=False), np.arange(len(rows)), min(count + 7, n)
    while len(missing):
        d, j = tree.query(points[rows[missing]], width)
        d, j = d.reshape(len(missing), -1), j.reshape(len(missing), -1)
        fine = np.abs(j - rows[missing, None]) > theiler
        done = np.sum(fine, axis=1) >= count if width < n else np.ones(len(missing), dtype=bool)
        order = np.argsort(~fine[done], axis=1, kind="stable")[:, :count]
        kept = np.take_along_axis(fine[done], order, axis=1)
        index[missing[done], : order.shape[1]] = np.where(kept, np.take_along_axis(j[done], order, axis=1), -1)
        distance[missing[done], : order.shape[1]] = np.where(kept, np.take_along_axis(d[done], order, axis=1), np.inf)
        missing, width = missing[~done], min(2 * width, n)
    return index, distance


def noise_level(series: ArrayLike, delay: int, dimension: int = 3, centres: int = 400) -> float:
    """Standard deviation of the white noise on a series, from above: the smaller of two estimates.

        differences   median |D^k x| / (0.6745 sqrt(C(2k, k))), least over k = 1 ... 8: noise is what is left when a
                      signal sampled finely is differenced away
        local fit     median residual of x_i fitted linearly on `dimension` samples before and after it (delay apart)
                      over its nearest neighbours: noise is what neighbours do not agree on

    The first serves flows, the second maps. What the fit cannot follow (curvature, too few neighbours) counts as noise,
    so a clean map shows a small number, not 0. Slow or coloured noise looks like signal to both.

    series (n,)    any unit; delay [samples]
    Returns the level in the unit of the series.
    Raises ValueError for values that are not finite or a series too short for one neighbourhood.
    Source: the local fit is the residual of local linear noise reduction, Kantz & Schreiber, Nonlinear Time Series
    Analysis, section 10.3.
    """
    x = checked_series(series)
    level, difference = np.std(x), x
    for order in range(1, 9):
        difference = np.diff(difference)
        level = min(level, np.median(np.abs(difference)) / (0.6745 * np.sqrt(comb(2 * order, order))))
    return float(min(level, _local_residual(x, delay, dimension, centres)))


def _local_residual(x, delay, dimension, centres):
    """Median residual of local linear fits of the middle coordinate on the others."""
    from scipy.spatial import cKDTree

    vectors = delay_vectors(x, delay, 2 * dimension + 1)
    middle, others = vectors[:, dimension], np.delete(vectors, dimension, axis=1)
    neighbours = 6 * vectors.shape[1]
    if len(vectors) < 2 * neighbours:
        raise ValueError(f"noise level: {2 * neighbours} delay vectors at least are needed, given {len(vectors)}")
    rows = np.random.default_rng(_SEED).choice(len(vectors), min(centres, len(vectors)), replace=False)
    _, near = cKDTree(others).query(others[rows], neighbours)
    residual = np.empty(len(rows))
    for k, (row, j) in enumerate(zip(rows, near, strict=True)):
        terms = np.column_stack([np.ones(neighbours), others[j] - others[row]])
        fit = terms @ np.linalg.lstsq(terms, middle[j], rcond=None)[0]
        residual[k] = np.sqrt(np.sum((middle[j] - fit) ** 2) / (neighbours - terms.shape[1]))
    return np.median(residual)
