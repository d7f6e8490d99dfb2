"""Error against run time, log-log: a mark for every setting, a line a method through what nothing cheaper beats."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, GREEN, INK, ORANGE, PURPLE, SKY, SOFT, VERMILION, picture_of, sheet

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
    "PyElastica": (INK, "h"),
}
_OTHER = (SOFT, ".")
DASHED = (", shock viscosity", ", stretched grid")


@dataclass(frozen=True, eq=False)
class Curve:
    """One method: time (n,) in the unit of the axis, error (n,), and whether it is another code's."""

    name: str
    time: np.ndarray
    error: np.ndarray
    peer: bool = False


def cheapest(time: np.ndarray, error: np.ndarray) -> np.ndarray:
    """Indices of the settings that no setting as cheap or cheaper beats, by time."""
    best, kept = np.inf, []
    for i in np.lexsort((error, time)):
        if error[i] < best:
            kept.append(i)
            best = error[i]
    return np.array(kept, dtype=int)


def work_precision(
    curves: list[Curve], time_label: str, error_label: str, marked: tuple[float, float] | None
) -> Picture:
    """The diagram. marked: (time, error) of the shipped setting, ringed; None where it is not among the marks."""
    with sheet(3.7) as figure:
        axes = figure.subplots()
        for curve in curves:
            colour, mark = _LOOKS.get(curve.name.partition(",")[0], _OTHER)
            dashed = "--" if curve.name.endswith(DASHED) else "-"
            axes.plot(curve.time, curve.error, mark, color=colour, markersize=2.6, alpha=0.45, linestyle="none")
            front = cheapest(curve.time, curve.error)
            width = 1.6 if curve.peer else 1.0
            axes.plot(curve.time[front], curve.error[front], dashed, marker=mark, color=colour, markersize=4.0,
                      linewidth=width, label=curve.name)  # fmt: skip
        if marked is not None:
            axes.plot(*marked, "o", color=INK, fillstyle="none", markersize=9, label="shipped setting")
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlabel(time_label)
        axes.set_ylabel(error_label)
        figure.legend(loc="outside right center")
        return picture_of(figure)
