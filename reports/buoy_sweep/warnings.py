"""What limits the use of a buoy sweep: failed runs, loops, the buoy out of the water, records that are too short."""

from __future__ import annotations

import math

from ..parts.content import Notice
from ..parts.symbols import T_I, TAU_0
from ..parts.wording import count, decimals, listed, number, percent
from .figures import PAPER_WINDOW
from .runs import Run, Sweep

_RESOLVED_RAD = 0.5 * math.pi  # turn of one element beyond which a loop is no longer resolved


def warnings(sweep: Sweep) -> list[Notice]:
    """Everything that limits what the sweep may be used for, each as a box; one plain note when there is nothing."""
    kinds = (
        ("Runs that failed or cannot be read", _failed(sweep)),
        ("Loops and unresolved turns", _turns(sweep)),
        ("The buoy leaves the water", _out_of_water(sweep)),
        ("Records too short for the paper's spectrum", _short(sweep)),
    )
    nothing = (
        "No run failed, no loop was released, the buoy stayed in the water, and every record is long enough for eq. "
        "(31)."
    )
    boxes = [Notice("warning", title, tuple(lines)) for title, lines in kinds if lines]
    return boxes or [Notice("note", "Nothing to warn of", (nothing,))]


def _failed(sweep: Sweep) -> list[str]:
    """One line for every way to end, and one for files that cannot be read, with the message of the first run."""
    lines = []
    for word in sorted({run["status"] for run in sweep.runs if not run.ok}):
        group = [run for run in sweep.runs if run["status"] == word]
        why = f": {group[0]['message']}" if group[0]["message"] else ""
        first = "" if len(group) == 1 else f", the first of them ({_at(group[:1])})"
        lines.append(f"{_at(group)}: {word}{first} after {number(group[0].periods_done, 3)} wave periods{why}")
    if unread := [run for run in sweep.runs if run.fault]:
        first = "" if len(unread) == 1 else f"of the first, {_at(unread[:1])}, "
        lines.append(f"{_at(unread)}: {first}{unread[0].fault}; figures and strobed values leave such a run out.")
    return lines


def _turns(sweep: Sweep) -> list[str]:
    looped = [run for run in sweep.runs if run["loop_releases"] > 0]
    planar = [run for run in looped if not run.in_space]
    coarse = [run for run in sweep.runs if run.in_space and run["max_turn_rad"] > _RESOLVED_RAD]
    total = count(int(sum(run["loop_releases"] for run in looped)), "loop release")
    kinds = (
        (
            looped,
            f"{total}: a loop that a plane cannot open was undone by turning everything above it by 2π (columns "
            "`loop_releases`, `max_turn_rad`). A rope free to leave the plane does not need it.",
        ),
        ([run for run in sweep.runs if run["status"] == "turn-unresolved"], "ended because a turn was not resolved."),
        (
            planar,
            "for what a planar run is good enough is said in the section “Out of the plane”; a sweep with "
            "`--dimensions auto` runs these values of kA in three dimensions.",
        ),
        (
            coarse,
            "in three dimensions an element turns by more than π/2: the rope's loops are not resolved there; "
            "`tether.nodes` makes the elements shorter.",
        ),
    )
    return [f"{sweep.at(runs)}: {said}" for runs, said in kinds if runs]


def _out_of_water(sweep: Sweep) -> list[str]:
    scene, seen = sweep.folder.scene, [run for run in sweep.runs if run.emergence is not None]
    out = [run for run in seen if run.emergence.out_share > 0.0]
    high = [run for run in seen if run.emergence.above_still_m > 0.0]
    lines = []
    if sweep.modes and scene.water is not None:
        top_m = scene.tether.length_m * (1 + sweep.modes.static_strain) + 0.5 * scene.buoy.diameter_m
        if (above := top_m - scene.water.depth_m) > 0:
            lines.append(f"Already at rest the top of the buoy is {decimals(above, 2)} m above the still-water line.")
    if high:
        most_m = decimals(max(run.emergence.above_still_m for run in high), 2)
        lines.append(f"{sweep.at(high)}: its centre rises above the still-water line, by {most_m} m at most.")
    if out:
        share, above_m = (max(getattr(run.emergence, one) for run in out) for one in ("out_share", "above_wave_m"))
        lines.append(
            f"{sweep.at(out)}: the whole sphere is above the linear wave, at most {percent(share)} of the time, its "
            f"centre up to {decimals(above_m, 2)} m above the wave."
        )
    return [*lines, loads_used(scene)] if lines else []


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


def _short(sweep: Sweep) -> list[str]:
    short = [run for run in sweep.good if run.periods_done < sum(PAPER_WINDOW) - 1e-6]
    if not short:
        return []
    start, periods = PAPER_WINDOW
    return [
        f"Eq. (31) with {TAU_0} = {start} {T_I} and n = {periods} needs {start + periods} wave periods; shorter: "
        f"{sweep.at(short)}.",
        "Their spectra are taken over the last half of the record instead, and hold more of the transient.",
    ]


def _at(runs: list[Run]) -> str:
    return f"kA = {listed(number(run.steepness) for run in runs)}"
