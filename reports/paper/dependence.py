"""What the paper leaves out: the list of it, and how much of the answer of section 4.2 hangs on each choice."""

import math
import tomllib
from itertools import chain
from pathlib import Path

import numpy as np

from engine import Scene, load_scene
from engine.natural_frequencies import natural_frequencies
from tables import EMPTY, PERIODIC, TANGENT_ERROR, TANGENT_EXPONENT, Column, by_columns, number, percent

from ..figures.curves import COLOURS, Curve, Panel, curves, dots
from ..out_of_plane.report import comparison_items
from ..out_of_plane.runs import read_study
from ..parts import (
    Figure,
    Folder,
    FolderError,
    Heading,
    Items,
    Picture,
    Row,
    Table,
    Text,
    entries,
    having,
    heads,
    plus_minus,
    provenance_of,
    read_files,
    series,
    table_of,
)
from ..parts.style import INK, kind_of

BESIDE = 0.14  # of the space between two values
DASHES = ("-", "--", ":", "-.", "-")
MARKS = {PERIODIC: "o", "quasi-periodic": "s", "chaotic": "*", "transient": "v", "undecided": "x", "": "+"}
Exponents = tuple[str, list[Row]]  # the name of a curve, and the rows of the table on it
Panels = list[list[tuple[str, list[Exponents]]]]  # rows and columns of them, each (title, curves)
TREATMENTS = {
    "extrapolate": "linear waves continued above still water",
    "zero": "no water above still water",
    "wheeler": "stretched to the surface after Wheeler",
    "full": "buoyancy and wave load of the whole sphere always",
    "spherical-cap": "of the wetted part",
}
ABOVE, DROWNED, EI, DEPTH = "above_still_water", "submergence", "bending_stiffness_Nm2", "depth_m"
_FILES = {"table.csv": "the runs", "columns.csv": "what its columns are"}
SHORT = (
    "To run section 4 one has to choose what the paper does not say. The first table lists the choices of the shipped "
    "scenes; the rest of this section shows what becomes of the answer with others."
)


def dependence_items(folder: Folder) -> Items:
    """The section, from the parts of the paper's folder."""
    items = [Heading("What the paper leaves out"), Text(SHORT), _gaps(folder.directory, folder.scene)]
    try:
        files = read_files(folder.directory / "dependence", _FILES)
    except FolderError:
        return [*items, Text("The part `dependence` is not there, so nothing is shown of what follows from them.")]
    columns = files["columns.csv"]
    rows = list(by_columns(files["table.csv"], columns))
    items += [Heading("Depth, waves above still water, buoyancy out of the water", 2), _depth_figure(rows)]
    for steepness in _steepnesses(rows):
        items.append(_regimes(rows, columns, steepness))
    return [*items, *_stiffness(rows, columns), *_plane(folder.directory / "out_of_plane")]


def _gaps(directory: Path, scene: Scene) -> Table:
    line, tether = load_scene("breaking_line").tether, scene.tether
    modes, tolerance = natural_frequencies(scene), provenance_of(directory / "buoy").get("strobe_tolerance", math.nan)
    out_m, side = math.nan, "below"  # of the water: the top of the sphere at rest
    if modes is not None:
        out_m = tether.length_m * (1.0 + modes.static_strain) + 0.5 * scene.buoy.diameter_m - scene.water.depth_m
    if out_m > 0.0:
        side = "above"
    words = {
        "out": number(abs(out_m), 2),
        "side": side,
        "waves": TREATMENTS[scene.waves.above_still_water],
        "buoyancy": TREATMENTS[scene.buoy.submergence],
        "tolerance": percent(tolerance),
    }
    return written("gaps", scene=scene, line=line, **words)


def written(name: str, **taken: object) -> Table:
    """A table of tables.toml by its name, which no run decides; taken: what stands in braces there."""
    texts = tomllib.loads(Path(__file__).with_name("tables.toml").read_text(encoding="utf-8"))[name]
    rows = []
    for row in texts["rows"]:
        rows.append([cell.format(**taken) for cell in row])
    return Table(heads(*texts["heads"]), rows, texts["caption"])


def _steepnesses(rows: list[dict]) -> list[float]:
    return sorted(set(entries(rows, "steepness")))


def _like(rows: list[dict], **wanted) -> list[dict]:
    """Rows that are as the scene as shipped, which leads the study, but for depth and what is wanted, by depth."""
    shipped = rows[0]
    wanted = {ABOVE: shipped[ABOVE], DROWNED: shipped[DROWNED], EI: shipped[EI]} | wanted
    matching = [row for row in rows if wanted.items() <= row.items()]
    return sorted(matching, key=lambda row: (row[DEPTH], row[EI]))


def _depth_figure(rows: list[dict]) -> Figure:
    waves, drowned = _treatments(rows, ABOVE), _treatments(rows, DROWNED)
    panels = []
    for kA in _steepnesses(rows):
        panels.append([])
        for under in drowned:
            curves = []
            for above in waves:
                members = _like(rows, steepness=kA, **{ABOVE: above, DROWNED: under})
                curves.append((f"waves: {above}", having(members, status="ok")))
            panels[-1].append((f"kA = {number(kA)}, buoyancy {under}", curves))
    treatments = "; ".join(f"`{word}`: {TREATMENTS.get(word, word)}" for word in (*waves, *drowned))
    caption = (
        "Largest Lyapunov exponent (tangent dynamics, one standard error) over the water depth, which the paper does "
        "not give (depths evenly spaced), for the treatments of waves above still water (colours) and of buoyancy "
        f"(columns); marks tell the regime. {treatments}. From `dependence/table.csv`."
    )
    alt = f"Exponent over water depth in {len(panels)} rows of panels, marked by regime."
    return Figure(depth_exponents(panels, DEPTH, r"$H$ (m)"), caption, alt)


