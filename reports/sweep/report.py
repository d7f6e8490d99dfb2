"""The report of `campaigns.sweep`: built from the table and its dictionary of columns alone, whatever was varied."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from ..figures.maps import Map, maps
from ..parts.columns import Quantity, table_of
from ..parts.content import Figure, Heading, Item, Notice, Report, Table, Text, plain
from ..parts.folder import FolderError, read_folder
from ..parts.provenance import appendix, provenance_items, scene_items, timing_items
from ..parts.wording import EMPTY, listed, number
from .motions import every_motion
from .quantities import Measured, at, colours_of, extremes, in_order, measured, over_key, series

_PANELS, _MAPS, _COLUMNS = 8, 6, 14  # of one figure, of one table
_LONGEST = 24  # letters of a cell of the tables of runs
_NOTHING = Text("Every number of the table is the same in all runs, so there is nothing to draw.")
_SOUND = "Every run reached its full length, and no axial ringing is left; the answer says what else was checked."
_EXTREMES = "Least and greatest value of every column that is not the same in all runs."
_SCENE = "The scene as run, from `scene.toml`, with the first value of what is varied."
_EXCURSIONS = {  # words of a message (`engine.excursions`) -> what they say
    "in the air": "the sphere was in the air with its whole buoyancy",
    "below the bed": "the line lay below the bed",
}
_COUNTED = ("end_time_s", "periods")  # columns that tell of the run, not of the motion


def report(directory: str | Path) -> Report:
    """The content of the report on a sweep's folder. Raises FolderError for a folder that is not one."""
    folder = read_folder(directory, ("status", "run_key", "message"))
    vary = folder.provenance.get("vary")
    if not isinstance(vary, dict) or not 1 <= len(vary) <= 2 or not set(vary) <= set(folder.columns):
        raise FolderError(folder.directory, ["provenance.json cannot be read: it does not name what was varied"])
    keys = [folder.columns[name] for name in vary]
    rows, motions = in_order(folder.table, list(vary)), colours_of(folder.table)
    shown = measured(folder.columns, rows, (*vary, *_COUNTED))
    each = [*keys, *([folder.columns["motion"]] if motions else [])]  # what tells one run from another
    said = listed(f"`{key.name}`" for key in keys)
    varied = {key.name: listed(number(value) for value in np.unique(series(rows, key.name))) for key in keys}
    shipped = str(folder.provenance.get("scene") or folder.scene.name)
    items = [
        Heading("Question"),
        Text(f"What does the scene `{folder.scene.name}` do as {said} {'varies' if len(keys) == 1 else 'vary'}?"),
        *extremes(each, rows, [column for one in shown for column, _ in one], _EXTREMES),
        *(_panels(keys[0], rows, shown, motions) if len(keys) == 1 else _maps_of_each(keys, rows, shown, motions)),
        *(every_motion(folder, keys[0].name, keys[0].head) if len(keys) == 1 else []),
        Heading("Warnings"),
        _failed(each, rows),
        Heading("Table of runs"),
        *_tables(folder.columns, keys, rows),
        *appendix(
            *timing_items(folder), *scene_items(folder.scene, shipped, varied, _SCENE), *provenance_items(folder)
        ),
    ]
    return Report(f"Sweep of {said.replace('`', '')}", folder.scene.title or folder.scene.name, tuple(items))


def _panels(key: Quantity, rows, shown: Sequence[Measured], motions: Mapping[str, str]) -> list[Item]:
    items: list[Item] = []
    for part in batched(shown, _PANELS):
        names = listed(plain(column.head) for one in part for column, _ in one)
        caption = f"Columns of `table.csv` over {key.head}: {names}. Bars: one standard error; crosses: ended early."
        items.append(Figure(over_key(rows, key, part, motions), caption, f"Panels over {plain(key.head)} of {names}."))
    return [Heading(f"Over {key.head}"), *(items or [_NOTHING])]


def _maps_of_each(keys: Sequence[Quantity], rows, shown: Sequence[Measured], motions) -> list[Item]:
    every = {f", motion {letter}": [row for row in rows if row["motion"] == letter] for letter in motions}
    return [item for said, own in (every or {"": rows}).items() for item in _maps(keys, own, shown, said)]


def _maps(keys: Sequence[Quantity], rows, shown: Sequence[Measured], motion: str) -> list[Item]:
    over = [series(rows, key.name) for key in keys]
    places = tuple(np.unique(values) for values in over)
    across, up = (np.searchsorted(*pair) for pair in zip(places, over, strict=True))

    def laid(values: np.ndarray, nothing: object) -> np.ndarray:
        cells = np.full((len(places[1]), len(places[0])), nothing, dtype=values.dtype)
        cells[up, across] = values
        return cells

    regimes = np.array([str(row.get("regime") or "") for row in rows], dtype=object)
    drawn = [Map("", "regime", laid(regimes, ""))] if any(regimes) else []
    for column in (column for one in shown for column, _ in one):
        drawn.append(Map(column.label, plain(column.head), laid(series(rows, column.name), np.nan)))
    items: list[Item] = []
    for part in batched(drawn, _MAPS):
        names = listed(one.name for one in part)
        caption = f"Columns of `table.csv` over {keys[0].head} and {keys[1].head}: {names}{motion}. Crosses: no value."
        picture = maps(places, (keys[0].label, keys[1].label), part)
        items.append(Figure(picture, caption, f"Maps over two parameters of {names}{motion}."))
    return [Heading(f"Over {keys[0].head} and {keys[1].head}{motion}"), *(items or [_NOTHING])]


def batched(items: Sequence, most: int) -> list[Sequence]:
    """The items in their order, `most` of them at a time."""
    return [items[first : first + most] for first in range(0, len(items), most)]


def _failed(keys: Sequence[Quantity], rows) -> Notice:
    failed = [row for row in rows if row["status"] != "ok"]
    less = [row for row in rows if row not in failed and "largest tension" in str(row["message"])]
    lines = [": ".join(filter(None, (at(keys, row), row["status"], row["message"]))) for row in failed + less]
    for place, words in _EXCURSIONS.items():
        if count := sum(place in str(row["message"]) for row in rows):
            lines.append(f"In {count} of {len(rows)} runs {words} (column `message`).")
    if not lines:
        return Notice("note", "Nothing to warn of", (_SOUND,))
    return Notice("warning", "Runs that failed" if failed else "Runs that hold less", tuple(lines))


def _tables(columns: Mapping[str, Quantity], keys: Sequence[Quantity], rows) -> list[Table]:
    """Every column that says something in some row, in tables that a page can hold; sentences stay in `table.csv`."""
    own = {key.name: (lambda row, name=key.name: number(float(row[name]))) for key in keys}
    names = []
    for name, column in columns.items():
        cells = {column.cell(row[name]) for row in rows}
        if name not in own and cells != {EMPTY} and max(map(len, cells)) <= _LONGEST:
            names.append(name)
    parts, tables = batched(names, _COLUMNS), []
    for place, part in enumerate(parts, 1):
        which = f", columns {place} of {len(parts)}" if len(parts) > 1 else ""
        tables.append(table_of(columns, [*own, *part], rows, f"Every run{which}.", own))
    return tables
