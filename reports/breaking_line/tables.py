"""Tables of the breaking line: cases, speeds and shocks against theory, energy, cost."""

from __future__ import annotations

import math

from ..parts.content import Column, Table
from ..parts.wording import decimals, number
from .runs import Line, of_kind

# title, unit, column, decimals
CASES = (
    ("end speed", "m/s", "end_speed_mps", 2),
    ("recoil", "m", "recoil_m", 2),
    ("x min", "m", "x_min_m", 3),
    ("left of it", "m", "left_of_fixed_end_m", 2),
    ("vertical", "m", "vertical_m", 3),
    ("beyond", "m", "vertical_beyond_m", 3),
    ("tilt", "rad", "steepest_tilt_rad", 2),
    ("folded", "m", "buckled_m", 2),
    ("turn", "rad", "max_turn_rad", 2),
    ("ε min", "–", "min_strain", 3),
    ("wall", "s", "wall_s", 2),
)
SPEEDS = (
    ("end speed", "m/s", "end_speed_mps", 2),
    ("exact", "m/s", "end_speed_theory_mps", 2),
    ("shocked", "m/s", "end_speed_shocked_theory_mps", 2),
    ("off", "%", "end_speed_error", 3),
    ("front", "m/s", "front_speed_mps", 1),
    ("exact", "m/s", "front_speed_theory_mps", 1),
    ("slack front", "m/s", "slack_front_speed_mps", 1),
    ("exact", "m/s", "slack_front_speed_theory_mps", 1),
    ("above", "%", "strain_overshoot", 2),
    ("rise", "%", "strain_rise", 2),
    ("|ε − exact|", "10⁻⁶", "strain_error", 2),
)
SHOCKS = (
    ("born at", "m", "shock_birth_m", 2),
    ("exact", "m", "shock_birth_theory_m", 2),
    ("at time", "ms", "shock_birth_theory_s", 2),
    ("speed", "m/s", "shock_speed_mps", 1),
    ("exact", "m/s", "shock_speed_theory_mps", 1),
    ("off by", "mm", "shock_offset_m", 1),
    ("at most", "mm", "shock_offset_largest_m", 1),
    ("elements", "", "shock_offset_elements", 2),
)
_SCALES = {
    "strain_error": 1e6, "shock_birth_theory_s": 1e3, "shock_offset_m": 1e3, "shock_offset_largest_m": 1e3,
    "end_speed_error": 100.0, "strain_overshoot": 100.0, "strain_rise": 100.0,
}  # fmt: skip
_ENERGIES = (
    ("kinetic", ("kinetic_J",)),
    ("strain", ("strain_J",)),
    ("weight", ("gravity_J",)),
    ("bending", ("bending_J",)),
    ("taken out", ("end_work_J",)),
    ("exact", ("end_work_theory_J",)),
    ("viscosity", ("viscous_J",)),
    ("scheme", ("scheme_space_J", "scheme_time_J")),
    ("remainder", ("remainder_J",)),
)
KINDS = {
    "case": "", "doubled": ", doubled grid", "straight": ", straight", "stiffness": ", doubled grid",
    "series": ", straight",
}  # fmt: skip


def cases_table(lines: tuple[Line, ...]) -> Table:
    """Every case that was asked for, failed ones included."""
    heads = (Column("case"), Column("F", "kN"), Column("status", align="left"), *heads_of(CASES))
    rows = tuple(
        (line.name, decimals(1e-3 * line.value("force_N"), 0), line.row["status"], *cells_of(line, CASES))
        for line in lines
        if line.kind == "case"
    )
    caption = (
        "The cases of `table.csv`; primes: fracture in 50 ms. End speed: median from 5 ms after the break on. x min: "
        "leftmost point, the fixed end is at 0; left of it: unstretched length that has been there. vertical: largest "
        "rise or fall of any node, and beyond the quarter at the fixed end. tilt: steepest element, followed round; "
        "folded: length up to where one is steeper than 0.2 rad at the end. turn: within one element."
    )
    return Table(heads, rows, caption, small=True)


