"""Figures 2-7: the breaking line every 10 ms - motion, tension and velocity, one panel a case, in the paper's units.

In the paper: fig. 2 motion of the breaking line, 5 ms; fig. 3 tension along the breaking line, 5 ms; fig. 4 velocity
along the breaking line, 5 ms; fig. 5 motion of the breaking line, 50 ms; fig. 6 tension along the breaking line, 50
ms; fig. 7 velocity along the breaking line, 50 ms.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from ...breaking_line.runs import named
from ...figures.line_panels import LinePanel, fill_line_panels, line_panels_height_in, paired_limits
from ...parts.content import sub
from ...parts.wording import number
from .drawing import Drawing, behind, value

if TYPE_CHECKING:
    import xarray

QUANTITIES = {  # array of a case -> (what is shown, label of its axis, unit)
    "z_m": ("motion of a breaking line in the x-z plane", "$z$ (m)", "m"),
    "tension_N": ("tension along a breaking line", "$T$ (N)", "N"),
    "speed_mps": ("velocity along a breaking line", "velocity (m/s)", "m/s"),
}
LETTERS = "abcd"
F_HS = "F" + sub("h,s")
SCALES = "over the unstretched length s from the fixed end; cases 1 and 2, and 3 and 4, share a scale"
TENSIONS = (-0.1, 1.06)  # of the largest static tension of the two cases that share a scale


def drawing(data: xarray.Dataset) -> Drawing:
    """The figure of a data file. Raises KeyError for one of another figure."""
    cases = [name.split("_")[1] for name in data if str(name).endswith("_force_N")]
    column = next(name for name in QUANTITIES if f"case_{cases[0]}_{name}" in data)
    what, label, unit = QUANTITIES[column]
    motion = column == "z_m"
    panels = [_panel(data, case, column, letter) for letter, case in zip(LETTERS, cases, strict=True)]
    fracture = number(1e3 * value(data, f"case_{cases[0]}_fracture_s"))
    scales = "heights much enlarged, one scale for all; dashed: the fixed end" if motion else SCALES
    scales += ", the same in figs. 3 and 6" if column == "tension_N" else ""
    ends = min(panel.y.min() for panel in panels), max(panel.y.max() for panel in panels)
    low, high = (number(float(end), 2) if motion else _thousands(float(end)) for end in ends)
    caption = (
        f"{what} (fracture in {fracture} ms), curves 10 ms apart, dark to bright; {scales}. Titles: the static force "
        f"{F_HS}. Seen: {low} to {high} {unit}. {behind(data)}"
    )
    alt = f"Four panels, {what}, fracture in {fracture} ms, a curve every 10 ms, from {low} to {high} {unit}."
    forces_N = [value(data, f"case_{case}_force_N") for case in cases]
    limits = _limits(panels, cases, forces_N if column == "tension_N" else None, motion)
    fill = partial(_fill, panels=panels, limits=limits, label=label, motion=motion)
    return Drawing(line_panels_height_in(len(panels)), fill, caption, alt)


def _panel(data: xarray.Dataset, case: str, column: str, letter: str) -> LinePanel:
    x = data[f"case_{case}_x_m" if column == "z_m" else f"case_{case}_s_m"].values
    title = f"({letter}) case {named(case)}: {_thousands(value(data, f'case_{case}_force_N'))} N"
    return LinePanel(title, x, data[f"case_{case}_{column}"].values, data[f"case_{case}_time_s"].values)


def _limits(panels: list[LinePanel], cases: list[str], forces_N: list[float] | None, motion: bool) -> list[tuple]:
    """(low, high) of each panel: one scale for all heights, else one for cases 1 and 2 and one for 3 and 4.

    Tensions are shown over the same share of the static one, because figs. 3 and 6 of the paper have identical scales.
    """
    if motion:
        low, high = min(float(p.y.min()) for p in panels), max(float(p.y.max()) for p in panels)
        return [(low - 0.06 * (high - low), high + 0.06 * (high - low))] * len(panels)
    limits = paired_limits(cases, panels)
    if forces_N is None:
        return limits
    most = [max(N for N, other in zip(forces_N, limits, strict=True) if other == own) for own in limits]
    low, high = TENSIONS
    return [(min(a, low * N), max(b, high * N)) for (a, b), N in zip(limits, most, strict=True)]


def _fill(figure, panels: list[LinePanel], limits: list[tuple], label: str, motion: bool) -> None:
    from matplotlib.ticker import FuncFormatter

    fill_line_panels(figure, panels, "$x$ (m)" if motion else "$s$ (m)", label, limits, centre=motion)
    if label.endswith("(N)"):
        for axes in figure.axes[: len(panels)]:
            axes.yaxis.set_major_formatter(FuncFormatter(lambda tick, _: _thousands(tick)))


def _thousands(newtons: float) -> str:
    """As the paper prints forces: 45 000."""
    return f"{np.round(newtons):,.0f}".replace(",", "\u202f").replace("-", "−")
