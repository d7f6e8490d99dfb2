"""The short answer of a buoy sweep, in words computed from the table and the trajectories."""

from __future__ import annotations

import math

from ..parts.wording import count, decimals, number, percent, ranges
from .motion import LONGEST_PERIOD
from .physics import Modes
from .runs import Run, lateral, period_length, planar_releases, several_points, value
from .warnings import releases


def short_answer(runs: tuple[Run, ...], transient: int, tolerance: float, modes: Modes | None) -> tuple[str, ...]:
    """One statement a line: the sweep, slack, period of the strobed orbit, loops, the extremes.

    `transient` wave periods are left out of strobed values and extremes, `tolerance` is that of `strobed_period`.
    """
    good = tuple(run for run in runs if run.ok)
    lines = [_sweep(runs, good, transient)]
    if good:
        lines += [_slack(good), *_periods(good, tolerance), _loops(good), _space(good), _extremes(good, modes)]
    return tuple(line for line in lines if line)


def _sweep(runs, good, transient) -> str:
    values = sorted({run.steepness for run in runs})
    span = f"kA = {number(values[0])}" if len(values) == 1 else f"kA from {number(values[0])} to {number(values[-1])}"
    longest = max((run.periods_done for run in runs), default=0.0)
    if not good:
        end = "None ended as asked; the reasons are under Warnings."
    elif len(good) == len(runs):
        end = "All ended as asked." if len(runs) > 1 else "It ended as asked."
    else:
        bad = [not run.ok for run in runs]
        end = f"{len(good)} ended as asked; not so kA = {ranges([run.steepness for run in runs], bad)}."
    return (
        f"{count(len(runs), 'run')}, {span}, the longest over {number(longest)} wave periods; what follows leaves out "
        f"the first {count(transient, 'period')}. {end}"
    )


def _slack(good) -> str:
    share = [value(run, "slack_fraction") for run in good]
    if all(math.isnan(s) for s in share):
        return ""
    slack = [run for run, s in zip(good, share, strict=True) if s > 0]
    if not slack:
        return f"The tether never goes slack: `slack_fraction` is 0 in {_all(good)}."
    first = slack[0]
    tense = [run.steepness for run in good if run.steepness < first.steepness]
    before = f"up to kA = {number(tense[-1])} it stays taut" if tense else ""
    share_of_first = percent(value(first, "slack_fraction"))
    text = f"The tether goes slack from kA = {number(first.steepness)} on ({share_of_first} of the time there)"
    later_taut = [s == 0 and run.steepness > first.steepness for run, s in zip(good, share, strict=True)]
    if any(later_taut):
        text += f", though not at kA = {ranges([run.steepness for run in good], later_taut)}"
    most = max(slack, key=lambda run: value(run, "slack_fraction"))
    share_of_most = f"the largest share is {percent(value(most, 'slack_fraction'))} at kA = {number(most.steepness)}"
    return "; ".join(part for part in (text, before, share_of_most if most is not first else "") if part) + "."


def _periods(good, tolerance: float) -> list[str]:
    steepness = [run.steepness for run in good]
    lines = []
    for length in range(1, LONGEST_PERIOD + 1):
        chosen = [period_length(run) == length and (length == 1 or several_points(run, tolerance)) for run in good]
        if any(chosen):
            lines.append(
                f"Strobed once a wave period, the motion repeats after {count(length, 'wave period')} (period "
                f"{length}) at kA = {ranges(steepness, chosen)}."
            )
    close = [(period_length(run) or 0) > 1 and not several_points(run, tolerance) for run in good]
    if any(close):
        lines.append(
            f"At kA = {ranges(steepness, close)} the table gives a longer period, but the points visited differ in r "
            f"by less than {percent(tolerance)} of its range: a swing that dies out near a period-1 motion looks like "
            "this."
        )
    none = [period_length(run) == 0 for run in good]
    if any(none):
        judged = any(run.row["regime"] for run in good)
        rest = "for its regime see the exponents" if judged else "what else it is, this report does not decide"
        lines.append(
            f"At kA = {ranges(steepness, none)} the strobed motion repeats after none of 1 to {LONGEST_PERIOD} "
            f"periods to {percent(tolerance)} of its range (`strobed_period` is empty); {rest}."
        )
    unknown = [period_length(run) is None for run in good]
    if any(unknown):
        lines.append(f"At kA = {ranges(steepness, unknown)} too few strobed points are left to look for a period.")
    return lines


def _loops(good) -> str:
    looped = [run for run in good if value(run, "loop_releases") > 0]
    if not looped:
        return f"No loop had to be released in {_all(good)}."
    most = max(looped, key=lambda run: value(run, "loop_releases"))
    if len(looped) == 1:
        return f"Loops form and are released at kA = {number(most.steepness)} alone ({releases(most)})."
    return (
        f"Loops form and are released in {len(looped)} of {count(len(good), 'run')}, first at kA = "
        f"{number(looped[0].steepness)}, most often at kA = {number(most.steepness)} "
        f"({count(int(value(most, 'loop_releases')), 'release')})."
    )


def _space(good) -> str:
    space = [run for run in good if run.in_space]
    if not space:
        return ""
    where = ranges([run.steepness for run in good], [run.in_space for run in good])
    why = ", because the planar runs there released loops" if any(planar_releases(run) > 0 for run in space) else ""
    most = max(space, key=lambda run: lateral(run, "rope"))
    return (
        f"In three dimensions were run: kA = {where}{why}. The rope leaves the plane of the waves farthest at kA = "
        f"{number(most.steepness)}, by {number(lateral(most, 'rope'), 2)} m; no buoy leaves it by more than "
        f"{number(max(lateral(run, 'buoy') for run in space), 2)} m."
    )


def _extremes(good, modes: Modes | None) -> str:
    pulls = [run for run in good if not math.isnan(value(run, "tension_top_max_N"))]
    if not pulls:
        return ""
    most = max(pulls, key=lambda run: value(run, "tension_top_max_N"))
    pull = value(most, "tension_top_max_N")
    static = (
        f", {number(pull / modes.static_tension_N, 3)} times the static {number(modes.static_tension_N)} N"
        if modes
        else ""
    )
    wide = max(pulls, key=lambda run: value(run, "radius_max_m") - value(run, "radius_min_m"))
    return (
        f"The largest top tension is {number(pull)} N at kA = {number(most.steepness)}{static}; the radius ranges "
        f"widest at kA = {number(wide.steepness)}, from {decimals(value(wide, 'radius_min_m'), 2)} to "
        f"{decimals(value(wide, 'radius_max_m'), 2)} m."
    )


def _all(good) -> str:
    return "the one run that ended as asked" if len(good) == 1 else f"all {len(good)} runs that ended as asked"
