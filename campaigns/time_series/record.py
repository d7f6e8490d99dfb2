"""A column of a text file as an evenly sampled record, or every reason why it is none.

The file: columns separated by commas, semicolons, tabs or spaces, one line of names above them (a file of numbers only
has the columns 1, 2, ...), lines that begin with # left out; UTF-8, or UTF-16 with its mark, as spreadsheets export it.
"""

import contextlib
import csv
import difflib
import os
import re
import warnings
from array import array
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import islice
from math import isfinite
from pathlib import Path

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

    column, time   names of columns; None: not given (a file of one column needs no name)
    step           sampling step [s], or None
    """
    faults_before = len(faults)
    try:
        table = read_table(Path(path))
        names = table.names
        column = names[0] if column is None and len(names) == 1 else column
        listed = ", ".join(names[:40]) + (f" and {len(names) - 40} more" if len(names) > 40 else "")
        if column is None:
            faults.append(f"--column: not given; allowed: {listed}")
        elif column == time:
            faults.append(f"--column and --time: given {column!r} as both; allowed: two columns")
        wanted = {option: name for option, name in (("--column", column), ("--time", time)) if name is not None}
        for option, name in wanted.items():
            if name not in names:
                faults.append(f"{option}: no column {name!r} in {path}{close_to(name, names)}; allowed: {listed}")
        if len(faults) > faults_before:
            return None
        numbers = _numbers(table, {f"{option} {name}": names.index(name) for option, name in wanted.items()}, faults)
    except ValueError as error:
        faults.append(str(error))
        return None
    x, t = numbers.get(f"--column {column}"), numbers.get(f"--time {time}")
    if x is not None and (fault := _not_worth_it(x)):
        faults.append(f"--column {column}: {fault}")
    unit = "samples" if t is None and step is None else "s"
    if t is not None and len(t) > 1:
        step = float((t[-1] - t[0]) / (len(t) - 1))
        if fault := _uneven(t, step):
            faults.append(f"--time {time}: {fault}")
    if len(faults) > faults_before:
        return None
    return Record(x, 1.0 if step is None else step, unit, column, Path(path))


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

    def rows(self) -> Iterator[list[str]]:
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
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # of a file without rows
        try:
            numbers = np.loadtxt(table.lines(), delimiter=table.mark, comments=None, quotechar='"', ndmin=2)
            if numbers.shape[1] == len(table.names) and np.isfinite(numbers).all():
                return {name: numbers[:, place].copy() for name, place in places.items()}
        except (ValueError, UserWarning):  # cell by cell, to say what is wrong; other columns may hold words
            pass
    values = {name: array("d") for name in places}
    wrong: dict[tuple[str, str], list] = {}  # column and what is wrong: its first cell, and its rows
    for number, cells in enumerate(table.rows(), 1):
        for name, place in places.items():
            cell = cells[place]
            if fault := _is_no_number(cell):
                wrong.setdefault((name, fault), [cell]).append(number)
            else:
                values[name].append(float(cell))
    for name in places:
        for fault, (cell, *where) in ((fault, entry) for (column, fault), entry in wrong.items() if column == name):
            further = f" (so are {len(where) - 1} more)" if len(where) > 1 else ""
            allowed = f"finite numbers in every row; {_cure(cell, name, where)}"
            faults.append(f"{name}: row {where[0]} below the names, {cell!r}, {fault}{further}; allowed: {allowed}")
    faulty = {name for name, _ in wrong}
    return {name: np.array(values[name]) for name in places if name not in faulty}


def _is_no_number(cell: str) -> str:
    """What is wrong with a cell in the place of a finite number; "" where nothing is."""
    try:
        number = float(cell)
    except ValueError:
        return "is no number" if cell else "is empty"
    return "is no number" if "_" in cell else "" if isfinite(number) else "is not finite"  # 1_0 is 10 to Python alone


def _cure(cell: str, name: str, rows: list[int]) -> str:
    """What to do about a cell that is no number, in `rows` of its column."""
    if _CLOCK.search(cell):
        in_its_place = "; give --step SECONDS in its place" if name.startswith("--time") else ""
        return f"dates and clock times are not read{in_its_place}"
    if "," in cell:
        return "with a dot, not a comma"
    if rows == [1] and cell and not any(mark.isdigit() for mark in cell):
        return "a line of units is taken out, or begun with #"
    return "cut the record there or fill the gap"


def _not_worth_it(x: np.ndarray) -> str:
    """Why a series (n,) cannot be judged; "" where it can."""
    if len(x) < LEAST_SAMPLES:
        return f"given {len(x)} samples; allowed: {LEAST_SAMPLES} or more"
    if np.abs(x).max() > LARGEST:
        return f"values up to {np.abs(x).max():.3g}; allowed: at most {LARGEST:g} in size; take a larger unit"
    if np.ptp(x) <= 64 * np.finfo(float).eps * np.abs(x).max():
        return f"every value is {x[0]:.6g}; allowed: a series that moves"
    return ""


def _uneven(t: np.ndarray, step: float) -> str:
    """Why times (n,) are not those of an even sampling of this mean step; "" where they are."""
    forward = np.diff(t)
    if np.any(forward <= 0.0):
        k = int(np.argmax(forward <= 0.0))
        return f"{t[k + 1]:.9g} follows {t[k]:.9g} in row {k + 2}; allowed: times in seconds that increase"
    deviation = np.abs(t - t[0] - step * np.arange(len(t))).max()
    if deviation <= UNEVEN * step:
        return ""
    usual, k = np.median(forward), int(np.argmax(np.abs(forward - np.median(forward))))
    fault = f"steps of {usual:.6g} s, but of {forward[k]:.6g} s after row {k + 1}"
    if abs(forward[k] - usual) <= UNEVEN * usual:
        fault = f"steps that creep from {forward[0]:.9g} s to {forward[-1]:.9g} s"
    allowed = f"even sampling (to {UNEVEN:.0%} of a step); interpolate onto even times first"
    if deviation <= np.ptp(forward) < 0.9 * step:
        # Within one digit of the even grid, as times written with few digits are.
        allowed += f", or, where times are only rounded, give --step {step:.6g} in the place of --time"
    return f"{fault}; allowed: {allowed}"


def close_to(name: str, names: Iterable[str]) -> str:
    """ "; did you mean ...?" where a name is close to one of these, else ""."""
    close = difflib.get_close_matches(name, list(names), n=1)
    return f"; did you mean {close[0]!r}?" if close else ""


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


def _cells(path: Path, lines: Iterable[str], mark: str | None) -> Iterator[list[str]]:
    """The cells of each line."""
    if mark is None:
        yield from ([cell.strip('"') for cell in line.split()] for line in lines)
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
        if (known := next((kind for mark, kind in BINARY.items() if begin.startswith(mark)), None)) is None:
            with open(path, encoding="utf-16" if begin[:2] in UTF16 else "utf-8-sig") as file:
                for line in file:
                    if "\0" in line:
                        break
                    if (text := line.lstrip()) and not text.startswith("#"):
                        yield line
                else:
                    return
        else:
            what, cure = known
    except UnicodeDecodeError:
        pass
    except FileNotFoundError:
        folder = path.absolute().parent
        siblings = os.listdir(folder)[:1000] if os.access(folder, os.R_OK) else []
        missing_folder = "" if os.path.isdir(folder) else f", nor a folder {folder}"
        fault = f"there is no such file{missing_folder}{close_to(path.name, siblings)}"
        raise ValueError(f"{path}: {fault}; allowed: {FORMAT}") from None
    except OSError as error:
        raise ValueError(f"{path}: cannot be read: {error.strerror}; allowed: {FORMAT}") from None
    raise ValueError(f"{path}: {what}; allowed: {FORMAT} ({cure})")
