"""Each case beside its source: rows of cases.csv, the points of both curves, and the table of docs/validation.md."""

from collections.abc import Iterable
from pathlib import Path

from campaigns.columns import Column
from campaigns.machinery.folder import run_of
from campaigns.validation import families
from campaigns.validation.cases import HOLDS, MISSES, NOT_RUN, TOLD, Case, missing

POINTS = (
    Column("case", symbol="case", meaning="name of the case"),
    Column("curve", symbol="curve", meaning="name of the pair of curves, where there are several"),
    Column("x", "", "x", "place on the axis that cases.csv names", 6),
    Column("ours", "", "ours", "our number", 6),
    Column("theirs", "", "theirs", "that of the source", 6),
)


def judged(out: Path, cases: Iterable[Case]) -> tuple[list[dict], list[dict]]:
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
        early = next(
            (f"{run.status}: {run.message}" if run else "no result" for run in runs if not run or run.status != "ok"),
            "",
        )
        if early:
            rows += [base | verdict(case, quantity, None) | {"note": early} for quantity in case.bars]
            continue
        outcome = getattr(families, case.family)(case, runs)
        rows += [
            base | {"note": outcome.note} | verdict(case, name, number) for name, number in outcome.numbers.items()
        ]
        for name, x, ours, theirs in outcome.curves:
            at = {"case": case.name, "curve": name}
            points += [at | {"x": a, "ours": b, "theirs": c} for a, b, c in zip(x, ours, theirs, strict=True)]
    return rows, points


def verdict(case: Case, quantity: str, number: "families.Number | None") -> dict[str, object]:
    """Numbers of a quantity, and its verdict; None: there is no number, and a bar is missed."""
    bar, unit = case.bars.get(quantity, (None, number.unit if number else ""))
    row = {"quantity": quantity, "bar": bar, "unit": unit}
    if number is None:
        return row | {"verdict": MISSES}
    word = TOLD if bar is None else HOLDS if number.error <= bar else MISSES
    return row | {"ours": number.ours, "theirs": number.theirs, "error": number.error, "verdict": word}


def page(rows: Iterable[dict]) -> str:
    """What is judged, as a table in Markdown."""
    lines = ["| case | compared | ours | theirs | error | bar | verdict |", "|---|---|---|---|---|---|---|"]
    for row in rows:
        if row["verdict"] != TOLD:
            error = "" if row.get("error") is None else f"{row['error']:.3g}"
            bar = "" if row.get("bar") is None else f"{row['bar']:g} {row['unit'].partition(' of ')[0]}"
            numbers = (str(row.get(name) or "").replace(" to ", "\u2013") for name in ("ours", "theirs"))
            cells = f"`{row['case']}`", row["quantity"], *numbers, error, bar, row["verdict"]
            lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"
