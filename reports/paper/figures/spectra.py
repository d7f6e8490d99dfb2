"""Figures 12, 17 and 18: spectra of the buoy's motion by eq. (31), natural frequencies marked by arrows.

In the paper: fig. 12 spectra, kA = 0.016; fig. 17 spectrum of r, kA = 0.13; fig. 18 spectrum of θ, kA = 0.13.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from ...figures.curves import mark
from ...figures.motion import log_limits
from ...parts.content import sub
from ...parts.figure_data import sources_of
from ...parts.style import BLUE, VERMILION
from ...parts.wording import OMEGA_I, T_I, TAU_0, listed, number
from .drawing import Drawing, behind, value

if TYPE_CHECKING:
    import xarray

SIDES = {  # motion -> its label on the axis, name in the text, line as in the paper's key, frequency
    "radial": (r"$|\Delta\tilde r|/r_0$ (–)", "r/r₀", BLUE, "-", ("natural_radial_radps", r"$\omega_{nr}$")),
    "angular": (
        r"$|\Delta\tilde\theta|$ (rad)",
        "θ",
        VERMILION,
        (0, (4, 1.5)),
        ("natural_angular_radps", r"$\omega_{n\theta}$"),
    ),
}
OMEGA_NR, OMEGA_NTHETA = "ω" + sub("nr"), "ω" + sub("nθ")  # as section 4.2.1 writes them
_SHOWN = 2.5  # wave frequencies
_HEIGHT_IN = 2.9


def drawing(data: xarray.Dataset) -> Drawing:
    """The figure of a data file. Raises KeyError for one of another figure."""
    sides = [side for side in SIDES if f"{side}_amplitude" in data]
    wave = value(data, "wave_radps")
    seen = []
    for side in sides:
        peaks = data[f"{side}_peaks_radps"].values[:4] if f"{side}_peaks_radps" in data else ()
        words = f"peaks at {listed(number(peak, 3) for peak in peaks)} rad/s" if len(peaks) else "no peak"
        seen.append(f"{SIDES[side][1]} has {words}")
    kA = sources_of(data)[0].label
    bins = wave / value(data, "periods")
    caption = (
        f"spectrum of the buoy's {' (solid) and '.join(sides)}{' (dashed)' if len(sides) > 1 else ''} motion, {kA}, by "
        f"eq. (31) with {TAU_0} = {number(value(data, 'start_periods'))} {T_I} and n = "
        f"{number(value(data, 'periods'))}; left linear as in the paper, right logarithmic. Arrows: the natural "
        f"frequencies {OMEGA_NR} = {number(value(data, 'natural_radial_radps'), 3)} and {OMEGA_NTHETA} = "
        f"{number(value(data, 'natural_angular_radps'), 3)} rad/s from the buoy's equation of motion and the waves' "
        f"{OMEGA_I} = {number(wave, 3)} rad/s. Seen (largest first; bins of {number(bins, 2)} rad/s): "
        f"{'; '.join(seen)}. {behind(data)}"
    )
    alt = f"Spectrum, linear and logarithmic, {kA}: {'; '.join(seen)}."
    return Drawing(_HEIGHT_IN, partial(_fill, data=data, sides=sides), caption, alt)


def _fill(figure, data: xarray.Dataset, sides: list[str]) -> None:
    omega, highest = data["omega_radps"].values, _SHOWN * value(data, "wave_radps")
    shown = omega <= highest
    found = {side: data[f"{side}_amplitude"].values[shown] for side in sides}
    marks = [(value(data, "wave_radps"), r"$\omega_i$")]
    marks += [(value(data, frequency), name) for *_, (frequency, name) in SIDES.values()]
    linear, logarithmic = figure.subplots(1, 2)
    for axes, title in ((linear, "linear"), (logarithmic, "logarithmic")):
        for side, amplitude in found.items():
            label, _, colour, dashes, _ = SIDES[side]
            axes.plot(omega[shown], amplitude, color=colour, linestyle=dashes if len(sides) > 1 else "-", label=label)
        y_label = " and ".join(SIDES[side][0] for side in sides)
        axes.set(title=title, xlabel=r"$\omega$ (rad/s)", xlim=(0.0, highest), ylabel=y_label)
    everything = np.concatenate([*found.values()])
    linear.set_ylim(0.0, 1.3 * float(everything.max()))
    mark(linear, marks)
    logarithmic.set_yscale("log")
    logarithmic.set(ylim=log_limits(everything))
    mark(logarithmic, [(frequency, "") for frequency, _ in marks])
    if len(sides) > 1:
        logarithmic.legend(loc="upper right")
