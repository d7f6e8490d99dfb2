"""The files of a report: the same bytes each time, a PDF with contents and links, of a size to send, quickly made; and
folders that a sweep can leave behind when things go wrong, which still give a report that says so.
"""

import json
import re
import shutil
import subprocess

import matplotlib
import numpy as np
import pandas
import pytest

from campaigns.accuracy.rows import COLUMNS as of_accuracy
from campaigns.explore.rows import COLUMNS as of_a_buoy
from campaigns.out_of_plane.rows import COLUMNS as of_plane
from reports import build, content_of
from reports.__main__ import main
from reports.buoy_sweep.report import report
from reports.parts.content import Bullets, Figure, Heading, Notice, Picture, Report, Sheet, Text, plain
from reports.parts.folder import Folder
from reports.parts.pdf import render_pdf
from tables import read_rows
from tests.processes import OTHERWISE, python
from tests.reports.conftest import campaign, folder_at, of_kind, warned

LINK, PAGE = re.compile(rb"/Subtype ?/Link\b"), re.compile(rb"/Type ?/Page\b")
needs_pdftotext = pytest.mark.skipif(shutil.which("pdftotext") is None, reason="no pdftotext to read the PDF with")


def words_of(pdf, *options):
    """The words of a PDF, pages apart by a form feed."""
    return subprocess.run(["pdftotext", *options, pdf, "-"], capture_output=True, check=True).stdout.decode()


@pytest.mark.slow
def test_a_copy_elsewhere_in_another_process_gives_the_same_bytes(folder, built, tmp_path):
    copy = shutil.copytree(folder, tmp_path / "elsewhere", ignore=shutil.ignore_patterns("report.*"))
    assert python("-m", "reports", copy, **OTHERWISE).returncode == 0
    for path in built:
        assert (copy / path.name).read_bytes() == path.read_bytes()


@pytest.mark.slow
def test_the_reader_s_own_figure_settings_do_not_count_and_stay(folder, built):
    contents = [path.read_bytes() for path in built]
    with matplotlib.rc_context({"lines.linewidth": 7.0, "svg.fonttype": "none", "font.size": 20.0}):
        build(folder, again=True)
        assert matplotlib.rcParams["lines.linewidth"] == 7.0
    assert [path.read_bytes() for path in built] == contents


def sizes_of(place, count):
    """Bytes of the page and of the PDF of so many runs with all their evidence."""
    campaign(place, [round(0.1 + 0.0001 * k, 4) for k in range(count)])
    evidence = "; ".join(f"name of a test, halves {k}: 0.123/0.456/yes" for k in range(13))
    table = pandas.read_csv(place / "table.csv", dtype=str)
    table.assign(evidence=evidence).to_csv(place / "table.csv", index=False)
    html, pdf = build(place)
    assert html.read_text(encoding="utf-8").count('<details class="sheet"') == count
    return np.array([html.stat().st_size, pdf.stat().st_size])


@pytest.mark.slow
def test_four_hundred_runs_with_their_evidence_make_files_of_less_than_ten_megabytes(tmp_path):
    """By what eighty runs add to twenty."""
    few, many = sizes_of(tmp_path / "few", 20), sizes_of(tmp_path / "many", 100)
    html, pdf = few + 380 / 80 * (many - few)
    assert html < 9e6 and pdf < 10e6, "room for a moving picture is left"


@pytest.mark.slow
@needs_pdftotext
def test_the_pdf_opens_with_the_answer_and_its_figure_and_lists_every_section_after_them(folder, built):
    items, everything = content_of(folder)[0].items, words_of(built[1])
    first, second = (" ".join(page.split()) for page in everything.split("\f")[:2])
    headings = [plain(heading.text) for heading in of_kind(items, Heading)]
    answer = (folder / "answer.txt").read_text(encoding="utf-8").splitlines()
    for line in answer:
        assert " ".join(line.split(":")[0].split()) in first
    assert "It took" in first and "Figure 1:" in first
    assert everything.index("Figure 1:") < everything.index("Contents") < everything.index(headings[0])
    assert second.startswith("Tethered buoy") and re.search(r"2 ?/ ?\d", second)
    figures = len(of_kind(items, Figure))
    assert all(f"Figure {number}:" in everything for number in range(1, figures + 1)), "each under its figure"
    document = built[1].read_bytes()
    assert len(LINK.findall(document)) >= len(headings) and b"/Outlines" in document


@pytest.mark.slow
@needs_pdftotext
def test_the_title_of_a_notice_stays_with_its_first_line(tmp_path):
    """Eighty notices at as many heights of a page."""
    items = []
    for k in range(80):
        items += [Text("Between.")] * (k % 7) + [Notice("warning", f"Title {k}.", (f"Line {k}.", "b"))]
    (tmp_path / "a.pdf").write_bytes(render_pdf(Report("a", "b", tuple(items))))
    pages = words_of(tmp_path / "a.pdf").split("\f")
    assert len(pages) > 8
    for page in pages:
        assert re.findall(r"Title (\d+)\.", page) == re.findall(r"Line (\d+)\.", page)


@pytest.mark.parametrize("height", [110, 140])
def test_the_first_picture_shrinks_to_the_page_of_the_answer(height):
    """Over the whole width a picture of 100 by 140 would not fit there; the contents are on the second page."""
    drawn = f'<svg xmlns="http://www.w3.org/2000/svg" width="100" height="{height}"><rect width="9" height="9"/></svg>'
    figure = Figure(Picture(drawn.encode(), "svg"), "A caption.", "d")
    items = (Bullets(("An answer of a line or two, as they are. " * 4,) * 6), Text("It took 2 s."), figure)
    assert len(PAGE.findall(render_pdf(Report("a", "b", items)))) == 2


