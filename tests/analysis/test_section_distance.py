"""Distance of two sections: 0 for the same, 1 for points, about its own scatter for two records of one motion."""

import math

import numpy as np
import pytest

from analysis import section_distance
from analysis.section_distances import energy_distance
from tests.analysis.maps import henon, logistic


def standard(seed, points, shift=0.0):
    return np.random.default_rng(seed).normal(shift, 1.0, (points, 1))


@pytest.mark.parametrize("shift", [0.5, 1.0, 3.0])
def test_two_normal_clouds_have_the_distance_of_the_closed_form(shift):
    """<|x - y|> of N(0, 1) and N(d, 1): d erf(d/2) + 2/sqrt(pi) exp(-d^2/4)."""
    across = shift * math.erf(shift / 2) + 2 / math.sqrt(math.pi) * math.exp(-(shift**2) / 4)
    exact = math.sqrt((2 * across - 4 / math.sqrt(math.pi)) / (2 * across))
    assert energy_distance(standard(1, 3000), standard(2, 3000, shift)) == pytest.approx(exact, abs=0.015)


def test_the_ends_of_the_scale():
    cloud = standard(3, 50)
    assert energy_distance(cloud, cloud) == pytest.approx(0.0, abs=1e-7)
    assert energy_distance(np.zeros((5, 2)), np.ones((7, 2))) == 1.0
    assert energy_distance(np.zeros((5, 2)), np.zeros((5, 2))) == 0.0


def test_two_orbits_of_one_map_are_as_far_apart_as_the_halves_of_one():
    starts = np.random.default_rng(0).uniform(0.0, 0.1, (40, 2, 2))
    pairs = [section_distance(*(henon(200, start=tuple(start)) for start in pair)) for pair in starts]
    assert np.mean([found.across > 1.5 * found.within for found in pairs]) <= 0.1


def test_orbits_of_two_maps_are_farther_apart_than_their_halves_in_any_units():
    first, second = (np.column_stack([x[:-1], x[1:]]) for x in (logistic(4.0, 401), logistic(3.7, 401)))
    found, scaled = section_distance(first, second), section_distance(first * [1e3, 1e-6], second * [1e3, 1e-6])
    assert found.across > 3 * found.within
    assert (scaled.across, scaled.within) == pytest.approx((found.across, found.within))


def test_too_short_is_said_and_wrong_shapes_are_refused():
    assert math.isnan(section_distance(np.zeros((39, 2)), np.zeros((50, 2))).across)
    with pytest.raises(ValueError, match="coordinates"):
        section_distance(np.zeros((50, 2)), np.zeros((50, 3)))
