"""An orbit diagram holds every point over its own parameter value; counting loses none, scales keep their order."""

import numpy as np
import pytest

from analysis import density_image, orbit_diagram, scale_density


def test_columns_follow_the_parameter_whatever_the_order_given():
    rng = np.random.default_rng(0)
    parameter = rng.permutation(20) / 100
    diagram = orbit_diagram(parameter, [np.full(3, value) for value in parameter])
    assert np.array_equal(diagram.parameter, np.sort(parameter))
    for value, column in zip(diagram.parameter, diagram.columns, strict=True):
        assert np.array_equal(column, np.full(3, value))


def test_points_list_every_point_once():
    arrays = [np.arange(n, dtype=float) for n in (3, 0, 5)]
    x, y = orbit_diagram([0.1, 0.2, 0.3], arrays).points()
    assert np.array_equal(x, [0.1] * 3 + [0.3] * 5)
    assert np.array_equal(y, np.concatenate(arrays))


def test_two_runs_of_one_value_share_its_column():
    diagram = orbit_diagram([0.2, 0.1, 0.2], [[1.0], [2.0], [3.0, 4.0]])
    assert np.array_equal(diagram.parameter, [0.1, 0.2])
    assert np.array_equal(diagram.columns[1], [1.0, 3.0, 4.0])


def test_only_the_last_points_are_kept_when_asked():
    diagram = orbit_diagram([1.0, 2.0], [np.arange(9.0), np.arange(2.0)], last=4)
    assert np.array_equal(diagram.columns[0], [5.0, 6.0, 7.0, 8.0])
    assert np.array_equal(diagram.columns[1], [0.0, 1.0])


def test_the_logistic_diagram_doubles_where_it_must():
    """x* = 1 - 1/r for 1 < r < 3; two points ((r+1) +- sqrt((r-3)(r+1)))/(2r) up to r = 1 + sqrt 6."""
    rates = np.array([2.0, 2.5, 3.2, 3.4])
    x = np.full(4, 0.3)
    history = []
    for _ in range(3000):
        x = rates * x * (1 - x)
        history.append(x)
    diagram = orbit_diagram(rates, np.array(history).T, last=100)
    for r, column in zip(diagram.parameter, diagram.columns, strict=True):
        root = np.sqrt(max((r - 3) * (r + 1), 0.0))
        expected = [1 - 1 / r] if r < 3 else [((r + 1) - root) / (2 * r), ((r + 1) + root) / (2 * r)]
        assert np.allclose(np.unique(column.round(9)), expected, atol=1e-8)


def _diagram(seed=0):
    rng = np.random.default_rng(seed)
    return orbit_diagram(np.sort(rng.uniform(size=12)), [rng.normal(size=n) for n in rng.integers(0, 400, 12)])


@pytest.mark.parametrize("bins", [1, 7, 400])
@pytest.mark.parametrize("value_range", [None, (-0.5, 1.5), (50.0, 60.0)])
def test_counts_are_conserved_column_by_column(bins, value_range):
    diagram = _diagram()
    image = density_image(diagram, bins, value_range)
    assert np.array_equal(image.counts.sum(axis=0) + image.outside, [len(column) for column in diagram.columns])
    assert image.counts.shape == (bins, 12)
    if value_range is None:
        assert not image.outside.any()


def test_every_point_lies_in_the_pixel_that_counts_it():
    image = density_image(orbit_diagram([1.0, 2.0], [[0.25], [0.9, 0.9]]), 10, (0.0, 1.0))
    assert image.counts[2, 0] == 1 and image.counts[9, 1] == 2 and image.counts.sum() == 3
    # Both ends of the range belong to the image.
    image = density_image(orbit_diagram([1.0], [[0.0, 1.0]]), 4, (0.0, 1.0))
    assert image.outside[0] == 0 and image.counts[0, 0] == 1 and image.counts[-1, 0] == 1


def test_columns_meet_half_way_between_uneven_parameters():
    image = density_image(orbit_diagram([0.0, 1.0, 4.0], [[0.0], [1.0], [2.0]]))
    assert np.array_equal(image.parameter_edges, [-0.5, 0.5, 2.5, 5.5])


@pytest.mark.parametrize("value", [0.0, -3.0, 21.6])
def test_a_single_fixed_point_still_makes_an_image(value):
    image = density_image(orbit_diagram([0.13], [[value] * 5]))
    assert image.counts.sum() == 5
    assert image.parameter_edges[0] < 0.13 < image.parameter_edges[1]


@pytest.mark.parametrize("how", ["linear", "log", "rank"])
def test_scales_rise_with_the_count_from_zero_to_one(how):
    counts = density_image(_diagram(), 20).counts
    shade = scale_density(counts, how)
    assert shade.shape == counts.shape
    assert np.array_equal(shade == 0.0, counts == 0)
    assert shade.max() == 1.0
    order = np.argsort(counts, axis=None)
    assert np.all(np.diff(shade.ravel()[order]) >= 0)
    for count in np.unique(counts):
        assert np.ptp(shade[counts == count]) == 0.0


def test_rank_spends_the_scale_evenly_on_the_occupied_pixels():
    """Invariant under any rising change of the counts; distinct counts are equally spaced."""
    counts = np.array([[0, 1, 5], [1000, 0, 20]])
    assert np.array_equal(scale_density(counts, "rank"), [[0.0, 0.25, 0.5], [1.0, 0.0, 0.75]])
    assert np.array_equal(scale_density(counts**2, "rank"), scale_density(counts, "rank"))


def test_bad_requests_are_refused():
    with pytest.raises(ValueError, match="given 1 arrays for 2 values"):
        orbit_diagram([0.1, 0.2], [[1.0]])
    with pytest.raises(ValueError, match="given 0 arrays for 0 values"):
        orbit_diagram([], [])
    empty = orbit_diagram([1.0], [[]])
    with pytest.raises(ValueError, match="without a single point"):
        density_image(empty)
    assert density_image(empty, value_range=(0.0, 1.0)).counts.sum() == 0
    with pytest.raises(ValueError, match="low < high"):
        density_image(_diagram(), value_range=(1.0, 1.0))
    with pytest.raises(ValueError, match="linear, log or rank"):
        scale_density(np.ones(3), "cubic")
    with pytest.raises(ValueError, match="whole numbers >= 0"):
        scale_density(np.array([-1, 2]))
