"""A campaign's folder as the report needs it, checked before anything is drawn or written."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pandas

    from engine import Scene

PARTS = {
    "table.csv": "one row a run",
    "scene.toml": "the scene as run",
    "provenance.json": "what ran, where and for how long",
    "trajectories": "the runs, one netCDF file each",
}
WORDS = ("status", "regime", "regime_tighter", "run_key", "message")  # columns of text in every table


class FolderError(ValueError):
    """The folder cannot be reported on; `faults` lists every reason, str() shows them all."""

    def __init__(self, directory: Path, faults: list[str]):
        self.faults = tuple(faults)
        super().__init__("\n".join([f"no report can be made of {directory}:", *(f"  - {fault}" for fault in faults)]))


@dataclass(frozen=True)
class Folder:
    """What a finished campaign left behind, read and checked: the trajectories stay on disk until asked for."""

    directory: Path
    provenance: dict
    table: pandas.DataFrame
    scene: Scene

    def trajectory_path(self, run_key: str) -> Path:
        return self.directory / "trajectories" / f"{run_key}.nc"


def read_folder(directory: str | Path, columns: tuple[str, ...], words: tuple[str, ...] = ()) -> Folder:
    """Read and check a campaign's folder.

    Args: `columns` the columns its table must have; `words` those of them that hold text, besides WORDS.
    Raises FolderError naming every part that is missing or cannot be read.
    """
    directory = Path(directory)
    if not directory.is_dir():
        raise FolderError(directory, [no_folder(directory)])
    faults = [f"{name} is missing ({meaning})" for name, meaning in PARTS.items() if not (directory / name).exists()]
    provenance = _read(directory / "provenance.json", _provenance, faults)
    table = _read(directory / "table.csv", lambda path: _table(path, columns, (*WORDS, *words)), faults)
    scene = _read(directory / "scene.toml", _scene, faults)
    if faults:
        raise FolderError(directory, faults)
    return Folder(directory, provenance, table, scene)


def no_folder(directory: Path) -> str:
    """Why a path that is no folder is none, and what is wanted instead."""
    there = "it is a file" if directory.exists() else "there is no such folder"
    return f"{there}; give the folder that a campaign wrote (its --out), for instance results/buoy_sweep"


def campaign_of(directory: str | Path) -> str | None:
    """The name of the campaign that filled the folder, None without a provenance that can be read."""
    path = Path(directory) / "provenance.json"
    try:
        return str(_provenance(path).get("campaign", ""))
    except (OSError, ValueError):
        return None


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


def _table(path: Path, columns: tuple[str, ...], words: tuple[str, ...]) -> pandas.DataFrame:
    import pandas

    text = dict.fromkeys(words, str)
    table = pandas.read_csv(path, dtype=text, keep_default_na=True)
    absent = [column for column in columns if column not in table.columns]
    if absent:
        raise ValueError(f"column{'s' if len(absent) > 1 else ''} missing: {', '.join(absent)}")
    if table.empty:
        raise ValueError("it has no rows")
    for column in columns:
        if column not in text:
            table[column] = pandas.to_numeric(table[column])
    filled = {column: table[column].fillna("") for column in text if column in table.columns}
    return table.assign(**filled)


def _scene(path: Path):
    from engine import load_scene

    return load_scene(path)
