"""The report of `campaigns.accuracy`: what is said, in which order. Everything comes from the campaign's folder."""

from __future__ import annotations

from pathlib import Path

from ..parts.content import Bullets, Heading, Item, Report, Text
from ..parts.provenance import provenance_items, timing_table
from ..parts.wording import count, number
from .sections import per_period, shipped, work_items
from .study import Study, read_study
from .tables import cost_items, failed_count, level_answer, order_items, peer_items, predictability_items


def report(directory: str | Path) -> Report:
    """The content of the report on an accuracy folder. Raises FolderError for a folder that is not one."""
    study = read_study(directory)
    works = [name for name in study.works if any(one.work == name for one in study.settings)]
    times = timing_table(study.folder)
    items: list[Item] = [
        Heading("Question"),
        Text(
            "What does an error cost? Every method of the engine, scipy's solvers on the engine's own equations in "
            "space, and other codes where they are installed, run the same works; each run's error is set against "
            "the time it took. Which grid and tolerance to choose follows from the diagrams; whether a method keeps "
            "its order, from the tables of slopes."
        ),
        Heading("Short answer"),
        Bullets(_short_answer(study, works)),
        Heading("Error against run time"),
        Text(_protocol(study)),
        *(item for name in works for item in work_items(study, name)),
        *peer_items(study),
        *order_items(study),
        *predictability_items(study),
        *cost_items(study),
        *([Heading("Run times"), times] if times else []),
        *provenance_items(study.folder),
    ]
    return Report("Error against run time", "Work-precision of the engine and of other codes", tuple(items))


def _short_answer(study: Study, works: list[str]) -> tuple[str, ...]:
    lines = [level_answer(study, name) for name in works]
    for name in works:
        one = shipped(study, name)
        if one is not None:
            factor, unit = per_period(study, name)
            lines.append(
                f"The shipped setting (41 nodes, rtol 0.03) on {name}: {number(one.error, 2)} "
                f"{study.works[name]['unit']} in "
                f"{number(factor * one.wall_s, 3)} {unit} (worst of {one.rounds} rounds {number(one.worst, 2)})."
            )
    judged = [row for row in study.orders if row["kind"] != "tolerance" and not row["rough"] and row["within"]]
    if judged:
        good = sum(row["within"] == "1" for row in judged)
        lines.append(f"Orders: {good} of {len(judged)} series on smooth works end within 0.15 of theory.")
    return tuple(line for line in (*lines, failed_count(study)) if line)


def _protocol(study: Study) -> str:
    machine = study.folder.provenance.get("machine") or {}
    where = f" on {machine.get('processor')}, {machine.get('cores')} cores," if machine else ""
    found = study.folder.provenance.get("rounds")
    rounds = count(found, "round") if isinstance(found, int) else "rounds"
    return (
        f"Timed one run at a time{where} settings in turns, {rounds}, each with another tolerance or step "
        "(0.9 to 1.1 times the one named), because near a snap the error of a loose setting is partly luck; medians "
        "are shown. Time is that of stepping alone: no compilation, statics, input or output of files."
    )
