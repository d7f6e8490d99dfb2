"""Law: linear waves add. A sea of one wave is that wave, a sea of two is the sum of both, each with its own
omega_i^2 = g k_i tanh k_i H; and a JONSWAP sea of significant height H_s has the variance H_s^2/16, whatever its seed.

Tolerance: rounding of the phases and of some hundred multiplications, 1e-12 of the speed at the surface.
"""

import numpy as np
import pytest
from scipy.integrate import quad

from engine import goes_in_lanes, simulate
from engine.physics.jonswap import HIGHEST, LOWEST, components
from engine.physics.sea import ROW, components_of, elevation_m
from engine.physics.waves import wave_number
from tests.engine.kernels import parameters_of, waves_at
from tests.engine.lines import line

ONE = {"period_s": 5.0, "amplitude_m": 0.8, "phase_rad": 0.3}
OTHER = {"period_s": 3.1, "amplitude_m": 0.2, "phase_rad": -1.0}
LAWS = ["extrapolate", "zero", "wheeler"]
RNG = np.random.default_rng(2)
ROPE = np.column_stack([np.linspace(0.0, 6.0, 41), np.linspace(0.0, 24.0, 41)])
FAR = RNG.uniform([-50.0, 0.0], [50.0, 22.0], (41, 2))
ASIDE = np.insert(ROPE, 1, np.linspace(0.0, -4.0, 41), axis=1)


def sea(*waves, dimensions=2, **both):
    keys = {f"waves.{key}": value for key, value in both.items()}
    return line({"waves.components": list(waves), "motion.dimensions": dimensions}, keys)


def regular(one, dimensions=2, **both):
    return line({f"waves.{key}": value for key, value in (one | both).items()}, {"motion.dimensions": dimensions})


def jonswap(**keys):
    return line({"waves.jonswap": keys})


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("heading", [0.0, np.pi])
@pytest.mark.parametrize("X", [ROPE, FAR], ids=["rope", "far apart"])
def test_a_sea_of_one_wave_is_that_wave(law, heading, X):
    one, both = {**ONE, "direction_rad": heading}, {"above_still_water": law, "ramp_s": 7.0}
    for t in (0.0, 2.3, 60.0):
        alone, listed = waves_at(regular(one, **both), t, X), waves_at(sea(one, **both), t, X)
        assert listed == pytest.approx(alone, abs=1e-12)
    assert np.abs(alone).max() > 0.1
    one, both = {**ONE, "direction_rad": heading + 0.7}, {"above_still_water": law, "dimensions": 3}
    assert waves_at(sea(one, **both), 2.3, ASIDE) == pytest.approx(
        waves_at(regular(one, **both), 2.3, ASIDE), abs=1e-12
    )


@pytest.mark.parametrize("law", ["extrapolate", "zero"])
def test_waves_add(law):
    both = {"above_still_water": law}
    apart = waves_at(sea(ONE, **both), 4.2, ROPE) + waves_at(sea(OTHER, **both), 4.2, ROPE)
    assert waves_at(sea(ONE, OTHER, **both), 4.2, ROPE) == pytest.approx(apart, abs=1e-12)


def test_wheeler_stretches_by_the_elevation_of_the_whole_sea():
    """At the crest of the sum the water moves as at the still level of the same sea without stretching."""
    stretched = sea(ONE, OTHER, above_still_water="wheeler")
    eta = float(elevation_m(stretched, 1.7, 3.0))
    at_surface = waves_at(stretched, 1.7, np.array([[3.0, 21.0 + eta]]))
    assert at_surface == pytest.approx(waves_at(sea(ONE, OTHER), 1.7, np.array([[3.0, 21.0]])), abs=1e-12)


def test_the_surface_of_a_sea_of_one_wave_is_that_of_the_wave():
    t, x = np.linspace(0.0, 9.0, 50), 3.0
    k = wave_number(5.0, 21.0)
    for scene in (sea(ONE, ramp_s=4.0), regular(ONE, ramp_s=4.0)):
        ramp = np.where(t < 4.0, np.sin(np.pi * t / 8.0) ** 2, 1.0)
        assert elevation_m(scene, t, x) == pytest.approx(
            0.8 * ramp * np.cos(k * x - 2.0 * np.pi / 5.0 * t + 0.3), abs=1e-12
        )


def test_mirror_and_shift_in_time():
    mirrored = sea(*({**wave, "direction_rad": np.pi} for wave in (ONE, OTHER)))
    here, there = waves_at(sea(ONE, OTHER), 4.2, ROPE), waves_at(mirrored, 4.2, ROPE * [-1.0, 1.0])
    assert there == pytest.approx(here * [-1.0, 1.0, -1.0, 1.0], abs=1e-12)
    later = sea(*({**w, "phase_rad": w["phase_rad"] - 2.0 * np.pi * 1.9 / w["period_s"]} for w in (ONE, OTHER)))
    assert waves_at(later, 2.3, ROPE) == pytest.approx(waves_at(sea(ONE, OTHER), 4.2, ROPE), abs=1e-12)


