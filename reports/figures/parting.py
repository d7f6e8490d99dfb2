"""How far refined runs of one scene are apart over time: where a motion stops being predictable."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, GREEN, INK, ORANGE, PURPLE, picture_of, sheet


def parting(time_s: np.ndarray, pairs: list[tuple[str, np.ndarray]], limit_m: float) -> Picture:
    """Largest distance so far, m, of each pair (name, (n,)) over time; limit_m is drawn across."""
    with sheet(2.8) as figure:
        axes = figure.subplots()
        for (name, distance), colour in zip(pairs, (BLUE, GREEN, ORANGE, PURPLE), strict=False):
            axes.plot(time_s, np.maximum(np.maximum.accumulate(distance), 1e-12), color=colour, label=name)
        axes.axhline(limit_m, color=INK, linewidth=0.7, linestyle=":")
        axes.set_yscale("log")
        axes.set_ylim(bottom=1e-9)
        axes.set_xlabel("time (s)")
        axes.set_ylabel("largest difference in $r$ so far (m)")
        axes.legend(loc="lower right")
        return picture_of(figure)
