"""Error against run time, log-log: a mark for every setting, a line a method through what nothing cheaper beats."""

import numpy as np

from ..parts import Picture
from ..parts.style import BLUE, GREEN, INK, ORANGE, PURPLE, SKY, SOFT, VERMILION
from .curves import Curve, Panel, curves

_LOOKS = {  # method: colour, mark
    "esdirk43": (BLUE, "o"),
    "trbdf2": (GREEN, "s"),
    "generalized-alpha": (ORANGE, "^"),
    "midpoint": (PURPLE, "v"),
    "backward-euler": (SKY, "D"),
    "paper-box": (SOFT, "p"),
    "scipy Radau": (VERMILION, "X"),
    "scipy BDF": (VERMILION, "*"),
    "MoorDyn": (INK, "P"),
    "CableDyn": (SOFT, "<"),
}
_OTHER = (SOFT, ".")
DASHED = (", shock viscosity", ", stretched grid")


def cheapest(time: np.ndarray, error: np.ndarray) -> np.ndarray:
    """Indices of the settings that no setting as cheap or cheaper beats, by time."""
    best, chosen = np.inf, []
    for i in np.lexsort((error, time)):
        if error[i] < best:
            chosen.append(i)
            best = error[i]
    return np.array(chosen, dtype=int)


def work_precision(
    results: list[tuple], time_label: str, error_label: str, marked: tuple[float, float] | None
) -> Picture:
    """The diagram.

    results: of each method its name, time (n,) in the unit of the axis, error (n,), and whether it is another code's.
    marked: (time, error) of the shipped setting, ringed; None where it is not among the marks.
    """
    lines = []
    for name, time, error, peer in results:
        colour, mark = _LOOKS.get(name.partition(",")[0], _OTHER)
        dash = "--" if name.endswith(DASHED) else "-"
        width = 1.6 if peer else 1.0
        lines.append(Curve(time, error, "", "", mark, colour, size=2.6, alpha=0.45))
        front = cheapest(time, error)
        lines.append(Curve(time[front], error[front], name, dash, mark, colour, width=width))
    if marked is not None:
        time, error = marked
        ring = Curve(np.array([time]), np.array([error]), "shipped setting", "", "o", INK, size=9.0, filled=False)
        lines.append(ring)
    return curves([[Panel(lines, time_label, error_label, log="xy")]], 3.7, "right")
