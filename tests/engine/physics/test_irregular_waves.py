"""Law: linear waves add. A sea of one wave is that wave, a sea of two is the sum of both, each with its own
omega_i^2 = g k_i tanh k_i H; and a JONSWAP sea of significant height H_s has the variance H_s^2/16, whatever its seed.

Tolerance: rounding of the phases and of some hundred multiplications, 1e-12 of the speed at the surface.
"""

import numpy as np
import pytest
from scipy.integrate import quad

from engine import load_scene
from engine.parameters import record_of
from engine.physics.jonswap import HIGHEST, LOWEST, components, spectral_density
from engine.physics.sea import ROW, components_of, elevation_m, sea_field
from engine.physics.waves import wave_field, wave_field_3d, wave_number
from engine.simd.cover import goes_in_lanes

ONE = {"period_s": 5.0, "amplitude_m": 0.8, "phase_rad": 0.3}
OTHER = {"period_s": 3.1, "amplitude_m": 0.2, "phase_rad": -1.0}
LAWS = ["extrapolate", "zero", "wheeler"]
RNG = np.random.default_rng(2)
ROPE = np.column_stack([np.linspace(0.0, 6.0, 41), np.linspace(0.0, 24.0, 41)])
FAR = RNG.uniform([-50.0, 0.0], [50.0, 22.0], (41, 2))


def sea(*waves, **changes):
    return load_scene(
        "tethered_buoy", {"waves.components": list(waves), **{key.replace("__", "."): v for key, v in changes.items()}}
    )


def field(scene, t, X):
    tables = []
    record = record_of(scene, tables)[0]
    F = np.zeros((len(X), 2 * X.shape[1]))
    X = np.ascontiguousarray(X, float)
    if scene.waves.irregular:
        sea_field(record, np.concatenate(tables), t, X, F)
    elif X.shape[1] == 3:
        wave_field_3d(record, t, X, F)
    else:
        wave_field(record, t, X, F)
    return F


def regular(one, **changes):
    keys = {f"waves.{name}": value for name, value in one.items()}
    return load_scene("tethered_buoy", {**keys, **{key.replace("__", "."): value for key, value in changes.items()}})


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("heading", [0.0, np.pi])
@pytest.mark.parametrize("X", [ROPE, FAR], ids=["rope", "far apart"])
def test_a_sea_of_one_wave_is_that_wave(law, heading, X):
    one, both = {**ONE, "direction_rad": heading}, {"waves__above_still_water": law, "waves__ramp_s": 7.0}
    for t in (0.0, 2.3, 60.0):
        alone, listed = field(regular(one, **both), t, X), field(sea(one, **both), t, X)
        assert listed == pytest.approx(alone, abs=1e-12)
    assert np.abs(alone).max() > 0.1


@pytest.mark.slow
@pytest.mark.parametrize("law", LAWS)
def test_a_sea_of_one_wave_in_space_is_that_wave(law):
    one, both = {**ONE, "direction_rad": 0.7}, {"waves__above_still_water": law, "motion__dimensions": 3}
    X = np.column_stack([ROPE[:, 0], np.linspace(0.0, -4.0, 41), ROPE[:, 1]])
    assert field(sea(one, **both), 2.3, X) == pytest.approx(field(regular(one, **both), 2.3, X), abs=1e-12)


@pytest.mark.parametrize("law", ["extrapolate", "zero"])
def test_waves_add(law):
    both = {"waves__above_still_water": law}
    apart = field(sea(ONE, **both), 4.2, ROPE) + field(sea(OTHER, **both), 4.2, ROPE)
    assert field(sea(ONE, OTHER, **both), 4.2, ROPE) == pytest.approx(apart, abs=1e-12)


def test_wheeler_stretches_by_the_elevation_of_the_whole_sea():
    """At the crest of the sum the water moves as at the still level of the same sea without stretching."""
    stretched = sea(ONE, OTHER, waves__above_still_water="wheeler")
    eta = float(elevation_m(stretched, 1.7, 3.0))
    at_surface = field(stretched, 1.7, np.array([[3.0, 21.0 + eta]]))
    assert at_surface == pytest.approx(field(sea(ONE, OTHER), 1.7, np.array([[3.0, 21.0]])), abs=1e-12)


def test_the_surface_of_a_sea_of_one_wave_is_that_of_the_wave():
    t, x = np.linspace(0.0, 9.0, 50), 3.0
    k = wave_number(5.0, 21.0)
    for scene in (sea(ONE, waves__ramp_s=4.0), regular(ONE, waves__ramp_s=4.0)):
        ramp = np.where(t < 4.0, np.sin(np.pi * t / 8.0) ** 2, 1.0)
        assert elevation_m(scene, t, x) == pytest.approx(
            0.8 * ramp * np.cos(k * x - 2.0 * np.pi / 5.0 * t + 0.3), abs=1e-12
        )


def test_mirror_and_shift_in_time():
    mirrored = sea(*({**wave, "direction_rad": np.pi} for wave in (ONE, OTHER)))
    here, there = field(sea(ONE, OTHER), 4.2, ROPE), field(mirrored, 4.2, ROPE * [-1.0, 1.0])
    assert there == pytest.approx(here * [-1.0, 1.0, -1.0, 1.0], abs=1e-12)
    later = sea(*({**w, "phase_rad": w["phase_rad"] - 2.0 * np.pi * 1.9 / w["period_s"]} for w in (ONE, OTHER)))
    assert field(later, 2.3, ROPE) == pytest.approx(field(sea(ONE, OTHER), 4.2, ROPE), abs=1e-12)


