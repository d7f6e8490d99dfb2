"""A report in a browser: axe-core finds nothing; on a telephone, in the dark, on paper; the explorer chooses runs."""

import colorsys
import io
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from reports.parts.content import Figure, Picture, Report
from reports.parts.html import render_html
from reports.parts.style import BLUE, GREEN, VERMILION
from tests.reports.conftest import every_kind

pytestmark = pytest.mark.slow
AXE = files("axe_playwright_python").joinpath("axe.min.js")
PHONE = {"width": 400, "height": 800}
SHOWN = "document.getElementById('explorer-sheet').dataset.run"
DRAWN = "document.querySelector('canvas').toDataURL()"  # tells one view from another


@pytest.fixture(scope="module")
def kinds(tmp_path_factory) -> Path:
    """A page with every kind of item there is, of which the pages of all campaigns are made."""
    path = tmp_path_factory.mktemp("kinds") / "report.html"
    path.write_bytes(render_html(every_kind("Words of a `column_m`")))
    return path


def violations(page) -> list[str]:
    """What axe-core finds serious or critical on a page, with a run chosen where it has an explorer."""
    page.evaluate("document.querySelector('#explorer button[value=after]')?.click()")
    page.evaluate(AXE.read_text(encoding="utf-8"))
    results = page.evaluate("axe.run(document).then((result) => result.violations)")
    return [
        f"{violation['id']}: {violation['help']}: {violation['nodes'][0]['html'][:200]} ({len(violation['nodes'])})"
        for violation in results
        if violation["impact"] in ("serious", "critical")
    ]


@pytest.mark.parametrize("window", [{}, {"color_scheme": "dark"}, PHONE], ids=["light", "dark", "phone"])
def test_axe_finds_nothing_serious(built, kinds, browse, window):
    for path in (built[0], kinds):
        with browse(path, **window) as page:
            assert violations(page) == []


def test_on_a_telephone_nothing_lies_beside_the_page_and_drawings_keep_their_size(built, kinds, browse):
    """Letters of 7.5 pt in a drawing 6.8 in wide are 10 pixels high from 650 pixels on; half size is the least for
    mathematics of 12 pt."""
    widths = "(all) => all.map((one) => one.getBoundingClientRect().width)"
    shares = "(all) => all.map((one) => one.getBoundingClientRect().width / one.width.baseVal.value)"
    for path in (built[0], kinds):
        with browse(path, **PHONE) as page:
            assert page.evaluate("document.documentElement.scrollWidth") == PHONE["width"]
            for drawing in ("figure .wide img", ".sheet svg.glance"):
                assert all(width >= 650.0 for width in page.eval_on_selector_all(drawing, widths)), drawing
            equations = page.eval_on_selector_all(".equation svg", shares)
            assert equations and all(share > 0.5 for share in equations)


def test_on_a_telephone_the_whole_diagram_of_the_first_page_is_seen_in_a_form_of_its_own(built, browse):
    chosen, seen = "(one) => one.currentSrc", []
    for window in ({}, PHONE):
        with browse(built[0], **window) as page:
            seen.append(page.eval_on_selector("#figure-1 img", chosen))
            box = page.locator("#figure-1 img").bounding_box()
            assert 0.0 <= box["x"] < box["x"] + box["width"] <= window.get("width", 1200)
    assert seen[0] != seen[1]
    assert box["width"] < box["height"], "upright, so that its letters are no smaller"


