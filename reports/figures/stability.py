"""The stability report's figures: error and cost over stiffness; eigenvalues of one-step maps in the unit circle; what
parts of a scene cost.
"""

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, GREEN, ORANGE, SOFT, VERMILION, picture_of, sheet

ROOM = 1.25  # half width of a panel; what lies outside is drawn on its edge


def stiffness(checks: dict[str, np.ndarray], least: float = 1e-8) -> Picture:
    """checks: name -> (stiffness in N, error of the largest tension, cost over the default scene's) (3, m).

    Errors below `least` are drawn there.
    """
    with sheet(2.6) as figure:
        panels = figure.subplots(1, 2)
        looks = zip((BLUE, VERMILION, GREEN, ORANGE), "osD^", strict=True)
        for (name, (stiff, error, cost)), (color, mark) in zip(checks.items(), looks, strict=False):
            for axes, values in zip(panels, (np.maximum(error, least), cost), strict=True):
                axes.plot(stiff, values, mark, color=color, markersize=3.5, label=name)
        for axes in panels:
            axes.set(xscale="log", yscale="log", xlabel="axial stiffness EA (N)")
        panels[0].set_ylabel("error of the largest tension (–)")
        panels[1].set_ylabel("Newton iterations a second,\nover the default scene's (–)")
        handles, names = panels[0].get_legend_handles_labels()
        figure.legend(handles, names, loc="outside upper center", ncols=len(names), fontsize=7.0)
        return picture_of(figure)


def step_maps(methods: dict[str, np.ndarray]) -> Picture:
    """methods: name -> eigenvalues (m,) complex. Crosses: outside the circle; beyond the panel, on its edge."""
    with sheet(1.95) as figure:
        panels = figure.subplots(1, len(methods), squeeze=False, sharey=True)[0]
        turn = np.linspace(0.0, 2.0 * np.pi, 200)
        for axes, (name, values) in zip(panels, methods.items(), strict=True):
            axes.plot(np.cos(turn), np.sin(turn), "-", color=SOFT, linewidth=0.6)
            outside = np.abs(values) > 1.0 + 1e-6
            shown = values.copy()
            far = np.maximum(np.abs(shown.real), np.abs(shown.imag))
            shown[far > ROOM] *= 0.97 * ROOM / far[far > ROOM]
            axes.plot(shown.real[~outside], shown.imag[~outside], "o", color=BLUE, markersize=1.8)
            axes.plot(shown.real[outside], shown.imag[outside], "x", color=VERMILION, markersize=4.0)
            axes.set(xlim=(-ROOM, ROOM), ylim=(-ROOM, ROOM), aspect="equal", xticks=(-1, 0, 1), yticks=(-1, 0, 1))
            axes.set_title(name, fontsize=7.0)
            axes.set_xlabel(r"Re $\mu$ (–)")
        panels[0].set_ylabel(r"Im $\mu$ (–)")
        return picture_of(figure)


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
