"""Sections of the accuracy report on one work: the diagram, what is cheapest at which error, what failed."""

from __future__ import annotations

import math

import numpy as np

from ..figures.work_precision import Curve, cheapest, work_precision
from ..parts.content import Column, Figure, Heading, Item, Table, Text
from ..parts.wording import EMPTY, count, decimals, number
from .study import Setting, Study

LEVELS = {"mm": (5.0, 2.0, 1.0, 0.1, 0.01), "%": (1.0, 0.3, 0.1, 0.03)}
WORST = 1e4  # mm or %: what is further off is not drawn
SHIPPED = ("esdirk43", 41, "rtol", 0.03)


def per_period(study: Study, work: str) -> tuple[float, str]:
    """Factor from wall seconds of a run to the unit of the time axis, and that unit."""
    entry = study.works[work]
    if entry["period_s"] != 1.0:
        return 1e3 * entry["period_s"] / entry["duration_s"], "ms per wave period"
    return 1e3, "ms"


def shipped(study: Study, work: str) -> Setting | None:
    """The shipped setting of the buoy on a work, or None."""
    for one in study.timed(work):
        if (one.method, one.nodes, one.control, one.value) == SHIPPED:
            return one
    return None


def within(settings: list[Setting], level: float) -> Setting | None:
    """The cheapest setting whose median error is within the level."""
    return min((one for one in settings if one.error <= level), key=lambda one: one.wall_s, default=None)


def work_items(study: Study, work: str) -> list[Item]:
    """Everything on one work."""
    entry, timed = study.works[work], study.timed(work)
    items: list[Item] = [Heading(entry["title"], 2), Text(_about(study, work))]
    if not timed:
        return [*items, Text("No timed run ended as asked.")]
    items.append(_diagram(study, work, timed))
    items.append(_levels(study, work, timed))
    left_out = _left_out(study, work)
    return items + ([Text(left_out)] if left_out else [])


def _about(study: Study, work: str) -> str:
    entry = study.works[work]
    what = {
        "radius": "Error: rms of r(t) minus r(t) of the reference, over all samples.",
        "place": "Error: rms of the distance of the bob from its place in the reference.",
        "strain": "Error: mean over line and time of |ε − ε exact|, in per cent of the static strain; exact: "
        "characteristics with a fitted shock, in one dimension.",
    }[entry["measure"]]
    rough = f" Not smooth: {entry['rough']}." if entry["rough"] else " Smooth."
    checks = study.of(work, kind="check")
    said = [
        f"{number(row['nodes'])} nodes and rtol {row['setting']:g} are {number(row['error'], 2)} {row['error_unit']} "
        "off"
        for row in checks
        if math.isfinite(row["error"])
    ]
    reference = next(iter(study.of(work, kind="reference")), None)
    if reference is not None:
        rough += f" Reference: {number(reference['nodes'])} nodes, rtol {reference['setting']:g}"
        rough += f"; of the runs that check it, {'; '.join(said)}." if said else "."
        if any(one.nodes == reference["nodes"] and not one.peer for one in study.timed(work)):
            rough += " Settings on the grid of the reference show their error in time alone."
    return what + rough


def _diagram(study: Study, work: str, timed: list[Setting]) -> Figure:
    factor, unit = per_period(study, work)
    names = list(dict.fromkeys(one.method for one in timed))
    curves = []
    for name in names:
        own = [one for one in timed if one.method == name]
        time, error = (np.array([getattr(one, column) for one in own]) for column in ("wall_s", "error"))
        drawn = error < WORST
        curves.append(Curve(name, factor * time[drawn], np.maximum(error[drawn], 1e-12), own[0].peer))
    ring = shipped(study, work)
    marked = (factor * ring.wall_s, ring.error) if ring else None
    unit_of_error = study.works[work]["unit"]
    picture = work_precision(curves, f"stepping time ({unit})", f"error ({unit_of_error})", marked)
    best = min(timed, key=lambda one: one.error)
    seen = f"{count(len(timed), 'setting')} of {count(len(names), 'method')}; the least error, {number(best.error, 2)} "
    seen += f"{unit_of_error}, has {best.method} ({best.named}) in {number(factor * best.wall_s, 3)} {unit}"
    dashed = any("," in name for name in names)
    title = study.works[work]["title"]
    special = "; dashed: with shock viscosity, or on a stretched grid" if dashed else ""
    caption = (
        f"Error against run time, {title[0].lower()}{title[1:]}. A mark is a setting (median of its rounds), a line "
        f"joins what nothing cheaper of the same method beats{special}. Other codes (thick) are held against their own "
        f"refined runs. Seen: {seen}. From `error` and `wall_s` of `table.csv`."
    )
    return Figure(picture, caption, f"Error over stepping time for every method, both on log scales: {seen}.")


def _levels(study: Study, work: str, timed: list[Setting]) -> Table:
    factor, unit = per_period(study, work)
    levels = LEVELS[study.works[work]["unit"]]
    error_unit = study.works[work]["unit"]
    columns = [Column("method", align="left")]
    columns += [Column(f"≤ {level:g} {error_unit}", unit) for level in levels]
    columns.append(Column("at the first level reached", align="left"))
    rows = []
    for name in dict.fromkeys(one.method for one in timed):
        own = [one for one in timed if one.method == name]
        found = [within(own, level) for level in levels]
        first = next((one for one in found if one is not None), None)
        cells = [decimals(factor * one.wall_s, 2) if one else EMPTY for one in found]
        rows.append((name, *cells, f"{first.named}: {number(first.error, 2)} {error_unit}" if first else EMPTY))
    caption = (
        "Stepping time of the cheapest setting tried whose median error is within the level; nothing is "
        "interpolated; a dash: none of the settings tried. From `table.csv`."
    )
    return Table(tuple(columns), tuple(rows), caption, small=True)


def _left_out(study: Study, work: str) -> str:
    """What ended early, by method."""
    said = []
    failed = [one for one in study.settings if one.work == work and one.failed]
    for name in dict.fromkeys(one.method for one in failed):
        own = [one for one in failed if one.method == name]
        statuses = ", ".join(dict.fromkeys(one.status for one in own))
        said.append(f"{name}: {count(len(own), 'setting')} ({statuses})")
    return f"Left out because a round ended early: {'; '.join(said)}; see `message` in `table.csv`." if said else ""


def cheapest_of(study: Study, work: str, peer: bool) -> list[Setting]:
    """The front over all methods of ours, or of all other codes."""
    own = [one for one in study.timed(work) if one.peer == peer]
    if not own:
        return []
    front = cheapest(np.array([one.wall_s for one in own]), np.array([one.error for one in own]))
    return [own[i] for i in front]
