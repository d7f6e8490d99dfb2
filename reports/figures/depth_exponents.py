"""Exponent over a parameter of the scene, a panel for each pair of conditions: curves with errors, marked by regime."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, GREEN, INK, ORANGE, PURPLE, VERMILION
from ..parts.wording import number
from . import curves

COLOURS = (BLUE, VERMILION, GREEN, ORANGE, PURPLE)
BESIDE = 0.14  # of the space between two values
DASHES = ("-", "--", ":", "-.", "-")
MARKS = {"periodic": "o", "quasi-periodic": "s", "chaotic": "*", "transient": "v", "undecided": "x", "": "+"}


@dataclass(frozen=True)
class Curve:
    """One curve: its name, places, exponents with standard errors [bits per wave period] and words for the regimes."""

    name: str
    at: tuple[float, ...]
    value: tuple[float, ...]
    error: tuple[float, ...]
    regime: tuple[str, ...]


def kind_of(regime: str) -> str:
    """The mark that a regime gets: one for all periods."""
    return "periodic" if regime.startswith("period-") else regime


def depth_exponents(panels: list[list[tuple[str, list[Curve]]]], label: str, log: bool = False) -> Picture:
    """Rows and columns of panels, each (title, curves), over the parameter named by `label`.

    Its values are evenly spaced, and curves beside each other, so that marks do not hide marks; with `log` both stay
    where they are, on a logarithmic axis.
    """
    everything = [curve for row in panels for _, found in row for curve in found]
    values = sorted({at for curve in everything for at in curve.at})
    seen = {kind_of(word) for curve in everything for word in curve.regime}
    ticks = {} if log else {"xticks": range(len(values)), "xticklabels": list(map(number, values))}
    nothing = np.empty(0)
    key = [curves.Curve(nothing, nothing, kind or "no verdict", "", MARKS[kind], INK) for kind in MARKS if kind in seen]
    rows = []
    for row in panels:
        drawn = []
        for title, found in row:
            lines = []
            for k, curve in enumerate(found):
                aside = BESIDE * (k - 0.5 * (len(found) - 1))
                at = np.array(curve.at if log else [values.index(one) + aside for one in curve.at], dtype=float)
                lines += _drawn(at, curve, COLOURS[k % len(COLOURS)], DASHES[k % len(DASHES)])
            scale = "x" if log else ""
            exponent = r"$\sigma$ (bits per $T_i$)" if not drawn else ""
            below = label if row is panels[-1] else ""
            drawn.append(curves.Panel([*lines, *key], below, exponent, title, scale, 0.0, ticks))
        rows.append(drawn)
    return curves.curves(rows, 2.1 * len(rows) + 0.7, "below", "xy")


def _drawn(at: np.ndarray, curve: Curve, colour: str, dash: str) -> list[curves.Curve]:
    """The line with its error bars, and the marks of its regimes."""
    value, kinds = np.array(curve.value, dtype=float), np.array([kind_of(word) for word in curve.regime], dtype=object)
    lines = [curves.Curve(at, value, curve.name, dash, "", colour, np.array(curve.error, dtype=float))]
    for kind, mark in MARKS.items():
        if (chosen := kinds == kind).any():
            size = 7.0 if mark == "*" else 4.5
            lines.append(curves.Curve(at[chosen], value[chosen], "", "", mark, colour, size=size))
    return lines
