"""What each part of a scene costs in time."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, picture_of, sheet


def scene_shares(names: list[str], times: np.ndarray) -> Picture:
    """Bars of the times (n,) of a Newton iteration, as shares of the first scene."""
    with sheet(0.9 + 0.2 * len(names)) as figure:
        axes = figure.subplots()
        axes.barh(np.arange(len(names))[::-1], times / times[0], 0.6, color=BLUE)
        axes.set_yticks(np.arange(len(names))[::-1], names)
        axes.axvline(1.0, color="black", linewidth=0.6)
        axes.set_xlabel("time of a Newton iteration, as a share of the first scene's (–)")
        axes.grid(False, axis="y")
        return picture_of(figure)
