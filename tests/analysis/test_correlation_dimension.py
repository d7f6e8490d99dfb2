"""Dimensions known by theory or from the literature, and the cases in which there is none to be had."""

import numpy as np
import pytest

from analysis import correlation_dimension
from analysis.correlation_sums import _sampling_error
from analysis.embedding import delay_vectors
from tests.analysis.systems import henon, normal, states


# 1.21 +- 0.01: Grassberger & Procaccia 1983; 1.220 +- 0.036: Sprott 2003. The slope of this set swings with the radius
# (1.19 to 1.23, decade by decade) and records of 20,000 points scatter by 0.011: the mean of three is known to 0.0065.
@pytest.mark.slow
def test_henon_and_that_the_printed_error_covers_it():
    """1.22 lies within two printed errors for 5000 points, in nine records of ten at least."""
    starts = np.random.default_rng(0).uniform([-0.3, -0.2], [0.3, 0.2], (10, 2))
    long = [correlation_dimension(henon(20000, start=start)) for start in starts[:3]]
    assert np.mean([item.value for item in long]) == pytest.approx(1.21, abs=0.016)
    short = [correlation_dimension(henon(5000, start=start)) for start in starts]
    assert sum(abs(item.value - 1.22) < 2 * item.error for item in short) >= 9
    assert max(item.error for item in short) < 0.08


# 2.05 +- 0.01: Grassberger & Procaccia 1983.
@pytest.mark.slow
def test_lorenz():
    result = correlation_dimension(states("lorenz", 15000, step=0.1), theiler=10)
    assert result.value == pytest.approx(2.05, abs=0.05)


@pytest.mark.parametrize("points", [1000, 4000])
def test_a_line_and_a_circle_have_dimension_1(points):
    place = np.random.default_rng(points).uniform(size=(points, 1))
    assert correlation_dimension(place @ [[1.0, -2.0, 3.0]]).value == pytest.approx(1.0, abs=0.03)
    circle = np.hstack([np.cos(2 * np.pi * place), np.sin(2 * np.pi * place)])
    assert correlation_dimension(circle).value == pytest.approx(1.0, abs=0.05)


def test_four_parts_of_a_record_know_the_slope_twice_as_well_as_one():
    place = np.linspace(0.0, 2.0, 41)
    parts = (1000.0 * np.exp(np.outer(1.0 + 0.1 * normal(seed, 4), place)) for seed in range(400))
    errors = [_sampling_error(pairs, place, place >= 0.0) for pairs in parts]
    assert np.sqrt(np.mean(np.square(errors))) == pytest.approx(0.05, rel=0.1)


@pytest.mark.parametrize("angle", [0.1571, 0.17, 0.18])
def test_a_torus_in_delays_has_dimension_2_within_two_errors(angle):
    """Its surface is curved, so that the slope is too large by a twentieth over most of the region."""
    k = np.arange(6000)
    x = np.cos(angle * k) + 0.6 * np.cos(0.5 * (5.0**0.5 - 1.0) * angle * k + 1.0)
    result = correlation_dimension(delay_vectors(x, 11, 4), theiler=44)
    assert abs(result.value - 2.0) < 2.0 * result.error < 1.0


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_noise_fills_its_space(dimension):
    noise = normal(dimension, 4000, dimension)
    assert correlation_dimension(noise).value == pytest.approx(dimension, rel=0.05)


def test_a_smooth_curve_is_one_dimensional_only_without_the_window():
    """A random walk visits the plane; its neighbours in time make it look like a curve (Theiler 1986)."""
    walk = np.cumsum(normal(3, 4000, 2), axis=0)
    smooth = np.apply_along_axis(lambda x: np.convolve(x, np.hanning(200), "same"), 0, walk)
    far = correlation_dimension(smooth, theiler=400).value
    assert correlation_dimension(smooth).value < 1.25 and (np.isnan(far) or far > 1.5)


def test_a_period_is_a_finite_set():
    result = correlation_dimension(np.resize([[0.0, 1.0], [3.0, 2.0], [1.0, 5.0]], (900, 2)))
    assert result.value == 0.0 and "finite set" in result.reason


def test_the_correlation_sum_counts_pairs():
    points = normal(5, 300, 2)
    result = correlation_dimension(points, theiler=4)
    z = points / points.std(axis=0)
    distance = [np.linalg.norm(z[i] - z[j]) for i in range(300) for j in range(i + 5, 300)]
    for k in (150, 200, 250, 279):
        assert result.correlation_sum[k] == pytest.approx(np.mean(distance < result.radius[k]), abs=1e-12)
