"""Figures of a buoy sweep, and the tables beside them, each with its caption."""

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from analysis import read_evidence
from engine.animation import shapes_of
from tables import (
    CAPPED,
    OPEN,
    PAPER_STEEPNESS,
    PEAK,
    PERIODIC,
    TANGENT_ERROR,
    TANGENT_EXPONENT,
    WOLF_ERROR,
    WOLF_EXPONENT,
    count,
    decimals,
    number,
    printed,
)

from ..figures.animations import tether_animation, tether_stills
from ..figures.curves import Curve, Panel, dots
from ..figures.orbit_diagram import OrbitDiagram, Strobes
from ..parts import T_I, T_S, Figure, Heading, Items, Table, Text, entries, heads, in_order, plain, series
from ..parts.style import BLUE, INK, REGIME_COLOURS, kind_of
from .motions import MARKS, lines, shares_panel, tension_panel
from .runs import STEEPNESS, Run, Sweep

_DEFINED = (
    "A run is looked at after 90, 135, 205, ... wave periods, each time without its first third. A word counts when "
    "two looks in a row find it, or a clear one from 465 periods on (docs/motions.md). Periodic: the strobed orbit "
    "repeats, and perturbations do not grow in the later half. "
    "Chaotic: the exponent of the tangent dynamics is positive by 3.5 errors, by two in the later half, and again at a "
    "tenth of the tolerance (`regime_tighter`). Quasi-periodic: the exponent is zero within a stated bound, neighbours "
    "stay, and a spectral line does not fit the waves. Transient: still changing at the end of the record. Everything "
    "else is undecided. A verdict is one over the periods of the run: a longer chaotic transient is called chaotic."
)


def orbit_figure(sweep: Sweep) -> Figure | None:
    """The answer in one figure; None where no run has strobed points."""
    drawn = [run for run in (*sweep.good, *sweep.between) if len(run.section)]
    if not drawn:
        return None
    drawn.sort(key=lambda run: (run.value, run.motion))
    columns = [Strobes(run.value, run.section[:, 0], run.get("regime") or "", run.motion) for run in drawn]
    missing = [run.value for run in sweep.runs if run not in drawn]
    first, last = drawn[0].value, drawn[-1].value
    marks = []
    if sweep.key.name == STEEPNESS.name:
        marks = [(kA, "paper") for kA in PAPER_STEEPNESS if first <= kA <= last]
    static_N, scale, unit = None, 1e-3, "(kN)"
    if sweep.modes and sweep.modes.static_tension_N:
        static_N = sweep.modes.static_tension_N
        scale, unit = 1.0 / static_N, "over static"
    tension, exponent = _tension(sweep, drawn, scale, unit), _exponent_panel(sweep)
    motions, ranges, labels = {}, {}, (axis_of(sweep), "strobed r (m)")
    if sweep.colours:
        below = [tension, *shares_panel(sweep)]
        if exponent is not None:
            below.append(exponent._replace(height=0.8))
        for letter, colour in sweep.colours.items():
            if letter:
                motions[letter] = (colour, _motion_title(sweep, letter))
    else:
        slack = Curve(series(drawn, sweep.key.name), 100.0 * series(drawn, "slack_fraction"), colour=INK)
        below = list(filter(None, (Panel([slack], y_label="slack (%)"), exponent, tension)))
        for word, holds in _excursions(sweep, drawn).items():
            ranges[_EXCURSIONS[word]] = holds
    caption = " ".join(filter(None, _caption(sweep, drawn, static_N)))
    alt = f"Orbit diagram over {plain(sweep.key.head)}: {_described(sweep, motions)}; see text."
    return OrbitDiagram(columns, labels, below, ranges, marks, missing, motions).figure(caption, alt)


def axis_of(sweep: Sweep) -> str:
    """The label of what is varied."""
    return "wave steepness kA (–)" if sweep.key.name == STEEPNESS.name else sweep.key.label


