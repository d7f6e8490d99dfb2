"""What is measured of a snapping run and of a slack rope, and what the scene alone says of eq. (33)."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from campaigns.paper.measures import buckling_waves, scales, snaps
from engine import load_scene
from engine.natural_frequencies import natural_frequencies

PEAK, STATIC_N = 4.0, 2000.0  # of the static tension


def bounces(pull):
    """snaps of r - l0 = sin(pi t/T_i), taut and slack in turn, with pull(r - l0, r') while slack [of the static]."""
    scene = load_scene("tethered_buoy")
    step_s, period_s = scene.sample_step_s(), scene.waves.period_s
    time_s = step_s * np.arange(round(80 * period_s / step_s) + 1)
    phase = np.pi * time_s / period_s
    stretch, rate = np.sin(phase), np.cos(phase)
    tension = STATIC_N * np.where(stretch > 0.0, PEAK * stretch, pull(stretch, rate))
    tension[0] = STATIC_N  # a run starts at rest
    columns = {"time_s": time_s, "tension_top_N": tension, "radius_rate_mps": rate}
    columns |= {"radius_m": 20.0 + stretch, "angle_rad": np.sin(2.0 * phase)}
    return snaps(SimpleNamespace(columns=columns, scene=scene), 10)


def test_a_mass_that_bounces_on_a_spring_is_turned_by_peaks_of_two_thirds_of_their_length():
    found = bounces(lambda stretch, rate: 0.0 * stretch)
    assert found["near_zero"] == pytest.approx(0.5 + math.asin(0.05 / PEAK) / math.pi, abs=0.01)
    assert found["turned"] == found["begun_inwards"] == 1.0 and found["compressed"] == 0.0
    assert math.isnan(found["compressed_inwards"])
    assert found["peak_periods"] == pytest.approx(2.0 / 3.0, abs=0.02)
    assert found["apart_periods"] == pytest.approx(2.0, abs=0.1)
    assert (found["radial_at"], found["angular_at"]) == (0.5, 1.0)
    assert found["radial_line"] == pytest.approx(1.0) and found["angular_line"] == pytest.approx(1.0)


@pytest.mark.parametrize(("sign", "inwards"), [(-1.0, 1.0), (1.0, 0.0)])
def test_compression_is_told_with_the_way_of_the_buoy(sign, inwards):
    found = bounces(lambda stretch, rate: np.where(sign * rate > 0.0, -0.1, 0.0))
    assert found["compressed"] == pytest.approx(0.25, abs=0.01)
    assert found["compressed_inwards"] == pytest.approx(inwards, abs=0.01)


@pytest.mark.parametrize("waves", [1, 4])
def test_a_slack_sine_has_its_half_waves(waves):
    x = np.linspace(0.0, 1.0, 200)
    shape = {"x_m": x[None, :], "z_m": 0.1 * np.sin(waves * np.pi * x)[None, :]}
    assert buckling_waves(SimpleNamespace(**shape, tension_N=-np.ones((1, 200)))) == waves
    assert buckling_waves(SimpleNamespace(**shape, tension_N=np.ones((1, 200)))) is None


def test_the_normalised_lift_is_the_static_stretch_over_the_diameter():
    scene = load_scene("tethered_buoy", {"water.depth_m": 300.0})
    modes = natural_frequencies(scene)
    found, twice = scales(scene, modes, 0.016, 0.13), scales(scene, modes, 0.016, 0.26)
    stretch_m = modes.static_strain * scene.tether.length_m
    assert found["lift"] == pytest.approx(stretch_m / scene.buoy.diameter_m, rel=1e-4)
    assert twice["force"] == pytest.approx(2.0 * found["force"])
    deep = scene.gravity_mps2 / modes.wave_radps**2  # 1/k of deep water
    assert found["small_amplitude_m"] == pytest.approx(0.016 * deep)
    assert found["diameter_over_wave"] == pytest.approx(scene.buoy.diameter_m / (2.0 * math.pi * deep))
    assert found["force"] < 1e-3  # waves do not reach down there
