"""What a figure is drawn from, as a report reads it: one netCDF-3 file that its campaign wrote, without the runs.

Arrays carry `units` and `long_name`; the attribute `sources` says which results they are from.
"""

from __future__ import annotations

import io
import json
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray


class FigureDataError(ValueError):
    """A data file that cannot be read: truncated, or not one of these."""


@dataclass(frozen=True)
class Source:
    """One result behind a figure: what it is called there, its file and content hash, the key of its run, its settings
    as TOML or JSON, and the seconds of computing that it took."""

    label: str
    file: str
    sha256: str
    key: str
    settings: str
    run_s: float


def parsed(content: bytes) -> xarray.Dataset:
    """The content of a data file from its bytes. Raises FigureDataError."""
    import xarray

    try:
        found = xarray.load_dataset(io.BytesIO(content), engine="scipy")
        sources_of(found)
    except Exception as error:  # a damaged header can make the reader fail in any way at all
        raise FigureDataError(f"truncated, damaged, or no figure's data ({type(error).__name__})") from None
    return found


def sources_of(content: xarray.Dataset) -> tuple[Source, ...]:
    """The results behind the figure, in the order of its key of lines."""
    return tuple(Source(**one) for one in json.loads(content.attrs["sources"]))
