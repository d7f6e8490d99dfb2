"""The report of `campaigns.out_of_plane`: what is said, in which order. Everything comes from the campaign's folder."""

import math
from collections.abc import Iterator
from pathlib import Path

from ..parts.content import Heading, Item, Notice, Report
from ..parts.provenance import report_page, scene_items, timing_items
from ..parts.sections import section_items
from ..parts.selecting import entries
from ..parts.wording import count, listed, number
from ..sweep.quantities import further
from . import sections
from .runs import VARIED, Run, Study, of_bodies, read_study

_RUNS = (
    *VARIED[:-1], "periods", "status", "buoy_motion", "rope_motion", "max_turn_rad", "loop_releases",
    "newton_iterations", "wall_s",
)  # fmt: skip
_MEASURED = (
    "rate_bits_per_period rate_error rate_nats_per_period fit_from_period fit_to_period fit_span_nats bursts "
    "burst_median_m burst_max_m first_burst_period first_burst_m rise_nats rise_periods lateral_late_m "
    "share_of_inplane early_gain_s"
).split()
# columns for which this report has chosen a place, or none: those stand in table.csv alone
_PLACED = {*of_bodies(*_MEASURED), *VARIED, "inplane_m", "bow_inplane_m", "bow_lateral_m"}
_RESOLVED_RAD = 0.5 * math.pi  # in one element


def report(directory: str | Path) -> Report:
    """The content of the report on an out-of-plane folder. Raises FolderError for a folder that is not one."""
    study = read_study(directory)
    items = [
        *section_items("out_of_plane", "Question"),
        *sections.statement_items(study),
        *sections.growth_items(study),
        *sections.dependence_items(study),
        *sections.comparison_items(study),
        Heading("Warnings"),
        *_warnings(study),
        Heading("Table of runs"),
        study.table((*_RUNS, *further(study.folder.columns, _PLACED)), study.runs, "Every run."),
    ]
    return report_page(study.folder, "Tethered buoy: out of the plane of the waves", items, _scene_and_times(study))


def _warnings(study: Study) -> Iterator[Item]:
    pushed = [run for run in study.runs if run.pushed]
    coarse = [run["nodes"] for run in pushed if run["max_turn_rad"] > _RESOLVED_RAD]
    failed, lost, looped, turned = [], [], [], []
    for run in study.runs:
        if not run.ok:
            failed.append(f"{_name(run)}: {_end(run)}.")
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
            yield Notice("warning", title, tuple(lines))
    if not any(boxes.values()):
        nothing = "No run failed, no loop was released, and every turn is resolved."
        yield Notice("note", "Nothing to warn of", (nothing,))


def _end(run: Run) -> str:
    return ": ".join(filter(None, (run["status"], run["message"])))


def _name(run: Run) -> str:
    pushed = f"push {number(run['seed_mps'])} m/s {run['seed_direction']}" if run["dimensions"] == 3 else "planar"
    return (
        f"kA = {number(run['steepness'])}, H = {number(run['depth_m'])} m, EI = {number(run['bending_stiffness_Nm2'])} "
        f"N m², {number(run['nodes'])} nodes, {pushed}"
    )


def _scene_and_times(study: Study) -> Iterator[Item]:
    yield from timing_items(study.folder)
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
    yield from scene_items(study.folder.scene, "tethered_buoy", varied)
