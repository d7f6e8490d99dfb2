"""The report of `campaigns.accuracy`: what is said, in which order. Everything comes from the campaign's folder."""

import math
from collections.abc import Iterator
from pathlib import Path

from ..parts.content import Bullets, Heading, Item, Report, Table, Text, heads
from ..parts.provenance import appendix, provenance_items, timing_items
from ..parts.sections import section_items
from ..parts.wording import EMPTY, count, decimals, number
from . import sections
from .sections import Study, read_study


def report(directory: str | Path) -> Report:
    """The content of the report on an accuracy folder. Raises FolderError for a folder that is not one."""
    study = read_study(directory)
    works = [name for name in study.works if any(setting.work == name for setting in study.settings)]
    items: list[Item] = [
        *section_items("accuracy", "Question"),
        Heading("The answer in numbers"),
        Bullets(tuple(_short_answer(study, works))),
        Heading("Error against run time"),
        Text(_protocol(study)),
        *(item for name in works for item in sections.work_items(study, name)),
        *peer_items(study),
        *sections.order_items(study),
        *sections.predictability_items(study),
        *cost_items(study),
        *appendix(*timing_items(study.folder), *provenance_items(study.folder)),
    ]
    return Report("Error against run time", "Work-precision of the engine and of other codes", tuple(items))


def _short_answer(study: Study, works: list[str]) -> Iterator[str]:
    yield from filter(None, (sections.level_answer(study, name) for name in works))
    for name in works:
        if (setting := sections.shipped(study, name)) is not None:
            factor, unit = sections.per_period(study, name)
            yield (
                f"The shipped setting (41 nodes, rtol 0.03) on {name}: "
                f"{number(setting.error, 2)} {study.unit(name)} in "
                f"{number(factor * setting.wall_s, 3)} {unit} "
                f"(worst of {setting.rounds} rounds {number(setting.worst, 2)})."
            )
    good, smooth = sections.smooth_series(study)
    if smooth:
        yield f"Orders: {good} of {smooth} series on smooth works end within 0.15 of theory."
    bad = sum(bool(setting.failed) and not setting.peer for setting in study.settings)
    yield f"Settings of ours that ended early in a round and are left out: {bad}."


def _protocol(study: Study) -> str:
    machine, found = study.folder.provenance.get("machine"), study.folder.provenance.get("rounds")
    machine_text = f" on {machine.get('processor')}, {machine.get('cores')} cores" if machine else ""
    rounds = count(found, "round") if isinstance(found, int) else "rounds"
    return (
        f"Timed one run at a time{machine_text}. The settings take turns, {rounds}, "
        f"each with another tolerance or step (0.9 "
        "to 1.1 times the one named), because near a snap the error of a loose setting is partly luck; medians are "
        "shown. Time is that of stepping alone: no compilation, statics, input or output of files."
    )


def cost_items(study: Study) -> Iterator[Item]:
    """Where the time of the shipped setting goes."""
    costs = study.costs
    if costs is None:
        return
    pieces, stepping_ms, python_ms = (costs[name] for name in ("per_iteration_us", "stepping_ms", "python_ms"))
    total = sum(pieces.values())
    rows = [(name, decimals(value, 2), decimals(100 * value / total, 0)) for name, value in pieces.items()]
    costs_per_period = [number(costs[name] / costs["periods"], 3) for name in ("newton_iterations", "steps")]
    caption = (
        f"The shipped setting ({costs['nodes']} nodes, rtol {costs['rtol']:g}, {costs['integrator']}) on the snapping "
        f"buoy over {costs['periods']} wave periods: {costs_per_period[0]} Newton iterations and "
        f"{costs_per_period[1]} steps a period. "
        "Assembly, waves and elimination are timed by themselves, the rest by difference. From `costs.json`."
    )
    yield Heading("Cost of each piece")
    columns = heads("piece", ("per Newton iteration", "µs"), ("share", "%"))
    yield Table(columns, (*rows, ("stepping, all", decimals(total, 2), "100")), caption)
    yield Text(
        f"A call of `simulate` over {costs['periods']} periods takes {decimals(stepping_ms, 1)} ms of stepping and "
        f"{decimals(python_ms, 1)} ms of Python (the scene as numbers, statics, the record: "
        f"{decimals(100 * python_ms / (python_ms + stepping_ms), 0)} %)."
    )


def peer_items(study: Study) -> Iterator[Item]:
    """Other codes: what is left different, what they cost beside ours, what is not installed."""
    of_peers = [setting for setting in study.settings if setting.peer]
    if not of_peers:
        return
    notes = study.folder.provenance.get("peer_notes") or {}
    yield Heading("Other codes")
    yield Bullets(tuple(f"{name}: {text}" for name, text in notes.items()))
    if rows := tuple(row for work in study.works for row in _beside_ours(study, work)):
        times = (("within", ""), ("its time", "ms"), ("ours", "ms"), ("ratio", ""))
        columns = heads("work", "code", *times, "its setting", "our setting", ("off ours", ""))
        caption = (
            "Cheapest settings within an error, each code against its own refined run (scipy against ours: it solves "
            "our equations); ratio: its time over ours, of buoys per wave period. Off ours: its distance from our "
            "refined run, in which the differences of the models show. The two finest levels that it reaches. From "
            "`table.csv`."
        )
        yield Table(columns, rows, caption, small=True)
    if missing := tuple(
        dict.fromkeys((setting.method, setting.status, setting.message) for setting in of_peers if setting.failed)
    ):
        caption = "Settings of other codes without a result. From `table.csv`."
        yield Table(heads("code", "outcome", "why"), missing, caption, small=True)


def _beside_ours(study: Study, work: str) -> Iterator[tuple[str, ...]]:
    """Rows of other codes on a work, at the two finest levels that each reaches."""
    unit, (factor, _) = study.unit(work), sections.per_period(study, work)
    ours = {level: sections.within(study.timed(work, peer=False), level) for level in sections.LEVELS[unit]}
    for name in dict.fromkeys(best.method for best in study.timed(work, peer=True)):
        comparisons = [
            (level, best, sections.within(study.timed(work, name), level)) for level, best in ours.items() if best
        ]
        for level, best, theirs in [comparison for comparison in comparisons if comparison[2]][-2:]:
            off = f"{number(theirs.against_ours, 2)} {unit}" if math.isfinite(theirs.against_ours) else EMPTY
            yield (
                work, name, f"{level:g} {unit}", decimals(factor * theirs.wall_s, 2), decimals(factor * best.wall_s, 2),
                number(theirs.wall_s / best.wall_s, 3), theirs.named, f"{best.method}: {best.named}", off,
            )  # fmt: skip
