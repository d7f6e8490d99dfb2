"""The equations of a report as inline SVG: the very Typst source the PDF sets, so that there is one source for both."""

from __future__ import annotations

import re
from functools import lru_cache

from .content import Equation

_SNIPPET = """#set document(date: none)
#set page(width: auto, height: auto, margin: 2pt, fill: none)
#set text(font: "Libertinus Serif", size: 12pt)
#show math.equation: set text(font: "New Computer Modern Math")
$ {math} $
"""


@lru_cache(maxsize=64)
def equation_svg(equation: Equation, prefix: str) -> str:
    """The equation as an <svg> element for an HTML page, in the colour of the surrounding text.

    Args: the equation; `prefix` makes the glyph ids of this equation unique in the page.
    Failure: `typst.TypstError` for source that is not Typst mathematics.
    """
    import typst

    source = _SNIPPET.format(math=equation.math).encode()
    svg = typst.compile(source, format="svg", ignore_system_fonts=True).decode()
    # In an HTML page the SVG namespace is implied; without its URL the page names no address at all.
    svg = re.sub(r'\sxmlns(:\w+)?="[^"]*"', "", svg).replace("xlink:href=", "href=")
    svg = svg.replace('"#000000"', '"currentColor"')
    svg = re.sub(r'id="([^"]+)"', rf'id="{prefix}-\1"', svg)
    svg = re.sub(r'href="#([^"]+)"', rf'href="#{prefix}-\1"', svg)
    label = equation.spoken.replace("&", "&amp;").replace('"', "&quot;").replace("<", "&lt;")
    return svg.replace("<svg ", f'<svg role="img" aria-label="{label}" ', 1)
