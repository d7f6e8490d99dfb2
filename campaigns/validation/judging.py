"""Each case beside its source: rows of cases.csv, the points of both curves, and the table of docs/trust.md."""

from collections.abc import Iterable
from pathlib import Path

from campaigns.machinery import run_of
from campaigns.validation import families
from campaigns.validation.cases import HOLDS, MISSES, NOT_RUN, TOLD, Case, missing
from engine import Trajectory
from tables import Column, Row, Rows, of_words

POINTS = (
    of_words("case", "name of the case"),
    of_words("curve", "name of the pair of curves, where there are several"),
    Column("x", "", "x", "place on the axis that cases.csv names", 6),
    Column("ours", "", "ours", "our number", 6),
    Column("theirs", "", "theirs", "that of the source", 6),
)


def judged(out: Path, cases: Iterable[Case]) -> tuple[list, list]:
    """(rows of `cases.JUDGED`, rows of POINTS) of all cases, from the runs in `out`."""
    rows, points = [], []
    for case in cases:
        keys = [job.key for job in case.jobs()]
        base = {name: getattr(case, name) for name in ("title", "source", "assumed", "x_label", "y_label")}
        base |= {"case": case.name, "run_keys": " ".join(keys), "note": missing(case)}
        if base["note"]:
            rows.append(base | {"quantity": next(iter(case.bars), ""), "verdict": NOT_RUN})
            continue
        runs = [run_of(out, {"run_key": key, "status": "ok"}) for key in keys]
        fault = _fault(runs)
        if fault:
            for quantity, (bar, unit) in case.bars.items():  # without a number they are missed
                missed = {"quantity": quantity, "bar": bar, "unit": unit, "verdict": MISSES}
                rows.append(base | missed | {"note": fault})
            continue
        outcome = getattr(families, case.family)(case, runs)
        for quantity, number in outcome.numbers.items():
            rows.append(base | {"note": outcome.note} | verdict(case, quantity, number))
        for curve, *columns in outcome.curves:
            for x, ours, theirs in zip(*columns, strict=True):
                points.append({"case": case.name, "curve": curve, "x": x, "ours": ours, "theirs": theirs})
    return rows, points


def _fault(runs: Iterable[Trajectory | None]) -> str:
    """Why the first of the runs that is missing or ended early did so, "" where all are whole."""
    for run in runs:
        if run is None:
            return "no result"
        if run.status != "ok":
            return f"{run.status}: {run.message}"
    return ""


def verdict(case: Case, quantity: str, number: families.Number) -> Row:
    """Numbers of a quantity, and its verdict."""
    bar, unit = case.bars.get(quantity, (None, number.unit))
    word = MISSES
    if bar is None:
        word = TOLD
    elif number.error <= bar:
        word = HOLDS
    row = {"quantity": quantity, "bar": bar, "unit": unit}
    return row | {"ours": number.ours, "theirs": number.theirs, "error": number.error, "verdict": word}


def page(rows: Rows) -> str:
    """What is judged, as a table in Markdown."""
    lines = ["| case | compared | ours | theirs | error | bar | verdict |", "|---|---|---|---|---|---|---|"]
    for row in rows:
        if row["verdict"] != TOLD:
            lines.append(f"| {' | '.join(_cells(row))} |")
    return "\n".join(lines) + "\n"


def _cells(row: Row) -> list[str]:
    """The cells of a row of `page`."""
    cells = [f"`{row['case']}`", row["quantity"]]
    for name in ("ours", "theirs"):
        cells.append(str(row.get(name) or "").replace(" to ", "\u2013"))
    error, bar = row.get("error"), row.get("bar")
    cells.append("" if error is None else f"{error:.3g}")
    cells.append("" if bar is None else f"{bar:g} {row['unit'].partition(' of ')[0]}")
    cells.append(row["verdict"])
    return cells
