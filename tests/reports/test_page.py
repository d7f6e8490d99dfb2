"""The page needs nothing but itself, is whole, says in words what its figures show, and takes text as text."""

import re
from itertools import pairwise

import pytest

from reports.parts.content import Report, Text, link, plain, spans
from reports.parts.html import render_html
from reports.parts.pdf import render_pdf, typst_data
from tables import sub
from tests.reports.conftest import ODD_TITLE, Page, every_kind

HEADINGS = {f"h{level}": level for level in range(1, 7)}
ODD = [
    ODD_TITLE, "", "\x00\x07\n\t\r", '#import "x"', "\\", '\\"', "$x$", "= no heading", "*/ // /*", "{{ 7 * 7 }}", "𝛉",
]  # fmt: skip


def test_nothing_is_fetched(source, page):
    assert not page.all("link") and not page.all("iframe")
    for tag, attributes in page.tags:
        assert attributes.get("src", "data:").startswith("data:"), tag
        assert attributes.get("href", "#").startswith("#"), tag
        assert not [name for name in attributes if name.startswith("on")], tag
    assert not [attributes for attributes in page.all("script") if "src" in attributes]
    source = re.sub(r"base64,[A-Za-z0-9+/=]+", "", source)
    assert "http" not in source and "url(" not in source and "@import" not in source
    assert not re.search(r"\b(fetch|XMLHttpRequest|WebSocket|EventSource|sendBeacon|eval|Function|import)\(", source)


def test_every_link_and_glyph_has_its_target_and_ids_are_unique(page):
    ids = [attributes["id"] for _, attributes in page.tags if "id" in attributes]
    assert len(ids) == len(set(ids))
    used = {attributes["href"][1:] for _, attributes in page.tags if "href" in attributes}
    assert used and used <= set(ids)


def test_every_figure_has_a_caption_and_a_text_alternative(page):
    images, drawings = page.all("img"), page.all("svg")
    assert len(images) == len(page.all("figure")) == len(page.all("figcaption")) >= 2
    assert all(len(image["alt"].split()) >= 5 for image in images)
    assert len(drawings) == 5 + 7, "five equations, a drawing of each run with a record"
    assert all(svg["role"] == "img" and len(svg["aria-label"].split()) >= 5 for svg in drawings)


def test_headings_go_down_one_level_at_a_time_and_there_is_one_title(page):
    levels = [HEADINGS[tag] for tag, _ in page.tags if tag in HEADINGS]
    assert levels[0] == 1 and levels.count(1) == 1 and ODD_TITLE in page.text
    assert all(lower <= upper + 1 for upper, lower in pairwise(levels))


def test_every_header_of_a_table_says_what_it_heads(page):
    assert {attributes.get("scope") for attributes in page.all("th")} == {"col", "row"}
    assert len(page.all("caption")) == len(page.all("table"))


def test_every_row_of_the_table_leads_to_its_sheet_and_neighbours_to_each_other(page):
    links = [attributes["href"] for attributes in page.all("a")]
    assert all(links.count(f"#run-{number}") >= 2 for number in range(1, 9))
    identities = [attributes.get("id", "") for attributes in page.all("div")]
    order = [identity for identity in identities if identity.startswith("run-")]
    assert order == [f"run-{number}" for number in range(1, 9)]


def test_a_report_without_an_explorer_has_no_script():
    assert not Page(render_html(Report("a", "b", (Text("c"),))).decode()).all("script")


@pytest.mark.parametrize("text", ODD)
def test_odd_text_in_every_place_gives_both_forms(text):
    report = every_kind(text)
    assert render_pdf(report).startswith(b"%PDF")
    for_paper = {entry["type"] for entry in typst_data(report)[0]["items"]}
    assert for_paper == {type(item).__name__.lower() for item in report.items} - {"explorer", "cellsheets"}
    if "\x00" not in text:  # HTML has no way to write it
        page = Page(render_html(report).decode())
        wanted = " ".join(plain(text).split())
        assert " ".join(page.text.split()).count(wanted) >= 10


def test_only_marks_made_here_are_marks():
    assert spans("a`b`c") == [("", "a"), ("code", "b"), ("", "c")]
    assert spans("T" + sub("i") + " `x") == [("", "T"), ("sub", "i"), ("", " `x")]
    assert plain("T" + sub("i") + " `x`") == "Ti x"
    assert spans(link("kA = 0.13", "run-7") + " of") == [("#run-7", "kA = 0.13"), ("", " of")]
