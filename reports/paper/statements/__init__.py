"""Every quantitative or qualitative statement of sections 4.1 and 4.2 and of the conclusions, judged by the runs.

Claims are in our own words. Each function of the modules here takes the Results and gives one Statement whose verdict
follows from its checks; the lists at their ends say where in the paper it stands and what else supports the number.
"""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass

from ...parts.statements import Statement
from ..results import Results

COLUMNS = ("number", "place", "statement", "verdict", "condition", "found", "threshold", "evidence")


@dataclass(frozen=True)
class Placed:
    """A judged statement, its place in the paper, and what supports it: refinement, other method, code, closed form."""

    number: int
    place: str
    statement: Statement
    evidence: str


def judged(results: Results) -> tuple[Placed, ...]:
    """All statements, in the order of the paper."""
    from . import calm, closing, line, plane, violent

    buoy = (*calm.STATEMENTS, *violent.STATEMENTS, *plane.STATEMENTS)
    asked = (*closing.METHOD, *line.STATEMENTS, *buoy, *closing.CONCLUSIONS)
    return tuple(
        Placed(number, place, state(results), evidence) for number, (place, state, evidence) in enumerate(asked, 1)
    )


def as_csv(placed: tuple[Placed, ...]) -> bytes:
    """statements.csv."""
    from ...parts.content import plain

    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(COLUMNS)
    for one in placed:
        said = one.statement
        cells = (one.number, one.place, said.claim, said.verdict, said.condition, said.found, said.threshold)
        writer.writerow([plain(str(cell)) for cell in (*cells, one.evidence)])
    return text.getvalue().encode()
