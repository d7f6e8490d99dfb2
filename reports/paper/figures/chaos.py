"""Figures 14, 19 and 20: running Lyapunov exponents, Poincare sections, motion across the plane of the waves.

Figure 14: the largest exponent of both waves, by Wolf's method and from the tangent dynamics. Figure 19: sections of
(a) the exact model and (b) eq. (33), in the units of eq. (33). Figure 20: after a push across the plane, on a
logarithmic axis, of the buoy and of the rope.

In the paper: fig. 14 Lyapunov exponents over time; fig. 19 sections: buoy (a), eq. (33) (b); fig. 20 motion across the
plane of the waves.
"""

from collections.abc import Sequence

import numpy as np
import xarray

from tables import decimals, number

from ...figures.curves import Curve, Panel, curves, dots
from ...figures.offplane_history import History, lateral_histories
from ...parts import L_0, T_I, Figure
from ...parts.style import BLUE, INK, VERMILION
from .drawing import DASHED, behind, sources_of, spans, value

_STYLES = {"large": (VERMILION, "-"), "small": (BLUE, DASHED)}  # solid and dashed as in the paper's key
_METHODS = {"wolf": ("Wolf", 1.2, 1.0), "tangent": ("tangent", 2.4, 0.4)}
PANELS = {  # motion -> title, labels of the axes
    "exact": ("(a) exact model", r"$(r - l_0)/D$ (–)", r"$\dot r/(D\,\omega_{nr})$ (–)"),
    "reduced": ("(b) eq. (33)", r"$\gamma$ (–)", r"$\dot\gamma$ (–)"),
}
_FEW = 1000  # points up to which each is drawn as a dot
WAVES, BODIES = ("small", "large"), ("buoy", "rope")


def running_exponents(data: xarray.Dataset, kind: str) -> Figure:
    """The figure of a data file. Raises KeyError for one of another figure."""
    labels = dict(zip(_STYLES, (source.label for source in sources_of(data)), strict=True))
    ends = []
    for name, label in labels.items():
        exponents = []
        for method, (words, *_) in _METHODS.items():
            exponent, error = value(data, f"{name}_{method}_value"), value(data, f"{name}_{method}_error")
            exponents.append(f"{decimals(exponent, 3)} ± {number(error, 2)} ({words})")
        ends.append(f"{label}: {' and '.join(exponents)}")
    length = float(data["large_tangent_periods"].values[-1])
    caption = (
        f"maximum Lyapunov exponent of eq. (32), in bits per wave period, against the length of the record of r(t), "
        f"after {number(value(data, 'transient_periods'))} wave periods; {labels['large']} solid, {labels['small']} "
        f"dashed. Thin: the method of Wolf et al. on the record; thick and pale: mean growth of an infinitesimal "
        f"perturbation of the same run. Values and standard errors from the whole record ({number(length)} {T_I}): "
        f"{'; '.join(ends)} bits per wave period. Nothing decays any more in a record that has settled: Wolf's value "
        f"then tends to 0, the tangent's does not. {behind(data)}"
    )
    alt = f"Running exponents over the length of the record: {'; '.join(ends)} bits per wave period."
    return Figure(curves([_running(data, labels)], 3.3, "below", "y", kind), caption, alt)


def _running(data: xarray.Dataset, labels: dict[str, str]) -> list[Panel]:
    longest, first = float(data["large_tangent_periods"].values[-1]), value(data, "linear_periods")
    full_curves = []
    for name, label in labels.items():
        colour, dashes = _STYLES[name]
        for method, (words, width, strength) in _METHODS.items():
            x, bits = data[f"{name}_{method}_periods"].values, data[f"{name}_{method}_bits"].values
            look = {"line": dashes, "colour": colour, "width": width, "alpha": strength}
            full_curves.append(Curve(x, bits, f"{label}, {words}", **look))
    early = []
    for curve in full_curves:
        begin = curve.x <= first
        early.append(curve._replace(x=curve.x[begin], y=curve.y[begin]))
    limits = settled([curve.y for curve in early])
    x_label, sigma = r"$t/T_i$ (wave periods)", r"$\sigma_m$ (bits per wave period)"
    panels = [Panel(early, x_label, sigma, level=0.0, settings={"xmargin": 0.01}, ylim=limits)]
    if longest > 1.5 * first:
        later = Panel(full_curves, x_label, "", "whole record, logarithmic", "x", 0.0, xlim=(10.0, longest))
        panels = [panels[0]._replace(title=f"first {first:.0f} wave periods"), later]
    return panels


