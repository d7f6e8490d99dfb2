"""The curves of folds, flips and torus points over two keys, from curves/table.csv of a folder of orbits."""

from collections.abc import Iterator, Sequence
from itertools import cycle, groupby
from operator import itemgetter

import numpy as np

from tables import Column, listed, number_of

from ..figures.curves import COLOURS, Curve, Panel, curves, dots
from ..figures.regime_map import LINES
from ..parts import Figure, Folder, Heading, Items, filled_table, having, series
from ..parts.style import INK


def keys_of(part: Folder) -> tuple[Column, Column]:
    """The two keys of a folder of curves: their columns stand before that of the first error."""
    columns = list(part.columns.values())
    place = [column.name for column in columns].index("error_1")
    return columns[place - 2], columns[place - 1]


def drawn_curves(part: Folder, keys: Sequence[Column]) -> Iterator[Curve]:
    """Each curve over two keys, and its special points."""
    colours = cycle(COLOURS)
    sound = having(part.table, status="ok")
    for number, group in groupby(sound, key=itemgetter("curve")):
        rows = list(group)
        look = next(colours)
        along = [row for row in rows if np.isfinite(number_of(row, "place"))]
        name = f"{rows[0]['kind']} of period {int(rows[0]['period'])} ({int(number)})"
        x, y = (series(along, key.name) for key in keys)
        yield Curve(x, y, name, LINES[rows[0]["kind"]], colour=look, width=1.2)
        special = [row for row in rows if row["special"]]
        if special:
            x, y = (series(special, key.name) for key in keys)
            yield dots(x, y, "o", INK)


def curve_items(folder: Folder) -> Items:
    """The picture of the curves with their special points and ends; nothing in a folder without curves."""
    part = folder.part("curves")
    if not part.table:
        return
    keys = keys_of(part)
    lines = list(drawn_curves(part, keys))
    yield Heading("Curves over two keys")
    if lines:
        texts = []
        for row in part.table:
            if row["special"]:
                words = row["special"] + "?" * (row["status"] == "not-found")
                texts.append((row[keys[0].name], row[keys[1].name], words, INK))
        panel = Panel(lines, keys[0].label, keys[1].label, texts=texts)
        caption = (
            "Where events are: folds solid, flips dashed, torus points dotted; dots: special points "
            "(`curves/table.csv`), a question mark where the search for one failed. "
            "Between the curves the number and the stability of the orbits do not change, except "
            "at curves of orbits that are not followed."
        )
        yield Figure(
            curves([[panel]], 3.6, "below"), caption, f"{listed(curve.name for curve in lines if curve.name)}."
        )
    special, firsts = [], []
    for _, group in groupby(part.table, key=itemgetter("curve")):
        rows = list(group)
        firsts.append(rows[0])
        special += [row for row in rows if row["special"]]
    if special:
        names = ("curve", "kind", "special", keys[0].name, "error_1", keys[1].name, "error_2", "status", "message")
        yield from filled_table(part._replace(table=tuple(special)), "Special points of the curves.", names)
    names = ("curve", "branch", "period", "kind", "begins", "ends", "message")
    yield from filled_table(part._replace(table=tuple(firsts)), "The curves, and why each ends both ways.", names)
