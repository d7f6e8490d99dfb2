"""Counting loses no point, and every scale keeps the order of the counts."""

import numpy as np
import pytest

from analysis import density_image, orbit_diagram, scale_density


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


def test_both_ends_of_the_range_belong_to_the_image():
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


def test_an_empty_image_stays_dark():
    assert not scale_density(np.zeros((3, 4), dtype=int)).any()


def test_bad_requests_are_refused():
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
