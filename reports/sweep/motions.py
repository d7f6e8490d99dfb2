"""The section on every motion of a sweep over one key: its starts, and where the ranges of its motions end."""

from collections import Counter
from itertools import groupby
from operator import itemgetter

from ..parts.columns import table_of
from ..parts.content import Heading, Item, Table, Text, heads
from ..parts.folder import Folder, part_of
from ..parts.wording import EMPTY, number, percent
from .quantities import in_order

_OUTCOMES = "settled", "joined", "unsettled"  # of a start
_TOLD = (
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
    part = part_of(folder, "ends")
    rows = [row for row in (part.table if part else ()) if row["status"] == "ok"]
    return sorted(rows, key=lambda row: (row["motion"], row[f"{key}_with"]))


def every_motion(folder: Folder, key: str, title: str) -> list[Item]:
    """The section of starts and ends; nothing where no start was told of. key, title: of the column of its values."""
    part = part_of(folder, "starts")
    rows, items = part.table if part else (), []
    if ends := ends_of(folder, key):
        columns, exact = part_of(folder, "ends").columns, ((f"{key}_end", "error"), "kind")
        names = ("motion", "end", f"{key}_with", f"{key}_without", *(exact if "kind" in columns else ()), "leads_to")
        items.append(table_of(columns, names, ends, _ENDS))
    if rows:
        body = []
        for at, group in groupby(in_order(rows, [key]), key=itemgetter(key)):
            own = list(group)
            found = Counter(row["outcome"] for row in own), Counter(row["motion"] for row in own if row["motion"])
            into = ", ".join(f"{letter} {many}" for letter, many in sorted(found[1].items())) or EMPTY
            body.append((number(at), str(len(own)), *(str(found[0][word]) for word in _OUTCOMES), into))
        titles = (title, ""), ("starts", ""), *((word, "") for word in _OUTCOMES), "into motion"
        lost = sum(row["outcome"] == _OUTCOMES[-1] for row in rows)
        caption = (
            f"Starts at each value, {len(rows)} in all, and how many end in which motion; {percent(lost / len(rows))} "
            "are unsettled. From `starts/table.csv`, which has every start."
        )
        items.append(Table(heads(*titles), tuple(body), caption, small=True))
    return [Heading("Every motion"), Text(_TOLD), *items] if items else []