def content(folder):
    """What a report says in its boxes, its bullets and its sheets, and the number of its figures."""
    items = report(folder).items
    sheets = [line for sheet in of_kind(items, Sheet) for line in sheet.lines]
    return warned(items), sheets, len(of_kind(items, Figure))


def test_runs_that_failed_are_named_with_their_reason_and_message_which_is_told_once(tmp_path):
    failing = dict.fromkeys([0.1, 0.11, 0.12], ("newton-failed", 0)) | {0.13: ("statics-failed", 0.004)}
    boxes, sheets, figures = content(campaign(tmp_path / "out", list(failing), failing=failing))
    lines = [line for line in boxes if "did not converge" in line]
    assert "newton-failed" in lines[1] and lines[1].endswith("kA = 0.1 to 0.12.")
    assert "statics-failed" in lines[0] and lines[0].endswith("kA = 0.13.") and len(lines) == 2
    assert figures == 0 and sum("did not converge" in line for line in sheets) == 4


def test_a_single_short_run_gives_a_report(tmp_path):
    boxes, _, figures = content(campaign(tmp_path / "out", [0.13], periods=6, transient=2))
    assert figures >= 2 and boxes


def test_a_damaged_a_missing_and_a_strange_trajectory_cost_only_themselves(tmp_path):
    folder = campaign(tmp_path / "out", [0.016, 0.05, 0.08, 0.13], periods=30, transient=5)
    files = [folder / "trajectories" / f"{row['run_key']}.nc" for row in read_rows(folder / "table.csv")]
    files[0].write_bytes(files[0].read_bytes()[:1000])
    files[1].unlink()
    shutil.copy(files[3], files[2])
    boxes, sheets, figures = content(folder)
    assert any("kA = 0.016 to 0.08." in line for line in boxes) and figures >= 2
    assert sum(file.name in line for file in files for line in sheets) == 3
    assert not any(str(tmp_path) in line for line in boxes + sheets)


HEAD = "name,unit,symbol,meaning,digits\n"
PARTS = ("table.csv", "columns.csv", "scene.toml", "provenance.json", "trajectories")


@pytest.mark.parametrize(
    ("part", "content", "phrase"),
    [
        ("columns.csv", None, "older version"),
        ("columns.csv", "name,unit\n", "its first line is not name,unit,symbol,meaning,digits"),
        ("columns.csv", HEAD + "a,,,,two\n", "columns.csv cannot be read"),
        ("columns.csv", HEAD + "a,b\n", "columns.csv cannot be read"),
        ("table.csv", "steepness,status\n0.1,ok\n", "columns missing: "),
        ("columns.csv", HEAD + "status,,,,\n", "does not tell of all columns"),
        ("table.csv", "", "table.csv cannot be read"),
        ("scene.toml", "name = 3", "scene.toml cannot be read"),
        ("provenance.json", "{", "provenance.json cannot be read"),
        ("provenance.json", json.dumps({"campaign": "other"}), "names the campaign 'other'"),
    ],
)
def test_a_part_that_cannot_be_used_is_named_and_nothing_is_written(tmp_path, capsys, part, content, phrase):
    """content: of the file in place of its own, None where it is taken away."""
    folder = campaign(tmp_path / "out", [0.13], periods=5, transient=1)
    if content is None:
        (folder / part).rename(tmp_path / "away")
    else:
        (folder / part).write_text(content, encoding="utf-8")
    files = sorted(folder.iterdir())
    assert main([str(folder)]) == 2
    assert phrase in capsys.readouterr().err and sorted(folder.iterdir()) == files


@pytest.mark.parametrize(
    ("campaign", "columns", "phrase"),
    [
        ("accuracy", of_accuracy, "does not describe the works"),
        ("out_of_plane", of_plane, "does not name base and transient"),
        ("sweep", of_a_buoy, "does not name what was varied"),
        ("oscillator", (), "table.csv is missing"),
        ("stability", (), "table.csv is missing"),
        ("stability", of_accuracy, "or not those of this campaign"),
    ],
)
def test_a_folder_that_does_not_say_what_its_report_needs_is_refused(tmp_path, capsys, campaign, columns, phrase):
    place = folder_at(tmp_path / "out", campaign, [{"status": "ok"}], columns)
    if not columns:
        (place / "table.csv").unlink()
    assert main([str(place)]) == 2
    assert phrase in capsys.readouterr().err


def test_an_empty_folder_lists_everything_that_is_missing(tmp_path, capsys):
    for place, phrase in ((tmp_path, [f"{part} is missing" for part in PARTS]), (tmp_path / "no", ["no such folder"])):
        assert main([str(place)]) == 2
        message = capsys.readouterr().err
        assert all(words in message for words in phrase) and list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "dictionary", [None, b"name,unit\n", b"\xff\xfe", b"name,unit,symbol,meaning,digits\na,,a,a,x\n"]
)
def test_a_part_of_a_folder_that_cannot_be_read_has_no_rows(tmp_path, dictionary):
    (tmp_path / "between").mkdir()
    (tmp_path / "between" / "table.csv").write_text("a\n1\n")
    if dictionary is not None:
        (tmp_path / "between" / "columns.csv").write_bytes(dictionary)
    part = Folder(tmp_path, {}, (), None, {}).part("between")
    assert (part.table, part.columns, part.directory) == ((), {}, tmp_path / "between")
