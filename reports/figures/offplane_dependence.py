"""Lateral motion of buoy and rope over the depth, for each bending stiffness."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from .curves import COLOURS, Curve, Panel, curves


def dependence(panels: list[tuple[str, list[tuple[str, np.ndarray, np.ndarray, np.ndarray]]]], label: str) -> Picture:
    """Panels (title, curves): each curve is (name, depth (p,) in m, lateral distance (p,) in m, decays (p,) bool).

    Filled marks: the motion goes on; open ones: it decays, and the mark is what is left of it.
    """
    drawn = []
    for title, found in panels:
        lines = []
        for (name, depth, size, decays), colour, mark in zip(found, COLOURS, "os^D", strict=False):
            lines.append(Curve(depth, size, colour=colour, width=0.6, alpha=0.6))
            lines.append(Curve(depth[~decays], size[~decays], name, "", mark, colour, size=4.5))
            lines.append(Curve(depth[decays], size[decays], "", "", mark, colour, size=4.5, filled=False))
        drawn.append(Panel(lines, "depth $H$ (m)", label, title, log="y"))
    return curves([drawn], 2.9, "below")
