"""Lateral motion over time on a logarithmic axis (the paper's figure 20)."""

from typing import NamedTuple

import numpy as np

from ..parts import Picture
from ..parts.style import BLUE, VERMILION
from .curves import Curve, Panel, curves, envelope

INPLANE = "in-plane half range of the buoy"
_DECADES_BELOW = 1.5  # room for the swings through zero below the least of the envelope


class History(NamedTuple):
    """One run: its label, |y| over t/T_i, the largest |y| of each period, and the in-plane half range."""

    label: str
    periods: np.ndarray
    size: np.ndarray
    envelope_periods: np.ndarray
    envelope: np.ndarray
    inplane_m: float


def lateral_histories(panels: list[tuple[str, list[History]]], kind: str = "svg", **further: object) -> Picture:
    """Stacked panels (axis label, runs): every sample thin, the largest value of each period thick; solid for the first
    run, dashed for the second; dotted the level of its in-plane motion. further: of every Panel."""
    rows = []
    for label, runs in panels:
        lines, levels = [], []
        for run, colour, dashes in zip(runs, (BLUE, VERMILION), ("-", (0, (4, 1.5))), strict=False):
            known, drawn = run.size > 0, run.envelope > 0
            levels.append(run.envelope[drawn])
            lines += [
                Curve(*envelope(run.periods[known], run.size[known]), colour=colour, width=0.4, alpha=0.35),
                Curve(run.envelope_periods[drawn], levels[-1], run.label, dashes, colour=colour, width=1.1),
                Curve(run.periods[[0, -1]], np.full(2, run.inplane_m), INPLANE, ":", colour=colour, width=1.0),
            ]
        all_levels = np.concatenate(levels)
        low, high = np.min(all_levels), np.max(all_levels)
        top = np.nanmax([high] + [run.inplane_m for run in runs])
        limits = (low / 10**_DECADES_BELOW, 4.0 * top)
        x_label = r"$t/T_i$ (wave periods)" if len(rows) == len(panels) - 1 else ""
        rows.append([Panel(lines, x_label, label, log="y", settings={"xmargin": 0.01}, ylim=limits, **further)])
    return curves(rows, 0.7 + 2.3 * len(panels), "below", "x", kind)
