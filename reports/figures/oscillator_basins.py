"""Basins of eq. (33): which start ends on which attractor."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, GREEN, INK, ORANGE, PURPLE, SKY, VERMILION, picture_of, sheet
from .oscillator_section import DISPLACEMENT, VELOCITY

_COLOURS = (VERMILION, ORANGE, GREEN, PURPLE, BLUE)
_APERIODIC = "#dbe9f4"


def oscillator_basins(
    label: np.ndarray, box, names: list[str], orbits: list[np.ndarray], section: np.ndarray
) -> Picture:
    """Label of each start (rows, columns) of a grid over the box, names of all labels (the last is aperiodic), strobed
    points of each periodic attractor, and points (m, 2) of the section to show where the other one lies."""
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    shown = np.minimum(label, len(_COLOURS))  # attractors beyond the fifth share the last colour
    aperiodic = label == len(names) - 1
    colours = [*_COLOURS, SKY, _APERIODIC]
    image = np.where(aperiodic, len(colours) - 1, shown)
    with sheet(4.3) as figure:
        axes = figure.subplots()
        axes.grid(False)
        axes.imshow(
            image, origin="lower", extent=box, aspect="auto", interpolation="nearest",
            cmap=ListedColormap(colours), vmin=-0.5, vmax=len(colours) - 0.5,
        )  # fmt: skip
        axes.plot(*section.T, ",", color=INK)
        for orbit in orbits[:6]:
            axes.plot(*orbit.T, "o", markersize=3.5, color="white", markeredgecolor=INK, markeredgewidth=0.8)
        keys = [Patch(facecolor=[*_COLOURS, SKY][min(i, 5)], label=name) for i, name in enumerate(names[:-1][:6])]
        keys.append(Patch(facecolor=_APERIODIC, label=names[-1]))
        figure.legend(handles=keys, loc="outside upper left", ncols=3)
        axes.set_xlabel(DISPLACEMENT)
        axes.set_ylabel(VELOCITY)
        axes.set_xlim(*box[:2])
        axes.set_ylim(*box[2:])
        return picture_of(figure, "png")