def _described(sweep: Sweep, motions: Mapping[str, tuple[str, str]]) -> str:
    """The motions and how often each regime comes, for those who cannot see the figure."""
    parts, regimes = [], []
    for letter, (_, title) in motions.items():
        parts.append(f"motion {letter} {title}")
    for word, runs in Counter(entries(sweep.judged, "regime")).items():
        regimes.append(f"{word} {runs} times")
    return "; ".join([*parts, ", ".join(regimes)])


_EXCURSIONS = {"flies": "whole sphere above still water", "loops": "loops released"}


def _excursions(sweep: Sweep, runs: Sequence[Run]) -> dict[str, np.ndarray]:
    """What only some runs do: for each word of _EXCURSIONS that holds for any of these, (n,) for which it does."""
    height_m, in_space = series(runs, "max_buoy_height_above_water_m"), series(runs, "dimensions") == 3
    holds = {
        "flies": height_m > sweep.folder.scene.buoy.diameter_m,
        "loops": (series(runs, "loop_releases") > 0) & ~in_space,
    }
    return {word: of_runs for word, of_runs in holds.items() if of_runs.any()}


def _motion_title(sweep: Sweep, letter: str) -> str:
    """A motion in the legend: its largest tension, and in a word each what else some of its runs do."""
    runs = sweep.motions[letter]
    parts = [f"up to {number(np.nanmax(series(runs, PEAK)) / 1e3, 3)} kN"]
    return ", ".join([*parts, *_excursions(sweep, runs)])


def _caption(sweep: Sweep, drawn: Sequence[Run], static_N: float | None) -> Iterator[str]:
    """The caption."""
    yield f"r at t = k{T_I} after the transient, over {sweep.key.head}, in the colour of the"
    if sweep.colours:
        yield "motion. Each has a bar with its regimes (numbers: periods after which it repeats)."
        words = [f"{word}: {_EXCURSIONS[word]}" for word in _excursions(sweep, drawn)]
        if words:
            yield f"{'; '.join(words).capitalize()}."
    elif sweep.judged:
        yield "regime (numbers in the bar: periods after which it repeats)."
    else:
        yield "regime."
    between = [run for run in drawn if run in sweep.between]
    if between:
        runs, longest = count(len(between), "short run"), number(max(run.periods_done for run in between), 3)
        colour = ", coloured like the most similar neighbour" if sweep.colours else ""
        yield f"Thin dashes: {runs} ({longest} periods) between the values of the table{colour}; not judged."
    tension = "largest tension"
    if static_N:
        tension = f"largest tension over the static {T_S} = {number(static_N)} N"
    exponent = "largest exponent with two standard errors, where the regime needs it"
    if sweep.colours:
        yield f"Below: {tension}, with arrows to the motion that follows where one ends; shares of the kicks, the most"
        yield f"dangerous motion lowest with its 95 % interval (hatched: not settled); {exponent}."
    else:
        yield f"Below: time with less than 5 % of the static tension; {exponent}; {tension}."
    undecided = sweep.runs_with(lambda run: run["regime"] in OPEN)
    if undecided:
        yield f"Not decided: {sweep.at(undecided)}."
    elif sweep.judged:
        yield "Not decided: no run."


def _exponent_panel(sweep: Sweep) -> Panel | None:
    """Exponents in the colours of the regimes; by Wolf's method where no other is known, and never where r repeats.

    None where no run has one.
    """
    y, bars, words = [], [], []
    for run in sweep.judged:
        word = kind_of(run["regime"])
        exponent, error = math.nan, math.nan
        if run.known(TANGENT_EXPONENT):
            exponent, error = run[TANGENT_EXPONENT], run[TANGENT_ERROR]
        elif word != PERIODIC:
            exponent, error = run[WOLF_EXPONENT], run[WOLF_ERROR]
        y.append(exponent)
        bars.append(2.0 * error)
        words.append(word)
    x, y, bars = series(sweep.judged, sweep.key.name), np.array(y), np.array(bars)
    known = np.isfinite(y)
    if not known.any():
        return None
    names, colours = np.array(words), REGIME_COLOURS
    if sweep.colours:
        names, colours = np.array(entries(sweep.judged, "motion")), sweep.colours
    marks = dict(zip(sweep.colours, MARKS, strict=False))
    lines = []
    for name in dict.fromkeys(names[known]):
        points = known & (names == name)
        lines.append(dots(x[points], y[points], marks.get(name, "o"), colours[name], 3.0, error=bars[points]))
    usual = np.minimum(np.nan_to_num(bars), 3.0 * float(np.nanmedian(bars)))  # one long bar would hide the others
    margin = 0.08 * float(np.ptp(y[known])) + 0.01
    limits = float((y - usual)[known].min()) - margin, float((y + usual)[known].max()) + margin
    return Panel(lines, y_label="exponent\n(bits/wave)", level=0.0, ylim=limits)


