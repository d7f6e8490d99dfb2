"""Text from outside is never read as HTML or Typst."""

import pytest

from reports.parts.content import (
    Bullets,
    Column,
    Explorer,
    ExplorerColumn,
    Figure,
    Heading,
    Listing,
    Notice,
    Picture,
    Report,
    Sheet,
    Table,
    Text,
    link,
    plain,
    spans,
    sub,
)
from reports.parts.html import render_html
from reports.parts.pdf import render_pdf
from tests.reports.conftest import ODD_TITLE, Page

ODD = [
    ODD_TITLE,
    "",
    "\x00\x07\n\t\r",
    '#import "x"',
    "\\",
    '\\"',
    "$x$",
    "= no heading",
    "*/ // /*",
    "{{ 7 * 7 }}",
    "𝛉",
]
DOT = b'<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"><circle r="4"/></svg>'


def everywhere(text: str) -> Report:
    """A report that has the text in every place where text can be."""
    some = text or "x"
    column = Column(some, some, "left")
    drawing = Figure(Picture(DOT, "svg"), f"{some} caption", f"{some} alternative")
    items = [
        Heading(text), Text(text), Bullets((text, text)), Listing(text), Notice("note", text, (text,)),
        drawing, Heading(text, 2),
        Table((column, column), ((text, text),), text), Table((column,), ((text,),) * 40, text, small=True),
        Explorer(drawing, text, text, text, (ExplorerColumn(0.1, (1.0,), text, "run-1"),)),
        Sheet("run-1", text, ((text, text),), (text,), "", Table((column,), ((text,),), text)),
    ]  # fmt: skip
    return Report(text, text, tuple(items))


@pytest.mark.parametrize("text", ODD)
def test_odd_text_in_every_place_gives_both_forms(text):
    report = everywhere(text)
    assert render_pdf(report).startswith(b"%PDF")
    if "\x00" not in text:  # HTML has no way to write it
        page = Page(render_html(report).decode())
        wanted = " ".join(plain(text).split())
        assert " ".join(page.text.split()).count(wanted) >= 10


def test_an_odd_title_reaches_the_page_unchanged(page, built):
    assert ODD_TITLE in page.text
    assert built[1].read_bytes().startswith(b"%PDF")


def test_only_marks_made_here_are_marks():
    assert spans("a`b`c") == [("", "a"), ("code", "b"), ("", "c")]
    assert spans("T" + sub("i") + " `x") == [("", "T"), ("sub", "i"), ("", " `x")]
    assert plain("T" + sub("i") + " `x`") == "Ti x"
    assert spans(link("kA = 0.13", "run-7") + " of") == [("#run-7", "kA = 0.13"), ("", " of")]
