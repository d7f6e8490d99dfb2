"""How a campaign was made, from its provenance.json: where its time went, and the table of all entries."""

from __future__ import annotations

import shlex

from .content import Column, Heading, Item, Listing, Table, Text
from .folder import Folder
from .wording import EMPTY, decimals, number

_TIMES = {
    "compile_s": "compiling the kernels",
    "run_s": "runs with their analysis",
    "analysis_s": "of it analysis, summed over workers",
    "report_s": "report",
}


def timing_table(folder: Folder) -> Table | None:
    """The time split of a campaign, None where its provenance has none."""
    timing = folder.provenance.get("timing")
    if not isinstance(timing, dict) or not timing:
        return None
    rows = tuple(
        (_TIMES.get(name, name.removesuffix("_s").replace("_", " ")), decimals(float(time), 2))
        for name, time in timing.items()
        if isinstance(time, (int, float))
    )
    caption = "Where the time of the campaign went, from `provenance.json`."
    return Table((Column("part", align="left"), Column("wall time", "s")), rows, caption)


def provenance_items(folder: Folder) -> list[Item]:
    """The command and everything else that provenance.json holds."""
    command = folder.provenance.get("command")
    items: list[Item] = [Heading("Provenance")]
    if command:
        items += [
            Text("The command:"),
            Listing(shlex.join(map(str, command)) if isinstance(command, list) else str(command)),
        ]
    rows = tuple(
        (f"`{key}`", text) for key, text in _flat(folder.provenance) if key.split(".")[0] not in ("command", "timing")
    )
    if rows:
        columns = (Column("entry", align="left"), Column("value", align="left"))
        items.append(Table(columns, rows, "All of `provenance.json` but the command and the times.", small=True))
    return items


def _flat(section: dict, prefix: str = "") -> list[tuple[str, str]]:
    rows = []
    for key, entry in section.items():
        if isinstance(entry, dict):
            rows += _flat(entry, f"{prefix}{key}.")
        elif isinstance(entry, list):
            words = [number(e) if isinstance(e, float) else str(e) for e in entry]
            short = words if len(words) <= 12 else [words[0], words[1], "…", words[-1]]
            said = ", ".join(short) + (f" ({len(words)} entries)" if short != words else "")
            rows.append((prefix + key, said or EMPTY))
        else:
            rows.append((prefix + key, EMPTY if entry in (None, "") else str(entry)))
    return rows
