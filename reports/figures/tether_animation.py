"""Buoy and tether in motion while the tether snaps: a GIF for the page, and stills for paper."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..parts.content import Picture
from ..parts.moving import moving_picture
from ..parts.style import BLUE, INK, ORANGE, SKY, SOFT, VERMILION, picture_of, sheet

_FRAMES_PER_SECOND = 12
_STILLS = 6
_MARGIN_M = 1.0
_LEAST_WIDE = 0.4  # of the height of a panel


@dataclass(frozen=True, eq=False)
class Snap:
    """Shapes of the line: `periods` t/T_i (m,), places x and z (m, n) in m, tension (m, n) in N, diameter of the buoy

    `water`: x (k,) and height (m, k) of the surface in m; `record`: t/T_i (j,), top tension (j,) in N, over the same
    time and finer.
    """

    periods: np.ndarray
    x_m: np.ndarray
    z_m: np.ndarray
    tension_N: np.ndarray
    diameter_m: float
    water: tuple[np.ndarray, np.ndarray]
    record: tuple[np.ndarray, np.ndarray]


def tether_animation(snap: Snap) -> Picture:
    """The GIF: tether and buoy in true proportion, beside them the top tension with the moment marked."""
    with sheet(3.4) as figure:
        scene, pull = figure.subplots(1, 2, gridspec_kw={"width_ratios": [1.0, 1.25]})
        drawn = _Scene(scene, snap)
        clock = scene.set_title("")
        _tension(pull, snap)
        (moment,) = pull.plot([], [], "o", color=VERMILION, markersize=6)

        def show(row: int) -> None:
            drawn.show(row)
            clock.set_text(f"$t/T_i$ = {snap.periods[row]:.2f}")
            moment.set_data([snap.periods[row]], [1e-3 * np.interp(snap.periods[row], *snap.record)])

        return moving_picture(figure, [*drawn.moving, clock, moment], len(snap.periods), show, _FRAMES_PER_SECOND)


def tether_stills(snap: Snap, rows: np.ndarray) -> Picture:
    """The shapes of the given frames (six) in true proportion, and the top tension with these moments marked."""
    with sheet(4.6) as figure:
        grid = figure.subplot_mosaic([list("abcdef"), ["T"] * _STILLS], height_ratios=[1.5, 1.0])
        for letter, row in zip("abcdef", rows, strict=True):
            axes = grid[letter]
            _Scene(axes, snap).show(int(row))
            axes.set_title(f"({letter}) {snap.periods[row]:.2f}")
            axes.locator_params(axis="x", nbins=2, integer=True, min_n_ticks=2)
            if letter != "a":
                axes.set_ylabel("")
                axes.tick_params(labelleft=False)
        _tension(grid["T"], snap)
        at = snap.periods[rows]
        height = 1e-3 * np.interp(at, *snap.record)
        grid["T"].plot(at, height, "o", color=VERMILION, markersize=5)
        for letter, x, y in zip("abcdef", at, height, strict=True):
            grid["T"].annotate(f"({letter})", (x, y), xytext=(4, 4), textcoords="offset points", fontsize=7.5)
        return picture_of(figure)


def still_rows(snap: Snap) -> np.ndarray:
    """Six frames about the highest tension: four before it, a sixth of a wave period apart, it, and one after."""
    top = 1e-3 * np.interp(snap.periods, *snap.record)
    peak = int(np.argmax(top))
    step = max(1, round(1.0 / 6.0 / max(float(snap.periods[1] - snap.periods[0]), 1e-9)))
    first = min(max(peak - 4 * step, 0), max(len(top) - 1 - 5 * step, 0))
    return np.clip(first + step * np.arange(_STILLS), 0, len(top) - 1)


class _Scene:
    """One panel: water, anchor, tether, buoy."""

    def __init__(self, axes, snap: Snap):
        from matplotlib.patches import Circle

        self.snap = snap
        self.axes = axes
        radius = 0.5 * snap.diameter_m
        left, right = float(snap.x_m.min()) - radius - _MARGIN_M, float(snap.x_m.max()) + radius + _MARGIN_M
        top = max(float(snap.z_m.max()) + radius, float(snap.water[1].max())) + _MARGIN_M
        more = max(0.0, 0.5 * (_LEAST_WIDE * top - (right - left)))  # of a panel too narrow for the numbers below it
        axes.set(xlim=(left - more, right + more), ylim=(min(float(snap.z_m.min()), 0.0) - 0.3, top), aspect="equal")
        axes.set_xlabel("$x$ (m)")
        axes.set_ylabel("$z$ (m)")
        (self.surface,) = axes.plot([], [], color=SKY, linewidth=1.2)
        (self.rope,) = axes.plot([], [], color=BLUE, linewidth=1.0)
        (self.slack,) = axes.plot([], [], color=VERMILION, linewidth=2.4, solid_capstyle="round")
        self.buoy = axes.add_patch(Circle((0.0, 0.0), radius, facecolor=ORANGE, edgecolor=INK, linewidth=0.8, zorder=3))
        axes.plot([0.0], [0.0], "^", color=INK, markersize=5)
        self.moving = [self.surface, self.rope, self.slack, self.buoy]

    def show(self, row: int) -> None:
        """Draw one frame."""
        x, z = self.snap.x_m[row], self.snap.z_m[row]
        self.surface.set_data(self.snap.water[0], self.snap.water[1][row])
        self.rope.set_data(x, z)
        taut = self.snap.tension_N[row] > 0.0
        self.slack.set_data(x, np.where(taut, np.nan, z))
        self.buoy.center = float(x[-1]), float(z[-1])


def _tension(axes, snap: Snap) -> None:
    axes.axhline(0.0, color=SOFT, linewidth=0.7)
    axes.plot(snap.record[0], 1e-3 * snap.record[1], color=INK, linewidth=0.9)
    axes.set_xlabel("$t/T_i$ (wave periods)")
    axes.set_ylabel("top tension (kN)")
    axes.margins(x=0.02)
