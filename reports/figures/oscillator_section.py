"""The section of eq. (33), figure 19(b) of the paper, and zooms into it."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from ..parts.style import INK, VERMILION, picture_of, sheet

DISPLACEMENT, VELOCITY = r"displacement $\gamma$ (–)", r"velocity $\dot\gamma$ (–)"


def oscillator_section(states: np.ndarray, boxes: np.ndarray, orbit: np.ndarray | None) -> Picture:
    """The whole section: states (m, 2), the boxes (b, 4) of the zooms, points (p, 2) of a coexisting orbit or None."""
    with sheet(4.9) as figure:
        axes = figure.subplots()
        axes.grid(False)
        axes.plot(*states.T, ",", color=INK, alpha=0.6 if len(states) > 20000 else 1.0)
        _label_boxes(axes, boxes)
        if orbit is not None:
            axes.plot(*orbit.T, "o", color=VERMILION, markersize=4, label=f"attracting period-{len(orbit)} orbit")
            axes.legend(loc="upper left")
        axes.set_xlabel(DISPLACEMENT)
        axes.set_ylabel(VELOCITY)
        return picture_of(figure, "png")


def oscillator_zooms(zooms: list[np.ndarray], boxes: np.ndarray) -> Picture:
    """One panel for each zoom: states (m, 2) inside its box (4,); the next box is drawn in."""
    with sheet(3.5) as figure:
        row = figure.subplots(1, len(zooms), squeeze=False)[0]
        for index, (axes, states, box) in enumerate(zip(row, zooms, boxes, strict=True)):
            axes.grid(False)
            axes.plot(*states.T, ",", color=INK, alpha=0.7)
            axes.set_xlim(*box[:2])
            axes.set_ylim(*box[2:])
            axes.set_title(f"zoom {index + 1}")
            _label_boxes(axes, boxes[index + 1 :], index + 2)
            axes.set_xlabel(DISPLACEMENT)
            axes.locator_params(axis="x", nbins=5)
        row[0].set_ylabel(VELOCITY)
        return picture_of(figure, "png")


def _label_boxes(axes, boxes: np.ndarray, first: int = 1) -> None:
    from matplotlib.patches import Rectangle

    for number, (left, right, low, high) in enumerate(boxes, first):
        axes.add_patch(Rectangle((left, low), right - left, high - low, fill=False, edgecolor=VERMILION, linewidth=0.9))
        if number == first:
            axes.annotate(
                f"zoom {number}", (0.5 * (left + right), high), xytext=(0, 3), textcoords="offset points",
                color=VERMILION, fontsize=7.5, va="bottom", ha="center",
                bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8, "alpha": 0.9},
            )  # fmt: skip
