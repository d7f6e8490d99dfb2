"""The facts of a report are those of its table and its scene: periods, natural frequencies, sources, histories."""

import math

import numpy as np
import pytest

from engine import load_scene
from engine.natural_frequencies import natural_frequencies
from reports.buoy_sweep.answer import short_answer
from reports.buoy_sweep.runs import read_sweep, spectrum_window
from reports.figures.time_series import Panel, envelope, time_series
from reports.parts.provenance import scene_table
from reports.parts.wording import number, ranges


@pytest.fixture(scope="module")
def sweep(folder):
    return read_sweep(folder)


def test_runs_of_a_motion_known_in_advance(sweep):
    """Period 1 below kA = 0.06, 2 to 0.1, two incommensurate frequencies above; those at 0.12 and 0.16 failed."""
    periods = {run.steepness: run.period for run in sweep.runs}
    assert periods == {0.016: 1, 0.03: 1, 0.05: 1, 0.08: 2, 0.1: 0, 0.12: None, 0.13: 0, 0.16: None}
    for run in sweep.runs:
        assert len(run.visited) == (run.period or 0)
        assert not len(run.visited) or min(run.visited) >= run["radius_min_m"] - 1e-9
        assert not len(run.visited) or max(run.visited) <= run["radius_max_m"] + 1e-9
    assert [run.steepness for run in sweep.chosen] == [0.016, 0.08, 0.13]
    assert [run.steepness for run in sweep.good] == [0.016, 0.03, 0.05, 0.08, 0.1, 0.13]


def test_the_short_answer_names_every_run_and_every_period(sweep):
    lines = short_answer(sweep)
    for steepness in ("0.016", "0.05", "0.08", "0.1", "0.12", "0.13", "0.16"):
        assert any(steepness in line for line in lines)
    assert any("kA = 0.12 and 0.16" in line for line in lines), "what failed"
    assert sum("(period " in line for line in lines) == 2
    assert not any("chaotic" in line for line in lines), "no exponent was computed"


def test_natural_frequencies_are_those_of_a_mass_on_the_tether():
    scene = load_scene("tethered_buoy")
    modes = natural_frequencies(scene)
    mass, length = 1611.0 + 907.0, 20.0
    assert modes.radial_radps == pytest.approx(math.sqrt(5e4 / (length * mass)), rel=1e-9)
    assert modes.pendulum_radps == pytest.approx(math.sqrt(modes.static_tension_N / (length * mass)), rel=1e-12)
    assert modes.static_strain == pytest.approx(0.04, rel=1e-3)
    tanh = load_scene("tethered_buoy", {"tether.tension": {"law": "tanh", "p": [3e4, 5.0, 0.0, 0.0, 1e4]}})
    soft = natural_frequencies(tanh)
    slope = 3e4 * 5.0 / math.cosh(5.0 * soft.static_strain) ** 2 + 1e4
    assert soft.radial_radps == pytest.approx(math.sqrt(slope / (length * mass)), rel=1e-7)
    assert natural_frequencies(load_scene("tethered_buoy", {"buoy.mass_kg": 1e4})) is None


def test_a_buoy_at_rest_under_water_has_the_modes_of_the_whole_sphere_and_at_the_surface_none():
    deep, out = ({"buoy.submergence": "spherical-cap", "water.depth_m": depth} for depth in (22.5, 21.0))
    whole = natural_frequencies(load_scene("tethered_buoy", {"water.depth_m": 22.5}))
    assert natural_frequencies(load_scene("tethered_buoy", deep)) == whole
    assert natural_frequencies(load_scene("tethered_buoy", out)) is None


def test_every_parameter_has_a_source_and_changes_are_marked():
    default = load_scene("tethered_buoy")
    changed = load_scene(
        "tethered_buoy", {"water.depth_m": 22.5, "current": {"law": "uniform", "velocity_mps": [1, 0, 0]}}
    )
    table = scene_table(changed, "tethered_buoy", {"waves.steepness": "0.1 to 0.2"}, "caption")
    cells = {row[0].strip("`"): row for row in table.rows}
    assert cells["water.depth_m"][2:] == ("22.5", "m", "set by the user (default 21)")
    assert cells["current.velocity_mps"][4] == "set by the user"
    assert cells["waves.steepness"][2] == "0.1 to 0.2" and "varied" in cells["waves.steepness"][4]
    assert cells["buoy.mass_kg"][4].startswith("Table 1")
    plain = scene_table(default, "tethered_buoy", {}, "caption")
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
    picture = time_series(np.arange(n) / 100.0, [Panel("T (kN)", high - 0.5, low, high)])
    assert picture.kind == "svg" and len(picture.data) > 1000


def test_ranges_name_every_chosen_value_and_no_other():
    values = [0.01, 0.02, 0.03, 0.04, 0.05, 0.06]
    assert ranges(values, [True, True, True, False, True, False]) == "0.01 to 0.03 and 0.05"
    assert ranges(values, [False] * 6) == "none"
    assert number(-0.053) == "−0.053" and number(math.nan) == "–"