def test_accelerations_are_rates_of_the_velocities():
    scene, step = sea(ONE, OTHER, waves__ramp_s=9.0), 1e-4
    rate = (field(scene, 4.2 + step, ROPE)[:, :2] - field(scene, 4.2 - step, ROPE)[:, :2]) / (2.0 * step)
    assert field(scene, 4.2, ROPE)[:, 2:] == pytest.approx(rate, abs=1e-7)


def test_each_component_meets_the_dispersion_relation_and_the_surface_moves_with_the_water():
    scene = load_scene("tethered_buoy", {"waves.jonswap.significant_height_m": 1.0, "waves.jonswap.seed": 4})
    tables = []
    record = record_of(scene, tables)[0]
    rows = np.concatenate(tables)[record["sea_at"] :][: ROW * record["sea_n"]].reshape(-1, ROW)
    assert 9.81 * rows[:, 0] * np.tanh(21.0 * rows[:, 0]) == pytest.approx(rows[:, 1] ** 2, rel=1e-12)
    eta = elevation_m(scene, np.array([3.0 - 1e-4, 3.0 + 1e-4]), 2.0)
    W = field(scene, 3.0, np.array([[2.0, 21.0]]))[0, 1]
    assert np.diff(eta) / 2e-4 == pytest.approx(W, abs=1e-6)


@pytest.mark.parametrize("gamma", [1.0, 3.3, 7.0])
@pytest.mark.parametrize("count", [8, 64, 500])
def test_a_jonswap_sea_carries_the_energy_of_its_height(gamma, count):
    total = quad(spectral_density, LOWEST / 8.0, HIGHEST / 8.0, args=(2.0, 8.0, gamma), points=[1 / 8.0], limit=200)[0]
    assert total == pytest.approx(2.0**2 / 16.0, rel=1e-6)
    periods, amplitudes, phases = components(2.0, 8.0, gamma, count, seed=5)
    assert np.sum(amplitudes**2) / 2.0 == pytest.approx(2.0**2 / 16.0, rel=1e-12)
    assert len(set(periods)) == count and np.all((phases >= 0.0) & (phases < 2.0 * np.pi))
    # Each component lies in its part of the band and carries the energy of it: no mean is off by more than a part.
    energy, part = amplitudes**2 / 2.0, (HIGHEST - LOWEST) / 8.0 / count
    mean = quad(lambda f: f * spectral_density(f, 2.0, 8.0, gamma), LOWEST / 8, HIGHEST / 8, points=[1 / 8])[0] / total
    assert np.sum(energy / periods) / np.sum(energy) == pytest.approx(mean, abs=part)


def test_the_surface_of_a_long_record_has_that_height():
    """4 standard deviations of the elevation over 2000 peak periods, to 3 %."""
    scene = load_scene("tethered_buoy", {"waves.jonswap.significant_height_m": 1.2, "waves.jonswap.seed": 1})
    eta = elevation_m(scene, np.arange(0.0, 10_000.0, 0.7))
    assert 4.0 * eta.std() == pytest.approx(1.2, rel=0.03)


def test_the_seed_is_the_sea():
    first, again, other = (
        components_of(load_scene("tethered_buoy", {"waves.jonswap": {"significant_height_m": 1.0, "seed": seed}}))
        for seed in (3, 3, 4)
    )
    assert all(np.array_equal(a, b) for a, b in zip(first, again, strict=True))
    assert not np.array_equal(first[0], other[0]) and not np.array_equal(first[2], other[2])
    assert np.array_equal(first[1], other[1])  # every seed has the same energy at the same frequencies


def test_a_regular_wave_is_no_sea():
    """It takes the way that it took before, and only it shares a batch."""
    plain, many = load_scene("tethered_buoy"), sea(ONE)
    assert (record_of(plain, [])[0]["sea_n"], record_of(many, [])[0]["sea_n"]) == (0, 1)
    assert goes_in_lanes(plain) and not goes_in_lanes(many)


@pytest.mark.slow
@pytest.mark.parametrize(
    "changes", [{}, {"motion.dimensions": 3}, {"solver.scheme": "paper-box"}], ids=["plane", "space", "paper box"]
)
def test_a_run_in_a_sea_of_one_wave_is_that_in_the_wave(changes):
    from engine import simulate

    k = wave_number(5.0, 21.0)
    small = {"waves.steepness": 0.016, "tether.nodes": 11, **changes}
    listed = {**small, "waves.components": [{"period_s": 5.0, "amplitude_m": 0.016 / k}]}
    del listed["waves.steepness"]
    one, other = (simulate(load_scene("tethered_buoy", keys), periods=3) for keys in (small, listed))
    assert one.status == other.status == "ok"
    assert other.columns["radius_m"] == pytest.approx(one.columns["radius_m"], abs=1e-6)


@pytest.mark.slow
def test_a_jonswap_sea_moves_the_buoy_and_repeats_itself_bit_for_bit():
    from engine import simulate

    scene = load_scene("tethered_buoy", {"waves.jonswap": {"significant_height_m": 0.5, "seed": 1}})
    first, again = simulate(scene, periods=10), simulate(scene, periods=10)
    assert first.status == "ok" and np.ptp(first.columns["radius_m"]) > 0.05
    assert np.array_equal(first.columns["radius_m"], again.columns["radius_m"])
