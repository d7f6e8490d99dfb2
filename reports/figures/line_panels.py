"""The paper's figures 2-7: configurations, tension and velocity of a breaking line, one panel a case, 10 ms apart."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tables import number

from ..parts import Picture
from ..parts.style import SOFT, picture_of, sheet
from .curves import cells

QUANTITIES = {  # what is drawn -> the same in words, label of its axis, unit
    "z_m": ("motion of a breaking line in the x-z plane", "$z$ (m)", "m"),
    "tension_N": ("tension along a breaking line", "$T$ (N)", "N"),
    "speed_mps": ("velocity along a breaking line", "velocity (m/s)", "m/s"),
}
SCALES = "over the unstretched length s from the fixed end; cases 1 and 2, and 3 and 4, share a scale"
SCALED = {
    "z_m": "heights much enlarged, one scale for all; dashed: the fixed end",
    "tension_N": f"{SCALES}, the same in figs. 3 and 6",
    "speed_mps": SCALES,
}
MARGINS = {"z_m": (0.06, 0.06), "tension_N": (0.03, 0.05), "speed_mps": (0.03, 0.05)}
TENSIONS = (-0.1, 1.06)  # of the largest static tension of the two cases that share a scale


class LinePanel(NamedTuple):
    """Curves of one case: its name, static force; x (m, n) or (n,) and y (m, n) of m instants (m,), s."""

    case: str
    force_N: float
    x: np.ndarray
    y: np.ndarray
    time_s: np.ndarray


def line_panels(panels: Sequence[LinePanel], column: str, kind: str = "svg") -> Picture:
    """Two panels a row, curves coloured by time on one scale; column: of QUANTITIES."""
    from matplotlib import colormaps
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import LinearSegmentedColormap, Normalize
    from matplotlib.ticker import FuncFormatter

    motion, late = column == "z_m", max(float(panel.time_s[-1]) for panel in panels)
    # without its yellow end, which is lost on white paper
    colours = LinearSegmentedColormap.from_list("time", colormaps["viridis"](np.linspace(0.0, 0.85, 32)))
    scale = ScalarMappable(Normalize(0.0, 1e3 * late), colours)
    x_label, y_label = "$s$ (m)", QUANTITIES[column][1]
    if motion:
        x_label = "$x$ (m)"
    with sheet(0.4 + 1.8 * ((len(panels) + 1) // 2)) as figure:
        drawn = cells(figure, panels, 2, (x_label, y_label))
        for (axes, panel), ends, letter in zip(drawn, limits(panels, column), "abcd", strict=False):
            x = np.broadcast_to(panel.x, panel.y.shape)
            for row, time_s in enumerate(panel.time_s):
                axes.plot(x[row], panel.y[row], color=scale.to_rgba(1e3 * time_s), linewidth=0.8)
            if motion:
                axes.axvline(0.0, color=SOFT, linewidth=0.7, linestyle=(0, (2, 2)))
            axes.set(title=f"({letter}) case {named(panel.case)}: {thousands(panel.force_N)} N", ylim=ends)
            axes.margins(x=0.02)
            if column == "tension_N":
                axes.yaxis.set_major_formatter(FuncFormatter(lambda tick, _: thousands(tick)))
        figure.colorbar(scale, ax=figure.axes, label="$t$ (ms)", shrink=0.6, aspect=30, pad=0.015)
        return picture_of(figure, kind)


def limits(panels: Sequence[LinePanel], column: str) -> list[tuple[float, float]]:
    """(low, high) of each panel: one scale for all heights, else one for cases 1 and 2 and one for 3 and 4.

    Tensions are shown over the same share of the static one, because figs. 3 and 6 of the paper have identical scales.
    """
    bounds = []
    below, above = MARGINS[column]
    for panel in panels:
        sharing = panels
        if column != "z_m":
            scale = _scale_of(panel)
            sharing = [other for other in panels if _scale_of(other) == scale]
        least, largest = _ends(sharing)
        force_N = max(other.force_N for other in sharing)
        low, high = least - below * (largest - least), largest + above * (largest - least)
        if column == "tension_N":
            low, high = min(low, TENSIONS[0] * force_N), max(high, TENSIONS[1] * force_N)
        bounds.append((low, high))
    return bounds


def _scale_of(panel: LinePanel) -> str:
    """The cases that share a scale with that of the panel: "12" or "34"."""
    return "12" if panel.case[0] in "12" else "34"


def _ends(panels: Sequence[LinePanel]) -> tuple[float, float]:
    """The least and the largest value of all panels."""
    return float(min(panel.y.min() for panel in panels)), float(max(panel.y.max() for panel in panels))


def seen(panels: Sequence[LinePanel], column: str) -> str:
    """The least and the largest value of all panels, in words."""
    low, high = _ends(panels)
    unit = QUANTITIES[column][2]
    if column == "z_m":
        return f"{number(low, 2)} to {number(high, 2)} {unit}"
    return f"{thousands(low)} to {thousands(high)} {unit}"


def named(case: str) -> str:
    """A case of the command line as the paper writes it: 4, 4′."""
    return case.replace("p", "′")


def thousands(newtons: float) -> str:
    """As the paper prints forces: 45 000."""
    return f"{np.round(newtons):,.0f}".replace(",", "\u202f").replace("-", "−")
