"""What a table measures, as a report draws it: its numbers with their errors over a key, and the colours of motions."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import cycle

import numpy as np

from tables import PEAK, Column, errors_of, number_of

from ..parts import Picture, Row, batched, in_order, series
from ..parts.style import BLUE, BROWN, GREEN, INK, PLUM, SOFT, VERMILION
from .curves import COLOURS, Panel, curves, dots

PER_ROW = 2
# of all motions but that of the largest tension; dark ones, because the page makes dark colours light on a dark screen
_CALM = BLUE, GREEN, PLUM, BROWN, INK
Measured = tuple[tuple[Column, Column | None], ...]  # one panel: columns of one unit, each with its errors or None


def measured(columns: Mapping[str, Column], rows: Sequence[Row], without: Iterable[str]) -> list[Measured]:
    """The numeric columns of a table that are not the same in all rows, in its order.

    A column X_..._error belongs to the column X_... before it; X_min_U and X_max_U share a panel. without: names left
    out, such as those of the varied keys.
    """
    excluded = set(without)
    names = []
    for name, column in columns.items():
        if column.digits is not None and name not in excluded:
            names.append(name)
    errors, panels = errors_of(columns), []
    for name in names:
        if name.endswith("_error"):
            continue
        values = series(rows, name)
        if len(np.unique(values[np.isfinite(values)])) < 2:
            continue
        pair = (columns[name], columns.get(errors.get(name)))
        least = name.replace("_max_", "_min_")
        if panels and least != name and panels[-1][-1][0].name == least:
            panels[-1] = (*panels[-1], pair)
        else:
            panels.append((pair,))
    return panels


def colours_of(rows: Sequence[Row]) -> dict[str, str]:
    """The colour of each motion of a table by its letter; {} where it has one motion, or does not tell of any.

    The motion of the largest tension is vermilion; "", of runs that ended before they had one, is grey.
    """
    peaks = {}
    for row in in_order(rows, []):
        letter = row.get("motion") or ""
        peaks[letter] = max(peaks.get(letter, 0.0), number_of(row, PEAK))
    nameless = peaks.pop("", None)
    if len(peaks) < 2:
        return {}
    worst, calm_colours = max(peaks, key=peaks.get), cycle(_CALM)
    colours = {}
    for letter in peaks:
        colours[letter] = VERMILION if letter == worst else next(calm_colours)
    if nameless is not None:
        colours[""] = SOFT
    return colours


def over_key(rows: Sequence[Row], key: Column, shown: Sequence[Measured], motions: Mapping[str, str]) -> Picture:
    """`panels_over` as one picture."""
    grid = batched(panels_over(rows, key, shown, motions), PER_ROW)
    return curves(grid, 0.6 + 1.7 * len(grid), "best")


def panels_over(rows: Sequence[Row], key: Column, shown: Sequence[Measured], motions: Mapping[str, str]) -> list[Panel]:
    """Every quantity over a varied key, a panel each, with error bars where there are errors.

    Runs that did not reach their full length are crosses. motions: `colours_of` the table; where there are several,
    the columns of one panel are told apart by their marks alone.
    """
    x = series(rows, key.name)
    completed, letters = np.zeros(len(rows), bool), np.full(len(rows), "", object)
    for place, row in enumerate(rows):
        completed[place] = row["status"] == "ok"
        if motions:
            letters[place] = row.get("motion") or ""
    panels = []
    for pairs in shown:
        lines, level = [], None
        names = [column.label.rpartition(" (")[0] for column, _ in pairs]  # without units
        for (column, error), name, mark, colour in zip(pairs, names, "os^D", COLOURS, strict=False):
            y, bars = series(rows, column.name), None
            if error is not None:
                bars, level = series(rows, error.name), 0.0
            for letter, curve_colour in (motions or {"": colour}).items():
                title = ""
                if motions and mark == "o":
                    title = letter
                elif not motions and len(pairs) > 1:
                    title = name
                points, crosses = (letters == letter) & completed, (letters == letter) & ~completed
                error_bars = None if bars is None else bars[points]
                lines.append(dots(x[points], y[points], mark, curve_colour, 3.0, name=title, error=error_bars))
                lines.append(dots(x[crosses], y[crosses], "x", curve_colour, 5.0))
        last_column, _ = pairs[-1]
        label = ", ".join([*names[:-1], last_column.label])  # the unit once, at the end
        panels.append(Panel(lines, key.label, label, level=level))
    return panels
