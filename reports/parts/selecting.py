"""Rows of a table, chosen by their entries, and the entries of a column."""

from collections.abc import Iterable


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
