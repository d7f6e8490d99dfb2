"""What moves: a tether that snaps, a breaking line. A GIF of each for the page, and stills for paper."""

from typing import NamedTuple

import numpy as np

from ..parts import Picture
from ..parts.style import BLUE, INK, ORANGE, SKY, SOFT, VERMILION, WIDTH_IN, moving_picture, picture_of, sheet
from .curves import Curve, Panel, curves, draw

_FRAMES_PER_SECOND = 12
_LINE_FRAMES_PER_SECOND = 10
_STILLS = "abcdef"
_STRIP = 6
_MARGIN_M = 1.0
_LEAST_WIDE = 0.4  # of the height of a panel


class Snap(NamedTuple):
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

    def pull_kN(self, rows: object) -> np.ndarray:
        """Top tension of the given frames."""
        return 1e-3 * np.interp(self.periods[rows], *self.record)


def tether_animation(snap: Snap) -> Picture:
    """The GIF: tether and buoy in true proportion, beside them the top tension with the moment marked."""
    with sheet(3.4) as figure:
        scene, pull = figure.subplots(1, 2, gridspec_kw={"width_ratios": [1.0, 1.25]})
        moving, place = _scene(scene, snap)
        clock = scene.set_title("")
        draw(pull, _tension(snap))
        (moment,) = pull.plot([], [], "o", color=VERMILION, markersize=6)

        def show(row: int) -> None:
            place(row)
            clock.set_text(f"{snap.periods[row]:.2f} wave periods")
            moment.set_data([snap.periods[row]], [snap.pull_kN(row)])

        return moving_picture(figure, [*moving, clock, moment], len(snap.periods), show, _FRAMES_PER_SECOND)


def tether_stills(snap: Snap) -> Picture:
    """Six shapes in true proportion, and the top tension with these moments marked.

    About the highest tension: four before it, a sixth of a wave period apart, it, and one after.
    """
    peak = int(np.argmax(snap.pull_kN(slice(None))))
    step = max(1, round(1.0 / 6.0 / max(float(snap.periods[1] - snap.periods[0]), 1e-9)))
    first = min(max(peak - 4 * step, 0), max(len(snap.periods) - 1 - 5 * step, 0))
    rows = np.clip(first + step * np.arange(len(_STILLS)), 0, len(snap.periods) - 1)
    with sheet(4.6, WIDTH_IN) as figure:
        places = {"left": 0.08, "right": 0.99, "bottom": 0.1, "top": 0.94, "hspace": 0.3, "wspace": 0.12}
        mosaic = [list(_STILLS), ["T"] * len(_STILLS)]
        grid = figure.subplot_mosaic(mosaic, height_ratios=[1.5, 1.0], gridspec_kw=places)
        draw(grid["T"], _tension(snap))
        grid["T"].plot(snap.periods[rows], snap.pull_kN(rows), "o", color=VERMILION, markersize=5)
        for letter, row in zip(_STILLS, rows, strict=True):
            axes, place = grid[letter], (snap.periods[row], snap.pull_kN(row))
            _scene(axes, snap)[1](int(row))
            axes.set_title(f"({letter}) {snap.periods[row]:.2f}")
            axes.locator_params(axis="x", nbins=2, integer=True, min_n_ticks=2)
            if letter != "a":
                axes.set_ylabel("")
                axes.tick_params(labelleft=False)
            grid["T"].annotate(f"({letter})", place, xytext=(4, 4), textcoords="offset points", fontsize=7.5)
        return picture_of(figure)


