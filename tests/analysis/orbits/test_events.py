"""An event is one of its kind, once, and none where the multipliers leap: maps with known corners, folds and flips."""

import numpy as np
import pytest

from analysis.orbits import OrbitMap, doubled_orbit, find_orbit, follow_branch, middle_of
from tests.analysis.systems import logistic_step as logistic


def bent(left, right, square=0.0):
    """x' = slope x + r + square x^2, the slope `left` below 0 and `right` above: its fixed point crosses 0 at r = 0."""

    def step(z, r):
        slope = left if z[0] < 0.0 else right
        return slope * z + r + square * z**2, lambda V: (slope + 2.0 * square * z[:, None]) * V

    return step


def collision(left, right):
    """The normal form of a border collision: (trace, determinant) on both sides of x = 0."""

    def step(z, r):
        trace, determinant = left if z[0] <= 0.0 else right
        matrix = np.array([[trace, 1.0], [-determinant, 0.0]])
        return matrix @ z + [r, 0.0], lambda V: matrix @ V

    return step


def quintic(z, r, c=0.2):
    """x' = -(1 + r) x - c x^3 + x^5: period 2 with r = -c x^2 + x^4 leaves the flip at 0 and folds at -c^2/4."""
    return -(1.0 + r) * z - c * z**3 + z**5, lambda V: (-(1.0 + r) - 3.0 * c * z**2 + 5.0 * z**4)[:, None] * V


def in_steps(size, seed, step=logistic):
    """A map with steps: they change the parameter by the share `size`, as irregularly as a mesh that adapts itself."""

    def frozen(points, r, mesh=0):
        shift = size * np.sin(1e7 * (r + float(points[0][0])) + 2.0 * mesh + seed)
        return [lambda z, s: step(z, s * (1.0 + shift))] * len(points)

    return OrbitMap(step, frozen=frozen, meshes=3)


def branch_of(step, start, low, high, at, **more):
    system = OrbitMap(step)
    return follow_branch(system, find_orbit(system, start, at), low, high, **more)


@pytest.mark.parametrize(
    "slopes", [(-0.7, -1.6), (-0.95, -1.05), (-0.97, -1.6), (-0.3, -9.0), (0.8, 1.5), (0.99, 1.2), (0.4, -1.7)]
)
@pytest.mark.parametrize("square", [0.0, 0.05])
def test_a_corner_of_a_map_is_no_flip_and_no_fold(slopes, square):
    branch = branch_of(bent(*slopes, square), [-0.1], -0.3, 0.3, -0.2)
    assert not branch.events and branch.parameters.max() < 2e-3
    assert "no step above" in branch.ends[1], "the branch says why it ends at the corner"


@pytest.mark.parametrize("sides", [((0.5, 0.6), (0.5, 2.2)), ((0.5, 0.99), (0.5, 1.01)), ((-0.5, 0.6), (0.4, 5.0))])
def test_a_pair_that_leaps_across_the_unit_circle_is_no_torus_point(sides):
    branch = branch_of(collision(*sides), [-0.1, 0.0], -0.3, 0.3, -0.2)
    assert not branch.events and "not smooth" in branch.ends[1]
    assert -1e-3 < branch.parameters.max() <= 1e-9


@pytest.mark.parametrize("sides", [((0.5, 0.6), (0.5, 2.2)), ((-1.5, 0.6), (-1.9, 0.8))])
def test_a_corner_is_no_event_of_a_map_in_steps(sides):
    system = in_steps(1e-3, 1, collision(*sides))
    branch = follow_branch(system, find_orbit(system, [-0.1, 0.0], -0.2), -0.3, 0.3, least=2e-3, accuracy=1e-2)
    assert not branch.events and "not smooth" in branch.ends[1] and branch.parameters.max() < 2e-3


@pytest.mark.parametrize("slopes", [(-0.3, -0.8), (0.2, 0.4), (-1.2, -1.7)])
def test_a_corner_that_leaves_the_stability_as_it_is_ends_no_branch(slopes):
    branch = branch_of(bent(*slopes), [-0.1], -0.3, 0.3, -0.2)
    assert not branch.events and branch.parameters.max() == 0.3


def test_a_steep_multiplier_is_no_leap():
    """Its flip at r = 0 has d mu/d r = -2000: nine tenths of the change within a thousandth."""

    def steep(z, r):
        level = np.tanh(4000.0 * z[0])
        slope, spread = -1.0 - 0.5 * level, 0.5 * 4000.0 * (1.0 - level**2)
        return slope * z + 2.0 * r, lambda V: (slope - spread * z[0]) * V

    flips = [event for event in branch_of(steep, [-0.1], -0.3, 0.3, -0.2).events if event.kind == "flip"]
    assert len(flips) == 1 and abs(flips[0].parameter) <= flips[0].error + 1e-8


@pytest.mark.parametrize("c", [0.05, 0.2, 0.5])
def test_a_flip_and_the_fold_beside_it_are_told_once_each(c):
    system = OrbitMap(lambda z, r: quintic(z, r, c))
    one = follow_branch(system, find_orbit(system, [0.01], -0.3), -0.4, 0.2)
    (flip,) = one.events
    assert flip.kind == "flip" and flip.parameter == pytest.approx(0.0, abs=1e-8)
    two = follow_branch(system, doubled_orbit(system, flip, amplitude=0.01), -0.4, 0.2, step=0.02, longest=0.05)
    folds = [event for event in two.events if event.kind == "fold"]
    assert [fold.parameter for fold in folds] == [pytest.approx(-(c**2) / 4, abs=1e-8)]
    assert "meets the orbit of period 1" in two.ends


def test_a_multiplier_1_where_the_parameter_does_not_turn_is_no_fold():
    """0 is a fixed point of the logistic map for every r: at r = 1 it meets another."""
    branch = branch_of(logistic, [0.0], 0.5, 1.6, 0.7)
    assert not branch.events and branch.parameters.max() == 1.6


@pytest.mark.parametrize("seed", range(6))
def test_steps_make_no_fold_of_a_flip_and_hide_no_flip(seed):
    system = in_steps(2e-4, seed)
    one = follow_branch(system, find_orbit(system, [0.6], 2.8), 2.6, 3.3, least=1e-3, accuracy=1e-2)
    (flip,) = one.events
    assert flip.kind == "flip" and abs(flip.parameter - 3.0) < 2e-3
    two = doubled_orbit(system, flip, amplitude=0.03)
    branch = follow_branch(system, two, 2.8, 3.4, least=2e-3, accuracy=1e-2)
    assert not branch.events and any("meets the orbit" in end for end in branch.ends)


@pytest.mark.parametrize("false", range(3))
def test_of_three_sequences_of_steps_a_false_one_is_not_believed_and_its_distance_is_the_error(false):
    def frozen(points, r, mesh=0):
        shift = 0.05 if mesh == false else 1e-3 * mesh
        return [lambda z, s: logistic(z, s + shift)] * len(points)

    system = OrbitMap(logistic, frozen=frozen, meshes=3)
    orbit, errors = middle_of(system, find_orbit(system, [0.6], 2.5))
    assert abs(orbit.multipliers[0] - (2.0 - 2.5)) < 3e-3 and 0.04 < errors[0] < 0.06
