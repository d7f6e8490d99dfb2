"""Measured speeds of contours of constant tension against the wave speed sqrt(T'/m) at their strain."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, GREEN, INK, ORANGE, PURPLE, SKY, VERMILION
from .curves import Curve, Panel, curves

_MARKS = (("o", BLUE), ("s", VERMILION), ("^", GREEN), ("D", ORANGE))
_SLOW = (("o", SKY), ("s", PURPLE), ("^", "#7ad1b5"), ("D", "#f3cf7a"))


def front_speeds(strain: np.ndarray, speed_mps: np.ndarray, measured: list[tuple]) -> Picture:
    """The curve over strain (n,), and for each case (name, strains, measured speeds); a prime marks slow breaks."""
    lines = [Curve(100 * strain, speed_mps, r"$\sqrt{T'/m}$", colour=INK, width=1.0)]
    for name, at, speeds in measured:
        slow = name.endswith("′")
        mark, colour = (_SLOW if slow else _MARKS)[(int(name[0]) - 1) % 4]
        lines.append(Curve(100 * at, speeds, name, "", mark, colour, size=6 if slow else 3.5, filled=not slow))
    return curves([[Panel(lines, "strain (%)", "speed of the contour (m/s)")]], 2.9, "lower right")
