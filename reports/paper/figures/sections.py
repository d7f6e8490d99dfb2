"""Figure 19: Poincare sections of (a) the exact model and (b) eq. (33), in the units of eq. (33).

In the paper: fig. 19 sections: buoy (a), eq. (33) (b).
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from ...parts.figure_data import sources_of
from ...parts.style import INK, SOFT
from ...parts.wording import L_0, number
from .drawing import Drawing, behind, spans, value

if TYPE_CHECKING:
    import xarray

PANELS = {  # motion -> title, labels of the axes
    "exact": ("(a) exact model", r"$(r - l_0)/D$ (–)", r"$\dot r/(D\,\omega_{nr})$ (–)"),
    "reduced": ("(b) eq. (33)", r"$\gamma$ (–)", r"$\dot\gamma$ (–)"),
}
_HEIGHT_IN = 3.6
_FEW = 1000  # points up to which each is drawn as a dot


def drawing(data: xarray.Dataset) -> Drawing:
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
    return Drawing(_HEIGHT_IN, partial(_fill, data=data), caption, f"Two scatter plots of strobed motion: {seen}.")


def _fill(figure, data: xarray.Dataset) -> None:
    for axes, (name, (title, x_label, y_label)) in zip(figure.subplots(1, 2), PANELS.items(), strict=True):
        x, y = data[f"{name}_displacement"].values, data[f"{name}_velocity"].values
        size = 3.5 if len(x) <= _FEW else 1.4 if len(x) <= 20 * _FEW else 0.35
        # as pixels also in the SVG: a hundred thousand marks would make it unusable
        axes.plot(x, y, ".", color=INK, markersize=size, markeredgewidth=0, rasterized=True)
        axes.axvline(0.0, color=SOFT, linewidth=0.8, linestyle=(0, (2, 2)))
        axes.grid(False)
        axes.set(title=title, xlabel=x_label, ylabel=y_label)
