"""Figures 9-11, 13, 15 and 16: tension, radius and angle against time at the paper's two steepnesses.

In the paper: fig. 9 top tension, kA = 0.016; fig. 10 motion along r, kA = 0.016; fig. 11 motion along θ, kA = 0.016;
fig. 13 top tension, kA = 0.13; fig. 15 motion along r, kA = 0.13; fig. 16 motion along θ, kA = 0.13.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from ...figures.curves import Curve, Panel, draw
from ...figures.motion import envelope
from ...parts.figure_data import sources_of
from ...parts.style import GREEN, INK, SOFT, VERMILION
from ...parts.wording import L_0, T_I, T_S, decimals, number
from .drawing import Drawing, behind, scaled, spans, value

if TYPE_CHECKING:
    import xarray

DETAIL_PERIODS = 10
_HEIGHT_IN = 3.9


@dataclass(frozen=True)
class Side:
    """One of the three histories: what it is, its array, labels left and right, factor from left to right, levels to
    mark with their names in the key; band: arrays of least and largest values between samples."""

    what: str
    column: str
    label: str
    other: str
    factor: float
    levels: tuple[tuple[float, str], ...]
    band: tuple[str, str] = ()


def drawing(data: xarray.Dataset) -> Drawing:
    """The figure of a data file. Raises KeyError for one of another figure."""
    side = _side(data)
    kA, seen = sources_of(data)[0].label, spans(data, {side.column: side.what}, 3)
    caption = (
        f"{seen}, {kA}, against t/{T_I}; above up to the end of the window of eq. (31) (shaded), below the last "
        f"{DETAIL_PERIODS} wave periods of it. {behind(data)}"
    )
    return Drawing(_HEIGHT_IN, partial(_fill, data=data, side=side), caption, f"History over time, {kA}: {seen}.")


def _side(data: xarray.Dataset) -> Side:
    if "tension_N" in data:
        static = value(data, "static_tension_N")
        what = f"tension at the top end over the static one ({T_S} = {number(static)} N)"
        levels, band = ((1.0, "static"), (0.0, "no tension")), ("tension_low_over_static", "tension_high_over_static")
        return Side(what, "tension_over_static", r"$T/T_s$ (–)", r"$T$ (kN)", 1e-3 * static, levels, band)
    if "radius_m" in data:
        static, length = value(data, "static_radius_m"), value(data, "unstretched_m")
        what = f"radius over the static one (r₀ = {L_0} + Δl = {decimals(static, 3)} m)"
        levels = ((1.0, r"static, $r_0$"), (length / static, r"unstretched, $l_0$"))
        return Side(what, "radius_over_static", r"$r/r_0$ (–)", r"$r$ (m)", static, levels)
    what = "angle from the vertical in rad (static value 0)"
    return Side(what, "angle_rad", r"$\theta$ (rad)", r"$\theta$ (°)", 180.0 / np.pi, ((0.0, "static"),))


def _fill(figure, data: xarray.Dataset, side: Side) -> None:
    periods = data["time_s"].values / value(data, "wave_period_s")
    start, length = value(data, "window_start_periods"), value(data, "window_periods")
    whole, detail = figure.subplots(2, 1, gridspec_kw={"height_ratios": [1.25, 1.0]})
    shade = whole.axvspan(start, min(start + length, periods[-1]), color=SOFT, alpha=0.15, linewidth=0)
    handles = {"window of eq. (31)": shade}
    for axes, shown in ((whole, slice(None)), (detail, periods >= periods[-1] - DETAIL_PERIODS)):
        x, band = periods[shown], None
        if side.band:
            (at, low), (_, high) = (envelope(x, data[name].values[shown]) for name in side.band)
            band = at, np.minimum(low, high), np.maximum(low, high)
        curve = Curve(*envelope(x, data[side.column].values[shown]), colour=INK, width=0.8, band=band)
        draw(axes, Panel([curve], y_label=side.label, settings={"xlim": (x[0], x[-1])}))
        axes.secondary_yaxis("right", functions=scaled(side.factor)).set_ylabel(side.other)
        handles |= _levels(axes, side)
    whole.secondary_xaxis("top", functions=scaled(value(data, "wave_period_s"))).set_xlabel(r"$t$ (s)")
    detail.set_xlabel(r"$t/T_i$ (wave periods)")
    figure.align_ylabels((whole, detail))
    figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=len(handles))


def _levels(axes, side: Side) -> dict[str, object]:
    """The static value and other levels that are within sight, by name for the key."""
    low, high = axes.get_ylim()
    return {
        name: axes.axhline(level, color=colour, linewidth=0.9, linestyle=dashes, zorder=1.5)
        for (level, name), colour, dashes in zip(side.levels, (VERMILION, GREEN), ("--", "-."), strict=False)
        if low <= level <= high
    }
