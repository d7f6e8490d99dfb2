"""Curves of folds, flips and torus points over two parameters: maps whose curves are known in closed form."""

import numpy as np
import pytest

from analysis.orbits import NoImage, OrbitMap, follow_curve
from tests.analysis.systems import henon_plane as henon

CLOSE = 1e-8


def cusp(z, p):
    """Fixed points x^3 - b x = a: folds on 27 a^2 = 4 b^3."""
    (x,), (a, b) = z, p
    return np.array([x + a + b * x - x**3]), lambda V: (1.0 + b - 3.0 * x * x) * V


def ring(z, p):
    """Fixed points x^2 = a^2 + b^2 - 1: folds on the unit circle."""
    (x,), (a, b) = z, p
    return np.array([x + 0.5 * (a * a + b * b - 1.0 - x * x)]), lambda V: (1.0 - x) * V


def curve_of(image, kind, z, parameters, low=(-3.0, -2.0), high=(4.0, 2.0), **settings):
    system = OrbitMap(image, parameter_size=np.ones(2))
    return follow_curve(system, kind, np.array([z]), np.array(parameters), low, high, **settings)


def special_of(curve):
    return {point.kind: point for point in curve.special}


@pytest.mark.parametrize(("kind", "sign", "factor"), [("fold", -1.0, -0.25), ("flip", 1.0, 0.75)])
def test_folds_and_flips_of_henons_map(kind, sign, factor):
    x, a = sign * 0.35, factor * 0.49
    curve = curve_of(henon, kind, [x, 0.3 * x], [a, 0.3], (-3.0, -1.5), (6.0, 0.9))
    a, b = curve.parameters.T
    assert abs(a - factor * (1.0 - b) ** 2).max() < CLOSE
    assert all(end.startswith("reaches the end of the range of key 2") for end in curve.ends)
    assert b[[0, -1]] == pytest.approx([-1.5, 0.9])
    name, place = {"fold": ("1:1", [-1.0, -1.0]), "flip": ("1:2", [3.0, -1.0])}[kind]
    assert special_of(curve)[name].parameters == pytest.approx(place, abs=CLOSE)


def test_torus_points_of_henons_map_end_in_strong_resonances():
    curve = curve_of(henon, "torus", [0.2, -0.2], [0.44, -1.0], longest=0.1, least=1e-5)
    a, b = curve.parameters.T
    assert abs(b + 1.0).max() < CLOSE
    assert a.min() == pytest.approx(-1.0, abs=1e-3) and a.max() == pytest.approx(3.0, abs=1e-3)
    assert all("no pair of multipliers is on the unit circle" in end for end in curve.ends)
    special = special_of(curve)
    assert special["1:3"].parameters == pytest.approx([1.25, -1.0], abs=CLOSE)
    assert special["1:4"].parameters == pytest.approx([0.0, -1.0], abs=CLOSE)


def test_two_curves_of_folds_meet_in_a_cusp():
    curve = curve_of(cusp, "fold", [0.5], [0.5**3 - 0.375, 0.75])
    a, b = curve.parameters.T
    assert abs(27.0 * a**2 - 4.0 * b**3).max() < CLOSE and a.min() < -1.0 and a.max() > 1.0
    (point,) = curve.special
    assert point.kind == "cusp" and abs(point.parameters).max() < CLOSE


def test_an_island_is_born_and_dies_at_extremes_of_a_closed_curve():
    curve = curve_of(ring, "fold", [0.0], [0.8, 0.6])
    assert curve.closed and abs(np.hypot(*curve.parameters.T) - 1.0).max() < CLOSE
    assert sorted(point.parameters[1] for point in curve.special) == pytest.approx([-1.0, 1.0], abs=CLOSE)
    assert {point.kind for point in curve.special} == {"extremum"}


def test_an_extremum_is_no_cusp_because_its_orbits_change_more_than_the_parameters():
    """The ring, in which x grows by 30 a."""

    def sheared(z, p):
        x, a = z[0], p[0]
        image, linear = ring(np.array([x - 30.0 * a]), p)
        return image + 30.0 * a, linear

    curve = curve_of(sheared, "fold", [3.0], [0.1, 0.99**0.5], (-0.2, 0.0), (0.2, 2.0), step=0.5, longest=1.0)
    (point,) = curve.special
    assert point.kind == "extremum" and point.parameters == pytest.approx([0.0, 1.0], abs=CLOSE)


