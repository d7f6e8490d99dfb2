"""A column of a text file as an evenly sampled record, or all reasons why the file has no such record.

Commas, semicolons, tabs or spaces separate the columns, and one line above them has their names; the columns of a file
without names are called 1, 2, ... Lines that begin with # are comments. The text is UTF-8, or UTF-16 with a byte order
mark, as spreadsheets export it.
"""

from __future__ import annotations

import contextlib
import csv
import os
import re
import warnings
from array import array
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING

from engine.streams import close_to

if TYPE_CHECKING:
    import numpy as np

FORMAT = "a text file of columns separated by commas, semicolons, tabs or spaces, with their names in the first line"
BINARY = {  # first bytes of files that are often given in place of text: what such a file is, and what to do with it
    b"PK\x03\x04": ("a spreadsheet or a zip archive, not text", "save the sheet as CSV"),
    b"\xd0\xcf\x11\xe0": ("a spreadsheet, not text", "save the sheet as CSV"),
    b"\x1f\x8b": ("compressed, not text", "unpack it first: gunzip -k"),
    b"CDF": ("netCDF, not text", "of a trajectory: engine.Trajectory.load(FILE).table().to_csv(NEW)"),
    b"\x89HDF": ("netCDF or HDF5, not text", "write the column as text, for instance with pandas"),
}
TIME = "time_s"  # a column of this name has the times, where neither --time nor --step is given
UTF16 = (b"\xff\xfe", b"\xfe\xff")
LEAST_SAMPLES = 100  # no measure says anything of a shorter record
# Share of a step by which a time may miss the even grid: three digits at 30 samples a second miss it by 1.5 %.
UNEVEN = 0.02
LARGEST = 1e100  # the square of a larger number may be infinite
_CLOCK = re.compile(r"\d+[-/.]\d+[-/.]\d+|\d+:\d+")


@dataclass(frozen=True, eq=False)
class Record:
    """An evenly sampled series."""

    values: np.ndarray  # (n,) in the unit of the file
    step: float  # time from sample to sample, in `unit`
    unit: str  # of time: "s", or "samples" where neither the file nor the command has times
    column: str
    path: Path


def read_record(
    path: str, column: str | None, time: str | None, step: float | None, faults: list[str]
) -> Record | None:
    """The Record of a column; None where anything is wrong. A line for each fault is then appended to `faults`.

    column, time   names of columns; None: not given. The only column beside the times needs no name
    step           sampling step [s], or None
    """
    earlier_faults = len(faults)
    try:
        table = read_table(Path(path))
        if time is None and step is None and column != TIME and TIME in table.names:
            time = TIME
        if column is None:
            series = [name for name in table.names if name and name != time]
            if len(series) == 1:
                column = series[0]
        if column is None and any(fault.startswith("--column:") for fault in faults):
            return None  # the command line has a --column that cannot be read
        faults.extend(_name_faults(table, column, time))
        if len(faults) > earlier_faults:
            return None
        column_option, time_option = f"--column {column}", f"--time {time}"
        places = {column_option: table.names.index(column)}
        if time is not None:
            places[time_option] = table.names.index(time)
        numbers = _numbers(table, places, faults)
    except ValueError as error:
        faults.append(str(error))
        return None
    x, t = numbers.get(column_option), numbers.get(time_option)
    if x is not None:
        faults.extend(f"{column_option}: {fault}" for fault in _series_faults(x))
    unit = "s"
    if t is not None and len(t) > 1:
        step = float((t[-1] - t[0]) / (len(t) - 1))
        faults.extend(f"{time_option}: {fault}" for fault in _sampling_faults(t, step))
    elif t is None and step is None:
        step, unit = 1.0, "samples"
    if len(faults) > earlier_faults:
        return None
    return Record(x, step, unit, column, Path(path))


def _name_faults(table: Table, column: str | None, time: str | None) -> Iterator[str]:
    """A line for each fault of the names of columns: not given, given twice, or not in the table."""
    named = list(filter(None, table.names))
    listed = ", ".join(named[:40])
    if len(named) > 40:
        listed += f" and {len(named) - 40} more"
    if column is None:
        yield f"--column: not given; allowed: {listed}"
    elif column == time:
        yield f"--column and --time: given {column!r} as both; allowed: two columns"
    for option, name in (("--column", column), ("--time", time)):
        if name is not None and name not in table.names:
            yield f"{option}: no column {name!r} in {table.path}{close_to(name, table.names)}; allowed: {listed}"


