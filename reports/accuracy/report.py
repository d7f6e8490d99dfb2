"""The report of `campaigns.accuracy`: what is said, in which order. Everything comes from the campaign's folder."""

import math
from collections.abc import Iterator
from pathlib import Path

from tables import EMPTY, count, decimals, number

from ..parts import Bullets, Heading, Items, Report, Table, Text, heads, report_page, section_items, timing_items
from . import sections
from .sections import Study, read_study

SNAPPING = ("snap", "violent")  # works whose diagram is on the first page, in this order


def report(directory: Path) -> Report:
    """The content of the report on an accuracy folder. Raises FolderError for a folder that is not one."""
    study = read_study(directory)
    items, drawn = [], ""
    for name in (*SNAPPING, *study.works):  # on the first page: the first work with a run that ended as asked
        if study.timed(name):
            drawn = name
            items.append(sections.diagram(study, name))
            break
    items += [section_items("accuracy"), Heading("Error against run time"), Text(_protocol(study))]
    works = {setting.work for setting in study.settings}
    for name in study.works:
        if name in works:
            items.append(sections.work_items(study, name, drawn))
    items += [peer_items(study), sections.order_items(study)]
    subtitle = "Work-precision of the engine and of other codes"
    return report_page(study.folder, "Error against run time", items, timing_items(study.folder), subtitle)


def _protocol(study: Study) -> str:
    machine, rounds = study.folder.provenance.get("machine"), study.folder.provenance.get("rounds")
    machine_text, rounds_text = "", "rounds"
    if machine:
        machine_text = f" on {machine.get('processor')}, {machine.get('cores')} cores"
    if isinstance(rounds, int):
        rounds_text = count(rounds, "round")
    return (
        f"Timed one run at a time{machine_text}. The settings take turns, {rounds_text}, "
        f"each with another tolerance or step (0.9 "
        "to 1.1 times the one named), because near a snap the error of a loose setting is partly luck; medians are "
        "shown. Time is that of stepping alone: no compilation, statics, input or output of files."
    )


def peer_items(study: Study) -> Items:
    """Other codes: what is left different, what they cost beside ours, what is not installed."""
    of_peers = [setting for setting in study.settings if setting.peer]
    if not of_peers:
        return
    notes = study.folder.provenance.get("peer_notes") or {}
    yield Heading("Other codes")
    yield Bullets([f"{name}: {text}" for name, text in notes.items()])
    rows = []
    for work in study.works:
        rows += _beside_ours(study, work)
    if rows:
        times = (("within", ""), ("its time", "ms"), ("ours", "ms"), ("ratio", ""))
        columns = heads("work", "code", *times, "its setting", "our setting", ("off ours", ""))
        caption = (
            "Cheapest settings within an error, each code against its own refined run (scipy against ours: it solves "
            "our equations); ratio: its time over ours, of buoys per wave period. Off ours: its distance from our "
            "refined run, in which the differences of the models show. The two finest levels that it reaches. From "
            "`table.csv`."
        )
        yield Table(columns, rows, caption)
    missing = {}
    for setting in of_peers:
        if setting.failed:
            missing[setting.method, setting.status, setting.message] = None  # a dictionary: each once, in order
    if missing:
        caption = "Settings of other codes without a result. From `table.csv`."
        yield Table(heads("code", "outcome", "why"), list(missing), caption)


def _beside_ours(study: Study, work: str) -> Iterator[tuple[str, ...]]:
    """Rows of other codes on a work, at the two finest levels that each reaches."""
    unit, (factor, _) = study.unit(work), sections.per_period(study, work)
    our_settings = study.timed(work, peer=False)
    for name in dict.fromkeys(setting.method for setting in study.timed(work, peer=True)):
        reached = []
        for level in sections.LEVELS[unit]:
            best, theirs = sections.within(our_settings, level), sections.within(study.timed(work, name), level)
            if best is not None and theirs is not None:
                reached.append((level, best, theirs))
        for level, best, theirs in reached[-2:]:
            off = EMPTY
            if math.isfinite(theirs.against_ours):
                off = f"{number(theirs.against_ours, 2)} {unit}"
            yield (
                work, name, f"{level:g} {unit}", decimals(factor * theirs.wall_s, 2), decimals(factor * best.wall_s, 2),
                number(theirs.wall_s / best.wall_s, 3), theirs.named, f"{best.method}: {best.named}", off,
            )  # fmt: skip
