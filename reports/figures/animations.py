"""A tether that snaps: a GIF for the page, and stills for paper."""

import numpy as np

from engine.animation import Shapes, animated, shape_panel, tension_panel

from ..parts import Picture
from ..parts.style import VERMILION, picture_of, sheet

_STILLS = "abcdef"


def tether_animation(snap: Shapes) -> Picture:
    """The GIF: tether and buoy in true proportion, beside them the top tension with the moment marked."""
    with sheet(3.4) as figure:
        return Picture(animated(figure, snap), "gif")


def tether_stills(snap: Shapes) -> Picture:
    """Six shapes in true proportion, and the top tension with these moments marked.

    About the highest tension: four before it, a sixth of a wave period apart, it, and one after.
    """
    peak = int(np.argmax(snap.pull_kN(slice(None))))
    step = max(1, round(1.0 / 6.0 / max(float(snap.times[1] - snap.times[0]), 1e-9)))
    first = min(max(peak - 4 * step, 0), max(len(snap.times) - 1 - 5 * step, 0))
    rows = np.clip(first + step * np.arange(len(_STILLS)), 0, len(snap.times) - 1)
    with sheet(4.6, layout=None) as figure:
        places = {"left": 0.08, "right": 0.99, "bottom": 0.1, "top": 0.94, "hspace": 0.3, "wspace": 0.12}
        mosaic = [list(_STILLS), ["T"] * len(_STILLS)]
        grid = figure.subplot_mosaic(mosaic, height_ratios=[1.5, 1.0], gridspec_kw=places)
        tension_panel(grid["T"], snap)
        grid["T"].plot(snap.times[rows], snap.pull_kN(rows), "o", color=VERMILION, markersize=5)
        for letter, row in zip(_STILLS, rows, strict=True):
            axes, place = grid[letter], (snap.times[row], snap.pull_kN(row))
            shape_panel(axes, snap)[1](int(row))
            axes.set_title(f"({letter}) {snap.times[row]:.2f}")
            axes.locator_params(axis="x", nbins=2, integer=True, min_n_ticks=2)
            if letter != "a":
                axes.set_ylabel("")
                axes.tick_params(labelleft=False)
            grid["T"].annotate(f"({letter})", place, xytext=(4, 4), textcoords="offset points", fontsize=7.5)
        return picture_of(figure)
