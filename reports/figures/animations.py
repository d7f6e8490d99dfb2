"""What moves: a tether that snaps, a breaking line. A GIF of each for the page, and stills for paper."""

import numpy as np

from engine.animation import Shapes, animated, moving_picture, shape_panel, tension_panel

from ..parts import Picture
from ..parts.style import BLUE, INK, SOFT, VERMILION, picture_of, sheet
from .curves import Curve, Panel, curves

_LINE_FRAMES_PER_SECOND = 10
_STILLS = "abcdef"
_STRIP = 6


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

        artists = [curve, end, pull, clock]
        return Picture(moving_picture(figure, artists, len(time_s), show, _LINE_FRAMES_PER_SECOND), "gif")


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
