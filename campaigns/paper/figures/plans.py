"""The parts of the paper's campaign as its figures take them: runs by name, or why there is none."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from reports.parts.figure_data import Array, Source, source
from reports.parts.folder import Folder, FolderError, read_folder


class LeftOut(Exception):
    """A figure that cannot be drawn; str() is the reason, as the report gives it."""


@dataclass(frozen=True)
class Plan:
    """A figure's data before it is computed: its title, the results behind it, and what computes its arrays."""

    title: str
    sources: tuple[Source, ...]
    arrays: Callable[[], dict[str, Array]]


@dataclass(frozen=True, eq=False)
class Parts:
    """The folder of the campaign, and what was read of it: several figures show the same run."""

    root: Path
    _folders: dict[str, Folder] = field(default_factory=dict)
    _runs: dict[Path, tuple] = field(default_factory=dict)

    def folder(self, name: str, columns: tuple[str, ...], words: tuple[str, ...] = ()) -> Folder:
        """A part by the name of its folder. Raises LeftOut where it is missing or unfinished."""
        if name not in self._folders:
            try:
                self._folders[name] = read_folder(self.root / name, columns, words)
            except FolderError as error:
                raise LeftOut(f"the part `{name}` is not there: {'; '.join(error.faults)}") from None
        return self._folders[name]

    def run(self, folder: Folder, label: str, **wanted):
        """The one run of a part that is as wanted: (its row, its trajectory, its Source). Raises LeftOut."""
        table = folder.table
        for column, entry in wanted.items():
            table = table[table[column] == entry]
        if table.empty:
            raise LeftOut(f"the part `{folder.directory.name}` holds no run of {label}")
        row = table.iloc[0].to_dict()
        if row["status"] != "ok":
            raise LeftOut(f"the run of {label} ended early ({row['status']}: {row['message']})")
        path = folder.trajectory_path(row["run_key"])
        if path not in self._runs:
            self._runs[path] = self._load(path, label)
        return row, *self._runs[path]

    def _load(self, path: Path, label: str) -> tuple:
        from engine.trajectory import Trajectory, TrajectoryError

        try:
            trajectory = Trajectory.load(path)
        except TrajectoryError as error:
            reason = str(error).removeprefix(f"{path}: ")  # what is written must not depend on where the folder lies
            raise LeftOut(f"the file of {label}, {path.name}, is no use ({reason})") from None
        run_s = trajectory.statistics["wall_s"]
        return trajectory, source(label, self.root, path, path.stem, trajectory.scene.to_toml(), run_s)
