"""Variables and texts as the bytes of a netCDF-3 file and back, with a digest by which a damaged file is known.

By scipy and not xarray, which reads these files: importing xarray costs every worker half a second. The same content
gives the same bytes.
"""

import hashlib
import io
import warnings

import numpy as np

DIGEST = "content_sha256"
NamedArrays = dict[str, np.ndarray]  # variables of a file by name
# One variable of a file: name, names of its dimensions, array of floats, unit, long name
Variable = tuple[str, tuple[str, ...], np.ndarray, str, str]


class TrajectoryError(ValueError):
    """A trajectory file that cannot be read: not there, truncated, damaged, or not one of ours."""


def _digest(texts: dict[str, str], arrays: NamedArrays) -> str:
    content = hashlib.sha256()
    for name, text in sorted(texts.items()):
        content.update(f"{name}={len(text.encode())}:{text}\n".encode())
    for name, values in sorted(arrays.items()):
        content.update(f"{name}{values.shape}\n".encode())
        content.update(np.ascontiguousarray(values, dtype=">f8").tobytes())
    return content.hexdigest()


def to_bytes(variables: list[Variable], texts: dict[str, str], attributes: dict[str, str]) -> bytes:
    """The content of a file: variables; texts as global attributes, part of the digest; further attributes.

    Raises ValueError for an attribute name that the texts or the format use.
    """
    from scipy.io import netcdf_file

    arrays = {name: np.asarray(values, dtype=">f8") for name, _, values, _, _ in variables}
    texts = {"Conventions": "CF-1.10", **texts, DIGEST: _digest(texts, arrays)}
    buffer = io.BytesIO()
    file = netcdf_file(buffer, "w", version=2)
    taken = [name for name in attributes if name in texts or hasattr(file, name)]
    if taken:
        raise ValueError(f"attributes: {', '.join(taken)} belong to the record or its format")
    for name, text in {**texts, **attributes}.items():
        setattr(file, name, text.encode("utf-8"))
    for name, dimensions, _, unit, long_name in variables:
        for dimension, length in zip(dimensions, arrays[name].shape, strict=True):
            if dimension not in file.dimensions:
                file.createDimension(dimension, length or None)  # None: the record dimension, which may be empty
        variable = file.createVariable(name, "d", dimensions)
        variable.units, variable.long_name = unit.encode(), long_name.encode()
        if arrays[name].size:
            variable[:] = arrays[name]
    file.flush()
    return buffer.getvalue()


def from_bytes(
    content: bytes, names: tuple[str, ...], optional: tuple[str, ...] = (), attributes: dict[str, str] | None = None
) -> tuple[dict[str, str], NamedArrays]:
    """(texts of these names, arrays) of a file, which need not have the optional ones. attributes: that it must have.

    Raises TrajectoryError, or whatever a damaged header makes of it.
    """
    from scipy.io import netcdf_file

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        file = netcdf_file(io.BytesIO(content), "r", mmap=False)
    present = [name for name in optional if hasattr(file, name)]
    texts = {name: _text(file, name) for name in (*names, *present)}
    arrays = {name: np.array(variable.data, dtype=np.float64) for name, variable in file.variables.items()}
    if _digest(texts, arrays) != _text(file, DIGEST):
        raise TrajectoryError("damaged: the content does not match its own digest")
    for name, wanted in (attributes or {}).items():
        text = _text(file, name)
        if text != wanted:
            raise TrajectoryError(f"another run: its {name} is {text!r}")
    return texts, arrays


def _text(file: object, name: str) -> str:
    value = getattr(file, name, None)
    if not isinstance(value, bytes):
        raise TrajectoryError(f"not a trajectory file: it has no attribute {name!r}")
    return value.decode("utf-8")
