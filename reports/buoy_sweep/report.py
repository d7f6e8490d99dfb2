"""The report of `campaigns.buoy_sweep`: what is said, in which order. Everything comes from the campaign's folder."""

import math
from collections.abc import Iterable, Sequence
from pathlib import Path

from ..parts.content import Heading, Item, Notice, Report, Text
from ..parts.provenance import appendix, provenance_items
from ..parts.sections import section_items
from ..parts.wording import T_I, TAU_0, decimals, number, percent
from ..sweep.motions import every_motion
from ..sweep.quantities import extremes
from .figures import close_up_items, orbit_figure, regime_items
from .motions import motions_items
from .runs import PAPER_WINDOW, Run, Sweep, read_sweep
from .sheets import sheet_items
from .tables import plane_items, runs_items, scene_and_modes, time_items

_EXTREMES = (
    "slack_fraction", "tension_top_max_N", "radius_min_m", "radius_max_m", "loop_releases", "rope_lateral_max_m",
    "buoy_lateral_max_m",
)  # fmt: skip
_COARSE = 0.05  # of the largest tension, as in `campaigns.buoy_sweep.answer`
_OF_THESE = "Least and greatest value in the runs that ended as asked."
_RESOLVED_RAD = 0.5 * math.pi  # turn of one element beyond which a loop is no longer resolved
_NOTHING = (
    "No run failed, no loop was released, the buoy stayed in the water, tensions hold to 5 %, and every record "
    "lasts for eq. (31)."
)


def report(directory: str | Path) -> Report:
    """The content of the report on a buoy sweep's folder. Raises FolderError for a folder that is not one."""
    sweep = read_sweep(directory)
    scene, figure = sweep.folder.scene, orbit_figure(sweep)
    items = [
        figure or Text("No run gave strobed points after the transient, so there is no orbit diagram."),
        *motions_items(sweep),
        *_question(sweep),
        Heading("Warnings"),
        warnings(sweep),
        *regime_items(sweep),
        *every_motion(sweep.folder, "steepness", "kA"),
        *close_up_items(sweep),
        *plane_items(sweep),
        *runs_items(sweep),
        *sheet_items(sweep),
        *appendix(
            *time_items(sweep),
            *scene_and_modes(sweep),
            *section_items("buoy_sweep_solved", law=scene.tether.tension.law),
            *provenance_items(sweep.folder),
        ),
    ]
    return Report("Tethered buoy: a sweep of wave steepness", scene.title or scene.name, tuple(items))


def _question(sweep: Sweep) -> list[Item]:
    columns = sweep.folder.columns
    shown = [columns[name] for name in _EXTREMES if name in columns]
    keys = [columns[name] for name in ("steepness", *(["motion"] if sweep.colours else []))]
    items: list[Item] = [
        *section_items("buoy_sweep", "Question"),
        *extremes(keys, [run.row for run in sweep.good], shown, _OF_THESE),
    ]
    if sweep.judged:
        return items
    said = (
        "No run was judged. Without `--periods` runs last as long as their regime needs; with it, 135 wave periods are "
        "the least, and perturbations have to be carried (`output.tangent_vectors`)."
    )
    return [*items, Notice("note", "No verdict on regular or chaotic motion", (said,))]


def warnings(sweep: Sweep) -> Notice:
    """Everything that limits what the sweep may be used for; a plain note when there is nothing."""
    runs, scene = sweep.runs, sweep.folder.scene
    out = [run for run in runs if run["max_buoy_height_above_water_m"] > scene.buoy.diameter_m]
    higher_m = max((run["max_buoy_height_above_water_m"] for run in out), default=0.0) - scene.buoy.diameter_m
    unread = [run for run in runs if run.fault]
    first = {run["status"]: run for run in reversed(runs) if not run.ok}
    strain = sweep.modes.static_strain if sweep.modes else -1.0
    dry_m = scene.anchor.position_m[2] + scene.tether.length_m * (1.0 + strain)
    dry_m += 0.5 * scene.buoy.diameter_m - scene.water.depth_m
    failed = [
        (f"{status}; the first after {number(run.periods_done, 3)} periods: {run['message'] or 'no message'}",
         [run for run in runs if run["status"] == status])
        for status, run in first.items()
    ]  # fmt: skip
    kinds = (
        *failed,
        (f"{unread[0].fault if unread else ''} (of the first); figures and strobed values leave such runs out", unread),
        ("loops were released; a rope free to leave the plane does not need it (`--dimensions auto`), see “Out of the "
         "plane”", [run for run in runs if run["loop_releases"] > 0]),
        ("axial ringing of the line is not resolved; column message says how far tensions hold, and when",
         [run for run in runs if "not resolved" in (run["message"] or "")]),
        (f"largest tensions hold to no better than {percent(_COARSE)} (column ± T_max)",
         [run for run in runs if run["tension_top_max_error_N"] > _COARSE * run["tension_top_max_N"]]),
        ("nothing is known of the error of the largest tension (column ± T_max)",
         [run for run in sweep.good if not run.known("tension_top_max_error_N")]),
        ("with smaller elements and steps the motion becomes another one (column message)",
         [run for run in runs if "becomes another motion" in (run["message"] or "")]),
        ("in three dimensions an element turns by more than π/2: its loops are not resolved, add `tether.nodes`",
         [run for run in runs if run.in_space and run["max_turn_rad"] > _RESOLVED_RAD]),
        (f"already at rest the top of the buoy is {decimals(dry_m, 2)} m above still water",
         runs if dry_m > 0.0 else ()),
        (f"the whole sphere rises above still water, its lowest point by up to {decimals(higher_m, 2)} m. There "
         f"`buoy.submergence` = {scene.buoy.submergence} and `waves.above_still_water` = "
         f"{scene.waves.above_still_water} matter", out),
        (f"shorter than the {sum(PAPER_WINDOW)} wave periods of eq. (31) with {TAU_0} = {PAPER_WINDOW[0]} {T_I} and "
         f"n = {PAPER_WINDOW[1]}: spectra are of the last half of the record, and hold more of the transient",
         [run for run in sweep.good if run.periods_done < sum(PAPER_WINDOW) - 1e-6]),
    )  # fmt: skip
    lines = _said(sweep, kinds)
    if not lines:
        return Notice("note", "Nothing to warn of", (_NOTHING,))
    return Notice("warning", "What limits these runs", lines)


def _said(sweep: Sweep, kinds: Iterable[tuple[str, Sequence[Run]]]) -> tuple[str, ...]:
    """One line for every kind of run of which there is one: what is said of it, and where."""
    return tuple(f"{said}: {sweep.at(runs)}." for said, runs in kinds if runs)
