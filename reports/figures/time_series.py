"""Histories against t/T_i: the whole record, and its last periods beside it (the paper's figures 9-11, 13, 15, 16)."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..parts.content import Picture
from ..parts.style import INK, SKY, picture_of, sheet

_BINS = 900  # columns of the whole-record view: about two a printed millimetre


@dataclass(frozen=True)
class Panel:
    """One history: its axis label with unit, the samples, and where known the extremes between samples."""

    label: str
    values: np.ndarray
    low: np.ndarray | None = None
    high: np.ndarray | None = None
    colour: str = INK


def time_series(periods: np.ndarray, panels: list[Panel], detail_periods: float = 12.0) -> Picture:
    """Stacked histories on a common axis.

    Args: `periods` t/T_i (n,), increasing; `panels` of n values each; `detail_periods` the length of the right column.
    A record no longer than 1.5 times the detail is drawn once, in full width.
    """
    last = float(periods[-1]) if len(periods) else 0.0
    has_detail = last > 1.5 * detail_periods
    with sheet(0.85 + 1.0 * len(panels)) as figure:
        grid = figure.subplots(
            len(panels),
            2 if has_detail else 1,
            sharex="col",
            sharey="row",
            squeeze=False,
            gridspec_kw={"width_ratios": [1.9, 1.0] if has_detail else [1.0]},
        )
        for row, panel in zip(grid, panels, strict=True):
            _draw(row[0], periods, panel, slice(None))
            row[0].set_ylabel(panel.label)
            if has_detail:
                _draw(row[1], periods, panel, periods >= last - detail_periods)
        grid[0, 0].set_title("whole record")
        grid[-1, 0].set_xlabel(r"$t/T_i$ (wave periods)")
        if has_detail:
            grid[0, 1].set_title(f"last {detail_periods:g} periods")
            grid[-1, 1].set_xlabel(r"$t/T_i$ (wave periods)")
        for axes in grid[-1]:
            axes.margins(x=0.01)
            axes.locator_params(axis="x", integer=True, nbins=6)
        figure.align_ylabels(grid[:, 0])
        return picture_of(figure)


def _draw(axes, periods: np.ndarray, panel: Panel, part) -> None:
    t = periods[part]
    if panel.low is not None and panel.high is not None:
        low, high = panel.low[part], panel.high[part]
        index = _kept(low, high)
        x, low, high = t[index], low[index], high[index]
        axes.fill_between(x, np.minimum(low, high), np.maximum(low, high), color=SKY, alpha=0.5, linewidth=0)
    axes.plot(*envelope(t, panel.values[part]), color=panel.colour, linewidth=0.7)


def envelope(x: np.ndarray, y: np.ndarray, bins: int = _BINS) -> tuple[np.ndarray, np.ndarray]:
    """A line through the least and greatest y of each of `bins` equal spans: looks like the full line at that width.

    Args: x (n,) increasing, y (n,). Returns x, y of at most 2*bins points; a shorter record comes back as it is.
    Every extreme of y is kept, which simple thinning would lose.
    """
    index = _kept(y, bins=bins)
    return x[index], y[index]


def _kept(*curves: np.ndarray, bins: int = _BINS) -> np.ndarray:
    """Where any of the curves, (n,) each, has its least or greatest value within one of `bins` equal spans."""
    n = len(curves[0])
    if n <= 2 * bins:
        return np.arange(n)
    keep: set[int] = set()
    for first, end in pairwise(np.linspace(0, n, bins + 1).astype(int)):
        for part in (curve[first:end] for curve in curves):
            if np.isfinite(part).any():
                keep.update((first + int(np.nanargmin(part)), first + int(np.nanargmax(part))))
    return np.array(sorted(keep), dtype=int)
