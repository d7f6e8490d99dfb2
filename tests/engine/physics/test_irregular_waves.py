"""Law: a JONSWAP sea of significant height H_s has the variance H_s^2/16, whatever its seed, spread over frequencies as
its spectrum says; the surface of any sea is the sum of its waves.
"""

import numpy as np
import pytest
from scipy.integrate import quad

from engine import goes_in_lanes, simulate
from engine.physics.sea import HIGHEST, LOWEST, components, components_of, elevation_m
from engine.physics.waves import wave_number
from tests.engine.kernels import parameters_of
from tests.engine.lines import line

ONE = {"period_s": 5.0, "amplitude_m": 0.8, "phase_rad": 0.3}


def jonswap(**keys):
    return line({"waves.jonswap": keys})


def test_the_surface_of_a_sea_of_one_wave_is_that_of_the_wave():
    t, x = np.linspace(0.0, 9.0, 50), 3.0
    ramp = np.where(t < 4.0, np.sin(np.pi * t / 8.0) ** 2, 1.0)
    eta = 0.8 * ramp * np.cos(wave_number(5.0, 21.0) * x - 2.0 * np.pi / 5.0 * t + 0.3)
    for waves in ({"components": [ONE]}, ONE):
        scene = line({f"waves.{key}": value for key, value in waves.items()}, {"waves.ramp_s": 4.0})
        assert elevation_m(scene, t, x) == pytest.approx(eta, abs=1e-12)


@pytest.mark.parametrize("gamma", [1.0, 3.3, 7.0])
@pytest.mark.parametrize("count", [8, 64, 500])
def test_a_jonswap_sea_carries_the_energy_of_its_height(gamma, count):
    def density(f, power=0):
        """f^power S(f) of the head of `engine.physics.sea`, c = 1, T_p = 8 s."""
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
    plain, many = line(), line({"waves.components": [ONE]})
    assert (parameters_of(plain)[0]["sea_n"], parameters_of(many)[0]["sea_n"]) == (0, 1)
    assert goes_in_lanes(plain) and not goes_in_lanes(many)


@pytest.mark.slow
def test_a_jonswap_sea_moves_the_buoy_and_repeats_itself_bit_for_bit():
    first, again = (simulate(jonswap(significant_height_m=0.5, seed=1), periods=10) for _ in range(2))
    assert first.status == "ok" and np.ptp(first.columns["radius_m"]) > 0.05
    assert np.array_equal(first.columns["radius_m"], again.columns["radius_m"])
