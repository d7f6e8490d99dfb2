"""Every run of a sweep on a sheet of its own: what the row says, how it moved, why it is called what it is called."""

from __future__ import annotations

import math

import numpy as np

from ..figures.run_sheet import Glance, run_sheet
from ..parts.content import Column, Explorer, ExplorerColumn, Figure, Heading, Item, Sheet, Table, Text, link
from ..parts.folder import Folder
from ..parts.symbols import OMEGA_I, OMEGA_R
from ..parts.wording import EMPTY, count, decimals, number, percent
from .figures import spectrum_window
from .physics import Modes
from .regimes import EXPONENTS, exponent_curves, judged
from .runs import Run, load, period_length, value

_MANY = 120  # runs above which a sheet is drawn more coarsely, so that 400 of them stay below 10 MB
_END_PERIODS = 6.0


def explorer(runs: tuple[Run, ...], figure: Figure) -> Explorer:
    """The orbit diagram to look around in; a choice shows the run's sheet."""
    columns = tuple(
        ExplorerColumn(run.steepness, tuple(run.section[:, 0]) if run.ok else (), _name(run), run.anchor)
        for run in runs
    )
    nothing = (math.nan,) * len(runs)
    lower = [("slack fraction (–)", tuple(value(run, "slack_fraction") for run in runs), nothing)]
    if judged(runs):
        curves = exponent_curves(list(runs))[:1]
        lower += [("σ (bits per wave period)", tuple(values), tuple(errors)) for _, values, errors in curves]
    return Explorer(
        figure, "Look around, choose a run", "wave steepness kA (–)", "strobed r (m)", columns, tuple(lower)
    )


def _name(run: Run) -> str:
    word = run.row["regime"] or ("" if run.ok else run.row["status"])
    return f"kA = {number(run.steepness)}" + (f", {word}" if word else "")


def sheet_items(folder: Folder, runs: tuple[Run, ...], transient: int, modes: Modes | None) -> list[Item]:
    """The section with the sheets."""
    bins = 160 if len(runs) <= _MANY else 80
    said = (
        "One sheet for each row of the table of runs; a link in a table leads here. Left: top tension (with its "
        f"extremes between samples), r and θ over the whole record, and its last {number(_END_PERIODS)} wave periods; "
        f"right: strobed section after {transient} wave periods, spectrum of r (eq. (31)), and the exponent of the "
        "tangent dynamics found up to each time. The page has them all; the PDF leaves them out."
    )
    items: list[Item] = [Heading("Every run"), Text(said)]
    for before, run, after in zip((None, *runs), runs, (*runs[1:], None), strict=False):
        items.append(_sheet(folder, run, transient, modes, bins, (before, after)))
    return items


def _sheet(folder: Folder, run: Run, transient: int, modes: Modes | None, bins: int, beside) -> Sheet:
    drawing = ""
    if run.has_record:
        drawing = run_sheet(_glance(load(folder, run), run, transient, modes), _seen(run), bins)
    before, after = beside
    ways = [link(f"kA = {number(one.steepness)}", one.anchor) for one in (before, after) if one is not None]
    lines = [f"Next to it: {' and '.join(ways)}."] if ways else []
    if message := run.row["message"] or run.fault:
        lines.insert(0, f"Message: {message}.")
    return Sheet(run.anchor, _name(run), _facts(run), tuple(lines), drawing, _evidence(run))


def _seen(run: Run) -> str:
    span = f"r from {decimals(value(run, 'radius_min_m'), 2)} to {decimals(value(run, 'radius_max_m'), 2)} m"
    return (
        f"Tension, radius and angle over {number(run.periods_done)} wave periods at kA {number(run.steepness)}, with "
        f"section, spectrum and exponent: {span}, tension up to {number(value(run, 'tension_top_max_N'))} N."
    )


