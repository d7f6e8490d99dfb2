"""The folder of `campaigns.oscillator` as its report needs it: rows by part, arrays by part."""

from __future__ import annotations

import csv
import json
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..parts.folder import FolderError, no_folder

PARTS = (
    "section",
    "history",
    "exponents",
    "orbits",
    "basins",
    "grazing",
    "diagram-force",
    "diagram-frequency",
)
FILES = {
    "table.csv": "one row a part",
    "scene.toml": "the numbers of eq. (33) as run",
    "provenance.json": "what ran, where and for how long",
    "trajectories": "the arrays, one netCDF file each",
}


@dataclass(frozen=True, eq=False)
class Study:
    """What the campaign left: `rows` of table.csv by part (text), `arrays` by part and name, `oscillator` the five
    numbers of eq. (33), `faults` by part where its arrays are not to be had."""

    directory: Path
    provenance: dict
    rows: dict[str, dict[str, str]]
    arrays: dict[str, dict[str, np.ndarray]]
    oscillator: dict[str, float]
    faults: dict[str, str]

    def number(self, part: str, column: str) -> float:
        """A cell of table.csv as a number; NaN where it is empty."""
        text = self.rows.get(part, {}).get(column, "")
        return float(text) if text else math.nan


def read_study(directory: str | Path) -> Study:
    """Read the folder. Raises FolderError naming every file that is missing or cannot be read."""
    directory = Path(directory)
    if not directory.is_dir():
        raise FolderError(directory, [no_folder(directory)])
    faults = [f"{name} is missing ({meaning})" for name, meaning in FILES.items() if not (directory / name).exists()]
    if faults:
        raise FolderError(directory, faults)
    try:
        provenance = json.loads((directory / "provenance.json").read_text(encoding="utf-8"))
        oscillator = {key: float(entry) for key, entry in provenance["oscillator"].items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise FolderError(directory, [f"provenance.json cannot be read: {error!r}"]) from error
    try:
        with open(directory / "table.csv", encoding="utf-8", newline="") as file:
            rows = {row["part"]: row for row in csv.DictReader(file)}
    except (OSError, ValueError, KeyError) as error:
        raise FolderError(directory, [f"table.csv cannot be read: {error!r}"]) from error
    if not rows:
        raise FolderError(directory, ["table.csv cannot be read: it has no rows"])
    arrays, without = {}, {}
    for part in PARTS:
        try:
            arrays[part] = _arrays(directory, rows[part])
        except KeyError:
            without[part] = "it has no row in table.csv"
        except (OSError, ValueError, TypeError) as error:
            without[part] = rows[part]["message"] or f"its arrays cannot be read ({type(error).__name__})"
    return Study(directory, provenance, rows, arrays, oscillator, without)


def _arrays(directory: Path, row: dict[str, str]) -> dict[str, np.ndarray]:
    from scipy.io import netcdf_file

    with netcdf_file(directory / "trajectories" / f"{row['run_key']}.nc", "r", mmap=False) as file:
        return {name: np.array(variable[:]) for name, variable in file.variables.items()}
