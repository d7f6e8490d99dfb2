"""The first page of every report: what its campaign found, and how long that took; the contents come after it."""

import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from tables import ANSWER, any_rows, count, number, number_of, printed

from .content import Bullets, Heading, Items, Report, Table, Text, heads, strong, with_subscripts
from .provenance import APPENDIX

# an option of a command, and N or a number behind it; KEY=VALUE would make the code too long for a narrow page
_OPTION = re.compile(r"(?<![\w`-])--[a-z][a-z-]*( ([A-Z]|\d+)\b)?")


def opened(report: Report, directory: Path, provenance: Mapping) -> Report:
    """The report with the answer of its campaign in front of it.

    What a report says before its first heading, such as a figure, stays on that page.
    """
    first_page = []
    path = directory / ANSWER
    if path.exists() and "timing" in provenance:
        lines = path.read_text(encoding="utf-8").splitlines()
        if lines:
            first_page.append(Bullets(tuple(map(_with_its_word, lines))))
    duration = how_long(provenance, any_rows(directory / "table.csv"))
    if duration:
        first_page.append(Text(duration))
    items, appendix, end = list(report.items), Heading(APPENDIX), len(report.items)
    if appendix in items:
        end = items.index(appendix)
    return replace(report, items=[*first_page, *items[:end], *symbols(items), *items[end:]])


def symbols(items: Items) -> Items:
    """The list of what the heads of all tables mean, each once; nothing where no head tells it."""
    meanings = {}
    for item in items:
        if isinstance(item, Table):
            for head in item.columns:
                if head.meaning:
                    meanings[head.title, head.unit, head.meaning] = None  # a dictionary: each once, in order
    if not meanings:
        return []
    columns = heads("symbol", "unit", "meaning")
    return [Heading("Symbols"), Table(columns, list(meanings), "The heads of the tables, from `columns.csv`.")]


def _with_its_word(line: str) -> str:
    """A line of the answer as print wants it: its first word in bold type, options of commands as code."""
    line = _OPTION.sub(r"`\g<0>`", with_subscripts(printed(line)))
    word, _, text = line.partition(" ")
    if word.isupper() and text.startswith(" "):
        return f"{strong(word)} {text.lstrip()}"
    return line


def how_long(provenance: Mapping, rows: list[dict[str, str]]) -> str:
    """Runs, wave periods, run time and cores in a sentence; "" where provenance.json has no times."""
    timing, runs = provenance.get("timing") or {}, provenance.get("runs") or {}
    if "run_s" not in timing or not runs.get("total"):
        return ""
    duration_s = timing["run_s"] + timing.get("compile_s", 0.0)
    duration = f"{number(duration_s / 60.0, 2)} minutes"
    if duration_s < 120.0:
        duration = f"{number(duration_s, 2)} s"
    parts = [f"It took {duration}: {count(runs['total'], 'run')}"]
    periods = sum(number_of(row, "periods") for row in rows if row.get("periods"))
    if periods:
        parts.append(f" over {periods:,.0f} periods".replace(",", "\u202f"))
    if runs.get("found"):
        parts.append(f", {count(runs['found'], 'run')} of them from before")
    jobs, cores = provenance.get("jobs"), provenance.get("cpu_count")
    if jobs and cores:
        parts.append(f", {jobs} at a time on {count(cores, 'core')}")
    return f"{''.join(parts)}."
