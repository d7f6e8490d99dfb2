"""The folder of `campaigns.oscillator` as its report needs it: rows by part, arrays by part."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..parts.columns import Quantity, value
from ..parts.folder import FolderError, read_columns, read_files

PARTS = ("section", "history", "exponents", "orbits", "basins", "grazing", "diagram-force", "diagram-frequency")
FILES = {
    "table.csv": "one row a part",
    "columns.csv": "what its columns are",
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
    columns: dict[str, Quantity]
    rows: dict[str, dict[str, str]]
    arrays: dict[str, dict[str, np.ndarray]]
    oscillator: dict[str, float]
    faults: dict[str, str]

    @property
    def period(self) -> float:
        """Forcing period, in units of time."""
        return 2.0 * math.pi / self.oscillator["frequency"]

    def number(self, part: str, column: str) -> float:
        """A cell of table.csv as a number; NaN where it is empty."""
        return value(self.rows.get(part, {}), column)


def read_study(directory: str | Path) -> Study:
    """Read the folder. Raises FolderError naming every file that is missing or cannot be read."""
    import xarray

    directory = Path(directory)
    found = read_files(directory, FILES)
    try:
        oscillator = {key: float(entry) for key, entry in found["provenance.json"]["oscillator"].items()}
        rows = {row["part"]: row for row in found["table.csv"]}
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        fault = f"provenance.json or table.csv is not of this campaign: {error!r}"
        raise FolderError(directory, [fault]) from error
    if not rows:
        raise FolderError(directory, ["table.csv cannot be read: it has no rows"])
    arrays, faults = {}, {}
    for part in PARTS:
        try:
            path = directory / "trajectories" / f"{rows[part]['run_key']}.nc"
            with xarray.open_dataset(path, engine="scipy") as file:
                arrays[part] = {str(name): variable.values for name, variable in file.load().data_vars.items()}
        except KeyError:
            faults[part] = "it has no row in table.csv"
        except (OSError, ValueError, TypeError) as error:
            faults[part] = rows[part]["message"] or f"its arrays cannot be read ({type(error).__name__})"
    return Study(directory, found["provenance.json"], read_columns(directory), rows, arrays, oscillator, faults)
