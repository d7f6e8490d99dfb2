"""The runs of the out-of-plane campaign as its report sees them: rows by what was varied, trajectories on demand."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..parts.folder import Folder

VARIED = (
    "steepness",
    "depth_m",
    "bending_stiffness_Nm2",
    "nodes",
    "dimensions",
    "seed_mps",
    "seed_direction",
    "profiles",
)
WORDS = ("seed_direction", "buoy_motion", "buoy_reason", "rope_motion", "rope_reason")
_OF_A_BODY = (
    "motion",
    "rate_bits_per_period",
    "rate_error",
    "rate_nats_per_period",
    "fit_from_period",
    "fit_to_period",
    "fit_span_nats",
    "bursts",
    "burst_median_m",
    "burst_max_m",
    "first_burst_period",
    "first_burst_m",
    "lateral_max_m",
    "lateral_late_m",
    "share_of_inplane",
    "early_gain_s",
    "reason",
)
COLUMNS = (
    *VARIED,
    "periods",
    "status",
    *(f"{body}_{name}" for body in ("buoy", "rope") for name in _OF_A_BODY),
    "inplane_m",
    "bow_inplane_m",
    "bow_lateral_m",
    "radius_min_m",
    "radius_max_m",
    "tension_top_max_N",
    "slack_fraction",
    "regime",
    "lyapunov_wolf_bits_per_period",
    "lyapunov_wolf_error",
    "lyapunov_tangent_bits_per_period",
    "lyapunov_tangent_error",
    "offplane_growth_bits_per_period",
    "offplane_growth_error",
    "max_turn_rad",
    "loop_releases",
    "newton_iterations",
    "end_time_s",
    "wall_s",
    "run_key",
    "message",
)
BODIES = ("buoy", "rope")
DISPLACEMENT = {"buoy": "y_m", "rope": "offplane_m"}  # column of a trajectory


@dataclass(frozen=True, eq=False)
class Run:
    """One row of the table."""

    row: dict

    def __getitem__(self, column: str):
        """An entry of the row: text, or a number that is NaN where the table leaves it empty."""
        return self.row[column]

    @property
    def ok(self) -> bool:
        return self.row["status"] == "ok"

    def known(self, column: str) -> bool:
        """Whether the row has a number in that column."""
        return math.isfinite(self.row[column])


@dataclass(frozen=True, eq=False)
class Study:
    """All rows, the values from which one thing at a time was varied, and the folder."""

    folder: Folder
    runs: tuple[Run, ...]
    base: dict
    transient: int

    def select(self, **wanted) -> list[Run]:
        """Runs that are as the base but for `wanted`; None for a key that may have any value, in rising order of it."""
        keys = {**self.base, **wanted}
        free = [key for key, entry in keys.items() if entry is None]
        found = [run for run in self.runs if all(entry is None or run[key] == entry for key, entry in keys.items())]
        return sorted(found, key=lambda run: tuple(run[key] for key in free))

    def planar(self, **wanted) -> list[Run]:
        """Planar runs that are as the base but for `wanted`, as `select`."""
        return self.select(dimensions=2, seed_mps=0.0, seed_direction="", **wanted)

    def pushes(self, steepness: float) -> list[Run]:
        """Runs that differ in the size of the push alone, on the grid that has most of them."""
        runs = self.select(steepness=steepness, seed_mps=None, nodes=None)
        grids = [run["nodes"] for run in runs]
        return [run for run in runs if run["nodes"] == max(grids, key=grids.count)]

    def one(self, **wanted) -> Run | None:
        """The one run that is as the base but for `wanted`, None where there is none that ended as asked."""
        return next((run for run in self.select(**wanted) if run.ok), None)

    @property
    def steepnesses(self) -> list[float]:
        """The small and the large wave, as far as there are rows of them."""
        return sorted({run["steepness"] for run in self.runs})

    def trajectory(self, run: Run):
        """The trajectory of a run, None where it is missing or cannot be read."""
        from engine.trajectory import Trajectory, TrajectoryError

        try:
            return Trajectory.load(self.folder.trajectory_path(run["run_key"]))
        except TrajectoryError:
            return None


def read_study(folder: Folder) -> Study:
    """The rows of the folder's table, and the base that its provenance names."""
    base = dict(folder.provenance["base"])
    assert set(base) == set(VARIED)
    runs = tuple(Run(row) for row in folder.table.to_dict("records"))
    return Study(folder, runs, base, int(folder.provenance["transient"]))


def envelope(trajectory, body: str, span: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """Largest lateral distance in each `span` wave periods: (t/T_i (m,), m (m,))."""
    from analysis import envelope_of

    period_s = trajectory.scene.waves.period_s
    values = np.abs(trajectory.columns[DISPLACEMENT[body]])
    time, size = envelope_of(values[np.isfinite(values)], trajectory.scene.sample_step_s(), span * period_s)
    return time / period_s, size
