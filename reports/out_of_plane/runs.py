"""The runs of the out-of-plane campaign as its report sees them: rows by what was varied, trajectories on demand."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..parts.columns import Name, table_of
from ..parts.content import Table
from ..parts.folder import Folder, Row
from ..parts.wording import number

VARIED = (
    "steepness", "depth_m", "bending_stiffness_Nm2", "nodes", "dimensions", "seed_mps", "seed_direction", "profiles",
)  # fmt: skip
NEEDED = (
    *VARIED, "periods", "status", "buoy_motion", "rope_motion", "inplane_m", "regime", "max_turn_rad", "loop_releases",
    "run_key", "message",
)  # fmt: skip
BODIES = ("buoy", "rope")
DISPLACEMENT = {"buoy": "y_m", "rope": "offplane_m"}  # column of a trajectory


class Run(Row):
    """One row of the table."""

    @property
    def pushed(self) -> bool:
        """Whether it is a run in three dimensions that ended as asked, with a push out of the plane."""
        return self.ok and self["dimensions"] == 3 and self["seed_direction"] != "along"

    def grows(self) -> bool:
        """Whether buoy or rope leave the plane exponentially."""
        return any(self[f"{body}_motion"] == "growth" for body in BODIES)


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
        """Runs that differ in the size of the push alone, on the grid that has most of them, as far as they ended."""
        runs = self.select(steepness=steepness, seed_mps=None, nodes=None)
        grids = [run["nodes"] for run in runs]
        return [run for run in runs if run.ok and run["nodes"] == max(grids, key=grids.count)]

    def one(self, **wanted) -> Run | None:
        """The one run that is as the base but for `wanted`, None where there is none that ended as asked."""
        return next((run for run in self.select(**wanted) if run.ok), None)

    @property
    def steepnesses(self) -> list[float]:
        """The small and the large wave, as far as there are rows of them."""
        return sorted({run["steepness"] for run in self.runs})

    def trajectory(self, run: Run):
        """The trajectory of a run, None where it is missing or cannot be read."""
        return self.folder.trajectory(run.row)[0]

    def table(self, names: Sequence[Name], runs: Sequence[Run], caption: str) -> Table:
        """A table of runs in the words of the dictionary."""
        own = {name: (lambda row, name=name: number(row[name])) for name in VARIED if name != "seed_direction"}
        return table_of(self.folder.columns, names, [run.row for run in runs], caption, own)


def read_study(folder: Folder) -> Study:
    """The rows of the folder's table, and the base that its provenance names."""
    rows = folder.table.to_dict("records")
    return Study(folder, tuple(map(Run, rows)), dict(folder.provenance["base"]), int(folder.provenance["transient"]))


def envelope(trajectory, body: str, span: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """Largest lateral distance in each `span` wave periods: (t/T_i (m,), m (m,))."""
    from analysis import envelope_of

    period_s = trajectory.scene.waves.period_s
    values = np.abs(trajectory.columns[DISPLACEMENT[body]])
    time, size = envelope_of(values[np.isfinite(values)], trajectory.scene.sample_step_s(), span * period_s)
    return time / period_s, size