@dataclass(frozen=True, eq=False)
class Table:
    """A text file of columns."""

    path: Path
    names: list[str]  # of the columns
    mark: str | None  # between the columns; None: spaces
    named: bool  # whether the first line has the names

    def lines(self) -> Iterator[str]:
        """The lines of the file below the names. An empty one among those of a single column is an empty cell."""
        row, empty = -int(self.named), 0
        for line in _lines(self.path):
            if not line.strip():
                empty += 1
                continue
            if row > 0 and len(self.names) == 1:
                yield from ['""\n'] * empty
            if row >= 0:
                yield line
            row, empty = row + 1, 0

    def rows(self) -> Iterator[list]:
        """The cells of each line. Raises ValueError at the first row with more or fewer cells than there are names."""
        for number, cells in enumerate(_cells(self.path, self.lines(), self.mark), 1):
            if len(cells) == len(self.names):
                yield cells
                continue
            fault = f"{self.path}: row {number} below the names has {len(cells)} cells, the names are {len(self.names)}"
            if self.mark == "," and len(cells) == 2 * len(self.names):
                raise ValueError(f"{fault}; allowed: numbers with a dot, not a comma, where commas separate columns")
            names = _short(", ".join(self.names))
            raise ValueError(f"{fault} ({names}); allowed: {FORMAT}, above it only lines begun with #")


def _numbers(table: Table, places: dict[str, int], faults: list[str]) -> dict[str, np.ndarray]:
    """Columns of a table as floats (n,), by their labels.

    places: label of each column, as "--column x", and its place in the table. A column with a cell that is no finite
    number is left out; each kind of such cells in a column is a line in `faults`.
    """
    import numpy as np  # 0.1 s, which a file without columns does not need

    with warnings.catch_warnings():
        warnings.simplefilter("error")  # NumPy warns of a file without rows
        try:
            numbers = np.loadtxt(table.lines(), delimiter=table.mark, comments=None, quotechar='"', ndmin=2)
            if numbers.shape[1] == len(table.names) and np.isfinite(numbers).all():
                return {label: numbers[:, place].copy() for label, place in places.items()}
        except (ValueError, UserWarning):
            pass
    # Now cell by cell: another column may hold words, and a fault line names the row and the cell.
    values = {label: array("d") for label in places}
    bad_cells = {}  # by label and fault: the first such cell, then the rows of all
    for row, cells in enumerate(table.rows(), 1):
        for label, place in places.items():
            cell = cells[place]
            fault = _cell_fault(cell)
            if fault:
                bad_cells.setdefault((label, fault), [cell]).append(row)
            else:
                values[label].append(float(cell))
    for (label, fault), (cell, *rows) in bad_cells.items():
        if len(rows) > 1:
            fault += f" (so are {len(rows) - 1} more)"
        allowed = f"finite numbers in every row; {_cure(cell, label, rows)}"
        faults.append(f"{label}: row {rows[0]} below the names, {_short(cell)!r}, {fault}; allowed: {allowed}")
        values.pop(label, None)
    return {label: np.array(column) for label, column in values.items()}


def _short(text: str) -> str:
    """At most 60 letters of a text."""
    if len(text) > 60:
        return f"{text[:57]}..."
    return text


def _cell_fault(cell: str) -> str:
    """Why a cell is no finite number; "" where it is a finite number."""
    try:
        number = float(cell)
    except ValueError:
        if not cell:
            return "is empty"
        return "is no number"
    if "_" in cell:  # Python alone reads 1_0 as 10
        return "is no number"
    if not isfinite(number):
        return "is not finite"
    return ""


def _cure(cell: str, label: str, rows: list[int]) -> str:
    """What to do about a cell that is no number. rows: of its column that have such cells."""
    if _CLOCK.search(cell):
        cure = "dates and clock times are not read"
        if label.startswith("--time"):
            cure += "; give --step SECONDS in its place"
        return cure
    if "," in cell:
        return "with a dot, not a comma"
    if rows == [1] and cell and not any(letter.isdigit() for letter in cell):
        return "a line of units is taken out, or begun with #"
    return "cut the record there or fill the gap"


def _series_faults(x: np.ndarray) -> Iterator[str]:
    """Why a series (n,) cannot be judged; nothing where it can."""
    import numpy as np

    size = np.abs(x).max(initial=0.0)
    if len(x) < LEAST_SAMPLES:
        yield f"given {len(x)} samples; allowed: {LEAST_SAMPLES} or more"
    elif size > LARGEST:
        yield f"values up to {size:.3g}; allowed: at most {LARGEST:g} in size; take a larger unit"
    elif np.ptp(x) <= 64 * np.finfo(float).eps * size:
        yield f"every value is {x[0]:.6g}; allowed: a series that moves"


