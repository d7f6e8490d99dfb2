"""The PDF opens at its contents, every line of which is a link, and stays of a size to send."""

import re
import shutil
import subprocess

import pytest

from reports.buoy_sweep.report import report
from reports.parts.content import Explorer, Figure, Heading, Notice, Report, Text, plain
from reports.parts.pdf import render_pdf

pytestmark = pytest.mark.slow
LINK = re.compile(rb"/Subtype ?/Link\b")


@pytest.fixture(scope="module")
def content(folder):
    return report(folder)


@pytest.mark.skipif(shutil.which("pdftotext") is None, reason="no pdftotext to read the PDF with")
def test_the_first_page_lists_every_section_and_figure(content, built):
    def text(*options):
        words = subprocess.run(["pdftotext", *options, built[1], "-"], capture_output=True, check=True).stdout
        return " ".join(words.decode().split())

    first, second = text("-f", "1", "-l", "1"), text("-f", "2", "-l", "2")
    headings = [plain(item.text) for item in content.items if isinstance(item, Heading)]
    assert first.index("Contents") < first.index(headings[0]) and all(heading in first for heading in headings)
    figures = [item for item in content.items if isinstance(item, (Figure, Explorer))]
    assert all(f"Figure {number} " in first for number in range(1, len(figures) + 1))
    assert second.startswith("Tethered buoy") and headings[0] in second and "2 / " in second
    assert all(f"Figure {number}:" in text() for number in range(1, len(figures) + 1)), "each under its figure"


@pytest.mark.skipif(shutil.which("pdftotext") is None, reason="no pdftotext to read the PDF with")
def test_the_title_of_a_notice_stays_with_its_first_line(tmp_path):
    """Eighty notices at as many heights of a page."""
    items = []
    for k in range(80):
        items += [
            *[Text(f"Between, {j}.") for j in range(k % 7)],
            Notice("warning", f"Title {k}.", (f"Line {k}.", "b")),
        ]
    (tmp_path / "a.pdf").write_bytes(render_pdf(Report("a", "b", tuple(items))))
    text = subprocess.run(["pdftotext", tmp_path / "a.pdf", "-"], capture_output=True, check=True).stdout.decode()
    pages = text.split("\f")
    assert len(pages) > 8
    for k in range(80):
        (place,) = (page for page in pages if f"Title {k}." in page)
        assert f"Line {k}." in place


def test_contents_are_links_and_headings_are_bookmarks(content, built):
    document = built[1].read_bytes()
    lines = sum(isinstance(item, (Heading, Figure, Explorer)) for item in content.items)
    assert len(LINK.findall(document)) >= lines and b"/Outlines" in document
