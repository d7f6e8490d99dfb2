"""Measured orders in the accuracy report, and where a motion stops being predictable."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from ..figures.parting import parting
from ..parts.columns import value
from ..parts.content import Bullets, Column, Figure, Heading, Item, Table, Text
from ..parts.wording import EMPTY, decimals, number
from .study import Study

PARTED_M = 0.01  # a difference in r that matters
KINDS = {
    "time": "steps halved",
    "time-early": "steps halved, up to the first slack",
    "space": "elements halved",
    "space-early": "elements halved, up to the first slack",
    "both": "elements and steps halved",
}
REASONS = {  # of series that are off, on smooth works
    "order 4": "The method of order 4 falls short in waves, where its differences are below 1e-4 mm: drag is |v| v; "
    "its second derivative jumps where v changes its sign. In a current that keeps the sign (“regular-smooth”) it has "
    "its order.",
    "viscosity": "Shock viscosity acts where strain rates have an extreme: ripples of the grid's own waves, which the "
    "midpoint rule does not damp, switch it on and cost part of the order.",
}


def order_items(study: Study) -> list[Item]:
    """Measured orders, work by work."""
    judged = [row for row in study.orders if row["kind"] in KINDS]
    if not judged:
        return [Heading("Orders of convergence"), Text("No series of steps or grids was run.")]
    columns = (
        Column("work", align="left"), Column("what is refined", align="left"), Column("method", align="left"),
        Column("theory"), Column("measured"), Column("slopes, coarse to fine", align="left"), Column("last difference"),
        Column("verdict", align="left"),
    )  # fmt: skip
    rows = tuple(
        (
            row["work"], KINDS[row["kind"]], row["method"], number(value(row, "theory")),
            decimals(value(row, "order"), 2) if row["order"] else EMPTY,
            " ".join(EMPTY if slope == "nan" else f"{float(slope):.2f}" for slope in row["slopes"].split()),
            f"{float(row['errors'].split()[-1]):.2g} {row['unit']}" if row["errors"] else EMPTY, _verdict(row),
        )
        for row in judged
    )  # fmt: skip
    caption = (
        "Slopes are log2 of the ratio of successive differences in a series of halved steps or elements (breaking "
        "line: of errors against the exact solution); measured: the last of them. From `orders.csv`."
    )
    good, smooth, off = smooth_series(study)
    reasons = [f"On smooth works {good} of {smooth} series end within 0.15 of theory."]
    if any(row["method"] == "esdirk43" and row["kind"].startswith("time") for row in off):
        reasons.append(REASONS["order 4"])
    if any("shock viscosity" in row["method"] for row in off):
        reasons.append(REASONS["viscosity"])
    if any(row["rough"] for row in judged):
        reasons.append("Works that are not smooth show no order past the point that makes them so.")
    table = Table(columns, rows, caption, small=True)
    return [Heading("Orders of convergence"), Text(" ".join(reasons)), table, *_tolerances(study)]


def smooth_series(study: Study) -> tuple[int, int, list[dict]]:
    """Series on smooth works: how many are as theory says, how many there are, and those that are off."""
    smooth = [row for row in study.orders if row["kind"] in KINDS and not row["rough"] and row["within"]]
    off = [row for row in smooth if row["within"] != "1"]
    return len(smooth) - len(off), len(smooth), off


def _verdict(row: dict) -> str:
    if not row["within"]:
        return row["note"] or "no slope"
    if row["within"] == "1":
        return "as theory says"
    return "not smooth" if row["rough"] else "off"


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
            row["work"], row["method"], decimals(value(row, "theory"), 2), decimals(value(row, "order"), 2),
            " ".join(number(float(error), 2) for error in row["errors"].split()) + f" {row['unit']}", row["settings"],
        )
        for row in rows
    )  # fmt: skip
    caption = (
        "Error over tolerance on 161 nodes, against rtol 1e-6 on the same grid; slope by least squares. Theory: an "
        "estimate of order p + 1 kept at rtol, with no longest step but 2 s. Loose tolerances take a few steps a "
        "wave, and are off by the size of the motion."
    )
    return [Heading("Tolerances", 2), Table(columns, cells, caption, small=True)]


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
    said += _limits(parted, float(time_s[-1]))
    caption = "Largest difference in r so far between runs that differ in one thing, violent work. From `radius_m`."
    alt = "Differences between refined runs over time on a log scale. " + " ".join(said)
    picture = Figure(parting(time_s, pairs, PARTED_M), caption, alt)
    return [Heading("Predictability of the violent work"), Bullets(tuple(said)), picture]


def _parted(at: float, end_s: float) -> str:
    apart = number(1e3 * PARTED_M)
    return f"{apart} mm apart at t = {at:.0f} s" if at < math.inf else f"within {apart} mm to the end, {end_s:.0f} s"


def _limits(parted: dict[str, list[float]], end_s: float) -> list[str]:
    """The verdict: what refinement in tolerance and in the grid gain."""
    said = []
    if parted["tolerance"]:
        said.append(f"Refined tolerances on one grid: {_parted(min(parted['tolerance']), end_s)} or later.")
    if parted["grid"]:
        said.append(f"The two finest grids: {_parted(parted['grid'][-1], end_s)}.")
        if parted["grid"][-1] < math.inf:
            said.append("Past that time only statistics of the motion may be compared, not its course.")
    return said


def _parting_time(time_s: np.ndarray, distance: np.ndarray) -> float:
    beyond = np.flatnonzero(distance > PARTED_M)
    return float(time_s[beyond[0]]) if len(beyond) else math.inf
