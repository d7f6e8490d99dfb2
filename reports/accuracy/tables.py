"""Tables of the accuracy report: measured orders, cost of each piece, other codes, where a motion stops being
predictable.
"""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from ..figures.parting import parting
from ..parts.content import Bullets, Column, Figure, Heading, Item, Table, Text
from ..parts.wording import EMPTY, count, decimals, listed, number
from .sections import LEVELS, per_period, within
from .study import Study

PARTED_M = 0.01  # a difference in r that matters
_KINDS = {
    "time": "steps halved",
    "time-early": "steps halved, up to the first slack",
    "space": "elements halved",
    "space-early": "elements halved, up to the first slack",
    "both": "elements and steps halved",
    "tolerance": "tolerance",
}


def order_items(study: Study) -> list[Item]:
    """Measured orders, work by work."""
    items: list[Item] = [Heading("Orders of convergence")]
    judged = [row for row in study.orders if row["kind"] != "tolerance"]
    if not judged:
        return [*items, Text("No series of steps or grids was run.")]
    columns = (
        Column("work", align="left"),
        Column("what is refined", align="left"),
        Column("method", align="left"),
        Column("theory"),
        Column("measured"),
        Column("slopes, coarse to fine", align="left"),
        Column("last difference"),
        Column("verdict", align="left"),
    )
    rows = tuple(
        (
            row["work"],
            _KINDS.get(row["kind"], row["kind"]),
            row["method"],
            number(float(row["theory"])),
            decimals(float(row["order"]), 2) if row["order"] else EMPTY,
            " ".join(EMPTY if slope == "nan" else f"{float(slope):.2f}" for slope in row["slopes"].split()),
            f"{float(row['errors'].split()[-1]):.2g} {row['unit']}" if row["errors"] else EMPTY,
            _verdict(row),
        )
        for row in judged
    )
    caption = (
        "Slopes are log2 of the ratio of successive differences in a series of halved steps or elements (breaking "
        "line: of errors against the exact solution); measured: the last of them. From `orders.csv`."
    )
    smooth = [row for row in judged if not row["rough"] and row["within"]]
    good = [row for row in smooth if row["within"] == "1"]
    said = f"On smooth works {len(good)} of {len(smooth)} series end within 0.15 of theory. "
    return [*items, Text(said + _why(smooth, judged)), Table(columns, rows, caption, small=True), *_tolerances(study)]


def _verdict(row: dict) -> str:
    if not row["within"]:
        return row["note"] or "no slope"
    if row["within"] == "1":
        return "as theory says"
    return "not smooth" if row["rough"] else "off"


def _why(smooth: list[dict], judged: list[dict]) -> str:
    off = [row for row in smooth if row["within"] != "1"]
    words = []
    if any(row["method"] == "esdirk43" and row["kind"].startswith("time") for row in off):
        words.append(
            "The method of order 4 falls short in waves, where its differences are below 1e-4 mm: drag is |v| v, whose "
            "second derivative jumps where v changes its sign; in a current that keeps the sign (“regular-smooth”) it "
            "shows its order. "
        )
    if any("shock viscosity" in row["method"] for row in off):
        words.append(
            "Shock viscosity acts where strain rates have an extreme: ripples of the grid's own waves, which the "
            "midpoint rule does not damp, switch it on and cost part of the order. "
        )
    if any(row["rough"] for row in judged):
        words.append("Works that are not smooth show no order past the point that makes them so; the table says what.")
    return "".join(words)


def _tolerances(study: Study) -> list[Item]:
    rows = [row for row in study.orders if row["kind"] == "tolerance"]
    if not rows:
        return []
    columns = (
        Column("work", align="left"), Column("method", align="left"), Column("theory"), Column("slope"),
        Column("errors", align="left"), Column("rtol", align="left"),
    )  # fmt: skip
    cells = tuple(
        (
            row["work"], row["method"], decimals(float(row["theory"]), 2), decimals(float(row["order"]), 2),
            " ".join(number(float(error), 2) for error in row["errors"].split()) + f" {row['unit']}", row["settings"],
        )
        for row in rows
    )  # fmt: skip
    caption = (
        "Error over tolerance on 161 nodes, against rtol 1e-6 on the same grid; slope by least squares. Theory: an "
        "estimate of order p + 1 kept at rtol, with no longest step but 2 s. Loose tolerances take a few steps a wave, "
        "and are off by the size of the motion."
    )
    return [Heading("Tolerances", 2), Table(columns, cells, caption, small=True)]


