"""The period is that of theory: maps, rotations, transients, noise; where there is none, the answer is None."""

import numpy as np
import pytest

from analysis import detect_period
from tests.analysis.maps import logistic

TOLERANCE = 1e-3
BRANCHES = np.array([0.0, 3.0, 1.0, 7.0, 5.0, 4.0, 2.0, 6.0])


# Windows: 1 < r < 3; 3 < r < 1 + sqrt 6; to 3.5441; to 3.5644; period 3 from 1 + sqrt 8 to 3.8415, then doubled.
@pytest.mark.parametrize(
    ("rate", "period"), [(2.8, 1), (3.2, 2), (3.4, 2), (3.5, 4), (3.55, 8), (3.566, 16), (3.832, 3), (3.845, 6)]
)
@pytest.mark.parametrize("points", [64, 201, 1000])
def test_windows_of_the_logistic_map(rate, period, points):
    estimate = detect_period(logistic(rate, points))
    assert estimate.period == period, estimate.reason
    assert estimate.points == points


@pytest.mark.parametrize(
    ("rate", "start"), [(3.65, 0.3), (3.75, 0.3), (3.9, 0.3), (4.0, 0.1), (4.0, 0.23), (4.0, 0.77)]
)
@pytest.mark.parametrize("points", [16, 24, 40, 64, 200, 2000])
def test_chaos_has_no_period(rate, start, points):
    assert detect_period(logistic(rate, points, start)).period is None


# sqrt: badly approximable; pi has the close return 113 (2e-6 turns away), the last one turns by a thousandth at a time.
@pytest.mark.parametrize("rotation", [(np.sqrt(5) - 1) / 2, np.sqrt(2) - 1, np.pi - 3, 0.001234567])
@pytest.mark.parametrize(("points", "max_period"), [(64, 16), (500, 128), (4000, 16), (4000, 1000)])
@pytest.mark.parametrize("projection", ["circle", "line"])
def test_a_quasi_periodic_rotation_is_never_a_period(rotation, points, max_period, projection):
    angle = 2 * np.pi * rotation * np.arange(points)
    orbit = np.column_stack([np.cos(angle), np.sin(angle)]) if projection == "circle" else np.cos(angle)
    estimate = detect_period(orbit, max_period=max_period, scale=2.0)
    assert estimate.period is None


def test_close_returns_fool_the_residual_but_not_the_answer():
    angle = 2 * np.pi * (np.pi - 3) * np.arange(1000)
    estimate = detect_period(np.column_stack([np.cos(angle), np.sin(angle)]), max_period=128)
    assert estimate.residual[112] < estimate.tolerance < estimate.projected[112]
    assert "drift" in estimate.reason


@pytest.mark.parametrize(("turns", "period"), [(1, 7), (2, 7), (3, 12), (4, 12), (1, 1)])
def test_a_rational_rotation_has_its_denominator(turns, period):
    angle = 2 * np.pi * turns / period * np.arange(100)
    expected = period // np.gcd(turns, period)
    assert detect_period(np.column_stack([np.cos(angle), np.sin(angle)]), scale=2.0).period == expected


def test_a_torus_on_a_period_2_motion_is_no_period():
    k = np.arange(300)
    angle = 2 * np.pi * 0.1234567 * k
    orbit = np.column_stack([(-1.0) ** k + 0.1 * np.cos(angle), 0.1 * np.sin(angle)])
    assert detect_period(orbit, scale=2.0).period is None
    assert detect_period(orbit, scale=2.0, tolerance=0.2).period == 2  # seen from afar the torus is two points


def test_the_orbit_is_given_in_the_order_visited_and_ends_where_the_record_ends():
    branch = np.array([0.3, 5.0, -2.0])
    for length in (60, 61, 62):
        estimate = detect_period(np.resize(branch, length))
        assert estimate.period == 3
        assert np.allclose(estimate.orbit[:, 0], np.resize(branch, length)[-3:])


def test_a_coordinate_that_never_moves_does_not_matter():
    x = logistic(3.2, 100)
    assert detect_period(np.column_stack([x, np.zeros(100), np.full(100, 20.8)])).period == 2
    assert detect_period(np.zeros(100)).period == 1


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
    estimate = detect_period(BRANCHES[k % period] + 0.1 * multiplier**k, scale=1.0, tolerance=1e-12)
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
    orbit = BRANCHES[np.arange(20) % 5]
    short, enough = detect_period(orbit[:19]), detect_period(orbit)
    assert short.period is None and "up to 16 needs 64 points, given 19" in short.reason
    assert np.isfinite(short.residual[3]) and np.isnan(short.residual[4])
    assert enough.period == 5


@pytest.mark.parametrize("wrong", [dict(scale=0.0), dict(scale=[1.0, 2.0]), dict(tolerance=0.0), dict(max_period=0)])
def test_a_scale_tolerance_or_limit_without_meaning_is_refused(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        detect_period(np.zeros(100), **wrong)


def _answers(period, points, amplitude, trials=60):
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
    answers = _answers(period, 4 * period, 0.25 * TOLERANCE * 7.0, trials=200)
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
