"""Figures of a buoy sweep, and the tables beside them, each with its caption."""

import math
from collections import Counter
from collections.abc import Iterator, Sequence

import numpy as np

from analysis import read_evidence

from ..figures.animations import Snap, tether_animation, tether_stills
from ..figures.curves import Curve, Panel
from ..figures.orbit_diagram import NARROW_IN, Column, Range, orbit_diagram
from ..parts.content import Figure, Heading, Item, Table, Text, heads
from ..parts.folder import part_of
from ..parts.style import BLUE, INK, REGIME_COLOURS, VERMILION
from ..parts.wording import T_I, T_S, count, decimals, number, printed
from ..sweep.quantities import series
from .runs import PAPER_STEEPNESS, Run, Sweep
from .tables import sweep_table

TANGENT, WOLF = (
    (f"lyapunov_{how}_bits_per_period", f"lyapunov_{how}_error") for how in ("tangent", "wolf")
)  # the largest exponents in the table, each with its standard error
_PERIOD = "period-"
_SHOWN_PERIODS = 3.0  # of the tether as it snaps
_CAP, _AS_RUN = "wetted cap", "as run"  # roles in companions/table.csv
_DEFINED = (
    "A run is looked at after 90, 135, 205, ... wave periods, each time without its first third. A word counts when "
    "two looks in a row find it, or a clear one from 465 periods on (docs/verdicts.md). Periodic: the strobed orbit "
    "repeats, and perturbations do not grow in the later half. "
    "Chaotic: the exponent of the tangent dynamics is positive by 3.5 errors, by two in the later half, and again at a "
    "tenth of the tolerance (`regime_tighter`). Quasi-periodic: the exponent is zero within a stated bound, neighbours "
    "stay, and a spectral line does not fit the waves. Transient: still changing at the end of the record. Everything "
    "else is undecided. A verdict is one over the periods of the run: a longer chaotic transient is called chaotic."
)


def exponents(sweep: Sweep) -> list[tuple[str, str]]:
    """The pairs of columns, value and error, in which some run has an exponent."""
    rows = [run.row for run in sweep.runs if run["regime"]]
    return [pair for pair in (TANGENT, WOLF) if np.isfinite(series(rows, pair[0])).any()]


def orbit_figure(sweep: Sweep) -> Figure | None:
    """The answer in one figure; None where no run has strobed points."""
    drawn = [run for run in (*sweep.good, *sweep.between) if len(run.section)]
    if not drawn:
        return None
    drawn.sort(key=lambda run: run.steepness)
    missing = [run.steepness for run in sweep.runs if run not in drawn]
    columns = [Column(run.steepness, run.section[:, 0], run["regime"] if run in sweep.judged else "") for run in drawn]
    scene, static_N = sweep.folder.scene, sweep.modes.static_tension_N if sweep.modes else None
    beyond = [
        Range("whole sphere above still water", [_flies(run, scene.buoy.diameter_m) for run in drawn]),
        Range("loops released", [run["loop_releases"] > 0 and not run.in_space for run in drawn]),
    ]
    ranges = [one for one in beyond if any(one.holds)]
    marks = [(kA, "paper") for kA in PAPER_STEEPNESS if drawn[0].steepness <= kA <= drawn[-1].steepness]
    scale, unit = (1.0 / static_N, "over static") if static_N else (1e-3, "(kN)")
    below = [_slack(drawn), *_exponent_panel(sweep), _tension(sweep, drawn, scale, unit)]
    labels = "wave steepness kA (–)", "strobed r (m)"
    wide, narrow = (orbit_diagram(columns, labels, below, ranges, marks, missing, *how) for how in ((), (NARROW_IN,)))
    caption = " ".join(_seen(sweep, drawn, static_N))
    words = Counter(run["regime"] for run in sweep.judged)
    alt = f"Orbit diagram over wave steepness: {', '.join(f'{word} {n} times' for word, n in words.items())}; see text."
    return Figure(wide, caption, alt, narrow=narrow)


def _flies(run: Run, diameter_m: float) -> bool:
    """Whether all of the sphere leaves the water."""
    return bool(run["max_buoy_height_above_water_m"] > diameter_m)


