"""What the report on eq. (33) says of coexisting attractors, periodic orbits and grazing."""

from __future__ import annotations

import math

import numpy as np

from ..figures.oscillator_basins import oscillator_basins
from ..parts.content import Figure, Heading, Item, Text
from ..parts.wording import number, percent
from .folder import Study
from .tables import orbit_table

BOX = (-60.0, 20.0, -25.0, 25.0)  # of the starts, analysis.oscillator.basin_grids.PAPER_BOX


def basin_items(study: Study) -> list[Item]:
    """Which starts end where, with the shares of the starts."""
    heading = Heading("Coexisting attractors")
    arrays = study.arrays.get("basins")
    if arrays is None:
        return [heading, Text(f"There are no basins: {study.faults['basins']}.")]
    shares, errors = arrays["shares"], arrays["errors"]
    orbits = [arrays[f"orbit_{index + 1}"] for index in range(len(shares) - 1)]
    names = [f"period {len(orbit)}" for orbit in orbits] + ["aperiodic"]
    section = study.arrays.get("section", {}).get("section", np.empty((0, 2)))[:20000]
    told = ", ".join(
        f"{name} {percent(float(share))} (± {number(100 * float(error), 2)})"
        for name, share, error in zip(names, shares, errors, strict=True)
        if share > 0
    )
    settled = arrays["settled"][arrays["settled"] >= 0]
    late = f"; the last of the settled ones did so after {int(settled.max())}" if len(settled) else ""
    caption = (
        f"Where a grid of {arrays['label'].size} starts ends within {study.rows['basins']['periods']} "
        f"periods{late}; dots: "
        f"strobed points of the periodic attractors; black: the section. Shares of the starts: {told}. From the part "
        "`basins`."
    )
    return [
        heading,
        Text(
            "A start counts as settled when Newton's method, begun from its strobed state, finds a stable periodic "
            "orbit "
            "that the start's own motion then approaches. The rest is aperiodic: on the chaotic attractor, or on "
            "its way."
        ),
        Figure(
            oscillator_basins(arrays["label"], BOX, names, orbits, section),
            caption,
            f"Basins of attraction over displacement and velocity; shares of the starts: {told}.",
        ),
    ]


def orbit_items(study: Study) -> list[Item]:
    """The periodic orbits with their multipliers."""
    heading = Heading("Periodic orbits")
    table = orbit_table(study)
    if table is None:
        return [heading, Text("Newton's method met no periodic orbit from any of its starts.")]
    text = (
        "Newton's method on the strobed map with the exact tangent map, from points of the section, a grid and the "
        "attractors found. A chaotic attractor is threaded by unstable orbits; those below are the ones that were "
        "met, and "
        "no list from a search is complete. The product of the two multipliers must be e to the −μpT."
    )
    return [heading, Text(text), table]


def grazing_items(study: Study) -> list[Item]:
    """The threshold of slack, and what random starts do at it."""
    heading = Heading("Grazing")
    arrays = study.arrays.get("grazing")
    force = study.number("grazing", "grazing_force")
    if arrays is None or not math.isfinite(force):
        reason = study.faults.get(
            "grazing", "without lift the tether is slack at any forcing, and without damping no taut motion attracts"
        )
        return [heading, Text(f"There is no threshold: {reason}.")]
    _, time, clearance, velocity = arrays["grazing"]
    below, above = arrays["slack_below"], arrays["slack_above"]
    text = (
        "Solved for: the forcing at which the periodic motion that is always taut touches γ = 0. F = "
        f"{force:.15g}, where "
        f"the least displacement is {clearance:.1e} and the velocity there {velocity:.1e}, at the time "
        f"{number(time, 6)} "
        f"after the strobe. Below this F that motion has no slack. It need not be the only one: of {len(below)} random "
        f"starts, {int((below > 0).sum())} are slack at some time in the last 100 of 2100 periods at 0.999 F, and "
        f"{int((above > 0).sum())} at 1.001 F. Starts that are slack below the threshold are on another attractor."
    )
    return [heading, Text(text)]
