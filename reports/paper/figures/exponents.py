"""Figure 14: the running maximum Lyapunov exponent of both waves, by Wolf's method and from the tangent dynamics.

In the paper: fig. 14 Lyapunov exponents over time.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from ...figures.curves import Curve, Panel, draw
from ...figures.motion import settled
from ...parts.figure_data import sources_of
from ...parts.style import BLUE, VERMILION
from ...parts.wording import T_I, decimals, number
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
    longest, first = float(data["large_tangent_periods"].values[-1]), value(data, "linear_periods")
    whole = []
    for name, label in labels.items():
        colour, dashes = _STYLES[name]
        for method, (words, width, strength) in _METHODS.items():
            x, bits = (data[f"{name}_{method}_{what}"].values for what in ("periods", "bits"))
            look = {"line": dashes, "colour": colour, "width": width, "alpha": strength}
            whole.append(Curve(x, bits, f"{label}, {words}", **look))
    early = [replace(one, x=one.x[one.x <= first], y=one.y[one.x <= first]) for one in whole]
    limits = {"ylim": settled([one.y for one in early]), "xmargin": 0.01}
    along, sigma = r"$t/T_i$ (wave periods)", r"$\sigma_m$ (bits per wave period)"
    panels = [Panel(early, along, sigma, level=0.0, settings=limits)]
    if longest > 1.5 * first:
        later = Panel(whole, along, "", "whole record, logarithmic", "x", 0.0, {"xlim": (10.0, longest)})
        panels = [replace(panels[0], title=f"first {first:.0f} wave periods"), later]
    grid = figure.subplots(1, len(panels), sharey=True, squeeze=False)[0]
    for axes, panel in zip(grid, panels, strict=True):
        draw(axes, panel)
    figure.legend(*grid[0].get_legend_handles_labels(), loc="outside upper center", ncols=4)
