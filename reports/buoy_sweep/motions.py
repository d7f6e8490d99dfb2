"""Several motions at one value: where each is and how it pulls, and its share of the starts."""

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from tables import EMPTY, PEAK, PERIODIC, decimals, listed, number, of_kicks, ranges

from ..figures.curves import Curve, Panel
from ..figures.orbit_diagram import cell_edges
from ..parts import Items, Table, heads
from ..parts.style import SOFT
from ..sweep.motions import ends_of
from ..sweep.quantities import series
from .runs import Run, Sweep

_LINES, MARKS = ("-", (0, (4, 1)), (0, (1, 1)), (0, (5, 1, 1, 1))), "osD^vP"


def lines(sweep: Sweep, drawn: Sequence[Run], column: str, scale: float) -> list[Curve]:
    """A column over the runs, a line for each motion, broken where a value of the table has it not; marks: judged."""
    curves = []
    for place, (letter, colour) in enumerate(sweep.colours.items()):
        values = {}
        for run in drawn:
            if run.motion == letter:
                values[run.steepness] = scale * run[column]
        x = np.array(sorted({*sweep.values, *values}))
        y = np.array([values.get(kA, np.nan) for kA in x])
        judged = np.isin(x, sweep.values) & np.isin(x, list(values))
        line, mark = _LINES[place % len(_LINES)], MARKS[place % len(MARKS)]
        curves.append(Curve(x, y, "", line, "", colour, width=1.2))
        curves.append(Curve(x[judged], y[judged], "", "", mark, colour, size=2.8))
    return curves


def tension_panel(sweep: Sweep, drawn: Sequence[Run], curves: list[Curve], scale: float, label: str) -> Panel:
    """The largest tension of each motion with its letter, and arrows to the motion that follows where one ends."""
    peaks = {}  # letter -> steepness and largest tension along its motion
    largest = {}  # of each motion
    top = 0.0
    for run in drawn:
        if not run.known(PEAK):
            continue
        peak = scale * run[PEAK]
        top = max(top, peak)
        if run.motion in sweep.colours:
            peaks.setdefault(run.motion, []).append((run.steepness, peak))
            largest[run.motion] = max(peak, largest.get(run.motion, 0.0))
    letters = [letter for letter in sweep.colours if letter in peaks]
    calm = min(letters, key=largest.get)
    arrows, texts = [], []
    for letter in letters:
        line = peaks[letter]
        kA, peak = line[len(line) // 2]
        offset = -0.12 if letter == calm else 0.26  # nothing stands below the lowest line; numbers stand above others
        texts.append((kA, peak + offset * top, letter, sweep.colours[letter]))
    for end in ends_of(sweep.folder, "steepness"):
        if end["motion"] not in largest or end["leads_to"] not in largest:
            continue
        kA = 0.5 * (end["steepness_with"] + end["steepness_without"])
        start, stop = _nearest(peaks[end["motion"]], kA), _nearest(peaks[end["leads_to"]], kA)
        colour = sweep.colours[end["motion"]]
        arrows.append((kA, start, stop, colour))
        texts.append((kA, start + math.copysign(0.12 * top, start - stop), decimals(kA, 3).lstrip("0"), colour))
    limits = {"ylim": (0.0, 1.35 * top)}
    return Panel(curves, y_label=label, settings=limits, arrows=arrows, texts=texts, height=1.5)


def _nearest(line: Sequence[tuple[float, float]], kA: float) -> float:
    """The value of the point of a line, (steepness, value) each, that is nearest to this steepness."""
    _, value = min(line, key=lambda point: abs(point[0] - kA))
    return value


def shares_panel(sweep: Sweep) -> list[Panel]:
    """The shares of fresh starts that end in each motion, one on the other; hatched: in none. No panel without any."""
    shares = {}  # steepness -> share of each motion
    for run in sweep.runs:
        if run.known("share"):
            shares.setdefault(run.steepness, {})[run.motion] = run["share"]
    boxes = []
    for kA, (low, high) in zip(sweep.values, pairwise(cell_edges(np.array(sweep.values))), strict=True):
        if kA not in shares:
            continue
        total = 0.0
        for letter, share in shares[kA].items():
            boxes.append((low, high, total, total + share, sweep.colours[letter], ""))
            total += share
        if total < 1.0 - 1e-9:
            boxes.append((low, high, total, 1.0, SOFT, "////"))
    if not boxes:
        return []
    axis = {"ylim": (0.0, 1.0), "yticks": (0.5,), "yticklabels": ("50",)}
    return [Panel([], y_label="starts\n(%)", settings=axis, boxes=boxes, height=0.55)]


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
        places = np.isin(sweep.values, series(good, "steepness"))
        row = [letter, ranges(sweep.values, places), _regimes(good)]
        row += [number(strongest[PEAK] / 1e3, 3), number(strongest.steepness), _kicks(good)]
        for name in word_columns:
            row.append(_words(good, name))
        rows.append(row)
    if not rows:
        return []
    titles = ["motion", "kA", "regime", ("largest T", "kN"), ("at kA =", ""), ("kicks", "")]
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
