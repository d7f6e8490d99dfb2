"""A table and the dictionary of its columns as files: `table.csv` and `columns.csv`, or `X.csv` and `X_columns.csv`.

A campaign writes both together. Whoever reads the table takes units, symbols, digits and meanings from the dictionary.
"""

import csv
import io
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import astuple, fields
from pathlib import Path

from engine.atomic import write_atomic
from tables.columns import Column, names

Row = dict[str, object]  # of a table, by column
Rows = Sequence[Row]
_NEEDED = ("name", "unit", "symbol", "meaning", "digits")  # of a dictionary; an older one has no page


def dictionary_path(table: Path) -> Path:
    """Where the columns of a table are explained: columns.csv for table.csv, X_columns.csv for any other X.csv."""
    if table.name == "table.csv":
        return table.with_name("columns.csv")
    return table.with_name(f"{table.stem}_columns.csv")


def dictionary(columns: Iterable[Column]) -> bytes:
    """The content of columns.csv: the fields of every column; digits are empty for a column of words."""
    return csv_of([field.name for field in fields(Column)], map(astuple, columns))


def csv_of(head: Iterable[str], rows: Iterable[Iterable[object]]) -> bytes:
    """The content of a CSV file. A byte of a file name that is no UTF-8 is written as "\\udcff"."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(head)
    writer.writerows(rows)
    return text.getvalue().encode(errors="backslashreplace")


def write_table(path: Path, columns: Sequence[Column], rows: Iterable[Row]) -> None:
    """Write the dictionary of the columns, then the rows. Raises OSError."""
    write_atomic(dictionary_path(path), dictionary(columns))
    head = names(columns)
    lines = []
    for row in rows:
        lines.append([_written(row.get(name)) for name in head])
    write_atomic(path, csv_of(head, lines))


def _written(entry: object) -> str:
    """An entry of a table: empty where it is unknown, never 0 and never the word nan."""
    if hasattr(entry, "item"):
        entry = entry.item()
    if entry is None or entry != entry:  # nan differs from itself
        return ""
    if isinstance(entry, float):
        return repr(entry)
    return " ".join(str(entry).split())


def read_rows(path: Path, needed: Iterable[str] = ()) -> list[dict[str, str]]:
    """The rows of a CSV file as they stand.

    Raises OSError; ValueError where a needed column is not there, and for a row of another length than the head.
    """
    with open(path, encoding="utf-8", newline="") as file:
        reader = csv.DictReader(file)
        try:
            rows = list(reader)
        except csv.Error as error:
            raise ValueError(str(error)) from None
    if not set(needed) <= set(reader.fieldnames or ()):
        raise ValueError(f"its first line is not {','.join(needed)}")
    for row in rows:
        if None in row or None in row.values():
            raise ValueError("a row has not as many entries as the first line")
    return rows


def any_rows(path: Path) -> list[dict[str, str]]:
    """The rows of a CSV file that may have been left out; none where it cannot be read."""
    try:
        return read_rows(path)
    except (OSError, ValueError):
        return []


def read_columns(path: Path) -> dict[str, Column]:
    """The columns that a dictionary declares, by name. Raises OSError, ValueError."""
    columns = {}
    for row in read_rows(path, _NEEDED):
        known = {field.name: row[field.name] for field in fields(Column) if field.name in row}
        known["digits"] = None
        if row["digits"]:
            known["digits"] = int(row["digits"])
        columns[row["name"]] = Column(**known)
    return columns


def read_table(path: Path) -> tuple[Row, ...]:
    """The rows of a table by its dictionary (`by_columns`). Raises OSError, ValueError."""
    return by_columns(read_rows(path), read_columns(dictionary_path(path)))


def by_columns(rows: Sequence[Mapping[str, str]], columns: Mapping[str, Column]) -> tuple[Row, ...]:
    """Rows with numbers in the columns that have digits, nan where one is empty, and words in the others.

    Raises ValueError where there is no row, for a column that is not declared, and for words in place of a number.
    """
    if not rows:
        raise ValueError("it has no rows")
    unknown = [name for name in rows[0] if name not in columns]
    if unknown:
        raise ValueError(f"columns.csv does not tell of all columns: {', '.join(unknown)}")
    table = []
    for row in rows:
        entries: Row = dict(row)
        for name, text in row.items():
            if columns[name].digits is None:
                continue
            entries[name] = float(text or math.nan)
            if text.isdecimal():
                entries[name] = int(text)
        table.append(entries)
    return tuple(table)
