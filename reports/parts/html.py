"""A report as one HTML page that needs nothing else: no network, figures and equations inside.

The one script there is, of the explorer (`templates/explorer.js`), adds to a page that says everything without it; a
report without an explorer has none.
"""

from __future__ import annotations

import base64
import json
import math
import re
from functools import lru_cache
from html import escape

import numpy as np

from .content import Equation, Explorer, Picture, Report, first_sentence, numbered, plain, spans

_MEDIA = {"svg": "image/svg+xml", "png": "image/png", "gif": "image/gif"}
_STEPS = 65535  # of the value axis of an explorer: a point is 2 bytes, 400 columns of 200 points 160 kB
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
    environment.globals.update(spans=spans, plain=plain, data_uri=data_uri, first_sentence=first_sentence)
    environment.globals.update(equation_svg=equation_svg, explorer_json=explorer_json)
    template = environment.get_template("report.html.jinja")
    return template.render(report=report, blocks=numbered(report.items)).encode()


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

    Columns have their parameter, name, anchor and number of points; the points follow as little-endian 16-bit numbers.
    A point v is round(65535 (v - low)/(high - low)), low and high the ends of all points; not a number becomes null.
    """
    points = [np.asarray(column.points, dtype=float) for column in explorer.columns]
    points = [values[np.isfinite(values)] for values in points]
    everything = np.concatenate([*points, np.empty(0)])
    low, high = (float(everything.min()), float(everything.max())) if everything.size else (0.0, 1.0)
    high = high if high > low else low + 1.0
    steps = np.rint((everything - low) / (high - low) * _STEPS).astype("<u2")
    content = {
        "x_label": explorer.x_label,
        "y_label": explorer.y_label,
        "low": low,
        "high": high,
        "columns": [
            {"at": column.at, "name": column.name, "anchor": column.anchor, "points": len(values)}
            for column, values in zip(explorer.columns, points, strict=True)
        ],
        "lower": [
            {"label": label, "values": _numbers(values), "errors": _numbers(errors)}
            for label, values, errors in explorer.lower
        ],
        "points": base64.b64encode(steps.tobytes()).decode(),
    }
    # "<" would let a name end the script element that the line stands in
    return json.dumps(content, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")


def _numbers(values) -> list[float | None]:
    return [float(f"{value:.6g}") if math.isfinite(value) else None for value in values]