def test_a_curve_whose_event_lies_beside_the_range_begins_at_its_border():
    """No point is outside, and the first one, beside that of the border, makes no island."""
    curve = curve_of(henon, "flip", [0.35, 0.105], [0.3695, 0.3], (-3.0, 0.3), (6.0, 0.9))
    assert curve.parameters[[0, -1], 1].tolist() == [0.3, 0.9] and not curve.special
    assert curve.parameters[:, 1].min() == 0.3


@pytest.mark.parametrize("on", [0, 1])
def test_a_curve_that_begins_at_the_end_of_a_range_reaches_it(on):
    low, high = np.array([-3.0, -1.5]), np.array([6.0, 0.9])
    low[on] = start = (0.3675, 0.3)[on]
    curve = curve_of(henon, "flip", [0.35, 0.105], [0.3675, 0.3], low, high)
    assert f"reaches the end of the range of key {on + 1}, {start:g}" in curve.ends
    assert len(np.unique(curve.parameters, axis=0)) == len(curve.points)


@pytest.mark.parametrize(("kind", "z", "a"), [("fold", -0.35, -0.1225), ("flip", 0.35, 0.3675)])
def test_what_a_more_accurate_map_changes_of_a_point_is_in_its_errors(kind, z, a):
    """A map whose first parameter is wrong by 1e-4 shows each point that much too low."""
    off = 1e-4
    size = np.array([2.0, 0.5])
    exact = OrbitMap(henon, parameter_size=size)
    system = OrbitMap(lambda z, p: henon(z, (p[0] + off, p[1])), parameter_size=size)
    place = np.array([[z, 0.3 * z]]), np.array([a, 0.3])
    curve = follow_curve(system, kind, *place, (-3.0, -0.5), (4.0, 0.9), sharper=exact)
    factor = {"fold": -0.25, "flip": 0.75}[kind]
    for point in curve.points:
        true = factor * (1.0 - point.parameters[1]) ** 2
        assert point.parameters[0] == pytest.approx(true - off, abs=CLOSE)
        assert point.errors[0] == pytest.approx(off, rel=0.1)  # the chord stands for the direction of the curve


def test_a_curve_that_leaves_both_ranges_in_one_step_ends_at_the_border_that_it_meets_first():
    """Flips on a = 0.75 (1 - b)^2 meet b = 0.2 at a = 0.48, before a = 0.49."""
    curve = curve_of(henon, "flip", [0.35, 0.105], [0.3675, 0.3], (0.36, 0.2), (0.49, 0.9), step=0.2)
    a, b = curve.parameters.T
    assert b.min() == pytest.approx(0.2) and a.max() == pytest.approx(0.48) and a.min() == pytest.approx(0.36)
    assert any(end.startswith("reaches the end of the range of key 2, 0.2") for end in curve.ends)


def test_where_no_event_is_no_curve_begins():
    with pytest.raises(NoImage):
        curve_of(henon, "flip", [-0.35, -0.105], [-5.0, 0.3])


def test_a_curve_does_not_follow_what_the_steps_of_one_orbit_make_of_multipliers_nearby():
    """Steps add a ripple that is fixed to the orbit they were chosen for: beside it the multiplier grows, where that of
    orbits with steps of their own falls. A multiplier that is wrong by `size` moves the flip by size (1 - b)."""
    size, length, phase = 0.05, 0.01, -0.5 * np.pi

    def in_steps(begin):
        def image(z, p):
            at = (z[0] - begin[0]) / length + phase
            ripple = np.array([size * length * (np.sin(at) - np.sin(phase)), 0.0])
            exact, linear = henon(z, p)
            return exact + ripple, lambda V: linear(V) + np.outer([size * np.cos(at), 0.0], V[0])

        return image

    def frozen(points, p, mesh):
        return [in_steps(z) for z in points]

    system = OrbitMap(henon, parameter_size=np.ones(2), frozen=frozen)
    place = np.array([[0.35, 0.105]]), np.array([0.3675, 0.3])
    curve = follow_curve(system, "flip", *place, (-3.0, -0.5), (6.0, 0.9), step=0.3, least=0.03, longest=0.5)
    a, b = curve.parameters.T
    assert all(end.startswith("reaches the end of the range of key 2") for end in curve.ends)
    assert np.all(abs(a - 0.75 * (1.0 - b) ** 2) < size * (1.0 - b))
