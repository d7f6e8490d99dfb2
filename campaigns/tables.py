"""A campaign's table as it lies in its folder: rows of words and numbers, told apart by its dictionary."""

import csv
from pathlib import Path

from campaigns.columns import dictionary_path

Row = dict[str, object]


def read_rows(path: Path) -> tuple[Row, ...]:
    """The rows of a table: words as they are, numbers as floats, nan where the table is empty.

    Raises OSError where table or dictionary cannot be read, ValueError where they do not fit each other.
    """
    words = {row["name"] for row in _read(dictionary_path(path)) if not row["digits"]}
    rows = [
        {name: text if name in words else float(text or "nan") for name, text in row.items()} for row in _read(path)
    ]
    if not rows:
        raise ValueError(f"{path.name} has no rows")
    return tuple(rows)


def _read(path: Path) -> list[dict[str, str]]:
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))
