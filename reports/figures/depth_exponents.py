"""Exponent over a parameter of the scene, a panel for each pair of conditions: curves with errors, marked by regime."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, GREEN, INK, ORANGE, PURPLE, SOFT, VERMILION, picture_of, sheet
from ..parts.wording import number

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
    rows, columns = len(panels), max(len(row) for row in panels)
    values = sorted({at for row in panels for _, curves in row for curve in curves for at in curve.at})
    with sheet(2.1 * rows + 0.7) as figure:
        axes = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey="row")
        seen: set[str] = set()
        handles = {}
        for i, row in enumerate(panels):
            for j, (title, curves) in enumerate(row):
                place = axes[i][j]
                place.set_title(title)
                place.axhline(0.0, color=SOFT, linewidth=0.7)
                for k, curve in enumerate(curves):
                    aside = BESIDE * (k - 0.5 * (len(curves) - 1))
                    at = curve.at if log else tuple(values.index(one) + aside for one in curve.at)
                    handles |= _drawn(place, at, curve, COLOURS[k % len(COLOURS)], DASHES[k % len(DASHES)])
                    seen |= {kind_of(word) for word in curve.regime}
                if log:
                    place.set_xscale("log")
                else:
                    place.set_xticks(range(len(values)), [number(one) for one in values])
            axes[i][0].set_ylabel(r"$\sigma$ (bits per $T_i$)")
        for place in axes[-1]:
            place.set_xlabel(label)
        from matplotlib.lines import Line2D

        style = {"linestyle": "none", "color": INK, "markersize": 5}
        known = [kind for kind in MARKS if kind in seen]
        marks = [Line2D([], [], marker=MARKS[kind], label=kind or "no verdict", **style) for kind in known]
        figure.legend(handles=[*handles.values(), *marks], loc="outside lower center", ncols=5)
        return picture_of(figure)


def _drawn(place, places, curve: Curve, colour: str, dash: str) -> dict[str, object]:
    at, value, error = (np.array(entry, dtype=float) for entry in (places, curve.value, curve.error))
    bars = place.errorbar(at, value, error, color=colour, linestyle=dash, linewidth=0.9, capsize=1.5, label=curve.name)
    for kind, mark in MARKS.items():
        chosen = np.array([kind_of(word) == kind for word in curve.regime], dtype=bool)
        if chosen.any():
            size = 7 if mark == "*" else 4.5
            place.plot(at[chosen], value[chosen], linestyle="none", marker=mark, color=colour, markersize=size)
    return {curve.name: bars}
