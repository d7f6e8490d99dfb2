"""Rows of a table, chosen by their entries and put in order; the entries of a column; the picture of the first page."""

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from tables import Column, number, number_of

from .content import Figure, Heading, Items, flat


def having(rows: Iterable, **wanted: object) -> list:
    """The rows with these entries in the columns of these names."""
    chosen = []
    for row in rows:
        if all(row[name] == entry for name, entry in wanted.items()):
            chosen.append(row)
    return chosen


def entries(rows: Iterable, column: str) -> list:
    """A column of the rows, as it stands there."""
    return [row[column] for row in rows]


def series(rows: Iterable, column: str) -> np.ndarray:
    """A column of numbers over the rows (p,), nan where it is empty."""
    return np.array([number_of(row, column) for row in rows])


def in_order(rows: Iterable[Mapping], keys: Sequence[str]) -> list:
    """The rows of a table by their keys, then by motion."""

    def place(row: Mapping) -> list:
        return [row[name] for name in keys] + [row.get("motion") or ""]

    return sorted(rows, key=place)


def at(keys: Sequence[Column], row: Mapping) -> str:
    """Where a row stands: "H = 21 m, kA = 0.1"; with the letter of its motion, where keys have that: "motion B"."""
    parts = []
    for key in keys:
        if key.digits is None:
            parts.append(f"{key.head} {row[key.name]}")
        else:
            parts.append(f"{key.head} = {number(float(row[key.name]))} {key.unit}".strip())
    return ", ".join(parts)


def batched(items: Sequence, size: int) -> list[Sequence]:
    """The items in their order, `size` of them at a time."""
    return [items[first : first + size] for first in range(0, len(items), size)]


def picture_first(items: Items) -> list:
    """The items with their first figure in front of all, so that it is on the first page.

    A heading that has nothing else below it goes.
    """
    items = flat(items)
    for place, item in enumerate(items):
        if isinstance(item, Figure):
            before, after = items[:place], items[place + 1 :]
            if before and isinstance(before[-1], Heading) and (not after or isinstance(after[0], Heading)):
                before.pop()
            return [item, *before, *after]
    return items