def cost_items(study: Study) -> list[Item]:
    """Where the time of the shipped setting goes."""
    costs = study.costs
    if costs is None:
        return []
    pieces = costs["per_iteration_us"]
    total = sum(pieces.values())
    columns = (Column("piece", align="left"), Column("per Newton iteration", "µs"), Column("share", "%"))
    rows = [(name, decimals(value, 2), decimals(100 * value / total, 0)) for name, value in pieces.items()]
    rows.append(("stepping, all", decimals(total, 2), "100"))
    caption = (
        f"The shipped setting ({costs['nodes']} nodes, rtol {costs['rtol']:g}, {costs['integrator']}) on the snapping "
        f"buoy over {costs['periods']} wave periods: {number(costs['newton_iterations'] / costs['periods'], 3)} "
        f"Newton iterations and {number(costs['steps'] / costs['periods'], 3)} steps a period. Assembly, waves and "
        "elimination are timed by themselves, the rest by difference. From `costs.json`."
    )
    python = costs["python_ms"]
    said = (
        f"A call of `simulate` over {costs['periods']} periods takes {decimals(costs['stepping_ms'], 1)} ms of "
        "stepping and "
        f"{decimals(python, 1)} ms of Python: the scene as numbers, statics, the record "
        f"({decimals(100 * python / (python + costs['stepping_ms']), 0)} %). "
    )
    return [Heading("Cost of each piece"), Table(columns, tuple(rows), caption), Text(said)]


def predictability_items(study: Study) -> list[Item]:
    """How long refined runs of the violent work stay together."""
    from engine import Trajectory

    runs = []
    for row in study.rows:
        if row["kind"] == "long" and row["status"] == "ok":
            try:
                runs.append((row, Trajectory.load(study.folder.trajectory_path(row["run_key"])).columns))
            except ValueError:
                continue
    if len(runs) < 2:
        return []
    time_s = runs[0][1]["time_s"]
    pairs, parted = [], {"tolerance": [], "grid": []}
    for (one, a), (other, b) in pairwise(runs):
        distance = np.abs(a["radius_m"] - b["radius_m"])
        if one["nodes"] == other["nodes"]:
            kind, name = "tolerance", f"{number(one['nodes'])} nodes, rtol {one['setting']:g} and {other['setting']:g}"
        else:
            kind, name = "grid", f"rtol {one['setting']:g}, {number(one['nodes'])} and {number(other['nodes'])} nodes"
        pairs.append((name, distance))
        parted[kind].append(_parting_time(time_s, distance))
    said = [f"{name}: {_parted(_parting_time(time_s, distance), time_s[-1])}." for name, distance in pairs]
    verdict = _limit(parted, float(time_s[-1]))
    what = "Largest difference in r so far between runs that differ in one thing, violent work."
    caption = f"{what} {verdict} From `radius_m`."
    alt = "Differences between refined runs over time on a log scale. " + " ".join(said)
    return [
        Heading("Predictability of the violent work"),
        Bullets((*said, verdict)),
        Figure(parting(time_s, pairs, PARTED_M), caption, alt),
    ]


def _parted(at: float, end_s: float) -> str:
    apart = number(1e3 * PARTED_M)
    return f"{apart} mm apart at t = {at:.0f} s" if at < math.inf else f"within {apart} mm to the end, {end_s:.0f} s"


