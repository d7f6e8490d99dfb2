"""Figures 9-13 and 15-18: the buoy at the paper's two steepnesses, histories and spectra.

Histories are of tension, radius and angle against time; spectra are by eq. (31), natural frequencies marked by arrows.

In the paper: fig. 9 top tension, kA = 0.016; fig. 10 motion along r, kA = 0.016; fig. 11 motion along θ, kA = 0.016;
fig. 12 spectra, kA = 0.016; fig. 13 top tension, kA = 0.13; fig. 15 motion along r, kA = 0.13; fig. 16 motion along θ,
kA = 0.13; fig. 17 spectrum of r, kA = 0.13; fig. 18 spectrum of θ, kA = 0.13.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import xarray

from tables import decimals, listed, number, sub

from ...figures.curves import Curve, Panel, curves, envelope
from ...parts import L_0, OMEGA_I, T_I, T_S, TAU_0, Figure
from ...parts.style import BLUE, GREEN, INK, VERMILION
from .drawing import DASHED, behind, sources_of, spans, value

DETAIL_PERIODS = 10
ALONG = r"$t/T_i$ (wave periods)"
MOTIONS = {  # motion -> its label on the axis, name in the text, colour and line as in the paper's key
    "radial": (r"$|\Delta\tilde r|/r_0$ (–)", "r/r₀", BLUE, "-"),
    "angular": (r"$|\Delta\tilde\theta|$ (rad)", "θ", VERMILION, DASHED),
}
MARKED = {
    "wave_radps": r"$\omega_i$",
    "natural_radial_radps": r"$\omega_{nr}$",
    "natural_angular_radps": r"$\omega_{n\theta}$",
}
OMEGA_NR, OMEGA_NTHETA = "ω" + sub("nr"), "ω" + sub("nθ")  # as section 4.2.1 writes them
SPECTRUM_TO = 2.5  # wave frequencies


class Side(NamedTuple):
    """One of the three histories: what it is, its array, labels left and right, factor from left to right, levels to
    mark with their names in the key; band: arrays of least and largest values between samples."""

    description: str
    column: str
    label: str
    other: str
    factor: float
    levels: tuple[tuple[float, str], ...]
    band: tuple[str, str] = ()


def history(data: xarray.Dataset, kind: str) -> Figure:
    """The figure of a data file. Raises KeyError for one of another figure."""
    side = _side(data)
    kA, seen = sources_of(data)[0].label, spans(data, {side.column: side.description}, 3)
    caption = (
        f"{seen}, {kA}, against t/{T_I}; above up to the end of the window of eq. (31), its start marked, below the "
        f"last {DETAIL_PERIODS} wave periods of it. {behind(data)}"
    )
    picture = curves(_histories(data, side), 3.9, "below", kind=kind)
    return Figure(picture, caption, f"History over time, {kA}: {seen}.")


def _side(data: xarray.Dataset) -> Side:
    if "tension_N" in data:
        static = value(data, "static_tension_N")
        label = f"tension at the top end over the static one ({T_S} = {number(static)} N)"
        levels, band = ((1.0, "static"), (0.0, "no tension")), ("tension_low_over_static", "tension_high_over_static")
        return Side(label, "tension_over_static", r"$T/T_s$ (–)", r"$T$ (kN)", 1e-3 * static, levels, band)
    if "radius_m" in data:
        static, length = value(data, "static_radius_m"), value(data, "unstretched_m")
        label = f"radius over the static one (r₀ = {L_0} + Δl = {decimals(static, 3)} m)"
        levels = ((1.0, r"static, $r_0$"), (length / static, r"unstretched, $l_0$"))
        return Side(label, "radius_over_static", r"$r/r_0$ (–)", r"$r$ (m)", static, levels)
    label = "angle from the vertical in rad (static value 0)"
    return Side(label, "angle_rad", r"$\theta$ (rad)", r"$\theta$ (°)", 180.0 / np.pi, ((0.0, "static"),))


def _histories(data: xarray.Dataset, side: Side) -> list[list[Panel]]:
    periods, period_s = data["time_s"].values / value(data, "wave_period_s"), value(data, "wave_period_s")
    starts = [(value(data, "window_start_periods"), "")]
    drawn = (slice(None), "", {"top": (period_s, r"$t$ (s)")}), (periods >= periods[-1] - DETAIL_PERIODS, ALONG, {})
    rows = []
    for shown, x_label, top in drawn:
        x, y, band = periods[shown], data[side.column].values[shown], None
        if side.band:
            low_name, high_name = side.band
            band_x, low = envelope(x, data[low_name].values[shown])
            _, high = envelope(x, data[high_name].values[shown])
            band = band_x, np.minimum(low, high), np.maximum(low, high)
        lines = [Curve(*envelope(x, y), colour=INK, width=0.8, band=band)]
        room = 0.05 * np.ptp(y)
        for (level, name), look in zip(side.levels, ((VERMILION, "--"), (GREEN, "-.")), strict=False):
            if y.min() - room <= level <= y.max() + room:
                lines.append(Curve(x[[0, -1]], np.full(2, level), name, look[1], colour=look[0]))
        right_axis = {"right": (side.factor, side.other), **top}
        marks = [] if rows else starts
        rows.append([Panel(lines, x_label, side.label, marks=marks, xlim=(x[0], x[-1]), beside=right_axis)])
    return rows


def spectra(data: xarray.Dataset, kind: str) -> Figure:
    """The figure of a data file. Raises KeyError for one of another figure."""
    sides = [side for side in MOTIONS if f"{side}_amplitude" in data]
    wave = value(data, "wave_radps")
    seen = []
    for side in sides:
        peaks, words = f"{side}_peaks_radps", "no peak"
        if peaks in data and len(data[peaks]):
            words = f"peaks at {listed(number(peak, 3) for peak in data[peaks].values[:4])} rad/s"
        seen.append(f"{MOTIONS[side][1]} has {words}")
    kA = sources_of(data)[0].label
    bins = wave / value(data, "periods")
    motions = " (solid) and ".join(sides)
    if len(sides) > 1:
        motions += " (dashed)"
    caption = (
        f"spectrum of the buoy's {motions} motion, {kA}, by eq. (31) with "
        f"{TAU_0} = {number(value(data, 'start_periods'))} {T_I} and n = "
        f"{number(value(data, 'periods'))}; left linear as in the paper, right logarithmic. Arrows: the natural "
        f"frequencies {OMEGA_NR} = {number(value(data, 'natural_radial_radps'), 3)} and {OMEGA_NTHETA} = "
        f"{number(value(data, 'natural_angular_radps'), 3)} rad/s from the buoy's equation of motion and the waves' "
        f"{OMEGA_I} = {number(wave, 3)} rad/s. Seen (largest first; bins of {number(bins, 2)} rad/s): "
        f"{'; '.join(seen)}. {behind(data)}"
    )
    alt = f"Spectrum, linear and logarithmic, {kA}: {'; '.join(seen)}."
    lines = []
    for side in sides:
        label, _, colour, dashes = MOTIONS[side]
        look = {"line": dashes, "name": label} if len(sides) > 1 else {}
        lines.append(Curve(data["omega_radps"].values, data[f"{side}_amplitude"].values, colour=colour, **look))
    labels = r"$\omega$ (rad/s)", " and ".join(MOTIONS[side][0] for side in sides)
    marks = [(value(data, frequency), name) for frequency, name in MARKED.items()]
    panels = spectrum_panels(lines, SPECTRUM_TO * wave, labels, marks)
    return Figure(curves([panels], 2.9, "below", kind=kind), caption, alt)


def spectrum_panels(
    lines: Sequence[Curve], highest_radps: float, labels: tuple[str, str], marks: Sequence[tuple[float, str]]
) -> list[Panel]:
    """Amplitudes over omega up to highest_radps, linear with named marks, and logarithmic; labels: of x and y."""
    shown = lines[0].x <= highest_radps
    lines = [line._replace(x=line.x[shown], y=line.y[shown]) for line in lines]
    everything = np.concatenate([line.y for line in lines])
    xlim, top = (0.0, highest_radps), 1.32 * max(float(everything.max()), 1e-12)
    nameless = [(at, "") for at, _ in marks]
    linear = Panel(lines, *labels, marks=marks, xlim=xlim, ylim=(0.0, top))
    return [linear, Panel(lines, labels[0], log="y", marks=nameless, xlim=xlim, ylim=log_limits(everything))]


def log_limits(amplitude: np.ndarray) -> tuple[float | None, float | None]:
    """Four decades at most below the peak; a spectrum of zeros keeps matplotlib's own limits."""
    peak = float(amplitude.max())
    if peak <= 0:
        return None, None
    least = float(amplitude[amplitude > 0].min())
    return max(peak * 1e-4, least * 0.5), peak * 3