def _facts(run: Run) -> tuple[tuple[str, str], ...]:
    length = period_length(run)
    low_high = {
        name: f"{decimals(value(run, f'{column}_min_{unit}'), places)} to "
        f"{decimals(value(run, f'{column}_max_{unit}'), places)} {unit}"
        for name, column, unit, places in (
            ("r", "radius", "m", 3),
            ("θ", "angle", "rad", 3),
            ("top tension", "tension_top", "N", 0),
        )
        if math.isfinite(value(run, f"{column}_max_{unit}"))
    }
    facts = [
        ("status", run.row["status"] + ("" if run.ok else f" after {number(run.periods_done, 3)} wave periods")),
        ("regime", run.row["regime"] or EMPTY),
        ("at a tenth of the tolerance", str(run.row.get("regime_tighter") or EMPTY)),
        ("repeats after", EMPTY if length is None else count(length, "wave period") if length else "none of 1 to 16"),
        *low_high.items(),
        ("slack", percent(value(run, "slack_fraction")) if math.isfinite(value(run, "slack_fraction")) else EMPTY),
        *((f"exponent, {name}", _with_error(run, *columns)) for name, *columns in EXPONENTS),
        ("loop releases", number(value(run, "loop_releases"))),
        ("largest turn", f"{decimals(value(run, 'max_turn_rad'), 2)} rad"),
        ("steps", number(value(run, "steps"))),
        ("wall time", f"{decimals(value(run, 'wall_s'), 2)} s"),
        ("file", f"`trajectories/{run.row['run_key'][:12]}….nc`"),
    ]
    return tuple((name, said) for name, said in facts if said != EMPTY)


def _with_error(run: Run, column: str, error: str) -> str:
    found = float(run.row.get(column, math.nan))
    if not math.isfinite(found):
        return EMPTY
    return f"{decimals(found, 3)} ± {decimals(float(run.row.get(error, math.nan)), 3)} bits per period"


def _evidence(run: Run) -> Table | None:
    """The tests behind the regime, as `campaigns.buoy_sweep` wrote them into the row (`motion.evidence_text`)."""
    from .motion import read_evidence

    tests = read_evidence(str(run.row.get("evidence") or ""))
    if not tests:
        return None
    heads = (Column("test", align="left"), Column("value"), Column("threshold"), Column("met"))
    reason = str(run.row.get("regime_reason") or "").strip()
    caption = f"Why it is called {run.row['regime']}: {reason}." if reason else "Evidence, in the order of the tests."
    rows = tuple((name, *(cell.replace("-", "−") for cell in cells)) for name, *cells in tests)
    return Table(heads, rows, caption, small=True)


def _glance(trajectory, run: Run, transient: int, modes: Modes | None) -> Glance:
    columns, scene = trajectory.columns, trajectory.scene
    periods = columns["time_s"] / scene.waves.period_s
    wave = 2.0 * math.pi / scene.waves.period_s
    low, high = columns["tension_top_low_N"] / 1e3, columns["tension_top_high_N"] / 1e3
    radius, angle = columns["radius_m"], columns["angle_rad"]
    nothing = np.empty(0)
    spectral, exponent = (nothing, nothing), (nothing, nothing)
    if (window := spectrum_window(run.periods_done)) and np.isfinite(radius).all():
        from analysis import spectrum

        found = spectrum(radius, scene.sample_step_s(), scene.waves.period_s, *window)
        shown = (found.angular_frequency_radps > 0.0) & (found.angular_frequency_radps <= 2.5 * wave)
        spectral = found.angular_frequency_radps[shown], found.amplitude[shown]
    growth = trajectory.tangent.growth_nats if trajectory.tangent is not None else np.empty((0, 0))
    if growth.shape[1] > 0 and len(growth) > transient:
        kept = growth[transient:, 0]
        counted = np.arange(1, len(kept) + 1)
        exponent = transient + counted, np.cumsum(kept) / counted / math.log(2.0)
    natural = ((modes.radial_radps, OMEGA_R),) if modes else ()
    return Glance(
        periods,
        (("T (kN)", low, high), ("r (m)", radius, radius), ("θ (rad)", angle, angle)),
        max(float(periods[-1]) - _END_PERIODS, 0.0),
        run.section[:400],
        spectral,
        (*natural, (wave, OMEGA_I)),
        exponent,
    )