def _sampling_faults(t: np.ndarray, step: float) -> Iterator[str]:
    """Why times (n,) of a mean step are not evenly spaced; nothing where they are."""
    import numpy as np

    forward = np.diff(t)
    if np.any(forward <= 0.0):
        k = int(np.argmax(forward <= 0.0))
        yield f"{t[k + 1]:.9g} follows {t[k]:.9g} in row {k + 2}; allowed: times in seconds that increase"
        return
    deviation = np.abs(t - t[0] - step * np.arange(len(t))).max()
    if deviation <= UNEVEN * step:
        return
    usual = np.median(forward)
    k = int(np.argmax(np.abs(forward - usual)))
    fault = f"steps of {usual:.6g} s, but of {forward[k]:.6g} s after row {k + 1}"
    if abs(forward[k] - usual) <= UNEVEN * usual:
        fault = f"steps that creep from {forward[0]:.9g} s to {forward[-1]:.9g} s"
    allowed = f"even sampling (to {UNEVEN:.0%} of a step); interpolate onto even times first"
    if deviation <= np.ptp(forward) < 0.9 * step:
        # Times that are written with few digits miss the even grid by at most one unit of the last digit.
        allowed += f", or, where times are only rounded, give --step {step:.6g} in the place of --time"
    yield f"{fault}; allowed: {allowed}"


def read_table(path: Path) -> Table:
    """The table in a file. Raises ValueError, with what is allowed, for a file that has none."""
    first_line = next(filter(str.strip, _lines(path)), None)
    if first_line is None:
        raise ValueError(f"{path}: empty; allowed: {FORMAT}")
    mark = next((mark for mark in ("\t", ";", ",") if mark in first_line), None)
    names, named = next(_cells(path, [first_line], mark)), True
    with contextlib.suppress(ValueError):  # a file of numbers only has no line of names
        list(map(float, names))
        names, named = [str(place) for place in range(1, len(names) + 1)], False
    for name in names:
        if name and names.count(name) > 1:  # separators at the end of a line are columns without a name
            raise ValueError(f"{path}: two columns are called {name!r}; allowed: a name of its own for each")
    table = Table(path, names, mark, named)
    next(table.rows(), None)  # a title above the names is a fault here, before a column is missed in it
    return table


def _cells(path: Path, lines: Iterable[str], mark: str | None) -> Iterator[list]:
    """The cells of each line."""
    if mark is None:
        for line in lines:
            yield [cell.strip('"') for cell in line.split()]
        return
    try:
        for row in csv.reader(lines, delimiter=mark, skipinitialspace=True):
            yield [cell.strip() for cell in row]
    except csv.Error as error:
        raise ValueError(f"{path}: no table ({error}); allowed: {FORMAT}") from None


def _lines(path: Path) -> Iterator[str]:
    """The lines of a text file, without comments.

    Raises ValueError, with what is allowed, for a file that cannot be read or is no text.
    """
    if os.path.isdir(path):
        raise ValueError(f"{path}: a folder; allowed: {FORMAT}")
    no_text = f"{path}: not text in UTF-8; allowed: {FORMAT} (of a text in another encoding: save it as UTF-8)"
    try:
        with open(path, "rb") as file:
            begin = file.read(8)
        for first_bytes, (kind, cure) in BINARY.items():
            if begin.startswith(first_bytes):
                raise ValueError(f"{path}: {kind}; allowed: {FORMAT} ({cure})")
        encoding = "utf-8-sig"
        if begin.startswith(UTF16):
            encoding = "utf-16"
        with open(path, encoding=encoding) as file:
            for line in file:
                if "\0" in line:
                    raise ValueError(no_text)
                if not line.lstrip().startswith("#"):
                    yield line
    except UnicodeDecodeError:
        raise ValueError(no_text) from None
    except FileNotFoundError:
        fault, folder = "there is no such file", path.absolute().parent
        if not os.path.isdir(folder):
            fault += f", nor a folder {folder}"
        elif os.access(folder, os.R_OK):
            fault += close_to(path.name, os.listdir(folder)[:1000])
        raise ValueError(f"{path}: {fault}; allowed: {FORMAT}") from None
    except OSError as error:
        raise ValueError(f"{path}: cannot be read: {error.strerror}; allowed: {FORMAT}") from None
