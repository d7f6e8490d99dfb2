"""The report of `campaigns.sweep`: built from the table and its dictionary of columns alone, whatever was varied."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import numpy as np

from tables import Column, listed, number

from ..buoy_sweep.ends import every_motion
from ..buoy_sweep.figures import orbit_figure
from ..buoy_sweep.motions import motions_items
from ..buoy_sweep.runs import NEEDED, read_sweep
from ..buoy_sweep.sheets import explorer, sheet_items
from ..buoy_sweep.snaps import snap_items
from ..figures.maps import Map, maps
from ..figures.quantities import Measured, colours_of, measured, over_key
from ..parts import (
    LONGEST_CELL,
    Figure,
    FolderError,
    Heading,
    Items,
    Notice,
    Report,
    Table,
    Text,
    at,
    batched,
    extremes,
    having,
    in_order,
    limits,
    picture_first,
    plain,
    read_folder,
    report_page,
    scene_items,
    series,
    shown_on,
    table_of,
    timing_items,
)

_PANELS, _MAPS, _COLUMNS = 8, 6, 14  # of one figure, of one table
_NOTHING = Text("Every number of the table is the same in all runs, so there is nothing to draw.")
_SOUND = "Every run reached its full length, and no axial ringing is left; the answer says what else was checked."
_EXTREMES = "Least and greatest value of every column that is not the same in all runs."
_SCENE = "The scene as run, from `scene.toml`, with the first value of what is varied."
_EXCURSIONS = {  # words of a message (`engine.trajectory.excursions`) -> what they say
    "in the air": "the sphere was in the air with its whole buoyancy",
    "below the bed": "the line lay below the bed",
}
_COUNTED = ("end_time_s", "periods")  # columns that tell of the run, not of the motion


def report(directory: Path) -> Report:
    """The content of the report on a sweep's folder. Raises FolderError for a folder that is not one."""
    folder = read_folder(directory, ("status", "run_key", "message"))
    vary = folder.provenance.get("vary")
    if not isinstance(vary, dict) or not 1 <= len(vary) <= 2 or not set(vary) <= set(folder.columns):
        raise FolderError(folder.directory, "provenance.json cannot be read: it does not name what was varied")
    keys = [folder.columns[name] for name in vary]
    rows, motions = in_order(folder.table, list(vary)), colours_of(folder.table)
    shown = measured(folder.columns, rows, (*vary, *_COUNTED))
    run_keys = list(keys)  # what tells one run from another
    if motions:
        run_keys.append(folder.columns["motion"])
    varied, key_cells, first, sheets = {}, {}, [], []
    for key in keys:
        varied[key.name] = listed(map(number, np.unique(series(rows, key.name))))
        key_cells[key.name] = lambda row, name=key.name: number(float(row[name]))  # with the digits that it needs
    shipped = str(folder.provenance.get("scene") or folder.scene.name)
    key_names = listed(f"`{name}`" for name in varied)
    verb = "vary"
    if len(keys) == 1:
        (key,) = keys
        verb = "varies"
        figures = _panels(key, rows, shown, motions), every_motion(folder, key.name, key.head), snap_items(folder, key)
        if set(NEEDED) <= set(folder.columns):  # of a buoy in regular waves
            sweep = read_sweep(directory, key)
            first, sheets = [orbit_figure(sweep), motions_items(sweep), explorer(sweep)], sheet_items(sweep)
    else:
        figures = _maps_of_each(keys, rows, shown, motions)
    items = [
        first,
        Heading("Question"),
        Text(f"What does the scene `{folder.scene.name}` do as {key_names} {verb}?"),
        extremes(run_keys, rows, _columns_of(shown), _EXTREMES),
        figures,
        Heading("Warnings"),
        _warnings(run_keys, rows),
        Heading("Table of runs"),
        _tables(folder.columns, key_cells, rows),
        sheets,
    ]
    if not first:
        items = picture_first(items)
    made = [timing_items(folder), scene_items(folder.scene, shipped, varied, _SCENE)]
    return report_page(folder, f"Sweep of {key_names.replace('`', '')}", items, made)


def _columns_of(shown: Sequence[Measured]) -> list[Column]:
    """The columns of all panels, without their errors."""
    columns = []
    for pairs in shown:
        columns += [column for column, _ in pairs]
    return columns


def _panels(key: Column, rows, shown: Sequence[Measured], motions: Mapping[str, str]) -> Items:
    yield Heading(f"Over {key.head}")
    for part in batched(shown, _PANELS):
        names = listed(plain(column.head) for column in _columns_of(part))
        caption = f"Columns of `table.csv` over {key.head}: {names}. Bars: one standard error; crosses: ended early."
        yield Figure(over_key(rows, key, part, motions), caption, f"Panels over {plain(key.head)} of {names}.")
    if not shown:
        yield _NOTHING


def _maps_of_each(keys: Sequence[Column], rows, shown: Sequence[Measured], motions) -> Items:
    if not motions:
        yield from _maps(keys, rows, shown, "")
    for letter in motions:
        yield from _maps(keys, having(rows, motion=letter), shown, f", motion {letter}")


def _maps(keys: Sequence[Column], rows, shown: Sequence[Measured], motion: str) -> Items:
    drawn = []
    regimes = [str(row.get("regime") or "") for row in rows]
    if any(regimes):
        drawn.append(Map("", "regime", regimes))
    for column in _columns_of(shown):
        drawn.append(Map(column.label, plain(column.head), series(rows, column.name)))
    yield Heading(f"Over {keys[0].head} and {keys[1].head}{motion}")
    for part in batched(drawn, _MAPS):
        names = listed(drawn_map.name for drawn_map in part)
        caption = f"Columns of `table.csv` over {keys[0].head} and {keys[1].head}: {names}{motion}. Crosses: no value."
        yield Figure(maps(keys, rows, part), caption, f"Maps over two parameters of {names}{motion}.")
    if not drawn:
        yield _NOTHING


def _warnings(keys: Sequence[Column], rows) -> Notice:
    """The runs that failed, then those whose numbers hold less, then how many left the range of the model."""
    failed, doubtful = [], []
    for row in rows:
        if row["status"] != "ok":
            failed.append(row)
        elif "largest tension" in str(row["message"]):
            doubtful.append(row)
    lines = []
    for row in failed + doubtful:
        parts = (at(keys, row), row["status"], row["message"])
        lines.append(": ".join(filter(None, parts)))
    for phrase, words in _EXCURSIONS.items():
        runs = sum(phrase in str(row["message"]) for row in rows)
        if runs:
            lines.append(f"In {runs} of {len(rows)} runs {words} (column `message`).")
    title = "Runs that failed" if failed else "Runs that hold less"
    return limits(title, lines, _SOUND)


def _tables(columns: Mapping[str, Column], key_cells: Mapping[str, Callable], rows) -> list[Table]:
    """Every column that says something in some row, in tables that a page can hold; sentences stay in `table.csv`.

    key_cells: of the varied keys, the function of a row that gives their cell.
    """
    names = [name for name in shown_on(columns, rows, longest=LONGEST_CELL) if name not in key_cells]
    parts, tables = batched(names, _COLUMNS), []
    for place, part in enumerate(parts, 1):
        caption = "Every run."
        if len(parts) > 1:
            caption = f"Every run, columns {place} of {len(parts)}."
        tables.append(table_of(columns, [*key_cells, *part], rows, caption, key_cells))
    return tables
