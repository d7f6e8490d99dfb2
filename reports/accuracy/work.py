"""One work in the accuracy report: the diagram, what is cheapest at which error, what failed."""

from __future__ import annotations

import math

import numpy as np

from ..figures.work_precision import Curve, work_precision
from ..parts.content import Column, Figure, Heading, Item, Table, Text
from ..parts.wording import EMPTY, count, decimals, number
from .study import Setting, Study

LEVELS = {"mm": (5.0, 2.0, 1.0, 0.1, 0.01), "%": (1.0, 0.3, 0.1, 0.03)}
WORST = 1e4  # mm or %: what is further off is not drawn
SHIPPED = ("esdirk43", 41, "rtol", 0.03)
ERRORS = {
    "radius": "Error: rms of r(t) minus r(t) of the reference, over all samples.",
    "place": "Error: rms of the distance of the bob from its place in the reference.",
    "strain": "Error: mean over line and time of |ε − ε exact|, in per cent of the static strain; exact: "
    "characteristics with a fitted shock, in one dimension.",
}


def per_period(study: Study, work: str) -> tuple[float, str]:
    """Factor from wall seconds of a run to the unit of the time axis, and that unit."""
    entry = study.works[work]
    if entry["period_s"] != 1.0:
        return 1e3 * entry["period_s"] / entry["duration_s"], "ms per wave period"
    return 1e3, "ms"


def shipped(study: Study, work: str) -> Setting | None:
    """The shipped setting of the buoy on a work, or None."""
    named = (one for one in study.timed(work) if (one.method, one.nodes, one.control, one.value) == SHIPPED)
    return next(named, None)


def within(settings: list[Setting], level: float) -> Setting | None:
    """The cheapest setting whose median error is within the level."""
    return min((one for one in settings if one.error <= level), key=lambda one: one.wall_s, default=None)


def level_answer(study: Study, work: str) -> str:
    """One sentence: what is cheapest at each error level on a work, over all our methods; "" for none."""
    (factor, time_unit), unit = per_period(study, work), study.unit(work)
    ours = [one for one in study.timed(work) if not one.peer]
    found = [(level, one) for level in LEVELS[unit][:3] if (one := within(ours, level))]
    parts = [
        f"{level:g} {unit} in {number(factor * one.wall_s, 3)} {time_unit} ({one.method}, {one.named})"
        for level, one in found
    ]
    return f"{study.works[work]['title']}: {'; '.join(parts)}." if parts else ""


def work_items(study: Study, work: str) -> list[Item]:
    """Everything on one work."""
    entry, timed = study.works[work], study.timed(work)
    smooth = f"Not smooth: {entry['rough']}." if entry["rough"] else "Smooth."
    items: list[Item] = [
        Heading(entry["title"], 2),
        Text(f"{ERRORS[entry['measure']]} {smooth}{_references(study, work)}"),
    ]
    if not timed:
        return [*items, Text("No timed run ended as asked.")]
    return [*items, _diagram(study, work, timed), _levels(study, work, timed), *_left_out(study, work)]


def _references(study: Study, work: str) -> str:
    reference = next(iter(study.of(work, kind="reference")), None)
    if reference is None:
        return ""
    said = f" Reference: {number(reference['nodes'])} nodes, rtol {reference['setting']:g}."
    for row in study.of(work, kind="check"):
        if math.isfinite(row["error"]):
            off = f"{number(row['error'], 2)} {row['error_unit']} off"
            said += f" {number(row['nodes'])} nodes and rtol {row['setting']:g} are {off}."
    if any(one.nodes == reference["nodes"] and not one.peer for one in study.timed(work)):
        said += " Settings on the grid of the reference show their error in time alone."
    return said


def _diagram(study: Study, work: str, timed: list[Setting]) -> Figure:
    (factor, unit), error_unit = per_period(study, work), study.unit(work)
    names = list(dict.fromkeys(one.method for one in timed))
    curves = []
    for name in names:
        own = [one for one in timed if one.method == name]
        time, error = (np.array([getattr(one, column) for one in own]) for column in ("wall_s", "error"))
        drawn = error < WORST
        curves.append(Curve(name, factor * time[drawn], np.maximum(error[drawn], 1e-12), own[0].peer))
    ring = shipped(study, work)
    marked = (factor * ring.wall_s, ring.error) if ring else None
    picture = work_precision(curves, f"stepping time ({unit})", f"error ({error_unit})", marked)
    best = min(timed, key=lambda one: one.error)
    seen = (
        f"{count(len(timed), 'setting')} of {count(len(names), 'method')}; the least error, {number(best.error, 2)} "
        f"{error_unit}, has {best.method} ({best.named}) in {number(factor * best.wall_s, 3)} {unit}"
    )
    dashed = "; dashed: with shock viscosity, or on a stretched grid" if any("," in name for name in names) else ""
    caption = (
        f"Error against run time, {study.works[work]['title']}. A mark is a setting (median of its rounds). A line "
        f"joins the settings of a method that no cheaper one beats{dashed}. Other codes (thick) are held against "
        f"their own refined runs. Seen: {seen}. From `error` and `wall_s` of `table.csv`."
    )
    return Figure(picture, caption, f"Error over stepping time for every method, both on log scales: {seen}.")


def _levels(study: Study, work: str, timed: list[Setting]) -> Table:
    (factor, unit), error_unit = per_period(study, work), study.unit(work)
    levels = LEVELS[error_unit]
    rows = []
    for name in dict.fromkeys(one.method for one in timed):
        found = [within([one for one in timed if one.method == name], level) for level in levels]
        first = next((one for one in found if one is not None), None)
        cells = [decimals(factor * one.wall_s, 2) if one else EMPTY for one in found]
        rows.append((name, *cells, f"{first.named}: {number(first.error, 2)} {error_unit}" if first else EMPTY))
    columns = [Column("method", align="left"), *(Column(f"≤ {level:g} {error_unit}", unit) for level in levels)]
    columns.append(Column("at the first level reached", align="left"))
    caption = (
        "Stepping time of the cheapest setting tried whose median error is within the level; nothing is "
        "interpolated; a dash: none of the settings tried. From `table.csv`."
    )
    return Table(tuple(columns), tuple(rows), caption, small=True)


def _left_out(study: Study, work: str) -> list[Item]:
    """What ended early, by method."""
    failed: dict[str, list[str]] = {}
    for one in study.settings:
        if one.work == work and one.failed:
            failed.setdefault(one.method, []).append(one.status)
    said = [
        f"{name}: {count(len(statuses), 'setting')} ({', '.join(dict.fromkeys(statuses))})"
        for name, statuses in failed.items()
    ]
    text = f"Left out because a round ended early: {'; '.join(said)}; see `message` in `table.csv`."
    return [Text(text)] if said else []
