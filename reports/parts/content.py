"""What a report says, before anyone decides what it looks like.

A report is one flat list of the frozen records below. `html` and `pdf` each walk the same list, so the page and the PDF
cannot drift apart. Text is plain text: the renderers escape it. They understand some marks (`spans`): a pair of
backquotes for a file, column or key name, because captions name their columns all the time, and what `sub`, `strong`
and `link` make: subscripts, because the symbols of the paper have them, bold words, and links within the page.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

from tables import DOWN, UP, sub


@dataclass(frozen=True)
class Heading:
    """A numbered heading; level 1 opens a section and appears in the contents, level 2 divides it.

    page: whether it begins a page, in the PDF.
    """

    text: str
    level: Literal[1, 2] = 1
    page: bool = False


@dataclass(frozen=True)
class Text:
    """One paragraph."""

    text: str


@dataclass(frozen=True)
class Bullets:
    """A list of short statements."""

    lines: Sequence[str]


@dataclass(frozen=True)
class Equation:
    """A displayed equation, written once in Typst mathematics.

    `math` is the Typst source between the dollar signs, `spoken` what a screen reader says, `number` the number the
    equation carries in the 1998 paper, empty when it has none there.
    """

    math: str
    spoken: str
    number: str = ""


@dataclass(frozen=True)
class Picture:
    """The bytes of one drawing: `kind` is "svg", "png", or "gif" for one that moves."""

    data: bytes
    kind: Literal["svg", "png", "gif"]


@dataclass(frozen=True)
class Figure:
    """A drawing with its caption (what is seen, from which columns) and its description for those who cannot see it.

    `moving`: shown below `picture` on the page, in a part that can be closed; those who asked their system for less
    motion see `picture` alone. `narrow`: shown in its place on a telephone. `places`: where maps stand on each of these
    two, for `CellSheets`.
    Raises ValueError when caption or description is empty: a figure without them is not allowed into a report.
    """

    picture: Picture
    caption: str
    alt: str
    moving: Picture | None = None
    narrow: Picture | None = None
    places: tuple[tuple[MapPlace, ...], ...] = ()

    def __post_init__(self) -> None:
        if not self.caption.strip() or not self.alt.strip():
            raise ValueError("a figure needs a caption and a text alternative")


@dataclass(frozen=True)
class Head:
    """A table column: its title, the unit shown under the title ("" for none), and how its cells are set.

    `share`: of the width that the columns of sentences divide among themselves, in the PDF. `meaning`: of the title;
    the list of symbols at the end of a report has it, and the page shows it where the mouse rests on the title.
    """

    title: str
    unit: str = ""
    align: Literal["left", "right"] = "right"
    share: int = 1
    meaning: str = ""


def heads(*titles: str | tuple[str, str]) -> list[Head]:
    """Columns of a table: a title alone is one of words, set left; a title with its unit or "" is one of numbers."""
    columns = []
    for title in titles:
        if isinstance(title, str):
            columns.append(Head(title, align="left"))
        else:
            columns.append(Head(*title))
    return columns


@dataclass(frozen=True)
class Table:
    """A table of strings. `small`: in the smaller type that many columns need.

    A row of one cell is the title of a group of rows, across all columns. Raises ValueError when another row has not
    one cell for every column.
    """

    columns: Sequence[Head]
    rows: Sequence[Sequence[str]]
    caption: str
    small: bool = True

    def __post_init__(self) -> None:
        if any(len(row) not in (1, len(self.columns)) for row in self.rows):
            raise ValueError("every row of a table needs one cell for every column")


@dataclass(frozen=True)
class Notice:
    """A box that must not be overlooked: a "note" informs, a "warning" limits what the report may be used for."""

    kind: Literal["note", "warning"]
    title: str
    lines: Sequence[str]


@dataclass(frozen=True)
class Listing:
    """Text kept as it is, letter for letter: a command, a scene file."""

    text: str


@dataclass(frozen=True)
class Explorer:
    """A diagram to look around in, for a page whose reader allows scripts; there is nothing of it elsewhere.

    A diagram has columns of points over a parameter, one column a run, and curves of one value a run below.
    `x_label`, `y_label`: with units; `columns`: the runs from left to right, at least one. Each shows the `Sheet` of
    its anchor when it is chosen. `lower`: (label, values, errors) of the curves below, NaN where a run has none.
    """

    x_label: str
    y_label: str
    columns: tuple[ExplorerColumn, ...]
    lower: tuple[tuple[str, tuple[float, ...], tuple[float, ...]], ...] = ()


@dataclass(frozen=True)
class ExplorerColumn:
    """One run of an explorer: its parameter, its points (or none), its name in a list, the anchor of its sheet.

    colour: of its points, "" for that of all.
    """

    at: float
    points: tuple[float, ...]
    name: str
    anchor: str
    colour: str = ""


@dataclass(frozen=True)
class Sheet:
    """All about one run on a few square inches; the PDF shows those that are `chosen`.

    `drawing`: an <svg> element with its text alternative, made here and not from outside, in the colours of the page;
    "" for a run without a record. `facts`: (name, value); `table`: the evidence, None where there is none.
    """

    anchor: str
    title: str
    facts: Sequence[tuple[str, str]]
    lines: Sequence[str] = ()
    drawing: str = ""
    table: Table | None = None
    chosen: bool = False


class MapPlace(NamedTuple):
    """Where a map stands on a picture, in shares of it: left, top, width, height; the ends of its axes; its page."""

    place: tuple[float, float, float, float]
    ends: tuple[float, float, float, float]
    page: int = 0


@dataclass(frozen=True)
class CellSheets:
    """All about each cell of the maps on a page whose reader allows scripts; there is nothing of it elsewhere.

    heads: (name, unit) of the facts of a motion. cells: one a cell, as JSON has it: page, box (left, right, low, high),
    name, note, scales (ends of r and T), motions (letter, colour, facts, what is said, series of 0 to 999).
    """

    heads: Sequence[tuple[str, str]]
    cells: Sequence[dict]


@dataclass(frozen=True)
class Links:
    """A list of other files: what each is, and its path from the report's own folder."""

    files: Sequence[tuple[str, str]]


