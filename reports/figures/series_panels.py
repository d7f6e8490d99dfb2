"""A measured record and the curves behind its verdict: record and spectrum, section, neighbours, dimension."""

import numpy as np

from ..parts import Picture
from ..parts.style import INK, kind_for
from .curves import Curve, Panel, curves

_LONGEST_NAME = 24  # letters of a column's name beside its axis
SHOWN = 4000  # samples of the record that are drawn: the last


def record_and_spectrum(
    time: np.ndarray, values: np.ndarray, frequency: np.ndarray, amplitude: np.ndarray, names: tuple[str, str]
) -> Picture:
    """The end of the record (n,) over time, and |X| (m,) of eq. (31) over the angular frequency, logarithmic.

    names: the unit of time; the column, as its file calls it.
    """
    unit, column = names
    shown = column if len(column) <= _LONGEST_NAME else column[: _LONGEST_NAME - 1] + "…"
    label = shown.replace("$", r"\$")  # a name is no mathematics
    record = Curve(time[-SHOWN:], values[-SHOWN:], colour=INK, width=0.6)
    moving = amplitude[1:]
    spectrum = Curve(frequency[1:], np.maximum(moving, 1e-6 * moving.max(initial=1e-300)), width=0.7)
    upper = Panel([record], f"time ({unit})", label)
    lower = Panel([spectrum], f"angular frequency (rad/{unit})", "$|X|$, eq. (31), as above", log="y")
    return curves([[upper], [lower]], 3.8, kind=kind_for(len(frequency) + SHOWN))


def return_map(values: np.ndarray) -> Picture:
    """Each point of the section (m,) against the one before it, and against its number."""
    look = {"line": "", "mark": "o", "size": 2.5 if len(values) < 600 else 1.5, "alpha": 0.6}
    values_panel = Panel([Curve(values[:-1], values[1:], **look)], "point $k$", "point $k + 1$")
    right = Panel([Curve(np.arange(len(values)), values, **look)], "$k$", "point $k$")
    return curves([[values_panel, right]], 3.0, kind=kind_for(2 * len(values)))


def growth_and_dimension(
    growth: tuple[np.ndarray, np.ndarray], slopes: tuple[float, np.ndarray, np.ndarray], unit: str
) -> Picture:
    """Growth of the distance of neighbours and slopes of the correlation sum; a panel is empty where there is no curve.

    Args: `growth` (time (n,), mean ln(distance) (n,)); `slopes` (delays, radius (b,), slope (b,)); `unit` of the time.
    """
    left, right = [], []
    if np.isfinite(growth[1]).any():
        left.append(Curve(*growth))
    delays, radius, slope = slopes
    if len(radius):
        right.append(Curve(radius, slope, f"{delays:.0f} delays", colour=INK))
    distances = Panel(left, f"time ({unit})", "mean ln(distance) (nats)")
    dimension = Panel(right, "radius (standard deviations)", "slope of the correlation sum", log="x")
    return curves([[distances, dimension]], 3.0, "best")
