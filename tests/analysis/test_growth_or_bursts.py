"""Exponential growth, bursts or neither: closed forms, records of known answer; no number where there is none."""

import math

import numpy as np
import pytest

from analysis import envelope_of, growth_or_bursts

STEP, PERIOD = 0.05, 5.0
SWING = 0.2  # rad/s: half a swing is 15.7 s, within four periods


def times(periods):
    return STEP * np.arange(round(periods * PERIOD / STEP) + 1)


def swings(rate, periods, noise=0.0):
    """exp(rate t) sin with a relative error of each sample."""
    t = times(periods)
    error = 1.0 + noise * np.random.default_rng(0).uniform(-1.0, 1.0, len(t))
    return np.exp(rate * t) * np.sin(SWING * t) * error


@pytest.mark.parametrize("noise", [0.0, 0.5])
@pytest.mark.parametrize("rate", [-0.03, -0.005, 0.005, 0.03])
def test_a_swing_that_grows_or_decays_has_its_rate(rate, noise):
    growth = growth_or_bursts(1e-6 * swings(rate, 250, noise), STEP, PERIOD)
    assert growth.kind == ("growth" if rate > 0 else "decay")
    assert abs(growth.rate.value - rate) < 3 * growth.rate.error + 1e-4 * abs(rate)
    assert growth.rate.error < 0.2 * abs(rate)
    assert growth.rate.unit == "nats/time" and not len(growth.burst_size)
    assert growth.span_nats == pytest.approx(rate * (growth.end - growth.begin), rel=0.05)


def test_the_error_of_a_rate_is_between_one_and_a_half_and_three_times_the_scatter_of_noise():
    """It is wide on purpose: quarters of the straight part may differ by more than noise."""
    t, rate = times(150), 0.01
    deviations = []
    for seed in range(60):
        noise = np.random.default_rng(seed).lognormal(0.0, 0.5, len(t))
        growth = growth_or_bursts(1e-6 * np.exp(rate * t) * noise, STEP, PERIOD).rate
        deviations.append((growth.value - rate) / growth.error)
    assert 0.33 < np.std(deviations) < 0.67


@pytest.mark.parametrize(("rate", "share"), [(0.02, 0.05), (0.05, 0.25), (0.08, 0.25), (0.12, 0.25)])
def test_growth_that_saturates_is_fitted_up_to_its_saturation(rate, share):
    """Fast growth is soon over: ten nats in 17 periods are too few spans of half a swing, and enough single periods."""
    y = 5e-5 * swings(rate, 300)
    growth = growth_or_bursts(y / np.sqrt(1.0 + (np.exp(rate * times(300)) * 5e-5) ** 2), STEP, PERIOD)
    assert growth.kind == "growth"
    assert abs(growth.rate.value - rate) < min(3 * growth.rate.error, share * rate)
    assert growth.end < math.log(2e4) / rate + 12 * PERIOD, "the level afterwards takes no part"


def bursts_at(periods, sizes):
    """Bursts of half a second on a level of 1e-4 that wanders by half a nat, over 200 periods."""
    t = times(200)
    bells = (size * np.exp(-(((t - at * PERIOD) / 0.5) ** 2)) for at, size in zip(periods, sizes, strict=True))
    return 1e-4 * np.exp(0.5 * np.sin(0.11 * t)) + sum(bells)


def test_bursts_have_their_sizes_and_times():
    at, sizes = [12.5, 30.4, 31.6, 77.3, 150.5], [0.2, 0.3, 0.1, 0.4, 0.25]
    growth = growth_or_bursts(bursts_at(at, sizes), STEP, PERIOD)
    assert growth.kind == "bursts" and math.isnan(growth.rate.value) and math.isnan(growth.span_nats)
    # neighbours in the envelope are one burst: the smaller of 30.4 and 31.6 has no dip between
    assert growth.burst_time / PERIOD == pytest.approx([12.5, 30.4, 77.3, 150.5], abs=0.02)
    assert growth.burst_size == pytest.approx([0.2, 0.3, 0.4, 0.25], rel=0.01)


def test_a_straight_fall_between_two_bursts_is_no_decay():
    """Each burst dies out exponentially over 40 periods; the record comes back to its level, again and again."""
    t = times(250)
    y = 1e-9 + np.exp(-0.05 * (t % (50 * PERIOD))) * np.abs(np.sin(SWING * t))
    growth = growth_or_bursts(y, STEP, PERIOD)
    assert growth.kind == "bursts" and "comes back" in growth.reason


def test_a_change_of_less_than_the_stated_span_is_refused():
    y = swings(0.002, 200)  # two nats in all
    refused = growth_or_bursts(y, STEP, PERIOD)
    assert refused.kind == "neither" and "3 nats" in refused.reason
    assert growth_or_bursts(y, STEP, PERIOD, least_span=1.0).kind == "growth"


@pytest.mark.parametrize("seed", range(8))
def test_noise_about_a_level_has_neither_rate_nor_bursts(seed):
    y = np.random.default_rng(seed).lognormal(0.0, 0.5, len(times(250)))
    assert growth_or_bursts(y, STEP, PERIOD).kind == "neither"


@pytest.mark.parametrize(
    ("values", "why"),
    [(np.zeros(5001), "every value is zero"), (np.empty(0), "no values"), (np.ones(5001), "no straight part")],
)
def test_nothing_to_tell_is_told_with_a_reason(values, why):
    growth = growth_or_bursts(values, STEP, PERIOD)
    assert growth.kind == "neither" and why in growth.reason
    assert math.isnan(growth.rate.value) and math.isnan(growth.begin) and len(growth.burst_time) == 0


def test_the_envelope_is_the_largest_value_of_each_span_where_it_is():
    y = np.zeros(1001)
    y[[3, 150, 260, 999]] = [2.0, 1.0, 3.0, 0.5]
    time, size = envelope_of(y, STEP, PERIOD)
    assert len(size) == 10 and size[[0, 1, 2, 9]].tolist() == [2.0, 1.0, 3.0, 0.5]
    assert time[[0, 1, 2, 9]] == pytest.approx([0.15, 7.5, 13.0, 49.95])
