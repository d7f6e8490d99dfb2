"""A report as one HTML page that needs nothing else: no network, figures and equations inside.

The one script there is, of the explorer (`templates/explorer.js`), adds to a page that says everything without it; a
report without an explorer has none.
"""

import base64
import json
import math
import re
import zlib
from collections.abc import Iterable
from dataclasses import asdict
from functools import lru_cache
from html import escape

from .content import CellSheets, Equation, Explorer, Picture, Report, numbered, plain, spans
from .selecting import entries

_MEDIA = {"svg": "image/svg+xml", "png": "image/png", "gif": "image/gif"}
_SNIPPET = """#set document(date: none)
#set page(width: auto, height: auto, margin: 2pt, fill: none)
#set text(font: "Libertinus Serif", size: 12pt)
#show math.equation: set text(font: "New Computer Modern Math")
$ {math} $
"""


def render_html(report: Report) -> bytes:
    """The page, UTF-8. Same report, same bytes; every text is escaped by the template."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

    loader = PackageLoader("reports")
    strictly = {"autoescape": True, "undefined": StrictUndefined}
    environment = Environment(loader=loader, trim_blocks=True, lstrip_blocks=True, **strictly)
    environment.globals.update(spans=spans, plain=plain, data_uri=data_uri)
    environment.globals.update(equation_svg=equation_svg, explorer_json=explorer_json, packed=packed)
    template = environment.get_template("report.html.jinja")
    blocks = numbered(report.items)
    kinds = entries(blocks, "kind")
    first = kinds.index("heading") if "heading" in kinds else len(blocks)
    return template.render(report=report, blocks=blocks, parts=(blocks[:first], blocks[first:])).encode()


def data_uri(picture: Picture) -> str:
    """The picture as the value of an img element's src: its bytes travel inside the page."""
    return f"data:{_MEDIA[picture.kind]};base64,{base64.b64encode(picture.data).decode()}"


@lru_cache(maxsize=64)
def equation_svg(equation: Equation, prefix: str) -> str:
    """The equation as an <svg> element in the colour of the surrounding text, from the Typst source that the PDF sets.

    Args: the equation; `prefix` makes the glyph ids of this equation unique in the page.
    Failure: `typst.TypstError` for source that is not Typst mathematics.
    """
    import typst

    source = _SNIPPET.format(math=equation.math).encode()
    svg = typst.compile(source, format="svg", ignore_system_fonts=True).decode()
    # In an HTML page the SVG namespace is implied; without its URL the page names no address at all.
    svg = re.sub(r'\sxmlns(:\w+)?="[^"]*"', "", svg).replace("xlink:href=", "href=")
    svg = svg.replace('"#000000"', '"currentColor"')
    svg = re.sub(r'(id="|href="#)([^"]+)"', rf'\1{prefix}-\2"', svg)
    return svg.replace("<svg ", f'<svg role="img" aria-label="{escape(equation.spoken)}" ', 1)


def explorer_json(explorer: Explorer) -> str:
    """What the explorer's script draws, as one line of JSON that may stand inside a page.

    `low` and `high` are the ends of all points; in curves of one value a run not a number becomes null.
    """
    content, every_point = asdict(explorer), []
    for column in content["columns"]:
        column["points"] = [point for point in _numbers(column["points"], 8) if point is not None]
        every_point += column["points"]
    low, high = min(every_point, default=0.0), max(every_point, default=0.0)
    content["low"], content["high"] = low, high if high > low else low + 1.0
    content["lower"] = []
    for label, values, errors in explorer.lower:
        content["lower"].append({"label": label, "values": _numbers(values), "errors": _numbers(errors)})
    # "<" would let a name end the script element that the line stands in
    return json.dumps(content, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")


def packed(sheets: CellSheets) -> str:
    """The sheets of cells as JSON, deflated, in base64: a page may have thousands."""
    text = json.dumps(sheets.cells, separators=(",", ":"), allow_nan=False)
    return base64.b64encode(zlib.compress(text.encode(), 9)).decode()


def _numbers(values: Iterable[float], digits: int = 6) -> list[float | None]:
    """The values with so many significant digits, None for what is not finite."""
    rounded = []
    for value in values:
        written = float(f"{value:.{digits}g}") if math.isfinite(value) else None
        rounded.append(written)
    return rounded
