"""The report of `campaigns.basins`: what is said, in which order. Everything comes from the campaign's folder."""

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..figures.basins import basin_map
from ..figures.curves import Curve, Panel, curves
from ..figures.orbit_diagram import NARROW_IN
from ..parts.columns import table_of
from ..parts.content import Figure, Heading, Item, Notice, Report, Table, Text
from ..parts.folder import Folder, FolderError, part_of, read_folder
from ..parts.provenance import appendix, provenance_items, scene_items, timing_items
from ..parts.sections import section_items
from ..parts.style import BLUE, INK
from ..parts.wording import count, listed, number, of_kicks
from ..sweep.quantities import colours_of, further

_AXES = {
    "vx": ("kick_x_mps", "velocity along the waves (m/s)"),
    "vz": ("kick_z_mps", "velocity upwards (m/s)"),
    "x": ("displacement_x_m", "place along the waves, from rest (m)"),
    "z": ("displacement_z_m", "place upwards, from rest (m)"),
    "phase": ("phase_rad", "time from the start to a crest, share of T"),
}
_MOTIONS = (
    "motion", "regime", "share", "share_low", "share_high", "radius_min_m", "radius_max_m", "tension_top_max_N",
    ("lyapunov_tangent_bits_per_period", "lyapunov_tangent_error"), "found_by",
)  # fmt: skip
_JUDGED = (
    "One judged run a motion. Share: of the starts of the grid. They are no independent draws: the interval is "
    "too wide where the basins are wider than the steps of the grid."
)
_PERIODS = 8  # of a motion without a period, drawn
_FAILED = "failed"


def report(directory: str | Path) -> Report:
    """The content of the report on a folder of basins. Raises FolderError for a folder that is not one."""
    folder = read_folder(directory, ("motion", "outcome", "status"))
    across = folder.provenance.get("across")
    if not isinstance(across, list) or not set(across) <= set(_AXES):
        raise FolderError(folder.directory, ["provenance.json cannot be read: it does not name what was varied"])
    parts = {name: part_of(folder, name) for name in ("motions", "shock", "edge")}
    motions = [row for row in (parts["motions"].table if parts["motions"] else ()) if row["motion"]]
    items = [
        *_map(folder, across, motions, parts["shock"]),
        *section_items("basins", "Question"),
        *(_motions(parts["motions"], motions, parts["edge"]) if motions else ()),
        *_shock(parts["shock"]),
        *_edge(parts["edge"]),
        Heading("Warnings"),
        _warnings(folder, across),
        *appendix(
            *timing_items(folder),
            *scene_items(folder.scene, str(folder.provenance.get("scene") or folder.scene.name), {}),
            *provenance_items(folder),
        ),
    ]
    return Report("Basins: which start ends in which motion", folder.scene.title or folder.scene.name, tuple(items))


def _colours(motions) -> dict[str, str]:
    return colours_of(motions) or {str(row["motion"]): BLUE for row in motions}


def _value(row, axis: str) -> float:
    return float(row[_AXES[axis][0]]) / (2.0 * math.pi if axis == "phase" else 1.0)


def _map(folder: Folder, across: list[str], motions, shock: Folder | None) -> Iterator[Item]:
    colours = {letter: colour for letter, colour in _colours(motions).items() if letter}
    places = tuple(np.unique([_value(row, axis) for row in folder.table]) for axis in across)
    ended = np.full((len(places[1]), len(places[0])), "", dtype=object)
    for row in folder.table:
        at = (int(np.searchsorted(values, _value(row, axis))) for values, axis in zip(places, across, strict=True))
        ended[tuple(at)[::-1]] = row["motion"] or (row["outcome"] if row["status"] == "ok" else _FAILED)
    names = {
        str(row["motion"]): f"{row['motion']}: {row['regime'] or row['status']}, "
        f"{number(row['tension_top_max_N'] / 1e3, 3)} kN"
        for row in motions
    }
    least = next((row for row in (shock.table if shock else ()) if row["status"] == "ok"), None)
    arrow = None
    if least is not None and least["size"] > 0.0:
        unit = "m" if "x" in across else "m/s"
        arrow = [_value(least, axis) for axis in across], f"{number(least['size'], 2)} {unit}"
    labels = tuple(_AXES[axis][1] for axis in across)
    wide, narrow = (basin_map(places, ended, labels, colours, names, arrow, *how) for how in ((), (NARROW_IN,)))
    told = "Motion in which each start of the grid ends, with its largest tension (`table.csv`, `motions/table.csv`)."
    told += "" if arrow is None else " Arrow: the smallest start that leads to the motion of the largest tension."
    yield Figure(
        wide, told, f"Map of {count(len(folder.table), 'start')}, a colour a motion; shares in the text.", narrow=narrow
    )


