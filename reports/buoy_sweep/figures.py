"""Figures of a buoy sweep, and the tables beside them, each with its caption."""

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from analysis import read_evidence

from ..figures.animations import Snap, tether_animation, tether_stills
from ..figures.curves import Curve, Panel
from ..figures.orbit_diagram import NARROW_IN, Column, Range, orbit_diagram
from ..parts.content import Figure, Heading, Item, Table, Text, heads
from ..parts.folder import part_of
from ..parts.style import BLUE, INK, REGIME_COLOURS, WIDTH_IN
from ..parts.wording import T_I, T_S, count, decimals, number, printed
from ..sweep.quantities import in_order, series
from .motions import MARKS, PEAK, lines, shares_panel, tension_panel
from .runs import PAPER_STEEPNESS, Run, Sweep
from .tables import sweep_table

TANGENT, WOLF = (
    (f"lyapunov_{how}_bits_per_period", f"lyapunov_{how}_error") for how in ("tangent", "wolf")
)  # the largest exponents in the table, each with its standard error
_PERIOD = "period-"
_SHOWN_PERIODS = 3.0  # of the tether as it snaps
_CAP = "wetted cap"  # role in companions/table.csv
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
    drawn.sort(key=lambda run: (run.steepness, run.motion))
    missing = [run.steepness for run in sweep.runs if run not in drawn]
    columns = [Column(run.steepness, run.section[:, 0], run.row.get("regime") or "", run.motion) for run in drawn]
    static_N = sweep.modes.static_tension_N if sweep.modes else None
    beyond = [Range(text, [holds(sweep, run) for run in drawn]) for text, (_, holds) in _BEYOND.items()]
    ranges = [] if sweep.colours else [one for one in beyond if any(one.holds)]
    marks = [(kA, "paper") for kA in PAPER_STEEPNESS if drawn[0].steepness <= kA <= drawn[-1].steepness]
    scale, unit = (1.0 / static_N, "over static") if static_N else (1e-3, "(kN)")
    below = [_tension(sweep, drawn, scale, unit)]
    if sweep.colours:
        below = [*below, *shares_panel(sweep), *(replace(one, height=0.8) for one in _exponent_panel(sweep))]
    else:
        below = [_slack(drawn), *_exponent_panel(sweep), *below]
    labels = "wave steepness kA (–)", "strobed r (m)"
    motions = {letter: (colour, _called(sweep, letter)) for letter, colour in sweep.colours.items() if letter}
    shown = columns, labels, below, ranges, marks, missing
    wide, narrow = (orbit_diagram(*shown, width_in, motions) for width_in in (WIDTH_IN, NARROW_IN))
    caption = " ".join(filter(None, _seen(sweep, drawn, static_N)))
    words = [f"{word} {n} times" for word, n in Counter(run["regime"] for run in sweep.judged).items()]
    told = "; ".join([*(f"motion {letter} {said}" for letter, (_, said) in motions.items()), ", ".join(words)])
    alt = f"Orbit diagram over wave steepness: {told}; see text."
    return Figure(wide, caption, alt, narrow=narrow)


def _flies(sweep: Sweep, run: Run) -> bool:
    """Whether all of the sphere leaves the water."""
    return bool(run["max_buoy_height_above_water_m"] > sweep.folder.scene.buoy.diameter_m)


def _loops(sweep: Sweep, run: Run) -> bool:
    """Whether loops were released in the plane."""
    return run["loop_releases"] > 0 and not run.in_space


_BEYOND = {"whole sphere above still water": ("flies", _flies), "loops released": ("loops", _loops)}  # short, which


def _called(sweep: Sweep, letter: str) -> str:
    """What the legend says of a motion: its largest tension, and in short what else some of its runs do."""
    runs = sweep.motions[letter]
    more = [short for short, holds in _BEYOND.values() if any(holds(sweep, run) for run in runs)]
    return ", ".join([f"up to {number(np.nanmax(_of(runs, PEAK)) / 1e3, 3)} kN", *more])


