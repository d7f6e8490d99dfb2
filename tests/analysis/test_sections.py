"""One point per period, and its value at the phase asked for: exact on samples, to fourth order between them.

An orbit diagram holds every point over its own parameter value, and counting loses none. The distance of two sections
is 0 for the same, 1 for points, and about its own scatter for two records of one motion.
"""

import math

import numpy as np
import pytest

from analysis import density_image, orbit_diagram, poincare_section, scale_density, section_at_phases, section_distance
from analysis.section_distances import energy_distance
from tests.analysis.systems import henon, logistic, normal

PERIOD = 5.0


@pytest.mark.parametrize("steps", range(60, 200))
def test_a_record_of_whole_periods_has_one_point_more_than_periods_whatever_the_rounding_of_the_step(steps):
    section = poincare_section(np.zeros(40 * steps + 1), PERIOD / steps, PERIOD)
    assert section.points.shape == (41, 1)
    assert np.allclose(section.time_s, PERIOD * np.arange(41))


@pytest.mark.parametrize(("phase", "transient"), [(0.0, 1), (0.3, 40)])
def test_leaving_out_a_transient_only_drops_points_from_the_start(phase, transient):
    x = normal(0, 3001, 2)
    full, part = (poincare_section(x, 0.1, PERIOD, phase, first) for first in (0, transient))
    for name in ("points", "time_s", "period_index"):
        assert np.array_equal(getattr(part, name), getattr(full, name)[transient:])


def test_coordinates_keep_their_order_and_phases_stand_side_by_side():
    section = poincare_section({"radius_m": np.arange(11.0), "angle_rad": -np.arange(11.0)}, 1.0, PERIOD)
    assert np.array_equal(section.points, [[0.0, 0.0], [5.0, -5.0], [10.0, -10.0]])
    assert np.array_equal(section.column("angle_rad"), [0.0, -5.0, -10.0])
    assert np.array_equal(section_at_phases(np.arange(22.0), 1.0, 8.0, 1).points, [[8.0, 10.0, 12.0, 14.0]])


@pytest.mark.parametrize("phase", [0.0, 0.25, 0.5, 0.99])
def test_phases_on_samples_give_the_samples(phase):
    x = normal(1, 2001, 2)
    section = poincare_section(x, 0.05, PERIOD, phase=phase)
    assert np.array_equal(section.points, x[np.arange(len(section.points)) * 100 + round(100 * phase)])
    assert not section.interpolated and poincare_section(x, 0.05, PERIOD, phase=0.001).interpolated


@pytest.mark.parametrize("phase", [0.0, 0.013, 0.25, 0.5, 0.77, 0.999])
def test_a_cubic_motion_is_exact_at_any_phase(phase):
    """A cubic spline without knots of its own at the ends reproduces cubics."""
    cubic = np.polynomial.Polynomial([0.0, 1.0, -40.0, 1.0])
    section = poincare_section(cubic(0.37 * np.arange(200)), 0.37, PERIOD, phase=phase)
    assert np.allclose(section.points[:, 0], cubic(section.time_s), rtol=1e-9)


def test_columns_follow_the_parameter_and_two_runs_of_one_value_share_one():
    diagram = orbit_diagram([0.2, 0.1, 0.2], [[1.0], [2.0], [3.0, 4.0]])
    assert np.array_equal(diagram.parameter, [0.1, 0.2])
    assert [column.tolist() for column in diagram.columns] == [[2.0], [1.0, 3.0, 4.0]]


@pytest.mark.parametrize("bins", [1, 7, 400])
def test_every_point_is_counted_in_its_pixel(bins):
    columns = [normal(count, count) for count in (0, 1, 400)]
    image = density_image(orbit_diagram([1.0, 2.0, 3.0], columns), bins)
    low, high = image.value_edges[:-1, None], image.value_edges[1:, None]
    for counts, column in zip(image.counts.T, columns, strict=True):
        assert np.array_equal(counts, np.sum((low <= column) & (column < high), axis=1))
        assert counts.sum() == len(column)


def test_points_beyond_the_range_are_counted_as_outside_and_only_the_last_points_are_kept():
    diagram = orbit_diagram([1.0, 2.0, 4.0], [np.arange(10.0)] * 3, last=4)
    assert np.array_equal(diagram.points(), [np.repeat([1.0, 2.0, 4.0], 4), np.tile(np.arange(6.0, 10.0), 3)])
    image = density_image(diagram, 2, value_range=(6.0, 8.0))
    assert image.counts.tolist() == [[1] * 3, [2] * 3] and image.outside.tolist() == [1] * 3
    assert image.parameter_edges.tolist() == [0.5, 1.5, 3.0, 5.0]


@pytest.mark.parametrize(("how", "bright"), [("linear", 0.25), ("log", np.log(2) / np.log(5)), ("rank", 0.5)])
def test_brightness_rises_with_the_counts_and_is_zero_only_without_points(how, bright):
    assert np.allclose(scale_density([[0, 1], [4, 0]], how), [[0.0, bright], [1.0, 0.0]])
    assert not scale_density(np.zeros((2, 2), int), how).any()


def standard(seed, points, shift=0.0):
    return np.random.default_rng(seed).normal(shift, 1.0, (points, 1))


@pytest.mark.parametrize("shift", [0.5, 3.0])
def test_two_normal_clouds_have_the_distance_of_the_closed_form(shift):
    """<|x - y|> of N(0, 1) and N(d, 1): d erf(d/2) + 2/sqrt(pi) exp(-d^2/4)."""
    across = shift * math.erf(shift / 2) + 2 / math.sqrt(math.pi) * math.exp(-(shift**2) / 4)
    exact = math.sqrt((2 * across - 4 / math.sqrt(math.pi)) / (2 * across))
    assert energy_distance(standard(1, 3000), standard(2, 3000, shift)) == pytest.approx(exact, abs=0.015)


def test_single_points_are_at_the_ends_of_the_scale():
    for place, wanted in ((0.0, 0.0), (1.0, 1.0)):
        assert energy_distance(np.zeros((5, 2)), np.full((7, 2), place)) == wanted


def test_two_orbits_of_one_map_are_as_far_apart_as_the_halves_of_one():
    starts = np.random.default_rng(0).uniform(0.0, 0.1, (40, 2, 2))
    pairs = [section_distance(*(henon(200, start=tuple(start)) for start in pair)) for pair in starts]
    assert np.mean([result.across > 1.5 * result.within for result in pairs]) <= 0.1
    after_transient = np.concatenate([np.full((60, 2), 9.0), henon(200)])
    assert section_distance(after_transient, henon(200)).across < 0.2, "the longer one is cut at its start"


def test_orbits_of_two_maps_are_farther_apart_than_their_halves_in_any_units():
    first, second = (np.column_stack([x[:-1], x[1:]]) for x in (logistic(4.0, 401), logistic(3.7, 401)))
    result, scaled = section_distance(first, second), section_distance(first * [1e3, 1e-6], second * [1e3, 1e-6])
    assert result.across > 3 * result.within
    assert (scaled.across, scaled.within) == pytest.approx((result.across, result.within))