def speeds_table(lines: tuple[Line, ...]) -> Table:
    """Speeds of the end and of fronts, and errors of strain: all cases, and the straight lines."""
    heads = (Column("run", align="left"), Column("nodes"), *heads_of(SPEEDS))
    rows = tuple(named_row(line, SPEEDS) for kind in ("case", "straight") for line in of_kind(lines, kind))
    caption = (
        "Speeds against exact theory. shocked: the exact end speed behind a shock of full strength; off: largest "
        "difference from the exact motion at any time. front: contours of 80 to 98 % of the static tension, "
        "extrapolated to all of it, before a shock meets them; slack front: contours of small strain, extrapolated to "
        "no tension; a dash where too little of either is seen. Until something arrives at the fixed end: strain above "
        "the static one, its largest rise towards the broken end (exact: none), both over the static one, and the mean "
        "of |ε − exact|."
    )
    return Table(heads, rows, caption, small=True)


def shocks_table(lines: tuple[Line, ...]) -> Table | None:
    """Shocks where theory has one."""
    shocked = [
        line
        for kind in ("straight", "case", "doubled")
        for line in of_kind(lines, kind)
        if math.isfinite(line.value("shock_birth_theory_m"))
    ]
    if not shocked:
        return None
    heads = (Column("run", align="left"), Column("nodes"), *heads_of(SHOCKS))
    caption = (
        "Shocks. born at: distance from the broken end at which the front turns vertical, extrapolated from its "
        "steepening over the first 40 % of the way; exact: where characteristics first cross, and when. speed: over "
        "all profiles that show it. off by: place less the exact one, mean, largest, and median in elements. straight: "
        "without gravity, on an even grid."
    )
    return Table(heads, tuple(named_row(line, SHOCKS) for line in shocked), caption, small=True)


def energy_table(lines: tuple[Line, ...]) -> Table | None:
    """The energy budget at the end of every case, in shares of what was stored."""
    found = [line for line in of_kind(lines, "case") if math.isfinite(line.value("stored_J"))]
    if not found:
        return None
    heads = (
        Column("case"),
        Column("stored", "kJ"),
        *(Column(title, "%") for title, _ in _ENERGIES),
        Column("lost by then", "%"),
        Column("exact", "%"),
    )
    rows = []
    for line in found:
        cells = [decimals(100 * line.share(*columns), 4 if title in ("remainder", "weight", "scheme") else 2)
                 for title, columns in _ENERGIES]  # fmt: skip
        lost = [decimals(100 * line.share(f"lost_at_arrival{part}_J"), 3) for part in ("", "_theory")]
        rows.append((line.name, decimals(1e-3 * line.value("stored_J"), 1), *cells, *lost))
    caption = (
        "Energy at the end of each run, in shares of the strain energy stored at the start. weight: change of its "
        "energy. taken out (below zero): work of the decaying end force, beside the exact simple wave. viscosity, "
        "scheme: dissipated by the shock viscosity and by the discretisation, added up step by step. remainder: at the "
        "start + work − all the rest. lost by then: dissipated when front or shock is at the fixed end, beside the "
        "exact loss."
    )
    return Table(heads, tuple(rows), caption, small=True)


def cost_table(lines: tuple[Line, ...]) -> Table:
    """Steps, Newton iterations and wall time of every run."""
    entries = (
        ("steps", "", "steps", 0),
        ("Newton", "", "newton_iterations", 0),
        ("failures", "", "newton_failures", 0),
        ("turn", "rad", "max_turn_rad", 2),
        ("wall", "s", "wall_s", 2),
    )
    heads = (Column("run", align="left"), Column("nodes"), Column("EI", "N m²"), *heads_of(entries))
    rows = tuple(
        (
            f"{line.name}{KINDS.get(line.kind, '')}",
            number(line.value("nodes")),
            number(line.value("bending_stiffness_Nm2")),
            *cells_of(line, entries),
        )
        for line in lines
    )
    return Table(heads, rows, "Every run of `table.csv`: work and wall time, compilation left out.", small=True)


def heads_of(entries) -> tuple[Column, ...]:
    return tuple(Column(title, unit) for title, unit, *_ in entries)


def cells_of(line: Line, entries) -> tuple[str, ...]:
    return tuple(decimals(_SCALES.get(column, 1.0) * line.value(column), places) for _, _, column, places in entries)


def named_row(line: Line, entries) -> tuple[str, ...]:
    return (f"{line.name}{KINDS[line.kind]}", number(line.value("nodes")), *cells_of(line, entries))
