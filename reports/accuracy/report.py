"""The report of `campaigns.accuracy`: what is said, in which order. Everything comes from the campaign's folder.

First what the campaign left; then the report and its sections: a work's diagram and tables, other codes, measured
orders.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from tables import EMPTY, Column, count, decimals, number

from ..figures.curves import Curve, Panel, curves, dots
from ..parts import (
    Bullets,
    Figure,
    Folder,
    FolderError,
    Heading,
    Items,
    Report,
    Table,
    Text,
    heads,
    read_files,
    read_folder,
    report_page,
    section_items,
    table_of,
    timing_items,
)
from ..parts.style import BLUE, GREEN, INK, ORANGE, PURPLE, SKY, SOFT, VERMILION

SNAPPING = ("snap", "violent")  # works whose diagram is on the first page, in this order
OURS, PEER = "point", "peer"
_WORDS = {
    "rtol": "rtol {:g}", "step_s": "step {:.4g} s", "courant": "Courant {:g}", "steps per period": "{:g} a period",
}  # fmt: skip


class Setting(NamedTuple):
    """One timed setting: medians over its rounds. error: in the unit of the work; failed: rounds that ended
    early, the first of them with status and message.
    """

    work: str
    method: str
    nodes: int
    control: str
    value: float
    error: float
    against_ours: float
    wall_s: float
    failed: int
    peer: bool
    status: str
    message: str

    @property
    def named(self) -> str:
        """The setting in words: "41 nodes, rtol 0.03"."""
        elements = "segments" if self.peer and not self.method.startswith("scipy") else "nodes"
        return f"{self.nodes} {elements}, {_WORDS[self.control].format(self.value)}"


class Study(NamedTuple):
    """What the campaign left. works: {name: title, unit, period_s, duration_s, rough} in the order of the report."""

    folder: Folder
    works: dict[str, dict]
    settings: list[Setting]
    orders: list[dict]
    order_columns: dict[str, Column]

    def unit(self, work: str) -> str:
        """Unit of the errors of a work."""
        return self.works[work]["unit"]

    def timed(self, work: str, method: str = "", peer: bool | None = None) -> list[Setting]:
        """Settings of a work that ended as asked in every round, of one method, of ours or of other codes."""
        chosen = []
        for setting in self.settings:
            ended = setting.failed == 0 and math.isfinite(setting.error)
            if ended and setting.work == work and method in ("", setting.method) and peer in (None, setting.peer):
                chosen.append(setting)
        return chosen


def read_study(directory: Path) -> Study:
    """Read the folder. Raises FolderError naming every file that is missing or cannot be read."""
    folder = read_folder(directory)
    works = folder.provenance.get("works")
    if not isinstance(works, dict) or not all(isinstance(entry, dict) and "title" in entry for entry in works.values()):
        raise FolderError(folder.directory, "provenance.json cannot be read: it does not describe the works")
    wanted = {"orders.csv": "orders of convergence", "orders_columns.csv": "what the columns of orders.csv are"}
    files = read_files(directory, wanted)
    return Study(folder, works, list(_settings(folder.table)), *files.values())


def _settings(rows: Sequence[Mapping[str, object]]) -> Iterator[Setting]:
    import pandas

    table = pandas.DataFrame(rows)
    timed = table[table["kind"].isin([OURS, PEER])].replace(math.inf, math.nan)
    for named, group in timed.groupby(["work", "method", "nodes", "control", "setting"], sort=False):
        good, bad = group[group["status"] == "ok"], group[group["status"] != "ok"]
        first = (bad if len(bad) else group).iloc[0]
        middle = good[["error", "error_against_ours", "wall_s"]].median()
        yield Setting(*named, *middle, len(bad), first["kind"] == PEER, first["status"], first["message"])


_LOOKS = {  # method: colour, mark
    "esdirk43": (BLUE, "o"),
    "trbdf2": (GREEN, "s"),
    "generalized-alpha": (ORANGE, "^"),
    "midpoint": (PURPLE, "v"),
    "backward-euler": (SKY, "D"),
    "paper-box": (SOFT, "p"),
    "scipy Radau": (VERMILION, "X"),
    "scipy BDF": (VERMILION, "*"),
    "MoorDyn": (INK, "P"),
    "CableDyn": (SOFT, "<"),
}
_OTHER = (SOFT, ".")
DASHED = (", shock viscosity", ", stretched grid")
LEVELS = {"mm": (5.0, 2.0, 1.0, 0.1, 0.01), "%": (1.0, 0.3, 0.1, 0.03)}
WORST = 1e4  # mm or %: what is further off is not drawn
SHIPPED = ("esdirk43", 41, "rtol", 0.03)
ERRORS = {
    "radius": "Error: rms of r(t) minus r(t) of the reference, over all samples.",
    "place": "Error: rms of the distance of the bob from its place in the reference.",
    "strain": "Error: mean over line and time of |ε − ε exact|, in per cent of the static strain; exact: "
    "characteristics with a fitted shock, in one dimension.",
}
TOLERANCE = "tolerance"
EXCEPTIONS = (
    "Exceptions have a cause each. A method of order 4 falls short in waves, where its differences are below 1e-4 mm: "
    "drag is |v| v; its second derivative jumps where v changes its sign. In a current that keeps the sign "
    "(“regular-smooth”) it has its order. Shock viscosity acts where strain rates have an extreme: ripples of the "
    "grid's own waves, which the midpoint rule does not damp, switch it on and cost part of the order. Works that are "
    "not smooth show no order past the point that makes them so."
)


def report(directory: Path) -> Report:
    """The content of the report on an accuracy folder. Raises FolderError for a folder that is not one."""
    study = read_study(directory)
    items, drawn = [], ""
    for name in (*SNAPPING, *study.works):  # on the first page: the first work with a run that ended as asked
        if study.timed(name):
            drawn = name
            items.append(diagram(study, name))
            break
    items += [section_items("accuracy"), Heading("Error against run time"), Text(_protocol(study))]
    works = {setting.work for setting in study.settings}
    for name in study.works:
        if name in works:
            items.append(work_items(study, name, drawn))
    items += [peer_items(study), order_items(study)]
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
    unit, (factor, _) = study.unit(work), per_period(study, work)
    our_settings = study.timed(work, peer=False)
    for name in dict.fromkeys(setting.method for setting in study.timed(work, peer=True)):
        reached = []
        for level in LEVELS[unit]:
            best, theirs = within(our_settings, level), within(study.timed(work, name), level)
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


def per_period(study: Study, work: str) -> tuple[float, str]:
    """Factor from wall seconds of a run to the unit of the time axis, and that unit."""
    entry = study.works[work]
    if entry["period_s"] != 1.0:
        return 1e3 * entry["period_s"] / entry["duration_s"], "ms per wave period"
    return 1e3, "ms"


def within(settings: list[Setting], level: float) -> Setting | None:
    """The cheapest setting whose median error is within the level."""
    accurate = [setting for setting in settings if setting.error <= level]
    return min(accurate, key=lambda setting: setting.wall_s, default=None)


def work_items(study: Study, work: str, drawn: str = "") -> Items:
    """Everything on one work; drawn: that whose diagram is on the first page."""
    entry = study.works[work]
    smooth = f"Not smooth: {entry['rough']}." if entry["rough"] else "Smooth."
    yield Heading(entry["title"], 2)
    yield Text(f"{ERRORS[entry['measure']]} {smooth}")
    references = []
    for row in study.folder.table:
        if row["work"] == work and row["kind"] in ("reference", "check"):
            references.append(row)
    if references:
        caption = (
            "The reference, and runs that check how far it is converged. Timed settings on the grid of the reference "
            "show their error in time alone. From `table.csv`."
        )
        names = ("kind", "nodes", "control", "setting", "error", "error_unit")
        yield table_of(study.folder.columns, names, references, caption)
    if not study.timed(work):
        yield Text("No timed run ended as asked.")
        return
    if work != drawn:
        yield diagram(study, work)
    failed = {}
    for setting in study.settings:
        if setting.work == work and setting.failed:
            failed[setting.method, setting.named, setting.status] = None  # a dictionary: each once, in order
    if failed:
        caption = "Left out, because a round ended early; see `message` in `table.csv`."
        yield Table(heads("method", "setting", "outcome"), list(failed), caption)


def cheapest(time: np.ndarray, error: np.ndarray) -> np.ndarray:
    """Indices of the settings that no setting as cheap or cheaper beats, by time."""
    best, chosen = np.inf, []
    for i in np.lexsort((error, time)):
        if error[i] < best:
            chosen.append(i)
            best = error[i]
    return np.array(chosen, dtype=int)


def diagram(study: Study, work: str) -> Figure:
    """Error against run time, log-log: a mark for every setting, a line a method through what nothing cheaper beats."""
    (factor, unit), error_unit, timed = per_period(study, work), study.unit(work), study.timed(work)
    settings_of_methods = {}
    lines = []
    for setting in timed:
        settings_of_methods.setdefault(setting.method, []).append(setting)
    for name, settings in settings_of_methods.items():
        time, error = [], []
        for setting in settings:
            if setting.error < WORST:
                time.append(factor * setting.wall_s)
                error.append(max(setting.error, 1e-12))
        time, error = np.array(time), np.array(error)
        colour, mark = _LOOKS.get(name.partition(",")[0], _OTHER)
        lines.append(dots(time, error, mark, colour, 2.6, alpha=0.45))
        front = cheapest(time, error)
        dash = "--" if name.endswith(DASHED) else "-"
        width = 1.6 if settings[0].peer else 1.0
        lines.append(Curve(time[front], error[front], name, dash, mark, colour, width=width))
    for setting in timed:
        if (setting.method, setting.nodes, setting.control, setting.value) == SHIPPED:
            time, error = np.array([factor * setting.wall_s]), np.array([setting.error])
            lines.append(dots(time, error, "o", INK, 9.0, name="shipped setting", filled=False))
            break
    panel = Panel(lines, f"stepping time ({unit})", f"error ({error_unit})", log="xy")
    best = min(timed, key=lambda setting: setting.error)
    seen = (
        f"{count(len(timed), 'setting')} of {count(len(settings_of_methods), 'method')}; the least error, "
        f"{number(best.error, 2)} {error_unit}, has {best.method} ({best.named}) in "
        f"{number(factor * best.wall_s, 3)} {unit}"
    )
    caption = (
        f"Error against run time, {study.works[work]['title']}. A mark is a setting (median of its rounds). A line "
        "joins the settings of a method that no cheaper one beats; dashed: with shock viscosity, or on a stretched "
        "grid. Other codes (thick) are held against their own refined runs. "
        f"Seen: {seen}. From `error` and `wall_s` of `table.csv`."
    )
    alt = f"Error over stepping time for every method, both on log scales: {seen}."
    return Figure(curves([[panel]], 3.7, "right"), caption, alt)


def order_items(study: Study) -> Items:
    """Measured orders, work by work."""
    judged, tolerances = [], []
    for row in study.orders:
        of_kind = tolerances if row["kind"] == TOLERANCE else judged
        of_kind.append(row)
    yield Heading("Orders of convergence")
    if not judged:
        yield Text("No series of steps or grids was run.")
        return
    good, smooth = smooth_series(study)
    yield Text(f"On smooth works {good} of {smooth} series end within 0.15 of theory. {EXCEPTIONS}")
    names = ("work", "kind", "method", "theory", "order", "slopes", "errors", "unit", "within", "rough", "note")
    caption = (
        "Series of halved steps (time) or elements (space), of both at once on breaking lines, and up to the first "
        "slack (early). Errors of breaking lines are against the exact solution. From `orders.csv`."
    )
    yield table_of(study.order_columns, names, judged, caption)
    if tolerances:
        yield Heading("Tolerances", 2)
        names = ("work", "method", "theory", "order", "errors", "unit", "settings")
        caption = (
            "Error over tolerance on 161 nodes, against rtol 1e-6 on the same grid; the order is a slope by least "
            "squares. Theory: an estimate of order p + 1 kept at rtol, with no longest step but 2 s. Loose tolerances "
            "take a few steps a wave, and are off by the size of the motion."
        )
        yield table_of(study.order_columns, names, tolerances, caption)


def smooth_series(study: Study) -> tuple[int, int]:
    """Series on smooth works: how many are as theory says, and how many there are."""
    verdicts = []
    for row in study.orders:
        if row["kind"] != TOLERANCE and not row["rough"] and row["within"]:
            verdicts.append(row["within"])
    return verdicts.count("1"), len(verdicts)
