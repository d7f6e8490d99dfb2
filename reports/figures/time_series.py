"""Histories against t/T_i: the whole record, and its last periods beside it (the paper's figures 9-11, 13, 15, 16)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np

from ..parts.content import Picture
from ..parts.style import INK
from .curves import Curve, Panel, curves

_LAST_PERIODS = 12  # of the right column
_BINS = 900  # columns of the whole-record view: about two a printed millimetre


def time_series(periods: np.ndarray, histories: Mapping[str, Sequence[np.ndarray]]) -> Picture:
    """Stacked histories on a common axis: the whole record, and its last periods beside it where it is long.

    Args: `periods` t/T_i (n,), increasing; `histories`, by the label of the axis with its unit, the samples (n,), and
    where known the least and the greatest values between samples (n,).
    """
    last, shown = float(periods[-1]) if len(periods) else 0.0, {"whole record": slice(None)}
    if last > 1.5 * _LAST_PERIODS:
        shown[f"last {_LAST_PERIODS} periods"] = periods >= last - _LAST_PERIODS
    rows = []
    for label, (values, *extremes) in histories.items():
        below, row = r"$t/T_i$ (wave periods)" if len(rows) == len(histories) - 1 else "", []
        for title, part in shown.items():
            t, ends, band = periods[part], [one[part] for one in extremes], None
            if ends:
                index = _kept(*ends)
                band = (t[index], *np.sort([one[index] for one in ends], axis=0))
            curve = Curve(*envelope(t, values[part]), colour=INK, width=0.7, band=band)
            texts = below, "" if row else label, "" if rows else title
            row.append(Panel([curve], *texts, settings={"xmargin": 0.01}, ticks=4))
        rows.append(row)
    return curves(rows, 0.85 + 1.0 * len(rows), share="xy", widths=(1.9, 1.0)[: len(shown)])


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