def _scene(axes, snap: Snap) -> tuple[list, object]:
    """Water, anchor, tether and buoy on the axes: what moves, and the function that puts it where a frame has it."""
    from matplotlib.patches import Circle

    radius = 0.5 * snap.diameter_m
    x_min, x_max = float(snap.x_m.min()) - radius - _MARGIN_M, float(snap.x_m.max()) + radius + _MARGIN_M
    top = max(float(snap.z_m.max()) + radius, float(snap.water[1].max())) + _MARGIN_M
    margin = max(0.0, 0.5 * (_LEAST_WIDE * top - (x_max - x_min)))  # of a panel too narrow for the numbers below it
    axes.set(xlim=(x_min - margin, x_max + margin), ylim=(min(float(snap.z_m.min()), 0.0) - 0.3, top), aspect="equal")
    axes.set(xlabel="$x$ (m)", ylabel="$z$ (m)")
    (surface,) = axes.plot([], [], color=SKY, linewidth=1.2)
    (rope,) = axes.plot([], [], color=BLUE, linewidth=1.0)
    (slack,) = axes.plot([], [], color=VERMILION, linewidth=2.4, solid_capstyle="round")
    buoy = axes.add_patch(Circle((0.0, 0.0), radius, facecolor=ORANGE, edgecolor=INK, linewidth=0.8, zorder=3))
    axes.plot([0.0], [0.0], "^", color=INK, markersize=5)

    def place(row: int) -> None:
        x, z = snap.x_m[row], snap.z_m[row]
        surface.set_data(snap.water[0], snap.water[1][row])
        rope.set_data(x, z)
        slack.set_data(x, np.where(snap.tension_N[row] > 0.0, np.nan, z))
        buoy.set_center((float(x[-1]), float(z[-1])))

    return [surface, rope, slack, buoy], place


def _tension(snap: Snap) -> Panel:
    record = Curve(snap.record[0], 1e-3 * snap.record[1], colour=INK)
    return Panel([record], "$t/T_i$ (wave periods)", "top tension (kN)", level=0.0, settings={"xmargin": 0.02})


def line_animation(time_s, s_m, x_m, z_m, tension_N) -> Picture:
    """The GIF: shape above, tension along the line below; times (m,), places (n,), the other arrays (m, n)."""
    with sheet(3.6) as figure:
        shape, tension = figure.subplots(2, 1)
        (curve,) = shape.plot([], [], color=BLUE, linewidth=1.2)
        (end,) = shape.plot([], [], "o", color=VERMILION, markersize=4)
        shape.axvline(0.0, color=SOFT, linewidth=0.7, linestyle=(0, (2, 2)))
        shape.set(xlabel="$x$ (m)", ylabel="$z$ (m)", **_limits(x_m, z_m))
        (pull,) = tension.plot([], [], color=INK, linewidth=1.0)
        ends = min(1.05e-3 * float(tension_N.min()), -20.0), 1.08e-3 * float(tension_N.max())
        words = {"xlabel": "$s$ (m), unstretched, from the fixed end", "ylabel": "$T$ (kN)"}
        tension.set(xlim=(s_m[0], s_m[-1]), ylim=ends, **words)
        clock = shape.set_title("t = 0 ms")

        def show(row: int) -> None:
            curve.set_data(x_m[row], z_m[row])
            end.set_data(x_m[row, -1:], z_m[row, -1:])
            pull.set_data(s_m, 1e-3 * tension_N[row])
            clock.set_text(f"t = {1e3 * time_s[row]:.0f} ms")

        return moving_picture(figure, [curve, end, pull, clock], len(time_s), show, _LINE_FRAMES_PER_SECOND)


def line_strip(time_s: np.ndarray, x_m: np.ndarray, z_m: np.ndarray) -> Picture:
    """A few of the shapes, evenly spaced in time, below one another."""
    rows, limits = [], _limits(x_m, z_m)
    for row in np.linspace(0, len(time_s) - 1, _STRIP).round().astype(int):
        end = Curve(x_m[row, -1:], z_m[row, -1:], line="", mark="o", colour=VERMILION, size=3.0)
        shape, title = [Curve(x_m[row], z_m[row], width=1.0), end], f"{1e3 * time_s[row]:.0f} ms"
        x_label = "" if len(rows) < _STRIP - 1 else "$x$ (m)"
        rows.append([Panel(shape, x_label, "$z$ (m)", title, settings=limits, marks=[(0.0, "")])])
    return curves(rows, 0.4 + 0.85 * _STRIP, share="x")


def _limits(x_m: np.ndarray, z_m: np.ndarray) -> dict[str, tuple[float, float]]:
    x_room, z_room = 0.03 * np.ptp(x_m), 0.1 * np.ptp(z_m)
    return {"xlim": (x_m.min() - x_room, x_m.max() + x_room), "ylim": (z_m.min() - z_room, z_m.max() + z_room)}
