"""Tables of the breaking line: cases, fronts and shocks against theory, energy, bending stiffness, doubled grids, cost."""

from __future__ import annotations

import math

from .breaking_runs import Line, find, of_kind
from .content import Column, Table
from .wording import EMPTY, decimals, number

# title, unit, column, decimals
_CASES = (
    ("end speed", "m/s", "end_speed_mps", 2),
    ("exact", "m/s", "end_speed_theory_mps", 2),
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
_FRONTS = (
    ("front", "m/s", "front_speed_mps", 1),
    ("exact", "m/s", "front_speed_theory_mps", 1),
    ("√(T′/m)", "m/s", "static_wave_speed_mps", 1),
    ("slack front", "m/s", "slack_front_speed_mps", 1),
    ("exact", "m/s", "slack_front_speed_theory_mps", 1),
    ("overshoot", "–", "strain_overshoot", 4),
    ("|ε − exact|", "10⁻⁴", "strain_error", 2),
)
_SHOCKS = (
    ("born at", "m", "shock_birth_m", 2),
    ("exact", "m", "shock_birth_theory_m", 2),
    ("at time", "ms", "shock_birth_theory_s", 2),
    ("speed", "m/s", "shock_speed_mps", 1),
    ("exact", "m/s", "shock_speed_theory_mps", 1),
    ("off by", "mm", "shock_offset_m", 1),
    ("at most", "mm", "shock_offset_largest_m", 1),
)
_SCALES = {
    "strain_error": 1e4, "shock_birth_theory_s": 1e3, "shock_offset_m": 1e3, "shock_offset_largest_m": 1e3
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
_DOUBLED = (
    ("end speed", "m/s", "end_speed_mps", 2),
    ("front", "m/s", "front_speed_mps", 1),
    ("recoil", "m", "recoil_m", 2),
    ("x min", "m", "x_min_m", 3),
    ("vertical", "m", "vertical_m", 3),
    ("tilt", "rad", "steepest_tilt_rad", 2),
    ("folded", "m", "buckled_m", 2),
    ("kinetic", "%", "kinetic_J", 2),
    ("dissipated", "%", "viscous_J", 3),
    ("bending", "%", "bending_J", 3),
)
KINDS = {"case": "", "doubled": ", doubled grid", "straight": ", straight", "stiffness": ""}


def cases_table(lines: tuple[Line, ...]) -> Table:
    """Every case that was asked for, failed ones included."""
    heads = (Column("case"), Column("F", "kN"), Column("status", align="left"), *_heads(_CASES))
    rows = tuple(
        (line.name, decimals(1e-3 * line.value("force_N"), 0), line.row["status"], *_cells(line, _CASES))
        for line in lines
        if line.kind == "case"
    )
    caption = (
        "The cases of `table.csv`; primes: fracture in 50 ms. End speed: median from 5 ms after the break on, beside the "
        "exact simple wave. x min: leftmost point, the fixed end is at 0; left of it: unstretched length that has been "
        "there. vertical: largest rise or fall of any node, and beyond the quarter at the fixed end. tilt: steepest "
        "element; folded: length up to where one is steeper than 0.2 rad at the end. turn: within one element."
    )
    return Table(heads, rows, caption, small=True)


def fronts_table(lines: tuple[Line, ...]) -> Table:
    """Fronts of all cases, and of the straight lines."""
    heads = (Column("run", align="left"), Column("nodes"), *_heads(_FRONTS))
    rows = tuple(_named(line, _FRONTS) for kind in ("case", "straight") for line in of_kind(lines, kind))
    caption = (
        "Fronts. front: contour of 99 % of the static tension, beside its exact speed, and the wave speed at the static "
        "tension; a dash where a shock overtakes it at once. slack front: contours of small strain, extrapolated to no "
        "tension. overshoot: largest strain above the static one, over it, before the front arrives. |ε − exact|: mean "
        "over the line when the front arrives, gravity left out of the exact solution."
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
    heads = (Column("run", align="left"), Column("nodes"), *_heads(_SHOCKS))
    caption = (
        "Shocks. born at: distance from the broken end at which the front turns vertical, extrapolated from its steepening "
        "over the first 40 % of the way; exact: where characteristics first cross, and when. speed: over all profiles "
        "that show it. off by: place less the exact one, mean and largest. straight: without gravity, on an even grid."
    )
    return Table(heads, tuple(_named(line, _SHOCKS) for line in shocked), caption, small=True)


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
        "energy. taken out (below zero): work of the decaying end force, beside the exact simple wave. viscosity, scheme: "
        "dissipated by the shock viscosity and by the discretisation, added up step by step. remainder: at the start + "
        "work − all the rest. lost by then: dissipated when the front arrives, beside the exact loss in the shock."
    )
    return Table(heads, tuple(rows), caption, small=True)


def stiffness_table(lines: tuple[Line, ...]) -> Table | None:
    """What the bending stiffness changes."""
    found = list(of_kind(lines, "stiffness"))
    if not found:
        return None
    cases = {line.case for line in found}
    found += [line for line in of_kind(lines, "case") if line.case in cases]
    found.sort(key=lambda line: (line.case, line.value("bending_stiffness_Nm2")))
    columns = [entry for entry in _CASES if entry[2] not in ("end_speed_theory_mps", "wall_s")]
    heads = (Column("case"), Column("EI", "N m²"), *_heads(columns), Column("bending", "%"))
    rows = tuple(
        (
            line.name,
            number(line.value("bending_stiffness_Nm2")),
            *_cells(line, columns),
            decimals(100 * line.share("bending_J"), 3),
        )
        for line in found
    )
    caption = "Bending stiffness, which the paper does not give; columns as in the table of cases."
    return Table(heads, rows, caption, small=True)


def doubled_table(lines: tuple[Line, ...]) -> Table | None:
    """Quoted quantities and what a doubled grid changes."""
    rows = []
    for doubled in of_kind(lines, "doubled"):
        line = find(lines, doubled.case)
        if line is not None:
            rows.append((line.name, *(_change(line, doubled, entry) for entry in _DOUBLED)))
    if not rows:
        return None
    heads = (Column("case"), *_heads(_DOUBLED))
    caption = (
        "What changes with twice the elements: the value at the reported grid, and the change in brackets. kinetic, "
        "dissipated (by the viscosity) and bending in shares of the stored energy at the end of the run."
    )
    return Table(heads, tuple(rows), caption, small=True)


def _change(line: Line, doubled: Line, entry: tuple) -> str:
    _, unit, column, places = entry
    before, after = (100 * run.share(column) if unit == "%" else run.value(column) for run in (line, doubled))
    if not (math.isfinite(before) and math.isfinite(after)):
        return EMPTY
    change = decimals(after - before, places)
    return f"{decimals(before, places)} ({change if change.startswith('−') else '+' + change})"


def cost_table(lines: tuple[Line, ...]) -> Table:
    """Steps, Newton iterations and wall time of every run."""
    entries = (
        ("steps", "", "steps", 0),
        ("Newton", "", "newton_iterations", 0),
        ("failures", "", "newton_failures", 0),
        ("turn", "rad", "max_turn_rad", 2),
        ("wall", "s", "wall_s", 2),
    )
    heads = (Column("run", align="left"), Column("nodes"), Column("EI", "N m²"), *_heads(entries))
    rows = tuple(
        (
            f"{line.name}{KINDS.get(line.kind, '')}",
            number(line.value("nodes")),
            number(line.value("bending_stiffness_Nm2")),
            *_cells(line, entries),
        )
        for line in lines
    )
    return Table(heads, rows, "Every run of `table.csv`: work and wall time, compilation left out.", small=True)


def _heads(entries) -> tuple[Column, ...]:
    return tuple(Column(title, unit) for title, unit, *_ in entries)


def _cells(line: Line, entries) -> tuple[str, ...]:
    return tuple(
        decimals(_SCALES.get(column, 1.0) * line.value(column), places) for _, _, column, places in entries
    )


def _named(line: Line, entries) -> tuple[str, ...]:
    return (f"{line.name}{KINDS[line.kind]}", number(line.value("nodes")), *_cells(line, entries))
