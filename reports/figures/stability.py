"""The stability report's figures: the verdict of every case; error and cost over stiffness."""

from collections.abc import Mapping, Sequence

import numpy as np

from ..parts import Picture
from ..parts.style import BLUE, GREEN, ORANGE, SKY, SOFT, VERMILION, picture_of, sheet

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


VERDICT_COLOURS = {"ok": GREEN, "refused": SKY, "known limit": ORANGE, "unexplained": VERMILION}


def case_grid(verdicts: Mapping[str, Sequence[str]]) -> Picture:
    """verdicts: title of a group -> the verdict of each of its cases."""
    from matplotlib.patches import Patch

    rows = len(verdicts)
    with sheet(0.6 + 0.24 * rows) as figure:
        axes = figure.add_subplot()
        for row, words in enumerate(verdicts.values()):
            colours = [VERDICT_COLOURS.get(word, SOFT) for word in words]
            axes.bar(range(len(words)), 0.8, 0.8, row - 0.4, color=colours, align="edge")
        axes.set(ylim=(rows - 0.4, -0.6), yticks=range(rows), yticklabels=list(verdicts), xticks=[])
        axes.tick_params(axis="y", length=0, labelsize=7.5)
        axes.spines[:].set_visible(False)
        axes.grid(False)
        present = set().union(*verdicts.values())
        names = [word for word in VERDICT_COLOURS if word in present]
        names += sorted(present - VERDICT_COLOURS.keys())
        handles = [Patch(color=VERDICT_COLOURS.get(name, SOFT), label=name) for name in names]
        figure.legend(handles=handles, loc="outside upper left", ncols=len(handles))
        return picture_of(figure)
