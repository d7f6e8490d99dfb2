"""Orbit (bifurcation) diagram of strobed motions over a parameter, and the same as an image of counts.

Drawn as dots, a thousand points of chaos and two points of a period-2 motion look alike once they overlap. Counts per
pixel keep the invariant density visible; a logarithmic scale keeps a pixel of one point visible beside a pixel of a
thousand.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from analysis.sampling import checked_count, checked_series, locked


@dataclass(frozen=True, eq=False)
class OrbitDiagram:
    """One column of points per parameter value.

    parameter (p,)    rising, each value once
    columns (p,)      tuple of arrays (m_i,): the points over each parameter value; empty where a run gave none
    """

    parameter: np.ndarray
    columns: tuple[np.ndarray, ...]


def orbit_diagram(parameters: ArrayLike, strobed: Iterable[ArrayLike]) -> OrbitDiagram:
    """Columns of strobed points over their parameter values, in rising order.

    parameters (p,)   e.g. wave steepness; a value given twice (two starts, coexisting motions) makes one joint column
    strobed           p arrays (m_i,): one strobed coordinate each, transient already left out; may be empty
    Returns an OrbitDiagram.
    Raises ValueError for values that are not finite, unequal numbers of parameters and arrays, or no parameter at all.
    """
    parameter = checked_series(parameters, "parameters")
    strobed = list(strobed)
    if len(parameter) == 0 or len(parameter) != len(strobed):
        given = f"{len(strobed)} arrays for {len(parameter)} values"
        raise ValueError(f"one array of points per parameter value is needed, given {given}")
    arrays = [checked_series(points, f"strobed[{i}]") for i, points in enumerate(strobed)]
    values = np.unique(parameter)
    columns = tuple(locked(np.concatenate([arrays[i] for i in np.flatnonzero(parameter == value)])) for value in values)
    return OrbitDiagram(locked(values), columns)


def density_image(diagram: OrbitDiagram, value_bins: int = 400) -> tuple[np.ndarray, np.ndarray]:
    """Counts of an orbit diagram per pixel: one pixel column per parameter value, `value_bins` rows.

    Returns (counts (v, p), edges (v + 1,)): points per pixel, row 0 holding the lowest values, and evenly spaced values
    over the range of all points with 2 % of margin. The counts add up to the points of every column.
    Raises ValueError for a diagram without a single point.
    """
    values = np.concatenate(diagram.columns)
    if values.size == 0:
        raise ValueError("an image needs points, given a diagram without a single point")
    low, high = values.min(), values.max()
    margin = 0.02 * (high - low)
    if margin <= 1e-12 * max(abs(low), abs(high)):  # all points are the same: a width that can be seen
        margin = 0.02 * abs(high) or 1.0
    edges = np.linspace(low - margin, high + margin, checked_count(value_bins, "value_bins") + 1)
    counts = np.stack([np.histogram(column, bins=edges)[0] for column in diagram.columns], axis=1)
    return counts, edges
