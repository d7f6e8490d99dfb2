"""Measured speeds of contours of constant tension against the wave speed sqrt(T'/m) at their strain."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, GREEN, INK, ORANGE, PURPLE, SKY, VERMILION, picture_of, sheet

_MARKS = (("o", BLUE), ("s", VERMILION), ("^", GREEN), ("D", ORANGE))
_SLOW = (("o", SKY), ("s", PURPLE), ("^", "#7ad1b5"), ("D", "#f3cf7a"))


def front_speeds(strain: np.ndarray, speed_mps: np.ndarray, measured: list[tuple]) -> Picture:
    """The curve over strain (n,), and for each case (name, strains, measured speeds); a prime marks slow breaks."""
    with sheet(2.9) as figure:
        axes = figure.subplots()
        axes.plot(100 * strain, speed_mps, color=INK, linewidth=1.0, label=r"$\sqrt{T'/m}$")
        for name, at, speeds in measured:
            slow = name.endswith("′")
            marker, colour = (_SLOW if slow else _MARKS)[(int(name[0]) - 1) % 4]
            face = "none" if slow else colour
            axes.plot(
                100 * at, speeds, marker, color=colour, markerfacecolor=face, markersize=6 if slow else 3.5, label=name
            )
        axes.set_xlabel("strain (%)")
        axes.set_ylabel("speed of the contour (m/s)")
        axes.legend(ncols=3, loc="lower right")
        return picture_of(figure)
