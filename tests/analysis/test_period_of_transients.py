"""A motion that is still on its way has no period yet; how far it has to go decides, not how slowly it moves."""

import numpy as np
import pytest

from analysis import detect_period

TOLERANCE = 1e-3


@pytest.mark.parametrize("multiplier", [0.5, 0.9, 0.98, 0.995, -0.5, -0.9, -0.98])
@pytest.mark.parametrize("points", [40, 100, 400, 4000])
def test_a_geometric_decay_is_periodic_once_what_is_left_fits_the_tolerance(multiplier, points):
    """x_k = m^k is m^k from its limit. Left over the last part: at most the first step there; at the end: m^points."""
    estimate = detect_period(multiplier ** np.arange(points), scale=1.0, tolerance=TOLERANCE)
    # Where the last part (at least the last half) begins, and where the record ends.
    at_its_start, at_its_end = abs(multiplier) ** (points // 2 - 1), abs(multiplier) ** points
    if at_its_end > TOLERANCE:
        assert estimate.period is None
    if 2 * at_its_start < TOLERANCE:
        assert estimate.period == 1


def test_steps_within_the_tolerance_that_add_up_to_more_are_no_period():
    """0.9995^k from 1: each step is half the tolerance, and a third of the way is still to go after 2000 periods."""
    estimate = detect_period(0.9995 ** np.arange(2000), scale=1.0, tolerance=TOLERANCE)
    assert estimate.residual[0] < TOLERANCE
    assert estimate.period is None
    assert "drift" in estimate.reason


@pytest.mark.parametrize("multiplier", [0.8, 0.95, 0.99, -0.8, -0.95])
@pytest.mark.parametrize("period", [1, 2, 3, 5])
def test_the_multiplier_and_the_trend_are_those_of_the_decay(multiplier, period):
    """Towards a period-N orbit the distance shrinks by m per forcing period, so by m^N per return."""
    k = np.arange(120)
    branches = np.array([0.0, 3.0, 1.0, 7.0, 5.0])[:period]
    estimate = detect_period(branches[k % period] + 0.1 * multiplier**k, scale=1.0, tolerance=1e-12)
    assert estimate.period is None
    assert estimate.multiplier[period - 1] == pytest.approx(multiplier**period, rel=1e-6)
    assert estimate.trend_nats_per_period[period - 1] == pytest.approx(np.log(abs(multiplier)), rel=1e-6)
    # The largest of the last N steps begins somewhere in the last but one round.
    left = 0.1 * abs(multiplier) ** (120 - 2 * period)
    assert estimate.projected[period - 1] == pytest.approx(left, rel=1e-6)


def test_a_creep_by_the_last_digit_is_rounding_and_no_drift():
    creep = 20.8 + np.spacing(20.8) * np.arange(40)
    assert detect_period(creep, scale=1.0, tolerance=1e-12).period == 1


def test_a_growing_departure_from_an_unstable_point_is_no_period():
    estimate = detect_period(1e-9 * 1.05 ** np.arange(200), scale=1.0, tolerance=TOLERANCE)
    assert estimate.residual[0] < TOLERANCE
    assert estimate.projected[0] == np.inf
    assert estimate.period is None


@pytest.mark.parametrize("turn", [0.1, 1.0, 1.25, 2.0])
def test_a_decaying_spiral_is_reported_as_a_transient_and_later_as_period_1(turn):
    k = np.arange(1200)
    spiral = 0.98**k * np.exp(1j * turn * k)
    orbit = np.column_stack([spiral.real, spiral.imag])
    early = detect_period(orbit[:200], scale=1.0, tolerance=TOLERANCE)
    assert early.period is None and "transient" in early.reason
    assert np.min(np.abs(early.trend_nats_per_period - np.log(0.98))) < 1e-3
    assert detect_period(orbit, scale=1.0, tolerance=TOLERANCE).period == 1


def test_what_happened_before_the_last_half_does_not_matter():
    k = np.arange(200)
    late = np.where(k % 2 == 0, 0.2, -0.4)
    orbit = np.where(k < 90, np.random.default_rng(0).normal(size=200), late)
    assert detect_period(orbit, scale=1.0).period == 2


def test_a_record_that_is_too_short_says_so():
    for points in (0, 1, 15):
        estimate = detect_period(np.zeros(points))
        assert estimate.period is None
        assert f"16 strobed points are needed at least, given {points}" in estimate.reason
        assert np.all(np.isnan(estimate.residual))
    assert detect_period(np.zeros(16)).period == 1


def test_candidates_need_four_rounds_each():
    orbit = np.resize([0.0, 3.0, 1.0, 7.0, 5.0], 20)
    short, enough = detect_period(orbit[:19]), detect_period(orbit)
    assert short.period is None and "up to 16 needs 64 points, given 19" in short.reason
    assert np.isfinite(short.residual[3]) and np.isnan(short.residual[4])
    assert enough.period == 5


def test_a_period_beyond_the_largest_candidate_is_not_found():
    orbit = np.resize([0.0, 3.0, 1.0, 7.0, 5.0], 200)
    assert detect_period(orbit, max_period=4).period is None
    assert detect_period(orbit, max_period=5).period == 5


@pytest.mark.parametrize("wrong", [dict(scale=0.0), dict(scale=[1.0, 2.0]), dict(tolerance=0.0), dict(max_period=0)])
def test_a_scale_tolerance_or_limit_without_meaning_is_refused(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        detect_period(np.zeros(100), **wrong)
