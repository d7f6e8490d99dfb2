"""The words and numbers of a report are those of its table and its scene."""

import math

import numpy as np
import pytest

from campaigns.buoy_sweep import rows
from campaigns.columns import names
from engine import load_scene
from engine.physics.waves import wave_number
from reports.buoy_sweep.figures import spectrum_window
from reports.buoy_sweep.motion import LONGEST_PERIOD
from reports.buoy_sweep.physics import natural_frequencies, water_surface_m
from reports.buoy_sweep.runs import COLUMNS
from reports.buoy_sweep.warnings import loads_used
from reports.figures.time_series import envelope
from reports.parts.scene_table import scene_table
from reports.parts.wording import number, ranges


def test_table_and_report_agree_on_columns_and_on_the_longest_period():
    assert set(COLUMNS) <= set(names(rows.COLUMNS))
    assert LONGEST_PERIOD == rows.LONGEST_PERIOD


def test_short_answer_of_a_motion_known_in_advance(page):
    text = " ".join(page.text.split())
    assert "8 runs, kA from 0.016 to 0.16" in text and "not so kA = 0.12 and 0.16" in text
    assert "(period 2) at kA = 0.08." in text
    assert "No verdict" in text and "chaotic" not in text.replace("No verdict on regular or chaotic motion", "")
    assert all(f"fig. {figure}" in text for figure in ("9", "10", "11", "12", "13", "15", "16", "19a"))


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


def test_what_is_said_of_a_buoy_partly_in_the_water():
    """One that rests under water has the modes of the whole sphere; at the surface none are given."""
    deep, out = ({"buoy.submergence": "spherical-cap", "water.depth_m": depth} for depth in (22.5, 21.0))
    whole = natural_frequencies(load_scene("tethered_buoy", {"water.depth_m": 22.5}))
    assert natural_frequencies(load_scene("tethered_buoy", deep)) == whole
    assert natural_frequencies(load_scene("tethered_buoy", out)) is None
    assert "whole sphere at any height" in loads_used(load_scene("tethered_buoy"))
    assert "below the linear wave" in loads_used(load_scene("tethered_buoy", out))


def test_the_surface_is_a_wave_of_the_given_height_that_travels_with_x():
    scene = load_scene("tethered_buoy", {"waves.steepness": 0.1})
    t = np.linspace(0, 5, 501)
    height = water_surface_m(scene, np.zeros(501), t) - 21.0
    k = wave_number(5.0, 21.0)
    assert np.ptp(height) == pytest.approx(2 * 0.1 / k, rel=1e-4)
    # A crest is at x = c t a moment later.
    assert water_surface_m(scene, np.array([2 * math.pi / (5 * k)]), np.array([1.0]))[0] == pytest.approx(21 + 0.1 / k)


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
    assert not any("set by the user" in row[4] for row in plain.rows)


def test_spectrum_window_never_reaches_beyond_the_record():
    for done in np.arange(0.0, 130.0, 0.37):
        window = spectrum_window(done)
        assert window is None or sum(window) <= done + 1e-6
    assert spectrum_window(60.0) == spectrum_window(300.0) == (40, 20)
    assert spectrum_window(9.9) is None


def test_the_envelope_keeps_every_extreme_and_the_order_of_time():
    t = np.arange(50_000) / 100.0
    y = np.sin(3.0 * t) + 0.1 * np.random.default_rng(5).normal(size=len(t))
    y[12_345] = 9.0
    x, line = envelope(t, y, bins=200)
    assert len(x) <= 400 and np.all(np.diff(x) > 0)
    assert line.max() == 9.0 and line.min() == y.min()
    short = envelope(t[:300], y[:300], bins=200)
    assert np.array_equal(short[1], y[:300])


def test_ranges_name_every_chosen_value_and_no_other():
    values = [0.01, 0.02, 0.03, 0.04, 0.05, 0.06]
    assert ranges(values, [True, True, True, False, True, False]) == "0.01 to 0.03 and 0.05"
    assert ranges(values, [False] * 6) == "none"
    assert number(-0.053) == "−0.053" and number(math.nan) == "–"
