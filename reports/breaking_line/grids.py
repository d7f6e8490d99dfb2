"""Tables of the breaking line that compare grids and stiffnesses: convergence, doubled grids, bending."""

from __future__ import annotations

import math

from ..parts.content import Column, Table
from ..parts.wording import EMPTY, decimals, number
from .runs import Line, find, of_kind
from .tables import CASES, SHOCKS, SPEEDS, cells_of, heads_of

_SERIES = ("strain_error", "strain_overshoot", "strain_rise", "shock_offset_elements", "end_speed_error")
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


def series_table(lines: tuple[Line, ...]) -> Table | None:
    """Convergence to the exact motion, grid by grid."""
    rows = []
    for case in dict.fromkeys(line.case for line in of_kind(lines, "series")):
        before = None
        for line in (line for line in of_kind(lines, "series") if line.case == case):
            order = math.nan
            if before is not None:
                ratio = (line.value("nodes") - 1) / (before.value("nodes") - 1)
                order = math.log(before.value("strain_error") / line.value("strain_error")) / math.log(ratio)
            cells = cells_of(line, [entry for entry in (*SPEEDS, *SHOCKS) if entry[2] in _SERIES])
            rows.append((line.name, number(line.value("nodes")), decimals(order, 2), *cells))
            before = line
    if not rows:
        return None
    entries = [entry for entry in (*SPEEDS, *SHOCKS) if entry[2] in _SERIES]
    heads = (Column("case"), Column("nodes"), Column("order"), *heads_of(entries))
    caption = (
        "Convergence on even grids, without gravity: the order is that of the mean of |ε − exact| over the line and "
        "over the second half of the time until something arrives at the fixed end; the other columns as above."
    )
    return Table(heads, tuple(rows), caption, small=True)


def stiffness_table(lines: tuple[Line, ...]) -> Table | None:
    """What the bending stiffness changes, on doubled grids."""
    found = list(of_kind(lines, "stiffness"))
    if not found:
        return None
    cases = {line.case for line in found}
    found += [line for line in of_kind(lines, "doubled") if line.case in cases]
    found.sort(key=lambda line: (line.case, line.value("bending_stiffness_Nm2")))
    columns = [entry for entry in CASES if entry[2] != "wall_s"]
    heads = (Column("case"), Column("EI", "N m²"), *heads_of(columns), Column("bending", "%"))
    rows = tuple(
        (
            line.name,
            number(line.value("bending_stiffness_Nm2")),
            *cells_of(line, columns),
            decimals(100 * line.share("bending_J"), 3),
        )
        for line in found
    )
    caption = (
        "Bending stiffness, which the paper does not give, on grids of twice the elements; columns as in the table of "
        "cases, bending: work against the shear forces, in shares of the stored energy."
    )
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
    heads = (Column("case"), *heads_of(_DOUBLED))
    caption = (
        "What changes with twice the elements: the value at the reported grid, and the change in brackets. kinetic, "
        "dissipated (by the viscosity) and bending in shares of the stored energy at the end of the run."
    )
    return Table(heads, tuple(rows), caption, small=True)


def changes_said(lines: tuple[Line, ...]) -> list[str]:
    """Quantities, each with the largest change that doubling the elements brings over the cases."""
    said = []
    for title, unit, column, places in _DOUBLED:
        changes = []
        for doubled in of_kind(lines, "doubled"):
            line = find(lines, doubled.case)
            if line is not None:
                before, after = _pair(line, doubled, unit, column)
                if math.isfinite(after - before):
                    changes.append((abs(after - before), line.name))
        if changes:
            most, name = max(changes)
            said.append(f"{title} {decimals(most, places + 1)} {unit} (case {name})")
    return said


def _pair(line: Line, doubled: Line, unit: str, column: str) -> list[float]:
    return [100 * run.share(column) if unit == "%" else run.value(column) for run in (line, doubled)]


def _change(line: Line, doubled: Line, entry: tuple) -> str:
    _, unit, column, places = entry
    before, after = _pair(line, doubled, unit, column)
    if not (math.isfinite(before) and math.isfinite(after)):
        return EMPTY
    change = decimals(after - before, places)
    return f"{decimals(before, places)} ({change if change.startswith('−') else '+' + change})"
