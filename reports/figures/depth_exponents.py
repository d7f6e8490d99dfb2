"""Exponent over a parameter of the scene, a panel for each pair of conditions: curves with errors, marked by regime."""

from itertools import chain

import numpy as np

from tables import number

from ..parts.content import Picture
from ..parts.style import INK
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
    values, key = _places_and_key(panels)
    axis, ticks = "x", {}
    if not log:
        axis, ticks = "", {"xticks": range(len(values)), "xticklabels": list(map(number, values))}
    rows = []
    for row in panels:
        drawn = []
        for title, series in row:
            lines = []
            for k, (name, members) in enumerate(series):
                at = np.array([run[0] for run in members], dtype=float)
                if not log:
                    at = np.searchsorted(values, at) + BESIDE * (k - 0.5 * (len(series) - 1))
                lines += _drawn(name, at, members, COLOURS[k % len(COLOURS)], DASHES[k % len(DASHES)])
            exponent = "" if drawn else r"$\sigma$ (bits per $T_i$)"
            x_label = label if row is panels[-1] else ""
            drawn.append(Panel([*lines, *key], x_label, exponent, title, axis, 0.0, ticks))
        rows.append(drawn)
    return curves(rows, 2.1 * len(rows) + 0.7, "below", "xy")


def _places_and_key(panels: list[list[tuple[str, list[Exponents]]]]) -> tuple[list[float], list[Curve]]:
    """The values of the parameter in all panels; what the marks mean, as curves without points for the legend."""
    places, kinds = set(), set()
    for _, series in chain.from_iterable(panels):
        for _, members in series:
            for place, _, _, regime in members:
                places.add(place)
                kinds.add(kind_of(regime))
    entries, nothing = [], np.empty(0)
    for kind, mark in MARKS.items():
        if kind in kinds:
            entries.append(Curve(nothing, nothing, kind or "no verdict", "", mark, INK))
    return sorted(places), entries


def _drawn(name: str, at: np.ndarray, runs: list, colour: str, dash: str) -> list[Curve]:
    """The line with its error bars, and the marks of its regimes."""
    values, errors, kinds = [], [], []
    for _, exponent, error, regime in runs:
        values.append(exponent)
        errors.append(error)
        kinds.append(kind_of(regime))
    values, errors, kinds = np.array(values, float), np.array(errors, float), np.array(kinds, object)
    lines = [Curve(at, values, name, dash, "", colour, errors)]
    for kind, mark in MARKS.items():
        chosen = kinds == kind
        if chosen.any():
            size = 7.0 if mark == "*" else 4.5
            lines.append(Curve(at[chosen], values[chosen], "", "", mark, colour, size=size))
    return lines
