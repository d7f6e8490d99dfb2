"""The cases of the stability report: a table for each group, and what ended otherwise than "ok", with the reasons."""

from __future__ import annotations

import math

from ..parts.content import Bullets, Column, Heading, Item, Table, Text
from ..parts.wording import EMPTY, number
from .folder import Study, value

TITLES = {
    "EI": "Bending stiffness, 0 to 1e4 N m²",
    "EA": "Axial stiffness, 1e-2 to 1e4 of Table 1",
    "f'": "Tension laws that lose their slope",
    "nodes": "Grids, 3 to 5000 nodes",
    "mass": "Density and added mass",
    "water": "Water and currents",
    "waves": "Steepness to 0.4, periods of 0.5 to 60 s",
    "surface": "Buoys partly out of the water, irregular seas",
    "start": "Blows, slack, horizontal and upside-down starts",
    "snap": "Slack taken up at speed",
    "push": "A straight line pushed together",
    "steps": "Fixed steps and tolerances far from usual",
    "input": "Values that no scene should have",
    "drift": "A long regular run",
}
HOW = (
    "How we know: “closed form”: the largest distance from it; “refinement” or a run on other nodes: rms difference of "
    "r from a run of twice the elements and a tenth of the tolerance (or the nodes named), over the range of r; "
    "“energy”: largest change of the total over the largest kinetic energy, without water; “static equilibrium stays”, "
    "“symmetry”, “r stays”: the largest movement over the length; “finite and complete”: every sample is there and a "
    "number, which is asked of every run besides. The case is ok where the measured number is below its bar."
)


def case_items(study: Study) -> list[Item]:
    """A heading, a table and its caption for each group."""
    items: list[Item] = [Heading("Cases and verdicts"), Text(HOW)]
    for group in study.groups():
        items += [Heading(TITLES.get(group, group), 2), _table(study, group)]
    return items


def _table(study: Study, group: str) -> Table:
    heads = (
        Column("case", align="left"),
        Column("D"),
        Column("verdict", align="left"),
        Column("ended", align="left"),
        Column("how we know", align="left"),
        Column("measured"),
        Column("bar"),
        Column("run", "s"),
        Column("wall", "s"),
    )
    rows = tuple(
        (
            row["case"],
            row["dimensions"],
            row["verdict"],
            row["run_status"],
            row["how"],
            _small(value(row, "measured")),
            _small(value(row, "bar")) if value(row, "bar") > 0 else EMPTY,
            number(value(row, "length_s"), 3),
            number(value(row, "case_wall_s"), 2),
        )
        for row in study.group(group)
    )
    caption = (
        f"{TITLES.get(group, group)}. D: dimensions of the motion; run: length of the run; wall: all runs of the case. "
        "From `table.csv`."
    )
    return Table(heads, rows, caption, small=True)


def _small(measured: float) -> str:
    return EMPTY if not math.isfinite(measured) else f"{measured:.1e}" if measured else "0"


def limit_items(study: Study) -> list[Item]:
    """What ended otherwise than "ok", and what the user is told."""
    items: list[Item] = [Heading("Known limits")]
    limits = study.judged("known limit")
    reasons = dict.fromkeys(row["limit"] for row in limits)
    lines = []
    for reason in reasons:
        rows = [row for row in limits if row["limit"] == reason]
        names = "; ".join(f"{row['case']} ({row['run_status']})" for row in rows)
        lines.append(f"{reason[:1].upper()}{reason[1:]}. Seen in: {names}.")
    items.append(Bullets(tuple(lines)) if lines else Text("None was met."))
    refused = study.judged("refused")
    items.append(Heading("Refused, and what the user is told", 2))
    if not refused:
        return [*items, Text("Nothing was refused.")]
    columns = (Column("case", align="left"), Column("message", align="left"))
    rows = tuple((row["case"], row["message"].removeprefix("faulty scene: ")) for row in refused)
    return [*items, Table(columns, rows, "Scenes that were not started. From `table.csv`.", small=True)]
