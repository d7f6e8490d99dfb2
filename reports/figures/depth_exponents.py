"""Exponent over a parameter of the scene, a panel for each pair of conditions: curves with errors, marked by regime."""

from itertools import chain

import numpy as np

from tables import TANGENT_ERROR, TANGENT_EXPONENT, number

from ..parts import Picture, Row, entries, series
from ..parts.style import INK
from .curves import COLOURS, Curve, Panel, curves

BESIDE = 0.14  # of the space between two values
DASHES = ("-", "--", ":", "-.", "-")
MARKS = {"periodic": "o", "quasi-periodic": "s", "chaotic": "*", "transient": "v", "undecided": "x", "": "+"}
Exponents = tuple[str, list[Row]]  # the name of a curve, and the rows of the table on it
Panels = list[list[tuple[str, list[Exponents]]]]  # rows and columns of them, each (title, curves)


def kind_of(regime: str) -> str:
    """The mark that a regime gets: one for all periods."""
    return "periodic" if regime.startswith("period-") else regime


def depth_exponents(panels: Panels, key: str, label: str, log: bool = False) -> Picture:
    """The panels over the column `key`, on an axis with that label.

    Its values are evenly spaced, and curves beside each other, so that marks do not hide marks; with `log` both stay
    where they are, on a logarithmic axis.
    """
    values, marks = _values_and_marks(panels, key)
    axis, ticks = "x", {}
    if not log:
        axis, ticks = "", {"xticks": range(len(values)), "xticklabels": list(map(number, values))}
    rows = []
    for row in panels:
        drawn = []
        for title, exponents in row:
            lines = []
            for k, (name, members) in enumerate(exponents):
                at = series(members, key)
                if not log:
                    at = np.searchsorted(values, at) + BESIDE * (k - 0.5 * (len(exponents) - 1))
                lines += _drawn(name, at, members, COLOURS[k % len(COLOURS)], DASHES[k % len(DASHES)])
            exponent = "" if drawn else r"$\sigma$ (bits per $T_i$)"
            x_label = label if row is panels[-1] else ""
            drawn.append(Panel([*lines, *marks], x_label, exponent, title, axis, 0.0, ticks))
        rows.append(drawn)
    return curves(rows, 2.1 * len(rows) + 0.7, "below", "xy")


def _values_and_marks(panels: Panels, key: str) -> tuple[list[float], list[Curve]]:
    """The values of the parameter in all panels; what the marks mean, as curves without points for the legend."""
    places, kinds = set(), set()
    for _, exponents in chain.from_iterable(panels):
        for _, members in exponents:
            for row in members:
                places.add(row[key])
                kinds.add(kind_of(row["regime"]))
    entries, nothing = [], np.empty(0)
    for kind, mark in MARKS.items():
        if kind in kinds:
            entries.append(Curve(nothing, nothing, kind or "no verdict", "", mark, INK))
    return sorted(places), entries


def _drawn(name: str, at: np.ndarray, runs: list, colour: str, dash: str) -> list[Curve]:
    """The line with its error bars, and the marks of its regimes."""
    values, kinds = series(runs, TANGENT_EXPONENT), np.array(list(map(kind_of, entries(runs, "regime"))), object)
    lines = [Curve(at, values, name, dash, "", colour, series(runs, TANGENT_ERROR))]
    for kind, mark in MARKS.items():
        chosen = kinds == kind
        if chosen.any():
            size = 7.0 if mark == "*" else 4.5
            lines.append(Curve(at[chosen], values[chosen], "", "", mark, colour, size=size))
    return lines
