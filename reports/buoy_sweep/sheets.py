"""Every run of a sweep on a sheet of its own: what the row says, how it moved, why it is called what it is called."""

import math

import numpy as np

from ..figures.run_sheet import run_sheet
from ..parts.columns import plus_minus
from ..parts.content import Explorer, ExplorerColumn, Figure, Heading, Item, Sheet, Text, link
from ..parts.wording import EMPTY, OMEGA_I, OMEGA_R, count, decimals, number
from ..sweep.quantities import errors_of, series
from .figures import EXPONENTS, evidence_table
from .runs import Run, Sweep

_MANY = 120  # runs above which a sheet is drawn more coarsely, so that 400 of them stay below 10 MB
_END_PERIODS = 6.0
_MOST_POINTS = 400
# columns that a sheet shows in its title, its drawing, its table or its message
_ELSEWHERE = ("steepness", "status", "strobed_period", "regime_reason", "evidence", "run_key", "message")


def explorer(sweep: Sweep, figure: Figure) -> Explorer:
    """The orbit diagram again, as numbers that the page's script draws; who chooses a run there sees its sheet."""
    runs, rows = sweep.runs, [run.row for run in sweep.runs]
    columns = tuple(
        ExplorerColumn(run.steepness, tuple(run.section[:, 0]) if run.ok else (), _name(run), run.anchor)
        for run in runs
    )
    lower = [("slack fraction (–)", tuple(series(rows, "slack_fraction")), (math.nan,) * len(runs))]
    for column, error in EXPONENTS if sweep.judged else ():
        if np.isfinite(values := series(rows, column)).any():
            lower.append(("σ (bits per wave period)", tuple(values), tuple(series(rows, error))))
            break
    return Explorer(figure, "wave steepness kA (–)", "strobed r (m)", columns, tuple(lower))


def sheet_items(sweep: Sweep) -> list[Item]:
    """The section with the sheets."""
    said = (
        "One sheet for each row of the table of runs. Left: top tension (with its extremes between samples), r and θ "
        f"over the whole record and its last {number(_END_PERIODS)} wave periods; right: strobed section after "
        f"{sweep.transient} wave periods, spectrum of r (eq. (31)), and the exponent of the tangent dynamics found up "
        "to each time. The PDF leaves the sheets out."
    )
    beside = zip((None, *sweep.runs), sweep.runs, (*sweep.runs[1:], None), strict=False)
    return [Heading("Every run"), Text(said), *(_sheet(sweep, run, (left, right)) for left, run, right in beside)]


def _sheet(sweep: Sweep, run: Run, beside: tuple[Run | None, Run | None]) -> Sheet:
    drawing = _drawing(sweep, run) if run.has_record else ""
    message = run["message"] or run.fault
    lines = [f"Message: {message}."] if message else []
    if ways := [link(one.named, one.anchor) for one in beside if one is not None]:
        lines.append(f"Next to it: {' and '.join(ways)}.")
    return Sheet(run.anchor, _name(run), _facts(sweep, run), tuple(lines), drawing, evidence_table(run))


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


def _drawing(sweep: Sweep, run: Run) -> str:
    trajectory = sweep.trajectory(run)
    columns, period_s = trajectory.columns, trajectory.scene.waves.period_s
    wave, shown = 2.0 * math.pi / period_s, {}  # shown: what only some runs have
    if found := run.spectrum(trajectory, "radius_m"):
        part = (found.angular_frequency_radps > 0.0) & (found.angular_frequency_radps <= 2.5 * wave)
        shown["spectrum"] = found.angular_frequency_radps[part], found.amplitude[part]
    if trajectory.tangent is not None and (growth := trajectory.tangent.growth_nats[sweep.transient :]).size:
        counted = np.arange(1, len(growth) + 1)
        shown["exponent"] = sweep.transient + counted, np.cumsum(growth[:, 0]) / counted / math.log(2.0)
    low, high = columns["tension_top_low_N"] / 1e3, columns["tension_top_high_N"] / 1e3
    radius, angle = columns["radius_m"], columns["angle_rad"]
    histories = (("T (kN)", low, high), ("r (m)", radius, radius), ("θ (rad)", angle, angle))
    natural = ((sweep.modes.radial_radps, OMEGA_R),) if sweep.modes else ()
    marks = (*natural, (wave, OMEGA_I))
    span = f"r from {decimals(run['radius_min_m'], 2)} to {decimals(run['radius_max_m'], 2)} m"
    seen = (
        f"Tension, radius and angle over {number(run.periods_done)} wave periods at {run.named}, with section, "
        f"spectrum and exponent: {span}, tension up to {number(run['tension_top_max_N'])} N."
    )
    bins, section = 160 if len(sweep.runs) <= _MANY else 80, run.section[:_MOST_POINTS]
    return run_sheet(seen, bins, columns["time_s"] / period_s, histories, _END_PERIODS, section, marks=marks, **shown)
