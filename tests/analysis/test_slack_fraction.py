"""The share of time below a level, against the arc cosine of a sine and exact results for straight lines."""

import numpy as np
import pytest

from analysis import slack_fraction


@pytest.mark.parametrize("threshold", [-0.9, -0.2, 0.0, 0.5, 0.9])
@pytest.mark.parametrize("samples", [100, 317, 1000])
@pytest.mark.parametrize("phase", [0.0, 0.3, np.sqrt(2)])
def test_a_cosine_is_below_a_level_for_one_minus_arccos_over_pi(threshold, samples, phase):
    """A chord misses a crossing by at most |x''| d^2/(8 |x'|), d the step in radians: two crossings per turn."""
    d = 2 * np.pi / samples
    x = np.cos(d * np.arange(samples * 5 + 1) + phase)
    found = slack_fraction(x, 5.0 / samples, threshold_N=threshold).fraction
    bound = 2 * d**2 / 8 * abs(threshold) / np.sqrt(1 - threshold**2) / (2 * np.pi)
    assert abs(found - (1.0 - np.arccos(threshold) / np.pi)) <= bound + d**3 / 10


@pytest.mark.parametrize(
    ("low", "high", "share"), [(-1.0, 3.0, 0.25), (-1.0, 1.0, 0.5), (0.0, 1.0, 0.0), (-2.0, 0.0, 1.0)]
)
def test_a_straight_line_is_exact_with_two_samples(low, high, share):
    for ends in ((low, high), (high, low)):
        assert slack_fraction(ends, 0.7).fraction == pytest.approx(share, abs=1e-15)


def test_a_saw_is_exact_whatever_its_sampling():
    t = np.arange(0, 20.01, 0.5)
    saw = np.abs((t % 4) - 2) - 0.5  # between -0.5 and 1.5, below zero for a quarter of the time
    result = slack_fraction(saw, 0.5)
    assert result.fraction == pytest.approx(0.25, abs=1e-14)
    assert (result.slack_s, result.record_s) == pytest.approx((5.0, 20.0))


def test_the_two_sides_of_a_level_share_the_time():
    x = np.random.default_rng(0).normal(size=1000)
    below, above = slack_fraction(x, 0.1, 0.3), slack_fraction(-x, 0.1, -0.3)
    assert below.fraction + above.fraction == pytest.approx(1.0, abs=1e-12)


def test_the_level_only_shifts_the_series():
    x = np.random.default_rng(0).normal(size=1000)
    assert slack_fraction(x, 0.1, 0.3).fraction == pytest.approx(slack_fraction(x - 0.3, 0.1).fraction, abs=1e-12)


def test_time_at_the_level_counts():
    """A tension-only tether is slack at exactly zero."""
    assert slack_fraction([0.0, 0.0, 0.0], 1.0).fraction == 1.0
    assert slack_fraction([1.0, 0.0, 0.0, 1.0], 1.0).fraction == pytest.approx(1 / 3)
    assert slack_fraction([1.0, 2.0, 1.0], 1.0).fraction == 0.0


@pytest.mark.parametrize("transient", [0.0, 0.8, 1.0, 2.35])
def test_a_transient_is_left_out_to_the_moment_even_between_samples(transient):
    """A straight line from -1 to 4 over 5 s is slack until 1 s."""
    result = slack_fraction(np.arange(-1.0, 5.0), 1.0, transient_s=transient)
    assert result.record_s == pytest.approx(5.0 - transient)
    assert result.slack_s == pytest.approx(max(1.0 - transient, 0.0), abs=1e-15)


def test_a_record_within_the_transient_is_refused():
    for tension, transient in ((np.ones(11), 1.5), ([], 0.0), ([1.0], 0.0), (np.ones(11), 1.0)):
        with pytest.raises(ValueError, match="transient"):
            slack_fraction(tension, 0.1, transient_s=transient)
