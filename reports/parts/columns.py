"""Tables of a report, made from the rows of a campaign's table and from the dictionary of its columns."""

from collections.abc import Callable, Iterable, Mapping, Sequence

from tables import EMPTY, Column, errors_of

from .content import Head, Table

Columns = Mapping[str, Column]  # of a table, by name
Row = Mapping[str, object]
LONGEST = 24  # letters of a cell in a table of runs; longer sentences stay in the table of the folder
Cells = Mapping[str, Callable[[Row], str]]  # name -> cell of a row, in place of the entry in print


def table_of(
    columns: Columns, names: Iterable[str], rows: Iterable[Row], caption: str, own_cells: Cells | None = None
) -> Table:
    """A table of the named columns: heads, units, digits and the explanation of the heads from the dictionary.

    A value that has a column of errors is printed with it. caption: what the table shows, in front of the meanings.
    Raises KeyError for a name that the dictionary does not have.
    """
    cells = printed_cells(columns) | (own_cells or {})
    shown = [columns[name] for name in names]
    heads, meanings = [], {}
    for column in shown:
        heads.append(Head(column.head, column.unit, "left" if column.digits is None else "right"))
        if column.meaning:
            meanings[f"{column.head}: {column.meaning}"] = None  # each once, in their order
    body = []
    for row in rows:
        body.append(tuple(cells[column.name](row) for column in shown))
    explained = f"{'; '.join(meanings)}." if meanings else ""
    return Table(tuple(heads), tuple(body), f"{caption} {explained}".strip(), small=True)


def printed_cells(columns: Columns) -> dict[str, Callable[[Row], str]]:
    """Of each column the function of a row that gives its cell: "−0.039 ± 0.003" where another has the errors."""
    errors, cells = errors_of(columns), {}
    for name, column in columns.items():
        cells[name] = plus_minus(column, columns[errors[name]]) if name in errors else column.cell
    return cells


def plus_minus(column: Column, error: Column) -> Callable[[Row], str]:
    def cell(row: Row) -> str:
        text = column.cell(row)
        return text if text == EMPTY else f"{text}\u00a0±\u00a0{error.cell(row)}"

    return cell


def shown_on(columns: Columns, rows: Sequence[Row], *pages: str, longest: int | None = None) -> list[str]:
    """The columns of these pages, of all without one, that say something in some row; errors stand beside their values.

    longest: letters of a cell; sentences beyond that stay in the table.
    """
    errors, cells, names = set(errors_of(columns).values()), printed_cells(columns), []
    for name, column in columns.items():
        if name in errors or (pages and column.page not in pages):
            continue
        texts = {cells[name](row) for row in rows}
        if texts - {EMPTY} and (longest is None or max(map(len, texts)) <= longest):
            names.append(name)
    return names
