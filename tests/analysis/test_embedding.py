"""Delay, dimension and noise level do not depend on units, and are what theory says where theory speaks."""

import numpy as np
import pytest

from analysis.embedding import (
    choose_delay,
    choose_embedding,
    delay_vectors,
    mean_period,
    mutual_information,
    noise_level,
    recorded_step,
)
from analysis.neighbours import nearest_outside
from tests.analysis.systems import henon, noisy, normal, record


def test_the_rows_of_delay_vectors_are_pieces_of_the_series():
    x = np.arange(20.0)
    rows = delay_vectors(x, 3, 4)
    assert rows.shape == (11, 4)
    assert np.array_equal(rows[5], [5, 8, 11, 14])


@pytest.mark.parametrize("samples_per_period", [20, 37.3, 200])
def test_a_sine_has_its_period_and_a_delay_that_opens_its_ellipse(samples_per_period):
    """With a little noise: I of an exact sine is the same at every lag but for where its ellipse touches the cells.
    The axes of the ellipse (x, x delayed by the angle a) are as 1 to tan(a/2): 45 to 90 degrees is open."""
    x = noisy(np.sin(2 * np.pi * np.arange(10_000) / samples_per_period), 0.1, 0)
    assert mean_period(x) == pytest.approx(samples_per_period, rel=0.01 + 0.0025 * samples_per_period)
    assert samples_per_period / 8 <= choose_delay(x).delay <= samples_per_period / 4 + 1


def test_mutual_information_is_entropy_at_lag_0_and_its_bias_for_independent_samples_and_sees_order_only():
    x = normal(0, 20_000)
    information, cells = mutual_information(x, 50)
    assert information[0] == pytest.approx(np.log(cells), rel=1e-3)
    assert information[1:].mean() == pytest.approx((cells - 1) ** 2 / (2 * len(x)), rel=0.05)
    assert np.allclose(information, mutual_information(np.exp(x / 5), 50)[0])


@pytest.mark.parametrize(
    ("name", "dimension"), [("henon", 2), ("logistic", 1), ("sine", 2), ("lorenz", 3), ("rossler", 3)]
)
def test_the_dimension_that_unfolds(name, dimension):
    samples = 20_000 if name == "lorenz" else 10_000
    series = np.sin(0.1 * np.arange(samples)) if name == "sine" else record(name, samples)[0]
    choice = choose_embedding(series)
    assert choice.by_false_neighbours == choice.dimension == dimension
    scaled = choose_embedding(7.0 - 1e-3 * series)
    assert (scaled.lag, scaled.dimension) == (choice.lag, choice.dimension)


def test_noise_is_told_from_motion_by_caos_second_average():
    noise = choose_embedding(normal(0, 5000))
    assert np.all(np.abs(noise.e2[1:] - 1.0) < 0.1)
    assert np.max(np.abs(choose_embedding(henon(5000)[:, 0]).e2 - 1.0)) > 0.3


def test_nearest_neighbours_outside_the_window_are_those_of_brute_force():
    points = normal(0, 300, 2).cumsum(axis=0)
    index, distance = nearest_outside(points, 20, count=3)
    separation = np.linalg.norm(points[:, None] - points, axis=2)
    separation[np.abs(np.subtract.outer(np.arange(300), np.arange(300))) <= 20] = np.inf
    assert np.allclose(distance, np.sort(separation, axis=1)[:, :3])
    assert np.allclose(np.take_along_axis(separation, index, axis=1), distance)


@pytest.mark.parametrize(("name", "share"), [("lorenz", 0.03), ("rossler", 0.01), ("henon", 0.005), ("henon", 0.03)])
def test_white_noise_is_measured(name, share):
    x = record(name)[0]
    noise = noisy(x, share, 1)
    assert noise_level(noise, choose_delay(noise).delay) == pytest.approx(share * np.std(x), rel=0.25)


@pytest.mark.parametrize("step", [0.25, 0.01, 1e-3])
def test_the_steps_of_a_logger_count_as_noise(step):
    """A slow sine is the same for many samples: its differences are mostly zero."""
    x = step * np.rint(np.sin(0.003 * np.arange(6000)) / step + 0.3)
    assert recorded_step(x) == (pytest.approx(step, rel=1e-9) if step < 0.2 else 0.0)
    assert noise_level(x, 100) >= recorded_step(x) / np.sqrt(12.0)
    assert recorded_step(np.sin(0.003 * np.arange(6000))) < 1e-9
