"""Lateral motion of buoy and rope over the depth, for each bending stiffness."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, GREEN, PURPLE, VERMILION, picture_of, sheet


def dependence(panels: list[tuple[str, list[tuple[str, np.ndarray, np.ndarray, np.ndarray]]]], label: str) -> Picture:
    """Panels (title, curves): each curve is (name, depth (p,) in m, lateral distance (p,) in m, decays (p,) bool).

    Filled marks: the motion goes on; open ones: it decays, and the mark is what is left of it.
    """
    with sheet(2.9) as figure:
        for axes, (title, curves) in zip(figure.subplots(1, len(panels), squeeze=False)[0], panels, strict=True):
            for (name, depth, size, decays), colour, mark in zip(
                curves, (BLUE, VERMILION, GREEN, PURPLE), "os^D", strict=False
            ):
                axes.plot(depth, size, "-", color=colour, linewidth=0.6, alpha=0.6)
                axes.plot(depth[~decays], size[~decays], mark, color=colour, markersize=4.5, label=name)
                axes.plot(depth[decays], size[decays], mark, color=colour, markersize=4.5, fillstyle="none")
            axes.set_yscale("log")
            axes.set_title(title)
            axes.set_xlabel("depth $H$ (m)")
            axes.set_ylabel(label)
            axes.margins(0.06)
        axes.legend(loc="upper right")
        return picture_of(figure)
