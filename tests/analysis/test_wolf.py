"""Wolf's method: known exponents with an error that holds, what it must not depend on, and what it refuses."""

import numpy as np
import pytest

from analysis.wolf_pairs import wolf_run
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
    [pytest.param(name, marks=[pytest.mark.slow] * (name not in ("lorenz", "henon"))) for name in CHAOTIC],
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
    clean, noisy = (wolf_lyapunov(*series("two_tone", noise)) for noise in (0.0, 0.01))
    assert abs(clean.value) < 5e-4
    assert abs(noisy.value) < 3e-3
    for found in (clean, noisy):
        assert abs(found.value) < 2.0 * found.error


def test_a_limit_cycle_has_exponent_zero():
    found = wolf_lyapunov(*systems.record("van_der_pol", 8000))
    assert abs(found.value) < 1e-3 and abs(found.value) < 2.0 * found.error


@pytest.mark.slow
@pytest.mark.parametrize("name", TRUTH)
def test_the_truth_lies_within_two_errors_for_nine_in_ten_noise_seeds(name):
    """20 seeds of 1 % noise on the same motion."""
    inside = 0
    for seed in range(20):
        found = wolf_lyapunov(*series(name, noise=0.01, seed=seed))
        inside += abs(found.value - TRUTH[name]) < 2.0 * found.error
    assert inside >= 18


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name, flow in systems.FLOWS.items() if flow.literature])
def test_literature_values_agree_with_two_nearby_copies(name):
    value, error = systems.benettin(name, 50_000.0)
    assert abs(value - systems.FLOWS[name].literature) < 4.0 * error + 1e-3


ROSSLER, STEP = systems.record("rossler", 6000)


def test_units_of_the_series_do_not_matter_and_units_of_time_scale():
    base = wolf_lyapunov(ROSSLER, STEP)
    # Powers of two: the same rounding, so the same neighbours, so the same number.
    other = wolf_lyapunov(-4.0 * ROSSLER, 2.0 * STEP)
    assert (other.value, other.error) == pytest.approx((0.5 * base.value, 0.5 * base.error), rel=1e-12)


def test_a_map_that_triples_every_distance_gives_ln_3_at_every_step():
    x, phase = np.empty(5000), 0.1234567
    for i in range(len(x)):
        x[i], phase = phase, (3.0 * phase) % 1.0
    run = wolf_run(x, 1.0, 1, 1, 1, 1)
    # A pair on both sides of a jump of the map does not triple; all others do, exactly.
    assert np.median(run.growth) == pytest.approx(np.log(3.0), abs=1e-12)
    assert np.mean(np.abs(run.growth - np.log(3.0)) < 1e-6) > 0.95


def test_the_convergence_curve_ends_at_the_value_and_is_the_running_mean():
    run = wolf_run(ROSSLER, STEP, 14, 3, 28, 60)
    assert run.convergence[-1] == pytest.approx(run.value, rel=1e-12)
    assert run.convergence[9] == pytest.approx(run.growth[:10].sum() / run.time_s[9], rel=1e-12)
    assert run.time_s[-1] <= (len(ROSSLER) - 1) * STEP


def test_a_retained_pair_telescopes():
    x = np.sin(0.1 * np.arange(5000)) + 0.3 * np.sin(0.0618 * np.arange(5000))
    run = wolf_run(x, 1.0, 15, 4, 15, 60)
    start = run.end_length / np.exp(run.growth)
    same = np.isclose(start[1:], run.end_length[:-1], rtol=1e-9)
    assert np.sum(~same) <= run.replacements <= np.sum(~same) + 1
    assert run.replacements < 0.1 * len(run.growth)


def test_noise_shortens_nothing_below_the_floor():
    run = wolf_run(systems.noisy(ROSSLER, 0.01, 0), STEP, 14, 3, 28, 60, noise=0.01 * np.std(ROSSLER))
    start = run.end_length / np.exp(run.growth)
    assert np.mean(start >= run.floor * (1 - 1e-9)) > 0.99
    assert run.floor == pytest.approx(2.0 * 0.01 * np.std(ROSSLER) * np.sqrt(6.0))


@pytest.mark.parametrize(
    ("x", "words"),
    [
        (np.ones(5000), "series that moves"),
        (ROSSLER[:300], "500 samples"),
        (np.sin(0.01 * np.arange(5000)), "mean periods"),
        (np.random.default_rng(0).normal(size=5000), "noise"),
        (np.tile([0.0, 1.0, 3.0, 2.0], 500), "no neighbours"),
    ],
    ids=["constant", "short", "few periods", "white noise", "repeats to the last digit"],
)
def test_where_nothing_qualifies_the_answer_is_nan_with_the_reason(x, words):
    found = wolf_lyapunov(x, 1.0)
    assert np.isnan(found.value) and np.isnan(found.error)
    assert words in found.reason
