"""Exponent of a sea and its error, groups of responses, residence, slow forecast: systems with closed answers."""

import numpy as np
import pytest

from analysis import growing_share, peaks, residence, responses, sea_lyapunov, slow_forecast, spells_of
from tests.analysis.systems import normal


def growth(count, rng, mean=-0.05, memory=0.9):
    """Growth that depends on wave groups: an autoregression about its mean."""
    noise, out, state = rng.normal(0.0, 0.1, count), np.empty(count), 0.0
    for number in range(count):
        state = memory * state + noise[number]
        out[number] = mean + state
    return out


@pytest.mark.parametrize("memory", [0.0, 0.7, 0.9])
def test_deviations_of_twenty_pieces_are_as_large_as_their_errors(memory):
    rng = np.random.default_rng(2)
    deviations = []
    for _ in range(30):
        pieces = [sea_lyapunov([growth(400, rng, memory=memory)]) for _ in range(20)]
        mean = np.mean([piece.value for piece in pieces])
        deviations.append(np.std([(piece.value - mean) / piece.error for piece in pieces], ddof=1))
    assert 0.8 < np.mean(deviations) < 1.25


def test_the_exponent_of_several_seas_is_their_mean_within_its_error():
    rng = np.random.default_rng(3)
    exponent = sea_lyapunov([growth(600, rng) for _ in range(8)], 20)
    assert abs(exponent.value + 0.05 / np.log(2.0)) < 3.0 * exponent.error < 0.3
    assert not sea_lyapunov([np.zeros(20)]).found


def test_errors_of_two_seas_join_as_independent_ones():
    pair = [growth(400, np.random.default_rng(seed)) for seed in (1, 2)]
    alone = [sea_lyapunov([growth_nats]).error for growth_nats in pair]
    assert sea_lyapunov(pair).error == pytest.approx(np.hypot(*alone) / 2)


def test_of_seas_that_scatter_more_than_their_errors_the_scatter_is_the_error():
    rng = np.random.default_rng(5)
    exponent = sea_lyapunov([growth(400, rng, mean) for mean in (-0.9, 0.0, 0.9)])
    assert exponent.error == pytest.approx(np.std(exponent.details["seas"], ddof=1) / np.sqrt(3.0))


def test_windows_that_grow_are_counted():
    assert growing_share([1, 1, -3, 1, 1, 1, -1, -1, 5], 2) == 0.5


def pulled(starts, waves, contraction):
    """x' = c x + a forcing that is the same for all starts: they come together at the rate c."""
    forcing = normal(4, waves)
    states = np.zeros((len(starts), waves, 1))
    x = np.array(starts, dtype=float)
    for wave in range(waves):
        x = contraction * x + forcing[wave]
        states[:, wave, 0] = x
    return states


def test_starts_of_a_contraction_come_together_when_their_distance_says_so():
    answer = responses(pulled([0.0, 1.0, 2.0], 100, 0.8), [1.0], 0.01)
    expected = np.log(0.01 / 1.0) / np.log(0.8) - 1.0  # neighbours of three starts are 1 apart
    assert answer.together_at == pytest.approx(expected, abs=1.0)
    assert answer.counts[0] == 3 and answer.counts[-1] == 1 and answer.partings == 0 and answer.noise < 1e-3


def test_two_attractors_stay_two_responses():
    states = np.stack([np.full((50, 1), value) for value in (0.0, 0.001, 1.0)])
    answer = responses(states, [1.0], 0.01)
    assert set(answer.counts) == {2} and np.isnan(answer.together_at)


def test_starts_that_part_for_a_while_are_counted():
    apart = np.ones(100)
    apart[5:10] = apart[20:50] = apart[70:] = 0.0  # five samples are a passing by
    answer = responses(np.stack([np.zeros((100, 1)), apart[:, None]]), [1.0], 0.01)
    assert (answer.together_at, answer.together_mean, answer.partings) == (20, 30, 1)
    assert answer.together_share == pytest.approx(60 / 80)


def test_residence_counts_visits():
    flags = np.array([0, 1, 1, 0, 0, 1, 0, 0], dtype=bool)
    assert spells_of(flags) == [(1, 3), (5, 6)]
    answer = residence([flags, ~flags])
    assert (answer.share, answer.mean, answer.visits) == (0.5, pytest.approx(8 / 5), 5)


def test_the_forecast_jumps_only_where_a_motion_ends():
    amplitude, ranges = [0.5, 1.5, 2.5, 1.5, 0.5, 1.5], [(0.0, 2.0), (1.0, np.inf)]
    assert slow_forecast(amplitude, ranges, 0).tolist() == [0, 0, 1, 1, 0, 0]
    assert slow_forecast([1.5, 1.5], ranges, 1).tolist() == [1, 1]


def test_each_wave_has_one_peak():
    series = np.sin(2 * np.pi * np.arange(0.5, 100.5) / 10.0 + 3.0)
    assert len(peaks(series)) in (9, 10) and np.allclose(np.diff(peaks(series)), 10)
