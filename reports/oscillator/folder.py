"""The folder of `campaigns.oscillator` as its report needs it: rows by part, arrays by part."""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..parts import folder
from ..parts.columns import Quantity, value
from ..parts.folder import FolderError

PARTS = ("section", "history", "exponents", "orbits", "basins", "grazing", "diagram-force", "diagram-frequency")


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
    # scene.toml is no scene of the engine here; its numbers are in the provenance as well.
    wanted = {name: meaning for name, meaning in folder.PARTS.items() if name != "scene.toml"}
    found = folder.read_files(directory, wanted)
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
    return Study(directory, found["provenance.json"], found["columns.csv"], rows, arrays, oscillator, faults)
