"""The first page of every report: what its campaign found, and how long that took; the contents come after it."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from .columns import value
from .content import Bullets, Item, Report, Text
from .folder import read_rows
from .wording import count, number, printed

ANSWER = "answer.txt"


def opened(report: Report, directory: Path, made: Mapping) -> Report:
    """The report with the answer of its campaign in front of it. made: provenance.json.

    What a report says before its first heading, such as a figure, stays on that page.
    """
    path, took = directory / ANSWER, how_long(made, read_rows(directory / "table.csv"))
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() and "timing" in made else []
    first: list[Item] = [Bullets(tuple(map(printed, lines)))] if lines else []
    return replace(report, items=(*first, *([Text(took)] if took else []), *report.items))


def how_long(made: Mapping, rows: list[dict[str, str]]) -> str:
    """Runs, wave periods, run time and cores in a sentence; "" where provenance.json has no times."""
    timing, runs = made.get("timing") or {}, made.get("runs") or {}
    if "run_s" not in timing or not runs.get("total"):
        return ""
    periods = sum(value(row, "periods") for row in rows if row.get("periods"))
    over = f" over {periods:,.0f} periods".replace(",", "\u202f") if periods else ""
    reused = f", {count(runs['found'], 'run')} of them from before" if runs.get("found") else ""
    jobs, cores = made.get("jobs"), made.get("cpu_count")
    machine = f", {jobs} at a time on {count(cores, 'core')}" if jobs and cores else ""
    took_s = timing["run_s"] + timing.get("compile_s", 0.0)
    took = f"{number(took_s, 2)} s" if took_s < 120.0 else f"{number(took_s / 60.0, 2)} minutes"
    return f"It took {took}: {count(runs['total'], 'run')}{over}{reused}{machine}."
