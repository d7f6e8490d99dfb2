"""A campaign's folder as the report needs it, checked before anything is drawn or written."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from .columns import Quantity, read_columns
from .faults import FolderError

if TYPE_CHECKING:
    import pandas

    from engine import Scene, Trajectory

PARTS = {
    "table.csv": "one row a run",
    "scene.toml": "the scene as run",
    "provenance.json": "what ran, where and for how long",
    "trajectories": "the runs, one netCDF file each",
}
__all__ = ["Folder", "FolderError", "Row", "no_folder", "provenance_of", "read_folder", "read_rows"]


@dataclass(frozen=True)
class Folder:
    """What a finished campaign left behind, read and checked: the trajectories stay on disk until asked for.

    columns: what the columns of the table are, by name.
    """

    directory: Path
    provenance: dict
    table: pandas.DataFrame
    scene: Scene
    columns: dict[str, Quantity]

    def trajectory_path(self, run_key: str) -> Path:
        return self.directory / "trajectories" / f"{run_key}.nc"

    def trajectory(self, row: Mapping[str, object]) -> tuple[Trajectory | None, str]:
        """(trajectory, "") of a row of the table, or None and why: "" for a run that failed and left nothing."""
        from engine.trajectory import Trajectory, TrajectoryError

        path = self.trajectory_path(row["run_key"])
        if not path.exists():
            return None, f"its file {path.name} is missing" if row["status"] == "ok" else ""
        try:
            return Trajectory.load(path), ""
        except TrajectoryError as error:
            reason = str(error).removeprefix(f"{path}: ")  # the report must not depend on where its folder lies
            return None, f"its file {path.name} cannot be read ({reason})"


def read_folder(directory: str | Path, needed: tuple[str, ...] = ()) -> Folder:
    """Read and check a campaign's folder: its table has the columns of its dictionary, and text where that says so.

    needed: the columns without which there is no report.
    Raises FolderError naming every part that is missing or cannot be read.
    """
    directory = Path(directory)
    if not directory.is_dir():
        raise FolderError(directory, [no_folder(directory)])
    faults = [f"{name} is missing ({meaning})" for name, meaning in PARTS.items() if not (directory / name).exists()]
    try:
        told = read_columns(directory)
    except FolderError as error:
        faults += error.faults
        told = {}
    provenance = _read(directory / "provenance.json", _provenance, faults)
    table = _read(directory / "table.csv", lambda path: _table(path, needed, told), faults)
    scene = _read(directory / "scene.toml", _scene, faults)
    if table is not None and told and (unknown := [name for name in table.columns if name not in told]):
        faults.append(f"columns.csv does not tell of all columns of table.csv: {', '.join(unknown)}")
    if faults:
        raise FolderError(directory, faults)
    return Folder(directory, provenance, table, scene, told)


def read_rows(table: Path) -> list[dict[str, str]]:
    """The rows of a table that a campaign may have left out, as they stand; none where it cannot be read."""
    try:
        with open(table, encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))
    except (OSError, ValueError):
        return []


def no_folder(directory: Path) -> str:
    """Why a path that is no folder is none, and what is wanted instead."""
    there = "it is a file" if directory.exists() else "there is no such folder"
    return f"{there}; give the folder that a campaign wrote (its --out), for instance results/buoy_sweep"


def provenance_of(directory: str | Path) -> dict:
    """What is told of the making of a folder, {} where nothing can be read."""
    try:
        return _provenance(Path(directory) / "provenance.json")
    except (OSError, ValueError):
        return {}


def _read(path: Path, reader, faults: list[str]):
    if not path.exists():
        return None
    try:
        return reader(path)
    except (OSError, ValueError, KeyError) as error:
        faults.append(f"{path.name} cannot be read: {error}")
        return None


def _provenance(path: Path) -> dict:
    content = json.loads(path.read_text(encoding="utf-8"))
    if not isinstance(content, dict):
        raise ValueError("not a JSON object")
    return content


def _table(path: Path, needed: tuple[str, ...], told: dict[str, Quantity]) -> pandas.DataFrame:
    import pandas

    text = [name for name, column in told.items() if column.digits is None]
    table = pandas.read_csv(path, dtype=dict.fromkeys(text, str), keep_default_na=True)
    absent = [column for column in needed if column not in table.columns]
    if absent:
        raise ValueError(f"column{'s' if len(absent) > 1 else ''} missing: {', '.join(absent)}")
    if table.empty:
        raise ValueError("it has no rows")
    known = [name for name in table.columns if name in told]
    return table.assign(
        **{name: table[name].fillna("") if name in text else pandas.to_numeric(table[name]) for name in known}
    )


def _scene(path: Path):
    from engine import load_scene

    return load_scene(path)


@dataclass(frozen=True, eq=False)
class Row:
    """One row of a campaign's table."""

    row: Mapping[str, object]

    def __getitem__(self, column: str):
        """An entry: text, or a number that is nan where the table leaves it empty or has no such column."""
        return self.row.get(column, math.nan)

    @property
    def ok(self) -> bool:
        """Whether the run reached its full length."""
        return self["status"] == "ok"

    def known(self, column: str) -> bool:
        """Whether the row has a number in that column."""
        return math.isfinite(self[column])
