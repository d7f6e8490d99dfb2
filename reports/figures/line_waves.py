"""A breaking line against exact theory: fronts over place and time, speeds of contours, shares of the energy."""

from typing import NamedTuple

import numpy as np

from ..parts import Picture
from ..parts.style import BLUE, GREEN, INK, ORANGE, PURPLE, SKY, VERMILION, picture_of, sheet
from .curves import Curve, Panel, cells, curves

WIDE = 4  # panels a row
KINDS = ("strain", "kinetic", "taken out by the end force", "dissipated", "bending")
_COLUMNS = 300  # of the shade
_SHARES = (SKY, BLUE, ORANGE, VERMILION, GREEN)
_MARKS = (("o", BLUE), ("s", VERMILION), ("^", GREEN), ("D", ORANGE))
_SLOW = (("o", SKY), ("s", PURPLE), ("^", "#7ad1b5"), ("D", "#f3cf7a"))


class FrontPanel(NamedTuple):
    """Tension over the static one (nt, nn) at times (nt,), s, and places (nn,), m; exact lines as (times, places)."""

    title: str
    time_s: np.ndarray
    s_m: np.ndarray
    share: np.ndarray
    lines: list[tuple[np.ndarray, np.ndarray]]
    shock: tuple[np.ndarray, np.ndarray] | None


def front_plane(panels: list[FrontPanel]) -> Picture:
    """Tension as a shade, C- as thin lines, the shock as a thick dashed one."""
    from matplotlib.colors import LinearSegmentedColormap

    shades = LinearSegmentedColormap.from_list("tension", ("#d9b38c", "#ffffff", "#9ecae1", "#2171b5"))
    with sheet(0.7 + 2.35 * -(-len(panels) // WIDE)) as figure:
        for axes, panel in cells(figure, panels, WIDE, ("$s$ (m)", "$t$ (ms)"), sharex=True):
            even = np.linspace(panel.s_m[0], panel.s_m[-1], _COLUMNS)
            image = np.array([np.interp(even, panel.s_m, row) for row in panel.share])
            extent = (panel.s_m[0], panel.s_m[-1], 1e3 * panel.time_s[0], 1e3 * panel.time_s[-1])
            look = {"cmap": shades, "vmin": -0.5, "vmax": 1.0, "interpolation": "bilinear"}
            shown = axes.imshow(image, origin="lower", extent=extent, aspect="auto", **look)
            for times, places in panel.lines:
                axes.plot(places, 1e3 * times, color=INK, linewidth=0.6)
            if panel.shock is not None:
                axes.plot(panel.shock[1], 1e3 * panel.shock[0], color=VERMILION, linewidth=1.6, linestyle=(0, (3, 1)))
            axes.grid(False)
            axes.set(title=panel.title, xlim=extent[:2], ylim=(0.0, extent[3]))
        figure.colorbar(shown, ax=figure.axes, label="$T/F$ (–)", shrink=0.6, aspect=30, pad=0.015)
        return picture_of(figure, "png")


def front_speeds(strain: np.ndarray, speed_mps: np.ndarray, measured: list[tuple]) -> Picture:
    """The wave speed sqrt(T'/m) over strain (n,), and for each case (name, strains, measured speeds of contours of
    constant tension); a prime marks slow breaks."""
    lines = [Curve(100 * strain, speed_mps, r"$\sqrt{T'/m}$", colour=INK, width=1.0)]
    for name, at, speeds in measured:
        slow = name.endswith("′")
        marks, size = (_SLOW, 6) if slow else (_MARKS, 3.5)
        mark, colour = marks[(int(name[0]) - 1) % 4]
        lines.append(Curve(100 * at, speeds, f"case {name}", "", mark, colour, size=size, filled=not slow))
    return curves([[Panel(lines, "strain (%)", "speed of the contour (m/s)")]], 2.9, "lower right")


def energy_shares(panels: list[tuple[str, np.ndarray, np.ndarray]]) -> Picture:
    """Stacked shares of what was stored: of each case its title, times (m,), s, and shares (5, m) in order of KINDS."""
    labels = ("$t$ (ms)", "share of the stored energy (%)")
    with sheet(0.8 + 1.75 * -(-len(panels) // WIDE)) as figure:
        for axes, (title, time_s, shares) in cells(figure, panels, WIDE, labels, sharey=True):
            above = 100 * np.maximum(shares, 0.0)
            shown = axes.stackplot(1e3 * time_s, above, colors=_SHARES, linewidth=0.6, edgecolor="white")
            axes.set(title=title, xlim=(0.0, 1e3 * time_s[-1]), ylim=(0.0, 100.0))
        figure.legend(shown, KINDS, loc="outside upper left", ncols=len(KINDS))
        return picture_of(figure)
