"""The section of a sweep's report on its own error against run time, from `accuracy/table.csv` in its folder."""

from __future__ import annotations

import csv
import math
from pathlib import Path

from ..parts.columns import number_of, read_columns, table_of
from ..parts.content import Heading, Item, Text
from ..parts.wording import number

FOLDER = "accuracy"
AS_RUN = "as run"


def accuracy_items(directory: Path, named: str) -> list[Item]:
    """The section; a sentence where the check was left out. named: symbol of what names a run, as "kA"."""
    heading = Heading("Error against run time")
    rows = _rows(directory / FOLDER)
    if not rows:
        text = (
            "This sweep did not repeat any of its runs (`--no-accuracy`, or no run ended as asked), so that it says "
            "nothing about its own error. What tolerance and grid give in general: docs/how_far_to_trust_a_run.md."
        )
        return [heading, Text(text)]
    columns = read_columns(directory / FOLDER)
    names = [
        "role", "label", "run", "status", "nodes", "rtol", "periods", "error_early_m", "error_m", "verdict", "wall_s",
    ]  # fmt: skip
    caption = "Runs repeated: what changed against the run as it was made. From `accuracy/table.csv`."
    own = {"rtol": lambda row: number(number_of(row["rtol"] or row["step_s"]))}
    return [heading, Text(_said(rows, named)), table_of(columns, names, rows, caption, own)]


def _rows(folder: Path) -> list[dict[str, str]]:
    try:
        with open(folder / "table.csv", encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))
    except (OSError, ValueError):
        return []


def _said(rows: list[dict[str, str]], named: str) -> str:
    parts = [
        _of_one([row for row in rows if row["role"] == role], named) for role in dict.fromkeys(r["role"] for r in rows)
    ]
    return (
        "Two runs of this sweep were repeated at a tenth of the tolerance and at twice the elements: the one whose "
        f"tension peaks lowest and the one whose tension peaks highest. {' '.join(parts)} Past the limit of "
        "predictability r differs by the size of the motion, whatever the tolerance; verdicts and extremes are then "
        "what may be compared."
    )


def _of_one(own: list[dict[str, str]], named: str) -> str:
    name = f"The {own[0]['role']} run ({named} = {number(float(own[0]['label']))})"
    again = [row for row in own if row["run"] != AS_RUN]
    early, whole = (
        max((1e3 * float(row[column]) for row in again if row[column]), default=math.nan)
        for column in ("error_early_m", "error_m")
    )
    if math.isnan(early):
        return f"{name} could not be repeated."
    judged = [row for row in again if row["same_verdict"]]
    if not judged:
        verdict = "the record is too short for a verdict"
    elif all(row["same_verdict"] == "1" for row in judged):
        verdict = f"it is called {judged[0]['verdict']} each time"
    else:
        verdict = "its verdict changes: " + ", ".join(
            f"{row['verdict']} ({row['run']})" for row in own if row["verdict"]
        )
    return (
        f"{name}: r changes by {number(early, 2)} mm rms over the first ten wave periods and by {number(whole, 2)} mm "
        f"over {own[0]['periods']}; {verdict}."
    )