def _tension(sweep: Sweep, drawn: Sequence[Run], scale: float, unit: str) -> Panel:
    label, capped, cap_name = f"largest T\n{unit}", _capped(sweep), f"{CAPPED}, on the same scale"
    cap_x, cap_y = series(capped, sweep.key.name), scale * series(capped, PEAK)
    if not sweep.colours:
        curves = [Curve(series(drawn, sweep.key.name), scale * series(drawn, PEAK), "as run", colour=INK)]
        if capped:
            curves.append(Curve(cap_x, cap_y, cap_name, colour=BLUE))
        return Panel(curves, y_label=label, ylim=(0.0, None))
    curves = lines(sweep, drawn, PEAK, scale)
    if capped:
        curves.append(dots(cap_x, cap_y, "_", INK, name=cap_name))  # of one motion or another
    return tension_panel(sweep, drawn, curves, scale, label)


def _run(sweep: Sweep, row: Mapping[str, object]) -> Run:
    """A row of a folder beside the table."""
    if not sweep.colours:
        row = {**row, "motion": ""}
    return Run(row)


def _capped(sweep: Sweep) -> list[Run]:
    """The runs with the wetted cap that ended as asked, by value."""
    runs = []
    for row in in_order(sweep.folder.part("companions").completed, [sweep.key.name]):
        if row["role"] == CAPPED:
            runs.append(_run(sweep, row))
    return runs


def close_up_items(sweep: Sweep) -> Items:
    """Heading and figure; nothing where no run was kept with its tether."""
    part = sweep.folder.part("close_up")
    if not part.completed:
        return []
    row = part.completed[-1]
    trajectory, _ = part.trajectory(row)
    if trajectory is None:
        return []
    try:
        snap = shapes_of(trajectory)
    except ValueError:  # no shapes were kept
        return []
    periods, tension_N = snap.record
    place = np.argmax(tension_N)
    seen = f"{number(float(tension_N[place]), 3)} N at t/{T_I} = {decimals(float(periods[place]), 2)}"
    caption = (
        f"Buoy and tether at {_run(sweep, row).named} in true proportion, at six values of "
        f"t/{T_I} (above each), and the tension at its top, at most {seen}. Thick: parts without tension; "
        "the wave is the linear one. From the profiles in `close_up/trajectories`."
    )
    alt = f"The tether at six moments as the buoy comes back and pulls it taut, with the top tension, at most {seen}."
    figure = Figure(tether_stills(snap), caption, alt, tether_animation(snap))
    return [Heading("The tether as it snaps"), figure]


def regime_items(sweep: Sweep) -> Items:
    """What the words mean; nothing where no run has a regime."""
    if not sweep.judged:
        return []
    return [Heading("Regimes"), Text(_DEFINED)]


def evidence_table(run: Run) -> Table | None:
    """The tests behind the regime, as the row has them (`analysis.evidence_text`)."""
    tests = read_evidence(run["evidence"])
    if not tests:
        return None
    columns = heads("test", ("value", ""), ("threshold", ""), ("met", ""))
    reason = printed(run["regime_reason"].strip()) or "no reason told"
    caption = f"Evidence at {run.named}, in the order of the tests: {reason}."
    rows = []
    for name, *cells in tests:
        rows.append((name, *(cell.replace("-", "−") for cell in cells)))
    return Table(columns, rows, caption)
