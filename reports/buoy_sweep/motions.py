"""Several motions at one value: where each is and how it pulls, and its share of the starts."""

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from ..figures.curves import Curve, Panel
from ..figures.orbit_diagram import cell_edges
from ..parts.content import Item, Table, heads
from ..parts.style import SOFT
from ..parts.wording import EMPTY, decimals, listed, number, of_kicks, ranges
from ..sweep.motions import ends_of
from .runs import Run, Sweep

PEAK = "tension_top_max_N"
_LINES, MARKS = ("-", (0, (4, 1)), (0, (1, 1)), (0, (5, 1, 1, 1))), "osD^vP"
_PERIOD = "period-"


def lines(sweep: Sweep, drawn: Sequence[Run], column: str, scale: float) -> list[Curve]:
    """A column over the runs, a line for each motion, broken where a value of the table has it not; marks: judged."""
    found = []
    for place, (letter, colour) in enumerate(sweep.colours.items()):
        own = {run.steepness: scale * run[column] for run in drawn if run.motion == letter}
        at = sorted({*sweep.values, *own})
        line, mark = _LINES[place % len(_LINES)], MARKS[place % len(MARKS)]
        found.append(Curve(np.array(at), np.array([own.get(kA, np.nan) for kA in at]), "", line, "", colour, width=1.2))
        judged = [kA for kA in sweep.values if kA in own]
        found.append(Curve(np.array(judged), np.array([own[kA] for kA in judged]), "", "", mark, colour, size=2.8))
    return found


def tension_panel(sweep: Sweep, drawn: Sequence[Run], curves: list[Curve], scale: float, label: str) -> Panel:
    """The largest tension of each motion with its letter, and arrows to the motion that follows where one ends."""
    arrows, texts = [], []
    peaks = {run: scale * run[PEAK] for run in drawn if run.known(PEAK)}
    ways = {letter: [run for run in peaks if run.motion == letter] for letter in sweep.colours}
    top, calm = max(peaks.values()), min(filter(None, ways.values()), key=lambda way: max(map(peaks.get, way)))
    for letter, way in ways.items():
        for run in way[len(way) // 2 :][:1]:
            aside = -0.12 if way is calm else 0.26  # nothing stands below the lowest line; numbers stand above others
            texts.append((run.steepness, peaks[run] + aside * top, letter, sweep.colours[letter]))
    for end in ends_of(sweep.folder, "steepness"):
        at = 0.5 * (end["steepness_with"] + end["steepness_without"])
        own = [ways.get(end[name]) for name in ("motion", "leads_to")]
        if all(own):
            start, stop = (peaks[min(way, key=lambda run: abs(run.steepness - at))] for way in own)
            colour = sweep.colours[end["motion"]]
            arrows.append((at, start, stop, colour))
            texts.append((at, start + math.copysign(0.12 * top, start - stop), decimals(at, 3).lstrip("0"), colour))
    limits = {"ylim": (0.0, 1.35 * top)}
    return Panel(curves, y_label=label, settings=limits, arrows=arrows, texts=texts, height=1.5)


def shares_panel(sweep: Sweep) -> list[Panel]:
    """The shares of fresh starts that end in each motion, one on the other; hatched: in none. No panel without any."""
    boxes = []
    for kA, (left, right) in zip(sweep.values, pairwise(cell_edges(np.array(sweep.values))), strict=True):
        own = {run.motion: run["share"] for run in sweep.runs if run.steepness == kA and run.known("share")}
        below = 0.0
        for letter, share in own.items():
            boxes.append((left, right, below, below + share, sweep.colours[letter], ""))
            below += share
        if own and below < 1.0 - 1e-9:
            boxes.append((left, right, below, 1.0, SOFT, "////"))
    axis = {"ylim": (0.0, 1.0), "yticks": (0.5,), "yticklabels": ("50",)}
    return [Panel([], y_label="starts\n(%)", settings=axis, boxes=boxes, height=0.55)] if boxes else []


def motions_items(sweep: Sweep) -> list[Item]:
    """One row a motion: where it is, what it does, how often it is met; nothing where there is one motion."""
    rows, told = [], [name for name in ("found_by", "confirmed") if name in sweep.folder.columns]
    for letter in sweep.colours:
        good = [run for run in sweep.motions[letter] if run.ok and run.known(PEAK)]
        if not good or not letter:
            continue
        peak, at = max(good, key=lambda run: run[PEAK]), {run.steepness for run in good}
        cells = letter, ranges(sweep.values, [kA in at for kA in sweep.values]), _words(good)
        pulls = number(peak[PEAK] / 1e3, 3), number(peak.steepness)
        rows.append((*cells, *pulls, _span(good), *(_said(good, name) for name in told)))
    titles = "motion", "kA", "regime", ("largest T", "kN"), ("at kA =", ""), ("kicks", "")
    columns = heads(*titles, *(name.replace("_", " ") for name in told))
    caption = "The motions. Kicks: fewest and most at a value that end in the motion, of all kicks there."
    return [Table(columns, tuple(rows), caption, small=True)] if rows else []


def _said(runs: Sequence[Run], column: str) -> str:
    """What a column of words says of runs, each once."""
    words = dict.fromkeys(run[column] for run in runs if run[column])
    return listed(words) if words else EMPTY


def _words(runs: Sequence[Run]) -> str:
    """ "period 1, 2 and 6, chaotic": the regimes of runs."""
    found = {run["regime"] for run in runs if run["regime"]}
    periods = sorted(int(word.removeprefix(_PERIOD)) for word in found if word.startswith(_PERIOD))
    said = [f"period {listed(map(str, periods))}"] if periods else []
    return ", ".join([*said, *sorted(word for word in found if not word.startswith(_PERIOD))]) or EMPTY


def _span(runs: Sequence[Run]) -> str:
    """ "2 of 8 to 4 of 8": fewest and most kicks at a value that end in the motion."""
    kicked = sorted((run for run in runs if run.known("share")), key=lambda run: run["share"])
    ends = dict.fromkeys(of_kicks(run.row) for run in (kicked[0], kicked[-1])) if kicked else ()
    return " to ".join(ends) or EMPTY
