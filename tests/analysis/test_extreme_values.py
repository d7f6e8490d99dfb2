"""Extremes are samples; the share of time below a level, against closed forms."""

from dataclasses import astuple

import numpy as np
import pytest

from analysis import Extremes, block_maxima, extremes, slack_fraction
from tests.analysis.systems import normal


def test_extremes_are_those_of_the_samples_after_the_transient():
    t = 0.05 * np.arange(401)
    result = extremes(3.0 * np.sin(2 * np.pi / 5 * t) + 1.0, 0.05)
    assert astuple(result) == pytest.approx((-2.0, 3.75, 4.0, 1.25))
    x = [9.0, -9.0, 0.0, 1.0, -1.0, 1.0, -1.0]
    assert extremes(x, 2.0, transient_s=4.0) == Extremes(-1.0, 8.0, 1.0, 6.0)
    assert extremes(x, 2.0, transient_s=12.0) == Extremes(-1.0, 12.0, -1.0, 12.0)


@pytest.mark.parametrize("threshold", [-0.9, -0.2, 0.0, 0.5, 0.9])
@pytest.mark.parametrize(("samples", "phase"), [(100, 0.0), (317, 0.3), (1000, np.sqrt(2))])
def test_a_cosine_is_below_a_level_for_one_minus_arccos_over_pi(threshold, samples, phase):
    """A chord misses a crossing by at most |x''| d^2/(8 |x'|), d the step in radians: two crossings per turn. What is
    below the level of a motion is above that of its mirror image."""
    d = 2 * np.pi / samples
    x = np.cos(d * np.arange(samples * 5 + 1) + phase)
    result = slack_fraction(x, 5.0 / samples, threshold_N=threshold).fraction
    bound = 2 * d**2 / 8 * abs(threshold) / np.sqrt(1 - threshold**2) / (2 * np.pi)
    assert abs(result - (1.0 - np.arccos(threshold) / np.pi)) <= bound + d**3 / 10
    above = slack_fraction(-x, 5.0 / samples, threshold_N=-threshold).fraction
    assert result + above == pytest.approx(1.0, abs=1e-12)


def test_time_at_the_level_counts():
    """A tension-only tether is slack at exactly zero."""
    assert slack_fraction([0.0, 0.0, 0.0], 1.0).fraction == 1.0
    assert slack_fraction(np.repeat([1.0, 0.0, 1.0], 40), 1.0).fraction == pytest.approx(39 / 119)
    assert slack_fraction([1.0, 2.0, 1.0], 1.0).fraction == 0.0


@pytest.mark.parametrize("step_s", [0.05, 0.02, 0.004, 0.001])
def test_snaps_within_a_step_do_not_end_the_slack_early(step_s):
    """A tension just below the level for 0.6 of the time, and high above it for the rest of each 0.0873 s."""
    t = step_s * np.arange(round(40.0 / step_s))
    tension_N = np.where(t % 0.0873 < 0.6 * 0.0873, -1e-3, 1e4)
    assert slack_fraction(tension_N, step_s).fraction == pytest.approx(0.6, abs=0.02)


@pytest.mark.parametrize("transient", [0.0, 0.8, 1.0, 2.35])
def test_a_transient_is_left_out_to_the_moment_even_between_samples(transient):
    """A straight line from -1 to 4 over 5 s is slack until 1 s."""
    result = slack_fraction(np.linspace(-1.0, 4.0, 101), 0.05, transient_s=transient)
    assert result.record_s == 5.0 - transient and result.slack_s == pytest.approx(max(1.0 - transient, 0.0))
    assert result.fraction == pytest.approx(max(1.0 - transient, 0.0) / (5.0 - transient), abs=1e-15)


def test_blocks_of_blocks_are_longer_blocks_and_a_part_of_one_counts_for_nothing():
    x = normal(1, 1003)
    tens = block_maxima(x, 10)
    assert len(tens) == 100 and np.array_equal(block_maxima(tens, 5), block_maxima(x, 50))
    assert np.array_equal(block_maxima(x, 1), x) and len(block_maxima(x, 1004)) == 0
