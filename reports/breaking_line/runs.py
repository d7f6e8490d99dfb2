"""The runs of the breaking line as the report looks at them: row of the table, and the trajectory of each case."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..parts.folder import Folder

WORDS = ("case", "kind")
COLUMNS = (
    *WORDS, "status", "force_N", "breaking_time_s", "bending_stiffness_Nm2", "nodes", "end_speed_mps",
    "end_speed_least_mps", "end_speed_most_mps", "end_speed_theory_mps", "end_speed_shocked_theory_mps",
    "end_speed_error", "speed_largest_mps", "front_speed_mps", "front_speed_theory_mps", "slack_front_speed_mps",
    "slack_front_speed_theory_mps", "arrival_theory_s", "shock_birth_m", "shock_birth_theory_m", "shock_birth_theory_s",
    "shock_speed_mps", "shock_speed_theory_mps", "shock_offset_m", "shock_offset_largest_m", "shock_offset_elements",
    "strain_error", "strain_overshoot", "strain_rise", "x_min_m", "left_of_fixed_end_m", "recoil_m",
    "recoil_120ms_m", "vertical_m", "vertical_beyond_m", "steepest_tilt_rad", "buckled_m", "tension_spread",
    "kinetic_spread", "fast_share", "resting_share", "stored_J", "kinetic_J", "kinetic_largest_J", "strain_J",
    "gravity_J", "end_work_J", "end_work_theory_J", "bending_J", "viscous_J", "scheme_space_J", "scheme_time_J",
    "remainder_J", "remainder_largest_J", "lost_at_arrival_J", "lost_at_arrival_theory_J", "max_turn_rad",
    "min_strain", "steps", "newton_iterations", "newton_failures", "end_time_s", "wall_s", "run_key", "message",
)  # fmt: skip
FAST, SLOW = ("1", "2", "3", "4"), ("1p", "2p", "3p", "4p")


@dataclass(frozen=True, eq=False)
class Line:
    """One row of the table.

    `trajectory`: of kind "case", where its file can be read; `fault`: why it cannot, else "".
    """

    row: dict
    trajectory: object | None
    fault: str

    @property
    def case(self) -> str:
        return self.row["case"]

    @property
    def kind(self) -> str:
        return self.row["kind"]

    @property
    def name(self) -> str:
        """As the paper writes it: 4, 4′."""
        return named(self.case)

    @property
    def ok(self) -> bool:
        return self.row["status"] == "ok"

    def value(self, column: str) -> float:
        """A number of the row, nan where the table leaves it empty."""
        found = self.row[column]
        return math.nan if found is None or found == "" else float(found)

    def share(self, *columns: str) -> float:
        """The sum of energies as a share of the stored one."""
        return sum(self.value(column) for column in columns) / self.value("stored_J")


def named(case: str) -> str:
    """A case of the command line as the paper writes it."""
    return case.replace("p", "′")


def read_lines(folder: Folder) -> tuple[Line, ...]:
    """Every run of the table, in its order."""
    return tuple(_read_line(folder, row) for row in folder.table.to_dict("records"))


def of_kind(lines: tuple[Line, ...], kind: str) -> tuple[Line, ...]:
    """The runs of one kind that ended as asked."""
    return tuple(line for line in lines if line.kind == kind and line.ok)


def find(lines: tuple[Line, ...], case: str, kind: str = "case") -> Line | None:
    """The run of a case and kind that ended as asked, None where there is none."""
    return next((line for line in of_kind(lines, kind) if line.case == case), None)


def pairs(lines: tuple[Line, ...]) -> list[tuple[Line, Line]]:
    """Fast and slow break of the same tension, where both ended as asked."""
    found = [(find(lines, fast), find(lines, slow)) for fast, slow in zip(FAST, SLOW, strict=True)]
    return [(fast, slow) for fast, slow in found if fast is not None and slow is not None]


def _read_line(folder: Folder, row: dict) -> Line:
    from engine.trajectory import Trajectory, TrajectoryError

    if row["kind"] != "case":
        return Line(row, None, "")
    path = folder.trajectory_path(row["run_key"])
    if not path.exists():
        return Line(row, None, f"its file {path.name} is missing" if row["status"] == "ok" else "")
    try:
        return Line(row, Trajectory.load(path), "")
    except TrajectoryError as error:
        return Line(row, None, f"its file {path.name} cannot be read ({str(error).removeprefix(f'{path}: ')})")
