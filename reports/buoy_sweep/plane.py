"""Out of the plane: which runs of a sweep were made in three dimensions, which released loops, what differs."""

from __future__ import annotations

import math

import numpy as np

from ..figures.transverse_exponents import transverse_exponents
from ..parts.content import Column, Figure, Heading, Item, Table, Text
from ..parts.folder import Folder
from ..parts.wording import EMPTY, count, decimals, number, percent, ranges
from .runs import Run, lateral, linked, planar_releases, value

# What `campaigns.out_of_plane` finds, and tests/reports/test_plane_or_space.py holds it to.
COMPARED = (
    "`campaigns.out_of_plane` compares such runs with runs in three dimensions at kA = 0.13 and depths of 21.0, 21.6 "
    "and 22.0 m, over 200 wave periods: range of r, section, exponent and regime of the buoy are the same within what "
    "one record leaves open, so for these the planar run is good enough. The path of the buoy in time after the first "
    "loops, and the shape of the rope in a loop, are not."
)
_EXPONENT, _ERROR = "offplane_growth_bits_per_period", "offplane_growth_error"
_MODES = {
    "2": "Every run was made in the plane of the waves.",
    "3": "Every run was made in three dimensions (`--dimensions 3`).",
    "auto": "Every value was run in the plane of the waves first; where that run released loops, the row is of a run "
    "in three dimensions (`--dimensions auto`).",
}


def plane_items(folder: Folder, runs: tuple[Run, ...], transient: int) -> list[Item]:
    """The section, or nothing where no run tells of motion across the plane."""
    shown = [run for run in runs if run.in_space or planar_releases(run) > 0]
    across = [run for run in runs if all(map(math.isfinite, _exponent(run)))]
    if not shown and not across:
        return []
    words = [_MODES.get(str(folder.provenance.get("dimensions")), ""), _push_words(folder, runs)]
    items: list[Item] = [Heading("Out of the plane")]
    if any(words):
        items.append(Text(" ".join(word for word in words if word)))
    if across:
        items += _across(across, runs)
    if any(not run.in_space for run in shown):
        items.append(Text(f"Planar runs with loop releases are marked 2 under D. {COMPARED}"))
    pairs = [run for run in shown if run.in_space and math.isfinite(planar_radius(run)[0])]
    if pairs:
        items.append(Text(_pair_words(pairs)))
    return [*items, _table(shown, transient)] if shown else items


def _across(across: list[Run], runs) -> list[Item]:
    """Figure and words on the exponents across the plane; `across`: the runs that have one."""
    bits, errors = np.array([_exponent(run) for run in across]).T
    values = [run.steepness for run in across]
    kinds = (
        ("decays", bits < -2.0 * errors),
        ("grows", bits > 2.0 * errors),
        ("does neither by two standard errors", abs(bits) <= 2.0 * errors),
    )
    parts = [f"{word} at kA = {ranges(values, list(chosen))}" for word, chosen in kinds if chosen.any()]
    least, most = (f"{decimals(end, 3)} (kA = {number(values[i])})" for i, end in
                   ((int(at), float(bits[at])) for at in (bits.argmin(), bits.argmax())))  # fmt: skip
    seen = f"from {least} to {most} bits per wave period" if len(across) > 1 else f"{least} bits per wave period"
    looped = [planar_releases(run) > 0 and run not in across for run in runs]
    without = ""
    if any(looped):
        without = (
            f" Planar runs that released loops have none (kA = {ranges([run.steepness for run in runs], looped)}): "
            "there a loop buckles sideways."
        )
    caption = (
        "Exponent of an infinitesimal perturbation across the plane, with one standard error: below zero the planar "
        f"motion is stable. Seen: {seen}. From `{_EXPONENT}` and `{_ERROR}` of `table.csv`."
    )
    return [
        Text(
            "Planar runs carry an infinitesimal perturbation across their plane (`output.lateral_growth`): it "
            f"{'; it '.join(parts)}.{without}"
        ),
        Figure(
            transverse_exponents(np.array(values), bits, errors), caption,
            f"Exponent across the plane over wave steepness: {seen}.",
        ),
    ]  # fmt: skip


