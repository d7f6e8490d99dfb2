"""Histories against t/T_i: the whole record, and its last periods beside it (the paper's figures 9-11, 13, 15, 16)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ..parts.content import Picture
from ..parts.style import INK
from .curves import Curve, curves
from .curves import Panel as Axes

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
    last, shown = float(periods[-1]) if len(periods) else 0.0, [("whole record", slice(None))]
    if last > 1.5 * detail_periods:
        shown.append((f"last {detail_periods:g} periods", periods >= last - detail_periods))
    rows = []
    for panel in panels:
        texts = "" if panel is not panels[-1] else r"$t/T_i$ (wave periods)", panel.label
        row = [_drawn(periods, panel, part, texts if k == 0 else (texts[0], "")) for k, (_, part) in enumerate(shown)]
        rows.append(row)
    rows[0] = [replace(one, title=title) for one, (title, _) in zip(rows[0], shown, strict=True)]
    return curves(rows, 0.85 + 1.0 * len(panels), share="xy", widths=(1.9, 1.0)[: len(shown)])


def _drawn(periods: np.ndarray, panel: Panel, part, labels: tuple[str, str]) -> Axes:
    t, band = periods[part], None
    if panel.low is not None and panel.high is not None:
        low, high = panel.low[part], panel.high[part]
        index = _kept(low, high)
        low, high = low[index], high[index]
        band = (t[index], np.minimum(low, high), np.maximum(low, high))
    curve = Curve(*envelope(t, panel.values[part]), colour=panel.colour, width=0.7, band=band)
    return Axes([curve], *labels, settings={"xmargin": 0.01}, ticks=4)


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