def _limit(parted: dict[str, list[float]], end_s: float) -> str:
    """The verdict: what refinement in tolerance and in the grid gain."""
    parts = []
    if parted["tolerance"]:
        parts.append(f"Refined tolerances on one grid: {_parted(min(parted['tolerance']), end_s)} or later.")
    if parted["grid"]:
        finest = parted["grid"][-1]
        parts.append(f"The two finest grids: {_parted(finest, end_s)}.")
        if finest < math.inf:
            parts.append("Past that time only statistics of the motion may be compared, not its course.")
    return " ".join(parts)


def _parting_time(time_s: np.ndarray, distance: np.ndarray) -> float:
    beyond = np.flatnonzero(distance > PARTED_M)
    return float(time_s[beyond[0]]) if len(beyond) else math.inf


def peer_items(study: Study) -> list[Item]:
    """Other codes: what is left different, what they cost beside ours, what is not installed."""
    peers = study.folder.provenance.get("peer_notes")
    own = [one for one in study.settings if one.peer]
    if not own:
        return []
    items: list[Item] = [Heading("Other codes")]
    if isinstance(peers, dict):
        items.append(Bullets(tuple(f"{name}: {text}" for name, text in peers.items())))
    rows = [row for work in study.works for row in _beside_ours(study, work)]
    columns = (
        Column("work", align="left"), Column("code", align="left"), Column("within"), Column("its time", "ms"),
        Column("ours", "ms"), Column("ratio"), Column("its setting", align="left"), Column("our setting", align="left"),
        Column("off ours"),
    )  # fmt: skip
    if rows:
        caption = (
            "Cheapest settings within an error, each code against its own refined run (scipy against ours: it solves "
            "our equations); ratio: its time over ours, of buoys per wave period. Off ours: its distance from our "
            "refined run, in which the differences of the models show. The two finest levels that it reaches. From "
            "`table.csv`."
        )
        items.append(Table(columns, tuple(rows), caption, small=True))
    missing = list(dict.fromkeys((one.method, one.status, one.message) for one in own if one.failed))
    if missing:
        heads = (Column("code", align="left"), Column("outcome", align="left"), Column("why", align="left"))
        caption = "Settings of other codes without a result. From `table.csv`."
        items.append(Table(heads, tuple(missing), caption, small=True))
    return items


def _beside_ours(study: Study, work: str) -> list[tuple[str, ...]]:
    """Rows of other codes on a work, at the two finest levels that each reaches."""
    timed, unit = study.timed(work), study.works[work]["unit"]
    factor, _ = per_period(study, work)
    rows = []
    for name in dict.fromkeys(one.method for one in timed if one.peer):
        pairs = [
            (level, ours, other)
            for level in LEVELS[unit]
            if (ours := within([one for one in timed if not one.peer], level))
            and (other := within([one for one in timed if one.method == name], level))
        ]
        for level, ours, other in pairs[-2:]:
            rows.append((
                work, name, f"{level:g} {unit}", decimals(factor * other.wall_s, 2), decimals(factor * ours.wall_s, 2),
                number(other.wall_s / ours.wall_s, 3), other.named, f"{ours.method}: {ours.named}",
                f"{number(other.against_ours, 2)} {unit}" if math.isfinite(other.against_ours) else EMPTY,
            ))  # fmt: skip
    return rows


def level_answer(study: Study, work: str) -> str:
    """One sentence: what is cheapest at each error level on a work, over all our methods."""
    factor, unit = per_period(study, work)
    timed = [one for one in study.timed(work) if not one.peer]
    parts = []
    for level in LEVELS[study.works[work]["unit"]][:3]:
        one = within(timed, level)
        if one is not None:
            parts.append(
                f"{level:g} {study.works[work]['unit']} in {number(factor * one.wall_s, 3)} {unit} ({one.method}, "
                f"{one.named})"
            )
    return f"{study.works[work]['title']}: {listed(parts)}." if parts else ""


def failed_count(study: Study) -> str:
    """How many settings ended early, in words."""
    bad = [one for one in study.settings if one.failed and not one.peer]
    return (
        f"{count(len(bad), 'setting')} of ours ended early in a round and {'is' if len(bad) == 1 else 'are'} left out."
        if bad
        else ""
    )
