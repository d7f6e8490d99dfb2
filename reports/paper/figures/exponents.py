"""Figure 14: the running maximum Lyapunov exponent of both waves, by Wolf's method and from the tangent dynamics.

In the paper: fig. 14 Lyapunov exponents over time.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from ...figures.motion import settled
from ...parts.figure_data import sources_of
from ...parts.style import BLUE, SOFT, VERMILION
from ...parts.symbols import T_I
from ...parts.wording import decimals, number
from .drawing import Drawing, behind, value

if TYPE_CHECKING:
    import xarray

_STYLES = {"large": (VERMILION, "-"), "small": (BLUE, (0, (4, 1.5)))}  # solid and dashed as in the paper's key
_METHODS = {"wolf": ("Wolf", 1.2, 1.0), "tangent": ("tangent", 2.4, 0.4)}
_HEIGHT_IN = 3.3


def drawing(data: xarray.Dataset) -> Drawing:
    """The figure of a data file. Raises KeyError for one of another figure."""
    labels = dict(zip(_STYLES, (one.label for one in sources_of(data)), strict=True))
    ends = []
    for name, label in labels.items():
        found = [
            f"{decimals(value(data, f'{name}_{method}_value'), 3)} ± "
            f"{number(value(data, f'{name}_{method}_error'), 2)} ({words})"
            for method, (words, *_) in _METHODS.items()
        ]
        ends.append(f"{label}: {' and '.join(found)}")
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
    return Drawing(_HEIGHT_IN, partial(_fill, data=data, labels=labels), caption, alt)


def _fill(figure, data: xarray.Dataset, labels: dict[str, str]) -> None:
    longest = float(data["large_tangent_periods"].values[-1])
    first = value(data, "linear_periods")
    panels = figure.subplots(1, 2 if longest > 1.5 * first else 1, sharey=True, squeeze=False)[0]
    curves = []
    for name, label in labels.items():
        colour, dashes = _STYLES[name]
        for method, (words, width, strength) in _METHODS.items():
            x, bits = data[f"{name}_{method}_periods"].values, data[f"{name}_{method}_bits"].values
            curves.append(bits[x <= first])
            for axes in panels:
                shown = x <= first if axes is panels[0] else slice(None)
                axes.plot(
                    x[shown], bits[shown], color=colour, linestyle=dashes, linewidth=width, alpha=strength,
                    label=f"{label}, {words}",
                )  # fmt: skip
    for axes in panels:
        axes.axhline(0.0, color=SOFT, linewidth=0.7)
        axes.set_xlabel(r"$t/T_i$ (wave periods)")
    panels[0].set(ylim=settled(curves))
    panels[0].set_ylabel(r"$\sigma_m$ (bits per wave period)")
    panels[0].margins(x=0.01)
    if len(panels) > 1:
        panels[0].set_title(f"first {first:.0f} wave periods")
        panels[1].set_title("whole record, logarithmic")
        panels[1].set_xscale("log")
        panels[1].set_xlim(10.0, longest)
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=4)
