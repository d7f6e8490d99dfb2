"""Tables of the breaking line: cases, speeds and shocks against theory, energy, grids, stiffness, cost."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace

from ..parts.columns import Quantity, table_of
from ..parts.content import Table
from ..parts.wording import EMPTY, decimals
from .runs import Line, find, of_kind

Columns = dict[str, Quantity]
KINDS = {"doubled": ", doubled grid", "straight": ", straight", "stiffness": ", doubled grid", "series": ", straight"}
CASES = (
    "case", "force_N", "status", "end_speed_mps", "recoil_m", "x_min_m", "left_of_fixed_end_m", "vertical_m",
    "vertical_beyond_m", "steepest_tilt_rad", "buckled_m", "max_turn_rad", "min_strain",
)  # fmt: skip
SPEEDS = (
    "case", "nodes", "end_speed_mps", "end_speed_theory_mps", "end_speed_shocked_theory_mps", "end_speed_error",
    "front_speed_mps", "front_speed_theory_mps", "slack_front_speed_mps", "slack_front_speed_theory_mps",
    "strain_overshoot", "strain_rise", "strain_error",
)  # fmt: skip
SHOCKS = (
    "case", "nodes", "shock_birth_m", "shock_birth_theory_m", "shock_birth_theory_s", "shock_speed_mps",
    "shock_speed_theory_mps", "shock_offset_m", "shock_offset_largest_m", "shock_offset_elements",
)  # fmt: skip
SERIES = (
    "case", "nodes", "order", "strain_error", "strain_overshoot", "strain_rise", "shock_offset_elements",
    "end_speed_error",
)  # fmt: skip
ENERGIES = (
    "kinetic_J", "strain_J", "gravity_J", "bending_J", "end_work_J", "end_work_theory_J", "viscous_J", "scheme_space_J",
    "scheme_time_J", "remainder_J", "lost_at_arrival_J", "lost_at_arrival_theory_J",
)  # fmt: skip
DOUBLED = (
    "end_speed_mps", "front_speed_mps", "recoil_m", "x_min_m", "vertical_m", "steepest_tilt_rad", "buckled_m",
    "kinetic_J", "viscous_J", "bending_J",
)  # fmt: skip
COST = (
    "case", "nodes", "bending_stiffness_Nm2", "steps", "newton_iterations", "newton_failures", "max_turn_rad", "wall_s",
)  # fmt: skip


def cases_table(lines: tuple[Line, ...], columns: Columns) -> Table:
    """Every case that was asked for, failed ones included."""
    cases = [line for line in lines if line.kind == "case"]
    return _table(columns, CASES, cases, "The cases of `table.csv`; primes: fracture in 50 ms.")


def speeds_table(lines: tuple[Line, ...], columns: Columns) -> Table:
    """Speeds of the end and of fronts, and errors of strain: all cases, and the straight lines."""
    shown = [line for kind in ("case", "straight") for line in of_kind(lines, kind)]
    caption = "Speeds against exact theory; straight: without gravity, on an even grid. An exact wave has no rise."
    return _table(columns, SPEEDS, shown, caption)


def shocks_table(lines: tuple[Line, ...], columns: Columns) -> Table | None:
    """Shocks where theory has one."""
    shown = [line for kind in ("straight", "case", "doubled") for line in of_kind(lines, kind)]
    shocked = [line for line in shown if math.isfinite(line.value("shock_birth_theory_m"))]
    return _table(columns, SHOCKS, shocked, "Shocks against exact theory.") if shocked else None


def series_table(lines: tuple[Line, ...], columns: Columns) -> Table | None:
    """Convergence to the exact motion, grid by grid."""
    found = sorted(of_kind(lines, "series"), key=lambda line: (line.case, line.value("nodes")))
    rows, before = [], None
    for line in found:
        order = math.nan
        if before is not None and before.case == line.case:
            ratio = (line.value("nodes") - 1) / (before.value("nodes") - 1)
            order = math.log(before.value("strain_error") / line.value("strain_error")) / math.log(ratio)
        rows.append(line.row | {"case": line.name, "order": order})
        before = line
    if not rows:
        return None
    more = columns | {"order": Quantity("order", "", "order", "order of the mean of |ε − exact|", 2)}
    return table_of(more, SERIES, rows, "Convergence on even grids, without gravity.")


def stiffness_table(lines: tuple[Line, ...], columns: Columns) -> Table | None:
    """What the bending stiffness changes, on doubled grids."""
    found = list(of_kind(lines, "stiffness"))
    found += [line for line in of_kind(lines, "doubled") if line.case in {other.case for other in found}]
    if not found:
        return None
    found.sort(key=lambda line: (line.case, line.value("bending_stiffness_Nm2")))
    names = ("case", "bending_stiffness_Nm2", *CASES[3:], "bending_J")
    rows = [_named(line) | shares(line, ("bending_J",)) for line in found]
    caption = "Bending stiffness, which the paper does not give, on grids of twice the elements."
    return table_of(in_percent(columns, ("bending_J",)), names, rows, caption)


def energy_table(lines: tuple[Line, ...], columns: Columns) -> Table | None:
    """The energy budget at the end of every case, in shares of what was stored."""
    found = [line for line in of_kind(lines, "case") if math.isfinite(line.value("stored_J"))]
    if not found:
        return None
    rows = [_named(line) | shares(line, ENERGIES) for line in found]
    caption = "Energy at the end of each run, in shares of the strain energy stored at the start."
    return table_of(in_percent(columns, ENERGIES), ("case", "stored_J", *ENERGIES), rows, caption)


def doubled_table(lines: tuple[Line, ...], columns: Columns) -> Table | None:
    """Quoted quantities and what a doubled grid changes."""
    percent = [name for name in DOUBLED if name.endswith("_J")]
    rows = [
        {"case": line.name} | _changes(line, fine, in_percent(columns, percent))
        for fine in of_kind(lines, "doubled")
        if (line := find(lines, fine.case)) is not None
    ]
    if not rows:
        return None
    caption = "What twice the elements change: the value at the reported grid, and the change in brackets."
    own = {name: lambda row, name=name: row[name] for name in DOUBLED}
    return table_of(in_percent(columns, percent), ("case", *DOUBLED), rows, caption, own)


def cost_table(lines: tuple[Line, ...], columns: Columns) -> Table:
    """Steps, Newton iterations and wall time of every run."""
    return _table(columns, COST, lines, "Every run of `table.csv`: work and wall time, compilation left out.")


def shares(line: Line, names: Iterable[str]) -> dict[str, float]:
    """Energies in per cent of the stored one."""
    return {name: 100.0 * line.share(name) for name in names}


def in_percent(columns: Columns, names: Iterable[str]) -> Columns:
    """The dictionary with these energies in per cent of the stored one."""
    return columns | {name: replace(columns[name], unit="%", digits=2) for name in names}


def _changes(line: Line, fine: Line, columns: Columns) -> dict[str, str]:
    cells = {}
    for name in DOUBLED:
        both = [100.0 * run.share(name) if name.endswith("_J") else run.value(name) for run in (line, fine)]
        change = decimals(both[1] - both[0], columns[name].digits)
        known = all(map(math.isfinite, both))
        signed = change if change.startswith("−") else f"+{change}"
        cells[name] = f"{columns[name].cell(both[0])} ({signed})" if known else EMPTY
    return cells


def _named(line: Line) -> dict[str, object]:
    return line.row | {"case": f"{line.name}{KINDS.get(line.kind, '')}"}


def _table(columns: Columns, names: tuple[str, ...], lines: Iterable[Line], caption: str) -> Table:
    return table_of(columns, names, [_named(line) for line in lines], caption)
