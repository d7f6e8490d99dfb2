"""Several motions at one value: where each is and how it pulls, and its share of the starts."""

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from tables import EMPTY, PEAK, PERIODIC, listed, number, of_kicks, ranges

from ..figures.curves import Curve, Panel, dots
from ..figures.orbit_diagram import cell_edges
from ..parts import Items, Table, heads, series
from ..parts.style import INK, SOFT
from .ends import ends_of, place_of
from .runs import Run, Sweep

_LINES, MARKS = ("-", (0, (4, 1)), (0, (1, 1)), (0, (5, 1, 1, 1))), "osD^vP"


def lines(sweep: Sweep, drawn: Sequence[Run], column: str, scale: float) -> list[Curve]:
    """A column over the runs, a line for each motion, broken where a value of the table has it not; marks: judged."""
    curves = []
    for place, (letter, colour) in enumerate(sweep.colours.items()):
        values = {}
        for run in drawn:
            if run.motion == letter:
                values[run.value] = scale * run[column]
        x = np.array(sorted({*sweep.values, *values}))
        y = np.array([values.get(value, np.nan) for value in x])
        judged = np.isin(x, sweep.values) & np.isin(x, list(values))
        line, mark = _LINES[place % len(_LINES)], MARKS[place % len(MARKS)]
        curves.append(Curve(x, y, "", line, "", colour, width=1.2))
        curves.append(dots(x[judged], y[judged], mark, colour, 2.8))
    return curves


