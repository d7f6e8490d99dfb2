"""The report of `campaigns.basins`: what is said, in which order. Everything comes from the campaign's folder."""

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.colors import to_rgba
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke

from tables import FAILED, REGIMES, RUNS, count, listed, number, of_kicks

from ..figures.curves import Curve, Panel, curves
from ..figures.orbit_diagram import NARROW_IN, cell_edges
from ..figures.quantities import colours_of
from ..figures.regime_map import widest
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
    batched,
    filled_table,
    having,
    limits,
    read_folder,
    report_page,
    section_items,
    shown_on,
    table_of,
)
from ..parts.style import BLUE, INK, SHADES, WIDTH_IN, picture_of, sheet

_AXES = {
    "vx": ("kick_x_mps", "velocity along x (m/s)"),
    "vz": ("kick_z_mps", "velocity upwards (m/s)"),
    "x": ("displacement_x_m", "place along x, from rest (m)"),
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
_OPEN = {"unsettled": "x", "failed": "P"}  # marks of starts that belong to no motion
_HALO = [withStroke(linewidth=2.0, foreground="white")]
_MOST = 14  # columns of one table
_PERIODS = 8  # of a motion without a period, drawn


def report(directory: Path) -> Report:
    """The content of the report on a folder of basins. Raises FolderError for a folder that is not one."""
    folder = read_folder(directory, ("motion", "outcome", "status"))
    across = folder.provenance.get("across")
    if not isinstance(across, list) or not set(across) <= set(_AXES):
        raise FolderError(folder.directory, "provenance.json cannot be read: it does not name what was varied")
    motion_runs, shock, edge = [folder.part(name) for name in ("motions", "shock", "edge")]
    motions = [row for row in motion_runs.table if row["motion"]]
    items = [_map(folder, across, motions, shock), section_items("basins")]
    if motions:
        items.append(_motions(motion_runs, motions, edge))
    if shock.table:
        items += [Heading("The smallest start"), filled_table(shock, _SMALLEST)]
    if edge.table:
        items += [Heading("The edge state"), Text(_EDGE), filled_table(edge, "The edge state.")]
    items += [Heading("Warnings"), _warnings(folder, across)]
    return report_page(folder, "Basins: which start ends in which motion", items)


def _colours(motions) -> dict[str, str]:
    return colours_of(motions) or {str(row["motion"]): BLUE for row in motions}


def _value(row, axis: str, scene) -> float:
    """Of a start on an axis; of its phase the time to the next crest over the anchor, in wave periods."""
    from engine.physics.sea import crest_share

    column, _ = _AXES[axis]
    value = float(row[column])
    if axis == "phase":
        return crest_share(scene, value)
    return value


def _map(folder: Folder, across: list[str], motions, shock: Folder) -> Items:
    x, columns = np.unique([_value(row, across[0], folder.scene) for row in folder.table], return_inverse=True)
    y, rows = np.unique([_value(row, across[1], folder.scene) for row in folder.table], return_inverse=True)
    ended = np.full((len(y), len(x)), "", dtype=object)
    for row, up, right in zip(folder.table, rows, columns, strict=True):
        ended[up, right] = row["motion"] or _outcome(row)
    colours, names = _colours(motions), {}
    colours.pop("", None)
    for row in motions:
        letter, regime = str(row["motion"]), row["regime"] or row["status"]
        names[letter] = f"{letter}: {regime}, {number(row['tension_top_max_N'] / 1e3, 3)} kN"
    caption = (
        "Motion in which each start of the grid ends, with its largest tension (`table.csv`, `motions/table.csv`)."
    )
    arrow = _arrow(across, shock, folder.scene)
    if arrow is not None:
        caption += " Arrow: the smallest start that leads to the motion of the largest tension."
    alt = f"Map of {count(len(folder.table), 'start')}, a colour a motion; shares in the text."
    pictures = []
    for width_in, height_in in ((WIDTH_IN, 0.62 * WIDTH_IN), (NARROW_IN, 0.9 * NARROW_IN)):
        with sheet(0.5 + height_in, width_in) as figure:
            axes = figure.subplots()
            _draw(axes, (x, y), ended, across, colours, arrow)
            handles = [Patch(facecolor=colour, label=names[letter]) for letter, colour in colours.items()]
            handles += axes.get_legend_handles_labels()[0]
            figure.legend(handles=handles, loc="outside upper left", ncols=max(1, int(width_in / 2.2)))
            pictures.append(picture_of(figure))
    yield Figure(pictures[0], caption, alt, narrow=pictures[1])


def _draw(axes, places: tuple[np.ndarray, np.ndarray], ended: np.ndarray, across: list[str], colours, arrow) -> None:
    """The grid as cells in the colours of its motions, each with its letter where it is widest.

    places: values of the starts (p,) and (q,). ended: (q, p) letters of motions, or keys of _OPEN.
    """
    x, y = places
    shades = np.zeros((*ended.shape, 4))
    for letter, colour in colours.items():
        shades[ended == letter] = to_rgba(colour)
    axes.grid(False)
    axes.pcolormesh(cell_edges(x), cell_edges(y), shades, rasterized=True)
    axes.set_facecolor(SHADES[-1])
    size = max(2.0, min(6.0, 160.0 / len(x)))
    for word, mark in _OPEN.items():
        rows, columns = np.nonzero(ended == word)
        if len(rows):
            axes.plot(x[columns], y[rows], mark, color=INK, markersize=size, label=word, linestyle="")
    for letter in colours:
        inside = ended == letter
        if arrow is not None:
            off_the_arrow = inside & _aside(x, y)
            if off_the_arrow.any():
                inside = off_the_arrow
        cell = widest(inside)
        if cell is not None:
            look = {"fontsize": 13, "weight": "bold", "path_effects": _HALO}
            axes.text(x[cell[1]], y[cell[0]], letter, ha="center", va="center", **look)
    if arrow is not None:
        end, text = arrow
        begin = (0.0, end[1] if across[1] == "phase" else 0.0)
        axes.plot(*begin, "o", color="white", markeredgecolor=INK, markersize=4.5)
        look = {"arrowstyle": "-|>", "color": INK, "linewidth": 1.4, "shrinkA": 0.0, "shrinkB": 0.0}
        axes.annotate("", tuple(end), begin, arrowprops=look).arrow_patch.set_path_effects(_HALO)
        _arrow_text(axes, text, begin, end)
    axes.set(xlabel=_AXES[across[0]][1], ylabel=_AXES[across[1]][1])


def _arrow_text(axes, text: str, begin: Sequence[float], end: Sequence[float]) -> None:
    """The text of an arrow beside its head, on the side that the arrow points to."""
    (across, up), (x_offset, y_offset), look = np.subtract(end, begin), (6.0, 3.0), {"ha": "left", "va": "bottom"}
    if across < 0.0:
        x_offset, look["ha"] = -x_offset, "right"
    if up < 0.0:
        y_offset, look["va"] = -y_offset, "top"
    offset = (x_offset, y_offset)
    axes.annotate(text, tuple(end), offset, textcoords="offset points", path_effects=_HALO, weight="bold", **look)


def _aside(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Which cells (q, p) are not near the places of no kick at all."""
    x, y = (values / max(np.abs(values).max(), 1e-9) for values in (x, y))
    if y.min() >= 0.0:  # a time: without a kick it makes no difference
        y = np.zeros_like(y)
    return np.hypot(x[None, :], y[:, None]) > 0.15


def _outcome(row) -> str:
    """What is said of a start that belongs to no motion."""
    if row["status"] != "ok":
        return FAILED
    return row["outcome"]


def _arrow(across: list[str], shock: Folder, scene) -> tuple[list[float], str] | None:
    """(where the smallest start to the largest tension is on the map, its size in words); None without one."""
    starts = having(shock.table, status="ok")
    if not starts or not starts[0]["size"] > 0.0:
        return None
    unit = "m" if "x" in across else "m/s"
    return [_value(starts[0], axis, scene) for axis in across], f"{number(starts[0]['size'], 2)} {unit}"


def _motions(part: Folder, motions, edge: Folder) -> Items:
    yield Heading("Motions")
    shown = shown_on(part.columns, motions, RUNS, REGIMES, longest=LONGEST_CELL)
    for names in batched([name for name in shown if name not in ("steepness", "motion")], _MOST):
        yield table_of(part.columns, ["motion", *names], motions, _JUDGED, {"share": of_kicks})
    for row in motions:
        if row["confirmed"]:
            yield Text(f"Motion {row['motion']}, when it goes on from its state, is found {row['confirmed']}.")
    colours, lines = _colours(motions), []
    for row in motions:
        lines += _loop(part, row, name=row["motion"], colour=colours[row["motion"]])
    for row in edge.table:
        lines += _loop(edge, row, name="edge state", line=(0, (3, 1)), colour=INK)
    if lines:
        caption = "Radial speed over r, of the last periods of each motion and of the edge state between two of them."
        picture = curves([[Panel(lines, "r (m)", "dr/dt (m/s)")]], 3.4, "right")
        yield Figure(picture, caption, f"Phase portrait of {listed(line.name for line in lines)}.")


def _loop(folder: Folder, row, **look) -> list[Curve]:
    """The last periods of a run: one orbit, or a few; nothing without its file. look: of the curve."""
    run, _ = folder.trajectory(row)
    if run is None:
        return []
    period = row["strobed_period"]
    samples_per_period = round(run.scene.waves.period_s / run.scene.sample_step_s())
    periods, width = _PERIODS, 0.5
    if math.isfinite(period):
        periods, width = int(period), 1.2
    last = slice(-periods * samples_per_period - 1, None)
    radius, rate = run.columns["radius_m"][last], run.columns["radius_rate_mps"][last]
    return [Curve(radius, rate, width=width, **look)]


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
        place = listed(f"{axis} = {number(_value(first, axis, folder.scene))}" for axis in across)
        line = f"{count(len(rows), 'start')} {outcome}, the first at {place}"
        if first["message"]:
            line += f": {first['message']}"
        lines.append(f"{line}.")
    return limits("Starts that belong to no motion", lines, "Every start has settled or joined a known motion.")
