"""Where the energy of a breaking line goes: shares of what was stored, stacked over time, one panel a case."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, GREEN, ORANGE, SKY, VERMILION, picture_of, sheet
from .curves import cells

KINDS = ("strain", "kinetic", "taken out by the end force", "dissipated", "bending")
_COLOURS = (SKY, BLUE, ORANGE, VERMILION, GREEN)


@dataclass(frozen=True)
class EnergyPanel:
    """One case: its title, times (m,), s, and the shares (5, m) in the order of KINDS."""

    title: str
    time_s: np.ndarray
    shares: np.ndarray


def energy_shares(panels: list[EnergyPanel]) -> Picture:
    """Four panels a row."""
    rows = (len(panels) + 3) // 4
    labels = ("$t$ (ms)", "share of the stored energy (%)")
    with sheet(0.8 + 1.75 * rows) as figure:
        for axes, panel in cells(figure, panels, 4, labels, sharey=True):
            shares = 100 * np.maximum(panel.shares, 0.0)
            shown = axes.stackplot(1e3 * panel.time_s, shares, colors=_COLOURS, linewidth=0.6, edgecolor="white")
            axes.set(title=panel.title, xlim=(0.0, 1e3 * panel.time_s[-1]), ylim=(0.0, 100.0))
        figure.legend(shown, KINDS, loc="outside upper left", ncols=len(KINDS))
        return picture_of(figure)
