"""The runs of the out-of-plane campaign for its report: rows by the quantities that were varied, and trajectories."""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from tables import BODIES, number

from ..parts import Folder, FolderError, Row, Table, having, read_folder, table_of

VARIED = (
    "steepness", "depth_m", "bending_stiffness_Nm2", "nodes", "dimensions", "seed_mps", "seed_direction", "profiles",
)  # fmt: skip
NEEDED = (
    *VARIED, "periods", "status", "buoy_motion", "rope_motion", "inplane_m", "regime", "max_turn_rad", "loop_releases",
    "run_key", "message",
)  # fmt: skip


class Study(NamedTuple):
    """All runs of the folder. base: the values from which the campaign varied one quantity at a time."""

    folder: Folder
    runs: tuple[Row, ...]
    base: dict
    transient: int

    def select(self, **wanted) -> list[Row]:
        """The runs that ended as asked, with the values `wanted` and otherwise those of the base.

        A quantity whose wanted value is None may have any value, and the runs are sorted by it.
        """
        keys = {**self.base, **wanted}
        fixed, free = {"status": "ok"}, []
        for key, entry in keys.items():
            if entry is None:
                free.append(key)
            else:
                fixed[key] = entry
        return sorted(having(self.runs, **fixed), key=lambda run: [run[key] for key in free])

    def over(self, **wanted) -> list[Row]:
        """As `select`, at every steepness, in rising order."""
        return self.select(**{"steepness": None, **wanted})

    def loaded(self, runs: Sequence[Row]) -> list[tuple]:
        """(run, its trajectory) of the runs whose trajectory can be read."""
        pairs = []
        for run in runs:
            trajectory, _ = self.folder.trajectory(run)
            if trajectory is not None:
                pairs.append((run, trajectory))
        return pairs

    def table(self, names: Sequence[str], runs: Sequence[Row], caption: str) -> Table:
        """A table of the named columns of these runs; the varied numbers have four significant digits."""
        varied_cells = {}
        for name in VARIED:
            if name != "seed_direction":
                varied_cells[name] = lambda row, name=name: number(row[name])
        return table_of(self.folder.columns, names, runs, caption, varied_cells)


def read_study(directory: Path) -> Study:
    """The runs of a folder, and the base that its provenance names. Raises FolderError."""
    folder = read_folder(directory, NEEDED)
    base = folder.provenance.get("base")
    if not isinstance(base, dict) or set(base) != set(VARIED) or "transient" not in folder.provenance:
        raise FolderError(folder.directory, "provenance.json cannot be read: it does not name base and transient")
    return Study(folder, folder.table, dict(base), int(folder.provenance["transient"]))


def columns_of_bodies(*names: str) -> list[str]:
    """The names of these columns of the buoy and then of the rope, for instance "buoy_motion", "rope_motion"."""
    columns = []
    for body in BODIES:
        for name in names:
            columns.append(f"{body}_{name}")
    return columns


def envelope(trajectory, body: str) -> tuple[np.ndarray, np.ndarray]:
    """Largest lateral distance of a body in each of m wave periods: (time in wave periods (m,), distance in m (m,))."""
    from analysis import envelope_of

    period_s = trajectory.scene.waves.period_s
    values = np.abs(trajectory.columns[BODIES[body]])
    time, size = envelope_of(values[np.isfinite(values)], trajectory.scene.sample_step_s(), period_s)
    return time / period_s, size