def _seen(sweep: Sweep, drawn: Sequence[Run], static_N: float | None) -> Iterator[str]:
    """The caption."""
    yield f"r at t = k{T_I} after the transient, over wave steepness, in the colour of the regime"
    yield "(numbers in the bar: periods after which it repeats)." if sweep.judged else "."
    if beside := [run for run in drawn if run in sweep.between]:
        longest = number(max(run.periods_done for run in beside), 3)
        yield f"{count(len(beside), 'run')} between those of the table, over {longest} periods, were not judged."
    yield "Below: time with less than 5 % of the static tension; largest exponent with two standard errors, where the"
    yield f"regime needs it; largest tension{f' over the static {T_S} = {number(static_N)} N' if static_N else ''}."
    for role, steepness, peak_N, cut_N in _finer(sweep):
        yield (
            f"{role.capitalize()} at kA = {number(steepness)}: {number(peak_N / 1e3, 3)} kN, where the run over the "
            f"same periods has {number(cut_N / 1e3, 3)}."
        )
    left = [run for run in sweep.judged if run["regime"] in ("undecided", "transient")]
    if sweep.judged:
        yield f"Not decided: {sweep.at(left) if left else 'no run'}."


def _slack(drawn: Sequence[Run]) -> Panel:
    slack = 100.0 * _of(drawn, "slack_fraction")
    return Panel([Curve(_of(drawn, "steepness"), slack, colour=INK)], y_label="slack (%)")


def _of(runs: Sequence[Run], column: str) -> np.ndarray:
    return series([run.row for run in runs], column)


def _exponent_panel(sweep: Sweep) -> list[Panel]:
    """Exponents in the colours of the regimes; by Wolf's method where no other is known, and never where r repeats."""
    values, errors, words = [], [], []
    for run in sweep.judged:
        word = _PERIOD if run["regime"].startswith(_PERIOD) else run["regime"]
        value, error = next((pair for pair in (TANGENT, WOLF) if run.known(pair[0])), TANGENT)
        shown = (value, error) == TANGENT or word != _PERIOD
        values.append(run[value] if shown else math.nan)
        errors.append(2.0 * run[error] if shown else math.nan)
        words.append(word)
    known = np.isfinite(values)
    if not known.any():
        return []
    x, y, bars = _of(sweep.judged, "steepness"), np.array(values), np.array(errors)
    lines = []
    for word in dict.fromkeys(np.array(words)[known]):
        own = known & (np.array(words) == word)
        lines.append(Curve(x[own], y[own], "", "", "o", REGIME_COLOURS[word], bars[own], 3.0))
    usual = np.minimum(np.nan_to_num(bars), 3.0 * float(np.nanmedian(bars)))  # one long bar would hide the others
    margin = 0.08 * float(np.ptp(y[known])) + 0.01
    limits = float((y - usual)[known].min()) - margin, float((y + usual)[known].max()) + margin
    return [Panel(lines, y_label="exponent\n(bits/wave)", level=0.0, settings={"ylim": limits})]


def _tension(sweep: Sweep, drawn: Sequence[Run], scale: float, unit: str) -> Panel:
    lines = [Curve(_of(drawn, "steepness"), scale * _of(drawn, "tension_top_max_N"), "as run", colour=INK)]
    rows = _companions(sweep, _CAP)
    if rows:
        lines.append(Curve(series(rows, "steepness"), scale * series(rows, "tension_top_max_N"), _CAP, colour=BLUE))
    for role, at, peak_N, _ in _finer(sweep):
        place = np.array([at]), np.array([scale * peak_N])
        lines.append(Curve(*place, role, "", "D", VERMILION, size=4.0))
    limits = {"ylim": (0.0, None)}
    return Panel(lines, y_label=f"largest T\n{unit}", settings=limits)


def _companions(sweep: Sweep, role: str) -> list[dict]:
    """The rows of a role in companions/table.csv that ended as asked, by steepness."""
    part = part_of(sweep.folder, "companions")
    rows = [row for row in (part.table if part else ()) if row["role"] == role and row["status"] == "ok"]
    return sorted(rows, key=lambda row: row["steepness"])


