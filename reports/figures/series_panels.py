"""A measured record and the curves behind its verdict: record and spectrum, section, neighbours, dimension."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, INK, VERMILION, kind_for, picture_of, sheet

_LONGEST_NAME = 24  # letters of a column's name beside its axis
SHOWN = 4000  # samples of the record that are drawn: the last


def record_and_spectrum(
    time: np.ndarray, values: np.ndarray, frequency: np.ndarray, amplitude: np.ndarray, names: tuple[str, str]
) -> Picture:
    """The end of the record (n,) over time, and |X| (m,) of eq. (31) over the angular frequency, logarithmic.

    names: the unit of time; the column, as its file calls it.
    """
    unit, column = names
    with sheet(3.8) as figure:
        upper, lower = figure.subplots(2, 1)
        upper.plot(time[-SHOWN:], values[-SHOWN:], color=INK, linewidth=0.6)
        upper.set_xlabel(f"time ({unit})")
        shown = column if len(column) <= _LONGEST_NAME else column[: _LONGEST_NAME - 1] + "…"
        upper.set_ylabel(shown, parse_math=False)
        moving = amplitude[1:]
        lower.semilogy(frequency[1:], np.maximum(moving, 1e-6 * moving.max(initial=1e-300)), color=BLUE, linewidth=0.7)
        lower.set_xlabel(f"angular frequency (rad/{unit})")
        lower.set_ylabel("$|X|$, eq. (31), as above")
        return picture_of(figure, kind_for(len(frequency) + SHOWN))


def return_map(values: np.ndarray) -> Picture:
    """Each point of the section (m,) against the one before it, and against its number."""
    with sheet(3.0) as figure:
        left, right = figure.subplots(1, 2)
        size = 6.0 if len(values) < 600 else 2.0
        left.scatter(values[:-1], values[1:], s=size, color=BLUE, alpha=0.6, linewidths=0)
        left.set_xlabel("point $k$")
        left.set_ylabel("point $k + 1$")
        right.scatter(np.arange(len(values)), values, s=size, color=BLUE, alpha=0.6, linewidths=0)
        right.set_xlabel("$k$")
        right.set_ylabel("point $k$")
        return picture_of(figure, kind_for(2 * len(values)))


def growth_and_dimension(divergence: list[tuple[str, np.ndarray, np.ndarray]], slopes: list, unit: str) -> Picture:
    """Growth of the distance of neighbours and slopes of the correlation sum.

    Args: `divergence` (name, time (n,), mean ln(distance) (n,)) each; `slopes` (delays, radius (b,), slope (b,)) each.
    """
    with sheet(3.0) as figure:
        left, right = figure.subplots(1, 2)
        for (name, time, curve), look in zip(divergence, ((BLUE, "-"), (VERMILION, "--")), strict=False):
            if np.any(np.isfinite(curve)):
                left.plot(time, curve, color=look[0], linestyle=look[1], label=name)
        left.set_xlabel(f"time ({unit})")
        left.set_ylabel("mean ln(distance) (nats)")
        for (delays, radius, slope), dashes in zip(slopes, ("-", "--", ":"), strict=False):
            right.semilogx(radius, slope, dashes, color=INK, label=f"{delays} delays")
        right.set_xlabel("radius (standard deviations)")
        right.set_ylabel("slope of the correlation sum")
        for axes in (left, right):
            if axes.get_legend_handles_labels()[1]:
                axes.legend()
        return picture_of(figure)
