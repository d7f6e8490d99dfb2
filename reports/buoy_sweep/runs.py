"""The runs of a buoy sweep as the report looks at them: table row, strobed motion, height of the buoy."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ..parts.content import link
from ..parts.folder import Folder
from ..parts.wording import number
from .physics import water_surface_m

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
LEAST_POINTS = 16  # strobed points below which it does not look


@dataclass(frozen=True)
class Emergence:
    """How far the buoy leaves the water, over the whole record.

    `above_still_m` highest centre above the still-water line, `above_wave_m` above the linear wave at its place;
    `out_share` share of the samples with the whole sphere above that wave.
    """

    above_still_m: float
    above_wave_m: float
    out_share: float


@dataclass(frozen=True, eq=False)
class Run:
    """One row of the table with what its trajectory adds.

    `section` (m, 2) strobed r (m) and r' (m/s) after the transient, empty where the run is shorter; `fault` why the
    trajectory of a run that should have one could not be read, else ""; `anchor` the place of its sheet in the report.
    """

    row: dict
    periods_done: float
    section: np.ndarray
    emergence: Emergence | None
    fault: str
    anchor: str = ""

    @property
    def steepness(self) -> float:
        return float(self.row["steepness"])

    @property
    def ok(self) -> bool:
        return self.row["status"] == "ok"

    @property
    def in_space(self) -> bool:
        """Whether the run was made in three dimensions; a table without the column is of planar runs."""
        return self.row.get("dimensions") == 3

    @property
    def has_record(self) -> bool:
        """Whether there is enough of a record to draw: one wave period at least."""
        return not self.fault and self.periods_done >= 1.0


def read_runs(folder: Folder) -> tuple[Run, ...]:
    """Every run of the table, by steepness; a trajectory that cannot be read leaves a run with a `fault`."""
    transient = int(folder.provenance.get("transient") or 0)
    table = folder.table.sort_values("steepness", kind="stable")
    rows = enumerate(table.to_dict("records"), 1)
    return tuple(replace(_read_run(folder, row, transient), anchor=f"run-{place}") for place, row in rows)


def load(folder: Folder, run: Run):
    """The trajectory of a run (`engine.Trajectory`)."""
    from engine import Trajectory

    return Trajectory.load(folder.trajectory_path(run.row["run_key"]))


def _read_run(folder: Folder, row: dict, transient: int) -> Run:
    from engine.trajectory import Trajectory, TrajectoryError

    nothing = np.empty((0, 2))
    path = folder.trajectory_path(row["run_key"])
    if not path.exists():
        # A run that died may well have left nothing; its status says so already.
        return Run(row, 0.0, nothing, None, f"its file {path.name} is missing" if row["status"] == "ok" else "")
    try:
        trajectory = Trajectory.load(path)
    except TrajectoryError as error:
        reason = str(error).removeprefix(f"{path}: ")  # the report must not depend on where its folder lies
        return Run(row, 0.0, nothing, None, f"its file {path.name} cannot be read ({reason})")
    columns = trajectory.columns
    if len(columns["time_s"]) < 2:
        return Run(row, 0.0, nothing, None, "")
    period_s = trajectory.scene.waves.period_s
    done = float(columns["time_s"][-1]) / period_s
    return Run(row, done, strobed(trajectory, transient), _emergence(trajectory), "")


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


def chosen_runs(runs: tuple[Run, ...], tolerance: float) -> tuple[Run, ...]:
    """The runs drawn in full: nearest the paper's two steepnesses, then the first whose points are several."""
    drawable = [run for run in runs if run.has_record]
    good = [run for run in drawable if run.ok] or drawable
    chosen: list[Run] = []
    for steepness in PAPER_STEEPNESS:
        if good:
            nearest = min(good, key=lambda run: abs(run.steepness - steepness))
            chosen += [nearest] if nearest not in chosen else []
    longer = next((run for run in good if several_points(run, tolerance) and run not in chosen), None)
    return tuple(sorted([*chosen, *([longer] if longer else [])], key=lambda run: run.steepness))


def period_length(run: Run) -> int | None:
    """After how many wave periods the run repeats: `strobed_period` of the table; 0 where no number fits.

    None where nobody could say: a run that failed, too few strobed points, or a table without the column.
    """
    if not run.ok or len(run.section) < LEAST_POINTS or "strobed_period" not in run.row:
        return None
    found = value(run, "strobed_period")
    return 0 if math.isnan(found) else int(found)


def orbit_radii(run: Run) -> list[float]:
    """Strobed r (m) of the points that a run of known period visits in turn: their means over the last half."""
    length = period_length(run)
    rounds = max(len(run.section) // (2 * length), 1)
    return list(run.section[-rounds * length :, 0].reshape(-1, length).mean(axis=0))


def several_points(run: Run, tolerance: float) -> bool:
    """Whether a run of period 2 or longer visits points that differ in r by more than the tolerance of its range.

    A pendulum swing that dies out slowly comes back to nearly the same place every six wave periods (omega_theta T_i
    is close to 1 rad): the table then says period 6 of what is about to settle on one point.
    """
    if (period_length(run) or 0) < 2:
        return False
    width = value(run, "radius_max_m") - value(run, "radius_min_m")
    return bool(np.ptp(orbit_radii(run)) > tolerance * width)


def linked(run: Run) -> str:
    """The run's steepness, as a link to its sheet."""
    return link(number(run.steepness), run.anchor)


def value(run: Run, column: str) -> float:
    """A number of the run's row, nan where the table leaves it empty."""
    found = run.row[column]
    return math.nan if found is None or found == "" else float(found)


def lateral(run: Run, body: str) -> float:
    """Largest lateral distance of the "buoy" or the "rope" after the transient in m, nan for a planar run."""
    return float(run.row[f"{body}_lateral_max_m"]) if run.in_space else math.nan


def planar_releases(run: Run) -> float:
    """Loop releases of the planar run of the same scene: its own, or those of the run it replaces; nan if unknown."""
    return value(run, "loop_releases") if not run.in_space else float(run.row.get("planar_loop_releases", math.nan))
