"""Exponent over a parameter of the scene, a panel for each pair of conditions: curves with errors, marked by regime."""

import numpy as np

from ..parts.content import Picture
from ..parts.style import INK
from ..parts.wording import number
from .curves import COLOURS, Curve, Panel, curves

BESIDE = 0.14  # of the space between two values
DASHES = ("-", "--", ":", "-.", "-")
MARKS = {"periodic": "o", "quasi-periodic": "s", "chaotic": "*", "transient": "v", "undecided": "x", "": "+"}
# its name; of every run the place, the exponent, its standard error [bits per wave period] and a word for the regime
Exponents = tuple[str, list[tuple[float, float, float, str]]]


def kind_of(regime: str) -> str:
    """The mark that a regime gets: one for all periods."""
    return "periodic" if regime.startswith("period-") else regime


def depth_exponents(panels: list[list[tuple[str, list[Exponents]]]], label: str, log: bool = False) -> Picture:
    """Rows and columns of panels, each (title, curves), over the parameter named by `label`.

    Its values are evenly spaced, and curves beside each other, so that marks do not hide marks; with `log` both stay
    where they are, on a logarithmic axis.
    """
    runs = [run for row in panels for _, series in row for _, members in series for run in members]
    values, seen = sorted({run[0] for run in runs}), {kind_of(run[3]) for run in runs}
    ticks = {} if log else {"xticks": range(len(values)), "xticklabels": list(map(number, values))}
    nothing = np.empty(0)
    key = [Curve(nothing, nothing, kind or "no verdict", "", MARKS[kind], INK) for kind in MARKS if kind in seen]
    rows = []
    for row in panels:
        drawn = []
        for title, series in row:
            lines = []
            for k, (name, members) in enumerate(series):
                aside = BESIDE * (k - 0.5 * (len(series) - 1))
                at = [run[0] if log else values.index(run[0]) + aside for run in members]
                look = COLOURS[k % len(COLOURS)], DASHES[k % len(DASHES)]
                lines += _drawn(name, np.array(at, dtype=float), members, *look)
            exponent = r"$\sigma$ (bits per $T_i$)" if not drawn else ""
            below = label if row is panels[-1] else ""
            drawn.append(Panel([*lines, *key], below, exponent, title, "x" if log else "", 0.0, ticks))
        rows.append(drawn)
    return curves(rows, 2.1 * len(rows) + 0.7, "below", "xy")


def _drawn(name: str, at: np.ndarray, runs: list, colour: str, dash: str) -> list[Curve]:
    """The line with its error bars, and the marks of its regimes."""
    value, error = (np.array([run[k] for run in runs], dtype=float) for k in (1, 2))
    kinds = np.array([kind_of(run[3]) for run in runs], dtype=object)
    lines = [Curve(at, value, name, dash, "", colour, error)]
    for kind, mark in MARKS.items():
        if (chosen := kinds == kind).any():
            lines.append(Curve(at[chosen], value[chosen], "", "", mark, colour, size=7.0 if mark == "*" else 4.5))
    return lines
