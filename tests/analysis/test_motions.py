"""Every start of a forced system is put to the motion that it ends in: settled, joined, grouped, matched, shares."""

import numpy as np
import pytest

from analysis import Settled, distance, grouped, joins, matched, remains, settled, share_of
from tests.analysis.systems import circle_map, henon, wells

PERIODS = 200


def of_map(orbit):
    """Settled of an orbit (n, d) of a map, which stays at its states for a period; None: not yet."""
    return settled(orbit, orbit[:-1], scale=np.ones(orbit.shape[1]))


def motion_at(*states, period=1):
    """Settled at these states, whose measures are all 1."""
    points = np.reshape(states, (len(states), -1))
    return Settled(period, points, np.ones((len(points), 1)), np.ones(1), "")


def test_every_start_is_put_to_its_motion():
    """Duffing's two wells at force .26 have a period 1 each, and both of them a period 5. Who joins is right later."""
    orbits, extremes = wells(np.random.default_rng(1).uniform(-1.5, 1.5, (40, 2)), PERIODS)
    runs = list(zip(orbits.swapaxes(0, 1), extremes.swapaxes(0, 1), strict=True))
    late = [settled(*run, scale=(1.0, 1.0)) for run in runs]
    assert None not in late
    label = grouped(late)
    known = [late[list(label).index(motion)] for motion in range(3)]
    assert sorted(m.period for m in known) == [1, 1, 5] and label.max() == 2
    well = [np.sign(motion.points[:, 0].mean()) for motion in known if motion.period == 1]
    assert sorted(well) == [-1.0, 1.0]
    joined = []
    for (run, measures), ends in zip(runs, label, strict=True):
        reached = ((n, joins(run[: n + 1], measures[:n], known)) for n in range(1, PERIODS))
        reached_at, motion = next((n, index) for n, index in reached if index is not None)
        assert motion == ends
        joined.append(reached_at)
    assert np.median(joined) < 30


@pytest.mark.parametrize("multiplier", (0.9, 0.99, 0.998, -0.99, 0.98 * np.exp(0.7j)))
def test_a_slow_decay_has_not_settled_while_it_has_far_to_go(multiplier):
    decay = 0.3 * np.asarray(multiplier, dtype=complex) ** np.arange(600)
    x = 2.0 + np.column_stack([decay.real, decay.imag])
    result = [(n, of_map(x[: n + 1])) for n in range(20, 600, 20)]
    result = [(n, motion) for n, motion in result if motion is not None]
    for n, motion in result:
        assert motion.period == 1
        assert np.abs(motion.points - 2.0).max() < 0.03
        assert abs(decay[n]) < 0.02
    assert result or abs(multiplier) > 0.995


def test_a_motion_without_period_settles_and_is_one_motion():
    orbit, torus = henon(1200), circle_map(0.9, 0.31, 400)
    parts = [of_map(part) for part in np.split(orbit, 8)]
    parts = [part for part in parts if part is not None]
    assert len(parts) >= 6 and {part.period for part in parts} == {None}
    round_ = next(motion for n in range(90, 200, 15) if (motion := of_map(torus[:n])) is not None)
    assert round_.period is None
    shifted = of_map(henon(150) + 0.5)
    assert list(grouped([*parts, round_, shifted])) == [0] * len(parts) + [1, 2]
    assert joins(torus[:230], torus[:229], [parts[0], round_]) == 1
    assert joins(orbit[:50], orbit[:49], [round_, parts[0]]) == 1


def test_a_cloud_that_moves_or_is_too_short_has_not_settled():
    x = henon(150)
    assert of_map(x[:80]) is None
    assert of_map(x + np.linspace(0.0, 3.0, 150)[:, None]) is None
    assert of_map(x * np.exp(-np.arange(150) / 50.0)[:, None]) is None


def test_an_orbit_is_joined_in_its_order_only():
    known = [motion_at(0.0, 1.0, 3.0, period=3)]
    x, ones = np.tile(known[0].points, (6, 1)), np.ones((17, 1))
    for start in range(3):
        assert joins(x[start:], ones[start:], known) == 0
    assert joins(x[::-1], ones, known) is None
    assert joins(x[:5], ones[:4], known) is None


def test_motions_are_matched_by_least_distance_in_all():
    def at(*values):
        return [motion_at(value) for value in values]

    assert distance(*at(0.2, 0.5)) == pytest.approx(0.3)
    assert matched(at(0.0, 0.4), at(0.25, 0.65)) == [0, 1]
    assert matched(at(0.0, 0.4, 5.0), at(0.45, 2.0)) == [None, 0, None]
    assert matched([], at(1.0)) == [] and matched(at(1.0), []) == [None]
    assert matched(at(0.0), at(0.4)) == [None] and matched(at(0.0), at(0.4), threshold=0.5) == [0]


def test_a_cloud_that_lies_within_another_is_the_same_motion_and_an_orbit_within_it_is_not():
    line = np.linspace(0.0, 1.0, 201)
    cloud = motion_at(*line, period=None)
    assert distance(cloud, motion_at(*line[:100], period=None)) == 0.0
    assert distance(cloud, motion_at(0.0)) == pytest.approx(0.5, abs=0.01)


@pytest.mark.parametrize(("limit", "reached"), [(0.01, 0), (0.05, None)])
def test_a_decay_is_joined_where_its_geometric_limit_is_the_orbit(limit, reached):
    """Three windows of a dozen periods, at distances of limit + 0.4, limit + 0.2 and limit + 0.1."""
    x = np.append(np.repeat(limit + np.array([0.4, 0.2, 0.1]), 12), limit + 0.1)[:, None]
    assert joins(x, np.ones((36, 1)), [motion_at(0.0)]) == reached


PASSED = np.arange(13.0)


@pytest.mark.parametrize(
    ("distance_from_orbit", "is_there"),
    [
        (0.06 * (1.0 - 0.6**PASSED), True),  # its orbit has moved by 0.06
        (0.12 * (1.0 - 0.6**PASSED), False),  # another orbit
        (0.03 * 1.1**PASSED, False),  # leaves an orbit that repels
        (0.007 * PASSED, False),  # goes on
    ],
)
def test_a_run_remains_on_an_orbit_that_has_moved_a_little(distance_from_orbit, is_there):
    x, measures, orbit = distance_from_orbit[:, None], np.ones((12, 1)), motion_at(0.0)
    assert joins(x, measures, [orbit]) is None
    assert remains(x, measures, orbit) == is_there


@pytest.mark.parametrize(("confidence", "z"), [(0.95, 1.959964), (0.99, 2.575829)])
def test_shares_have_wilsons_interval(confidence, z):
    """Its ends are the shares q from which 16 of 49 is just z standard deviations away."""
    wilson = share_of(16, 49, confidence)
    assert wilson.share == 16 / 49 and wilson.low < wilson.share < wilson.high
    for end in (wilson.low, wilson.high):
        assert abs(end - 16 / 49) == pytest.approx(z * np.sqrt(end * (1.0 - end) / 49), abs=1e-6)
