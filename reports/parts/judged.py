"""Statements of the paper as a campaign judged them: rows of statements.csv, counts of verdicts, tables."""

from collections.abc import Iterable
from pathlib import Path

from .content import Column, Table
from .folder import FolderError, read_files

FILE = "statements.csv"
COLUMNS = ("number", "place", "statement", "verdict", "condition", "found", "threshold", "evidence")
HOLDS, HOLDS_IF, FAILS, OPEN = "holds", "holds if", "does not hold", "–"
VERDICTS = {HOLDS: "hold", HOLDS_IF: "hold under a condition", FAILS: "do not hold", OPEN: "are not decided"}
Judged = dict[str, str]


def read_statements(directory: Path) -> tuple[Judged, ...]:
    """The rows of statements.csv. Raises FolderError where they cannot be read."""
    rows = read_files(directory, {FILE: "the statements of the paper as judged"})[FILE]
    if not all(tuple(row) == COLUMNS for row in rows):
        raise FolderError(directory, [f"{FILE} cannot be read: its first line is not {','.join(COLUMNS)}"])
    return tuple(rows)


def counted(rows: Iterable[Judged]) -> str:
    """How many hold, and so on: "3 hold, 1 do not hold"."""
    verdicts = [row["verdict"] for row in rows]
    return (
        ", ".join(f"{verdicts.count(word)} {phrase}" for word, phrase in VERDICTS.items() if word in verdicts) or "none"
    )


def statements_table(rows: Iterable[Judged], caption: str) -> Table:
    """Number, place, statement, verdict, evidence of the rows."""
    titles = (("place", 1), ("the paper", 3), ("verdict", 3), ("the runs", 5), ("decided by, evidence", 3))
    heads = (Column("no."), *(Column(title, align="left", share=share) for title, share in titles))
    body = []
    for row in rows:
        verdict = f"{row['verdict']}: {row['condition']}" if row["condition"] else row["verdict"]
        first = (row[name] for name in COLUMNS[:3])
        body.append((*first, verdict, row["found"], f"{row['threshold']}. {row['evidence']}"))
    return Table(heads, tuple(body), caption, small=True)
