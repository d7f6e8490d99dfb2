"""A column of a text file as an evenly sampled record, or every reason why it is none.

The file: columns separated by commas, semicolons, tabs or spaces, one line of names above them (a file of numbers only
has the columns 1, 2, ...), lines that begin with # left out; UTF-8, or UTF-16 with its mark, as spreadsheets export it.
"""

import contextlib
import csv
import difflib
import os
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
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
    before = len(faults)
    try:
        table = read_table(Path(path))
    except ValueError as error:
        faults.append(str(error))
        return None
    names = list(table)
    column = names[0] if column is None and len(names) == 1 else column
    listed = ", ".join(names[:40]) + (f" and {len(names) - 40} more" if len(names) > 40 else "")
    if column is None:
        faults.append(f"--column: not given; allowed: {listed}")
    elif column == time:
        faults.append(f"--column and --time: given {column!r} as both; allowed: two columns")
    numbers = {}
    for option, name in (("--column", column), ("--time", time)):
        if name in table:
            numbers[option] = _numbers(table[name], f"{option} {name}", faults)
        elif name is not None:
            faults.append(f"{option}: no column {name!r} in {path}{close_to(name, names)}; allowed: {listed}")
    x, t = numbers.get("--column"), numbers.get("--time")
    if x is not None and (fault := _not_worth_it(x)):
        faults.append(f"--column {column}: {fault}")
    unit = "samples" if t is None and step is None else "s"
    if t is not None and len(t) > 1:
        step = float((t[-1] - t[0]) / (len(t) - 1))
        if fault := _uneven(t, step):
            faults.append(f"--time {time}: {fault}")
    if len(faults) > before:
        return None
    return Record(x, 1.0 if step is None else step, unit, column, Path(path))


def _numbers(cells: Sequence[str], name: str, faults: list[str]) -> np.ndarray | None:
    """A column as floats (n,); None with a fault for each way in which cells are no finite number."""
    values, wrong = np.full(len(cells), np.nan), {}
    for k, cell in enumerate(cells):
        try:
            values[k] = float(cell)
        except ValueError:
            wrong.setdefault("is empty" if not cell else "is no number", []).append(k)
            continue
        if not np.isfinite(values[k]):
            wrong.setdefault("is not finite", []).append(k)
    for what, rows in wrong.items():
        cell = cells[rows[0]]
        more = f" (so are {len(rows) - 1} more)" if len(rows) > 1 else ""
        allowed = f"finite numbers in every row; {_cure(cell, name, rows)}"
        faults.append(f"{name}: row {rows[0] + 1} below the names, {cell!r}, {what}{more}; allowed: {allowed}")
    return None if wrong else values


def _cure(cell: str, name: str, rows: list[int]) -> str:
    """What to do about a cell that is no number, in `rows` of its column."""
    if _CLOCK.search(cell):
        in_its_place = "; give --step SECONDS in its place" if name.startswith("--time") else ""
        return f"dates and clock times are not read{in_its_place}"
    if "," in cell:
        return "with a dot, not a comma"
    if rows == [0] and cell and not any(mark.isdigit() for mark in cell):
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
    away = np.abs(t - t[0] - step * np.arange(len(t))).max()
    if away <= UNEVEN * step:
        return ""
    usual, k = np.median(forward), int(np.argmax(np.abs(forward - np.median(forward))))
    given = f"steps of {usual:.6g} s, but of {forward[k]:.6g} s after row {k + 1}"
    if abs(forward[k] - usual) <= UNEVEN * usual:
        given = f"steps that creep from {forward[0]:.9g} s to {forward[-1]:.9g} s"
    allowed = f"even sampling (to {UNEVEN:.0%} of a step); interpolate onto even times first"
    if away <= np.ptp(forward) < 0.9 * step:
        # Within one digit of the even grid, as times written with few digits are.
        allowed += f", or, where times are only rounded, give --step {step:.6g} in the place of --time"
    return f"{given}; allowed: {allowed}"


def close_to(name: str, names: Iterable[str]) -> str:
    """ "; did you mean ...?" where a name is close to one of these, else ""."""
    close = difflib.get_close_matches(name, list(names), n=1)
    return f"; did you mean {close[0]!r}?" if close else ""


def read_table(path: Path) -> dict[str, tuple[str, ...]]:
    """{name: cells (n,) of text}. Raises ValueError, with what is allowed, where the file is no table."""
    lines = [line for line in _text(path).splitlines() if line.strip() and not line.lstrip().startswith("#")]
    if not lines:
        raise ValueError(f"{path}: empty; allowed: {FORMAT}")
    mark = next((mark for mark in ("\t", ";", ",") if mark in lines[0]), None)
    try:
        if mark is None:
            rows = [[cell.strip('"') for cell in line.split()] for line in lines]
        else:
            cells = csv.reader(lines, delimiter=mark, skipinitialspace=True)
            rows = [[cell.strip() for cell in row] for row in cells]
    except csv.Error as error:
        raise ValueError(f"{path}: no table ({error}); allowed: {FORMAT}") from None
    names, *below = rows
    with contextlib.suppress(ValueError):  # a file of numbers only has no line of names
        list(map(float, names))
        names, below = [str(place + 1) for place in range(len(names))], rows
    if twice := next((name for name in names if names.count(name) > 1), None):
        raise ValueError(f"{path}: two columns are called {twice!r}; allowed: a name of its own for each")
    if fault := _ragged(names, below, mark):
        raise ValueError(f"{path}: {fault}")
    return dict(zip(names, zip(*below, strict=True), strict=True)) if below else dict.fromkeys(names, ())


def _ragged(names: list[str], rows: list[list[str]], mark: str | None) -> str:
    """The fault of the first row with more or fewer cells than there are names; "" where there is none."""
    row = next((k for k, cells in enumerate(rows) if len(cells) != len(names)), None)
    if row is None:
        return ""
    given = f"row {row + 1} below the names has {len(rows[row])} cells, the names are {len(names)}"
    if mark == "," and len(rows[row]) == 2 * len(names):
        return f"{given}; allowed: numbers with a dot, not a comma, where commas separate the columns"
    shown = ", ".join(names)
    shown = shown if len(shown) <= 60 else f"{shown[:57]}..."
    return f"{given} ({shown}); allowed: {FORMAT} (lines above it: taken out, or begun with #)"


def _text(path: Path) -> str:
    if os.path.isdir(path):
        raise ValueError(f"{path}: a folder; allowed: {FORMAT}")
    try:
        content = path.read_bytes()
    except FileNotFoundError:
        folder = path.absolute().parent
        beside = os.listdir(folder)[:1000] if os.access(folder, os.R_OK) else []
        where = "" if os.path.isdir(folder) else f", nor a folder {folder}"
        fault = f"there is no such file{where}{close_to(path.name, beside)}"
        raise ValueError(f"{path}: {fault}; allowed: {FORMAT}") from None
    except OSError as error:
        raise ValueError(f"{path}: cannot be read: {error.strerror}; allowed: {FORMAT}") from None
    foreign = ("not text in UTF-8", "of a text in another encoding: save it as UTF-8")
    what, cure = next((told for mark, told in BINARY.items() if content.startswith(mark)), foreign)
    with contextlib.suppress(UnicodeDecodeError):
        text = content.decode("utf-16" if content[:2] in UTF16 else "utf-8-sig")
        if "\0" not in text and what == foreign[0]:
            return text
    raise ValueError(f"{path}: {what}; allowed: {FORMAT} ({cure})")
