"""A campaign's folder as a report needs it, checked before anything is drawn or written: one reader for every file."""

from __future__ import annotations

import io
import json
import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from tables import Column, by_columns, read_columns, read_rows

from .columns import Row, shown_on, table_of
from .content import Table
from .selecting import having

if TYPE_CHECKING:
    import xarray

    from engine import Scene, Trajectory

PARTS = {
    "table.csv": "one row a run",
    "columns.csv": "what its columns are",
    "scene.toml": "the scene as run",
    "provenance.json": "what ran, where and for how long",
    "trajectories": "the runs, one netCDF file each",
}
_OLD = "made by an older version: run the command again, finished runs are found"


class FolderError(ValueError):
    """The folder cannot be reported on; `faults` lists every reason, str() shows them all."""

    def __init__(self, directory: Path, *faults: str):
        self.faults = faults
        lines = [f"no report can be made of {directory}:"]
        for fault in faults:
            lines.append(f"  - {fault}")
        super().__init__("\n".join(lines))


class Folder(NamedTuple):
    """What a finished campaign left behind, read and checked: the trajectories stay on disk until asked for.

    table: its rows, numbers where the dictionary has digits, nan where there is none. columns: what the columns of the
    table are, by name.
    """

    directory: Path
    provenance: dict
    table: tuple[Row, ...]
    scene: Scene
    columns: dict[str, Column]

    @property
    def completed(self) -> list[Row]:
        """The rows of the runs that reached their full length."""
        return having(self.table, status="ok")

    def part(self, name: str) -> Folder:
        """The folder of that name inside of this one; without rows where it was left out or cannot be read."""
        directory = self.directory / name
        try:
            columns = read_columns(directory / "columns.csv")
            table = by_columns(read_rows(directory / "table.csv"), columns)
        except (OSError, ValueError):
            columns, table = {}, ()
        return self._replace(directory=directory, table=table, columns=columns)

    def trajectory_path(self, run_key: str) -> Path:
        return self.directory / "trajectories" / f"{run_key}.nc"

    def trajectory(self, row: Row) -> tuple[Trajectory | None, str]:
        """(trajectory, "") of a row of the table, or None and why: "" for a run that failed and left nothing."""
        from engine.trajectory import Trajectory, TrajectoryError

        path = self.trajectory_path(row["run_key"])
        if not path.exists() and row["status"] != "ok":
            return None, ""
        if not path.exists():
            return None, f"its file {path.name} is missing"
        try:
            return Trajectory.load(path, {"run_key": row["run_key"]}), ""
        except TrajectoryError as error:
            reason = str(error).removeprefix(f"{path}: ")  # the report must not depend on where its folder lies
            return None, f"its file {path.name} cannot be read ({reason})"


@dataclass(frozen=True, eq=False)
class TableRow:
    """One row of a campaign's table."""

    row: Row

    def __getitem__(self, column: str):
        """An entry: text, or a number that is nan where the table leaves it empty or has no such column."""
        return self.row.get(column, math.nan)

    def get(self, column: str):
        """An entry; None where the table has no such column."""
        return self.row.get(column)

    @property
    def ok(self) -> bool:
        """Whether the run reached its full length."""
        return self["status"] == "ok"

    def known(self, column: str) -> bool:
        """Whether the row has a number in that column."""
        return math.isfinite(self[column])


def read_folder(directory: Path, needed: tuple[str, ...] = ()) -> Folder:
    """Read and check a campaign's folder: its table has the columns of its dictionary, and text where that says so.

    needed: the columns without which there is no report.
    Raises FolderError naming every part that is missing or cannot be read.
    """
    parts, faults = _readable(directory, PARTS, _READERS)
    columns, table = parts.get("columns.csv"), None
    if columns is not None and "table.csv" in parts:
        try:
            rows = parts["table.csv"]
            absent = []
            if rows:
                absent = [column for column in needed if column not in rows[0]]
            if absent:
                plural = "s" if len(absent) > 1 else ""
                raise ValueError(f"column{plural} missing: {', '.join(absent)}")
            table = by_columns(rows, columns)
        except ValueError as error:
            faults.append(f"table.csv cannot be read: {error}")
    if faults:
        raise FolderError(directory, *faults)
    return Folder(directory, parts["provenance.json"], table, parts["scene.toml"], columns)


