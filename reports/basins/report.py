"""The report of `campaigns.basins`: what is said, in which order. Everything comes from the campaign's folder."""

import math
from pathlib import Path

import numpy as np

from tables import FAILED, REGIMES, RUNS, count, listed, number, of_kicks

from ..figures.basins import basin_map
from ..figures.curves import Curve, Panel, curves
from ..figures.orbit_diagram import NARROW_IN
from ..parts import (
    LONGEST_CELL,
    Figure,
    Folder,
    FolderError,
    Heading,
    Items,
    Notice,
    Report,
    Text,
    having,
    limits,
    part_of,
    read_folder,
    report_page,
    section_items,
    shown_on,
    table_of,
)
from ..parts.style import BLUE, INK
from ..sweep.quantities import batched, colours_of, filled_table

_AXES = {
    "vx": ("kick_x_mps", "velocity along the waves (m/s)"),
    "vz": ("kick_z_mps", "velocity upwards (m/s)"),
    "x": ("displacement_x_m", "place along the waves, from rest (m)"),
    "z": ("displacement_z_m", "place upwards, from rest (m)"),
    "phase": ("phase_rad", "time from the start to a crest, share of T"),
}
_JUDGED = (
    "One judged run a motion. Share: of the starts of the grid. They are no independent draws: the interval is "
    "too wide where the basins are wider than the steps of the grid."
)
_SMALLEST = "The smallest start that leads to the motion of the largest tension, bisected to 1 %, on two grids."
_EDGE = (
    "Two states on either side of the border between two basins are bisected until they are near each other, "
    "run side by side until they part, and bisected again (Skufca, Yorke and Eckhardt, Phys. Rev. Lett. 96, "
    "174101, 2006). Both settle on the edge state, which no start keeps. Its strobed states: `edge/orbit.csv`."
)
_MOST = 14  # columns of one table
_PERIODS = 8  # of a motion without a period, drawn


def report(directory: Path) -> Report:
    """The content of the report on a folder of basins. Raises FolderError for a folder that is not one."""
    folder = read_folder(directory, ("motion", "outcome", "status"))
    across = folder.provenance.get("across")
    if not isinstance(across, list) or not set(across) <= set(_AXES):
        raise FolderError(folder.directory, "provenance.json cannot be read: it does not name what was varied")
    motion_runs, shock, edge = [part_of(folder, name) for name in ("motions", "shock", "edge")]
    motions = []
    if motion_runs is not None:
        motions = [row for row in motion_runs.table if row["motion"]]
    items = [*_map(folder, across, motions, shock), *section_items("basins")]
    if motions:
        items += _motions(motion_runs, motions, edge)
    if shock is not None:
        items += [Heading("The smallest start"), *filled_table(shock, _SMALLEST)]
    if edge is not None:
        items += [Heading("The edge state"), Text(_EDGE), *filled_table(edge, "The edge state.")]
    items += [Heading("Warnings"), _warnings(folder, across)]
    return report_page(folder, "Basins: which start ends in which motion", items)


def _colours(motions) -> dict[str, str]:
    return colours_of(motions) or {str(row["motion"]): BLUE for row in motions}


def _value(row, axis: str) -> float:
    column, _ = _AXES[axis]
    value = float(row[column])
    if axis == "phase":
        return value / (2.0 * math.pi)
    return value


