"""Wolf's method: known exponents with an error that holds, what it must not depend on, and what it refuses.

Rosenstein's exponent, and the scaling region without which there is none.
"""

from itertools import product
from types import SimpleNamespace

import numpy as np
import pytest

from analysis.divergence import _slope_of, rosenstein_lyapunov, scaling_region
from analysis.wolf_pairs import wolf_run
from analysis.wolf_plateau import _plateau, wolf_lyapunov
from tests.analysis.systems import TRUTH, noisy, normal, record

CHAOTIC = [name for name in TRUTH if TRUTH[name]]
ROSSLER, STEP = record("rossler", 6000)


@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=[pytest.mark.slow] * (name != "lorenz")) for name in CHAOTIC],
)
def test_clean_records_are_within_a_tenth_and_maps_within_a_fiftieth(name):
    result = wolf_lyapunov(*record(name))
    assert result.value == pytest.approx(TRUTH[name], rel=0.02 if name in ("henon", "logistic") else 0.1)
    assert abs(result.value - TRUTH[name]) < 2.0 * result.error < result.value


@pytest.mark.parametrize(
    ("name", "samples", "noise", "bound"),
    [
        ("two_tone", 20_000, 0.0, 5e-4),
        pytest.param("two_tone", 20_000, 0.01, 3e-3, marks=pytest.mark.slow),
    ],
)
def test_a_torus_has_exponent_zero(name, samples, noise, bound):
    result = wolf_lyapunov(*record(name, samples, noise))
    assert abs(result.value) < min(bound, 2.0 * result.error)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["lorenz", "ueda", "pendulum", "henon", "two_tone"])
def test_noise_of_one_per_cent_costs_a_fifth_and_the_truth_lies_within_two_errors_in_nine_of_ten(name):
    """10 seeds of noise on the same motion."""
    result = [wolf_lyapunov(*record(name, 10_000, noise=0.01, seed=seed)) for seed in range(10)]
    assert result[0].value == pytest.approx(TRUTH[name], rel=0.2, abs=3e-3)
    assert sum(abs(item.value - TRUTH[name]) < 2.0 * item.error for item in result) >= 9


@pytest.mark.parametrize("estimate", [wolf_lyapunov, rosenstein_lyapunov])
def test_units_of_the_series_do_not_matter_and_units_of_time_scale(estimate):
    base = estimate(ROSSLER, STEP)
    # Powers of two: the same rounding, so the same neighbours, so the same number.
    scaled = estimate(-4.0 * ROSSLER, 2.0 * STEP)
    assert (scaled.value, scaled.error) == pytest.approx((0.5 * base.value, 0.5 * base.error), rel=1e-9)


def test_the_error_joins_four_parts_and_vectors_twice_as_long_are_one_of_them():
    exponent = wolf_lyapunov(ROSSLER, STEP)
    details, run = exponent.details, exponent.details["run"]
    settings = list(product(details["dimensions"], details["evolutions"]))
    assert (run.dimension, run.evolution) in settings and details["qualified"].all()
    delay, period = details["embedding"].lag, round(details["embedding"].mean_period)

    def value(m, e, lengths):
        return wolf_run(ROSSLER, STEP, delay, m, e, max(period, (m - 1) * delay), details["noise"], lengths).value

    values, doubled = (np.array([value(m, e, lengths) for m, e in settings]) for lengths in (1.0, 2.0))
    assert np.array_equal(values, details["values"].ravel())
    assert details["length_change"] == pytest.approx(np.sqrt(np.mean((doubled - values) ** 2)))
    parts = [details[name] for name in ("block_error", "spread", "length_change", "noise_bias")]
    assert exponent.error == pytest.approx(np.linalg.norm(parts))


def test_the_convergence_curve_ends_at_the_value_and_is_the_running_mean():
    run = wolf_run(ROSSLER, STEP, 14, 3, 28, 60)
    assert run.convergence[-1] == pytest.approx(run.value, rel=1e-12)
    assert run.convergence[9] == pytest.approx(run.growth[:10].sum() / run.time_s[9], rel=1e-12)
    assert run.time_s[-1] <= (len(ROSSLER) - 1) * STEP