def test_accelerations_are_rates_of_the_velocities():
    scene, step = sea(ONE, OTHER, ramp_s=9.0), 1e-4
    rate = (waves_at(scene, 4.2 + step, ROPE)[:, :2] - waves_at(scene, 4.2 - step, ROPE)[:, :2]) / (2.0 * step)
    assert waves_at(scene, 4.2, ROPE)[:, 2:] == pytest.approx(rate, abs=1e-7)


def test_each_component_meets_the_dispersion_relation_and_the_surface_moves_with_the_water():
    scene = jonswap(significant_height_m=1.0, seed=4)
    p, tables = parameters_of(scene)
    rows = tables[p["sea_at"] :][: ROW * p["sea_n"]].reshape(-1, ROW)
    assert 9.81 * rows[:, 0] * np.tanh(21.0 * rows[:, 0]) == pytest.approx(rows[:, 1] ** 2, rel=1e-12)
    eta = elevation_m(scene, np.array([3.0 - 1e-4, 3.0 + 1e-4]), 2.0)
    W = waves_at(scene, 3.0, np.array([[2.0, 21.0]]))[0, 1]
    assert np.diff(eta) / 2e-4 == pytest.approx(W, abs=1e-6)


@pytest.mark.parametrize("gamma", [1.0, 3.3, 7.0])
@pytest.mark.parametrize("count", [8, 64, 500])
def test_a_jonswap_sea_carries_the_energy_of_its_height(gamma, count):
    def density(f, power=0):
        """f^power S(f) of the head of `engine.physics.jonswap`, c = 1, T_p = 8 s."""
        ratio, sigma = 8.0 * f, 0.07 if 8.0 * f < 1.0 else 0.09
        return f**power * ratio**-5 * np.exp(-1.25 / ratio**4) * gamma ** np.exp(-((ratio - 1) ** 2) / (2 * sigma**2))

    periods, amplitudes, phases = components(2.0, 8.0, gamma, count, seed=5)
    assert np.sum(amplitudes**2) / 2.0 == pytest.approx(2.0**2 / 16.0, rel=1e-12)
    assert len(set(periods)) == count and np.all((phases >= 0.0) & (phases < 2.0 * np.pi))
    # Each component lies in its part of the band and carries the energy of it: no mean is off by more than a part.
    energy, part = amplitudes**2 / 2.0, (HIGHEST - LOWEST) / 8.0 / count
    of_f, total = (quad(density, LOWEST / 8, HIGHEST / 8, args=(n,), points=[1 / 8], limit=200)[0] for n in (1, 0))
    assert np.sum(energy / periods) / np.sum(energy) == pytest.approx(of_f / total, abs=part)


def test_the_surface_of_a_long_record_has_that_height():
    """4 standard deviations of the elevation over 2000 peak periods, to 3 %."""
    scene = jonswap(significant_height_m=1.2, seed=1)
    eta = elevation_m(scene, np.arange(0.0, 10_000.0, 0.7))
    assert 4.0 * eta.std() == pytest.approx(1.2, rel=0.03)


def test_the_seed_is_the_sea():
    first, again, other = (components_of(jonswap(significant_height_m=1.0, seed=seed)) for seed in (3, 3, 4))
    assert all(np.array_equal(a, b) for a, b in zip(first, again, strict=True))
    assert not np.array_equal(first[0], other[0]) and not np.array_equal(first[2], other[2])
    assert np.array_equal(first[1], other[1])  # every seed has the same energy at the same frequencies


def test_a_regular_wave_is_no_sea():
    """It takes the way that it took before, and only it shares a batch."""
    plain, many = line(), sea(ONE)
    assert (parameters_of(plain)[0]["sea_n"], parameters_of(many)[0]["sea_n"]) == (0, 1)
    assert goes_in_lanes(plain) and not goes_in_lanes(many)


@pytest.mark.slow
@pytest.mark.parametrize(
    "changes", [{}, {"motion.dimensions": 3}, {"solver.scheme": "paper-box"}], ids=["plane", "space", "paper box"]
)
def test_a_run_in_a_sea_of_one_wave_is_that_in_the_wave(changes):
    small = {"tether.nodes": 11, **changes}
    listed = {"waves.components": [{"period_s": 5.0, "amplitude_m": 0.016 / wave_number(5.0, 21.0)}]}
    one, other = (simulate(line(small, keys), periods=3) for keys in ({"waves.steepness": 0.016}, listed))
    assert one.status == other.status == "ok"
    assert other.columns["radius_m"] == pytest.approx(one.columns["radius_m"], abs=1e-6)


@pytest.mark.slow
def test_a_jonswap_sea_moves_the_buoy_and_repeats_itself_bit_for_bit():
    first, again = (simulate(jonswap(significant_height_m=0.5, seed=1), periods=10) for _ in range(2))
    assert first.status == "ok" and np.ptp(first.columns["radius_m"]) > 0.05
    assert np.array_equal(first.columns["radius_m"], again.columns["radius_m"])
