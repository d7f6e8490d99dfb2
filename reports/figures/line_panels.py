"""The paper's figures 2-7: configurations, tension and velocity of a breaking line, one panel a case, 10 ms apart."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, SOFT, VERMILION, picture_of, sheet
from .curves import cells

_WIDTH_IN = 5.6  # of all panels of a row


@dataclass(frozen=True)
class LinePanel:
    """Curves of one case: its title, x (m, n) or (n,) and y (m, n) of m instants, and these instants (m,), s."""

    title: str
    x: np.ndarray
    y: np.ndarray
    time_s: np.ndarray


def line_panels(panels: list[LinePanel], x_label: str, y_label: str, y_limits: list[tuple], centre: bool) -> Picture:
    """Two panels a row, curves coloured by time on one scale.

    y_limits: (low, high) of each panel; centre: mark the fixed end at x = 0.
    """
    with sheet(line_panels_height_in(len(panels))) as figure:
        fill_line_panels(figure, panels, x_label, y_label, y_limits, centre)
        return picture_of(figure)


def line_panels_height_in(count: int) -> float:
    """The height of so many panels."""
    return 0.4 + 1.8 * ((count + 1) // 2)


def paired_limits(cases: list[str], panels: list[LinePanel]) -> list[tuple[float, float]]:
    """The paper's scales: (low, high) of each panel, one scale for cases 1 and 2 and one for 3 and 4."""
    limits = []
    for case in cases:
        pair = "12" if case[0] in "12" else "34"
        together = [panel.y for other, panel in zip(cases, panels, strict=True) if other[0] in pair]
        low, high = min(float(y.min()) for y in together), max(float(y.max()) for y in together)
        limits.append((low - 0.03 * (high - low), high + 0.05 * (high - low)))
    return limits


def fill_line_panels(
    figure, panels: list[LinePanel], x_label: str, y_label: str, y_limits: list[tuple], centre: bool
) -> None:
    """`line_panels` on an open sheet."""
    from matplotlib import colormaps
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import LinearSegmentedColormap, Normalize

    late = max(float(panel.time_s[-1]) for panel in panels)
    # without its yellow end, which is lost on white paper
    colours = LinearSegmentedColormap.from_list("time", colormaps["viridis"](np.linspace(0.0, 0.85, 32)))
    scale = ScalarMappable(Normalize(0.0, 1e3 * late), colours)
    for (axes, panel), limits in zip(cells(figure, panels, 2, (x_label, y_label)), y_limits, strict=False):
        x = np.broadcast_to(panel.x, panel.y.shape)
        for row, time_s in enumerate(panel.time_s):
            axes.plot(x[row], panel.y[row], color=scale.to_rgba(1e3 * time_s), linewidth=0.8)
        if centre:
            axes.axvline(0.0, color=SOFT, linewidth=0.7, linestyle=(0, (2, 2)))
        axes.set(title=panel.title, ylim=limits)
        axes.margins(x=0.02)
    figure.colorbar(scale, ax=figure.axes, label="$t$ (ms)", shrink=0.6, aspect=30, pad=0.015)


def folds(panels: list[LinePanel], x_limits: tuple[float, float], z_limits: tuple[float, float]) -> Picture:
    """Shapes in true proportion, two panels a row; x and y of each panel (n,), time_s its one instant."""
    wide = min(len(panels), 2)
    rows = (len(panels) + 1) // 2
    height = _WIDTH_IN / wide * (z_limits[1] - z_limits[0]) / (x_limits[1] - x_limits[0])
    with sheet(0.4 + rows * (0.3 + height)) as figure:
        for axes, panel in cells(figure, panels, 2, ("$x$ (m)", "$z$ (m)"), sharex=True, sharey=True):
            axes.plot(panel.x, panel.y, color=BLUE, linewidth=0.7)
            axes.plot([0.0], [0.0], "o", color=VERMILION, markersize=3)
            axes.set(title=panel.title, aspect="equal", xlim=x_limits, ylim=z_limits)
        return picture_of(figure)
