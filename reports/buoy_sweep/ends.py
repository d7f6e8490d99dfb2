"""The section on every motion of a sweep over one key: its starts, and where the ranges of its motions end."""

import math
from collections import Counter
from collections.abc import Sequence
from itertools import groupby
from operator import itemgetter

from tables import EMPTY, OUTCOMES, UNSETTLED, number, number_of, percent

from ..parts import Folder, Heading, Items, Table, Text, heads, in_order, plus_minus, table_of

_METHOD = (
    "At each value the motion starts from rest, from kicks of the buoy and from the motions of its neighbours. A start "
    "ends when it has settled, or when it has joined a motion that is known at that value; unsettled ones belong to no "
    "motion. A share is that of the kicks, not of the other starts."
)
_ENDS = (
    "Ends of the ranges of motions, found by bisection: the last value with the motion, the first one without it, and "
    "the motion that follows there. Where the orbit of the motion tells it, the end and its kind: two orbits meet at a "
    "fold, the period doubles at a flip. From `ends/table.csv`."
)


def ends_of(folder: Folder, key: str) -> list[dict]:
    """The ends of ranges that were found, by motion and value."""
    return sorted(folder.part("ends").completed, key=lambda row: (row["motion"], row[f"{key}_with"]))


def place_of(end: dict, key: str) -> float:
    """Where a motion ends: by its orbit, or else in the middle of the bisected range."""
    exact = number_of(end, f"{key}_end")
    return exact if math.isfinite(exact) else 0.5 * (end[f"{key}_with"] + end[f"{key}_without"])


def every_motion(folder: Folder, key: str, title: str) -> Items:
    """The section of starts and ends; nothing where there are no tables of them. key, title: of the varied column."""
    ends, starts = ends_of(folder, key), folder.part("starts").table
    if not ends and not starts:
        return
    yield Heading("Every motion")
    yield Text(_METHOD)
    if ends:
        yield _ends_table(folder.part("ends"), ends, key)
    if starts:
        yield _starts_table(starts, key, title)


def _ends_table(part: Folder, ends: list[dict], key: str) -> Table:
    """Where the ranges of motions end, with the exact end where the table has one."""
    names = ["motion", "end", f"{key}_with", f"{key}_without"]
    own_cells = {}
    if "kind" in part.columns:
        exact = part.columns[f"{key}_end"]
        own_cells[exact.name] = plus_minus(exact, part.columns["error"])
        names += [exact.name, "kind"] + ["no_orbit"] * ("no_orbit" in part.columns)
    return table_of(part.columns, [*names, "leads_to"], ends, _ENDS, own_cells)


def _starts_table(rows: Sequence[dict], key: str, title: str) -> Table:
    """How many starts at each value end in which way, and in which motion."""
    body, unsettled = [], 0
    for value, group in groupby(in_order(rows, [key]), key=itemgetter(key)):
        starts, outcomes, motions = 0, Counter(), Counter()
        for row in group:
            starts += 1
            outcomes[row["outcome"]] += 1
            if row["motion"]:
                motions[row["motion"]] += 1
        unsettled += outcomes[UNSETTLED]
        counts = [str(outcomes[word]) for word in OUTCOMES]
        reached = ", ".join(f"{letter} {motions[letter]}" for letter in sorted(motions))
        body.append((number(value), str(starts), *counts, reached or EMPTY))
    titles = [(title, ""), ("starts", "")]
    for word in OUTCOMES:
        titles.append((word, ""))
    caption = (
        f"Starts at each value, {len(rows)} in all, and how many end in which motion; {percent(unsettled / len(rows))} "
        "are unsettled. From `starts/table.csv`, which has every start."
    )
    return Table(heads(*titles, "into motion"), body, caption)
