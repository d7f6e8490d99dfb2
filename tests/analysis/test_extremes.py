"""Extremes are samples, with the time at which they are first reached."""

import numpy as np
import pytest

from analysis import extremes


def test_extremes_of_a_sine_with_their_times():
    t = 0.05 * np.arange(401)
    found = extremes(3.0 * np.sin(2 * np.pi / 5 * t) + 1.0, 0.05)
    assert (found.maximum, found.minimum) == pytest.approx((4.0, -2.0))
    assert (found.maximum_time_s % 5, found.minimum_time_s % 5) == pytest.approx((1.25, 3.75))


def test_turning_the_series_over_swaps_them():
    x = np.random.default_rng(0).normal(size=300)
    up, down = extremes(x, 0.1), extremes(-x, 0.1)
    assert (up.maximum, up.maximum_time_s) == (-down.minimum, down.minimum_time_s)
    assert (up.minimum, up.minimum_time_s) == (-down.maximum, down.maximum_time_s)


def test_the_first_of_equal_extremes_is_named():
    found = extremes([0.0, 1.0, -1.0, 1.0, -1.0], 2.0)
    assert (found.maximum_time_s, found.minimum_time_s) == (2.0, 4.0)


def test_a_transient_is_left_out_and_times_still_count_from_the_first_sample():
    x = np.array([9.0, -9.0, 1.0, 2.0, 0.0])
    found = extremes(x, 0.1, transient_s=0.2)
    assert (found.maximum, found.minimum) == (2.0, 0.0)
    assert (found.maximum_time_s, found.minimum_time_s) == pytest.approx((0.3, 0.4))
    assert extremes(x, 0.1, transient_s=0.4).maximum == 0.0


def test_a_record_within_the_transient_is_refused():
    for series, transient in (([1.0, 2.0], 0.3), ([], 0.0)):
        with pytest.raises(ValueError, match="longer than the transient"):
            extremes(series, 0.1, transient_s=transient)
