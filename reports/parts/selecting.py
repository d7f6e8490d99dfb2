"""Rows of a table, chosen by their entries, the entries of a column, and the picture of the first page."""

from collections.abc import Iterable

import numpy as np

from tables import number_of

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
