"""Campaign folders and their pages, made once for the tests that only look at them."""

from html.parser import HTMLParser
from pathlib import Path

import pytest

from reports import build
from tests.reports.synthetic import campaign

ODD_TITLE = '<b>#odd$ *title* _x_ @ref `code` \\ "q" & [z] //c é\u2028 </title>'


class Page(HTMLParser):
    """The start tags of a page as (tag, attributes), and the text outside of style elements."""

    def __init__(self, source: str):
        super().__init__()
        self.tags, self.text, self._open = [], "", []
        self.feed(source)

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))
        self._open.append(tag)

    def handle_endtag(self, tag):
        if tag in self._open:
            del self._open[len(self._open) - 1 - self._open[::-1].index(tag) :]

    def handle_data(self, data):
        if "style" not in self._open:
            self.text += data


@pytest.fixture(scope="session")
def folder(tmp_path_factory) -> Path:
    """Eight runs: two failed (one without a record), periods 1 and 2 and none, an odd title."""
    failing = {0.12: ("newton-failed", 0), 0.16: ("turn-unresolved", 33.3)}
    steepness = [0.016, 0.03, 0.05, 0.08, 0.1, 0.12, 0.13, 0.16]
    place = tmp_path_factory.mktemp("reports") / "eight"
    return campaign(place, steepness, failing=failing, overrides={"title": ODD_TITLE, "water.depth_m": 22.5})


@pytest.fixture(scope="session")
def built(folder) -> tuple[Path, Path]:
    return build(folder)


@pytest.fixture(scope="session")
def page(built) -> Page:
    return Page(built[0].read_text(encoding="utf-8"))
