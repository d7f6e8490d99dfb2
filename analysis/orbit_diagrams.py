"""Orbit (bifurcation) diagram of strobed motions over a parameter, and the same as an image of counts.

Drawn as dots, a thousand points of chaos and two points of a period-2 motion look alike once they overlap. Counts per
pixel keep the invariant density visible; a logarithmic or rank scale keeps a pixel of one point visible beside a pixel
of a thousand (equalisation of the histogram, as in the rasterisers used for very large point clouds).
"""

from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike

from analysis.sampling import checked_count, checked_series, locked, record


@record
class OrbitDiagram:
    """One column of points per parameter value.

    parameter (p,)    rising, each value once
    columns (p,)      tuple of arrays (m_i,): the points over each parameter value; empty where a run gave none
    """

    parameter: np.ndarray
    columns: tuple[np.ndarray, ...]

    def points(self) -> tuple[np.ndarray, np.ndarray]:
        """All points as two arrays (parameter, value) of equal length, for drawing as dots."""
        counts = [len(column) for column in self.columns]
        return np.repeat(self.parameter, counts), np.concatenate(self.columns)


@record
class DensityImage:
    """An orbit diagram as counts; `pcolormesh(parameter_edges, value_edges, counts)` draws it.

    counts (v, p) int         points per pixel; row 0 holds the lowest values
    parameter_edges (p + 1,)  half-way between neighbouring parameter values
    value_edges (v + 1,)      evenly spaced
    outside (p,) int          points of each column beyond the value range: counts.sum(axis=0) + outside is all of them
    """

    counts: np.ndarray
    parameter_edges: np.ndarray
    value_edges: np.ndarray
    outside: np.ndarray


def orbit_diagram(parameters: ArrayLike, strobed: Iterable[ArrayLike], last: int | None = None) -> OrbitDiagram:
    """Columns of strobed points over their parameter values, in rising order.

    parameters (p,)   e.g. wave steepness; a value given twice (two starts, coexisting motions) makes one joint column
    strobed           p arrays (m_i,): one strobed coordinate each, transient already left out; may be empty
    last              keep at most this many points of each array, from its end; None keeps all
    Returns an OrbitDiagram.
    Raises ValueError for values that are not finite, unequal numbers of parameters and arrays, or no parameter at all.
    """
    parameter = checked_series(parameters, "parameters")
    strobed = list(strobed)
    if len(parameter) == 0 or len(parameter) != len(strobed):
        sizes = f"{len(strobed)} arrays for {len(parameter)} values"
        raise ValueError(f"one array of points per parameter value is needed, given {sizes}")
    first = 0 if last is None else -checked_count(last, "last")
    arrays = [checked_series(points, f"strobed[{i}]")[first:] for i, points in enumerate(strobed)]
    values = np.unique(parameter)
    columns = []
    for value in values:
        together = [arrays[i] for i in np.flatnonzero(parameter == value)]
        columns.append(locked(np.concatenate(together)))
    return OrbitDiagram(values, tuple(columns))


def density_image(
    diagram: OrbitDiagram, value_bins: int = 400, value_range: tuple[float, float] | None = None
) -> DensityImage:
    """Counts of an orbit diagram per pixel: one pixel column per parameter value, `value_bins` rows.

    value_range   (low, high); None spans all points with 2 % of margin. Both ends belong to the image
    Returns a DensityImage, whose counts plus `outside` add up to the points of every column.
    Raises ValueError for an empty diagram without a range, or a range that is not low < high.
    """
    value_bins = checked_count(value_bins, "value_bins")
    low, high = _value_range(diagram) if value_range is None else map(float, value_range)
    if not (np.isfinite(low) and np.isfinite(high) and low < high):
        raise ValueError(f"value_range: low < high, both finite, is needed, given ({low}, {high})")
    edges = np.linspace(low, high, value_bins + 1)
    counts = np.stack([np.histogram(column, bins=edges)[0] for column in diagram.columns], axis=1)
    outside = np.array([len(column) for column in diagram.columns]) - counts.sum(axis=0)
    return DensityImage(counts, _cell_edges(diagram.parameter), edges, outside)


def scale_density(counts: ArrayLike, how: str = "rank") -> np.ndarray:
    """Counts as brightness in [0, 1] that rises with them; 0 only where there is no point.

        linear: c/c_max      log: ln(1 + c)/ln(1 + c_max)      rank: share of the occupied pixels with at most c points

    "rank" spends the scale evenly on the pixels there are, whatever the counts; "log" keeps ratios readable.

    counts   whole numbers >= 0, any shape
    Returns floats of the same shape; all 0 where all counts are.
    Raises ValueError for another word or a negative count.
    """
    counts = np.asarray(counts)
    if counts.size and counts.min() < 0:
        raise ValueError(f"counts: whole numbers >= 0 are needed, given {counts.min()}")
    if how not in ("linear", "log", "rank"):
        raise ValueError(f"how: linear, log or rank is needed, given {how!r}")
    occupied = counts[counts > 0]
    if occupied.size == 0:
        return np.zeros(counts.shape)
    if how == "linear":
        return counts / occupied.max()
    if how == "log":
        return np.log1p(counts) / np.log1p(occupied.max())
    rank = np.searchsorted(np.sort(occupied), counts, side="right") / occupied.size
    return np.where(counts > 0, rank, 0.0)


def _value_range(diagram):
    """Range of all points with a margin; of a width that can be seen where all points are the same."""
    values = np.concatenate(diagram.columns)
    if values.size == 0:
        raise ValueError("value_range: needed for a diagram without a single point")
    low, high = values.min(), values.max()
    margin = 0.02 * (high - low)
    if margin <= 1e-12 * max(abs(low), abs(high)):
        margin = 0.02 * abs(high) or 1.0
    return low - margin, high + margin


def _cell_edges(centres):
    """Edges half-way between rising centres; the outer cells are as wide as their inner half says."""
    if len(centres) == 1:
        return centres + (0.05 * abs(centres[0]) or 0.5) * np.array([-1.0, 1.0])
    middle = 0.5 * (centres[1:] + centres[:-1])
    return np.concatenate([[2 * centres[0] - middle[0]], middle, [2 * centres[-1] - middle[-1]]])
