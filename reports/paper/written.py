"""The tables of the report that no run decides, from tables.toml: misprints, what is not judged, what was chosen."""

from __future__ import annotations

import tomllib
from pathlib import Path

from ..parts.content import Column, Table

TABLES = Path(__file__).with_name("tables.toml")


def written(name: str, **taken: str) -> Table:
    """A table by its name in the file; taken: the words that stand in braces there."""
    told = tomllib.loads(TABLES.read_text(encoding="utf-8"))[name]
    rows = tuple(tuple(cell.format(**taken) for cell in row) for row in told["rows"])
    return Table(tuple(Column(title, align="left") for title in told["heads"]), rows, told["caption"], small=True)
