"""Sheets and explorer: drawings keep what they draw, and a script reads back what it is given."""

import json
import re

import numpy as np
import pytest

from reports.figures.run_sheet import NOTHING, run_sheet
from reports.parts.content import Explorer, ExplorerColumn, Figure, Picture
from reports.parts.html import explorer_json
from reports.parts.wording import OMEGA_I, OMEGA_R

FIGURE = Figure(Picture(b"", "svg"), "A caption.", "A text.")


def drawing(t, values, section=(), spectrum=NOTHING, marks=(), exponent=NOTHING) -> str:
    """A sheet of a record whose tension, radius and angle are the same values."""
    histories = tuple((name, values, values) for name in ("T (kN)", "r (m)", "θ (rad)"))
    points = np.reshape(section, (-1, 2))
    return run_sheet("x", 80, t, histories, 6.0, points, spectrum, marks, exponent)


def glance(peak: float) -> str:
    """A sheet of a record of 20000 samples that are 1, -1 in turn but for one of height `peak`."""
    wave = np.cos(np.pi * np.arange(20001))
    wave[7777] = peak
    return drawing(np.linspace(0.0, 300.0, 20001), wave)


def bands(drawing: str) -> list[np.ndarray]:
    """Corners of every band of a drawing, in fifths of a pixel."""
    found = []
    for path in re.findall(r'class="band"[^>]* d="M([^"]*)z"', drawing):
        start, *steps = path.split("l")
        numbers = [[int(word) for word in re.findall(r"-?\d+", part)] for part in (start, *steps)]
        found.append(np.cumsum(numbers, axis=0))
    return found


def test_a_single_high_sample_among_thousands_is_drawn():
    flat, high = bands(glance(1.0))[0], bands(glance(3.0))[0]
    assert np.ptp(high[:, 1]) == np.ptp(flat[:, 1]), "both fill the panel between its margins"
    assert np.sum(high[:, 1] == high[:, 1].min()) <= 2 < np.sum(flat[:, 1] == flat[:, 1].min())


def test_a_drawing_of_few_columns_is_small_whatever_the_record():
    assert len(glance(2.0).encode()) < 12_000


@pytest.mark.parametrize("values", [np.full(11, np.nan), np.zeros(11), np.full(11, 1e9)], ids=["nan", "0", "1e9"])
def test_a_record_without_a_finite_value_or_without_any_range_is_drawn(values):
    t = np.linspace(0.0, 5.0, 11)
    assert "nan" not in drawing(t, values, np.zeros((3, 2)), exponent=(t, values * 0.0))


@pytest.mark.parametrize("periods", [0, 1, 2])
def test_a_run_may_end_any_time_after_its_transient(periods):
    """Not every run ends as asked: the exponent of one wave period is a number, and no curve."""
    t = np.linspace(0.0, 200.0 + 5.0 * periods, 400)
    drawn = drawing(t, np.sin(t), [[1, 1]], exponent=(40.0 + np.arange(1, periods + 1), np.full(periods, 0.3)))
    assert ("no exponent" in drawn) is (periods < 2) and "nan" not in drawn


@pytest.mark.parametrize("full", [True, False])
def test_words_of_a_sheet_end_within_it_and_subscripts_are_set_below(full):
    """Of the letters of a sans-serif face the mean is not wider than 0.55 of its size, 12 pixels."""
    t, marks = np.linspace(0.0, 9.0, 50), ((1.0, OMEGA_R), (1.26, OMEGA_I))
    drawn = drawing(t, t, np.ones((3, 2)), (t[1:], t[1:]), marks, (t, t)) if full else drawing(t, t, marks=marks)
    for place, words in re.findall(r'<text x="(\d+)"[^>]*>(.*?)</text>', drawn):
        assert int(place) + 0.55 * 12.0 * len(re.sub("<[^>]*>", "", words)) < 960.0, words
    assert not re.search("[ᵢᵣ₀₁]", drawn) and drawn.count('class="s">i<') == (5 if full else 2)


def test_explorer_data_reads_back_to_a_hundred_thousandth_of_the_range():
    rng = np.random.default_rng(3)
    points = [tuple(rng.normal(20.0, 3.0, size)) for size in (5, 0, 40)]
    columns = tuple(ExplorerColumn(0.1 * k, values, f"</script> {k}", f"run-{k}") for k, values in enumerate(points))
    lower = (("slack", (0.1, float("nan"), 0.3), (float("nan"),) * 3),)
    text = explorer_json(Explorer(FIGURE, "x", "y", columns, lower))
    assert "<" not in text
    read = json.loads(text)
    for column, values in zip(read["columns"], points, strict=True):
        assert column["points"] == pytest.approx(values, abs=1e-5 * (read["high"] - read["low"]))
    assert read["lower"][0]["values"] == [0.1, None, 0.3] and read["lower"][0]["errors"] == [None] * 3