def test_settings_that_scatter_add_their_standard_deviation_to_the_error():
    def run(m, e, lengths=1.0):
        value = 1.0 + 0.1 * normal(m + e)
        return SimpleNamespace(value=value, error=0.0, end_length=np.ones(1), size=10.0, noise_bias=0.0)

    exponent = _plateau(run, {"dimensions": range(0, 3000, 1000), "evolutions": range(300)})
    assert exponent.error == pytest.approx(0.1, rel=0.1)


def test_noise_shortens_nothing_below_the_floor():
    run = wolf_run(noisy(ROSSLER, 0.01, 0), STEP, 14, 3, 28, 60, noise=0.01 * np.std(ROSSLER))
    start = run.end_length / np.exp(run.growth)
    assert np.mean(start >= run.floor * (1 - 1e-9)) > 0.99
    assert run.floor == pytest.approx(2.0 * 0.01 * np.std(ROSSLER) * np.sqrt(6.0))
    # noise adds 2 sigma^2 to a squared length in each of three dimensions: growth without that
    added = 6.0 * (0.01 * np.std(ROSSLER)) ** 2
    growth = 0.5 * np.log((run.end_length**2 - added) / (start**2 - added))
    assert run.noise_bias == pytest.approx(np.nanmean(growth - run.growth) / (28 * STEP), rel=0.1)


def test_the_error_by_rosenstein_is_that_of_the_mean_over_independent_pairs():
    """2000 pairs part at rates 1 +- 0.5: a mean known to 0.5/sqrt(2000)."""
    errors = []
    for seed in range(30):
        rates = 1.0 + 0.5 * normal(seed, 2000)
        errors.append(_slope_of(np.outer(0.1 * np.arange(21), rates), 0.1, 1.0, {}).error)
    assert np.mean(errors) == pytest.approx(0.5 / np.sqrt(2000), rel=0.15)


def test_short_flows_and_noisy_maps_by_rosenstein_lie_within_two_errors_in_nine_of_ten():
    """Their exponents are too small by 15 to 30 %."""
    deviations = []
    for part in np.split(record("ueda", 24_000)[0], 4):
        result = rosenstein_lyapunov(part, 2.0 * np.pi / 50.0)
        deviations.append((TRUTH["ueda"] - result.value) / result.error)
    for seed in range(6):
        result = rosenstein_lyapunov(*record("logistic", 2500, noise=0.01, seed=seed))
        deviations.append((TRUTH["logistic"] - result.value) / result.error)
    assert np.sum(np.abs(deviations) < 2.0) >= 9


T = 0.1 * np.arange(200)


def test_a_line_between_two_plateaus_is_found_with_its_slope():
    region = scaling_region(T, np.clip(0.7 * (T - 4.0), 0.0, 5.0))
    assert region.slope == pytest.approx(0.7, rel=0.08)
    assert region.span > 4.0
    assert T[region.begin] > 3.0 and T[region.end] < 12.2


def test_the_error_of_a_line_is_the_scatter_of_the_slopes_of_its_quarters():
    """Of t + 0.05 t^2 up to 4 they are 1.05, 1.15, 1.25 and 1.35."""
    t = 0.1 * np.arange(41)
    assert scaling_region(t, t + 0.05 * t**2).error == pytest.approx(np.std([1.05, 1.15, 1.25, 1.35]))


def test_a_swing_that_rides_on_the_line_is_averaged_away():
    assert scaling_region(T, 0.5 * T + np.sin(2 * np.pi * T), cycle=10).slope == pytest.approx(0.5, rel=0.03)


@pytest.mark.parametrize(
    "curve", [0.04 * np.arange(20.0), np.zeros(20), -np.arange(20.0), np.log1p(np.arange(40.0)) / 4]
)
def test_less_than_a_nat_is_refused(curve):
    region = scaling_region(np.arange(float(len(curve))), curve)
    assert np.isnan(region.slope) and region.begin == -1
    assert "no straight" in region.reason


@pytest.mark.parametrize("name", ["henon", "logistic", pytest.param("rossler", marks=pytest.mark.slow)])
def test_known_exponents_by_rosenstein(name):
    result = rosenstein_lyapunov(*record(name))
    assert result.value == pytest.approx(TRUTH[name], rel=0.2 if name == "rossler" else 0.1)
    assert result.details["region"].span >= 1.0 and result.details["region"].slope == result.value
