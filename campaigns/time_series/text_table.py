"""A text file as columns of text.

The file: columns separated by commas, semicolons, tabs or spaces, one line of names above them (a file of numbers only
has the columns 1, 2, ...), lines that begin with # left out; UTF-8, or UTF-16 with its mark, as spreadsheets export it.
"""

import csv
import difflib
import os
from collections.abc import Iterable
from pathlib import Path

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
        rows = _rows(lines, mark)
    except csv.Error as error:
        raise ValueError(f"{path}: no table ({error}); allowed: {FORMAT}") from None
    names = rows[0]
    if all(_is_number(cell) for cell in names):
        names = [str(place + 1) for place in range(len(names))]
    else:
        rows = rows[1:]
    if twice := next((name for name in names if names.count(name) > 1), None):
        raise ValueError(f"{path}: two columns are called {twice!r}; allowed: a name of its own for each")
    if fault := _ragged(names, rows, mark):
        raise ValueError(f"{path}: {fault}")
    return dict(zip(names, zip(*rows, strict=True), strict=True)) if rows else {name: () for name in names}


def _rows(lines: list[str], mark: str | None) -> list[list[str]]:
    """Cells of every line, separated by a mark, outside double quotes, or by blanks (None)."""
    if mark is None:
        return [[cell.strip('"') for cell in line.split()] for line in lines]
    return [[cell.strip() for cell in row] for row in csv.reader(lines, delimiter=mark, skipinitialspace=True)]


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
    what, cure = "not text in UTF-8", "of a text in another encoding: save it as UTF-8"
    if found := next((told for mark, told in BINARY.items() if content.startswith(mark)), None):
        what, cure = found
    else:
        try:
            text = content.decode("utf-16" if content[:2] in UTF16 else "utf-8-sig")
            if "\0" not in text:
                return text
        except UnicodeDecodeError:
            pass
    raise ValueError(f"{path}: {what}; allowed: {FORMAT} ({cure})")


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True