def _exponent(run: Run) -> tuple[float, float]:
    """Exponent across the plane and its error in bits per period, nan where there is none."""
    return tuple(float(run.row.get(column, math.nan)) for column in (_EXPONENT, _ERROR))


def planar_radius(run: Run) -> tuple[float, float]:
    """Least and greatest r of the planar run that a run in three dimensions replaces, nan where there was none."""
    return tuple(float(run.row.get(f"planar_radius_{end}_m", math.nan)) for end in ("min", "max"))


def _push_words(folder: Folder, runs) -> str:
    push = folder.provenance.get("push_mps")
    if not any(run.in_space for run in runs):
        return ""
    if not push:
        return "The scene itself gives the buoy a velocity across the waves at t = 0."
    return (
        "Without a push the motion would stay exactly in the plane: as the scene has no velocity across the waves, "
        f"the buoy was given {number(push)} m/s there at t = 0 (`push_mps` in `provenance.json`)."
    )


def _pair_words(pairs: list[Run]) -> str:
    off = [max(abs(value(run, f"radius_{end}_m") - planar) for end, planar in _ends(run)) for run in pairs]
    widths = [value(run, "radius_max_m") - value(run, "radius_min_m") for run in pairs]
    worst = max(range(len(pairs)), key=lambda i: off[i] / widths[i])
    same = [run for run in pairs if run.row["regime"] and run.row["regime"] == run.row["planar_regime"]]
    judged = [run for run in pairs if run.row["regime"] and run.row["planar_regime"]]
    pairs_judged = count(len(judged), "pair")
    regimes = f" The regime is the planar one in {len(same)} of {pairs_judged} with two verdicts." if judged else ""
    return (
        "Against the planar runs they replace, the ends of the range of r differ most at kA = "
        f"{number(pairs[worst].steepness)}: by {decimals(off[worst], 3)} m, {percent(off[worst] / widths[worst])} of "
        f"the range.{regimes}"
    )


def _ends(run: Run) -> tuple[tuple[str, float], ...]:
    return tuple(zip(("min", "max"), planar_radius(run), strict=True))


def _table(runs: list[Run], transient: int) -> Table:
    heads = (
        Column("kA"),
        Column("D"),
        Column("loops, plane"),
        Column("loops, space"),
        Column("rope |y|", "m"),
        Column("buoy |y|", "m"),
        Column("turn", "rad"),
        Column("r min", "m"),
        Column("r max", "m"),
        Column("planar r min", "m"),
        Column("planar r max", "m"),
        Column("regime", align="left"),
        Column("planar regime", align="left"),
    )
    rows = tuple(
        (
            linked(run),
            "3" if run.in_space else "2",
            number(planar_releases(run)),
            number(value(run, "loop_releases")) if run.in_space else EMPTY,
            number(lateral(run, "rope"), 2),
            number(lateral(run, "buoy"), 2),
            decimals(value(run, "max_turn_rad"), 2),
            *(decimals(value(run, f"radius_{end}_m"), 3) if run.in_space else EMPTY for end in ("min", "max")),
            *(decimals(radius, 3) for radius in _planar_range(run)),
            (run.row["regime"] or EMPTY) if run.in_space else EMPTY,
            (run.row.get("planar_regime") if run.in_space else run.row["regime"]) or EMPTY,
        )
        for run in runs
    )
    caption = (
        "Runs in three dimensions (D = 3) and planar runs with loop releases (D = 2). loops: releases in the planar "
        f"run and in the run in three dimensions; |y|: largest distance from the plane of the waves after {transient} "
        "wave periods; turn: largest turn within one element. In three dimensions the regime is that of the samples "
        "alone. From `table.csv`."
    )
    return Table(heads, rows, caption, small=True)


def _planar_range(run: Run) -> tuple[float, float]:
    if run.in_space:
        return planar_radius(run)
    return value(run, "radius_min_m"), value(run, "radius_max_m")
