"""The dictionary of a campaign's table, and report tables made from it.

A campaign writes `columns.csv` beside `table.csv`: one row a column with its unit, symbol, meaning and digits. A report
takes heads, units, digits and the words of a caption from there, so that it declares none of them.
"""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from .content import Column, Table, sub
from .faults import FolderError
from .wording import EMPTY, decimals, number

HEADER = ("name", "unit", "symbol", "meaning", "digits")
Name = str | tuple[str, str]  # a column, or a value and its standard error in one column


@dataclass(frozen=True)
class Quantity:
    """One column of a campaign's table.

    symbol: its head in a report, "" for the name itself; `_` before a word makes that word a subscript. digits: places
    after the point, None for a column of words.
    """

    name: str
    unit: str = ""
    symbol: str = ""
    meaning: str = ""
    digits: int | None = None

    @property
    def head(self) -> str:
        """The symbol with its subscripts, or the name in words."""
        return re.sub(r"_(\w+)", lambda found: sub(found[1]), self.symbol) or self.name.replace("_", " ")

    @property
    def label(self) -> str:
        """The head with its unit as an axis of a figure has it, in matplotlib's mathematics."""
        symbol = re.sub(r"_(\w+)", r"$_{\\mathrm{\1}}$", self.symbol) or self.name.replace("_", " ")
        return f"{symbol} ({self.unit or '–'})"

    def cell(self, entry: object) -> str:
        """An entry of this column in print: a dash where the table is empty.

        A number that the places after the point would show as zero gets two significant digits instead.
        """
        if self.digits is None:
            text = "" if entry is None or entry != entry else str(entry)
            return text or EMPTY
        value = number_of(entry)
        hidden = value != 0.0 and abs(value) < 0.5 * 10.0**-self.digits
        return number(value, 2) if hidden else decimals(value, self.digits)


def number_of(entry: object) -> float:
    """An entry of a table as a number, nan where it is empty."""
    return math.nan if entry is None or entry == "" else float(entry)


def read_columns(directory: str | Path, table: str = "table.csv") -> dict[str, Quantity]:
    """The dictionary of a table of a folder by name, in the order of the table: columns.csv, or X_columns.csv of X.csv.

    Raises FolderError where there is none, as in folders made before there were dictionaries, or an unsound one.
    """
    name = "columns.csv" if table == "table.csv" else f"{table.removesuffix('.csv')}_columns.csv"
    try:
        with open(Path(directory, name), encoding="utf-8", newline="") as file:
            reader = csv.DictReader(file)
            if tuple(reader.fieldnames or ()) != HEADER:
                raise ValueError(f"its first line is not {','.join(HEADER)}")
            rows = list(reader)
        if any(None in row or None in row.values() for row in rows):
            raise ValueError(f"a row has not {len(HEADER)} entries")
        found = [Quantity(**{**row, "digits": int(row["digits"]) if row["digits"] else None}) for row in rows]
    except FileNotFoundError:
        fault = f"{name} is missing (made by an older version: run the command again, finished runs are found)"
        raise FolderError(Path(directory), [fault]) from None
    except (OSError, ValueError) as error:
        raise FolderError(Path(directory), [f"{name} cannot be read: {error}"]) from None
    return {column.name: column for column in found}


def table_of(
    columns: Mapping[str, Quantity],
    names: Sequence[Name],
    rows: Iterable[Mapping[str, object]],
    caption: str,
    own: Mapping[str, Callable[[Mapping[str, object]], str]] | None = None,
) -> Table:
    """A table of the named columns: heads, units, digits and the explanation of the heads from the dictionary.

    names: columns, or (value, standard error) to be set as "value ± error". rows: of `table.csv`. caption: what the
    table shows, in front of the meanings. own: name -> cell of a row, in place of the entry in print.
    Raises KeyError for a name that the dictionary does not have.
    """
    own = own or {}
    chosen = [columns[_value(name)] for name in names]
    heads = tuple(Column(one.head, one.unit, "left" if one.digits is None else "right") for one in chosen)
    body = tuple(
        tuple(own[_value(name)](row) if _value(name) in own else _cell(columns, name, row) for name in names)
        for row in rows
    )
    return Table(heads, body, f"{caption} {explained(columns, names)}".strip(), small=True)


def explained(columns: Mapping[str, Quantity], names: Sequence[Name]) -> str:
    """The heads and what they mean, in one sentence: "kA: wave steepness; r_min: least radius." """
    parts = [f"{one.head}: {one.meaning}" for name in names if (one := columns[_value(name)]).meaning]
    return f"{'; '.join(dict.fromkeys(parts))}." if parts else ""


def plus_minus(columns: Mapping[str, Quantity], row: Mapping[str, object], value: str, error: str) -> str:
    """ "−0.039 ± 0.003", or a dash where there is no value."""
    found = columns[value].cell(row.get(value))
    return found if found == EMPTY else f"{found}\u00a0±\u00a0{columns[value].cell(row.get(error))}"


def _value(name: Name) -> str:
    return name if isinstance(name, str) else name[0]


def _cell(columns: Mapping[str, Quantity], name: Name, row: Mapping[str, object]) -> str:
    return columns[name].cell(row.get(name)) if isinstance(name, str) else plus_minus(columns, row, *name)
