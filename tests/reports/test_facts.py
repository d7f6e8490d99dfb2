"""The facts of a report are those of its folder: heads and units, periods, natural frequencies, sources, histories."""

import math

import numpy as np
import pytest

from engine import load_scene
from engine.natural_frequencies import natural_frequencies
from reports.buoy_sweep.runs import read_sweep, spectrum_window
from reports.figures.motion import envelope, time_series
from reports.parts.columns import table_of
from reports.parts.content import plain
from reports.parts.folder import read_columns
from reports.parts.provenance import scene_table
from reports.parts.wording import number, ranges

TANH = {"tether.tension": {"law": "tanh", "p": [3e4, 5.0, 0.0, 0.0, 1e4]}}
DICTIONARY = """name,unit,symbol,meaning,digits
steepness,,kA,wave steepness,3
radius_min_m,m,r_min,"least distance, after the transient",2
growth,bits,σ,exponent,3
growth_error,bits,,its standard error,3
status,,,,
"""


def test_heads_units_places_and_caption_come_from_the_dictionary(tmp_path):
    (tmp_path / "columns.csv").write_text(DICTIONARY, encoding="utf-8")
    rows = [
        {"steepness": 0.13, "radius_min_m": 19.876, "growth": -0.04, "growth_error": 0.002, "status": "ok"},
        {"steepness": 0.1, "radius_min_m": math.nan, "growth": 1e-9, "growth_error": None, "status": ""},
    ]
    columns, names = read_columns(tmp_path), ["steepness", "radius_min_m", ("growth", "growth_error"), "status"]
    table = table_of(columns, names, rows, "Two runs.", {"status": lambda row: row["status"].upper()})
    assert [plain(column.title) for column in table.columns] == ["kA", "rmin", "σ", "status"]
    assert [(column.unit, column.align) for column in table.columns[1::2]] == [("m", "right"), ("", "left")]
    assert table.rows == (
        ("0.130", "19.88", "−0.040\u00a0±\u00a00.002", "OK"),
        ("0.100", "–", "1e-9\u00a0±\u00a0–", ""),
    )
    said = "Two runs. kA: wave steepness; rmin: least distance, after the transient; σ: exponent."
    assert plain(table.caption) == said
    with pytest.raises(KeyError):
        table_of(columns, ["mass"], rows, "")


def test_runs_of_a_motion_known_in_advance(folder):
    """Period 1 below kA = 0.06, 2 to 0.1, two incommensurate frequencies above; those at 0.12 and 0.16 failed."""
    sweep = read_sweep(folder)
    periods = {run.steepness: run.period for run in sweep.runs}
    assert periods == {0.016: 1, 0.03: 1, 0.05: 1, 0.08: 2, 0.1: 0, 0.12: None, 0.13: 0, 0.16: None}
    for run in sweep.runs:
        assert len(run.visited) == (run.period or 0)
        assert all(run["radius_min_m"] - 1e-9 <= r <= run["radius_max_m"] + 1e-9 for r in run.visited)
    assert [run.steepness for run in sweep.chosen] == [0.016, 0.08, 0.13]
    assert [run.steepness for run in sweep.good] == [0.016, 0.03, 0.05, 0.08, 0.1, 0.13]


def buoy(changes=None):
    return load_scene("tethered_buoy", changes or {})


def test_natural_frequencies_are_those_of_a_mass_on_the_tether():
    mass, length = 1611.0 + 907.0, 20.0
    for law, slope in (({}, lambda strain: 5e4), (TANH, lambda strain: 1.5e5 / math.cosh(5.0 * strain) ** 2 + 1e4)):
        modes = natural_frequencies(buoy(law))
        assert modes.radial_radps == pytest.approx(math.sqrt(slope(modes.static_strain) / (length * mass)), rel=1e-7)
        assert modes.pendulum_radps == pytest.approx(math.sqrt(modes.static_tension_N / (length * mass)), rel=1e-12)
    assert natural_frequencies(buoy()).static_strain == pytest.approx(0.04, rel=1e-3)
    assert natural_frequencies(buoy({"buoy.mass_kg": 1e4})) is None


def test_a_buoy_at_rest_under_water_has_the_modes_of_the_whole_sphere_and_at_the_surface_none():
    deep, out = ({"buoy.submergence": "spherical-cap", "water.depth_m": depth} for depth in (22.5, 21.0))
    assert natural_frequencies(buoy(deep)) == natural_frequencies(buoy({"water.depth_m": 22.5}))
    assert natural_frequencies(buoy(out)) is None


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


def test_spectrum_window_never_reaches_beyond_the_record():
    for done in np.arange(0.0, 130.0, 0.37):
        window = spectrum_window(done)
        assert window is None or sum(window) <= done + 1e-6
    assert spectrum_window(60.0) == spectrum_window(300.0) == (40, 20)
    assert spectrum_window(9.9) is None


def test_a_history_drawn_from_fewer_points_keeps_every_extreme_and_the_order_of_time():
    x, y = np.arange(30_000.0), np.random.default_rng(0).normal(size=30_000)
    kept_x, kept_y = envelope(x, y, bins=200)
    assert len(kept_x) <= 400 and np.all(np.diff(kept_x) > 0)
    assert (kept_y.min(), kept_y.max()) == (y.min(), y.max()) and np.array_equal(y[kept_x.astype(int)], kept_y)
    assert np.array_equal(envelope(x[:300], y[:300], bins=200)[1], y[:300])


def test_a_band_whose_edges_rest_at_different_times_is_drawn():
    """A slack stretch in the lower edge only: it has fewer extremes there than the upper one."""
    n = 4001
    low, high = np.sin(np.arange(n)), 2.0 + np.sin(1.3 * np.arange(n))
    low[1000:2000] = -1.0
    high[1500:2600] = np.nan
    picture = time_series(np.arange(n) / 100.0, {"T (kN)": (high - 0.5, low, high)})
    assert picture.kind == "svg" and len(picture.data) > 1000


def test_ranges_name_every_chosen_value_and_no_other():
    values = [0.01, 0.02, 0.03, 0.04, 0.05, 0.06]
    assert ranges(values, [True, True, True, False, True, False]) == "0.01 to 0.03 and 0.05"
    assert ranges(values, [False] * 6) == "none"
    assert number(-0.053) == "−0.053" and number(math.nan) == "–"