def _motions(part: Folder, motions, edge: Folder | None) -> Iterator[Item]:
    yield Heading("Motions")
    shown = (*_MOTIONS, *further(part.columns))
    yield table_of(part.columns, shown, motions, _JUDGED, {"share": of_kicks})
    for row in motions:
        if row["confirmed"]:
            yield Text(f"Motion {row['motion']}, when it goes on from its state, is found {row['confirmed']}.")
    colours, lines = _colours(motions), []
    for row in motions:
        run, _ = part.trajectory(row)
        if run is not None:
            lines.append(_loop(run, row["strobed_period"], f"{row['motion']}", colours[row["motion"]]))
    for row in edge.table if edge else ():
        run, _ = edge.trajectory(row) if row["run_key"] else (None, "")
        if run is not None:
            lines.append(_loop(run, row["strobed_period"], "edge state", INK, (0, (3, 1))))
    if lines:
        caption = "Radial speed over r, of the last periods of each motion and of the edge state between two of them."
        picture = curves([[Panel(lines, "r (m)", "dr/dt (m/s)")]], 3.4, "right")
        yield Figure(picture, caption, f"Phase portrait of {listed(line.name for line in lines)}.")


def _loop(run, period: float, name: str, colour: str, line="-") -> Curve:
    """The last periods of a run: one orbit, or a few."""
    every = round(run.scene.waves.period_s / run.scene.sample_step_s())
    shown = int(period) if math.isfinite(period) else _PERIODS
    radius, rate = (run.columns[one][-shown * every - 1 :] for one in ("radius_m", "radius_rate_mps"))
    return Curve(radius, rate, name, line, "", colour, width=1.2 if math.isfinite(period) else 0.5)


def _shock(part: Folder | None) -> Iterator[Item]:
    if part is not None:
        yield Heading("The smallest start")
        caption = "The smallest start that leads to the motion of the largest tension, bisected to 1 %, on two grids."
        yield _table(part, caption)


def _edge(part: Folder | None) -> Iterator[Item]:
    if part is not None:
        yield Heading("The edge state")
        yield Text(
            "Two states on either side of the border between two basins are bisected until they are near each other, "
            "run side by side until they part, and bisected again (Skufca, Yorke and Eckhardt, Phys. Rev. Lett. 96, "
            "174101, 2006). Both settle on the edge state, which no start keeps. Its strobed states: `edge/orbit.csv`."
        )
        yield _table(part, "The edge state.")


def _table(part: Folder, caption: str) -> Table:
    """The columns that say something."""
    shown = [name for name in part.columns if any(row[name] not in ("", 0.0) for row in part.table)]
    shown = [name for name in shown if any(row[name] == row[name] for row in part.table)]  # not nan
    return table_of(part.columns, [name for name in shown if name != "run_key"], part.table, caption)


def _warnings(folder: Folder, across: list[str]) -> Notice:
    kinds: dict[str, list] = {}
    for row in folder.table:
        if not row["motion"]:
            kinds.setdefault(row["outcome"] if row["status"] == "ok" else row["status"], []).append(row)
    if not kinds:
        return Notice("note", "Nothing to warn of", ("Every start has settled or joined a known motion.",))
    lines = []
    for why, rows in kinds.items():
        at = listed(f"{axis} = {number(_value(rows[0], axis))}" for axis in across)
        reason = f": {rows[0]['message']}" if rows[0]["message"] else ""
        lines.append(f"{count(len(rows), 'start')} {why}, the first at {at}{reason}.")
    return Notice("warning", "Starts that belong to no motion", tuple(lines))
