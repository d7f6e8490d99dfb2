"""Measured orders in the accuracy report, and where a motion stops being predictable."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from ..figures.parting import parting
from ..parts.columns import table_of
from ..parts.content import Bullets, Figure, Heading, Item, Text
from ..parts.wording import number
from .study import Study

PARTED_M = 0.01  # a difference in r that matters
TOLERANCE = "tolerance"
EXCEPTIONS = (
    "Exceptions have a cause each. A method of order 4 falls short in waves, where its differences are below 1e-4 mm: "
    "drag is |v| v; its second derivative jumps where v changes its sign. In a current that keeps the sign "
    "(“regular-smooth”) it has its order. Shock viscosity acts where strain rates have an extreme: ripples of the "
    "grid's own waves, which the midpoint rule does not damp, switch it on and cost part of the order. Works that are "
    "not smooth show no order past the point that makes them so."
)


def order_items(study: Study) -> Iterator[Item]:
    """Measured orders, work by work."""
    judged = [row for row in study.orders if row["kind"] != TOLERANCE]
    tolerances = [row for row in study.orders if row["kind"] == TOLERANCE]
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
    smooth = [row["within"] for row in study.orders if row["kind"] != TOLERANCE and not row["rough"] and row["within"]]
    return smooth.count("1"), len(smooth)


def predictability_items(study: Study) -> Iterator[Item]:
    """How long refined runs of the violent work stay together."""
    long = [row for row in study.rows if row["kind"] == "long" and row["status"] == "ok"]
    loaded = [(row, run) for row in long if (run := study.folder.trajectory(row)[0]) is not None]
    if len(loaded) < 2:
        return
    time_s = loaded[0][1].columns["time_s"]
    pairs, said = [], []
    for (one, a), (other, b) in pairwise(loaded):
        names = [f"{number(row['nodes'])} nodes and rtol {row['setting']:g}" for row in (one, other)]
        pairs.append((" against ".join(names), np.abs(a.columns["radius_m"] - b.columns["radius_m"])))
        beyond = time_s[pairs[-1][1] > PARTED_M]
        when = f"apart at t = {beyond[0]:.0f} s" if len(beyond) else f"together to the end, {time_s[-1]:.0f} s"
        said.append(f"{pairs[-1][0]}: {when}.")
    yield Heading("Predictability of the violent work")
    yield Text(
        f"Refined runs count as apart where r differs by {number(1e3 * PARTED_M)} mm. Past the time at which the two "
        "finest grids part only statistics of the motion may be compared, not its course."
    )
    yield Bullets(tuple(said))
    caption = "Largest difference in r so far between runs that differ in one thing, violent work. From `radius_m`."
    alt = f"Differences between refined runs over time on a log scale. {' '.join(said)}"
    yield Figure(parting(time_s, pairs, PARTED_M), caption, alt)
