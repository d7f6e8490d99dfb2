"""A report as a PDF, set by Typst from the fonts inside its wheel, so that the bytes do not depend on the machine.

Every text reaches Typst as a string literal in code mode (`quote`), never as markup: a scene called `#$*_<@` stays what
it is. Only the equations and the preamble below are Typst markup.
"""

from __future__ import annotations

import tempfile
from itertools import zip_longest
from pathlib import Path

from .content import (
    Bullets,
    Equation,
    Explorer,
    Figure,
    Heading,
    Item,
    Links,
    Listing,
    Notice,
    Report,
    Sheet,
    Table,
    Text,
    first_sentence,
    plain,
    section_ids,
    spans,
)

_PREAMBLE = """\
#set document(title: {title}, date: none)
#set page(paper: "a4", margin: (x: 2.1cm, top: 2.2cm, bottom: 2.2cm), numbering: "1 / 1",
  header: context if counter(page).get().first() > 1 {{
    set text(size: 8pt, fill: luma(90)); {short_title}; v(-0.6em); line(length: 100%, stroke: 0.4pt + luma(180)) }})
#set text(font: "Libertinus Serif", size: 10.5pt, lang: "en", hyphenate: true)
#show math.equation: set text(font: "New Computer Modern Math")
#show raw: set text(font: "DejaVu Sans Mono", size: 0.85em)
#set par(justify: true, leading: 0.62em)
#show heading.where(level: 1): set block(above: 1.8em, below: 0.9em)
#show heading.where(level: 2): set block(above: 1.4em, below: 0.7em)
#show heading: set text(fill: rgb("#0b3c5d"))
#show figure.caption: set text(size: 9pt)
#show figure.caption: set align(left)
#show figure.caption: set par(justify: false)
#show figure.where(kind: table): set figure.caption(position: top)
#show figure.caption.where(kind: table): set block(sticky: true)
#set figure(gap: 0.8em)
#let notice(colour, paper, title, lines) = block(width: 100%, fill: paper, stroke: (left: 2.5pt + colour),
  inset: (x: 0.9em, y: 0.7em), breakable: true)[
  #block(sticky: true, below: 0.65em, text(weight: "bold", fill: colour, title)) #list(..lines)]
#align(left)[#text(size: 21pt, weight: "bold", fill: rgb("#0b3c5d"), {title})]
#v(-0.6em)
#text(fill: luma(70), {subtitle})
#v(1em)
#outline(title: [Contents], depth: 2, indent: 1.2em)
"""
# A list of figures shows the first sentence of each caption; `shown` is on while one is set.
_FIGURES = """\
#let shown = state("list-of-figures", false)
#let said(whole, short) = context if shown.get() { short } else { whole }
#shown.update(true)
#outline(title: [Figures], target: figure.where(kind: image))
#shown.update(false)
"""
_SHORT_TABLE = 12  # rows up to which a table is kept on one page
_COLOURS = {"note": ('rgb("#0b5c94")', 'rgb("#eef4f9")'), "warning": ('rgb("#9a4a00")', 'rgb("#fff4e5")')}


def render_pdf(report: Report) -> bytes:
    """The PDF. Same report, same bytes; works without a network.

    Failure: `typst.TypstError` when an equation is not Typst mathematics; other text cannot make it fail.
    """
    import typst

    source, pictures = typst_source(report)
    # Through a folder: the in-memory form of the binding takes text files only, and a PNG is none.
    with tempfile.TemporaryDirectory() as folder:
        for name, content in {"main.typ": source.encode(), **pictures}.items():
            Path(folder, name).write_bytes(content)
        return typst.compile(Path(folder, "main.typ"), root=folder, format="pdf", ignore_system_fonts=True)


def typst_source(report: Report) -> tuple[str, dict[str, bytes]]:
    """The Typst document and the pictures it names, by file name."""
    sections = section_ids(report.items)
    pictures: dict[str, bytes] = {}
    parts = [
        _PREAMBLE.format(
            title=quote(report.title), short_title=quote(_short(report.title)), subtitle=quote(report.subtitle)
        )
    ]
    if any(isinstance(item, (Figure, Explorer)) for item in report.items):
        parts.append(_FIGURES)
    parts.append("#pagebreak(weak: true)")
    for index, (item, following) in enumerate(zip_longest(report.items, report.items[1:])):
        if isinstance(item, Sheet):
            continue  # the page has a sheet for every run; on paper they would be hundreds
        if isinstance(item, Explorer):
            item = item.figure
        if isinstance(item, Figure):
            name = f"figure-{len(pictures) + 1}.{item.picture.kind}"
            pictures[name] = item.picture.data
            parts.append(_figure(item, name))
        elif isinstance(item, Heading):
            parts.append(f"#heading(level: {item.level}, {_inline(f'{sections[index]}  {item.text}')})")
        elif isinstance(item, Text) and isinstance(following, (Figure, Equation)):
            parts.append(f"#block(sticky: true, {_block(item).removeprefix('#')})")  # stays with what it announces
        else:
            parts.append(_block(item))
    return "\n\n".join(parts) + "\n", pictures


