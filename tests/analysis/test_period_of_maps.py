"""Maps whose period is known by theory: the logistic map's windows, its full chaos, and rotations of a circle."""

import numpy as np
import pytest

from analysis import detect_period


def _logistic(rate, points, skip=3000, x=0.3):
    orbit = []
    for k in range(skip + points):
        x = rate * x * (1 - x)
        if k >= skip:
            orbit.append(x)
    return np.array(orbit)


# Windows: 1 < r < 3; 3 < r < 1 + sqrt 6; to 3.5441; to 3.5644; period 3 from 1 + sqrt 8 to 3.8415, then doubled.
@pytest.mark.parametrize(
    ("rate", "period"), [(2.8, 1), (3.2, 2), (3.4, 2), (3.5, 4), (3.55, 8), (3.566, 16), (3.832, 3), (3.845, 6)]
)
@pytest.mark.parametrize("points", [64, 201, 1000])
def test_windows_of_the_logistic_map(rate, period, points):
    estimate = detect_period(_logistic(rate, points))
    assert estimate.period == period, estimate.reason
    assert estimate.points == points


@pytest.mark.parametrize("rate", [3.65, 3.75, 3.9, 4.0])
@pytest.mark.parametrize("points", [64, 200, 2000])
def test_chaos_has_no_period(rate, points):
    assert detect_period(_logistic(rate, points)).period is None


@pytest.mark.parametrize("start", [0.1, 0.23, 0.3, 0.41, 0.77])
@pytest.mark.parametrize("points", [16, 24, 40])
def test_short_pieces_of_full_chaos_have_no_period_either(start, points):
    assert detect_period(_logistic(4.0, points, x=start)).period is None


# sqrt: badly approximable; pi has the close return 113 (2e-6 turns away), the last one turns by a thousandth at a time.
@pytest.mark.parametrize("rotation", [(np.sqrt(5) - 1) / 2, np.sqrt(2) - 1, np.pi - 3, 0.001234567])
@pytest.mark.parametrize("points", [64, 500, 4000])
@pytest.mark.parametrize("max_period", [16, 128, 1000])
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


def test_units_and_origin_do_not_matter():
    orbit = np.column_stack([_logistic(3.5, 200), _logistic(3.55, 200)])
    plain = detect_period(orbit)
    changed = detect_period(orbit * [1e-3, 1e4] + [20.0, -7.0])
    assert plain.period == changed.period == 8
    assert np.allclose(plain.residual, changed.residual, atol=1e-10)


def test_a_coordinate_that_never_moves_does_not_matter():
    x = _logistic(3.2, 100)
    assert detect_period(np.column_stack([x, np.zeros(100), np.full(100, 20.8)])).period == 2
    assert detect_period(np.zeros(100)).period == 1
