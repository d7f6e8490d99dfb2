"""Several motions at one value: where each is and how it pulls, what follows where it ends, its share of starts."""

import math
from collections import Counter
from collections.abc import Sequence
from itertools import groupby, pairwise
from operator import itemgetter

import numpy as np

from ..figures.curves import Curve, Panel
from ..figures.orbit_diagram import cell_edges
from ..parts.columns import table_of
from ..parts.content import Heading, Item, Table, Text, heads
from ..parts.folder import part_of
from ..parts.style import SOFT
from ..parts.wording import EMPTY, decimals, listed, number, percent, ranges
from ..sweep.quantities import in_order
from .runs import Run, Sweep

PEAK = "tension_top_max_N"
_LINES, MARKS = ("-", (0, (4, 1)), (0, (1, 1)), (0, (5, 1, 1, 1))), "osD^vP"
_PERIOD = "period-"
_OUTCOMES = "settled", "joined", "unsettled"  # of a start
_TOLD = (
    "At each value the motion starts from rest, from kicks of the buoy and from the motions of its neighbours. A start "
    "ends when it has settled, or when it has joined a motion that is known at that value; unsettled ones belong to no "
    "motion. A share is that of the fresh starts, not of those carried over."
)
_ENDS = (
    "Ends of the ranges of motions, found by bisection: the last value with the motion, the first one without it, and "
    "the motion that follows there. From `ends/table.csv`."
)


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
    for end in _ends(sweep):
        at = 0.5 * (end["steepness_with"] + end["steepness_without"])
        own = [ways.get(end[name]) for name in ("motion", "leads_to")]
        if all(own):
            start, stop = (peaks[min(way, key=lambda run: abs(run.steepness - at))] for way in own)
            colour = sweep.colours[end["motion"]]
            arrows.append((at, start, stop, colour))
            texts.append((at, start + math.copysign(0.12 * top, start - stop), decimals(at, 3).lstrip("0"), colour))
    limits = {"ylim": (0.0, 1.35 * top)}
    return Panel(curves, y_label=label, settings=limits, arrows=arrows, texts=texts, height=1.5)


def _ends(sweep: Sweep) -> list[dict]:
    """The ends of ranges that were found, by motion and value."""
    part = part_of(sweep.folder, "ends")
    rows = [row for row in (part.table if part else ()) if row["status"] == "ok"]
    return sorted(rows, key=lambda row: (row["motion"], row["steepness_with"]))


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
    titles = "motion", "kA", "regime", ("largest T", "kN"), ("at kA =", ""), ("share", "%")
    columns = heads(*titles, *(name.replace("_", " ") for name in told))
    caption = "The motions. Share: of the fresh starts at a value."
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
    """ "25 to 50": least and greatest share of starts, in percent."""
    shares = [run["share"] for run in runs if run.known("share")]
    said = dict.fromkeys(number(100.0 * share, 2) for share in (min(shares), max(shares))) if shares else ()
    return " to ".join(said) or EMPTY


def every_motion(sweep: Sweep) -> list[Item]:
    """The section of starts and ends; nothing where there is one motion and no start was told of."""
    part = part_of(sweep.folder, "starts")
    rows, items = part.table if part else (), []
    if ends := _ends(sweep):
        names = ("motion", "end", "steepness_with", "steepness_without", "leads_to")
        items.append(table_of(part_of(sweep.folder, "ends").columns, names, ends, _ENDS))
    if rows:
        body = []
        for kA, group in groupby(in_order(rows, ["steepness"]), key=itemgetter("steepness")):
            own = list(group)
            found = Counter(row["outcome"] for row in own), Counter(row["motion"] for row in own if row["motion"])
            into = ", ".join(f"{letter} {many}" for letter, many in sorted(found[1].items())) or EMPTY
            body.append((number(kA), str(len(own)), *(str(found[0][word]) for word in _OUTCOMES), into))
        titles = ("kA", ""), ("starts", ""), *((word, "") for word in _OUTCOMES), "into motion"
        lost = sum(row["outcome"] == _OUTCOMES[-1] for row in rows)
        caption = (
            f"Starts at each value, {len(rows)} in all, and how many end in which motion; {percent(lost / len(rows))} "
            "are unsettled. From `starts/table.csv`, which has every start."
        )
        items.append(Table(heads(*titles), tuple(body), caption, small=True))
    return [Heading("Every motion"), Text(_TOLD), *items] if items else []
