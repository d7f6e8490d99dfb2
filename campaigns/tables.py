"""A campaign's table as it lies in its folder: rows of words and numbers, told apart by its dictionary."""

import csv
from pathlib import Path
from typing import TYPE_CHECKING

from campaigns.columns import dictionary_path
from campaigns.machinery.folder import trajectory_path

if TYPE_CHECKING:
    from engine import Trajectory

Row = dict[str, object]


def read_rows(path: Path) -> tuple[Row, ...]:
    """The rows of a table: words as they are, numbers as floats, nan where the table is empty.

    Raises OSError where table or dictionary cannot be read, ValueError where they do not fit each other.
    """
    words = {row["name"] for row in _read(dictionary_path(path)) if not row["digits"]}
    rows = [
        {name: text if name in words else float(text or "nan") for name, text in row.items()} for row in _read(path)
    ]
    if not rows:
        raise ValueError(f"{path.name} has no rows")
    return tuple(rows)


def run_of(folder: Path, row: Row) -> "Trajectory | None":
    """The trajectory of a row; None for a run that ended early, or whose file cannot be read."""
    from engine.trajectory import Trajectory, TrajectoryError

    try:
        return Trajectory.load(trajectory_path(folder, row["run_key"])) if row["status"] == "ok" else None
    except TrajectoryError:
        return None


def _read(path: Path) -> list[dict[str, str]]:
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))
