"""The explorer in a browser: a click, a key or the list chooses a run, and its sheet is shown; wheel and keys zoom."""

import pytest

from tests.reports.chromium import Chromium, installed
from tests.reports.conftest import Page

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(installed() is None, reason="no Chromium on this machine to open the report with"),
]
SHOWN = "document.getElementById('explorer-sheet').dataset.run"
# (x, y) in the window of a share of the upper panel; a reading of what is drawn tells one view from another
PLACE = """(() => { const box = document.querySelector('canvas').getBoundingClientRect();
  return [box.left + 48 + (box.width - 58) * %s, box.top + 0.3 * box.height]; })()"""
DRAWN = "document.querySelector('canvas').toDataURL()"


@pytest.fixture(scope="module")
def browser(built):
    with Chromium() as chromium:
        chromium.open(built[0])
        yield chromium


def at(browser, share):
    browser.value("document.querySelector('canvas').scrollIntoView({block: 'center'})")
    return browser.value(PLACE % share)


def test_a_click_on_a_steepness_shows_the_sheet_of_that_run(browser, page):
    """The ends of the axis lie 3 % beyond the least and the greatest steepness (eight runs, 0.016 to 0.16)."""
    for steepness, number in ((0.016, 1), (0.05, 3), (0.13, 7)):
        share = (0.03 + (steepness - 0.016) / 0.144) / 1.06
        browser.click(*at(browser, share))
        assert browser.value(SHOWN) == f"run-{number}"
        shown = browser.value("document.getElementById('explorer-sheet').innerText")
        assert f"kA = {steepness:g}" in shown and "status" in shown
        assert browser.value("document.querySelectorAll('#explorer-sheet svg.glance').length") == 1
        assert f"kA = {steepness:g}" in browser.value("document.querySelector('[role=status]').textContent")


def test_keys_and_list_choose_runs_too(browser):
    browser.value("document.querySelector('canvas').focus()")
    browser.click(*at(browser, 0.03))
    browser.press("ArrowRight")
    assert browser.value(SHOWN) == "run-2"
    browser.press("ArrowLeft")
    browser.press("ArrowLeft")
    assert browser.value(SHOWN) == "run-1", "before the first there is none"
    browser.value("(() => { const list = document.querySelector('#explorer select'); list.selectedIndex = 8;"
                  " list.dispatchEvent(new Event('change')); })()")  # fmt: skip
    assert browser.value(SHOWN) == "run-8"


def test_wheel_keys_buttons_and_drags_change_the_view_and_all_brings_it_back(browser):
    browser.click(*at(browser, 0.5))
    whole = browser.value(DRAWN)
    x, y = at(browser, 0.5)
    browser.mouse("mouseWheel", x, y, deltaX=0, deltaY=-240)
    browser.value("new Promise(requestAnimationFrame)")
    seen = [whole, browser.value(DRAWN)]
    browser.press("+", "+")
    seen.append(browser.value(DRAWN))
    browser.press("d", "d")
    seen.append(browser.value(DRAWN))
    browser.mouse("mousePressed", x, y, button="left", buttons=1, clickCount=1)
    browser.mouse("mouseMoved", x + 60, y + 20, button="left", buttons=1)
    browser.mouse("mouseReleased", x + 60, y + 20, button="left", buttons=0, clickCount=1)
    seen.append(browser.value(DRAWN))
    assert len(set(seen)) == len(seen), "each of them draws another view"
    browser.value("document.querySelector('#explorer button[value=whole]').click()")
    assert browser.value(DRAWN) == whole


def test_a_run_without_points_is_seen_too(browser):
    """Of the eight runs, those at kA = 0.12 and 0.16 failed: there, and only there, the lower edge has a cross.

    The lowest point of all stands a twenty-fifth of the panel above the edge, the arms of a cross end 4 pixels above.
    """
    browser.value("document.querySelector('#explorer button[value=whole]').click()")
    marked = browser.value("""(() => {
      const canvas = document.querySelector('canvas'), pen = canvas.getContext('2d');
      const data = JSON.parse(document.getElementById('explorer-data').textContent);
      const floor = canvas.clientHeight - 44 - 92 * data.lower.length;
      return data.columns.filter((column) => {
        const share = (0.03 + (column.at - 0.016) / 0.144) / 1.06;
        const x = Math.round(48 + share * (canvas.clientWidth - 58));
        const seen = pen.getImageData(x - 5, floor - 6, 10, 3).data;
        return seen.some((value, i) => i % 4 === 3 && value > 150);
      }).map((column) => column.at);
    })()""")
    assert marked == [0.12, 0.16]


def test_nothing_is_asked_of_a_network(browser):
    assert browser.asked_for() == []


def test_without_scripts_the_page_has_every_sheet_and_no_empty_explorer(built, page):
    sheets = [attributes["id"] for tag, attributes in page.tags if attributes.get("class") == "sheet"]
    assert sheets == [f"run-{number}" for number in range(1, 9)]
    linked = {attributes["href"][1:] for tag, attributes in page.tags if tag == "a"}
    assert set(sheets) <= linked
    with Chromium(scripts=False) as chromium:
        chromium.open(built[0])
        box = chromium.call("DOM.getDocument", depth=0)["root"]["nodeId"]
        node = chromium.call("DOM.querySelector", nodeId=box, selector="#explorer")["nodeId"]
        with pytest.raises(RuntimeError, match="box model"):
            chromium.call("DOM.getBoxModel", nodeId=node)
        node = chromium.call("DOM.querySelector", nodeId=box, selector="#run-7 svg")["nodeId"]
        assert chromium.call("DOM.getBoxModel", nodeId=node)["model"]["height"] > 100


def test_a_report_without_an_explorer_has_no_script():
    from reports.parts.content import Report, Text
    from reports.parts.html import render_html

    assert "script" not in [tag for tag, _ in Page(render_html(Report("a", "b", (Text("c"),))).decode()).tags]
