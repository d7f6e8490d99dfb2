"""The files of a report: the same bytes each time, a PDF with contents and links, of a size to send, quickly made."""

import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

import matplotlib
import pandas
import pytest

from reports import build
from reports.buoy_sweep.report import report
from reports.parts.content import Explorer, Figure, Heading, Notice, Report, Text, first_sentence, plain
from reports.parts.pdf import render_pdf
from tests.reports.conftest import campaign

ROOT = Path(__file__).parents[2]
LINK = re.compile(rb"/Subtype ?/Link\b")
needs_pdftotext = pytest.mark.skipif(shutil.which("pdftotext") is None, reason="no pdftotext to read the PDF with")


def words_of(pdf, *options):
    """The words of a PDF, pages apart by a form feed."""
    return subprocess.run(["pdftotext", *options, pdf, "-"], capture_output=True, check=True).stdout.decode()


@pytest.mark.slow
def test_a_copy_elsewhere_in_another_process_gives_the_same_bytes(folder, built, tmp_path):
    copy = shutil.copytree(folder, tmp_path / "elsewhere", ignore=shutil.ignore_patterns("report.*"))
    environment = {**os.environ, "PYTHONHASHSEED": "77", "TZ": "Asia/Tokyo", "SOURCE_DATE_EPOCH": "1"}
    subprocess.run([sys.executable, "-m", "reports", str(copy)], cwd=ROOT, env=environment, check=True)
    for path in built:
        assert (copy / path.name).read_bytes() == path.read_bytes()


@pytest.mark.slow
def test_the_reader_s_own_figure_settings_do_not_count_and_stay(folder, built):
    before = [path.read_bytes() for path in built]
    with matplotlib.rc_context({"lines.linewidth": 7.0, "svg.fonttype": "none", "font.size": 20.0}):
        build(folder)
        assert matplotlib.rcParams["lines.linewidth"] == 7.0
    assert [path.read_bytes() for path in built] == before


@pytest.mark.slow
def test_sixty_long_runs_within_fifteen_seconds_of_processor_and_ten_megabytes(tmp_path):
    steepness = [round(0.01 + 0.0025 * k, 4) for k in range(60)]
    folder = campaign(tmp_path / "out", steepness, periods=300, transient=100)
    start = time.process_time()
    paths = build(folder)
    assert time.process_time() - start < 15.0
    assert all(path.stat().st_size < 10e6 for path in paths)


@pytest.mark.slow
def test_four_hundred_runs_with_their_evidence_make_files_of_less_than_ten_megabytes(tmp_path):
    place = campaign(tmp_path / "many", [round(0.1 + 0.0001 * k, 4) for k in range(400)])
    evidence = "; ".join(f"name of a test, halves {k}: 0.123/0.456/yes" for k in range(13))
    table = pandas.read_csv(place / "table.csv", dtype=str)
    table.assign(evidence=evidence).to_csv(place / "table.csv", index=False)
    html, pdf = build(place)
    assert html.read_text(encoding="utf-8").count('<section class="sheet"') == 400
    assert html.stat().st_size < 9e6 and pdf.stat().st_size < 10e6, "room for a moving picture is left"


@pytest.mark.slow
@needs_pdftotext
def test_the_pdf_opens_with_every_section_and_figure_as_links(folder, built):
    items = report(folder).items
    first, second = (" ".join(words_of(built[1], "-f", page, "-l", page).split()) for page in "12")
    headings = [plain(item.text) for item in items if isinstance(item, Heading)]
    figures = sum(isinstance(item, (Figure, Explorer)) for item in items)
    assert first.index("Contents") < first.index(headings[0]) and all(heading in first for heading in headings)
    assert all(f"Figure {number} " in first for number in range(1, figures + 1))
    assert second.startswith("Tethered buoy") and headings[0] in second and "2 / " in second
    everything = words_of(built[1])
    assert all(f"Figure {number}:" in everything for number in range(1, figures + 1)), "each under its figure"
    document = built[1].read_bytes()
    assert len(LINK.findall(document)) >= len(headings) + figures and b"/Outlines" in document


@pytest.mark.slow
@needs_pdftotext
def test_the_title_of_a_notice_stays_with_its_first_line(tmp_path):
    """Eighty notices at as many heights of a page."""
    items = []
    for k in range(80):
        between = [Text(f"Between, {j}.") for j in range(k % 7)]
        items += [*between, Notice("warning", f"Title {k}.", (f"Line {k}.", "b"))]
    (tmp_path / "a.pdf").write_bytes(render_pdf(Report("a", "b", tuple(items))))
    pages = words_of(tmp_path / "a.pdf").split("\f")
    assert len(pages) > 8
    for k in range(80):
        (place,) = (page for page in pages if f"Title {k}." in page)
        assert f"Line {k}." in place


@pytest.mark.parametrize(
    ("caption", "said"),
    [
        ("Radius at t = 0.5 s. From `a.csv`.", "Radius at t = 0.5 s"),
        ("Tension (fig. 9) over t: up to 3 N.", "Tension (fig. 9) over t"),
        ("From `a: b` on; then", "From `a: b` on"),
        ("Runs in space (D = 3; see fig. 2). loops: of each", "Runs in space (D = 3; see fig. 2)"),
        ("By Wolf et al. against t. From", "By Wolf et al. against t"),
        ("Fig. 9 of the paper, tension (line). From", "Fig. 9 of the paper, tension (line)"),
        ("One", "One"),
    ],
)
def test_a_list_of_figures_takes_the_first_sentence(caption, said):
    assert first_sentence(caption) == said