def test_in_the_dark_figures_are_dark_and_keep_their_hues(tmp_path, browse):
    """Three colours on white paper: the paper becomes dark, each colour stays within 17 degrees of its hue."""
    colours = (BLUE, GREEN, VERMILION)
    bars = "".join(f'<rect x="{100 * k}" width="60" height="100" fill="{item}"/>' for k, item in enumerate(colours))
    paper = '<path fill="#fff" d="M0 0h300v100H0z"/>'
    svg = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 300 100">{paper}{bars}</svg>'
    path, hues = tmp_path / "colours.html", []
    path.write_bytes(render_html(Report("a", "b", (Figure(Picture(svg.encode(), "svg"), "c", "d"),))))
    for scheme in ("light", "dark"):
        with browse(path, color_scheme=scheme) as page:
            drawn = Image.open(io.BytesIO(page.locator("figure img").screenshot()))
            at = [(round(drawn.width * share), drawn.height // 2) for share in (0.27, 0.1, 0.43, 0.77)]
            paper, *bars = (colorsys.rgb_to_hsv(*(part / 255 for part in drawn.getpixel(item)[:3])) for item in at)
            hues.append([hue for hue, *_ in bars])
            assert paper[2] > 0.95 if scheme == "light" else paper[2] < 0.15
            assert all(light > 0.4 and strong > 0.4 for _, strong, light in bars)
    assert np.allclose(*hues, atol=17 / 360)


def test_nothing_moves_on_paper_nor_for_those_who_asked_for_less_motion(kinds, browse):
    for media, seen in (({}, True), ({"media": "print"}, False), ({"reduced_motion": "reduce"}, False)):
        with browse(kinds) as page:
            page.emulate_media(**media)
            assert page.locator(".moving").first.is_visible() is seen
            assert page.locator("figure img").first.is_visible()


@pytest.fixture(scope="module")
def window(built, browse):
    with browse(built[0]) as page:
        yield page


def at(window, share):
    """(x, y) in the window of a share of the upper panel."""
    canvas = window.locator("#explorer canvas")
    canvas.evaluate("(one) => one.scrollIntoView({block: 'center'})")
    box = canvas.bounding_box()
    return box["x"] + 48 + (box["width"] - 58) * share, box["y"] + 0.3 * box["height"]


def test_a_click_on_a_steepness_keys_and_the_list_show_the_sheet_of_that_run(window):
    """The ends of the axis lie 3 % beyond the eight runs, which go from 0.016 to 0.16."""
    for steepness, number in ((0.05, 3), (0.13, 7), (0.016, 1)):
        window.mouse.click(*at(window, (0.03 + (steepness - 0.016) / 0.144) / 1.06))
        assert window.evaluate(SHOWN) == f"run-{number}"
        assert window.locator("#explorer-sheet svg.glance").count() == 1
        assert f"kA = {steepness:g}" in window.locator("[role=status]").text_content()
    for key, run in (("ArrowRight", 2), ("ArrowLeft", 1), ("ArrowLeft", 1)):  # before the first there is none
        window.keyboard.press(key)
        assert window.evaluate(SHOWN) == f"run-{run}"
    window.locator("#explorer select").select_option(index=8)
    assert window.evaluate(SHOWN) == "run-8"


def test_wheel_keys_and_drags_change_the_view_and_all_brings_it_back(window):
    x, y = at(window, 0.5)
    window.mouse.click(x, y)
    seen = [window.evaluate(DRAWN)]
    window.mouse.wheel(0, -240)
    window.wait_for_function(f"(before) => {DRAWN} !== before", arg=seen[0])
    for key in ("+", "d"):
        seen.append(window.evaluate(DRAWN))
        window.keyboard.press(key)
    seen.append(window.evaluate(DRAWN))
    window.mouse.down()
    window.mouse.move(x + 60, y + 20)
    window.mouse.up()
    assert len({*seen, window.evaluate(DRAWN)}) == 5, "each of them draws another view"
    window.locator("#explorer button[value=whole]").click()
    assert window.evaluate(DRAWN) == seen[0]


def test_a_run_without_points_is_seen_too(window):
    """Of the eight runs, those at kA = 0.12 and 0.16 failed: there, and only there, the lower edge has a cross.

    The lowest point of all stands a twenty-fifth of the panel above the edge, the arms of a cross end 4 pixels above.
    The run at 0.16 is chosen, because the broken line of a chosen run reaches the edge.
    """
    window.locator("#explorer select").select_option(index=8)
    window.locator("#explorer button[value=whole]").click()
    marked = window.evaluate("""() => {
      const canvas = document.querySelector('canvas'), pen = canvas.getContext('2d');
      const data = JSON.parse(document.getElementById('explorer-data').textContent);
      const floor = canvas.clientHeight - 44 - 92 * data.lower.length;
      return data.columns.filter((column) => {
        const share = (0.03 + (column.at - 0.016) / 0.144) / 1.06;
        const x = Math.round(48 + share * (canvas.clientWidth - 58));
        const seen = pen.getImageData(x - 5, floor - 6, 10, 3).data;
        return seen.some((value, i) => i % 4 === 3 && value > 150);
      }).map((column) => column.at);
    }""")
    assert marked == [0.12, 0.16]


def test_without_scripts_the_page_has_every_sheet_and_no_empty_explorer(built, browse):
    with browse(built[0], java_script_enabled=False) as page:
        assert page.locator(".sheet").count() == 8
        assert not page.locator("#explorer").is_visible()
        page.locator(".sheet summary").nth(6).click()
        assert page.locator("#run-7 svg").bounding_box()["height"] > 100
