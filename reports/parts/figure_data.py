"""What a figure is drawn from: one netCDF-3 file beside its pictures, so that it can be drawn again without the runs.

A campaign writes the file (`dataset`, `store`), its report draws from it alone (`parsed`, `sources_of`). The file opens
in xarray and in any netCDF tool; arrays carry `units` and `long_name`, and the attributes say which results they are
from.
The same content gives the same bytes: there is no date and no host in the file.
"""

from __future__ import annotations

import dataclasses
import hashlib
import io
import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray

Array = tuple[tuple[str, ...], object, str, str]  # dimensions, values, unit, long name


class FigureDataError(ValueError):
    """A data file that cannot be read: not there, truncated, or not one of these."""


@dataclass(frozen=True)
class Source:
    """One result behind a figure.

    `label` what it is called there; `file` within the campaign's folder, with its `sha256`; `key` of the run;
    `settings` as TOML or JSON; `run_s` the seconds of computing that it took.
    """

    label: str
    file: str
    sha256: str
    key: str
    settings: str
    run_s: float


def source(label: str, folder: Path, path: Path, key: str, settings: str, run_s: float) -> Source:
    """The record of a result file inside a campaign's folder. Raises OSError for a file that cannot be read."""
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    return Source(label, path.relative_to(folder).as_posix(), digest, key, settings, float(run_s))


def dataset(title: str, arrays: dict[str, Array], sources: tuple[Source, ...], made_by: str) -> xarray.Dataset:
    """The labelled content of a data file.

    arrays: name -> (dimensions, values, unit, long name); no dimensions for a single number. `made_by`: the key of what
    the file was made from and with, by which `made_by_of` recognises it.
    """
    import xarray

    variables = {
        name: (dimensions, np.asarray(values, dtype=float), {"units": unit, "long_name": long_name})
        for name, (dimensions, values, unit, long_name) in arrays.items()
    }
    attributes = {
        "Conventions": "CF-1.10",
        "title": title,
        "sources": json.dumps([dataclasses.asdict(one) for one in sources], ensure_ascii=False),
        "run_seconds": float(sum(one.run_s for one in sources)),
        "made_by": made_by,
    }
    return xarray.Dataset(variables, attrs=attributes)


def store(path: Path, content: xarray.Dataset) -> None:
    """Write the file, whole or not at all. Raises OSError."""
    from engine.atomic import write_atomic

    write_atomic(path, bytes(content.to_netcdf(format="NETCDF3_64BIT", engine="scipy")))


def read(path: Path) -> xarray.Dataset:
    """The content of a data file. Raises FigureDataError."""
    try:
        return parsed(path.read_bytes())
    except OSError as error:
        raise FigureDataError(f"{path.name} cannot be read: {error.strerror or error}") from None
    except FigureDataError as error:
        raise FigureDataError(f"{path.name} is {error}") from None


def parsed(content: bytes) -> xarray.Dataset:
    """The content of a data file from its bytes. Raises FigureDataError."""
    import xarray

    try:
        found = xarray.load_dataset(io.BytesIO(content), engine="scipy")
        sources_of(found)
    except Exception as error:  # a damaged header can make the reader fail in any way at all
        raise FigureDataError(f"truncated, damaged, or no figure's data ({type(error).__name__})") from None
    return found


def made_by_of(path: Path) -> str | None:
    """The key of what a data file was made from; None where there is no sound one."""
    try:
        return str(read(path).attrs["made_by"])
    except (FigureDataError, KeyError):
        return None


def sources_of(content: xarray.Dataset) -> tuple[Source, ...]:
    """The results behind the figure, in the order of its key of lines."""
    return tuple(Source(**one) for one in json.loads(content.attrs["sources"]))
