"""The short answer of a buoy sweep, in words computed from the table and the trajectories."""

from __future__ import annotations

import math

from ..parts.wording import count, decimals, number, percent
from .runs import Run, Sweep


def short_answer(sweep: Sweep) -> tuple[str, ...]:
    """One statement a line: the sweep, slack, period of the strobed orbit, loops, space, the extremes."""
    lines = [_sweep(sweep)]
    if sweep.good:
        lines += [_slack(sweep), *_periods(sweep), _loops(sweep), _space(sweep), _extremes(sweep)]
    return tuple(line for line in lines if line)


def _sweep(sweep: Sweep) -> str:
    runs, values = sweep.runs, sorted({run.steepness for run in sweep.runs})
    span = f"kA = {number(values[0])}" if len(values) == 1 else f"kA from {number(values[0])} to {number(values[-1])}"
    if not sweep.good:
        end = "None ended as asked; the reasons are under Warnings."
    elif len(sweep.good) == len(runs):
        end = "All ended as asked." if len(runs) > 1 else "It ended as asked."
    else:
        failed = [run for run in runs if not run.ok]
        end = f"{len(sweep.good)} ended as asked; not so {sweep.at(failed)}."
    return (
        f"{count(len(runs), 'run')}, {span}, the longest over {number(max(run.periods_done for run in runs))} wave "
        f"periods; what follows leaves out the first {count(sweep.transient, 'period')}. {end}"
    )


def _slack(sweep: Sweep) -> str:
    known = [run for run in sweep.good if not math.isnan(run["slack_fraction"])]
    slack = [run for run in known if run["slack_fraction"] > 0]
    if not slack:
        return f"The tether never goes slack: `slack_fraction` is 0 in {_all(sweep)}." if known else ""
    first, most = slack[0], max(slack, key=lambda run: run["slack_fraction"])
    parts = [
        f"The tether goes slack from kA = {number(first.steepness)} on ({percent(first['slack_fraction'])} of the time "
        "there)"
    ]
    if taut := [run for run in known if run not in slack and run.steepness > first.steepness]:
        parts[0] += f", though not at {sweep.at(taut, sweep.good)}"
    if tense := [run.steepness for run in sweep.good if run.steepness < first.steepness]:
        parts.append(f"up to kA = {number(tense[-1])} it stays taut")
    if most is not first:
        parts.append(f"the largest share is {percent(most['slack_fraction'])} at kA = {number(most.steepness)}")
    return "; ".join(parts) + "."


def _periods(sweep: Sweep) -> list[str]:
    good, share = sweep.good, percent(sweep.tolerance)
    lines = []
    for length in range(1, sweep.longest + 1):
        if chosen := [run for run in good if len(run.visited) == length]:
            lines.append(
                f"Strobed once a wave period, the motion repeats after {count(length, 'wave period')} (period "
                f"{length}) at {sweep.at(chosen, good)}."
            )
    if close := [run for run in good if run.period and not run.visited]:
        lines.append(
            f"At {sweep.at(close, good)} the table gives a longer period, but the points visited differ in r by less "
            f"than {share} of its range: a swing that dies out near a period-1 motion looks like this."
        )
    if none := [run for run in good if run.period == 0]:
        rest = "for its regime see the exponents" if sweep.judged else "what else it is, this report does not decide"
        lines.append(
            f"At {sweep.at(none, good)} the strobed motion repeats after none of 1 to {sweep.longest} periods to "
            f"{share} of its range (`strobed_period` is empty); {rest}."
        )
    if unknown := [run for run in good if run.period is None]:
        lines.append(f"At {sweep.at(unknown, good)} too few strobed points are left to look for a period.")
    return lines


def _loops(sweep: Sweep) -> str:
    looped = [run for run in sweep.good if run["loop_releases"] > 0]
    if not looped:
        return f"No loop had to be released in {_all(sweep)}."
    most = max(looped, key=lambda run: run["loop_releases"])
    if len(looped) == 1:
        return f"Loops form and are released at kA = {number(most.steepness)} alone ({releases(most)})."
    return (
        f"Loops form and are released in {len(looped)} of {count(len(sweep.good), 'run')}, first at kA = "
        f"{number(looped[0].steepness)}, most often at kA = {number(most.steepness)} "
        f"({count(int(most['loop_releases']), 'release')})."
    )


def _space(sweep: Sweep) -> str:
    space = [run for run in sweep.good if run.in_space]
    if not space:
        return ""
    why = ", because the planar runs there released loops" if any(run.planar_releases > 0 for run in space) else ""
    most = max(space, key=lambda run: run["rope_lateral_max_m"])
    return (
        f"In three dimensions were run: {sweep.at(space, sweep.good)}{why}. The rope leaves the plane of the waves "
        f"farthest at kA = {number(most.steepness)}, by {number(most['rope_lateral_max_m'], 2)} m; no buoy leaves it "
        f"by more than {number(max(run['buoy_lateral_max_m'] for run in space), 2)} m."
    )


def _extremes(sweep: Sweep) -> str:
    pulls = [run for run in sweep.good if not math.isnan(run["tension_top_max_N"])]
    if not pulls:
        return ""
    most = max(pulls, key=lambda run: run["tension_top_max_N"])
    wide = max(pulls, key=lambda run: run["radius_max_m"] - run["radius_min_m"])
    pull, static = most["tension_top_max_N"], ""
    if sweep.modes:
        rest = sweep.modes.static_tension_N
        static = f", {number(pull / rest, 3)} times the static {number(rest)} N"
    return (
        f"The largest top tension is {number(pull)} N at kA = {number(most.steepness)}{static}; the radius ranges "
        f"widest at kA = {number(wide.steepness)}, from {decimals(wide['radius_min_m'], 2)} to "
        f"{decimals(wide['radius_max_m'], 2)} m."
    )


def releases(run: Run) -> str:
    """How many loops a run had to release, and its largest turn, in words."""
    turn = decimals(run["max_turn_rad"], 2)
    return f"{count(int(run['loop_releases']), 'loop release')}, largest turn within one element {turn} rad"


def _all(sweep: Sweep) -> str:
    how_many = len(sweep.good)
    return "the one run that ended as asked" if how_many == 1 else f"all {how_many} runs that ended as asked"
