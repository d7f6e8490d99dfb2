"""Poincare sections in radius and radial speed, one panel a run (the paper's figure 19a), or two runs on each other."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from ..parts.style import kind_for
from .curves import Curve, Panel, curves

_LABELS = (r"$r$ (m)", r"$\dot{r}$ (m/s)")


def section(panels: list[tuple[str, np.ndarray]]) -> Picture:
    """Args: for each run its title and the points r (m), r' (m/s) at one wave phase, (m, 2)."""
    drawn = []
    for title, points in panels:
        size, alpha = (3.6, 0.75) if len(points) < 600 else (2.0, 0.5)
        dots = Curve(*points.T, line="", mark="o", size=size, alpha=alpha)
        drawn.append(Panel([dots], *_LABELS, title, settings=_limits(points), ticks=5))
    return curves([drawn], 2.9 if len(panels) > 1 else 3.6, kind=kind_for(sum(len(points) for _, points in panels)))


def section_pairs(panels: list[tuple[str, np.ndarray, np.ndarray]], names: tuple[str, str]) -> Picture:
    """Args: per scene a title and the points r (m), r' (m/s) of two motions, (m, 2) and (k, 2); names of the two."""
    drawn = []
    for title, first, second in panels:
        rings = Curve(*first.T, names[0], line="", mark="o", size=5.0, width=0.7, filled=False)
        drawn.append(Panel([rings, Curve(*second.T, names[1], line="", mark=".", size=3.0)], *_LABELS, title, ticks=4))
    return curves([drawn], 2.9, "below")


def _limits(points: np.ndarray) -> dict[str, tuple[float, float]]:
    """Axes no narrower than 0.1 m and 0.1 m/s, so that a settled periodic orbit looks like the points it is."""
    low, high = points.min(axis=0), points.max(axis=0)
    middle, half = 0.5 * (low + high), np.maximum(0.56 * (high - low), 0.05)
    return {axis: (middle[i] - half[i], middle[i] + half[i]) for i, axis in enumerate(("xlim", "ylim"))}
