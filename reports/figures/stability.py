"""The stability report's figure: error and cost over stiffness."""

import numpy as np

from ..parts import Picture
from ..parts.style import BLUE, GREEN, ORANGE, VERMILION, picture_of, sheet

_LEAST = 1e-8


def stiffness(checks: dict[str, np.ndarray]) -> Picture:
    """checks: name -> (stiffness in N, error of the largest tension, cost over the default scene's) (3, m).

    Errors below _LEAST are drawn there.
    """
    with sheet(2.6) as figure:
        panels = figure.subplots(1, 2)
        looks = zip((BLUE, VERMILION, GREEN, ORANGE), "osD^", strict=True)
        for (name, (stiff, error, cost)), (color, mark) in zip(checks.items(), looks, strict=False):
            for axes, values in zip(panels, (np.maximum(error, _LEAST), cost), strict=True):
                axes.plot(stiff, values, mark, color=color, markersize=3.5, label=name)
        for axes in panels:
            axes.set(xscale="log", yscale="log", xlabel="axial stiffness EA (N)")
        panels[0].set_ylabel("error of the largest tension (–)")
        panels[1].set_ylabel("Newton iterations a second,\nover the default scene's (–)")
        handles, names = panels[0].get_legend_handles_labels()
        figure.legend(handles, names, loc="outside upper center", ncols=len(names), fontsize=7.0)
        return picture_of(figure)