def _treatments(rows: list[dict], key: str) -> list[str]:
    """The words of a column, each once, in the order of the table."""
    return list(dict.fromkeys(entries(rows, key)))


def _regimes(rows: list[dict], quantities: dict[str, Column], steepness: float) -> Table:
    pairs = dict.fromkeys((row[ABOVE], row[DROWNED]) for row in rows)
    column_heads, rows_by_depth, depths = [("H", "m")], [], set()
    for above, under in pairs:
        matching = _like(rows, steepness=steepness, **{ABOVE: above, DROWNED: under})
        by_depth = {row[DEPTH]: row for row in matching}
        column_heads.append(f"{above}, {under}")
        rows_by_depth.append(by_depth)
        depths.update(by_depth)
    body = []
    for H in sorted(depths):
        cells = [_cell(by_depth.get(H), quantities) for by_depth in rows_by_depth]
        body.append((number(H), *cells))
    caption = (
        f"Regime and largest exponent, bits per wave period, at kA = {number(steepness)}, by depth, treatment of the "
        "waves above still water and of buoyancy."
    )
    return Table(heads(*column_heads), body, caption)


def _cell(row: dict | None, columns: dict[str, Column]) -> str:
    if row is None:
        return EMPTY
    if row["status"] != "ok":
        return row["status"]
    regime = row["regime"] or "no verdict"
    if not math.isfinite(row[TANGENT_EXPONENT]):
        return regime
    return f"{regime}, {plus_minus(columns[TANGENT_EXPONENT], columns[TANGENT_ERROR])(row)}"


def _stiffness(rows: list[dict], columns: dict[str, Column]) -> Items:
    shipped = rows[0]
    usual, varied = {}, set()  # rows with the shipped treatments by (kA, H); those of them with several stiffnesses
    for row in rows:
        if row[ABOVE] == shipped[ABOVE] and row[DROWNED] == shipped[DROWNED]:
            place = (row["steepness"], row[DEPTH])
            usual.setdefault(place, []).append(row)
            if row[EI] != shipped[EI]:
                varied.add(place)
    heading = Heading("Bending stiffness", 2)
    if not varied:
        return [heading, Text("The stiffness was not varied.")]
    panel, shown = {}, []
    for kA, H in sorted(varied):
        by_stiffness = sorted(usual[kA, H], key=lambda row: row[EI])
        panel.setdefault(f"kA = {number(kA)}", []).append((f"H = {number(H)} m", having(by_stiffness, status="ok")))
        shown += by_stiffness
    caption = (
        "Largest exponent over the bending stiffness of the tether, which the paper does not give. A positive exponent "
        "of a run whose buoy repeats its motion belongs to the folds of the slack rope. From `dependence/table.csv`."
    )
    picture = depth_exponents([list(panel.items())], EI, r"$EI$ (N m$^2$)", log=True)
    names = ("steepness", DEPTH, EI, "status", "radius_min_m", "radius_max_m", "regime", TANGENT_EXPONENT)
    table = table_of(columns, names, shown, "What the bending stiffness changes.")
    return [heading, Figure(picture, caption, "Exponent over bending stiffness, at each depth a curve."), table]


def _plane(part: Path) -> Items:
    heading = Heading("Two dimensions or three", 2)
    try:
        study = read_study(part)
        return [heading, *list(comparison_items(study))[1:]]
    except FolderError:
        return [heading, Text("The part `out_of_plane` is not there.")]


def depth_exponents(panels: Panels, key: str, label: str, log: bool = False) -> Picture:
    """The panels over the column `key`, on an axis with that label: lines with error bars, marked by regime.

    Its values are evenly spaced, and curves beside each other, so that marks do not hide marks; with `log` both stay
    where they are, on a logarithmic axis.
    """
    everything = []
    for _, exponents in chain.from_iterable(panels):
        for _, members in exponents:
            everything += members
    values, kinds = np.unique(series(everything, key)), set(map(kind_of, entries(everything, "regime")))
    meanings, nothing = [], np.empty(0)  # of the marks, as curves without points
    for kind, mark in MARKS.items():
        if kind in kinds:
            meanings.append(dots(nothing, nothing, mark, INK, name=kind.replace(PERIODIC, "periodic") or "no verdict"))
    axis, ticks = "x", {}
    if not log:
        axis, ticks = "", {"xticks": range(len(values)), "xticklabels": list(map(number, values))}
    rows = []
    for row in panels:
        drawn = []
        for title, exponents in row:
            lines = []
            for k, (name, members) in enumerate(exponents):
                at, colour, dash = series(members, key), COLOURS[k % len(COLOURS)], DASHES[k % len(DASHES)]
                if not log:
                    at = np.searchsorted(values, at) + BESIDE * (k - 0.5 * (len(exponents) - 1))
                exponent = series(members, TANGENT_EXPONENT)
                lines.append(Curve(at, exponent, name, dash, "", colour, series(members, TANGENT_ERROR)))
                kinds = np.array(list(map(kind_of, entries(members, "regime"))), object)
                for kind, mark in MARKS.items():
                    chosen = kinds == kind
                    if chosen.any():
                        size = 7.0 if mark == "*" else 4.5
                        lines.append(dots(at[chosen], exponent[chosen], mark, colour, size))
            y_label = "" if drawn else r"$\sigma$ (bits per $T_i$)"
            x_label = label if row is panels[-1] else ""
            drawn.append(Panel([*lines, *meanings], x_label, y_label, title, axis, 0.0, ticks))
        rows.append(drawn)
    return curves(rows, 2.1 * len(rows) + 0.7, "below", "xy")
