"""What campaigns say at their end, in sentences: what of it several campaigns share.

A study's `answer(order, rows)` gives at most eight sentences, made of nothing but the rows of its tables; the command
prints them and keeps them as answer.txt, where its report finds them.
"""

import math
from collections.abc import Iterator, Mapping
from functools import partial
from operator import itemgetter
from pathlib import Path

from tables import FAILS, PEAK, STATEMENTS, Row, Rows, any_rows, listed, number_of, typed, verdict_counts

CHAOS_OF_ONE_GRID = "Chaos was found on one grid of the line; campaigns.sweep over a key looks on a finer one."
SMALL_N = 10.0  # below it a force is told in newtons
NOTHING_LASTS = {"LOAD": "not known, because no run lasts beyond the transient."}


def greatest(rows: Rows, name: str) -> Row | None:
    """The row in which a column is greatest; None where no row knows it."""
    return max(known_rows(rows, name), key=partial(number_of, name=name), default=None)


def known_rows(rows: Rows, name: str) -> list[Row]:
    """The rows that know a number of a column."""
    return [row for row in rows if math.isfinite(number_of(row, name))]


def numbers_of(rows: Rows, name: str) -> list[float]:
    """The numbers of a column, nan where a row has none."""
    return [number_of(row, name) for row in rows]


def line(word: str, text: str) -> str:
    """A line of an answer, with its word in front; the texts of all lines stand below each other."""
    return f"{word:<8} {text}"


def lasting(rows: Rows) -> list[Row]:
    """The rows of runs that reached their end and have a largest tension after their transient."""
    return [row for row in known_rows(rows, PEAK) if row["status"] == "ok"]


def lines(texts: Mapping[str, str]) -> list[str]:
    """The lines of an answer of texts by their words; without those that have no text."""
    return [line(word, text) for word, text in texts.items() if text]


def in_newtons(*forces_N: float, digits: int = 3) -> str:
    """ "9.45 kN"; without an exponent, "1234 kN"; of several "4.4 -> 9.4 kN"; of a model in a tank "0.594 N"."""
    unit, unit_N = "kN", 1e3
    if max(map(abs, forces_N)) < SMALL_N:
        unit, unit_N = "N", 1.0
    return f"{' -> '.join(typed(force_N / unit_N, digits) for force_N in forces_N)} {unit}"


def verdicts(folder: Path, quoted: int) -> Iterator[str]:
    """How many of the paper's statements hold, by statements.csv; then the first `quoted` that do not, a line each."""
    statements = any_rows(folder / STATEMENTS)
    if not statements:  # as where no run ended
        return
    yield f"Of {len(statements)} statements of the paper: {verdict_counts(statements)}."
    failing = [row for row in statements if row["verdict"] == FAILS]
    for row in failing[:quoted]:
        yield f"Does not hold: {row['statement']}"
    numbers = listed(map(itemgetter("number"), failing[quoted:]))
    if len(failing) > quoted:
        yield f"{('Those', 'Further ones')[quoted > 0]} that do not: no. {numbers} of {STATEMENTS}."
