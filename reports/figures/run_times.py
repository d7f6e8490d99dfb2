"""What each run of a sweep cost: wall time and Newton iterations."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, VERMILION, picture_of, sheet


def run_times(steepness: np.ndarray, wall_s: np.ndarray, newton_per_period: np.ndarray, failed: np.ndarray) -> Picture:
    """Cost against steepness.

    Args: (n,) arrays; `newton_per_period` Newton iterations for each wave period simulated; `failed` bool marks runs
    that ended early (crosses).
    """
    with sheet(2.4) as figure:
        for axes, values, label in zip(
            figure.subplots(1, 2),
            (wall_s, newton_per_period),
            ("wall time of the run (s)", "Newton iterations per period"),
            strict=True,
        ):
            axes.plot(steepness[~failed], values[~failed], "o", color=BLUE, markersize=4, label="ended as asked")
            if failed.any():
                axes.plot(steepness[failed], values[failed], "x", color=VERMILION, markersize=6, label="ended early")
                axes.legend(loc="upper left", ncols=2)
            axes.set_xlabel(r"wave steepness $kA$ (–)")
            axes.set_ylabel(label)
            axes.margins(x=0.06)
            axes.set_ylim(0.0, 1.3 * max(float(values.max()), 1e-9))  # room for the legend above the points
        return picture_of(figure)
