"""Tables of a report, made from the rows of a campaign's table and from the dictionary of its columns."""

from collections.abc import Callable, Iterable, Mapping, Sequence

import numpy as np

from tables import EMPTY, Column, errors_of

from .content import Head, Table, heads
from .selecting import at, series

Columns = Mapping[str, Column]  # of a table, by name
Row = Mapping[str, object]
LONGEST_CELL = 24  # letters; a column with longer cells is left out of a table of runs, and stays in table.csv
Cells = Mapping[str, Callable[[Row], str]]  # name of a column -> the function of a row that gives its cell


def table_of(
    columns: Columns, names: Iterable[str], rows: Iterable[Row | str], caption: str, own_cells: Cells | None = None
) -> Table:
    """A table of the named columns; `columns` has their heads, units, digits and meanings.

    If a column of errors belongs to a value, the value is printed with its error. The meanings of the columns go with
    their heads. rows: a word in place of a row is the title of those that follow. own_cells: cells of some columns that
    replace the printed values. Raises KeyError for a name that `columns` does not have.
    """
    cells = printed_cells(columns) | (own_cells or {})
    shown = [columns[name] for name in names]
    titles = []
    for column in shown:
        align = "left" if column.digits is None else "right"
        titles.append(Head(column.head, column.unit, align, meaning=column.meaning))
    body = []
    for row in rows:
        if isinstance(row, str):
            body.append([row])
        else:
            body.append([cells[column.name](row) for column in shown])
    return Table(titles, body, caption)


def printed_cells(columns: Columns) -> dict[str, Callable[[Row], str]]:
    """For each column the function of a row that gives its cell; "−0.039 ± 0.003" if the column has errors."""
    errors, cells = errors_of(columns), {}
    for name, column in columns.items():
        cells[name] = plus_minus(column, columns[errors[name]]) if name in errors else column.cell
    return cells


def plus_minus(column: Column, error: Column) -> Callable[[Row], str]:
    """The function of a row that gives the value of `column` with its `error`; an empty value has no error."""

    def cell(row: Row) -> str:
        text = column.cell(row)
        return text if text == EMPTY else f"{text}\u00a0±\u00a0{error.cell(row)}"

    return cell


def shown_on(columns: Columns, rows: Sequence[Row], *pages: str, longest: int | None = None) -> list[str]:
    """The names of the columns on these pages (without pages: of all) that are filled in at least one row.

    Columns of errors are left out, because errors are printed with their values. longest: letters of a cell; a column
    with a longer cell is left out.
    """
    errors, cells, names = set(errors_of(columns).values()), printed_cells(columns), []
    for name, column in columns.items():
        if name in errors or (pages and column.page not in pages):
            continue
        texts = {cells[name](row) for row in rows}
        if texts - {EMPTY} and (longest is None or max(map(len, texts)) <= longest):
            names.append(name)
    return names


def extremes(keys: Sequence[Column], rows: Sequence[Row], shown: Iterable[Column], caption: str) -> list[Table]:
    """The least and the greatest value of every quantity, and where; nothing where no run has one."""
    cells = []
    for column in shown:
        values = series(rows, column.name)
        if not np.isfinite(values).any():
            continue
        line = [column.meaning or column.head, column.unit or EMPTY]
        for row in (rows[int(np.nanargmin(values))], rows[int(np.nanargmax(values))]):
            line += [column.cell(row), at(keys, row)]
        cells.append(line)
    columns = heads("quantity", "unit", ("least", ""), "at", ("greatest", ""), "at")
    if not cells:
        return []
    return [Table(columns, cells, caption)]
