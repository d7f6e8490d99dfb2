"""What a figure is drawn from, as a campaign writes it: one netCDF-3 file, so that it can be drawn without the runs.

The file opens in xarray and in any netCDF tool; arrays carry `units` and `long_name`, and the attributes say which
results they are from. The same content gives the same bytes: there is no date and no host in the file.
"""

import hashlib
import io
import json
from pathlib import Path

import numpy as np

from campaigns.machinery import SEAL, read_sealed, write_sealed

Array = tuple[tuple[str, ...], object, str, str]  # dimensions, values, unit, long name
Source = dict[str, object]  # one result behind a figure, as `source` makes it


def source(label: str, folder: Path, path: Path, key: str, settings: str, run_s: float) -> Source:
    """The record of a result file inside a campaign's folder. Raises OSError for a file that cannot be read.

    `label` what it is called there; `file` within the campaign's folder, with its `sha256`; `key` of the run;
    `settings` as TOML or JSON; `run_s` the seconds of computing that it took.
    """
    file, digest = path.relative_to(folder).as_posix(), hashlib.sha256(path.read_bytes()).hexdigest()
    return {"label": label, "file": file, "sha256": digest, "key": key, "settings": settings, "run_s": float(run_s)}


def dataset(title: str, arrays: dict[str, Array], sources: tuple[Source, ...], made_by: str):
    """The labelled content of a data file, an xarray.Dataset.

    arrays: name -> (dimensions, values, unit, long name); no dimensions for a single number. made_by: the key of what
    the file was made from and with, by which `attribute_of` recognises it.
    """
    import xarray

    variables = {}
    for name, (dimensions, values, unit, long_name) in arrays.items():
        variables[name] = dimensions, np.asarray(values, dtype=float), {"units": unit, "long_name": long_name}
    attributes = {
        "Conventions": "CF-1.10",
        "title": title,
        "sources": json.dumps(sources, ensure_ascii=False),
        "run_seconds": float(sum(source["run_s"] for source in sources)),
        "made_by": made_by,
    }
    return xarray.Dataset(variables, attrs=attributes)


def store(path: Path, content) -> None:
    """Write the file, sealed (`folder.write_sealed`), whole or not at all. Raises OSError."""
    content = content.assign_attrs(seal=SEAL.decode())
    write_sealed(path, bytes(content.to_netcdf(format="NETCDF3_64BIT", engine="scipy")))


def attribute_of(path: Path, name: str = "made_by") -> str | None:
    """An attribute of a data file, at first the key of what it was made from; None where there is no sound file."""
    import xarray

    content = read_sealed(path)
    if content is None:
        return None
    return xarray.load_dataset(io.BytesIO(content), engine="scipy").attrs.get(name)