def filled_table(
    part: Folder, caption: str, names: Iterable[str] = (), own_cells: Mapping[str, Callable] | None = None
) -> list[Table]:
    """The table of a part of a folder, with those of the named columns (all, but for the key of a run) that say
    something in some row; nothing without a row."""
    if not part.table:
        return []
    filled = []
    for name in names or shown_on(part.columns, part.table):
        entries = [row.get(name, "") for row in part.table]
        if name != "run_key" and any(entry not in ("", 0.0) and entry == entry for entry in entries):  # nan is not
            filled.append(name)
    return [table_of(part.columns, filled, part.table, caption, own_cells)]


def read_files(
    directory: Path, wanted: Mapping[str, str], own_readers: Mapping[str, Callable[[Path], object]] | None = None
) -> dict[str, object]:
    """{name: content}: rows {column: text} of a .csv file, the object of a .json file, the scene of a .toml file, the
    `Column` of every column of a dictionary of columns by name, the arrays of a .nc file, text of a .txt file, the
    paths in a folder.

    wanted: name of a file or folder -> what it holds. own_readers: ending of a name -> reader in place of the usual.
    Raises FolderError naming all that is missing or cannot be read.
    """
    contents, faults = _readable(directory, wanted, _READERS | (own_readers or {}))
    if faults:
        raise FolderError(directory, *faults)
    return contents


def provenance_of(directory: Path) -> dict:
    """The provenance.json of a folder, {} where it cannot be read."""
    try:
        return _json(directory / "provenance.json")
    except (OSError, ValueError, RecursionError):
        return {}


def _readable(directory: Path, wanted: Mapping[str, str], readers: Mapping) -> tuple[dict[str, object], list[str]]:
    """The contents of the wanted files that can be read, by name, and the faults of the others."""
    if not directory.is_dir():
        problem = "it is a file" if directory.exists() else "there is no such folder"
        return {}, [f"{problem}; give the folder that a campaign wrote (its --out), for instance results/buoy_sweep"]
    contents, faults = {}, []
    for name, meaning in wanted.items():
        path = directory / name
        reader = next(read for ending, read in readers.items() if name.endswith(ending))
        if not path.exists():
            hint = f"; {_OLD}" if reader is read_columns else ""
            faults.append(f"{name} is missing ({meaning}{hint})")
            continue
        try:
            contents[name] = reader(path)
        except (OSError, ValueError, KeyError, RecursionError) as error:
            faults.append(f"{name} cannot be read: {error}")
    return contents, faults


def _json(path: Path) -> dict:
    content = json.loads(path.read_text(encoding="utf-8"))
    if not isinstance(content, dict):
        raise ValueError("not a JSON object")
    return content


def _scene(path: Path) -> Scene:
    from engine import load_scene

    return load_scene(path)


def read_arrays(content: bytes) -> xarray.Dataset:
    """The labelled arrays of a netCDF-3 file from its bytes. Raises ValueError for damaged ones."""
    import xarray

    try:
        return xarray.load_dataset(io.BytesIO(content), engine="scipy")
    except Exception as error:  # a damaged header can make the reader fail in any way at all
        raise ValueError(f"truncated, damaged, or no netCDF-3 file ({type(error).__name__})") from None


_READERS = {
    "columns.csv": read_columns,
    ".csv": read_rows,
    ".json": _json,
    ".toml": _scene,
    ".nc": lambda path: read_arrays(path.read_bytes()),
    ".txt": lambda path: path.read_text(encoding="utf-8"),
    "": lambda path: [*path.iterdir()],
}
