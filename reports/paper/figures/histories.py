"""Figures 9-11, 13, 15 and 16: tension, radius and angle against time at the paper's two steepnesses.

In the paper: fig. 9 top tension, kA = 0.016; fig. 10 motion along r, kA = 0.016; fig. 11 motion along θ, kA = 0.016;
fig. 13 top tension, kA = 0.13; fig. 15 motion along r, kA = 0.13; fig. 16 motion along θ, kA = 0.13.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from ...figures.time_series import envelope
from ...parts.figure_data import sources_of
from ...parts.style import GREEN, INK, SKY, SOFT, VERMILION
from ...parts.symbols import L_0, T_I, T_S
from ...parts.wording import decimals, number, percent
from .drawing import Drawing, behind, scaled, value

if TYPE_CHECKING:
    import xarray

DETAIL_PERIODS = 10
NEAR_ZERO = 0.05  # of the static tension: what the paper calls near zero, in numbers
_HEIGHT_IN = 3.9


@dataclass(frozen=True)
class Side:
    """One of the three histories: its array, labels left and right, factor from left to right, levels to mark with
    their names in the key."""

    column: str
    label: str
    other: str
    factor: float
    levels: tuple[tuple[float, str], ...]
    band: tuple[str, str] = ()  # arrays of least and largest values between samples


def drawing(data: xarray.Dataset) -> Drawing:
    """The figure of a data file. Raises KeyError for one of another figure."""
    told = _tension if "tension_N" in data else _radial if "radius_m" in data else _angular
    side, what, seen = told(data)
    kA = sources_of(data)[0].label
    caption = (
        f"{what}, {kA}, against t/{T_I}; above up to the end of the window of eq. (31) (shaded), below the last "
        f"{DETAIL_PERIODS} wave periods of it. Seen: {seen}; {_swings(data, side)}. {behind(data)}"
    )
    alt = f"History over time: {what}, {kA}, {seen}."
    return Drawing(_HEIGHT_IN, partial(_fill, data=data, side=side), caption, alt)


def _tension(data: xarray.Dataset) -> tuple[Side, str, str]:
    static = value(data, "static_tension_N")
    low, high = data["tension_low_over_static"].values, data["tension_high_over_static"].values
    slack = float(np.mean(data["tension_over_static"].values < NEAR_ZERO))
    seen = f"from {decimals(low.min(), 2)} to {decimals(high.max(), 2)} {T_S}"
    seen += f", {percent(slack)} of the time below {NEAR_ZERO} {T_S}" if slack else f", never below {NEAR_ZERO} {T_S}"
    side = Side(
        "tension_over_static",
        r"$T/T_s$ (–)",
        r"$T$ (kN)",
        1e-3 * static,
        ((1.0, "static"), (0.0, "no tension")),
        ("tension_low_over_static", "tension_high_over_static"),
    )
    return side, f"tension at the top end over the static one ({T_S} = {number(static)} N)", seen


def _radial(data: xarray.Dataset) -> tuple[Side, str, str]:
    static, length = value(data, "static_radius_m"), value(data, "unstretched_m")
    ratio = data["radius_over_static"].values
    swing = (static * ratio - static) / (static - length)
    levels = ((1.0, r"static, $r_0$"), (length / static, r"unstretched, $l_0$"))
    seen = (
        f"from {decimals(ratio.min(), 3)} to {decimals(ratio.max(), 3)}; Δr from {decimals(swing.min(), 2)} to "
        f"{decimals(swing.max(), 2)} times the static stretch Δl, slack below −1"
    )
    what = f"radius over the static one (r₀ = {L_0} + Δl = {decimals(static, 3)} m)"
    return Side("radius_over_static", r"$r/r_0$ (–)", r"$r$ (m)", static, levels), what, seen


def _angular(data: xarray.Dataset) -> tuple[Side, str, str]:
    angle = data["angle_rad"].values
    seen = f"from {decimals(angle.min(), 3)} to {decimals(angle.max(), 3)} rad"
    side = Side("angle_rad", r"$\theta$ (rad)", r"$\theta$ (°)", 180.0 / np.pi, ((0.0, "static"),))
    return side, "angle from the vertical (static value 0, hence in rad)", seen


def _swings(data: xarray.Dataset, side: Side) -> str:
    """From least to largest in the first and in the last periods: whether a transient dies out."""
    periods, values = data["time_s"].values / value(data, "wave_period_s"), data[side.column].values
    first, last = periods <= DETAIL_PERIODS, periods >= periods[-1] - DETAIL_PERIODS
    return (
        f"a span of {number(float(np.ptp(values[first])), 3)} in the first {DETAIL_PERIODS} wave periods, of "
        f"{number(float(np.ptp(values[last])), 3)} in the last"
    )


def _fill(figure, data: xarray.Dataset, side: Side) -> None:
    periods = data["time_s"].values / value(data, "wave_period_s")
    start, length = value(data, "window_start_periods"), value(data, "window_periods")
    whole, detail = figure.subplots(2, 1, gridspec_kw={"height_ratios": [1.25, 1.0]})
    shade = whole.axvspan(start, min(start + length, periods[-1]), color=SOFT, alpha=0.15, linewidth=0)
    handles = {"window of eq. (31)": shade}
    for axes in (whole, detail):
        shown = slice(None) if axes is whole else periods >= periods[-1] - DETAIL_PERIODS
        if side.band:
            low, high = (data[name].values[shown] for name in side.band)
            x, low = envelope(periods[shown], low)
            _, high = envelope(periods[shown], high)
            axes.fill_between(x, np.minimum(low, high), np.maximum(low, high), color=SKY, alpha=0.5, linewidth=0)
        axes.plot(*envelope(periods[shown], data[side.column].values[shown]), color=INK, linewidth=0.8)
        axes.set_ylabel(side.label)
        axes.set_xlim(periods[shown][0], periods[shown][-1])
        right = axes.secondary_yaxis("right", functions=scaled(side.factor))
        right.set_ylabel(side.other)
        handles |= _levels(axes, side)
    seconds = whole.secondary_xaxis("top", functions=scaled(value(data, "wave_period_s")))
    seconds.set_xlabel(r"$t$ (s)")
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
