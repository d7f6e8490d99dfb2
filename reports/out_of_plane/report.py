"""The report of `campaigns.out_of_plane`: what is said, in which order. Everything comes from the campaign's folder."""

from __future__ import annotations

from pathlib import Path

from ..buoy_sweep.tables import accuracy_items
from ..parts.content import Heading, Item, Notice, Report, Text
from ..parts.folder import Folder, FolderError, read_folder
from ..parts.provenance import provenance_items, scene_table, timing_table
from ..parts.wording import count, decimals, listed, number
from .answer import answer_items
from .comparison import comparison_items, read_pairs
from .runs import NEEDED, VARIED, Run, Study, read_study
from .sections import growth_items, history_items, push_items
from .varied import dependence_items, direction_items, grid_items, shape_items
from .words import speed

_RUNS = (
    *VARIED[:-1], "periods", "status", "buoy_motion", "rope_motion", "max_turn_rad", "loop_releases",
    "newton_iterations", "wall_s",
)  # fmt: skip
_RESOLVED_RAD = 1.5707963267948966  # a quarter of a turn in one element


def report(directory: str | Path) -> Report:
    """The content of the report on an out-of-plane folder. Raises FolderError for a folder that is not one."""
    folder = read_folder(directory, NEEDED)
    base = folder.provenance.get("base")
    if not isinstance(base, dict) or set(base) != set(VARIED) or "transient" not in folder.provenance:
        raise FolderError(folder.directory, ["provenance.json cannot be read: it does not name base and transient"])
    study = read_study(folder)
    pairs = read_pairs(study)
    items = [
        Heading("Question"),
        Text(
            "Waves of one direction move a tethered buoy in a plane. Is that plane stable? The paper (Tjavaras, Zhu, "
            "Liu, Triantafyllou and Yue, “The mechanics of highly-extensible cables”, Journal of Sound and Vibration "
            "213(4), 1998, section 4.2.2 and figure 20) pushes the buoy across the waves by 1e-5 m/s and reports that "
            "the motion across the plane does not grow at kA = 0.016, and that at kA = 0.13 it grows exponentially and "
            "becomes comparable with the motion in the plane. Here buoy and rope are looked at apart."
        ),
        Heading("Short answer"),
        *answer_items(study, pairs),
        *history_items(study),
        *growth_items(study),
        *push_items(study),
        *dependence_items(study),
        *direction_items(study),
        *grid_items(study),
        *shape_items(study),
        *comparison_items(study, pairs),
        *accuracy_items(folder.directory),
        Heading("Warnings"),
        *_warnings(study),
        Heading("Table of runs"),
        study.table(_RUNS, study.runs, "Every run."),
        *_scene_and_times(folder, study),
        *provenance_items(folder),
    ]
    title = folder.scene.title or folder.scene.name
    return Report("Tethered buoy: out of the plane of the waves", title, tuple(items))


def _warnings(study: Study) -> list[Item]:
    pushed = [run for run in study.runs if run.pushed]
    lost = [run for run in study.runs if run.ok and not study.folder.trajectory_path(run["run_key"]).exists()]
    kinds = (
        ("Runs that failed", [run for run in study.runs if not run.ok], _end),
        ("Runs without a trajectory", lost, lambda run: "its trajectory is missing; figures leave it out"),
        (
            "Loops released in three dimensions",
            [run for run in pushed if run["loop_releases"] > 0],
            lambda run: count(int(run["loop_releases"]), "release"),
        ),
    )
    boxes = [
        Notice("warning", title, tuple(f"{_name(run)}: {said(run)}." for run in runs))
        for title, runs, said in kinds
        if runs
    ]
    coarse = [run for run in pushed if run["max_turn_rad"] > _RESOLVED_RAD]
    if coarse:
        grids = sorted({int(run["nodes"]) for run in coarse})
        fine = sorted({int(run["nodes"]) for run in pushed} - set(grids))
        lines = [
            f"In {count(len(coarse), 'run')} ({listed(map(str, grids))} nodes) an element turns by more than π/2, at "
            f"most by {decimals(max(run['max_turn_rad'] for run in coarse), 2)} rad: the loops there are not resolved, "
            "and sizes of single bursts carry the error that the section on the grid shows."
        ]
        if fine:
            lines.append(f"No element turns that far on {listed(map(str, fine))} nodes.")
        boxes.append(Notice("warning", "Turns within one element", tuple(lines)))
    return boxes or [
        Notice("note", "Nothing to warn of", ("No run failed, no loop was released, and every turn is resolved.",))
    ]


def _end(run: Run) -> str:
    return f"{run['status']}: {run['message']}" if run["message"] else run["status"]


def _name(run: Run) -> str:
    planar = "planar" if run["dimensions"] == 2 else f"push {speed(run['seed_mps'])} {run['seed_direction']}"
    return (
        f"kA = {number(run['steepness'])}, H = {number(run['depth_m'])} m, EI = {number(run['bending_stiffness_Nm2'])} "
        f"N m², {number(run['nodes'])} nodes, {planar}"
    )


def _scene_and_times(folder: Folder, study: Study) -> list[Item]:
    swept = {
        "waves.steepness": listed(number(value) for value in study.steepnesses),
        "water.depth_m": _values(study, "depth_m"),
        "tether.bending_stiffness_Nm2": _values(study, "bending_stiffness_Nm2"),
        "tether.nodes": _values(study, "nodes"),
        "motion.dimensions": _values(study, "dimensions"),
        "start.buoy_velocity_mps": "see the table of runs",
    }
    if any(run.known("offplane_growth_bits_per_period") for run in study.runs):
        swept |= {"output.tangent_vectors": "1 in planar runs", "output.lateral_growth": "yes in planar runs"}
    if any(run["profiles"] for run in study.runs):
        swept["output.profiles"] = "yes in one run"
    caption = "The scene, from `scene.toml`; defaults are those of the scene `tethered_buoy`."
    table = scene_table(folder.scene, "tethered_buoy", swept, caption)
    times = timing_table(folder)
    return [*([Heading("Run times"), times] if times else []), Heading("Scene"), table]


def _values(study: Study, key: str) -> str:
    return listed(number(value) for value in sorted({run[key] for run in study.runs}))
