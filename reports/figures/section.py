"""Poincare sections in radius and radial speed, one panel a run (the paper's figure 19a)."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, kind_for, picture_of, sheet


def section(panels: list[tuple[str, np.ndarray, np.ndarray]]) -> Picture:
    """Points of the section.

    Args: for each run its title, r (m,) in m and r' (m,) in m/s at one wave phase.
    """
    points = sum(len(radius) for _, radius, _ in panels)
    with sheet(2.9 if len(panels) > 1 else 3.6) as figure:
        for axes, (title, radius, rate) in zip(figure.subplots(1, len(panels), squeeze=False)[0], panels, strict=True):
            size, alpha = (10.0, 0.75) if len(radius) < 600 else (3.0, 0.5)
            axes.scatter(radius, rate, s=size, color=BLUE, alpha=alpha, linewidths=0)
            axes.set_title(title)
            axes.set_xlabel(r"$r$ (m)")
            axes.set_ylabel(r"$\dot{r}$ (m/s)")
            _widen(axes, radius, rate)
        return picture_of(figure, kind_for(points))


def _widen(axes, radius: np.ndarray, rate: np.ndarray) -> None:
    """Axes no narrower than 0.1 m and 0.1 m/s, so that a settled periodic orbit looks like the points it is."""
    for values, limit in ((radius, axes.set_xlim), (rate, axes.set_ylim)):
        if len(values):
            middle, half = (values.max() + values.min()) / 2, max((values.max() - values.min()) * 0.56, 0.05)
            limit(middle - half, middle + half)
    axes.locator_params(axis="x", nbins=5)