Item = Heading | Text | Bullets | Equation | Figure | Table | Notice | Listing | Explorer | Sheet | CellSheets | Links
Items = Iterable["Item | Items | None"]  # lists within lists; None stands for nothing


@dataclass(frozen=True)
class Report:
    """A whole report: its title, one line under it, and its items in reading order.

    What comes before the first heading is the first page; the contents follow it.
    """

    title: str
    subtitle: str
    items: Sequence[Item]


# Characters of Unicode's private area, as those of `sub`: no text from outside carries them.
_TO, _SAY, _BACK, _LOUD = "\ue002", "\ue003", "\ue004", "\ue005"
_MARKS = re.compile(
    f"`([^`\\n]+)`|{DOWN}([^{UP}]*){UP}|{_TO}([^{_SAY}]*){_SAY}([^{_BACK}]*){_BACK}|{_LOUD}([^{_BACK}]*){_BACK}"
)


def with_subscripts(text: str) -> str:
    """The text with its symbols printed: "C_dp" of plain words gets a subscript."""
    return re.sub(r"\b([A-Za-z]{1,3})_(\w{1,3})\b", lambda match: match[1] + sub(match[2]), text)


def link(text: str, anchor: str) -> str:
    """The text as a link to a place of the page; where there is no such place, in the PDF, the text alone."""
    return f"{_TO}{anchor}{_SAY}{text}{_BACK}"


def strong(text: str) -> str:
    """The text in bold type."""
    return f"{_LOUD}{text}{_BACK}"


def spans(text: str) -> list[tuple[str, str]]:
    """Split text into (style, piece), style being "", "code", "sub", "strong" or, for a link, "#" and its anchor.

    A backquote without a partner stays as written.

    >>> spans("from `time_s` on")
    [('', 'from '), ('code', 'time_s'), ('', ' on')]
    """
    pieces, at = [], 0
    for match in _MARKS.finditer(text):
        pieces.append(("", text[at : match.start()]))
        code, subscript, anchor, link_text, loud = match.groups()
        if code:
            pieces.append(("code", code))
        elif loud is not None:
            pieces.append(("strong", loud))
        elif subscript is not None:
            pieces.append(("sub", subscript))
        else:
            pieces.append((f"#{anchor}", link_text))
        at = match.end()
    pieces.append(("", text[at:]))
    return [(style, piece) for style, piece in pieces if piece]


def plain(text: str) -> str:
    """The text without its marks, for places that take letters only, such as a text alternative."""
    return "".join(piece for _, piece in spans(text))


def flat(items: Items) -> list[Item]:
    """The items in their order, without lists and without None."""
    flat_items = []
    for item in items:
        if isinstance(item, Item):
            flat_items.append(item)
        elif item is not None:
            flat_items += flat(item)
    return flat_items


def numbered(items: Iterable[Item]) -> list[dict]:
    """Every item with its kind and its number, for both renderers: headings "1", "1.1", ..., all others from 1 on."""
    counts, section, division, blocks = Counter(), 0, 0, []
    for item in items:
        kind = type(item).__name__.lower()
        counts[kind] += 1
        number = str(counts[kind])
        if isinstance(item, Heading) and item.level == 1:
            section, division = section + 1, 0
            number = str(section)
        elif isinstance(item, Heading):
            division += 1
            number = f"{section}.{division}"
        blocks.append({"kind": kind, "item": item, "number": number})
    return blocks
