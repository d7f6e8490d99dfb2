"""The period is that of theory: maps, rotations, transients, noise; where there is none, the answer is None."""

import re

import numpy as np
import pytest

from analysis import detect_period
from tests.analysis.systems import circle, logistic, normal

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


@pytest.mark.parametrize(
    ("rate", "start"), [(3.65, 0.3), (3.75, 0.3), (3.9, 0.3), (4.0, 0.1), (4.0, 0.23), (4.0, 0.77)]
)
@pytest.mark.parametrize("points", [16, 24, 40, 64, 200, 2000])
def test_chaos_has_no_period(rate, start, points):
    assert detect_period(logistic(rate, points, start)).period is None


# sqrt: badly approximable; pi has the close return 113 (2e-6 turns away), the last one turns by a thousandth at a time.
@pytest.mark.parametrize("rotation", [(np.sqrt(5) - 1) / 2, np.sqrt(2) - 1, np.pi - 3, 0.001234567])
@pytest.mark.parametrize(("points", "max_period"), [(64, 16), (500, 128), (4000, 16), (4000, 1000)])
@pytest.mark.parametrize("coordinates", [1, 2])
def test_a_quasi_periodic_rotation_is_never_a_period(rotation, points, max_period, coordinates):
    orbit = circle(rotation * np.arange(points))[:, :coordinates]
    assert detect_period(orbit, max_period=max_period, scale=2.0).period is None


@pytest.mark.parametrize("length", [60, 61, 62])
def test_a_record_need_not_be_whole_rounds_and_its_orbit_ends_where_it_ends(length):
    record = np.resize([0.3, 5.0, -2.0], length)
    estimate = detect_period(record)
    assert estimate.period == 3 and estimate.points == length and estimate.scale == 7.0
    assert np.allclose(estimate.orbit[:, 0], record[-3:])


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


@pytest.mark.parametrize(
    ("motion", "projected"), [(0.9995 ** np.arange(2000), 0.5), (1e-9 * 1.05 ** np.arange(200), np.inf)]
)
def test_steps_within_the_tolerance_that_add_up_to_more_are_no_period(motion, projected):
    """A creep, each step half the tolerance with a third of the way still to go; and a departure that grows."""
    estimate = detect_period(motion, scale=1.0, tolerance=TOLERANCE)
    assert estimate.residual[0] < TOLERANCE < estimate.projected[0] and estimate.projected[0] >= 0.7 * projected
    assert estimate.period is None and "drift" in estimate.reason


@pytest.mark.parametrize(("drift", "period"), [(1.0, None), (0.01, 1)])
def test_a_slow_drift_below_fast_noise_is_no_period(drift, period):
    """A step of the drift is a third of the tolerance; the noise makes the multiplier -1/2, as about a fixed point."""
    rng, k = np.random.default_rng(1), np.arange(400)
    motion = 300.0 * TOLERANCE * drift * 0.999**k + rng.uniform(-0.3, 0.3, 400) * TOLERANCE
    estimate = detect_period(motion, scale=1.0, tolerance=TOLERANCE)
    assert max(estimate.residual[0], estimate.projected[0]) < TOLERANCE and estimate.period == period


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
    rest = 0.1 * abs(multiplier) ** (120 - 2 * period)
    assert estimate.projected[period - 1] == pytest.approx(rest, rel=1e-6)


def test_a_decay_is_a_period_after_as_many_more_periods_as_are_announced():
    decay = 0.9 ** np.arange(300)
    announced = int(re.search(r"(\d+) more forcing periods", detect_period(decay[:60], scale=1.0).reason)[1])
    for more, period in ((announced - 2, None), (announced + 1, 1)):
        assert detect_period(decay[more : more + 60], scale=1.0).period == period


def test_a_creep_by_the_last_digit_is_rounding_and_no_drift():
    creep = 20.8 + np.spacing(20.8) * np.arange(40)
    assert detect_period(creep, scale=1.0, tolerance=1e-12).period == 1


@pytest.mark.parametrize("points", [0, 1, 15])
def test_a_record_that_is_too_short_says_so(points):
    estimate = detect_period(np.zeros(points))
    assert estimate.period is None and np.all(np.isnan(estimate.residual))
    assert f"16 strobed points are needed at least, given {points}" in estimate.reason


def test_candidates_need_four_rounds_each():
    orbit = BRANCHES[np.arange(20) % 5]
    short = detect_period(orbit[:19])
    assert short.period is None and "up to 16 needs 64 points, given 19" in short.reason
    assert np.isfinite(short.residual[3]) and np.isnan(short.residual[4])
    assert detect_period(orbit).period == 5


def answers(period, points, share):
    """Periods found with noise of this share of the tolerance."""
    rng = np.random.default_rng(period * points)
    clean = BRANCHES[np.arange(points) % period]
    noise = share * TOLERANCE * 7.0 * rng.uniform(-1, 1, (60, points))
    return [detect_period(clean + row, scale=7.0, tolerance=TOLERANCE).period for row in noise]


@pytest.mark.parametrize("period", [1, 2, 4, 8])
def test_noise_gives_the_period_then_the_period_or_none_but_no_multiple_of_it_and_then_none(period):
    """Two values differ by at most twice the noise amplitude: a quarter of the tolerance leaves a factor two."""
    for rounds in (16, 40):
        assert set(answers(period, max(rounds * period, 32), 0.25)) == {period}
    for points in (32, 200):
        for share in (0.5, 0.6, 0.8, 1.5):
            assert set(answers(period, points, share)) <= {period, None}
        assert set(answers(period, points, 5.0)) == {None}


def test_independent_errors_about_a_point_have_the_multiplier_minus_one_half():
    """Differences d_k = e_{k+1} - e_k of independent e have correlation -1/2 with their next ones."""
    estimate = detect_period(normal(0, 200000), max_period=3)
    assert estimate.multiplier == pytest.approx([-0.5] * 3, abs=0.01)
    assert estimate.trend_nats_per_period == pytest.approx([0.0] * 3, abs=1e-4)


@pytest.mark.parametrize(("split", "period"), [(0.5, 1), (2, None), (4, 2)])
def test_two_branches_nearer_than_the_tolerance_are_one_and_up_to_three_times_that_not_told_apart(split, period):
    branches = 1.0 + split * TOLERANCE * (np.arange(100) % 2)
    assert detect_period(branches, scale=1.0, tolerance=TOLERANCE).period == period
