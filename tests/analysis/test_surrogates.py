"""What surrogates keep, what they do not, and how often a true null is rejected."""

import numpy as np
import pytest
from scipy.signal import lfilter

from analysis import (
    iaaft_surrogates,
    neighbour_growth,
    noisy_periodic_surrogates,
    normal_scores,
    prediction_gain,
    rank_among,
    spectral_lines,
)
from analysis.surrogates import null_ranks, rank_until_lost
from tests.analysis.systems import henon, logistic, normal

RECORDS = {
    "henon": henon(400),
    "logistic": logistic(3.9, 333),
    "saturated noise": np.tanh(2 * lfilter([1.0], [1.0, -0.7], normal(0, 500))),
}


@pytest.mark.parametrize("surrogates_of", [iaaft_surrogates, noisy_periodic_surrogates])
def test_shape_and_seed(surrogates_of):
    first, same, different = (surrogates_of(RECORDS["henon"], 3, seed) for seed in (5, 5, 6))
    assert first.shape == (3, 400, 2)
    assert np.array_equal(first, same) and not np.array_equal(first, different)
    assert not np.array_equal(first[0], first[1])


@pytest.mark.parametrize("name", RECORDS)
def test_iaaft_keeps_the_values_exactly_and_the_spectrum_closely(name):
    record = RECORDS[name]
    wanted = np.abs(np.fft.rfft(record, axis=0))
    for surrogate in iaaft_surrogates(record, 5, 1):
        assert np.array_equal(np.sort(surrogate, axis=0), np.sort(record, axis=0))
        got = np.abs(np.fft.rfft(surrogate, axis=0))
        assert np.sqrt(np.sum((got - wanted)[1:] ** 2) / np.sum(wanted[1:] ** 2)) < 0.06


def test_iaaft_keeps_what_columns_have_in_common():
    """Two coordinates of one linear process, position and lagged position."""
    x = lfilter([1.0], [1.0, -1.6, 0.9], normal(2, 603))[:600]
    record = np.column_stack([x[3:], x[:-3]])
    wanted = np.corrcoef(record.T)[0, 1]
    for surrogate in iaaft_surrogates(record, 5, 1):
        assert np.corrcoef(surrogate.T)[0, 1] == pytest.approx(wanted, abs=0.03)


def test_lines_of_a_clean_quasi_periodic_motion_are_found_to_rounding():
    k = np.arange(400)
    turn = 2 * np.pi * 0.1234567 * k
    motion = np.column_stack([np.cos(turn) + 0.4 * np.cos(2 * turn + 1), np.exp(np.sin(turn)) * (-1.0) ** k])
    lines = spectral_lines(motion)
    assert lines.unexplained.max() < 1e-8
    assert np.min(np.abs(lines.frequency - 0.1234567)) < 1e-8
    assert lines.amplitude[np.argmin(np.abs(lines.frequency - 0.1234567)), 0] == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("record", [normal(0, 400, 2), logistic(4.0, 400)])
def test_white_noise_and_strong_chaos_have_no_lines(record):
    assert len(spectral_lines(record).frequency) == 0


def test_noisy_periodic_surrogates_keep_the_lines_and_the_level_of_the_rest():
    k = np.arange(400)
    noise = 0.3 * normal(1, 400)
    record = np.array([0.0, 3.0, 1.0, 7.0])[k % 4] + noise
    for surrogate in noisy_periodic_surrogates(record, 5, 2):
        means = [surrogate[j::4].mean() for j in range(4)]
        assert means == pytest.approx([0.0, 3.0, 1.0, 7.0], abs=0.15)
        rest = surrogate - np.resize(means, 400)
        assert rest.std() == pytest.approx(0.3, rel=0.1)
        assert abs(np.corrcoef(rest, noise)[0, 1]) < 0.2


def test_normal_scores_forget_the_instrument():
    x = normal(4, 200, 2)
    assert np.array_equal(normal_scores(x), normal_scores(np.exp(x)))
    plain, distorted = (null_ranks(section, 19, 0) for section in (x, np.exp(x)))
    assert plain[0].statistic == distorted[0].statistic, "the linear null allows any instrument"
    assert plain[1].statistic != distorted[1].statistic


def test_a_rank_needs_enough_surrogates_and_counts_ties_against():
    drawn = np.arange(39.0)
    assert rank_among(38.5, drawn).above and rank_among(37.5, drawn).above
    assert not rank_among(36.5, drawn).above and not rank_among(37.0, drawn).above
    assert rank_among(100.0, drawn).advantage == 81.0


def test_a_rank_test_that_is_lost_stops():
    drawn = iter([0.0, 2.0, 0.5, 3.0, 9.0])
    lost = rank_until_lost(1.0, drawn, 39)
    assert lost.above is False and next(drawn) == 9.0, "two of 39 may not be as large"
    assert list(lost.surrogates) == [0.0, 2.0, 0.5, 3.0] and lost.share_below == 0.5
    assert rank_until_lost(1.0, iter([0.0] * 38 + [2.0]), 39).above
    assert rank_until_lost(1.0, iter([np.nan]), 39).above is None


@pytest.mark.slow
def test_a_linear_process_beats_its_nulls_about_once_in_twenty():
    """400 records; 5 % of them, within three standard deviations of that count (20 +- 13), through an instrument."""
    rng, above = np.random.default_rng(7), 0
    for _ in range(400):
        x = np.exp(lfilter([1.0], [1.0, -1.2, 0.8], rng.normal(size=170))[50:])
        scores = normal_scores(x)
        surrogates = (iaaft_surrogates(scores, 1, rng)[0] for _ in range(19))
        gains = (prediction_gain(surrogate).gain for surrogate in surrogates)
        above += rank_until_lost(prediction_gain(scores).gain, gains, 19).above
    assert 7 <= above <= 33


def test_a_gain_is_the_ratio_of_errors_and_a_rate_is_growth_over_the_time_between():
    result, growth = prediction_gain(logistic(3.9, 200)), neighbour_growth(logistic(3.9, 200))
    assert result.gain == pytest.approx(np.log(result.linear_error / result.local_error)) and result.gain > 1.0
    assert len(growth.distance) == 50 and growth.rate == pytest.approx(growth.growth / 34.75)
