"""The maximum of a storm: its interval covers the truth of known laws, and two motions in one record are told."""

import math

import numpy as np
import pytest
from scipy import optimize, stats

from analysis import storm_maximum
from analysis.storm_maxima import _by_order
from tests.analysis.systems import normal

STEP_S, MEMORY = 5.0, 6  # a peak every step; peaks of a cluster
LAWS = {"exponential": stats.expon(), "Rayleigh": stats.rayleigh(), "log-normal": stats.lognorm(0.5)}
LAWS["Weibull"] = stats.weibull_min(0.75)
PLANS = ((8, 1.0), (20, 3.0), (6, 0.5))  # records and their hours


def record_of(law, peaks, clustered, rng):
    """Independent peaks, or clusters: the maximum of neighbours, whose largest has a closed law."""
    if not clustered:
        return law.rvs(peaks, random_state=rng)
    even = rng.random(peaks + MEMORY - 1)
    largest = np.lib.stride_tricks.sliding_window_view(even, MEMORY).max(axis=1)
    return law.ppf(largest**MEMORY)


def truth_of(law, clustered):
    """The level that the maximum of three hours stays below in 37 % of all storms."""
    peaks = 3 * 3600 / STEP_S
    if clustered:
        peaks = (peaks + MEMORY - 1) / MEMORY
    return law.ppf(math.exp(-1.0 / peaks))


def covered(count, clustered, seed):
    rng, hits = np.random.default_rng(seed), []
    for number in range(count):
        law = list(LAWS.values())[number % len(LAWS)]
        records, hours = PLANS[number // len(LAWS) % len(PLANS)]
        sea = [record_of(law, int(hours * 3600 / STEP_S), clustered, rng) for _ in range(records)]
        answer = storm_maximum(sea, STEP_S, least_block_s=20 * STEP_S)
        hits.append(answer.low <= truth_of(law, clustered) <= answer.high)
    return np.mean(hits)


@pytest.mark.slow
@pytest.mark.parametrize("clustered", [False, True], ids=["independent", "clustered"])
def test_the_interval_covers_the_truth_in_86_to_94_of_100_records(clustered):
    """240 records tell 0.90 to 0.019: an interval for 80 % misses the bounds by three of these, one for 98 % by two."""
    assert 0.86 <= covered(240, clustered, seed=1) <= 0.94


def test_the_estimate_of_a_long_record_is_near_the_truth():
    law, rng = LAWS["Rayleigh"], np.random.default_rng(3)
    answer = storm_maximum([law.rvs(2160, random_state=rng) for _ in range(40)], STEP_S)
    assert answer.found and answer.value == pytest.approx(truth_of(law, False), rel=0.02)
    assert answer.low < answer.value < answer.high


@pytest.mark.parametrize("seed", range(4))
def test_the_shape_of_few_maxima_balances_likelihood_and_a_normal_prior_of_standard_deviation_015(seed):
    """By scipy's law: twelve maxima of Gumbel's law, which alone leave the shape open to some 0.2."""
    maxima = np.random.default_rng(seed).gumbel(3.0, 0.5, size=12)

    def misfit(parameters):
        place, log_scale, shape = parameters
        likelihood = stats.genextreme.logpdf(maxima, -shape, place, math.exp(log_scale)).sum()
        return -likelihood - stats.norm.logpdf(shape, 0.0, 0.15)

    best = optimize.minimize(misfit, (3.0, math.log(0.5), 0.01), method="Nelder-Mead", options={"xatol": 1e-5})
    answer = storm_maximum([[peak] for peak in maxima], 1800.0, storm_s=1800.0 * 12)
    assert answer.blocks == 12 and answer.shape == pytest.approx(best.x[2], abs=1e-3)


def two_motions(records, hours, rng):
    """Peaks near 1, and near 5 in one visit of a dozen waves an hour."""
    sea = []
    for _ in range(records):
        peaks = 1.0 + 0.1 * rng.gumbel(size=int(hours * 720))
        for hour in range(math.ceil(hours)):
            if rng.random() < 0.6:
                begin = int(hour * 720 + rng.integers(0, min(700, len(peaks))))
                peaks[begin : begin + 12] = 5.0 + 0.3 * rng.gumbel(size=len(peaks[begin : begin + 12]))
        sea.append(peaks)
    return sea


def test_two_motions_are_refused_where_no_block_holds_both_and_answered_where_storms_do():
    rng = np.random.default_rng(5)
    refused = storm_maximum(two_motions(12, 1.0, rng), STEP_S)
    assert not refused.found and "two motions" in refused.reason
    answer = storm_maximum(two_motions(30, 9.0, rng), STEP_S)
    assert answer.found and 5.0 < answer.low < answer.high < 7.0


def test_the_interval_by_order_ends_where_five_in_a_hundred_lie_beyond():
    """Of 60 storms, whose largest values are 0 to 59: how many lie below the quantile is binomial."""
    answer = _by_order([[float(rank)] for rank in range(60)], 1, 3 * 3600.0, 0.9, "")
    below = stats.binom(60, math.exp(-1.0))
    assert below.cdf(answer.low) < 0.05 <= below.cdf(answer.low + 1)
    assert below.cdf(answer.high - 1) < 0.95 <= below.cdf(answer.high)


def test_no_block_is_shorter_than_the_least():
    blocks_s = [storm_maximum([normal(1, 700)], STEP_S, least_block_s=least_s).block_s for least_s in (55.0, 56.0)]
    assert blocks_s[0] == 55.0 and blocks_s[1] > 56.0


def test_too_little_is_refused():
    answer = storm_maximum([normal(1, 700)], STEP_S, least_block_s=1000.0)
    assert not answer.found and answer.reason
