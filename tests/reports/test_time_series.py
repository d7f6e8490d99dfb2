"""The page on any column: from its folder alone, the same bytes twice, and a folder that lacks something is named."""

import numpy as np
import pytest

from campaigns.time_series import main
from reports import build
from reports.figures.series_panels import record_and_spectrum
from reports.parts.content import Figure, first_sentence
from reports.parts.folder import FolderError
from reports.time_series.report import report


@pytest.fixture(scope="module")
def judged(tmp_path_factory):
    place = tmp_path_factory.mktemp("series")
    t = 0.3 * np.arange(3000)
    rows = "\n".join(repr(float(value)) for value in np.sin(t) + 0.7 * np.sin(0.61803 * t))
    (place / "tank.csv").write_text(f"load_N\n{rows}\n")
    assert main([str(place / "tank.csv"), "--column", "load_N", "--step", "0.3", "--out", str(place / "out")]) == 0
    return place / "out"


@pytest.mark.slow
def test_the_page_says_the_verdict_and_shows_every_curve(judged):
    html, pdf = build(judged)
    text = html.read_text(encoding="utf-8")
    assert "The motion is quasi-periodic" in text and "load_N" in text
    figures = [item for item in report(judged).items if isinstance(item, Figure)]
    assert all(len(first_sentence(figure.caption).split()) > 1 for figure in figures), "their names in the contents"
    assert text.count("<figure") == 3 and text.count("alt=") + text.count("aria-label") >= 3
    assert pdf.read_bytes()[:4] == b"%PDF"
    before = html.read_bytes(), pdf.read_bytes()
    assert tuple(path.read_bytes() for path in build(judged)) == before


@pytest.mark.slow
def test_any_name_of_a_column_can_be_drawn():
    for name in ("$x_{1", "load_N", "a b " * 40, "\\frac", "Zug in N²"):
        assert b"<svg" in record_and_spectrum(*np.ones((4, 30)), ("s", name)).data


@pytest.mark.slow
def test_what_is_missing_is_named(judged, tmp_path):
    (tmp_path / "provenance.json").write_text((judged / "provenance.json").read_text())
    (tmp_path / "section.csv").write_text("time_s,value_0\n0,x\n")
    with pytest.raises(FolderError) as fault:
        build(tmp_path)
    assert "answer.json is missing" in str(fault.value) and "section.csv cannot be read" in str(fault.value)
