"""Figure 20: motion across the plane of the waves after a push, on a logarithmic axis, of the buoy and of the rope.

In the paper: fig. 20 motion across the plane of the waves.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from ...figures.offplane_history import History, fill_lateral_histories, lateral_height_in
from ...parts.figure_data import sources_of
from ...parts.wording import number
from .drawing import Drawing, behind, scaled, value

if TYPE_CHECKING:
    import xarray

WAVES, BODIES = ("small", "large"), ("buoy", "rope")


def drawing(data: xarray.Dataset) -> Drawing:
    """The figure of a data file. Raises KeyError for one of another figure."""
    labels = dict(zip(WAVES, (one.label.partition(" with")[0] for one in sources_of(data)), strict=True))
    bodies = {f"{name}_{body}_m": f"{body} at {label}" for name, label in labels.items() for body in BODIES}
    most = "; ".join(f"{words} within {number(float(data[name].max()), 2)} m" for name, words in bodies.items())
    push = number(value(data, "push_mps"))
    caption = (
        f"motion of the buoy across the plane of the waves after a push of {push} m/s, solid and dashed as in the "
        f"paper, and below, beyond the paper, of the rope (its farthest node). Thick: the largest value in each wave "
        f"period; thin: every sample; dotted: half the range of the buoy in the plane. Seen: {most}. {behind(data)}"
    )
    alt = f"Distance from the plane of the waves on a logarithmic axis over time: {most}."
    return Drawing(lateral_height_in(len(BODIES)), partial(_fill, data=data, labels=labels), caption, alt)


def _fill(figure, data: xarray.Dataset, labels: dict[str, str]) -> None:
    period_s, static_m = value(data, "wave_period_s"), value(data, "static_radius_m")
    panels = []
    for body, axis in zip(BODIES, ("buoy, $|y|$ (m)", "rope, largest $|y|$ (m)"), strict=True):
        runs = []
        for name, label in labels.items():
            arrays = (f"{body}_m", "periods", f"{body}_envelope_m")
            size, envelope_periods, envelope = (data[f"{name}_{what}"].values for what in arrays)
            periods, inplane_m = data[f"{name}_time_s"].values / period_s, value(data, f"{name}_inplane_m")
            runs.append(History(label, periods, size, envelope_periods, envelope, inplane_m))
        panels.append((axis, runs))
    for axes in fill_lateral_histories(figure, panels):
        axes.secondary_yaxis("right", functions=scaled(1.0 / static_m)).set_ylabel(r"$|y|/r_0$ (–)")
