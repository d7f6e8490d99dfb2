"""Wolf's method finds known exponents: positive, zero, none; clean and with noise; and its error says how well."""

import numpy as np
import pytest

from analysis.wolf_plateau import wolf_lyapunov
from tests.analysis import systems

# nats/time: literature, or two nearby copies over 1e5 time units where no book agrees (tests/analysis/systems.py).
TRUTH = {
    "lorenz": 0.9056,
    "rossler": 0.0714,
    "duffing": 0.1565,
    "ueda": 0.1034,
    "pendulum": 0.1400,
    "henon": 0.41922,
    "logistic": np.log(2.0),
    "two_tone": 0.0,
}
CHAOTIC = [name for name in TRUTH if TRUTH[name]]


def series(name, noise=0.0, seed=0):
    if name in systems.FLOWS:
        return systems.record(name, noise=noise, seed=seed)
    return systems.noisy(getattr(systems, name)(), noise, seed), 0.1 if name == "two_tone" else 1.0


@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=[pytest.mark.slow] * (name in ("ueda", "pendulum", "duffing"))) for name in CHAOTIC],
)
def test_clean_records_are_within_a_tenth_and_maps_within_a_fiftieth(name):
    found = wolf_lyapunov(*series(name))
    assert found.value == pytest.approx(TRUTH[name], rel=0.02 if name in ("henon", "logistic") else 0.1)
    assert abs(found.value - TRUTH[name]) < 2.0 * found.error
    assert found.value > 2.0 * found.error


@pytest.mark.slow
@pytest.mark.parametrize("name", CHAOTIC)
def test_one_per_cent_of_noise_costs_less_than_a_fifth(name):
    found = wolf_lyapunov(*series(name, noise=0.01))
    assert found.value == pytest.approx(TRUTH[name], rel=0.2)


def test_a_torus_has_exponent_zero():
    clean, noisy = wolf_lyapunov(*series("two_tone")), wolf_lyapunov(*series("two_tone", noise=0.01))
    assert abs(clean.value) < 5e-4
    assert abs(noisy.value) < 3e-3
    for found in (clean, noisy):
        assert abs(found.value) < 2.0 * found.error


def test_a_limit_cycle_has_exponent_zero():
    found = wolf_lyapunov(*systems.record("van_der_pol"))
    assert abs(found.value) < 1e-3 and abs(found.value) < 2.0 * found.error


@pytest.mark.slow
@pytest.mark.parametrize("name", TRUTH)
def test_the_truth_lies_within_two_errors_for_nine_in_ten_noise_seeds(name):
    """50 seeds of 1 % noise on the same motion."""
    inside = 0
    for seed in range(50):
        found = wolf_lyapunov(*series(name, noise=0.01, seed=seed))
        inside += abs(found.value - TRUTH[name]) < 2.0 * found.error
    assert inside >= 45


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name, flow in systems.FLOWS.items() if flow.literature])
def test_literature_values_agree_with_two_nearby_copies(name):
    value, error = systems.benettin(name, 50_000.0)
    assert abs(value - systems.FLOWS[name].literature) < 4.0 * error + 1e-3


@pytest.mark.slow
@pytest.mark.parametrize("name", ["thomas", "chua", "hyper_rossler"])
def test_systems_beyond_those_of_the_table_are_within_two_errors(name):
    truth, _ = systems.benettin(name, 50_000.0 if name != "chua" else 20_000.0)
    found = wolf_lyapunov(*systems.record(name))
    assert abs(found.value - truth) < 2.0 * found.error
