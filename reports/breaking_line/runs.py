"""The runs of the breaking line as the report looks at them: row of the table, and the trajectory of each case."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..figures.line_panels import thousands
from ..parts.folder import Folder, FolderError, Row, read_files

if TYPE_CHECKING:
    import xarray

FAST, SLOW = ("1", "2", "3", "4"), ("1p", "2p", "3p", "4p")


@dataclass(frozen=True, eq=False)
class Line(Row):
    """One row of the table.

    `trajectory`: of kind "case", where its file can be read; `fault`: why it cannot, else "".
    """

    trajectory: object | None = None
    fault: str = ""

    @property
    def name(self) -> str:
        """As the paper writes it: 4, 4′."""
        return named(self["case"])

    def share(self, column: str) -> float:
        """An energy as a share of the stored one."""
        return self[column] / self["stored_J"]


def named(case: str) -> str:
    """A case of the command line as the paper writes it."""
    return case.replace("p", "′")


def title_of(place: int, case: str, force_N: float) -> str:
    """Of the panel of a case, at a place in its figure."""
    return f"({'abcd'[place]}) case {named(case)}: {thousands(force_N)} N"


def read_lines(folder: Folder) -> tuple[Line, ...]:
    """Every run of the table, in its order."""
    rows = folder.table.to_dict("records")
    return tuple(Line(row, *(folder.trajectory(row) if row["kind"] == "case" else (None, ""))) for row in rows)


def read_exact(folder: Folder) -> xarray.Dataset | None:
    """exact.nc of the folder: characteristics, shocks and speeds of exact theory; None where it has none."""
    try:
        return read_files(folder.directory, {"exact.nc": "exact theory"})["exact.nc"]
    except FolderError:
        return None


def of_kind(lines: Iterable[Line], *kinds: str) -> list[Line]:
    """The runs that ended as asked, kind by kind."""
    return [line for kind in kinds for line in lines if line["kind"] == kind and line.ok]
