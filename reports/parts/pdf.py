"""A report as a PDF, set by Typst from the fonts inside its wheel, so that the bytes do not depend on the machine.

`templates/report.typ` is the same for every report. It reads the items from JSON, so that no text is ever Typst source:
a scene called `#$*_<@` stays what it is. Only equations are evaluated.
"""

import json
import tempfile
from dataclasses import fields, is_dataclass
from importlib.resources import files
from itertools import pairwise
from pathlib import Path

from .content import CellSheets, Equation, Explorer, Figure, Listing, Picture, Report, Sheet, numbered, spans

_LONGEST_TITLE = 90  # letters above a page


def render_pdf(report: Report) -> bytes:
    """The PDF. Same report, same bytes; works without a network.

    Failure: `typst.TypstError` when an equation is not Typst mathematics; other text cannot make it fail.
    """
    import typst

    content, pictures = typst_data(report)
    template = files("reports").joinpath("templates/report.typ").read_bytes()
    # Through a folder: the in-memory form of the binding takes text files only, and a PNG is none.
    with tempfile.TemporaryDirectory() as folder:
        written = {"main.typ": template, "report.json": json.dumps(content).encode(), **pictures}
        for name, data in written.items():
            Path(folder, name).write_bytes(data)
        return typst.compile(Path(folder, "main.typ"), root=folder, format="pdf", ignore_system_fonts=True)


def typst_data(report: Report) -> tuple[dict, dict[str, bytes]]:
    """What the template reads: the report as JSON has it, and the pictures it names, by file name.

    Explorer and sheets of cells are on the page only, and so are sheets that are not chosen: on paper they would be
    hundreds.
    """
    pictures, items = {}, []
    for block in numbered(report.items):
        item = block["item"]
        if isinstance(item, Explorer | CellSheets) or (isinstance(item, Sheet) and not item.chosen):
            continue
        entry = {**_pieces(item), "type": type(item).__name__.lower(), "number": block["number"]}
        match item:
            case Equation():
                entry |= {"math": item.math, "number": item.number}
            case Listing():
                entry["text"] = item.text
            case Figure():
                name = f"figure-{len(pictures) + 1}.{item.picture.kind}"
                pictures[name] = item.picture.data
                entry["file"] = name
            case Sheet() if item.drawing:
                name = f"sheet-{block['number']}.svg"
                pictures[name] = standalone(item.drawing)
                entry["file"] = name
        items.append(entry)
    for entry, following in pairwise(items):
        entry["announces"] = following["type"] in ("figure", "equation")  # a text stays with what comes next
    title = report.title
    short = title if len(title) <= _LONGEST_TITLE else title[: _LONGEST_TITLE - 1] + "…"
    return {"title": title, "short_title": short, "subtitle": report.subtitle, "items": items}, pictures


def standalone(drawing: str) -> bytes:
    """The drawing of a sheet as a file of its own: in ink, with the look that the page's style sheet gives it there."""
    look = files("reports").joinpath("templates/sheet.css").read_text(encoding="utf-8")
    return (
        drawing.replace("<svg ", '<svg xmlns="http://www.w3.org/2000/svg" ', 1)
        .replace(">", f"><style>{look}</style>", 1)
        .encode()
    )


def _pieces(value: object) -> object:
    """The value for JSON: every text as its pieces (style, letters), records by the names of their fields."""
    if isinstance(value, str):
        return spans(value)
    if isinstance(value, tuple | list):
        return [_pieces(entry) for entry in value]
    if is_dataclass(value):
        pieces = {}
        for field in fields(value):
            content = getattr(value, field.name)
            if not isinstance(content, Picture):
                pieces[field.name] = _pieces(content)
        return pieces
    return value
