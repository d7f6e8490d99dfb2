"""The report of `campaigns.breaking_line`: what is said, in which order. Everything comes from its folder."""

from functools import partial
from pathlib import Path

import xarray

from tables import count, decimals, listed, number, percent, verdict_counts

from ..figures.line_panels import named
from ..parts import (
    Folder,
    Heading,
    Items,
    Notice,
    Report,
    Text,
    flat,
    picture_first,
    read_folder,
    read_statements,
    report_page,
    scene_items,
    section_items,
    statements_table,
    timing_items,
)
from . import figures
from .runs import FAST, KINDS, SLOW, Line, of_kind, read_exact, read_lines, series_table, table_of_runs

ANIMATED = "4"
MOST_TURN_RAD = 0.6
CLOSED = 1e-3  # of the stored energy
THEORY = (
    "Without gravity and bending the line is a one-dimensional elastic wave. The unloading that leaves the broken end "
    "is a simple wave: every tension runs at its own speed √(T′/m). Where the law is concave, above its inflection, "
    "lower tensions are faster than higher ones: the front steepens, and a shock forms that obeys the conditions of "
    "Rankine and Hugoniot. The exact solution follows characteristics and fits the shock between them "
    "(`campaigns/breaking_line/theory`)."
)
BUDGET = (
    "Work and dissipation are added up step by step from the equations that each step solves: the force at the end, "
    "the shock viscosity, the shear forces (bending has no potential in the paper's equations where the strain "
    "varies), and what the scheme itself dissipates in space and in time. The remainder tells how well the equations "
    "were solved."
)


def report(directory: Path) -> Report:
    """The content of the report on a breaking-line folder. Raises FolderError for a folder that is not one."""
    folder = read_folder(directory)
    lines, judged = read_lines(folder), read_statements(folder.directory)
    table = partial(table_of_runs, lines, folder.columns)
    verdicts = f"The paper's statements on the breaking line: {verdict_counts(judged)}. From `statements.csv`."
    of_cases = sum(line["kind"] == "case" for line in lines)
    ended = f"{len(of_kind(lines, 'case'))} of {count(of_cases, 'case')} ended as asked."
    exact = read_exact(folder)
    items = [
        exact and figures.speeds_figure(exact),
        section_items("breaking_line"),
        _section("The cases", table("cases"), _warnings(lines), text=ended),
        _section("Fast breaks", figures.paper_figures(lines, FAST)),
        _section("Slow breaks", figures.paper_figures(lines, SLOW)),
        _section("At the fixed end", figures.folds_figure(lines)),
        _section("In motion", figures.animation_figure(lines, ANIMATED)),
        _section("Fronts and shocks", _fronts(folder, lines, exact), text=THEORY),
        _section("Energy", figures.energy_figure(lines), table("energies"), text=BUDGET),
        _section("The paper's statements", statements_table(judged, verdicts)),
        _section("Bending stiffness", table("stiffness")),
        _section("Doubled grids", table("doubled")),
    ]
    solved = section_items("breaking_line_solved", "Equations", law=folder.scene.tether.tension.law)
    cases = listed(named(case) for case in folder.provenance.get("cases") or ["as asked"])
    varied = {"end.force_N": f"cases {cases}", "end.force_decay_s": "0.005 (1 to 4), 0.05 (1′ to 4′)"}
    scene = scene_items(folder.scene, "breaking_line", varied)
    made = [timing_items(folder, table("cost")), scene, solved]
    return report_page(folder, "The breaking synthetic line", picture_first(items), made)


def _section(heading: str, *items: Items, text: str = "") -> Items:
    """The items below their heading and text; nothing where there are none."""
    present = flat(items)
    if not present:
        return []
    return [Heading(heading), Text(text) if text else None, *present]


def _warnings(lines: list[Line]) -> Items:
    warnings = [f"{_run(line)}: {line['status']}: {line['message']}" for line in lines if not line.ok]
    for line in lines:
        if line.fault:
            warnings.append(f"Case {line.name}: {line.fault}; its figures are left out.")
    for line in lines:
        if line.ok and line["max_turn_rad"] > MOST_TURN_RAD:
            turn = decimals(line["max_turn_rad"], 2)
            warnings.append(
                f"{_run(line)} turns by {turn} rad within one element: its folds are not resolved, add nodes."
            )
    for line in of_kind(lines, "case"):
        if line.share("remainder_largest_J") > CLOSED:
            warnings.append(f"The energy budget of case {line.name} does not close to {percent(CLOSED)}.")
    if not warnings:
        return []
    return [Notice("warning", "What limits these runs", warnings)]


def _run(line: Line) -> str:
    run = f"Case {line.name}{KINDS.get(line['kind'], '')}"
    if line["kind"] == "stiffness":
        run += f", EI = {number(line['bending_stiffness_Nm2'])} N m²"
    return f"{run}, {number(line['nodes'])} nodes"


def _fronts(folder: Folder, lines: list[Line], exact: xarray.Dataset | None) -> Items:
    """Nothing where no case has a theory."""
    if not any(line.known("front_speed_theory_mps") for line in of_kind(lines, "case")):
        return []
    speeds, shocks = (table_of_runs(lines, folder.columns, kind) for kind in ("speeds", "shocks"))
    return [exact and figures.plane_figure(lines, exact), speeds, shocks, series_table(lines, folder.columns)]
