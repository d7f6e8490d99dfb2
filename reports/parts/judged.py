"""Statements of the paper as a campaign judged them: rows of statements.csv, counts of verdicts, tables."""

from collections.abc import Iterable
from functools import partial
from pathlib import Path

from tables import STATEMENT_COLUMNS, STATEMENTS, read_rows

from .content import Head, Table, heads
from .folder import read_files

Judged = dict[str, str]


def read_statements(directory: Path) -> list[Judged]:
    """The rows of statements.csv. Raises FolderError where they cannot be read."""
    reader = {".csv": partial(read_rows, needed=STATEMENT_COLUMNS)}
    return read_files(directory, {STATEMENTS: "the statements of the paper as judged"}, reader)[STATEMENTS]


def statements_table(rows: Iterable[Judged], caption: str) -> Table:
    """Number, place, statement, verdict, evidence of the rows."""
    columns = heads(("no.", ""), "place")
    for title, share in (("the paper", 3), ("verdict", 3), ("the runs", 5), ("decided by, evidence", 3)):
        columns.append(Head(title, align="left", share=share))
    body = []
    for row in rows:
        verdict = row["verdict"]
        if row["condition"]:
            verdict = f"{verdict}: {row['condition']}"
        evidence = f"{row['threshold']}. {row['evidence']}"
        body.append((row["number"], row["place"], row["statement"], verdict, row["found"], evidence))
    return Table(columns, body, caption)
