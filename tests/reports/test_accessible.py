"""A report can be read by everybody: axe-core finds nothing; on a telephone, in the dark, on paper, without motion."""

from importlib.resources import files
from itertools import pairwise
from pathlib import Path
from typing import get_args

import pytest

from reports.buoy_sweep.equations import BUOY
from reports.parts.content import (
    Bullets,
    Column,
    Explorer,
    Figure,
    Heading,
    Item,
    Links,
    Listing,
    Notice,
    Picture,
    Report,
    Sheet,
    Table,
    Text,
    link,
)
from reports.parts.html import render_html
from reports.parts.symbols import T_I

AXE = files("axe_playwright_python").joinpath("axe.min.js")
HEADINGS = {f"h{level}": level for level in range(1, 7)}
PHONE = {"width": 400, "height": 800}


@pytest.fixture(scope="module")
def every_kind(tmp_path_factory) -> Path:
    """A page with every kind of item, long words and wide tables among them, but the explorer and its sheets."""
    dot = Picture(b'<svg xmlns="http://www.w3.org/2000/svg" width="490" height="200"><circle r="40"/></svg>', "svg")
    heads = tuple(Column(f"column {k}", "m", "right" if k else "left") for k in range(14))
    rows = tuple(tuple(f"{k}.{j} `trajectories`" for j in range(14)) for k in range(4))
    items = (
        Heading("One"),
        Text("See " + link("there", "figure-1") + " and `a_rather_long_name_of_a_column_of_the_table_N` of " + T_I),
        Heading("Two", 2),
        Bullets(("a", "b")),
        BUOY,
        Figure(dot, "A caption.", "A text of five words.", Picture(b"GIF89a", "gif")),
        Table(heads, rows, "Wide."),
        Table(heads, rows, "Small.", small=True),
        *(Notice(kind, "Beware", ("of this", "of `that`")) for kind in ("note", "warning")),
        Listing("python -m campaigns.any --out /a/rather/long/path/that/has/no/blank/in/it/and/goes/on/and/on"),
        Links((("the report of a part", "part/report.html"),)),
    )
    covered = {type(item) for item in items} | {Explorer, Sheet}
    assert covered == set(get_args(Item)), "a new kind of item belongs on this page"
    path = tmp_path_factory.mktemp("kinds") / "report.html"
    path.write_bytes(render_html(Report("Every kind", "of item", items)))
    return path


def violations(page) -> list[str]:
    """What axe-core finds serious or critical on a page, with a run chosen where it has an explorer."""
    page.evaluate("document.querySelector('#explorer button[value=after]')?.click()")
    page.evaluate(AXE.read_text(encoding="utf-8"))
    found = page.evaluate("axe.run(document).then((result) => result.violations)")
    return [
        f"{one['id']}: {one['help']}: {one['nodes'][0]['html'][:200]} ({len(one['nodes'])})"
        for one in found
        if one["impact"] in ("serious", "critical")
    ]


@pytest.mark.slow
@pytest.mark.parametrize("window", [{}, {"color_scheme": "dark"}, PHONE], ids=["light", "dark", "phone"])
def test_axe_finds_nothing_serious(built, every_kind, browse, window):
    """In a sweep's page; and in one with every kind of item there is, of which the pages of all campaigns are made."""
    for path in (built[0], every_kind):
        with browse(path, **window) as page:
            assert violations(page) == []


@pytest.mark.slow
def test_axe_would_have_found_something(built, browse, tmp_path):
    """A picture without its text and grey letters on grey are found: the check can fail."""
    source = built[0].read_text(encoding="utf-8")
    spoilt = tmp_path / "spoilt.html"
    spoilt.write_text(source.replace(' alt="', ' data-alt="').replace("--soft: #57606a", "--soft: #c0c4c8"), "utf-8")
    with browse(spoilt) as page:
        assert {line.partition(":")[0] for line in violations(page)} >= {"image-alt", "color-contrast"}


@pytest.mark.slow
def test_on_a_telephone_nothing_lies_beside_the_page_and_drawings_keep_their_size(built, every_kind, browse):
    """Letters of 7.5 pt in a drawing 6.8 in wide are 10 pixels high from 650 pixels on; half size is the least for
    mathematics of 12 pt."""
    widths = "(all) => all.map((one) => one.getBoundingClientRect().width)"
    shares = "(all) => all.map((one) => one.getBoundingClientRect().width / one.width.baseVal.value)"
    for path in (built[0], every_kind):
        with browse(path, **PHONE) as page:
            assert page.evaluate("document.documentElement.scrollWidth") == PHONE["width"]
            for drawing in ("figure img", "svg.glance"):
                assert all(width >= 650.0 for width in page.eval_on_selector_all(drawing, widths)), drawing
            found = page.eval_on_selector_all(".equation svg", shares)
            assert found and all(share > 0.5 for share in found)


@pytest.mark.slow
def test_on_paper_captions_are_smaller_than_text_and_nothing_moves(every_kind, browse):
    with browse(every_kind) as page:
        page.emulate_media(media="print")
        size = "(one) => parseFloat(getComputedStyle(one).fontSize)"
        text, *captions = (
            page.eval_on_selector(one, size) for one in ("main > p:not(.subtitle)", "figcaption", "caption")
        )
        assert max(captions) < text == pytest.approx(10.0 / 0.75, abs=0.01)
        assert not page.locator(".moving").is_visible()


@pytest.mark.slow
@pytest.mark.parametrize("motion", ["no-preference", "reduce"])
def test_moving_pictures_are_hidden_from_those_who_asked_for_less_motion(every_kind, browse, motion):
    with browse(every_kind, reduced_motion=motion) as page:
        assert page.locator(".moving").is_visible() is (motion == "no-preference")
        assert page.locator("figure > .wide > img").is_visible()


def test_headings_go_down_one_level_at_a_time_and_there_is_one_title(page):
    levels = [HEADINGS[tag] for tag, _ in page.tags if tag in HEADINGS]
    assert levels[0] == 1 and levels.count(1) == 1
    assert all(after <= before + 1 for before, after in pairwise(levels))


def test_landmarks_skip_link_and_language(page):
    tags = [tag for tag, _ in page.tags]
    assert tags.count("main") == tags.count("nav") == 1
    assert dict(page.tags)["html"]["lang"] == "en"
    first_link = next(attributes for tag, attributes in page.tags if tag == "a")
    assert first_link["class"] == "skip"
    assert ("main", first_link["href"][1:]) in [(tag, attributes.get("id")) for tag, attributes in page.tags]


def test_every_header_of_a_table_says_what_it_heads(page):
    headers = [attributes.get("scope") for tag, attributes in page.tags if tag == "th"]
    assert set(headers) == {"col", "row"}
    assert [tag for tag, _ in page.tags].count("caption") == [tag for tag, _ in page.tags].count("table")
