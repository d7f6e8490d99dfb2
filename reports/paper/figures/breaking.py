"""Figures 2-7: the breaking line every 10 ms - motion, tension and velocity, one panel a case, in the paper's units."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from ...breaking_line.runs import named
from ...figures.line_panels import LinePanel, fill_line_panels, line_panels_height_in, paired_limits
from ...parts.content import sub
from ...parts.wording import decimals, number
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


def drawing(data: xarray.Dataset) -> Drawing:
    """The figure of a data file. Raises KeyError for one of another figure."""
    cases = [name.split("_")[1] for name in data if str(name).endswith("_force_N")]
    column = next(name for name in QUANTITIES if f"case_{cases[0]}_{name}" in data)
    what, label, unit = QUANTITIES[column]
    panels, words = [], []
    for letter, case in zip(LETTERS, cases, strict=True):
        panel = _panel(data, case, column, letter)
        panels.append(panel)
        if column == "z_m":
            recoil = float(panel.x[0, -1] - panel.x[-1, -1])
            least = float(panel.x.min())
            words.append(f"({letter}) the end recoils {decimals(recoil, 1)} m, least x {decimals(least, 2)} m")
        else:
            low, high = (_thousands(float(end)) for end in (panel.y.min(), panel.y.max()))
            words.append(f"({letter}) {low} to {high} {unit}")
    forces = ", ".join(
        f"({letter}) case {named(case)}, {_thousands(value(data, f'case_{case}_force_N'))} N"
        for letter, case in zip(LETTERS, cases, strict=True)
    )
    fracture = number(1e3 * value(data, f"case_{cases[0]}_fracture_s"))
    scales = (
        "heights much enlarged, one scale for all; dashed: the fixed end"
        if column == "z_m"
        else "over the unstretched length s from the fixed end; cases 1 and 2, and 3 and 4, share a scale"
    )
    caption = (
        f"{what} (fracture in {fracture} ms), curves 10 ms apart, dark to bright; {scales}. {F_HS}: "
        f"{forces}. Seen: {'; '.join(words)}. {behind(data)}"
    )
    alt = f"Four panels, {what}, fracture in {fracture} ms, a curve every 10 ms: {'; '.join(words)}."
    fill = partial(_fill, panels=panels, cases=cases, label=label, motion=column == "z_m")
    return Drawing(line_panels_height_in(len(panels)), fill, caption, alt)


def _panel(data: xarray.Dataset, case: str, column: str, letter: str) -> LinePanel:
    x = data[f"case_{case}_x_m" if column == "z_m" else f"case_{case}_s_m"].values
    title = f"({letter}) case {named(case)}: {_thousands(value(data, f'case_{case}_force_N'))} N"
    return LinePanel(title, x, data[f"case_{case}_{column}"].values, data[f"case_{case}_time_s"].values)


def _fill(figure, panels: list[LinePanel], cases: list[str], label: str, motion: bool) -> None:
    from matplotlib.ticker import FuncFormatter

    if motion:
        low, high = min(float(p.y.min()) for p in panels), max(float(p.y.max()) for p in panels)
        limits = [(low - 0.06 * (high - low), high + 0.06 * (high - low))] * len(panels)
    else:
        limits = paired_limits(cases, panels)
    fill_line_panels(figure, panels, "$x$ (m)" if motion else "$s$ (m)", label, limits, centre=motion)
    if label.endswith("(N)"):
        for axes in figure.axes[: len(panels)]:
            axes.yaxis.set_major_formatter(FuncFormatter(lambda tick, _: _thousands(tick)))


def _thousands(newtons: float) -> str:
    """As the paper prints forces: 45 000."""
    return f"{np.round(newtons):,.0f}".replace(",", "\u202f").replace("-", "−")
