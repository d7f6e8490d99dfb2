"""The report of `campaigns.sea`: one sea with its picture, or a map of seas. All content comes from the folder."""

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from tables import EMPTY, TANGENT_EXPONENT, count, number_of

from ..figures.maps import Map, maps
from ..figures.quantities import measured, over_key
from ..parts import (
    LONGEST_CELL,
    Figure,
    Folder,
    FolderError,
    Heading,
    Items,
    Notice,
    Report,
    Table,
    batched,
    heads,
    limits,
    plain,
    printed_cells,
    read_folder,
    report_page,
    section_items,
    series,
    shown_on,
    table_of,
)
from .figures import history_figure, responses_figure

_MOST_COLUMNS = 12  # columns of one table
_MOST_RUNS = 60  # that are printed; table.csv has all
_REGULAR = "Every motion of regular waves beside the sea, as `campaigns.sweep` finds them (`regular/table.csv`)."
_MAPS = {
    TANGENT_EXPONENT: "exponent",
    "large_share": "share of the large motion",
    "storm_maximum_N": "three-hour maximum",
    "snaps_per_hour": "snaps an hour",
}


def report(directory: Path) -> Report:
    """The content of the report on a sea's folder. Raises FolderError for a folder that is not one."""
    folder = read_folder(directory, ("sea", "start", "solver", "status"))
    cells = folder.part("cells")
    keys = folder.provenance.get("sea_keys")
    if not cells.table or not isinstance(keys, list):
        raise FolderError(folder.directory, "cells/table.csv cannot be read")
    if keys:
        figures = _maps(cells, keys)
    else:
        figures = _pictures(folder, cells)
    items = [figures, section_items("sea"), Heading("What the runs say together"), _numbers(cells)]
    regular = folder.part("regular")
    if regular.table:
        items += [Heading("Regular waves beside the sea"), _regular(regular)]
    items += [Heading("Warnings"), _warnings(folder)]
    names = shown_on(folder.columns, folder.table, longest=LONGEST_CELL)
    if len(folder.table) <= _MOST_RUNS:
        items.append(Heading("Runs"))
        items += [
            table_of(folder.columns, part, folder.table, "A row a run.") for part in batched(names, _MOST_COLUMNS)
        ]
    return report_page(folder, "A sea: memory of the start, motions, loads", items)


def _numbers(cells: Folder) -> Table:
    """The quantities of a single sea state as lines, or a row for each state of a map."""
    names = [name for name in shown_on(cells.columns, cells.table) if name not in ("status", "message")]
    if len(cells.table) > 1:
        return table_of(
            cells.columns, names[:_MOST_COLUMNS], cells.table, "A row a sea state; cells/table.csv has more."
        )
    printed, (row,) = printed_cells(cells.columns), cells.table
    lines = []
    for name in names:
        column = cells.columns[name]
        lines.append([column.meaning, printed[name](row), column.unit or EMPTY])
    return Table(heads("quantity", "value", "unit"), lines, "Of all seas of this state (`cells/table.csv`).")


def _pictures(folder: Folder, cells: Folder) -> Items:
    """The first sea over time, and the responses of the starts in all seas."""
    (cell,) = cells.table
    yield history_figure(folder, cell)
    distance = number_of(cell, "distance")
    if math.isfinite(distance):  # a sea with one start has no distance between starts
        yield responses_figure(folder.part("history"), distance)


def _maps(cells: Folder, keys: Sequence[str]) -> Items:
    """The quantities of _MAPS over one key, or as maps over two keys."""
    columns = [cells.columns[key] for key in keys]
    if len(keys) == 1:
        panels = [panel for panel in measured(cells.columns, cells.table, keys) if panel[0][0].name in _MAPS]
        if panels:
            picture = over_key(cells.table, columns[0], panels, {})
            yield Figure(picture, "Bars: one standard error.", "Panels over the key.")
        return
    drawn = [Map("", "sign of the exponent", [str(row["sign"] or "open") for row in cells.table])]
    for name, words in _MAPS.items():
        values = series(cells.table, name)
        if np.isfinite(values).any():
            drawn.append(Map(cells.columns[name].label, words, values))
    axes = ", ".join(plain(column.head) for column in columns)
    caption = f"Sea states over {axes}: {', '.join(part.name for part in drawn)}. Crosses: not known."
    yield Figure(maps(columns, cells.table, drawn), caption, f"Maps over {axes}.")


def _regular(regular: Folder) -> Table:
    """The motions of regular waves; an older folder may lack some of the columns."""
    wanted = ("waves.amplitude_m", "motion", "regime", "strobed_period", "tension_top_max_N", "slack_fraction")
    names = [name for name in wanted if name in regular.columns]
    return table_of(regular.columns, names, regular.table, _REGULAR)


def _warnings(folder: Folder) -> Notice:
    """Each run that ended early, and one of the messages of the others."""
    lines, messages = [], []
    for row in folder.table:
        if row["status"] != "ok":
            lines.append(f"Sea {row['sea']:.0f}, start {row['start']:.0f}: {row['status']}. {row['message']}")
        elif row["message"]:
            messages.append(str(row["message"]))
    if messages:
        lines.append(f"{count(len(messages), 'run')} ended as asked with a message, for instance: {min(messages)}")
    return limits("What the runs say", lines, "Every run reached its end.")
