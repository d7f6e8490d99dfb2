"""The file of a part of the oscillator study: its arrays, and its row of table.csv, as netCDF-3."""

import io
import json
from pathlib import Path

import numpy as np
from scipy.io import netcdf_file


def to_netcdf(arrays: dict, row: dict) -> bytes:
    """The arrays of a part as a netCDF-3 file, its row as the attribute `row` (JSON)."""
    buffer = io.BytesIO()
    file = netcdf_file(buffer, "w", version=2)
    file.row = json.dumps(row, default=lambda number: number.item())
    for name, values in arrays.items():
        values = np.asarray(values)
        kind = "i4" if values.dtype.kind in "iub" else "f8"
        for axis, length in enumerate(values.shape):
            file.createDimension(f"{name}_{axis}", length)
        variable = file.createVariable(name, kind, tuple(f"{name}_{axis}" for axis in range(values.ndim)))
        variable[:] = values
    file.flush()
    return buffer.getvalue()


def read_row(path: Path) -> dict | None:
    """The row of a part's file; None where there is no such file, or a damaged one."""
    try:
        with netcdf_file(path, "r", mmap=False) as file:
            row = json.loads(file.row)
    except Exception:  # absent, truncated, from a foreign hand: the cure is the same, it is computed again
        return None
    return row
