"""The report of `campaigns.sea`: one sea with its picture, or a map of seas. Everything comes from the folder."""

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from tables import EMPTY, TANGENT_EXPONENT, count, number_of

from ..figures.maps import Map, maps
from ..figures.sea import SeaHistory, responses_over_time, sea_history
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
    having,
    heads,
    limits,
    part_of,
    plain,
    printed_cells,
    read_folder,
    report_page,
    section_items,
    shown_on,
    table_of,
)
from ..sweep.quantities import batched, measured, over_key, series

_MOST = 12  # columns of one table
_SHOWN = 120  # peak periods of the picture, or 1.6 times the time until the starts are together
_PICTURE = (
    "Sea 1. Top: distance of the buoy from its anchor, from every start. Middle: the waves at the anchor with their "
    "envelope, and the amplitudes at which motions of regular waves end. Bottom: tension of the run from rest; shaded: "
    "slack; triangles: snaps."
)
_RESPONSES = (
    "Every sea over the whole record. Top: how many different responses its starts have. Bottom: the largest distance "
    "of two starts, as a share of the motion; dashed: the distance below which two starts are one response."
)
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
    cells = part_of(folder, "cells")
    keys = folder.provenance.get("sea_keys")
    if cells is None or not isinstance(keys, list):
        raise FolderError(folder.directory, "cells/table.csv cannot be read")
    if keys:
        figures = _maps(cells, keys)
    else:
        figures = _picture(folder, cells)
    items = [*figures, *section_items("sea")]
    items += [Heading("What the runs say together"), _numbers(cells)]
    regular = part_of(folder, "regular")
    if regular is not None:
        items += [Heading("Regular waves beside the sea"), *_regular(regular)]
    items += [Heading("Warnings"), _warnings(folder)]
    names = shown_on(folder.columns, folder.table, longest=LONGEST_CELL)
    if len(folder.table) <= 60:
        items.append(Heading("Runs"))
        items += [table_of(folder.columns, part, folder.table, "A row a run.") for part in batched(names, _MOST)]
    return report_page(folder, "A sea: memory of the start, motions, loads", items)


def _numbers(cells: Folder) -> Table:
    """The row of one sea as lines, or those of a map as rows."""
    names = [name for name in shown_on(cells.columns, cells.table) if name not in ("status", "message")]
    if len(cells.table) > 1:
        return table_of(cells.columns, names[:_MOST], cells.table, "A row a sea state; cells/table.csv has more.")
    printed, (row,) = printed_cells(cells.columns), cells.table
    lines = []
    for name in names:
        column = cells.columns[name]
        lines.append([column.meaning, printed[name](row), column.unit or EMPTY])
    return Table(heads("quantity", ("value", ""), "unit"), lines, "Of all seas of this state (`cells/table.csv`).")


def _picture(folder: Folder, cells: Folder) -> Items:
    (cell,) = cells.table
    history = _history(folder, cell)
    if history is not None:
        alt = "Three panels over time: radius from all starts, waves with their envelope, tension with snaps."
        yield Figure(sea_history(history), _PICTURE, alt)
    over_time = part_of(folder, "history")
    if over_time is None:
        return
    seas = []
    for seed in sorted({row["sea"] for row in over_time.table}):
        rows = [row for row in having(over_time.table, sea=seed) if math.isfinite(row["responses"])]
        if rows:
            seas.append((series(rows, "period"), series(rows, "responses"), series(rows, "apart")))
    if seas:
        yield Figure(
            responses_over_time(seas, cell["distance"]), _RESPONSES, "Number of responses and distance over time."
        )


