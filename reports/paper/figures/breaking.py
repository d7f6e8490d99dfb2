"""Figures 2-7: the breaking line every 10 ms - motion, tension and velocity, one panel a case, in the paper's units.

In the paper: fig. 2 motion of the breaking line, 5 ms; fig. 3 tension along the breaking line, 5 ms; fig. 4 velocity
along the breaking line, 5 ms; fig. 5 motion of the breaking line, 50 ms; fig. 6 tension along the breaking line, 50
ms; fig. 7 velocity along the breaking line, 50 ms.
"""

import xarray

from tables import number, sub

from ...figures.line_panels import QUANTITIES, SCALED, LinePanel, line_panels, seen
from ...parts import Figure
from .drawing import behind, value

F_HS = "F" + sub("h,s")


def breaking(data: xarray.Dataset, kind: str) -> Figure:
    """The figure of a data file. Raises KeyError for one of another figure."""
    cases = [name.split("_")[1] for name in data if str(name).endswith("_force_N")]
    column = next(name for name in QUANTITIES if f"case_{cases[0]}_{name}" in data)
    abscissa = "x_m" if column == "z_m" else "s_m"
    panels = []
    for case in cases:
        x, y = data[f"case_{case}_{abscissa}"].values, data[f"case_{case}_{column}"].values
        time_s = data[f"case_{case}_time_s"].values
        panels.append(LinePanel(case, value(data, f"case_{case}_force_N"), x, y, time_s))
    quantity, fracture = QUANTITIES[column][0], number(1e3 * value(data, f"case_{cases[0]}_fracture_s"))
    caption = (
        f"{quantity} (fracture in {fracture} ms), curves 10 ms apart, dark to bright; {SCALED[column]}. "
        f"Titles: the static force {F_HS}. Seen: {seen(panels, column)}. {behind(data)}"
    )
    alt = f"Four panels, {quantity}, fracture in {fracture} ms, a curve every 10 ms, from {seen(panels, column)}."
    return Figure(line_panels(panels, column, kind), caption, alt)
