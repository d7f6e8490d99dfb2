"""The parts of the paper's campaign as its figures and statements take them: runs by name, or why there is none."""

import json
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from campaigns.figure_data import Array, Source, source
from campaigns.machinery.folder import Row, read_rows, trajectory_path


class LeftOut(Exception):
    """A figure that cannot be drawn; str() is the reason, as the report gives it."""


@dataclass(frozen=True)
class Plan:
    """A figure's data before it is computed: its title, the results behind it, and what computes its arrays."""

    title: str
    sources: tuple[Source, ...]
    arrays: Callable[[], dict[str, Array]]


@dataclass(frozen=True)
class Part:
    """A part's folder with its table and its provenance."""

    folder: Path
    rows: tuple[Row, ...]
    provenance: dict


@dataclass(frozen=True, eq=False)
class Parts:
    """The folder of the campaign, and what was read of it: several figures show the same run."""

    root: Path
    _parts: dict[str, Part] = field(default_factory=dict)
    _runs: dict[Path, tuple] = field(default_factory=dict)

    def part(self, name: str) -> Part:
        """A part by the name of its folder. Raises LeftOut where it is missing or unfinished."""
        if name not in self._parts:
            folder = self.root / name
            try:
                told = json.loads((folder / "provenance.json").read_text(encoding="utf-8"))
                self._parts[name] = Part(folder, read_rows(folder / "table.csv"), told)
            except FileNotFoundError as error:
                raise LeftOut(f"the part `{name}` is not there: {Path(error.filename).name} is missing") from None
            except (OSError, ValueError, KeyError) as error:
                raise LeftOut(f"the part `{name}` cannot be read ({type(error).__name__}: {error})") from None
        return self._parts[name]

    def run(self, part: Part, label: str, **wanted) -> tuple[Row, object, Source]:
        """The one run of a part that is as wanted: its row, its trajectory, its Source. Raises LeftOut."""
        from engine.trajectory import Trajectory, TrajectoryError

        row = next((row for row in part.rows if wanted.items() <= row.items()), None)
        if row is None:
            raise LeftOut(f"the part `{part.folder.name}` holds no run of {label}")
        if row["status"] != "ok":
            raise LeftOut(f"the run of {label} ended early ({row['status']}: {row['message']})")
        path = trajectory_path(part.folder, row["run_key"])
        if path not in self._runs:
            try:
                found = Trajectory.load(path)
            except TrajectoryError as error:
                reason = str(error).removeprefix(f"{path}: ")  # what is written must not depend on the folder's place
                raise LeftOut(f"the file of {label}, {path.name}, is no use ({reason})") from None
            settings, run_s = found.scene.to_toml(), found.statistics["wall_s"]
            self._runs[path] = found, source(label, self.root, path, path.stem, settings, run_s)
        return row, *self._runs[path]

    def of_buoy(self, steepness: float) -> tuple[object, Source]:
        """Trajectory and Source of the buoy's run at a steepness of the paper. Raises LeftOut."""
        return self.run(self.part("buoy"), f"kA = {steepness:g}", steepness=steepness)[1:]
