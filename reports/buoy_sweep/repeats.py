"""The section of a sweep's report on its own error against run time, from `accuracy/table.csv` in its folder."""

from __future__ import annotations

import csv
import math
from pathlib import Path

from ..parts.content import Column, Heading, Item, Table, Text
from ..parts.wording import EMPTY, decimals, number

FILE = "accuracy/table.csv"
AS_RUN = "as run"


def accuracy_items(directory: Path, named: str) -> list[Item]:
    """The section; a sentence where the check was left out. named: symbol of what names a run, as "kA"."""
    heading = Heading("Error against run time")
    rows = _rows(directory)
    if not rows:
        text = (
            "This sweep did not repeat any of its runs (`--no-accuracy`, or no run ended as asked), so that it says "
            "nothing about its own error. What tolerance and grid give in general: docs/how_far_to_trust_a_run.md."
        )
        return [heading, Text(text)]
    return [heading, Text(_said(rows, named)), _table(rows, named)]


def _rows(directory: Path) -> list[dict[str, str]]:
    try:
        with open(directory / FILE, encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))
    except (OSError, ValueError):
        return []


def _said(rows: list[dict[str, str]], named: str) -> str:
    parts = []
    for role in dict.fromkeys(row["role"] for row in rows):
        own = [row for row in rows if row["role"] == role]
        again = [row for row in own if row["run"] != AS_RUN]
        early = [1e3 * float(row["error_early_m"]) for row in again if row["error_early_m"]]
        whole = [1e3 * float(row["error_m"]) for row in again if row["error_m"]]
        if not early:
            parts.append(f"The {role} run ({named} = {number(float(own[0]['label']))}) could not be repeated.")
            continue
        said = (
            f"The {role} run ({named} = {number(float(own[0]['label']))}): r changes by {number(max(early), 2)} mm "
            f"rms over the first ten wave periods and by {number(max(whole), 2)} mm over {own[0]['periods']}"
        )
        judged = [row for row in again if row["same_verdict"]]
        if not judged:
            said += "; the record is too short for a verdict"
        elif all(row["same_verdict"] == "1" for row in judged):
            said += f"; it is called {judged[0]['verdict']} each time"
        else:
            said += "; its verdict changes: " + ", ".join(
                f"{row['verdict']} ({row['run']})" for row in own if row["verdict"]
            )
        parts.append(said + ".")
    return (
        "Two runs of this sweep were repeated at a tenth of the tolerance and at twice the elements: the one whose "
        "tension peaks lowest and the one whose tension peaks highest. "
        + " ".join(parts)
        + " Past the limit of predictability r differs by the "
        "size of the motion, whatever the tolerance; verdicts and extremes are then what may be compared."
    )


def _table(rows: list[dict[str, str]], named: str) -> Table:
    columns = (
        Column("run", align="left"), Column(named), Column("repeated", align="left"), Column("status", align="left"),
        Column("nodes"), Column("rtol"), Column("periods"), Column("r, 10 periods", "mm"), Column("r, all", "mm"),
        Column("verdict", align="left"), Column("wall", "s"), Column("of as run"),
    )  # fmt: skip
    cells = []
    for row in rows:
        base = next((float(one["wall_s"]) for one in rows if one["role"] == row["role"] and one["run"] == AS_RUN
                     and one["wall_s"]), math.nan)  # fmt: skip
        wall = _number(row["wall_s"])
        again = row["run"] != AS_RUN
        cells.append((
            row["role"], number(float(row["label"])), row["run"], row["status"], row["nodes"],
            number(_number(row["rtol"] or row["step_s"])), row["periods"],
            number(1e3 * _number(row["error_early_m"]), 2) if again else EMPTY,
            number(1e3 * _number(row["error_m"]), 2) if again else EMPTY,
            row["verdict"] or EMPTY, decimals(wall, 3), decimals(wall / base, 1) if base > 0 else EMPTY,
        ))  # fmt: skip
    caption = (
        "Runs repeated: rms difference in r from the run as it was made, the verdict on records of one length, and "
        "the seconds each took (rtol: or the fixed step in s). From `accuracy/table.csv`."
    )
    return Table(columns, tuple(cells), caption, small=True)


def _number(text: str) -> float:
    return float(text) if text else math.nan
