"""The runs of the breaking line as the report looks at them: row of the table, and the trajectory of each case."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..parts.folder import Folder

if TYPE_CHECKING:
    import xarray

FAST, SLOW = ("1", "2", "3", "4"), ("1p", "2p", "3p", "4p")


@dataclass(frozen=True, eq=False)
class Line:
    """One row of the table.

    `trajectory`: of kind "case", where its file can be read; `fault`: why it cannot, else "".
    """

    row: dict
    trajectory: object | None
    fault: str

    @property
    def case(self) -> str:
        return self.row["case"]

    @property
    def kind(self) -> str:
        return self.row["kind"]

    @property
    def name(self) -> str:
        """As the paper writes it: 4, 4′."""
        return named(self.case)

    @property
    def ok(self) -> bool:
        return self.row["status"] == "ok"

    def value(self, column: str) -> float:
        """A number of the row, nan where the table leaves it empty."""
        return float(self.row[column])

    def share(self, column: str) -> float:
        """An energy as a share of the stored one."""
        return self.value(column) / self.value("stored_J")


def named(case: str) -> str:
    """A case of the command line as the paper writes it."""
    return case.replace("p", "′")


def read_lines(folder: Folder) -> tuple[Line, ...]:
    """Every run of the table, in its order."""
    return tuple(_read_line(folder, row) for row in folder.table.to_dict("records"))


def read_exact(folder: Folder) -> xarray.Dataset | None:
    """exact.nc of the folder: characteristics, shocks and speeds of exact theory; None where it has none."""
    import io

    import xarray

    try:
        return xarray.load_dataset(io.BytesIO((folder.directory / "exact.nc").read_bytes()), engine="scipy")
    except (OSError, ValueError, TypeError):
        return None


def of_kind(lines: tuple[Line, ...], kind: str) -> tuple[Line, ...]:
    """The runs of one kind that ended as asked."""
    return tuple(line for line in lines if line.kind == kind and line.ok)


def find(lines: tuple[Line, ...], case: str) -> Line | None:
    """The run of a case that ended as asked, None where there is none."""
    return next((line for line in of_kind(lines, "case") if line.case == case), None)


def _read_line(folder: Folder, row: dict) -> Line:
    return Line(row, *(folder.trajectory(row) if row["kind"] == "case" else (None, "")))