def _finer(sweep: Sweep) -> Iterator[tuple[str, float, float, float]]:
    """(role, steepness, largest tension on the finer grid, that of the run cut to the same periods), in N."""
    for coarse in _companions(sweep, _AS_RUN):
        role = f"{2 * int(coarse['nodes']) - 1} nodes"
        for fine in _companions(sweep, role):
            if fine["steepness"] == coarse["steepness"]:
                yield role, fine["steepness"], fine["tension_top_max_N"], coarse["tension_top_max_N"]


def close_up_items(sweep: Sweep) -> list[Item]:
    """Heading and figure; nothing where no run was kept with its tether."""
    part = part_of(sweep.folder, "close_up")
    rows = [row for row in (part.table if part else ()) if row["status"] == "ok"]
    trajectory = part.trajectory(rows[-1])[0] if rows else None
    if trajectory is None or (snap := _snap(trajectory)) is None:
        return []
    at, peak = snap.record[0][np.argmax(snap.record[1])], float(snap.record[1].max())
    seen = f"{number(peak, 3)} N at t/{T_I} = {decimals(float(at), 2)}"
    caption = (
        f"Buoy and tether at kA = {number(trajectory.scene.waves.steepness)} in true proportion, at six values of "
        f"t/{T_I} (above each), and the tension at its top, at most {seen}. Thick: parts without tension; "
        "the wave is the linear one. From the profiles in `close_up/trajectories`."
    )
    alt = f"The tether at six moments as the buoy comes back and pulls it taut, with the top tension, at most {seen}."
    figure = Figure(tether_stills(snap), caption, alt, tether_animation(snap))
    return [Heading("The tether as it snaps"), figure]


def _snap(trajectory) -> Snap | None:
    """The wave periods about the highest tension, None where the run has no profiles or no whole period."""
    from engine.physics.sea import elevation_m

    lines, scene = trajectory.profiles, trajectory.scene
    time_s, top = trajectory.columns["time_s"], trajectory.columns["tension_top_high_N"]
    period_s, end_s = scene.waves.period_s, float(time_s[-1])
    if lines is None or len(lines.time_s) < 2 or lines.time_s[-1] < period_s:
        return None
    late = time_s >= min(2.0 * period_s, 0.5 * end_s)  # the start from rest is left out where the record goes on
    shown_s = _SHOWN_PERIODS * period_s
    begin = float(time_s[late][np.argmax(top[late])]) - 0.6 * shown_s
    begin = min(max(begin, 0.0), max(end_s - shown_s, 0.0))
    inside, part = ((times >= begin) & (times <= begin + shown_s) for times in (lines.time_s, time_s))
    x, z = lines.x_m[inside], lines.z_m[inside]
    beyond = max(3.0 * scene.buoy.diameter_m, 0.25 * float(z.max()))  # of the rope, on both sides
    across = np.linspace(x.min() - beyond, x.max() + beyond, 80)
    surface = scene.water.depth_m + elevation_m(scene, lines.time_s[inside][:, None], across)
    record = time_s[part] / period_s, top[part]
    times = lines.time_s[inside] / period_s
    return Snap(times, x, z, lines.tension_N[inside], scene.buoy.diameter_m, (across, surface), record)


def regime_items(sweep: Sweep) -> list[Item]:
    """What the words mean, and the exponents of the runs; nothing where no run has a regime."""
    if not sweep.judged:
        return []
    caption = "Regime, and largest exponent with one standard error after the transient, where the regime needs it."
    names = ("steepness", "regime", "periods", "transient_periods", TANGENT, WOLF)
    told = tuple(name for name in names if isinstance(name, tuple) or name in sweep.folder.columns)
    return [Heading("Regimes and exponents"), Text(_DEFINED), sweep_table(sweep, told, sweep.judged, caption)]


def evidence_table(run: Run) -> Table | None:
    """The tests behind the regime, as the row has them (`analysis.evidence_text`)."""
    tests = read_evidence(run["evidence"])
    if not tests:
        return None
    columns = heads("test", ("value", ""), ("threshold", ""), ("met", ""))
    reason = printed(run["regime_reason"].strip()) or "no reason told"
    caption = f"Evidence at {run.named}, in the order of the tests: {reason}."
    rows = tuple((name, *(cell.replace("-", "−") for cell in cells)) for name, *cells in tests)
    return Table(columns, rows, caption, small=True)
