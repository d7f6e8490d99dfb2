"""Poincare sections of two motions of one scene over each other, one panel a scene."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, VERMILION, picture_of, sheet


def section_pairs(panels: list[tuple[str, np.ndarray, np.ndarray]], names: tuple[str, str]) -> Picture:
    """Args: per scene a title and the points r (m), r' (m/s) of both motions, (m, 2) and (k, 2); names of the two."""
    with sheet(2.9) as figure:
        for axes, (title, first, second) in zip(figure.subplots(1, len(panels), squeeze=False)[0], panels, strict=True):
            axes.plot(*first.T, "o", color=BLUE, markersize=5.0, fillstyle="none", markeredgewidth=0.7, label=names[0])
            axes.plot(*second.T, ".", color=VERMILION, markersize=3.0, label=names[1])
            axes.set_title(title)
            axes.set_xlabel(r"$r$ (m)")
            axes.set_ylabel(r"$\dot{r}$ (m/s)")
            axes.locator_params(axis="x", nbins=4)
        handles, labels = axes.get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=2)
        return picture_of(figure)
