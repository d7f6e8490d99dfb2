"""The runs of the breaking line as the report looks at them, row and trajectory of each case, and the tables of them:
cases, speeds and shocks against theory, energy, grids, stiffness, cost.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import pairwise

import xarray

from tables import Column

from ..figures.line_panels import named
from ..parts import Folder, FolderError, Table, TableRow, having, read_files, table_of

Columns = dict[str, Column]
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
    "kinetic_J", "kinetic_largest_J", "strain_J", "gravity_J", "bending_J", "end_work_J", "end_work_theory_J",
    "viscous_J", "scheme_space_J", "scheme_time_J", "remainder_J", "remainder_largest_J", "lost_at_arrival_J",
    "lost_at_arrival_theory_J",
)  # fmt: skip
DOUBLED = (
    "case", "nodes", "end_speed_mps", "front_speed_mps", "recoil_m", "x_min_m", "vertical_m", "steepest_tilt_rad",
    "buckled_m", "kinetic_J", "viscous_J", "bending_J",
)  # fmt: skip
COST = (
    "case", "nodes", "bending_stiffness_Nm2", "steps", "newton_iterations", "newton_failures", "max_turn_rad", "wall_s",
)  # fmt: skip
OF_RUNS = {  # table -> its columns; kinds of run; what a run must have; caption
    # It must have a number in that column, or its case a run of that kind; "": failed runs are shown too.
    "cases": (CASES, ("case",), "", "The cases of `table.csv`; primes: fracture in 50 ms."),
    "speeds": (
        SPEEDS,
        ("case", "straight"),
        "nodes",
        "Speeds against exact theory; straight: without gravity, on an even grid. An exact wave has no rise.",
    ),
    "shocks": (SHOCKS, ("straight", "case", "doubled"), "shock_birth_theory_m", "Shocks against exact theory."),
    "energies": (
        ("case", "stored_J", *ENERGIES),
        ("case",),
        "stored_J",
        "Energy at the end of each run, in shares of the strain energy stored at the start.",
    ),
    "stiffness": (
        ("case", "bending_stiffness_Nm2", *CASES[3:], "bending_J"),
        ("stiffness", "doubled"),
        "stiffness",
        "Bending stiffness, which the paper does not give, on grids of twice the elements.",
    ),
    "doubled": (DOUBLED, ("case", "doubled"), "doubled", "What twice the elements change, case by case."),
    "cost": (COST, ("case", *KINDS), "", "Every run of `table.csv`: work and wall time, compilation left out."),
}
FAST, SLOW = ("1", "2", "3", "4"), ("1p", "2p", "3p", "4p")


@dataclass(frozen=True, eq=False)
class Line(TableRow):
    """One row of the table.

    `trajectory`: of kind "case", where its file can be read; `fault`: why it cannot, else "".
    """

    trajectory: object | None = None
    fault: str = ""

    @property
    def name(self) -> str:
        """As the paper writes it: 4, 4′."""
        return named(self["case"])

    def share(self, column: str) -> float:
        """An energy as a share of the stored one."""
        return self[column] / self["stored_J"]


def read_lines(folder: Folder) -> list[Line]:
    """Every run of the table, in its order."""
    lines = []
    for row in folder.table:
        if row["kind"] == "case":
            lines.append(Line(row, *folder.trajectory(row)))
        else:
            lines.append(Line(row))
    return lines


def read_exact(folder: Folder) -> xarray.Dataset | None:
    """exact.nc of the folder: characteristics, shocks and speeds of exact theory; None where it has none."""
    try:
        return read_files(folder.directory, {"exact.nc": "exact theory"})["exact.nc"]
    except FolderError:
        return None


def of_kind(lines: Iterable[Line], *kinds: str) -> list[Line]:
    """The runs that ended as asked, kind by kind."""
    runs = []
    for kind in kinds:
        runs += having(lines, kind=kind, status="ok")
    return runs


def table_of_runs(lines: list[Line], columns: Columns, kind: str) -> Table | None:
    """A table of OF_RUNS, its energies in per cent of the stored one; None where no run is to be shown."""
    names, kinds, needed, caption = OF_RUNS[kind]
    shown = _runs_to_show(lines, kinds, needed)
    if not shown:
        return None
    energies = []
    for name in names:
        if name.endswith("_J") and name != "stored_J":
            energies.append(name)
    rows = []
    for line in shown:
        row = line.row | {"case": f"{line.name}{KINDS.get(line['kind'], '')}"}
        for name in energies:
            row[name] = 100.0 * line.share(name)
        rows.append(row)
    in_percent = {name: replace(columns[name], unit="%", digits=2) for name in energies}
    return table_of(columns | in_percent, names, rows, caption)


def _runs_to_show(lines: list[Line], kinds: tuple[str, ...], needed: str) -> list[Line]:
    """The runs of these kinds that a table of OF_RUNS shows; needed: what they must have, as described there."""
    if not needed:
        return [line for line in lines if line["kind"] in kinds]
    ended = of_kind(lines, *kinds)
    if needed not in KINDS:
        return [line for line in ended if line.known(needed)]
    varied = {line["case"] for line in of_kind(lines, needed)}
    shown = [line for line in ended if line["case"] in varied]
    return sorted(shown, key=lambda line: (line["case"], line["nodes"], line["bending_stiffness_Nm2"]))


def series_table(lines: list[Line], columns: Columns) -> Table | None:
    """Convergence to the exact motion, grid by grid."""
    series = sorted(of_kind(lines, "series"), key=lambda line: (line["case"], line["nodes"]))
    if not series:
        return None
    rows = [line.row | {"case": line.name, "order": math.nan} for line in series]
    for (coarser, line), row in zip(pairwise(series), rows[1:], strict=False):
        if coarser["case"] == line["case"]:
            ratio = (line["nodes"] - 1) / (coarser["nodes"] - 1)
            row["order"] = math.log(coarser["strain_error"] / line["strain_error"]) / math.log(ratio)
    quantities = columns | {"order": Column("order", "", "order", "order of the mean of |ε − exact|", 2)}
    return table_of(quantities, SERIES, rows, "Convergence on even grids, without gravity.")