def sections(data: xarray.Dataset, kind: str) -> Figure:
    """The figure of a data file. Raises KeyError for one of another figure."""
    force, lift, damping, frequency = (number(value(data, key)) for key in ("force", "lift", "damping", "frequency"))
    waves = sources_of(data)[0].label
    names = {"exact_displacement": "γ", "exact_velocity": "γ′"}
    reduced = {name.replace("exact", "reduced"): words for name, words in names.items()}
    seen = f"in (a) {spans(data, names)}; in (b) {spans(data, reduced)}"
    caption = (
        f"Poincaré sections, one point a forcing period: (a) the exact model at {waves}, (b) eq. (33) with F = "
        f"{force}, B − W = {lift}, μ = {damping} and ω = {frequency}. Both in the units of eq. (33): γ = (r − {L_0})/D "
        f"with the buoy's diameter D = {number(value(data, 'diameter_m'))} m, γ′ = r′/(D ω) with the natural frequency "
        f"{number(value(data, 'natural_radial_radps'), 3)} rad/s; slack left of 0. Seen: {seen}. {behind(data)}"
    )
    panels = []
    for name, (title, *axes) in PANELS.items():
        x, y = data[f"{name}_displacement"].values, data[f"{name}_velocity"].values
        strobed = dots(x, y, ".", INK, _size_of_dots(len(x)), pixels=True)
        panels.append(Panel([strobed], *axes, title, marks=[(0.0, "")]))
    return Figure(curves([panels], 3.6, kind=kind), caption, f"Two scatter plots of strobed motion: {seen}.")


def settled(series: Sequence[np.ndarray]) -> tuple[float, float]:
    """Limits that show 0 and what the curves (m,) do after their first tenth, in which they jump about."""
    late = np.concatenate([bits[len(bits) // 10 :] for bits in series] + [np.zeros(1)])
    margin = 0.15 * max(float(np.ptp(late)), 0.02)
    return float(late.min()) - margin, float(late.max()) + margin


def _size_of_dots(points: int) -> float:
    if points <= _FEW:
        return 3.5
    if points <= 20 * _FEW:
        return 1.4
    return 0.35


def offplane_histories(data: xarray.Dataset, kind: str) -> Figure:
    """The figure of a data file. Raises KeyError for one of another figure."""
    labels = dict(zip(WAVES, (source.label.partition(" with")[0] for source in sources_of(data)), strict=True))
    distances = []
    for name, label in labels.items():
        for body in BODIES:
            largest_m = number(float(data[f"{name}_{body}_m"].max()), 2)
            distances.append(f"{body} at {label} within {largest_m} m")
    largest = "; ".join(distances)
    push = number(value(data, "push_mps"))
    caption = (
        f"motion of the buoy across the plane of the waves after a push of {push} m/s, solid and dashed as in the "
        f"paper, and below, beyond the paper, of the rope (its farthest node). Thick: the largest value in each wave "
        f"period; thin: every sample; dotted: half the range of the buoy in the plane. Seen: {largest}. {behind(data)}"
    )
    alt = f"Distance from the plane of the waves on a logarithmic axis over time: {largest}."
    period_s, static_m = value(data, "wave_period_s"), value(data, "static_radius_m")
    panels = []
    for body, axis in zip(BODIES, ("buoy, $|y|$ (m)", "rope, largest $|y|$ (m)"), strict=True):
        runs = []
        for name, label in labels.items():
            arrays = (f"{body}_m", "periods", f"{body}_envelope_m")
            size, envelope_periods, envelope = (data[f"{name}_{array_name}"].values for array_name in arrays)
            periods, inplane_m = data[f"{name}_time_s"].values / period_s, value(data, f"{name}_inplane_m")
            runs.append(History(label, periods, size, envelope_periods, envelope, inplane_m))
        panels.append((axis, runs))
    right_axis = {"right": (1.0 / static_m, r"$|y|/r_0$ (–)")}
    return Figure(lateral_histories(panels, kind, beside=right_axis), caption, alt)
