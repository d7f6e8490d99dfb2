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

from .content import Equation, Explorer, Figure, Listing, Picture, Report, Sheet, first_sentence, numbered, spans

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

    Sheets are on the page only: on paper they would be hundreds. Of an explorer the figure is shown.
    """
    pictures, items = {}, []
    for block in numbered(report.items):
        item = block["item"].figure if isinstance(block["item"], Explorer) else block["item"]
        if isinstance(item, Sheet):
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
                entry |= {"file": name, "first": spans(first_sentence(item.caption))}
        items.append(entry)
    for entry, following in pairwise(items):
        entry["announces"] = following["type"] in ("figure", "equation")  # a text stays with what comes next
    title = report.title
    short = title if len(title) <= _LONGEST_TITLE else title[: _LONGEST_TITLE - 1] + "…"
    return {"title": title, "short_title": short, "subtitle": report.subtitle, "items": items}, pictures


def _pieces(value: object) -> object:
    """The value for JSON: every text as its pieces (style, letters), records by the names of their fields."""
    if isinstance(value, str):
        return spans(value)
    if isinstance(value, tuple):
        return [_pieces(one) for one in value]
    if is_dataclass(value):
        shown = (field.name for field in fields(value) if not isinstance(getattr(value, field.name), Picture))
        return {name: _pieces(getattr(value, name)) for name in shown}
    return value