def tension_panel(sweep: Sweep, drawn: Sequence[Run], curves: list[Curve], scale: float, label: str) -> Panel:
    """The largest tension of each motion with its letter, and arrows to the motion that follows where one ends."""
    peaks = {}  # letter -> value and largest tension along its motion
    largest = {}  # of each motion
    for run in drawn:
        if run.known(PEAK):
            peak = scale * run[PEAK]
            peaks.setdefault(run.motion, []).append((run.value, peak))
            largest[run.motion] = max(peak, largest.get(run.motion, 0.0))
    top = max(largest.values())
    letters = [letter for letter in sweep.colours if letter in peaks]
    calm = min(letters, key=largest.get)
    arrows, texts = [], []
    for letter in letters:
        line = peaks[letter]
        middle, peak = line[len(line) // 2]
        offset = -0.12 if letter == calm else 0.26  # nothing stands below the lowest line; numbers stand above others
        texts.append((middle, peak + offset * top, letter, sweep.colours[letter]))
    for end in ends_of(sweep.folder, sweep.key.name):
        if end["motion"] not in largest or end["leads_to"] not in largest:
            continue
        place = place_of(end, sweep.key.name)
        start, stop = _nearest(peaks[end["motion"]], place), _nearest(peaks[end["leads_to"]], place)
        colour = sweep.colours[end["motion"]]
        arrows.append((place, start, stop, colour))
        height = start + math.copysign(0.12 * top, start - stop)
        texts.append((place, height, number(place, 3).removeprefix("0"), colour))
    span = sweep.values[-1] - sweep.values[0]
    texts = _apart(texts, 0.07 * span, 0.15 * top)
    return Panel(curves, y_label=label, ylim=(0.0, 1.35 * top), arrows=arrows, texts=texts, height=1.5)


def _apart(texts: Sequence[tuple], wide: float, high: float) -> list[tuple]:
    """The texts (x, y, text, colour), each raised until none before it is nearer than `wide` and `high`."""
    placed: list[tuple] = []
    for x, y, text, colour in texts:
        while any(abs(x - other_x) < wide and abs(y - other_y) < 0.99 * high for other_x, other_y, *_ in placed):
            y += high
        placed.append((x, y, text, colour))
    return placed


def _nearest(line: Sequence[tuple[float, float]], place: float) -> float:
    """The value of the point of a line, (place, value) each, that is nearest to a place."""
    _, value = min(line, key=lambda point: abs(point[0] - place))
    return value


def shares_panel(sweep: Sweep) -> list[Panel]:
    """The shares of kicks that end in each motion, one on the other; hatched: in none. No panel without any.

    The motion of the largest tension is lowest, with the interval of its share.
    """
    shares, lowest = {}, _of_largest_tension(sweep)  # shares: value -> share of each motion
    for run in sorted(sweep.runs, key=lambda run: (run.motion != lowest, run.motion)):
        if run.known("share"):
            shares.setdefault(run.value, {})[run.motion] = run["share"]
    boxes = []
    for value, (low, high) in zip(sweep.values, pairwise(cell_edges(np.array(sweep.values))), strict=True):
        if value not in shares:
            continue
        total = 0.0
        for letter, share in shares[value].items():
            boxes.append((low, high, total, total + share, sweep.colours[letter], ""))
            total += share
        if total < 1.0 - 1e-9:
            boxes.append((low, high, total, 1.0, SOFT, "////"))
    if not boxes:
        return []
    axis = {"yticks": (0.5,), "yticklabels": ("50",)}
    intervals = []
    for run in sweep.motions[lowest]:
        if run.known("share_low"):
            ends = np.array([run["share_low"], run["share_high"]])
            intervals.append(Curve(np.full(2, run.value), ends, colour=INK, width=0.8))
    return [Panel(intervals, y_label="kicks\n(%)", settings=axis, ylim=(0.0, 1.0), boxes=boxes, height=0.75)]


def _of_largest_tension(sweep: Sweep) -> str:
    """The letter of the motion that pulls hardest."""
    known = sweep.runs_with(lambda run: run.known(PEAK) and run.motion)
    return max(known, key=lambda run: run[PEAK]).motion


def motions_items(sweep: Sweep) -> Items:
    """One row a motion: where it is, what it does, how often it is met; nothing where there is one motion."""
    rows, word_columns = [], []
    for name in ("found_by", "confirmed"):
        if name in sweep.folder.columns:
            word_columns.append(name)
    for letter in sweep.colours:
        good = [run for run in sweep.motions[letter] if run.ok and run.known(PEAK)]
        if not good or not letter:
            continue
        strongest = max(good, key=lambda run: run[PEAK])
        places = np.isin(sweep.values, series(good, sweep.key.name))
        row = [letter, ranges(sweep.values, places), _regimes(good)]
        row += [number(strongest[PEAK] / 1e3, 3), number(strongest.value), _kicks(good)]
        for name in word_columns:
            row.append(_words(good, name))
        rows.append(row)
    if not rows:
        return []
    symbol = sweep.key.head
    titles = ["motion", symbol, "regime", ("largest T", "kN"), (f"at {symbol} =", ""), ("kicks", "")]
    for name in word_columns:
        titles.append(name.replace("_", " "))
    caption = "The motions. Kicks: fewest and most at a value that end in the motion, of all kicks there."
    return [Table(heads(*titles), rows, caption)]


def _words(runs: Sequence[Run], column: str) -> str:
    """The words of a column of runs, each once."""
    words = dict.fromkeys(run[column] for run in runs if run[column])
    return listed(words) if words else EMPTY


def _regimes(runs: Sequence[Run]) -> str:
    """ "period 1, 2 and 6, chaotic": the regimes of runs."""
    periods, words = set(), set()
    for run in runs:
        regime = run["regime"]
        if regime.startswith(PERIODIC):
            periods.add(int(regime.removeprefix(PERIODIC)))
        elif regime:
            words.add(regime)
    parts = sorted(words)
    if periods:
        parts.insert(0, f"period {listed(map(str, sorted(periods)))}")
    return ", ".join(parts) or EMPTY


def _kicks(runs: Sequence[Run]) -> str:
    """ "2 of 8 to 4 of 8": fewest and most kicks at a value that end in the motion."""
    kicked = [run for run in runs if run.known("share")]
    if not kicked:
        return EMPTY
    kicked.sort(key=lambda run: run["share"])
    fewest, most = of_kicks(kicked[0]), of_kicks(kicked[-1])
    if fewest == most:
        return fewest
    return f"{fewest} to {most}"
