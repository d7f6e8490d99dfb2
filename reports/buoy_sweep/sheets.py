"""Every run of a sweep on a sheet of its own: what the row says, how it moved, why it is called what it is called."""

import math

from ..parts.columns import plus_minus
from ..parts.content import Explorer, ExplorerColumn, Heading, Item, Sheet, Text, link
from ..parts.wording import EMPTY, count, number
from ..sweep.quantities import errors_of, series
from .figures import evidence_table, exponents
from .runs import END_PERIODS, Run, Sweep

# columns that a sheet shows in its title, its drawing, its table or its message
_ELSEWHERE = ("steepness", "motion", "status", "strobed_period", "regime_reason", "evidence", "run_key", "message")


def explorer(sweep: Sweep) -> Explorer:
    """The orbit diagram as numbers that the page's script draws; who chooses a run there sees its sheet."""
    runs, rows = sweep.runs, [run.row for run in sweep.runs]
    columns = tuple(
        ExplorerColumn(
            run.steepness,
            tuple(run.section[:, 0]) if run.ok else (),
            _name(run),
            run.anchor,
            sweep.colours.get(run.motion, ""),
        )
        for run in runs
    )
    lower = [("slack fraction (–)", tuple(series(rows, "slack_fraction")), (math.nan,) * len(runs))]
    for column, error in exponents(sweep)[:1]:
        lower.append(("σ (bits per wave period)", tuple(series(rows, column)), tuple(series(rows, error))))
    return Explorer("wave steepness kA (–)", "strobed r (m)", columns, tuple(lower))


def sheet_items(sweep: Sweep) -> list[Item]:
    """The section with the sheets, and on the page what chooses one of them."""
    said = (
        "One sheet for each row of the table of runs. Left: top tension (with its extremes between samples), r and θ "
        f"over the whole record and its last {number(END_PERIODS)} wave periods; right: strobed section after the "
        "transient, spectrum of r (eq. (31)), and the exponent of the tangent dynamics found up to each time, where "
        "perturbations were carried. The PDF has those nearest the paper's kA = 0.016 and 0.13, and the first of a "
        "motion that repeats after several periods."
    )
    return [Heading("Every run"), Text(said), explorer(sweep), *(_sheet(sweep, run) for run in sweep.runs)]


def _sheet(sweep: Sweep, run: Run) -> Sheet:
    message = run["message"] or run.fault
    lines, own = [f"Message: {message}."] if message else [], sweep.motions[run.motion]
    place = own.index(run)
    others = (one for one in sweep.runs if one.steepness == run.steepness and one is not run)
    for said, ways in (
        ("Next to it", (*own[max(place - 1, 0) : place], *own[place + 1 :][:1])),
        ("At the same kA", others),
    ):
        if links := [link(one.named, one.anchor) for one in ways]:
            lines.append(f"{said}: {' and '.join(links)}.")
    return Sheet(
        run.anchor, _name(run), _facts(sweep, run), tuple(lines), run.drawing, evidence_table(run), run in sweep.chosen
    )


def _name(run: Run) -> str:
    word = run["regime"] or ("" if run.ok else run["status"])
    return f"{run.named}, {word}" if word else run.named


def _facts(sweep: Sweep, run: Run) -> tuple[tuple[str, str], ...]:
    """What the row says of the run, in the words and units of the dictionary; the period as the report found it."""
    after = "" if run.ok else f" after {number(run.periods_done, 3)} wave periods"
    period = count(run.period, "wave period") if run.period else f"none of 1 to {sweep.longest}"
    facts = [("status", run["status"] + after), ("repeats after", EMPTY if run.period is None else period)]
    columns = sweep.folder.columns
    errors = errors_of(columns)
    for name, column in columns.items():
        said = plus_minus(columns, run.row, name, errors.get(name, ""))
        if name not in _ELSEWHERE and name not in errors.values() and said != EMPTY:
            facts.append((column.head, f"{said} {column.unit}".strip()))
    return (*facts, ("file", f"`trajectories/{run['run_key'][:12]}….nc`"))
