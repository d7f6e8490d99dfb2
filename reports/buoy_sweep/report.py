"""The report of `campaigns.buoy_sweep`: its parts in their order. All data come from the folder of the campaign."""

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

from tables import COARSE, OTHER_GROWTH, OTHER_MOTION, decimals, number, percent

from ..parts import (
    T_I,
    TAU_0,
    Heading,
    Items,
    Notice,
    Report,
    Text,
    extremes,
    limits,
    report_page,
    section_items,
    series,
    timing_items,
)
from .ends import every_motion
from .figures import close_up_items, orbit_figure, regime_items
from .motions import motions_items
from .runs import PAPER_WINDOW, Run, Sweep, read_sweep
from .sheets import explorer, sheet_items
from .snaps import snap_items
from .tables import cost_figure, plane_items, runs_items, scene_and_modes

_EXTREMES = (
    "slack_fraction", "tension_top_max_N", "radius_min_m", "radius_max_m", "loop_releases", "rope_lateral_max_m",
    "buoy_lateral_max_m",
)  # fmt: skip
_EXTREMES_CAPTION = "Least and greatest value in the runs that ended as asked."
_LARGEST_RESOLVED_TURN_RAD = 0.5 * math.pi  # in one element; the loops of a run with a larger turn are not resolved
Limit = tuple[str, Sequence[Run]]  # a limitation in words, and the runs that it concerns
_NO_LIMITS = (
    "No run failed, no loop was released, the buoy stayed in the water, tensions hold to 5 %, and every record "
    "lasts for eq. (31)."
)


def report(directory: Path) -> Report:
    """The content of the report on a buoy sweep's folder. Raises FolderError for a folder that is not one."""
    sweep = read_sweep(directory)
    items = [
        orbit_figure(sweep) or Text("No run gave strobed points after the transient, so there is no orbit diagram."),
        motions_items(sweep),
        explorer(sweep),
        _question(sweep),
        Heading("Warnings"),
        warnings(sweep),
        regime_items(sweep),
        every_motion(sweep.folder, "steepness", "kA"),
        close_up_items(sweep),
        snap_items(sweep.folder, sweep.folder.columns["steepness"]),
        plane_items(sweep),
        runs_items(sweep),
        sheet_items(sweep),
    ]
    solved = section_items("buoy_sweep_solved", "Equations", law=sweep.folder.scene.tether.tension.law)
    made = [timing_items(sweep.folder, cost_figure(sweep)), scene_and_modes(sweep), solved]
    return report_page(sweep.folder, "Tethered buoy: a sweep of wave steepness", items, made)


def _question(sweep: Sweep) -> Items:
    columns = sweep.folder.columns
    shown = [columns[name] for name in _EXTREMES if name in columns]
    keys = [columns["steepness"]]
    if sweep.colours:
        keys.append(columns["motion"])
    yield section_items("buoy_sweep")
    yield extremes(keys, sweep.good, shown, _EXTREMES_CAPTION)
    if sweep.judged:
        return
    reason = (
        "No run was judged. Without `--periods` runs last as long as their regime needs. With `--periods` a run needs "
        "at least 135 wave periods and has to carry perturbations (`output.tangent_vectors`)."
    )
    yield Notice("note", "No verdict on regular or chaotic motion", (reason,))


def warnings(sweep: Sweep) -> Notice:
    """All limitations of the use of the sweep; a plain note if there are none."""
    lines = []
    for text, runs in (*_failures(sweep), *_numerical_limits(sweep), *_physical_limits(sweep)):
        if runs:
            lines.append(f"{text}: {sweep.at(runs)}.")
    return limits("What limits these runs", lines, _NO_LIMITS)


def _failures(sweep: Sweep) -> Iterator[Limit]:
    """The runs that ended early, one limit for each status, and the runs whose trajectory cannot be read."""
    by_status = {}
    for run in reversed(sweep.runs):
        if not run.ok:
            by_status.setdefault(run["status"], []).insert(0, run)
    for status, runs in by_status.items():
        message = runs[0]["message"] or "no message"
        yield f"{status}; the first after {number(runs[0].periods_done, 3)} periods: {message}", runs
    unread = sweep.runs_with(lambda run: run.fault)
    if unread:
        yield f"{unread[0].fault} (the first of these runs); figures and strobed values leave such runs out", unread


def _numerical_limits(sweep: Sweep) -> Iterator[Limit]:
    """The runs whose loops, tensions or motion are not resolved by the grid and the steps."""
    yield (
        "loops were released; a rope that can leave the plane needs no release (`--dimensions auto`), see “Out of the "
        "plane”",
        sweep.runs_with(lambda run: run["loop_releases"] > 0),
    )
    yield (
        "axial ringing of the line is not resolved; the column message says how far and when tensions hold",
        sweep.runs_with(lambda run: "not resolved" in (run["message"] or "")),
    )
    yield (
        f"largest tensions hold to no better than {percent(COARSE)} (column ± T_max)",
        sweep.runs_with(lambda run: run["tension_top_max_error_N"] > COARSE * run["tension_top_max_N"]),
    )
    yield (
        "the error of the largest tension is not known (column ± T_max)",
        sweep.runs_with(lambda run: run.ok and not run.known("tension_top_max_error_N")),
    )
    yield (
        "with smaller elements and steps the run ends in another motion (column message)",
        sweep.runs_with(lambda run: OTHER_MOTION in (run["message"] or "")),
    )
    yield (
        "with smaller elements and steps perturbations grow otherwise, so the regime may be another (column message)",
        sweep.runs_with(lambda run: OTHER_GROWTH in (run["message"] or "")),
    )
    yield (
        "in three dimensions an element turns by more than π/2: loops are not resolved, so use more `tether.nodes`",
        sweep.runs_with(lambda run: run.in_space and run["max_turn_rad"] > _LARGEST_RESOLVED_TURN_RAD),
    )


def _physical_limits(sweep: Sweep) -> Iterator[Limit]:
    """The runs whose buoy leaves the water, and the runs that are too short for the spectrum of the paper."""
    scene = sweep.folder.scene
    strain = sweep.modes.static_strain if sweep.modes else -1.0
    dry_m = scene.anchor.position_m[2] + scene.tether.length_m * (1.0 + strain)
    dry_m += 0.5 * scene.buoy.diameter_m - scene.water.depth_m
    if dry_m > 0.0:
        yield f"already at rest the top of the buoy is {decimals(dry_m, 2)} m above still water", sweep.runs
    flying = sweep.runs_with(lambda run: run["max_buoy_height_above_water_m"] > scene.buoy.diameter_m)
    height_m = series(flying, "max_buoy_height_above_water_m").max(initial=0.0) - scene.buoy.diameter_m
    yield (
        f"the whole sphere rises above still water, its lowest point by up to {decimals(height_m, 2)} m. There "
        f"the choice of `buoy.submergence` = {scene.buoy.submergence} and `waves.above_still_water` = "
        f"{scene.waves.above_still_water} decides the motion",
        flying,
    )
    window = sum(PAPER_WINDOW)
    yield (
        f"shorter than the {window} wave periods of eq. (31) with {TAU_0} = {PAPER_WINDOW[0]} {T_I} and "
        f"n = {PAPER_WINDOW[1]}: their spectra use the last half of the record, which has more of the transient",
        sweep.runs_with(lambda run: run.ok and run.periods_done < window - 1e-6),
    )
