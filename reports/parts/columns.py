"""The dictionary of a campaign's table, and report tables made from it.

A campaign writes `columns.csv` beside `table.csv`: one row a column with its unit, symbol, meaning and digits. A report
takes heads, units, digits and the words of a caption from there, so that it declares none of them.
"""

import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from .content import Column, Table, sub
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
        return re.sub(r"_(\w+)", lambda match: sub(match[1]), self.symbol) or self.name.replace("_", " ")

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
            missing = entry is None or entry != entry  # nan differs from itself
            return EMPTY if missing else str(entry) or EMPTY
        value = number_of(entry)
        hidden = value != 0.0 and abs(value) < 0.5 * 10.0**-self.digits
        return number(value, 2) if hidden else decimals(value, self.digits)


def number_of(entry: object) -> float:
    """An entry of a table as a number, nan where it is empty."""
    return math.nan if entry is None or entry == "" else float(entry)


def value(row: Mapping[str, object], column: str) -> float:
    """An entry of a row of text as a number, nan where it is empty or the row has no such column."""
    return number_of(row.get(column))


def table_of(
    columns: Mapping[str, Quantity],
    names: Sequence[Name],
    rows: Iterable[Mapping[str, object]],
    caption: str,
    own_cells: Mapping[str, Callable[[Mapping[str, object]], str]] | None = None,
) -> Table:
    """A table of the named columns: heads, units, digits and the explanation of the heads from the dictionary.

    names: columns, or (value, standard error) to be set as "value ± error". rows: of `table.csv`. caption: what the
    table shows, in front of the meanings. own_cells: name -> cell of a row, in place of the entry in print.
    Raises KeyError for a name that the dictionary does not have.
    """
    own_cells = own_cells or {}
    cells, heads = {}, {}
    for name in names:
        value, error = value_and_error(name)
        quantity = columns[value]
        cells[value] = own_cells.get(value) or partial(plus_minus, columns, value=value, error=error)
        align = "left" if quantity.digits is None else "right"
        heads[value] = Column(quantity.head, quantity.unit, align)
    body = []
    for row in rows:
        body.append(tuple(cell(row) for cell in cells.values()))
    return Table(tuple(heads.values()), tuple(body), f"{caption} {explained(columns, names)}".strip(), small=True)


def value_and_error(name: Name) -> tuple[str, str]:
    """The column of a value and the column of its error, "" where it has none."""
    return (name, "") if isinstance(name, str) else name


def explained(columns: Mapping[str, Quantity], names: Sequence[Name]) -> str:
    """The heads and what they mean, in one sentence: "kA: wave steepness; r_min: least radius." """
    parts: dict[str, None] = {}  # each once, in their order
    for name in names:
        quantity = columns[value_and_error(name)[0]]
        if quantity.meaning:
            parts[f"{quantity.head}: {quantity.meaning}"] = None
    return f"{'; '.join(parts)}." if parts else ""


def plus_minus(columns: Mapping[str, Quantity], row: Mapping[str, object], value: str, error: str) -> str:
    """ "−0.039 ± 0.003", "−0.039" where `error` is "", or a dash where there is no value."""
    text = columns[value].cell(row.get(value))
    if text == EMPTY or not error:
        return text
    return f"{text}\u00a0±\u00a0{columns[value].cell(row.get(error))}"
