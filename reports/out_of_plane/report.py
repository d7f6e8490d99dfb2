"""The report of `campaigns.out_of_plane`: what is said, in which order. Everything comes from the campaign's folder."""

import math
from pathlib import Path

from tables import COST, RUNS, count, listed, number

from ..parts import (
    LONGEST_CELL,
    Heading,
    Items,
    Notice,
    Report,
    entries,
    picture_first,
    report_page,
    scene_items,
    section_items,
    shown_on,
    timing_items,
)
from ..sweep.quantities import batched
from . import sections
from .runs import VARIED, Run, Study, columns_of_bodies, read_study

_MOST = 18  # columns of one table
_RESOLVED_RAD = 0.5 * math.pi  # in one element


def report(directory: Path) -> Report:
    """The content of the report on an out-of-plane folder. Raises FolderError for a folder that is not one."""
    study = read_study(directory)
    items = [
        section_items("out_of_plane"),
        sections.statement_items(study),
        sections.growth_items(study),
        sections.dependence_items(study),
        sections.comparison_items(study),
        Heading("Warnings"),
        _warnings(study),
        Heading("Table of runs"),
        _runs_tables(study),
    ]
    title = "Tethered buoy: out of the plane of the waves"
    return report_page(study.folder, title, picture_first(items), _scene_and_times(study))


def _runs_tables(study: Study) -> Items:
    columns = study.folder.columns
    named = [*VARIED[:-1], "periods", "status", *columns_of_bodies("motion")]
    others = shown_on(columns, study.runs, RUNS, COST, longest=LONGEST_CELL)
    for names in batched(list(dict.fromkeys([*named, *others])), _MOST):
        yield study.table(names, study.runs, "Every run.")


def _warnings(study: Study) -> Items:
    pushed = [run for run in study.runs if run.pushed]
    coarse = [run["nodes"] for run in pushed if run["max_turn_rad"] > _RESOLVED_RAD]
    failed, lost, looped, turned = [], [], [], []
    for run in study.runs:
        if not run.ok:
            reason = ": ".join(filter(None, (run["status"], run["message"])))
            failed.append(f"{_name(run)}: {reason}.")
        elif not study.folder.trajectory_path(run["run_key"]).exists():
            lost.append(f"{_name(run)}: its trajectory is missing; figures leave it out.")
    for run in pushed:
        if run["loop_releases"] > 0:
            looped.append(f"{_name(run)}: {count(int(run['loop_releases']), 'release')}.")
    unresolved = "an element turns by more than π/2: loops are not resolved, and the sizes of bursts depend on the grid"
    for nodes in sorted(set(coarse)):
        turned.append(f"{count(coarse.count(nodes), 'run')} on {number(nodes)} nodes: {unresolved}.")
    boxes = {
        "Runs that failed": failed,
        "Runs without a trajectory": lost,
        "Loops released in three dimensions": looped,
        "Turns within one element": turned,
    }
    for title, lines in boxes.items():
        if lines:
            yield Notice("warning", title, lines)
    if not any(boxes.values()):
        nothing = "No run failed, no loop was released, and every turn is resolved."
        yield Notice("note", "Nothing to warn of", (nothing,))


def _name(run: Run) -> str:
    pushed = f"push {number(run['seed_mps'])} m/s {run['seed_direction']}" if run["dimensions"] == 3 else "planar"
    return (
        f"kA = {number(run['steepness'])}, H = {number(run['depth_m'])} m, EI = {number(run['bending_stiffness_Nm2'])} "
        f"N m², {number(run['nodes'])} nodes, {pushed}"
    )


def _scene_and_times(study: Study) -> Items:
    yield timing_items(study.folder)
    keys = {
        "steepness": "waves.steepness",
        "depth_m": "water.depth_m",
        "bending_stiffness_Nm2": "tether.bending_stiffness_Nm2",
        "nodes": "tether.nodes",
        "dimensions": "motion.dimensions",
    }
    varied = {}
    for name, key in keys.items():
        varied[key] = listed(map(number, sorted(set(entries(study.runs, name)))))
    varied["start.buoy_velocity_mps"] = "see the table of runs"
    if any(run.known("offplane_growth_bits_per_period") for run in study.runs):
        varied |= {"output.tangent_vectors": "1 in planar runs", "output.lateral_growth": "yes in planar runs"}
    if any(entries(study.runs, "profiles")):
        varied["output.profiles"] = "yes in one run"
    yield scene_items(study.folder.scene, "tethered_buoy", varied)
