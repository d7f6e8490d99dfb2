"""The facts of a report are those of its folder: heads and units, periods, sources, histories;
sheets and explorer keep what they draw, and a script reads back what it is given.
"""

import json
import math
import re

import numpy as np
import pytest

from engine import load_scene
from reports.buoy_sweep.runs import read_sweep, spectrum_window
from reports.figures.curves import envelope
from reports.figures.run_sheet import NOTHING, run_sheet
from reports.parts.columns import shown_on, table_of
from reports.parts.content import Explorer, ExplorerColumn, plain
from reports.parts.folder import read_columns
from reports.parts.html import explorer_json
from reports.parts.provenance import scene_table
from reports.parts.symbols import OMEGA_I, OMEGA_R

DICTIONARY = """name,unit,symbol,meaning,digits
steepness,,kA,wave steepness,3
radius_min_m,m,r_min,"least distance, after the transient",2
growth,bits,σ,exponent,3
growth_error,bits,± σ,its standard error,3
status,,,,
"""


def test_heads_units_places_and_caption_come_from_the_dictionary(tmp_path):
    (tmp_path / "columns.csv").write_text(DICTIONARY, encoding="utf-8")
    rows = [
        {"steepness": 0.13, "radius_min_m": 19.876, "growth": -0.04, "growth_error": 0.002, "status": "ok"},
        {"steepness": 0.1, "radius_min_m": "", "growth": 1e-9, "growth_error": None, "status": ""},
    ]
    columns, names = read_columns(tmp_path / "columns.csv"), ["steepness", "radius_min_m", "growth", "status"]
    table = table_of(columns, names, rows, "Two runs.", {"status": lambda row: row["status"].upper()})
    assert [plain(column.title) for column in table.columns] == ["kA", "rmin", "σ", "status"]
    assert [(column.unit, column.align) for column in table.columns[1::2]] == [("m", "right"), ("", "left")]
    assert table.rows == [
        ["0.130", "19.88", "−0.040\u00a0±\u00a00.002", "OK"],
        ["0.100", "–", "1e-9\u00a0±\u00a0–", ""],
    ]
    assert shown_on(columns, rows[1:]) == ["steepness", "growth"], "what says nothing is left out"
    assert table.caption == "Two runs."
    meanings = [head.meaning for head in table.columns]
    assert meanings == ["wave steepness", "least distance, after the transient", "exponent", ""]
    with pytest.raises(KeyError):
        table_of(columns, ["mass"], rows, "")


def test_runs_of_a_motion_known_in_advance(folder):
    """Period 1 below kA = 0.06, 2 to 0.1, two incommensurate frequencies above; those at 0.12 and 0.16 failed."""
    sweep = read_sweep(folder)
    periods = {run.value: run.period for run in sweep.runs}
    assert periods == {0.016: 1, 0.03: 1, 0.05: 1, 0.08: 2, 0.1: 0, 0.12: None, 0.13: 0, 0.16: None}
    assert sorted(run.value for run in sweep.chosen) == [0.016, 0.08, 0.13]
    assert [run.value for run in sweep.good] == [0.016, 0.03, 0.05, 0.08, 0.1, 0.13]


def buoy(changes=None):
    return load_scene("tethered_buoy", changes or {})


def test_every_parameter_has_a_source_and_changes_are_marked():
    changed = buoy({"water.depth_m": 22.5, "current": {"law": "uniform", "velocity_mps": [1, 0, 0]}})
    table = scene_table(changed, "tethered_buoy", {"waves.steepness": "0.1 to 0.2"}, "caption")
    cells = {row[0].strip("`"): row for row in table.rows}
    assert cells["water.depth_m"][2:] == ("22.5", "m", "set by the user (default 21)")
    assert cells["current.velocity_mps"][4] == "set by the user"
    assert cells["waves.steepness"][2] == "0.1 to 0.2" and "varied" in cells["waves.steepness"][4]
    assert cells["buoy.mass_kg"][4].startswith("Table 1")
    plain = scene_table(buoy(), "tethered_buoy", {}, "caption")
    assert all(row[4] for row in plain.rows) and not any("set by the user" in row[4] for row in plain.rows)
    of_a_file = {row[0].strip("`"): row[4] for row in scene_table(buoy(), "one/of/mine.toml", {}, "caption").rows}
    assert of_a_file["water.depth_m"] == "set by the user"


def test_spectrum_window_never_reaches_beyond_the_record():
    for periods in np.arange(0.0, 130.0, 0.37):
        window = spectrum_window(periods)
        assert window is None or sum(window) <= periods + 1e-6
    assert spectrum_window(60.0) == spectrum_window(300.0) == (40, 20)
    assert spectrum_window(9.9) is None


def test_a_history_drawn_from_fewer_points_keeps_every_extreme_and_the_order_of_time():
    x, y = np.arange(30_000.0), np.random.default_rng(0).normal(size=30_000)
    kept_x, kept_y = envelope(x, y, bins=200)
    assert len(kept_x) <= 400 and np.all(np.diff(kept_x) > 0)
    assert (kept_y.min(), kept_y.max()) == (y.min(), y.max()) and np.array_equal(y[kept_x.astype(int)], kept_y)
    assert np.array_equal(envelope(x[:300], y[:300], bins=200)[1], y[:300])


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
    corners = []
    for path in re.findall(r'class="band"[^>]* d="M([^"]*)z"', drawing):
        start, *steps = path.split("l")
        numbers = [[int(word) for word in re.findall(r"-?\d+", part)] for part in (start, *steps)]
        corners.append(np.cumsum(numbers, axis=0))
    return corners


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
    points = np.random.default_rng(3).normal(20.0, 3.0, 40)
    columns = (ExplorerColumn(0.1, tuple(points), "</script>", "run-1"), ExplorerColumn(0.2, (), "", "run-2"))
    text = explorer_json(Explorer("x", "y", columns, (("slack", (0.1, math.nan), (math.nan,) * 2),)))
    assert "<" not in text
    read = json.loads(text)
    assert read["columns"][0]["points"] == pytest.approx(points, abs=1e-5 * np.ptp(points))
    assert (read["low"], read["high"]) == pytest.approx((points.min(), points.max()))
    assert read["lower"] == [{"label": "slack", "values": [0.1, None], "errors": [None, None]}]
