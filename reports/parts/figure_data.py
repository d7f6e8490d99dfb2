"""What a figure is drawn from, as a report reads it: one netCDF-3 file that its campaign wrote, without the runs.

Arrays carry `units` and `long_name`; the attribute `sources` says which results they are from.
"""

from __future__ import annotations

import io
import json
from types import SimpleNamespace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray


class FigureDataError(ValueError):
    """A data file that cannot be read: truncated, or not one of these."""


def parsed(content: bytes) -> xarray.Dataset:
    """The content of a data file from its bytes. Raises FigureDataError."""
    import xarray

    try:
        found = xarray.load_dataset(io.BytesIO(content), engine="scipy")
        sources_of(found)
    except Exception as error:  # a damaged header can make the reader fail in any way at all
        raise FigureDataError(f"truncated, damaged, or no figure's data ({type(error).__name__})") from None
    return found


def sources_of(content: xarray.Dataset) -> list[SimpleNamespace]:
    """The results behind the figure, in the order of its key of lines.

    Each has its label there, its file and sha256, the key of its run, its settings (TOML or JSON), and its run_s.
    """
    return [SimpleNamespace(**one) for one in json.loads(content.attrs["sources"])]
