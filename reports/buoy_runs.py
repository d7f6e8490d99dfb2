"""The runs of a buoy sweep as the report looks at them: table row, strobed motion, height of the buoy."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .buoy_physics import water_surface_m
from .folder import Folder

COLUMNS = (
    "steepness",
    "status",
    "regime",
    "radius_min_m",
    "radius_max_m",
    "angle_min_rad",
    "angle_max_rad",
    "tension_top_min_N",
    "tension_top_max_N",
    "slack_fraction",
    "max_turn_rad",
    "loop_releases",
    "steps",
    "rejected_steps",
    "newton_iterations",
    "wall_s",
    "run_key",
    "message",
)
PAPER_STEEPNESS = (0.016, 0.13)
LONGEST_PERIOD = 8
LEAST_POINTS = 16  # below this `analysis.detect_period` does not look
# Of the range of the motion within a wave period. Wide enough for the millimetres that adaptive steps leave in a
# settled orbit, and far below the branches of the period-2 motion at kA = 0.13, H = 22.5 m (145 mm of a range of 4 m).
TOLERANCE = 5e-3


@dataclass(frozen=True)
class Emergence:
    """How far the buoy leaves the water, over the whole record.

    `above_still_m` highest centre above the still-water line, `above_wave_m` above the linear wave at its place;
    `out_share` share of the samples with the whole sphere above that wave.
    """

    above_still_m: float
    above_wave_m: float
    out_share: float


@dataclass(frozen=True)
class Run:
    """One row of the table with what its trajectory adds.

    `section` (m, 2) strobed r (m) and r' (m/s) after the transient, empty where the run is shorter; `period` what
    `analysis.detect_period` says of it, None where it cannot; `fault` why the trajectory could not be read, else "".
    """

    row: dict
    periods_done: float
    section: np.ndarray
    period: object | None
    emergence: Emergence | None
    fault: str

    @property
    def steepness(self) -> float:
        return float(self.row["steepness"])

    @property
    def ok(self) -> bool:
        return self.row["status"] == "ok"

    @property
    def has_record(self) -> bool:
        """Whether there is enough of a record to draw: one wave period at least."""
        return not self.fault and self.periods_done >= 1.0


def read_runs(folder: Folder) -> tuple[Run, ...]:
    """Every run of the table, by steepness; a trajectory that cannot be read leaves a run with a `fault`."""
    transient = int(folder.provenance.get("transient") or 0)
    table = folder.table.sort_values("steepness", kind="stable")
    return tuple(_read_run(folder, row, transient) for row in table.to_dict("records"))


def load(folder: Folder, run: Run):
    """The trajectory of a run (`engine.Trajectory`)."""
    from engine import Trajectory

    return Trajectory.load(folder.trajectory_path(run.row["run_key"]))


def _read_run(folder: Folder, row: dict, transient: int) -> Run:
    from engine.trajectory import Trajectory, TrajectoryError

    nothing = np.empty((0, 2))
    path = folder.trajectory_path(row["run_key"])
    if not row["run_key"] or not path.exists():
        return Run(
            row, 0.0, nothing, None, None, f"its file {path.name} is missing" if row["run_key"] else "it left no file"
        )
    try:
        trajectory = Trajectory.load(path)
    except TrajectoryError as error:
        reason = str(error).removeprefix(
            f"{path}: "
        )  # the folder's own path would make the report depend on where it lies
        return Run(row, 0.0, nothing, None, None, f"its file {path.name} cannot be read ({reason})")
    columns = trajectory.columns
    if len(columns["time_s"]) < 2:
        return Run(row, 0.0, nothing, None, None, "")
    period_s = trajectory.scene.waves.period_s
    done = float(columns["time_s"][-1]) / period_s
    section = strobed(trajectory, transient)
    period = _period(section, trajectory, transient) if row["status"] == "ok" else None
    return Run(row, done, section, period, _emergence(trajectory), "")


def strobed(trajectory, transient: int) -> np.ndarray:
    """r (m) and r' (m/s) at t = k T_i, k >= transient, as (m, 2); empty for a record that ends before."""
    from analysis import poincare_section

    columns, scene = trajectory.columns, trajectory.scene
    finite = np.isfinite(columns["radius_m"]) & np.isfinite(columns["radius_rate_mps"])
    end = len(finite) if finite.all() else int(np.argmin(finite))
    series = {name: columns[name][:end] for name in ("radius_m", "radius_rate_mps")}
    if (end - 1) * scene.sample_step_s() < transient * scene.waves.period_s:
        return np.empty((0, 2))
    return poincare_section(series, scene.sample_step_s(), scene.waves.period_s, transient_periods=transient).points


def _period(section: np.ndarray, trajectory, transient: int):
    """The period of the strobed motion, None where there are too few points to look for one.

    Differences are measured by the range of r and r' within the motion itself, after the transient.
    """
    from analysis import detect_period

    first = round(transient * trajectory.scene.waves.period_s / trajectory.scene.sample_step_s())
    scale = [float(np.ptp(trajectory.columns[name][first:])) for name in ("radius_m", "radius_rate_mps")]
    if len(section) < LEAST_POINTS or min(scale) <= 0.0:
        return None
    return detect_period(section, max_period=LONGEST_PERIOD, tolerance=TOLERANCE, scale=scale)


def _emergence(trajectory) -> Emergence | None:
    scene, columns = trajectory.scene, trajectory.columns
    if scene.water is None or scene.waves is None or scene.buoy is None:
        return None
    height = columns["z_m"] - water_surface_m(scene, columns["x_m"], columns["time_s"])
    return Emergence(
        float(np.nanmax(columns["z_m"]) - scene.water.depth_m),
        float(np.nanmax(height)),
        float(np.mean(height > 0.5 * scene.buoy.diameter_m)),
    )


def chosen_runs(runs: tuple[Run, ...]) -> tuple[Run, ...]:
    """The runs drawn in full: nearest the paper's two steepnesses, then the first good one of period 2 or longer."""
    drawable = [run for run in runs if run.has_record]
    good = [run for run in drawable if run.ok] or drawable
    chosen: list[Run] = []
    for steepness in PAPER_STEEPNESS:
        if good:
            nearest = min(good, key=lambda run: abs(run.steepness - steepness))
            chosen += [nearest] if nearest not in chosen else []
    longer = next((run for run in good if run.ok and period_length(run) > 1 and run not in chosen), None)
    return tuple(sorted([*chosen, *([longer] if longer else [])], key=lambda run: run.steepness))


def period_length(run: Run) -> int:
    """N of a strobed orbit that repeats after N points, 0 where none was found or looked for."""
    return int(run.period.period or 0) if run.period is not None else 0


def value(run: Run, column: str) -> float:
    """A number of the run's row, nan where the table leaves it empty."""
    number = run.row[column]
    return math.nan if number is None or number == "" else float(number)
