"""An orbit diagram holds every point over its own parameter value, and counting loses none."""

import numpy as np
import pytest

from analysis import density_image, orbit_diagram, scale_density
from tests.analysis.maps import logistic


def test_columns_follow_the_parameter_whatever_the_order_given_and_two_runs_of_one_value_share_one():
    parameter = np.random.default_rng(0).permutation(20) / 100
    diagram = orbit_diagram(parameter, [np.full(3, value) for value in parameter])
    assert np.array_equal(diagram.parameter, np.sort(parameter))
    assert np.array_equal(diagram.columns, np.repeat(diagram.parameter[:, None], 3, axis=1))
    diagram = orbit_diagram([0.2, 0.1, 0.2], [[1.0], [2.0], [3.0, 4.0]])
    assert np.array_equal(diagram.parameter, [0.1, 0.2])
    assert np.array_equal(diagram.columns[1], [1.0, 3.0, 4.0])


def test_the_logistic_diagram_doubles_where_it_must():
    """x* = 1 - 1/r for 1 < r < 3; two points ((r+1) +- sqrt((r-3)(r+1)))/(2r) up to r = 1 + sqrt 6."""
    rates = [2.0, 2.5, 3.2, 3.4]
    diagram = orbit_diagram(rates, [logistic(rate, 100, skip=3000) for rate in rates])
    for r, column in zip(diagram.parameter, diagram.columns, strict=True):
        root = np.sqrt(max((r - 3) * (r + 1), 0.0))
        expected = [1 - 1 / r] if r < 3 else [((r + 1) - root) / (2 * r), ((r + 1) + root) / (2 * r)]
        assert np.allclose(np.unique(column.round(9)), expected, atol=1e-8)


@pytest.mark.parametrize("bins", [1, 7, 400])
def test_counts_are_conserved_column_by_column_and_every_point_lies_in_its_pixel(bins):
    rng = np.random.default_rng(0)
    diagram = orbit_diagram(np.sort(rng.uniform(size=12)), [rng.normal(size=n) for n in rng.integers(0, 400, 12)])
    image = density_image(diagram, bins)
    counts, edges = image.counts, image.value_edges
    assert counts.shape == (bins, 12)
    assert np.array_equal(counts.sum(axis=0), [len(column) for column in diagram.columns])
    for found, column in zip(counts.T, diagram.columns, strict=True):
        assert np.array_equal(found, np.sum((edges[:-1, None] <= column) & (column < edges[1:, None]), axis=1))


@pytest.mark.parametrize("value", [0.0, -3.0, 21.6])
def test_a_single_fixed_point_still_makes_an_image(value):
    assert density_image(orbit_diagram([0.13], [[value] * 5])).counts.sum() == 5


def test_points_beyond_the_range_are_counted_as_outside_and_only_the_last_points_are_kept():
    diagram = orbit_diagram([1.0, 2.0, 4.0], [np.arange(10.0)] * 3, last=4)
    assert np.array_equal(diagram.points(), [np.repeat([1.0, 2.0, 4.0], 4), np.tile(np.arange(6.0, 10.0), 3)])
    image = density_image(diagram, 2, value_range=(6.0, 8.0))
    assert np.array_equal(image.counts, np.repeat([[1], [2]], 3, axis=1)) and np.array_equal(image.outside, [1] * 3)
    assert np.array_equal(image.parameter_edges, [0.5, 1.5, 3.0, 5.0])
    with pytest.raises(ValueError, match="low < high"):
        density_image(diagram, value_range=(1.0, 1.0))


@pytest.mark.parametrize(("how", "bright"), [("linear", 0.25), ("log", np.log(2) / np.log(5)), ("rank", 0.5)])
def test_brightness_rises_with_the_counts_and_is_zero_only_without_points(how, bright):
    assert np.allclose(scale_density([[0, 1], [4, 0]], how), [[0.0, bright], [1.0, 0.0]])
    assert not scale_density(np.zeros((2, 2), int), how).any()
    with pytest.raises(ValueError, match="linear, log or rank"):
        scale_density([1], "square")


def test_bad_requests_are_refused():
    with pytest.raises(ValueError, match="given 1 arrays for 2 values"):
        orbit_diagram([0.1, 0.2], [[1.0]])
    with pytest.raises(ValueError, match="given 0 arrays for 0 values"):
        orbit_diagram([], [])
    with pytest.raises(ValueError, match="without a single point"):
        density_image(orbit_diagram([1.0], [[]]))
