"""Exponents of a tangent map: means of growth per period, with errors that hold for correlated growth; their record."""

import numpy as np
import pytest
from scipy.signal import lfilter

from analysis import tangent_lyapunov, transverse_lyapunov
from analysis.exponents import Exponent, no_exponent
from tests.analysis.systems import logistic, logistic_growth, normal


def growth_of_a_bit(periods, seed):
    """Along an orbit of x -> 4 x (1 - x): exponent ln 2, one bit an iteration."""
    start = np.random.default_rng(seed).uniform(0.1, 0.9)
    return logistic_growth(4.0, logistic(4.0, periods + 1, start, skip=0))


def ar1(periods, seed):
    return lfilter([1.0], [1.0, -0.6], normal(seed, periods))


@pytest.mark.parametrize("periods", [200, 500, 2000])
def test_errors_are_those_of_the_scatter(periods):
    """AR(1) growth, correlation 0.6, mean zero: deviations in errors scatter by 0.8 to 1.25."""
    result = [tangent_lyapunov(ar1(periods, seed))[0] for seed in range(400)]
    assert 0.8 < np.std([exponent.value / exponent.error for exponent in result]) < 1.25


def test_errors_of_long_records_are_sure():
    """Six frequencies know the error to 30 %; of 8000 periods 24 count, and the scatter over starts is that of normal
    deviates to a twelfth."""
    result = [tangent_lyapunov(ar1(8000, seed))[0] for seed in range(150)]
    errors, scatter = np.array([exponent.error for exponent in result]), np.std([exponent.value for exponent in result])
    assert np.std(errors) < 0.2 * errors.mean() and errors.mean() == pytest.approx(scatter, rel=0.15)
    assert 0.87 < np.std([exponent.value / exponent.error for exponent in result]) < 1.13
    assert "this one run" in result[0].reason


def test_columns_are_exponents_in_their_order_after_the_transient():
    result = tangent_lyapunov(np.log([[2.0, 0.25]] * 100), transient_periods=10)
    assert [item.value for item in result] == pytest.approx([1.0, -2.0])
    assert [item.details["periods"] for item in result] == [90, 90]


@pytest.mark.parametrize("coupling", [0.0, 0.1, 0.25, 0.4])
def test_coupled_maps_leave_their_diagonal_or_keep_to_it(coupling):
    """x' = (1 - c) f(x) + c f(y), y' = c f(x) + (1 - c) f(y), f(x) = 4 x (1 - x): across x = y the growth of a step is
    |1 - 2 c| |f'|, the exponent 1 + log2|1 - 2 c| bits, and the diagonal is left below c = 1/4."""
    growth = growth_of_a_bit(20_000, 3) + np.log(abs(1 - 2 * coupling))
    result = transverse_lyapunov(growth, 100)
    assert abs(result.value - (1 + np.log2(1 - 2 * coupling))) < 3 * result.error
    assert result.unit == "bits/period" and result.details["periods"] == 19_900 and result.error < 0.02


def test_loops_released_leave_no_exponent_across_the_plane():
    growth, released = ar1(200, 5), np.zeros(200)
    released[40] = 1.0
    assert transverse_lyapunov(growth, 41, released).found
    lost = transverse_lyapunov(growth, 40, released)
    assert not lost.found and "released in 1 of" in lost.reason


def test_one_bit_a_period_is_ln_2_nats_over_the_period():
    sigma = Exponent(np.log(2.0) / 5.0, 0.1 * np.log(2.0) / 5.0, "nats/time", "method").in_bits_per_period(5.0)
    assert (sigma.value, sigma.error, sigma.unit) == (pytest.approx(1.0), pytest.approx(0.1), "bits/period")
    assert sigma.in_bits_per_period(7.0) is sigma


def test_without_a_value_there_is_a_reason_and_no_error():
    none = no_exponent("method", "nothing qualified")
    assert np.isnan(none.value) and np.isnan(none.error) and not none.found
    assert none.in_bits_per_period(5.0).reason == "nothing qualified"