def _map(folder: Folder, across: list[str], motions, shock: Folder | None) -> Items:
    x_axis, y_axis = across
    x, across_place = np.unique([_value(row, x_axis) for row in folder.table], return_inverse=True)
    y, up_place = np.unique([_value(row, y_axis) for row in folder.table], return_inverse=True)
    ended = np.full((len(y), len(x)), "", dtype=object)
    for row, up, right in zip(folder.table, up_place, across_place, strict=True):
        ended[up, right] = row["motion"] or _outcome(row)
    colours, names = _colours(motions), {}
    colours.pop("", None)
    for row in motions:
        letter, regime = str(row["motion"]), row["regime"] or row["status"]
        names[letter] = f"{letter}: {regime}, {number(row['tension_top_max_N'] / 1e3, 3)} kN"
    arrow = _arrow(across, shock)
    labels = _AXES[x_axis][1], _AXES[y_axis][1]
    picture = basin_map((x, y), ended, labels, colours, names, arrow)
    narrow = basin_map((x, y), ended, labels, colours, names, arrow, NARROW_IN)
    caption = (
        "Motion in which each start of the grid ends, with its largest tension (`table.csv`, `motions/table.csv`)."
    )
    if arrow is not None:
        caption += " Arrow: the smallest start that leads to the motion of the largest tension."
    alt = f"Map of {count(len(folder.table), 'start')}, a colour a motion; shares in the text."
    yield Figure(picture, caption, alt, narrow=narrow)


def _outcome(row) -> str:
    """What is said of a start that belongs to no motion."""
    if row["status"] != "ok":
        return FAILED
    return row["outcome"]


def _arrow(across: list[str], shock: Folder | None) -> tuple[list[float], str] | None:
    """(where the smallest start to the largest tension is on the map, its size in words); None without one."""
    if shock is None:
        return None
    starts = having(shock.table, status="ok")
    if not starts or not starts[0]["size"] > 0.0:
        return None
    unit = "m" if "x" in across else "m/s"
    return [_value(starts[0], axis) for axis in across], f"{number(starts[0]['size'], 2)} {unit}"


def _motions(part: Folder, motions, edge: Folder | None) -> Items:
    yield Heading("Motions")
    shown = shown_on(part.columns, motions, RUNS, REGIMES, longest=LONGEST_CELL)
    for names in batched([name for name in shown if name not in ("steepness", "motion")], _MOST):
        yield table_of(part.columns, ["motion", *names], motions, _JUDGED, {"share": of_kicks})
    for row in motions:
        if row["confirmed"]:
            yield Text(f"Motion {row['motion']}, when it goes on from its state, is found {row['confirmed']}.")
    colours, lines = _colours(motions), []
    looks = [(part, row, f"{row['motion']}", "-", "", colours[row["motion"]]) for row in motions]
    if edge is not None:
        looks += [(edge, row, "edge state", (0, (3, 1)), "", INK) for row in edge.table if row["run_key"]]
    for folder, row, *look in looks:
        run, _ = folder.trajectory(row)
        if run is not None:
            lines.append(_loop(run, row["strobed_period"], look))
    if lines:
        caption = "Radial speed over r, of the last periods of each motion and of the edge state between two of them."
        picture = curves([[Panel(lines, "r (m)", "dr/dt (m/s)")]], 3.4, "right")
        yield Figure(picture, caption, f"Phase portrait of {listed(line.name for line in lines)}.")


def _loop(run, period: float, look: list) -> Curve:
    """The last periods of a run: one orbit, or a few. look: name, line, mark and colour."""
    samples_per_period = round(run.scene.waves.period_s / run.scene.sample_step_s())
    periods, width = _PERIODS, 0.5
    if math.isfinite(period):
        periods, width = int(period), 1.2
    last = slice(-periods * samples_per_period - 1, None)
    radius, rate = run.columns["radius_m"][last], run.columns["radius_rate_mps"][last]
    return Curve(radius, rate, *look, width=width)


def _warnings(folder: Folder, across: list[str]) -> Notice:
    rows_of_outcomes = {}
    for row in folder.table:
        if row["motion"]:
            continue
        outcome = row["outcome"] if row["status"] == "ok" else row["status"]
        rows_of_outcomes.setdefault(outcome, []).append(row)
    lines = []
    for outcome, rows in rows_of_outcomes.items():
        first = rows[0]
        place = listed(f"{axis} = {number(_value(first, axis))}" for axis in across)
        line = f"{count(len(rows), 'start')} {outcome}, the first at {place}"
        if first["message"]:
            line += f": {first['message']}"
        lines.append(f"{line}.")
    return limits("Starts that belong to no motion", lines, "Every start has settled or joined a known motion.")
