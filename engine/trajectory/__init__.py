"""The record of one run: even samples of the buoy and the tension, how the run ended, what it cost, optional profiles.

On disk a netCDF-3 file (it opens in xarray and in any netCDF tool); scene, status, message and statistics are
attributes, and a digest of the whole content lets `load` tell a damaged file from a sound one.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from engine import views
from engine.atomic import write_atomic
from engine.scene.models import Scene

from . import netcdf, stored
from .columns import COLUMNS, Columns
from .final_state import FinalState
from .joining import joined
from .netcdf import TrajectoryError
from .parts import EnergyBudget, Profiles, TangentGrowth

if TYPE_CHECKING:
    import pandas


@dataclass(frozen=True)
class Trajectory:
    """One run of one scene.

    status        "ok", or the word for how the run ended early; the samples up to its end are kept (possibly none)
    message       what its user has to know of it, in words; often empty
    columns       every name of COLUMNS -> (n,) array, evenly sampled
    statistics    counts and times of the work done
    profiles, tangent, energy: where the scene asks for them
    final_state   what `simulate(..., start=)` goes on from; None where the run ended early, or keeps energies
    began         what was changed where it went on from another run, as "went on at t = 300 s; changed:
                  waves.steepness 0.12 -> 0.13"; empty where nothing was, and for a run from rest
    excursions    the end of the message, where the run left what its laws are made for (`excursions`)
    """

    scene: Scene
    status: str
    message: str
    columns: Columns
    statistics: dict[str, int | float]
    profiles: Profiles | None = None
    tangent: TangentGrowth | None = None
    energy: EnergyBudget | None = None
    final_state: FinalState | None = None
    began: str = ""
    excursions: str = ""

    @property
    def own_message(self) -> str:
        """The message without the excursions: what the engine says of the run itself."""
        return self.message.removesuffix(self.excursions).rstrip(":; ")

    def followed_by(self, later: "Trajectory") -> "Trajectory":
        """This run and the one that went on from its final state as one record: scene and end of the later one.

        Perturbations that only the later one carried have growth nan before. Raises ValueError where `later` does not
        begin where this run ends, or one of them has profiles and the other not.
        """
        return joined(self, later)

    def table(self) -> "pandas.DataFrame":
        """The samples as a pandas table, one row a sample, columns in the order of COLUMNS; `attrs` has their units."""
        import pandas

        table = pandas.DataFrame({name: self.columns[name] for name in COLUMNS})
        table.attrs["units"] = {name: unit for name, (unit, _) in COLUMNS.items()}
        return table

    def __getitem__(self, column: str) -> np.ndarray:
        """The samples of a column, as run["tension_top_N"]. Raises ValueError with all names where there is none."""
        if column not in self.columns:
            raise ValueError(f"no column {column!r}; allowed: {', '.join(self.columns)}")
        return self.columns[column]

    # how one looks at a run: each of these takes the run and is described there
    plot, animate, snaps, extremes = views.plot, views.animate, views.snaps, views.extremes
    spectrum, section, exponent, verdict = views.spectrum, views.section, views.exponent, views.verdict
    to_xarray, _repr_html_ = views.to_xarray, views.html

    def __repr__(self) -> str:
        return f"Trajectory({self.scene.name!r}, {self.status!r}, {len(self.columns['time_s'])} samples)"

    def save(self, path: str | Path, attributes: dict[str, str] | None = None) -> None:
        """Write the record as one netCDF-3 file, whole or not at all.

        attributes: further global attributes (provenance). The folder must exist.
        Raises OSError (nothing is left behind), ValueError for an attribute name that the record or the format uses
        itself.
        """
        write_atomic(path, self.to_bytes(attributes))

    def to_bytes(self, attributes: dict[str, str] | None = None) -> bytes:
        """The content of the file that `save` writes, for whoever has to send it first. Raises ValueError as `save`."""
        return netcdf.to_bytes(stored.variables_of(self), stored.texts_of(self), attributes or {})

    @staticmethod
    def load(path: str | Path, attributes: dict[str, str] | None = None) -> "Trajectory":
        """The record saved under path, equal to the one saved. attributes: of `save`, which the file must have.

        Raises TrajectoryError with the reason when there is no such file or it is truncated, damaged, not a
        trajectory, or has other attributes.
        """
        try:
            content = Path(path).read_bytes()
        except OSError as error:
            raise TrajectoryError(f"{path}: cannot be read: {error.strerror or error}") from None
        return Trajectory.from_bytes(content, str(path), attributes)

    @staticmethod
    def from_bytes(content: bytes, name: str = "the record", attributes: dict[str, str] | None = None) -> "Trajectory":
        """The record of a file's content, as `load`, for whoever was sent it; TrajectoryError calls it by name."""
        try:
            texts, arrays = netcdf.from_bytes(content, stored.TEXTS, stored.OPTIONAL_TEXTS, attributes)
            return Trajectory(**stored.fields_of(texts, arrays))
        except TrajectoryError as error:
            raise TrajectoryError(f"{name}: {error}") from None
        except Exception as error:  # a damaged header can make the reader fail in any way at all
            raise TrajectoryError(f"{name}: truncated, damaged, or not a netCDF-3 file ({error})") from None
