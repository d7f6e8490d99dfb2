"""Every run of a sweep on a sheet of its own: what the row says, how it moved, why it is called what it is called."""

import math
from collections.abc import Sequence

from tables import EMPTY, PEAK, PEAK_ERROR, TANGENT_ERROR, TANGENT_EXPONENT, WOLF_ERROR, WOLF_EXPONENT, count, number

from ..parts import Explorer, ExplorerColumn, Heading, Items, Sheet, Text, link, plain, printed_cells, series, shown_on
from .figures import evidence_table
from .runs import END_PERIODS, STEEPNESS, Run, Sweep

# columns that a sheet shows in its title, its drawing, its table or its message
_ELSEWHERE = ("motion", "status", "strobed_period", "regime_reason", "evidence", "run_key", "message")


def explorer(sweep: Sweep) -> Explorer:
    """The orbit diagram as numbers that the page's script draws; who chooses a run there sees its sheet."""
    columns = []
    for run in sweep.runs:
        points = tuple(run.section[:, 0]) if run.ok else ()
        colour = sweep.colours.get(run.motion, "")
        columns.append(ExplorerColumn(run.value, points, _name(run), run.anchor, colour))
    rows = sweep.runs
    peak_kN, error_kN = (1e-3 * series(rows, name) for name in (PEAK, PEAK_ERROR))
    lower = [
        ("peak tension (kN)", tuple(peak_kN), tuple(error_kN)),
        ("slack fraction (–)", tuple(series(rows, "slack_fraction")), (math.nan,) * len(rows)),
    ]
    for column, error in ((TANGENT_EXPONENT, TANGENT_ERROR), (WOLF_EXPONENT, WOLF_ERROR)):
        if any(run.known(column) for run in sweep.judged):
            lower.append(("σ (bits per wave period)", tuple(series(rows, column)), tuple(series(rows, error))))
            break
    axis = f"{plain(sweep.key.head)} ({sweep.key.unit or EMPTY})"
    return Explorer(axis, "strobed r (m)", tuple(columns), tuple(lower))


def sheet_items(sweep: Sweep) -> Items:
    """The section with the sheets, which the explorer opens too."""
    printed = "the first and the last value"
    if sweep.key.name == STEEPNESS.name:
        printed = "the paper's kA = 0.016 and 0.13"
    introduction = (
        "One sheet for each row of the table of runs. Left: top tension (with its extremes between samples), r and θ "
        f"over the whole record and its last {number(END_PERIODS)} wave periods; right: strobed section after the "
        "transient, spectrum of r (eq. (31)), and the exponent of the tangent dynamics found up to each time, where "
        f"perturbations were carried. The PDF has those nearest {printed}, and the first of a motion that repeats "
        "after several periods."
    )
    return [Heading("Every run"), Text(introduction), [_sheet(sweep, run) for run in sweep.runs]]


def _sheet(sweep: Sweep, run: Run) -> Sheet:
    lines = []
    message = run["message"] or run.fault
    if message:
        lines.append(f"Message: {message}.")
    motion = sweep.motions[run.motion]
    place = motion.index(run)
    neighbours = motion[max(place - 1, 0) : place] + motion[place + 1 : place + 2]
    if neighbours:
        lines.append(f"Next to it: {_links(neighbours)}.")
    rivals = sweep.runs_with(lambda rival: rival.value == run.value and rival is not run)
    if rivals:
        lines.append(f"At the same {sweep.key.head}: {_links(rivals)}.")
    return Sheet(
        run.anchor, _name(run), _facts(sweep, run), tuple(lines), run.drawing, evidence_table(run), run in sweep.chosen
    )


def _links(runs: Sequence[Run]) -> str:
    """The names of runs, each a link to its sheet."""
    return " and ".join(link(run.named, run.anchor) for run in runs)


def _name(run: Run) -> str:
    """The run with its regime, or with the reason why it ended early."""
    if run["regime"]:
        return f"{run.named}, {run['regime']}"
    if not run.ok:
        return f"{run.named}, {run['status']}"
    return run.named


def _facts(sweep: Sweep, run: Run) -> tuple[tuple[str, str], ...]:
    """What the row says of the run, in the words and units of the dictionary; the period as the report found it."""
    status = run["status"]
    if not run.ok:
        status += f" after {number(run.periods_done, 3)} wave periods"
    if run.period is None:
        period = EMPTY
    elif run.period == 0:
        period = f"none of 1 to {sweep.longest}"
    else:
        period = count(run.period, "wave period")
    facts = [("status", status), ("repeats after", period)]
    columns = sweep.folder.columns
    cells = printed_cells(columns)
    for name in shown_on(columns, [run]):
        if name not in (sweep.key.name, *_ELSEWHERE):
            facts.append((columns[name].head, f"{cells[name](run)} {columns[name].unit}".strip()))
    return (*facts, ("file", f"`trajectories/{run['run_key'][:12]}….nc`"))