def quote(text: str) -> str:
    """The text as a Typst string literal: nothing inside it is read as markup or code.

    >>> print(quote('a "b" \\\\ #c'))
    "a \\"b\\" \\\\ #c"
    """
    table = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\t": "\\t", "\r": "\\r"}
    return '"' + "".join(table.get(c) or (c if c.isprintable() else f"\\u{{{ord(c):x}}}") for c in text) + '"'


def _inline(text: str) -> str:
    """A Typst content expression for text with `code` spans."""
    forms = {"": "text", "code": "raw", "sub": "sub"}
    # the places that links lead to are on the page only
    pieces = [f"{forms.get(style, 'text')}({quote(piece)})" for style, piece in spans(text)]
    return " + ".join(pieces) or '""'


def _block(item: Item) -> str:
    match item:
        case Text():
            return f"#par({_inline(item.text)})"
        case Bullets():
            return f"#list({', '.join(_inline(line) for line in item.lines)})"
        case Equation():
            number = f"_ => text(size: 9pt, {quote(f'eq. ({item.number})')})" if item.number else "none"
            return f"#[#set math.equation(numbering: {number}, alt: {quote(item.spoken)})\n$ {item.math} $]"
        case Table():
            return _table(item)
        case Notice():
            colour, paper = _COLOURS[item.kind]
            lines = "".join(f"{_inline(line)}, " for line in item.lines)
            return f"#notice({colour}, {paper}, {_inline(item.title)}, ({lines}))"
        case Links():
            return f"#list({', '.join(_inline(f'{name}: `{path}`') for name, path in item.files)})"
        case Listing():
            return (
                f"#block(fill: luma(245), inset: 0.7em, width: 100%, breakable: true, "
                f"raw({quote(item.text)}, block: true))"
            )
    raise TypeError(f"no PDF form for {type(item).__name__}")


def _figure(item: Figure, name: str) -> str:
    image = f"image({quote(name)}, width: 100%, alt: {quote(plain(item.alt))})"
    caption = f"said({_inline(item.caption)}, {_inline(first_sentence(item.caption))})"
    return f"#figure({image}, caption: {caption})"


def _table(item: Table) -> str:
    """A table with a header that comes back on every page it runs over."""
    size, inset = ("7.5pt", "(x: 2.6pt, y: 2.8pt)") if item.small else ("9pt", "(x: 5pt, y: 3.4pt)")
    shares = (f"{column.share}fr" if _is_prose(item, i) else "auto" for i, column in enumerate(item.columns))
    widths = ", ".join(shares)
    aligns = ", ".join(column.align for column in item.columns)
    header = ", ".join(
        f'[#text(weight: "bold", {_inline(column.title)})'
        + (f" \\ #{{ {_inline(column.unit)} }}" if column.unit else "")
        + "]"
        for column in item.columns
    )
    cells = "\n".join("  " + ", ".join(_cell(cell) for cell in row) + "," for row in item.rows)
    whole = "false" if len(item.rows) <= _SHORT_TABLE else "true"
    return (
        f"#[#show figure: set block(breakable: {whole})\n#figure(kind: table, caption: {_inline(item.caption)}, {{ "
        f"set text(size: {size}); set par(justify: false)\n"
        f"table(columns: ({widths},), align: ({aligns},), inset: {inset}, stroke: none, "
        "fill: (_, y) => if y > 0 and calc.even(y) { luma(246) },\n"
        f"  table.hline(), table.header({header}, table.hline(stroke: 0.5pt)),\n{cells}\n  table.hline()) }})]"
    )


def _cell(text: str) -> str:
    return f"[#{{ {_inline(text)} }}]"


def _is_prose(table: Table, index: int) -> bool:
    """Columns of sentences share the width that is left; columns of numbers and names take what they need."""
    cells = [row[index] for row in table.rows]
    return table.columns[index].align == "left" and any(len(cell) > 40 and " " in cell for cell in cells)


def _short(title: str) -> str:
    return title if len(title) <= 90 else title[:89] + "…"
