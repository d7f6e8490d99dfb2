"""With noise the answer is the period or None, never another number."""

import numpy as np
import pytest

from analysis import detect_period

TOLERANCE = 1e-3
BRANCHES = np.array([0.0, 3.0, 1.0, 7.0, 5.0, 4.0, 2.0, 6.0])


def _answers(period, points, amplitude, trials=200):
    rng = np.random.default_rng(period * points)
    clean = BRANCHES[np.arange(points) % period]
    noise = amplitude * rng.uniform(-1, 1, (trials, points))
    return [detect_period(clean + row, scale=7.0, tolerance=TOLERANCE).period for row in noise]


@pytest.mark.parametrize("period", [1, 2, 4, 8])
@pytest.mark.parametrize("rounds", [16, 40])
def test_noise_well_within_the_tolerance_does_not_hide_the_period(period, rounds):
    """Two values differ by at most twice the noise amplitude: a quarter of the tolerance leaves a factor two."""
    assert set(_answers(period, max(rounds * period, 32), 0.25 * TOLERANCE * 7.0)) == {period}


@pytest.mark.parametrize("period", [4, 8])
def test_four_rounds_are_too_few_to_tell_noise_from_drift_always_but_mostly(period):
    """The multiplier from 2 or 3 steps a branch exceeds 1/2 by chance at times; that must stay rare and give None."""
    answers = _answers(period, 4 * period, 0.25 * TOLERANCE * 7.0)
    assert set(answers) <= {period, None}
    assert answers.count(period) >= 0.95 * len(answers)


@pytest.mark.parametrize("period", [1, 2, 4, 8])
@pytest.mark.parametrize("points", [32, 64, 200])
@pytest.mark.parametrize("share", [0.5, 0.6, 0.8, 1.5])
def test_noise_near_the_tolerance_gives_the_period_or_none_but_no_multiple_of_it(period, points, share):
    assert set(_answers(period, points, share * TOLERANCE * 7.0)) <= {period, None}


@pytest.mark.parametrize("period", [1, 2, 4])
def test_noise_above_the_tolerance_gives_none(period):
    assert set(_answers(period, 200, 5 * TOLERANCE * 7.0)) == {None}


def test_independent_errors_about_a_point_have_the_multiplier_minus_one_half():
    """Differences d_k = e_{k+1} - e_k of independent e have correlation -1/2 with their next ones."""
    noise = np.random.default_rng(0).normal(size=200000)
    estimate = detect_period(noise, max_period=3)
    assert estimate.multiplier == pytest.approx([-0.5] * 3, abs=0.01)
    assert estimate.trend_nats_per_period == pytest.approx([0.0] * 3, abs=1e-4)


def test_two_branches_nearer_than_the_tolerance_are_one_and_up_to_three_times_that_not_told_apart():
    k = np.arange(100)
    for split, period in ((0.5 * TOLERANCE, 1), (2 * TOLERANCE, None), (4 * TOLERANCE, 2)):
        assert detect_period(1.0 + split * (k % 2), scale=1.0, tolerance=TOLERANCE).period == period