def _history(folder: Folder, cell) -> SeaHistory | None:
    """What the picture shows: the first sea, from t = 0 to some time after its starts came together."""
    from analysis import envelope
    from engine.physics.sea import elevation_m
    from engine.views import snaps_of

    rows = [row for row in having(folder.table, sea=1, status="ok") if not row["solver"]]
    runs = [folder.trajectory(row)[0] for row in sorted(rows, key=lambda row: row["start"])]
    if not runs or None in runs or rows[0]["start"] != 0:
        return None
    rest, options = runs[0], folder.provenance
    period_s, step_s = rest.scene.waves.period_s, rest.scene.sample_step_s()
    together = _together(folder)
    periods = _SHOWN
    if not math.isnan(together):
        periods = max(_SHOWN, 1.6 * together)
    shown = slice(0, round(periods * period_s / step_s) + 1)
    time_s = rest.columns["time_s"]
    surface_m = elevation_m(rest.scene, time_s)
    snaps = snaps_of(rest.scene, rest.columns, slack_share=options["slack_share"], snap_share=options["snap_share"])
    end_s = time_s[shown][-1]
    seen = (snaps.taut_s <= end_s) & np.isfinite(snaps.onset_s)
    folds = cell["fold_up_m"], cell["fold_down_m"]
    if not math.isfinite(sum(folds)):
        folds = None
    return SeaHistory(
        time_s[shown] / period_s,
        [run.columns["radius_m"][shown] for run in runs],
        surface_m[shown],
        envelope(surface_m)[shown],
        rest.columns["tension_top_high_N"][shown],
        np.column_stack([snaps.peak_s / period_s, snaps.peak_N])[snaps.peak_s <= end_s],
        np.column_stack([snaps.onset_s, snaps.taut_s])[seen] / period_s,
        folds,
        together,
        number_of(cell, "regular_N"),
    )


def _together(folder: Folder) -> float:
    """When the starts of the first sea first come together and stay for ten periods; NaN: never."""
    over_time = part_of(folder, "history")
    if over_time is None:
        return math.nan
    from analysis import spells_of
    from analysis.seas import HOLD

    rows = having(over_time.table, sea=1)
    for begin, end in spells_of([row["responses"] == 1 for row in rows]):
        if end - begin >= HOLD:
            return float(begin)
    return math.nan


def _maps(cells: Folder, keys: Sequence[str]) -> Items:
    columns = [cells.columns[key] for key in keys]
    if len(keys) == 1:
        shown = [pairs for pairs in measured(cells.columns, cells.table, keys) if pairs[0][0].name in _MAPS]
        if not shown:
            return
        yield Figure(over_key(cells.table, columns[0], shown, {}), "Bars: one standard error.", "Panels over the key.")
        return
    x, y = (series(cells.table, key) for key in keys)
    places = np.unique(x), np.unique(y)
    across, up = np.searchsorted(places[0], x), np.searchsorted(places[1], y)

    def laid(values, nothing):
        kind = object if nothing == "" else float
        grid = np.full((len(places[1]), len(places[0])), nothing, dtype=kind)
        grid[up, across] = values
        return grid

    signs = [str(row["sign"] or "open") for row in cells.table]
    drawn = [Map("", "sign of the exponent", laid(signs, ""))]
    for name, words in _MAPS.items():
        values = laid([row[name] for row in cells.table], math.nan)
        if np.isfinite(values).any():
            drawn.append(Map(cells.columns[name].label, words, values))
    labels = tuple(column.label for column in columns)
    heads = ", ".join(plain(column.head) for column in columns)
    caption = f"Sea states over {heads}: {', '.join(part.name for part in drawn)}. Crosses: not known."
    yield Figure(maps(places, labels, drawn), caption, f"Maps over {heads}.")


def _regular(regular: Folder) -> Items:
    wanted = ("waves.amplitude_m", "motion", "regime", "strobed_period", "tension_top_max_N", "slack_fraction")
    names = [name for name in wanted if name in regular.columns]
    yield table_of(regular.columns, names, regular.table, _REGULAR)


def _warnings(folder: Folder) -> Notice:
    lines, messages = [], set()
    for row in folder.table:
        if row["status"] != "ok":
            lines.append(f"Sea {row['sea']:.0f}, start {row['start']:.0f}: {row['status']}. {row['message']}")
        elif row["message"]:
            messages.add(str(row["message"]))
    if messages:
        with_message = count(sum(1 for row in folder.table if row["message"]), "run")
        lines.append(f"{with_message} say: {sorted(messages)[0]}")
    return limits("What the runs say", lines, "Every run reached its end.")
