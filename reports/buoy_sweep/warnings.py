"""What limits the use of a buoy sweep: failed runs, loops, the buoy out of the water, records that are too short."""

from __future__ import annotations

import math

from ..parts.content import Notice
from ..parts.symbols import T_I, TAU_0
from ..parts.wording import count, decimals, listed, number, percent, ranges
from .figures import PAPER_WINDOW
from .physics import Modes
from .runs import Run, value

_RESOLVED_RAD = 0.5 * math.pi  # turn of one element beyond which a loop is no longer resolved
_MANY = 8  # statements of one kind above which a box sums them up


def warnings(runs: tuple[Run, ...], scene, modes: Modes | None) -> list[Notice]:
    """Everything that limits what the sweep may be used for, each as a box; one plain note when there is nothing."""
    boxes = [_failed(runs), _turns(runs), _out_of_water(runs, scene, modes), _short(runs)]
    boxes = [box for box in boxes if box is not None]
    return boxes or [
        Notice(
            "note",
            "Nothing to warn of",
            (
                "No run failed, no loop was released, the buoy stayed in the water, and every record is long enough "
                "for eq. (31).",
            ),
        )
    ]


def _failed(runs) -> Notice | None:
    failed = [run for run in runs if not run.ok]
    lines = [f"{_at([run])}: {_end(run)}" for run in failed]
    if len(failed) > _MANY:
        words = sorted({run.row["status"] for run in failed})
        groups = [[run for run in failed if run.row["status"] == word] for word in words]
        lines = [
            f"{_at(group)}: {word}; the first of them {_end(group[0])}"
            for word, group in zip(words, groups, strict=True)
        ]
    unread = [run for run in runs if run.fault]
    lines += [f"{_at([run])}: {run.fault}; figures and strobed values leave this run out." for run in unread[:_MANY]]
    if len(unread) > _MANY:
        lines.append(f"The same is true of {count(len(unread) - _MANY, 'further run')}: {_at(unread[_MANY:])}.")
    return Notice("warning", "Runs that failed or cannot be read", tuple(lines)) if lines else None


def _end(run: Run) -> str:
    why = f": {run.row['message']}" if run.row["message"] else ""
    return f"{run.row['status']} after {number(run.periods_done, 3)} wave periods{why}"


def _turns(runs) -> Notice | None:
    looped = [run for run in runs if value(run, "loop_releases") > 0]
    unresolved = [run for run in runs if run.row["status"] == "turn-unresolved"]
    coarse = [run for run in runs if run.in_space and value(run, "max_turn_rad") > _RESOLVED_RAD]
    if not looped and not unresolved and not coarse:
        return None
    lines = [f"{_at([run])}: {releases(run)}" for run in looped]
    if len(looped) > _MANY:
        most = max(looped, key=lambda run: value(run, "loop_releases"))
        total = int(sum(value(run, "loop_releases") for run in looped))
        lines = [
            f"{count(total, 'loop release')} in {len(looped)} of {count(len(runs), 'run')}: kA = "
            f"{ranges([run.steepness for run in runs], [run in looped for run in runs])}.",
            f"Most at {_at([most])}: {releases(most)}. All of them are in the table of runs.",
        ]
    if unresolved:
        lines.append(f"Ended because a turn could not be resolved: {_at(unresolved)}.")
    if looped:
        lines.append(
            "A loop that a plane cannot open was undone by turning everything above it by 2π (columns `loop_releases`, "
            "`max_turn_rad`). A rope free to leave the plane does not need it."
        )
    if any(not run.in_space for run in looped):
        lines.append(
            "What the planar run is good enough for is said in the section “Out of the plane”; a sweep with "
            "`--dimensions auto` runs these values of kA in three dimensions."
        )
    if coarse:
        most = max(value(run, "max_turn_rad") for run in coarse)
        lines.append(
            f"In three dimensions an element turns by more than π/2, at most by {decimals(most, 2)} rad: "
            f"{_at(coarse)}. The rope's loops are not resolved there; `tether.nodes` makes the elements shorter."
        )
    return Notice("warning", "Loops and unresolved turns", tuple(lines))


def _out_of_water(runs, scene, modes) -> Notice | None:
    seen = [run for run in runs if run.emergence is not None]
    out = [run for run in seen if run.emergence.out_share > 0.0]
    high = [run for run in seen if run.emergence.above_still_m > 0.0]
    rest = scene.tether.length_m * (1 + modes.static_strain) + 0.5 * scene.buoy.diameter_m if modes else 0.0
    above = rest - scene.water.depth_m if scene.water is not None else 0.0
    if not out and not high and above <= 0:
        return None
    lines = []
    if above > 0:
        lines.append(f"Already at rest the top of the buoy is {decimals(above, 2)} m above the still-water line.")
    if high:
        top = max(high, key=lambda run: run.emergence.above_still_m)
        lines.append(
            f"The centre of the buoy rises above the still-water line in {count(len(high), 'run')}, by "
            f"{decimals(top.emergence.above_still_m, 2)} m at most (kA = {number(top.steepness)})."
        )
    if out:
        top = max(out, key=lambda run: run.emergence.out_share)
        lines.append(
            "The whole sphere is above the linear wave at kA = "
            f"{ranges([run.steepness for run in runs], [run in out for run in runs])}, at most "
            f"{percent(top.emergence.out_share)} of the time (kA = {number(top.steepness)}), its centre up to "
            f"{decimals(max(run.emergence.above_wave_m for run in out), 2)} m above the wave."
        )
    lines.append(loads_used(scene))
    return Notice("warning", "The buoy leaves the water", tuple(lines))


def loads_used(scene) -> str:
    """Which loads the run took for a buoy that comes out of the water, and what is doubtful about them."""
    submergence, above = scene.buoy.submergence, scene.waves.above_still_water
    if submergence == "full":
        loads = "buoyancy, added mass and wave load of the whole sphere at any height"
        doubt = "Out of the water neither is physical, and the choice decides the outcome."
    else:
        loads = "buoyancy, added mass, wave load and drag of the part of the sphere below the linear wave"
        doubt = "What an impact on the water loses in spray is left out; the choice decides the outcome."
    return f"Used here: `buoy.submergence` = {submergence} ({loads}) and `waves.above_still_water` = {above}. {doubt}"


def _short(runs) -> Notice | None:
    short = [run for run in runs if run.ok and run.periods_done < sum(PAPER_WINDOW) - 1e-6]
    if not short:
        return None
    return Notice(
        "warning",
        "Records too short for the paper's spectrum",
        (
            f"Eq. (31) with {TAU_0} = {PAPER_WINDOW[0]} {T_I} and n = {PAPER_WINDOW[1]} needs {sum(PAPER_WINDOW)} "
            f"wave periods; shorter: kA = {ranges([run.steepness for run in runs], [run in short for run in runs])}.",
            "Their spectra are taken over the last half of the record instead, and hold more of the transient.",
        ),
    )


def releases(run: Run) -> str:
    """How many loops a run had to release, and its largest turn, in words."""
    turn = decimals(value(run, "max_turn_rad"), 2)
    return f"{count(int(value(run, 'loop_releases')), 'loop release')}, largest turn within one element {turn} rad"


def _at(runs) -> str:
    return f"kA = {listed(number(run.steepness) for run in runs)}"
