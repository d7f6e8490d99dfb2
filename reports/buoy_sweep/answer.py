"""The short answer of a buoy sweep: which runs do what, and where each measured value is least and greatest."""

from __future__ import annotations

from ..parts.content import Bullets, Item
from ..parts.wording import count, number, percent
from ..sweep.quantities import extremes
from .runs import Run, Sweep

_EXTREMES = (
    "slack_fraction", "tension_top_max_N", "radius_min_m", "radius_max_m", "loop_releases", "rope_lateral_max_m",
    "buoy_lateral_max_m",
)  # fmt: skip


def answer_items(sweep: Sweep) -> list[Item]:
    """The statements, and the table of extremes of the runs that ended as asked."""
    rows = [run.row for run in sweep.good]
    shown = [sweep.columns[name] for name in _EXTREMES if name in sweep.columns]
    caption = "Least and greatest value in the runs that ended as asked."
    return [Bullets(short_answer(sweep)), *extremes([sweep.columns["steepness"]], rows, shown, caption)]


def short_answer(sweep: Sweep) -> tuple[str, ...]:
    """One statement a line: the sweep, what failed, then each kind of motion with the steepness of its runs."""
    runs, longest = sweep.runs, number(max(run.periods_done for run in sweep.runs))
    lines = [
        f"{count(len(runs), 'run')}, {sweep.at(runs)}, the longest over {longest} wave periods. "
        f"What follows leaves out the first {count(sweep.transient, 'period')} and runs that failed.",
        *(f"{kind}: {sweep.at(chosen, runs)}." for kind, chosen in _kinds(sweep) if chosen),
    ]
    pulls = [run["tension_top_max_N"] for run in sweep.good if run.known("tension_top_max_N")]
    if pulls and sweep.modes:
        static = sweep.modes.static_tension_N
        lines.append(
            f"The largest top tension is {number(max(pulls) / static, 3)} times the static {number(static)} N."
        )
    return tuple(lines)


def _kinds(sweep: Sweep) -> list[tuple[str, list[Run]]]:
    """(kind, its runs): of runs that did not end as asked, and of all others by slack, period, loops, dimensions."""
    good, share = sweep.good, percent(sweep.tolerance)
    judged = "for its regime see the exponents" if sweep.judged else "what else it is, this report does not decide"
    return [
        ("Did not end as asked", [run for run in sweep.runs if not run.ok]),
        ("Slack for a part of the time", [run for run in good if run["slack_fraction"] > 0]),
        ("Never slack", [run for run in good if run["slack_fraction"] == 0]),
        *(
            (f"Strobed once a wave period, the motion repeats after {count(length, 'wave period')} (period {length})",
             [run for run in good if len(run.visited) == length])
            for length in range(1, sweep.longest + 1)
        ),
        (
            f"A longer period in the table, but the points visited differ in r by less than {share} of its range, as "
            "those of a swing do that dies out near a period-1 motion",
            [run for run in good if run.period and not run.visited],
        ),
        (
            f"The strobed motion repeats after none of 1 to {sweep.longest} periods to {share} of its range "
            f"(`strobed_period` is empty); {judged}",
            [run for run in good if run.period == 0],
        ),
        ("Too few strobed points to look for a period", [run for run in good if run.period is None]),
        ("Loops were released", [run for run in good if run["loop_releases"] > 0]),
        ("Run in three dimensions", [run for run in good if run.in_space]),
    ]  # fmt: skip
