"""Tables of the breaking line: cases, speeds and shocks against theory, energy, grids, stiffness, cost."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from itertools import pairwise

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
OF_RUNS = {  # table -> its columns; kinds of run; a column that is known of each run, "" for failed runs too; caption
    "cases": (CASES, ("case",), "", "The cases of `table.csv`; primes: fracture in 50 ms."),
    "speeds": (
        SPEEDS,
        ("case", "straight"),
        "nodes",
        "Speeds against exact theory; straight: without gravity, on an even grid. An exact wave has no rise.",
    ),
    "shocks": (SHOCKS, ("straight", "case", "doubled"), "shock_birth_theory_m", "Shocks against exact theory."),
    "cost": (COST, ("case", *KINDS), "", "Every run of `table.csv`: work and wall time, compilation left out."),
}


def table_of_runs(lines: tuple[Line, ...], columns: Columns, which: str) -> Table | None:
    """A table of OF_RUNS; None where no run is to be shown."""
    names, kinds, needed, caption = OF_RUNS[which]
    shown = [line for line in of_kind(lines, *kinds) if line.known(needed)] if needed else lines
    return _table(columns, names, [line for line in shown if line["kind"] in kinds], caption)


def series_table(lines: tuple[Line, ...], columns: Columns) -> Table | None:
    """Convergence to the exact motion, grid by grid."""
    found = sorted(of_kind(lines, "series"), key=lambda line: (line["case"], line["nodes"]))
    rows = [line.row | {"case": line.name, "order": math.nan} for line in found]
    for (before, line), row in zip(pairwise(found), rows[1:], strict=False):
        if before["case"] == line["case"]:
            ratio = (line["nodes"] - 1) / (before["nodes"] - 1)
            row["order"] = math.log(before["strain_error"] / line["strain_error"]) / math.log(ratio)
    more = columns | {"order": Quantity("order", "", "order", "order of the mean of |ε − exact|", 2)}
    return table_of(more, SERIES, rows, "Convergence on even grids, without gravity.") if rows else None


def stiffness_table(lines: tuple[Line, ...], columns: Columns) -> Table | None:
    """What the bending stiffness changes, on doubled grids."""
    varied = {line["case"] for line in of_kind(lines, "stiffness")}
    found = [line for line in of_kind(lines, "stiffness", "doubled") if line["case"] in varied]
    found.sort(key=lambda line: (line["case"], line["bending_stiffness_Nm2"]))
    caption = "Bending stiffness, which the paper does not give, on grids of twice the elements."
    return _table(columns, ("case", "bending_stiffness_Nm2", *CASES[3:], "bending_J"), found, caption, ("bending_J",))


def energy_table(lines: tuple[Line, ...], columns: Columns) -> Table | None:
    """The energy budget at the end of every case, in shares of what was stored."""
    found = [line for line in of_kind(lines, "case") if line.known("stored_J")]
    caption = "Energy at the end of each run, in shares of the strain energy stored at the start."
    return _table(columns, ("case", "stored_J", *ENERGIES), found, caption, ENERGIES)


def doubled_table(lines: tuple[Line, ...], columns: Columns) -> Table | None:
    """Quoted quantities and what a doubled grid changes."""
    columns = _in_percent(columns, [name for name in DOUBLED if name.endswith("_J")])
    pairs = [(find(lines, fine["case"]), fine) for fine in of_kind(lines, "doubled")]
    rows = [{"case": line.name} | _changes(line, fine, columns) for line, fine in pairs if line is not None]
    caption = "What twice the elements change: the value at the reported grid, and the change in brackets."
    own = {name: lambda row, name=name: row[name] for name in DOUBLED}
    return table_of(columns, ("case", *DOUBLED), rows, caption, own) if rows else None


def _changes(line: Line, fine: Line, columns: Columns) -> dict[str, str]:
    cells = {}
    for name in DOUBLED:
        both = [100.0 * run.share(name) if name.endswith("_J") else run[name] for run in (line, fine)]
        change = decimals(both[1] - both[0], columns[name].digits)
        known = all(map(math.isfinite, both))
        signed = change if change.startswith("−") else f"+{change}"
        cells[name] = f"{columns[name].cell(both[0])} ({signed})" if known else EMPTY
    return cells


def _in_percent(columns: Columns, names: Iterable[str]) -> Columns:
    """The dictionary with these energies in per cent of the stored one."""
    return columns | {name: replace(columns[name], unit="%", digits=2) for name in names}


def _table(
    columns: Columns, names: tuple[str, ...], lines: list[Line], caption: str, shares: tuple[str, ...] = ()
) -> Table | None:
    """Lines by name and kind; shares: energies to be given in per cent of the stored one."""
    rows = [
        line.row
        | {"case": f"{line.name}{KINDS.get(line['kind'], '')}"}
        | {name: 100.0 * line.share(name) for name in shares}
        for line in lines
    ]
    return table_of(_in_percent(columns, shares), names, rows, caption) if rows else None
