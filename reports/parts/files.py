"""The files of a campaign's folder that are read whole: tables as rows of text, JSON as it is."""

from __future__ import annotations

import csv
import json
from pathlib import Path

from .folder import FolderError, no_folder


def read_files(directory: str | Path, wanted: dict[str, str]) -> dict[str, object]:
    """{name: content}: rows {column: text} of a .csv file, the value of a .json file, None for a folder.

    wanted: name of a file or folder -> what it holds. Raises FolderError naming all that is missing or cannot be read.
    """
    directory = Path(directory)
    if not directory.is_dir():
        raise FolderError(directory, [no_folder(directory)])
    faults = [f"{name} is missing ({meaning})" for name, meaning in wanted.items() if not (directory / name).exists()]
    found: dict[str, object] = {}
    for name in wanted if not faults else ():
        try:
            found[name] = _content(directory / name)
        except (OSError, ValueError) as error:
            faults.append(f"{name} cannot be read: {error}")
    if faults:
        raise FolderError(directory, faults)
    return found


def _content(path: Path) -> object:
    if path.suffix == ".json":
        return json.loads(path.read_text(encoding="utf-8"))
    if path.suffix == ".csv":
        rows = list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))
        if any(None in row for row in rows):
            raise ValueError("a row has more entries than the first line")
        return rows
    return None


def value(row: dict[str, str], column: str) -> float:
    """A cell as a number; NaN where it is empty."""
    text = row.get(column, "")
    return float(text) if text else float("nan")
