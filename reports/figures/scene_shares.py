"""What each part of a scene costs, in operations and in time."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, ORANGE, picture_of, sheet


def scene_shares(names: list[str], operations: np.ndarray, times: np.ndarray) -> Picture:
    """Bars of both, (n,) each, as shares of the first scene."""
    with sheet(0.9 + 0.26 * len(names)) as figure:
        axes = figure.subplots()
        at = np.arange(len(names))[::-1]
        axes.barh(at + 0.19, operations / operations[0], 0.36, color=BLUE, label="operations per Newton iteration")
        axes.barh(at - 0.19, times / times[0], 0.36, color=ORANGE, label="time per Newton iteration")
        axes.set_yticks(at, names)
        axes.axvline(1.0, color="black", linewidth=0.6)
        axes.set_xlabel("share of the first scene (–)")
        axes.grid(False, axis="y")
        axes.legend(loc="upper right")
        return picture_of(figure)
