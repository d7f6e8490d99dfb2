"""Fronts of breaking lines over place and time: exact characteristics and shocks over the computed tension."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..parts.content import Picture
from ..parts.style import INK, VERMILION, picture_of, sheet
from .curves import cells

_COLUMNS = 300


@dataclass(frozen=True)
class FrontPanel:
    """Tension over the static one (nt, nn) at times (nt,), s, and places (nn,), m; exact lines as (times, places)."""

    title: str
    time_s: np.ndarray
    s_m: np.ndarray
    share: np.ndarray
    lines: list[tuple[np.ndarray, np.ndarray]]
    shock: tuple[np.ndarray, np.ndarray] | None


def front_plane(panels: list[FrontPanel]) -> Picture:
    """Four panels a row: tension as a shade, C- as thin lines, the shock as a thick dashed one."""
    from matplotlib.colors import LinearSegmentedColormap

    shades = LinearSegmentedColormap.from_list("tension", ("#d9b38c", "#ffffff", "#9ecae1", "#2171b5"))
    rows = (len(panels) + 3) // 4
    with sheet(0.7 + 2.35 * rows) as figure:
        for axes, panel in cells(figure, panels, 4, ("$s$ (m)", "$t$ (ms)"), sharex=True):
            even = np.linspace(panel.s_m[0], panel.s_m[-1], _COLUMNS)
            image = np.array([np.interp(even, panel.s_m, row) for row in panel.share])
            extent = (panel.s_m[0], panel.s_m[-1], 1e3 * panel.time_s[0], 1e3 * panel.time_s[-1])
            shown = axes.imshow(
                image, origin="lower", extent=extent, aspect="auto", cmap=shades, vmin=-0.5, vmax=1.0,
                interpolation="bilinear",
            )  # fmt: skip
            for times, places in panel.lines:
                axes.plot(places, 1e3 * times, color=INK, linewidth=0.6)
            if panel.shock is not None:
                axes.plot(panel.shock[1], 1e3 * panel.shock[0], color=VERMILION, linewidth=1.6, linestyle=(0, (3, 1)))
            axes.grid(False)
            limits = (panel.s_m[0], panel.s_m[-1])
            axes.set(title=panel.title, xlim=limits, ylim=(0.0, 1e3 * panel.time_s[-1]))
        figure.colorbar(shown, ax=figure.axes, label="$T/F$ (–)", shrink=0.6, aspect=30, pad=0.015)
        return picture_of(figure, "png")