def _seen(sweep: Sweep, drawn: Sequence[Run], static_N: float | None) -> Iterator[str]:
    """The caption."""
    yield f"r at t = k{T_I} after the transient, over wave steepness, in the colour of the"
    if sweep.colours:
        yield "motion. Each has a bar with its regimes (numbers: periods after which it repeats)."
        told = [f"{short}: {text}" for text, (short, holds) in _BEYOND.items() if any(holds(sweep, r) for r in drawn)]
        yield f"{'; '.join(told).capitalize()}." if told else ""
    else:
        yield f"regime{' (numbers in the bar: periods after which it repeats)' if sweep.judged else ''}."
    if beside := [run for run in drawn if run in sweep.between]:
        longest = number(max(run.periods_done for run in beside), 3)
        said = ", and have the colour of the motion beside them that is most alike" if sweep.colours else ""
        yield f"{count(len(beside), 'run')} between those of the table, over {longest} periods, were not judged{said}."
    tension = f"largest tension{f' over the static {T_S} = {number(static_N)} N' if static_N else ''}"
    exponent = "largest exponent with two standard errors, where the regime needs it"
    if sweep.colours:
        yield f"Below: {tension}, with arrows to the motion that follows where one ends; shares of the fresh starts"
        yield f"(hatched: not settled); {exponent}."
    else:
        yield f"Below: time with less than 5 % of the static tension; {exponent}; {tension}."
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
    colours, marks = sweep.colours or REGIME_COLOURS, dict(zip(sweep.colours, MARKS, strict=False))
    names = np.array([run.motion for run in sweep.judged] if sweep.colours else words)
    lines = []
    for name in dict.fromkeys(names[known]):
        own = known & (names == name)
        lines.append(Curve(x[own], y[own], "", "", marks.get(name, "o"), colours[name], bars[own], 3.0))
    usual = np.minimum(np.nan_to_num(bars), 3.0 * float(np.nanmedian(bars)))  # one long bar would hide the others
    margin = 0.08 * float(np.ptp(y[known])) + 0.01
    limits = float((y - usual)[known].min()) - margin, float((y + usual)[known].max()) + margin
    return [Panel(lines, y_label="exponent\n(bits/wave)", level=0.0, settings={"ylim": limits})]


def _tension(sweep: Sweep, drawn: Sequence[Run], scale: float, unit: str) -> Panel:
    several, label = bool(sweep.colours), f"largest T\n{unit}"
    shown = [Curve(_of(drawn, "steepness"), scale * _of(drawn, PEAK), "as run", colour=INK)]
    shown = lines(sweep, drawn, PEAK, scale) if several else shown
    if capped := _capped(sweep):
        look = {"line": "", "mark": "_", "colour": INK} if several else {"colour": BLUE}  # of one motion or another
        shown.append(Curve(_of(capped, "steepness"), scale * _of(capped, PEAK), _CAP, **look))
    if several:
        return tension_panel(sweep, drawn, shown, scale, label)
    return Panel(shown, y_label=label, settings={"ylim": (0.0, None)})


def _run(sweep: Sweep, row: Mapping[str, object]) -> Run:
    """A row of a folder beside the table."""
    return Run(row if sweep.colours else {**row, "motion": ""})


def _capped(sweep: Sweep) -> list[Run]:
    """The runs with the wetted cap that ended as asked, by steepness."""
    part = part_of(sweep.folder, "companions")
    rows = in_order(part.table if part else (), ["steepness"])
    return [_run(sweep, row) for row in rows if row["role"] == _CAP and row["status"] == "ok"]


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
        f"Buoy and tether at {_run(sweep, rows[-1]).named} in true proportion, at six values of "
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
    anchor = scene.anchor.position_m  # places of a run are told from there
    surface = scene.water.depth_m - anchor[2] + elevation_m(scene, lines.time_s[inside][:, None], anchor[0] + across)
    record = time_s[part] / period_s, top[part]
    times = lines.time_s[inside] / period_s
    return Snap(times, x, z, lines.tension_N[inside], scene.buoy.diameter_m, (across, surface), record)


def regime_items(sweep: Sweep) -> list[Item]:
    """What the words mean, and the exponents of the runs; nothing where no run has a regime."""
    if not sweep.judged:
        return []
    caption = "Regime, and largest exponent with one standard error after the transient, where the regime needs it."
    names = ("regime", "periods", "transient_periods", TANGENT, WOLF)
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
