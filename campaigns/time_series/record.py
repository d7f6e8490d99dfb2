"""A column of a text file as an evenly sampled record, or every reason why it is none.

The file: columns separated by commas, semicolons, tabs or spaces, one line of names above them (a file of numbers only
has the columns 1, 2, ...), lines that begin with # left out; UTF-8, or UTF-16 with its mark, as spreadsheets export it.
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
from itertools import islice
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING

from engine.streams import close_to

if TYPE_CHECKING:
    import numpy as np

FORMAT = "a text file of columns separated by commas, semicolons, tabs or spaces, with their names in the first line"
# How files begin that are often given in place of text, what they are, and what to do.
BINARY = {
    b"PK\x03\x04": ("a spreadsheet or a zip archive, not text", "save the sheet as CSV"),
    b"\xd0\xcf\x11\xe0": ("a spreadsheet, not text", "save the sheet as CSV"),
    b"\x1f\x8b": ("compressed, not text", "unpack it first: gunzip -k"),
    b"CDF": ("netCDF, not text", "of a trajectory: engine.Trajectory.load(FILE).table().to_csv(NEW)"),
    b"\x89HDF": ("netCDF or HDF5, not text", "write the column as text, for instance with pandas"),
}
TIME = "time_s"  # a column of this name has the times, where neither --time nor --step is given
UTF16 = (b"\xff\xfe", b"\xfe\xff")
# Fewer say nothing in any of the measures.
LEAST_SAMPLES = 100
# Share of a step by which a time may miss the even grid: three digits at 30 samples a second miss it by 1.5 %.
UNEVEN = 0.02
# Beyond, squares of differences leave the range of numbers.
LARGEST = 1e100
_CLOCK = re.compile(r"\d+[-/.]\d+[-/.]\d+|\d+:\d+")


@dataclass(frozen=True, eq=False)
class Record:
    """An evenly sampled series."""

    values: np.ndarray  # (n,) in the unit of the file
    step: float  # time from sample to sample, in `unit`
    unit: str  # "s", or "samples" where the file and the command say nothing of time
    column: str
    path: Path


def read_record(
    path: str, column: str | None, time: str | None, step: float | None, faults: list[str]
) -> Record | None:
    """The Record of one column; None where anything is wrong, which is then appended to `faults`, a line each.

    column, time   names of columns; None: not given (a file of one column beside TIME needs no name)
    step           sampling step [s], or None
    """
    faults_before = len(faults)
    try:
        table = read_table(Path(path))
        if time is None and step is None and column != TIME and TIME in table.names:
            time = TIME
        if column is None:
            series = [name for name in table.names if name != time]
            if len(series) == 1:
                column = series[0]
        if column is None and any(fault.startswith("--column:") for fault in faults):
            return None  # it was given, and is at fault
        faults.extend(_unknown_columns(table, column, time))
        if len(faults) > faults_before:
            return None
        places = {f"--column {column}": table.names.index(column)}
        if time is not None:
            places[f"--time {time}"] = table.names.index(time)
        numbers = _numbers(table, places, faults)
    except ValueError as error:
        faults.append(str(error))
        return None
    x, t = numbers.get(f"--column {column}"), numbers.get(f"--time {time}")
    if x is not None:
        faults.extend(f"--column {column}: {fault}" for fault in _not_worth_it(x))
    unit = "s"
    if t is not None and len(t) > 1:
        step = float((t[-1] - t[0]) / (len(t) - 1))
        faults.extend(f"--time {time}: {fault}" for fault in _uneven(t, step))
    elif t is None and step is None:
        step, unit = 1.0, "samples"
    if len(faults) > faults_before:
        return None
    return Record(x, step, unit, column, Path(path))


def _unknown_columns(table: Table, column: str | None, time: str | None) -> Iterator[str]:
    """What is wrong with the names of columns, as fault lines."""
    listed = ", ".join(table.names[:40])
    if len(table.names) > 40:
        listed += f" and {len(table.names) - 40} more"
    if column is None:
        yield f"--column: not given; allowed: {listed}"
    elif column == time:
        yield f"--column and --time: given {column!r} as both; allowed: two columns"
    for option, name in (("--column", column), ("--time", time)):
        if name is not None and name not in table.names:
            yield f"{option}: no column {name!r} in {table.path}{close_to(name, table.names)}; allowed: {listed}"


@dataclass(frozen=True, eq=False)
class Table:
    """A text file of columns: their names, the mark between them (None: spaces), whether its first line has names."""

    path: Path
    names: list[str]
    mark: str | None
    named: bool

    def lines(self) -> Iterator[str]:
        """The lines below the names."""
        return islice(_lines(self.path), int(self.named), None)

    def rows(self) -> Iterator[list]:
        """The cells of each line. Raises ValueError at the first row with more or fewer cells than there are names."""
        for number, cells in enumerate(_cells(self.path, self.lines(), self.mark), 1):
            if len(cells) == len(self.names):
                yield cells
                continue
            fault = f"{self.path}: row {number} below the names has {len(cells)} cells, the names are {len(self.names)}"
            if self.mark == "," and len(cells) == 2 * len(self.names):
                raise ValueError(f"{fault}; allowed: numbers with a dot, not a comma, where commas separate columns")
            shown = ", ".join(self.names)
            if len(shown) > 60:
                shown = f"{shown[:57]}..."
            raise ValueError(f"{fault} ({shown}); allowed: {FORMAT} (lines above it: taken out, or begun with #)")


def _numbers(table: Table, places: dict[str, int], faults: list[str]) -> dict[str, np.ndarray]:
    """Columns as floats (n,), by what they are called; without those that have faults, one for each way of them.

    places: numbers of the columns.
    """
    import numpy as np  # 0.1 s, which a file without columns does not need

    with warnings.catch_warnings():
        warnings.simplefilter("error")  # of a file without rows
        try:
            numbers = np.loadtxt(table.lines(), delimiter=table.mark, comments=None, quotechar='"', ndmin=2)
            if numbers.shape[1] == len(table.names) and np.isfinite(numbers).all():
                return {name: numbers[:, place].copy() for name, place in places.items()}
        except (ValueError, UserWarning):  # cell by cell, to say what is wrong; other columns may hold words
            pass
    values = {name: array("d") for name in places}
    wrong = {}  # by column and what is wrong: its first cell, and its rows
    for number, cells in enumerate(table.rows(), 1):
        for name, place in places.items():
            cell = cells[place]
            fault = _is_no_number(cell)
            if fault:
                wrong.setdefault((name, fault), [cell]).append(number)
            else:
                values[name].append(float(cell))
    for (name, fault), (cell, *rows) in wrong.items():
        if len(rows) > 1:
            fault += f" (so are {len(rows) - 1} more)"
        allowed = f"finite numbers in every row; {_cure(cell, name, rows)}"
        faults.append(f"{name}: row {rows[0]} below the names, {cell!r}, {fault}; allowed: {allowed}")
        values.pop(name, None)
    return {name: np.array(column) for name, column in values.items()}


def _is_no_number(cell: str) -> str:
    """What is wrong with a cell in the place of a finite number; "" where nothing is."""
    try:
        number = float(cell)
    except ValueError:
        if not cell:
            return "is empty"
        return "is no number"
    if "_" in cell:  # 1_0 is 10 to Python alone
        return "is no number"
    if not isfinite(number):
        return "is not finite"
    return ""


def _cure(cell: str, name: str, rows: list[int]) -> str:
    """What to do about a cell that is no number, in `rows` of its column."""
    if _CLOCK.search(cell):
        cure = "dates and clock times are not read"
        if name.startswith("--time"):
            cure += "; give --step SECONDS in its place"
        return cure
    if "," in cell:
        return "with a dot, not a comma"
    if rows == [1] and cell and not any(mark.isdigit() for mark in cell):
        return "a line of units is taken out, or begun with #"
    return "cut the record there or fill the gap"


def _not_worth_it(x: np.ndarray) -> Iterator[str]:
    """Why a series (n,) cannot be judged, if it cannot."""
    import numpy as np

    if len(x) < LEAST_SAMPLES:
        yield f"given {len(x)} samples; allowed: {LEAST_SAMPLES} or more"
    elif np.abs(x).max() > LARGEST:
        yield f"values up to {np.abs(x).max():.3g}; allowed: at most {LARGEST:g} in size; take a larger unit"
    elif np.ptp(x) <= 64 * np.finfo(float).eps * np.abs(x).max():
        yield f"every value is {x[0]:.6g}; allowed: a series that moves"


def _uneven(t: np.ndarray, step: float) -> Iterator[str]:
    """Why times (n,) are not those of an even sampling of this mean step, if they are not."""
    import numpy as np

    forward = np.diff(t)
    if np.any(forward <= 0.0):
        k = int(np.argmax(forward <= 0.0))
        yield f"{t[k + 1]:.9g} follows {t[k]:.9g} in row {k + 2}; allowed: times in seconds that increase"
        return
    deviation = np.abs(t - t[0] - step * np.arange(len(t))).max()
    if deviation <= UNEVEN * step:
        return
    usual, k = np.median(forward), int(np.argmax(np.abs(forward - np.median(forward))))
    fault = f"steps of {usual:.6g} s, but of {forward[k]:.6g} s after row {k + 1}"
    if abs(forward[k] - usual) <= UNEVEN * usual:
        fault = f"steps that creep from {forward[0]:.9g} s to {forward[-1]:.9g} s"
    allowed = f"even sampling (to {UNEVEN:.0%} of a step); interpolate onto even times first"
    if deviation <= np.ptp(forward) < 0.9 * step:
        # Within one digit of the even grid, as times written with few digits are.
        allowed += f", or, where times are only rounded, give --step {step:.6g} in the place of --time"
    yield f"{fault}; allowed: {allowed}"


def read_table(path: Path) -> Table:
    """The table of a file. Raises ValueError, with what is allowed, where it is none."""
    first = next(_lines(path), None)
    if first is None:
        raise ValueError(f"{path}: empty; allowed: {FORMAT}")
    mark = next((mark for mark in ("\t", ";", ",") if mark in first), None)
    names, named = next(_cells(path, [first], mark)), True
    with contextlib.suppress(ValueError):  # a file of numbers only has no line of names
        list(map(float, names))
        names, named = [str(place) for place in range(1, len(names) + 1)], False
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"{path}: two columns are called {name!r}; allowed: a name of its own for each")
    table = Table(path, names, mark, named)
    next(table.rows(), None)  # a title in the place of the names is told before a column that they lack
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
    """The lines of a text file that say something."""
    if os.path.isdir(path):
        raise ValueError(f"{path}: a folder; allowed: {FORMAT}")
    what, cure = "not text in UTF-8", "of a text in another encoding: save it as UTF-8"
    try:
        with open(path, "rb") as file:
            begin = file.read(8)
        kinds = [kind for mark, kind in BINARY.items() if begin.startswith(mark)]
        encoding = "utf-8-sig"
        if begin[:2] in UTF16:
            encoding = "utf-16"
        if kinds:
            what, cure = kinds[0]
        else:
            with open(path, encoding=encoding) as file:
                for line in file:
                    if "\0" in line:
                        break
                    text = line.strip()
                    if text and not text.startswith("#"):
                        yield line
                else:
                    return
    except UnicodeDecodeError:
        pass
    except FileNotFoundError:
        fault, folder = "there is no such file", path.absolute().parent
        if not os.path.isdir(folder):
            fault += f", nor a folder {folder}"
        elif os.access(folder, os.R_OK):
            fault += close_to(path.name, os.listdir(folder)[:1000])
        raise ValueError(f"{path}: {fault}; allowed: {FORMAT}") from None
    except OSError as error:
        raise ValueError(f"{path}: cannot be read: {error.strerror}; allowed: {FORMAT}") from None
    raise ValueError(f"{path}: {what}; allowed: {FORMAT} ({cure})")
