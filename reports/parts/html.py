"""A report as one HTML page that needs nothing else: no network, figures and equations inside.

The one script there is, of the explorer (`templates/explorer.js`), adds to a page that says everything without it; a
report without an explorer has none.
"""

from __future__ import annotations

import base64

from .content import (
    Equation,
    Explorer,
    Figure,
    Heading,
    Picture,
    Report,
    Table,
    first_sentence,
    plain,
    section_ids,
    spans,
)
from .equations import equation_svg
from .explorer_data import explorer_json

_MEDIA = {"svg": "image/svg+xml", "png": "image/png", "gif": "image/gif"}


def render_html(report: Report) -> bytes:
    """The page, UTF-8. Same report, same bytes; every text is escaped by the template."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

    environment = Environment(
        loader=PackageLoader("reports"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.globals.update(spans=spans, plain=plain, data_uri=data_uri)
    environment.globals.update(equation_svg=equation_svg, explorer_json=explorer_json, first_sentence=first_sentence)
    template = environment.get_template("report.html.jinja")
    return template.render(report=report, blocks=_numbered(report)).encode()


def data_uri(picture: Picture) -> str:
    """The picture as the value of an img element's src: its bytes travel inside the page."""
    return f"data:{_MEDIA[picture.kind]};base64,{base64.b64encode(picture.data).decode()}"


def _numbered(report: Report) -> list[dict]:
    """The items with the names and numbers the template needs: kind, item, section, figure and table numbers."""
    sections, counts, blocks = section_ids(report.items), {}, []
    for index, item in enumerate(report.items):
        kind = type(item).__name__.lower()
        number = None
        if isinstance(item, Heading):
            number = sections[index]
        elif isinstance(item, (Figure, Explorer, Table, Equation)):
            counted = "figure" if isinstance(item, Explorer) else kind
            number = counts[counted] = counts.get(counted, 0) + 1
        blocks.append({"kind": kind, "item": item, "number": number})
    return blocks
