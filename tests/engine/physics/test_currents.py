"""Law: a current is linear between the values of its table in x, y, z and t, and constant beyond them; its local
acceleration is its rate at a place.

Against scipy's RegularGridInterpolator with the arguments clipped to the table; both do the same few multiplications:
1e-13. Rates by central differences within a cell, where the current is linear in time: rounding over the step, 1e-9.
"""

import numpy as np
import pytest
from scipy.interpolate import RegularGridInterpolator

from tests.engine.kernels import current_at, parameters_of
from tests.engine.lines import SPACE, STILL, line

AXES = {
    "time_s": [0.0, 10.0, 11.0, 60.0],
    "height_m": [0.0, 1.0, 5.0, 20.0],
    "y_m": [-8.0, 0.0, 3.0],
    "x_m": [-10.0, -2.0, 0.0, 7.0, 30.0],
}
RNG = np.random.default_rng(7)
VALUES = RNG.normal(size=(3, 4, 4, 3, 5))
PLACES = np.column_stack([RNG.uniform(-15, 40, 200), RNG.uniform(-20, 20, 200), RNG.uniform(-3, 25, 200)])
TIMES = [-1.0, 0.0, 3.3, 10.0, 10.4, 35.0, 60.0, 99.0]


def table(axes, values):
    """values: (components, ...) along the axes given: U, V, W in space, U, W in a plane."""
    names = "xyz" if len(values) == 3 else "xz"
    return {"law": "table", **axes} | {f"velocity_{c}_mps": v.tolist() for c, v in zip(names, values, strict=True)}


FLAT = {name: axis for name, axis in AXES.items() if name != "y_m"}
TABLES = {2: (FLAT, VALUES[[0, 2], :, :, 0]), 3: (AXES, VALUES)}


def field(current, t, dimensions=2, before=()):
    """Velocity and acceleration, (200, dimensions) each."""
    scene = line(STILL, {"current": current, "motion.dimensions": dimensions})
    X = PLACES if dimensions == 3 else PLACES[:, [0, 2]]
    return np.split(current_at(scene, t, X, before), 2, axis=1)


def clipped(axes, t):
    points = {"time_s": np.full(200, t), "x_m": PLACES[:, 0], "y_m": PLACES[:, 1], "height_m": PLACES[:, 2]}
    return np.stack([np.clip(points[name], axis[0], axis[-1]) for name, axis in axes.items()], axis=-1)


@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize("t", TIMES)
def test_a_table_is_linear_between_its_values(t, dimensions):
    axes, values = TABLES[dimensions]
    velocity, acceleration = field(table(axes, values), t, dimensions)
    for found, part in zip(velocity.T, values, strict=True):
        exact = RegularGridInterpolator(tuple(axes.values()), part)(clipped(axes, t))
        assert np.max(np.abs(found - exact)) < 1e-13
    assert np.array_equal(field(table(axes, values), t, dimensions, [np.full(17, 1e9)])[0], velocity)
    if t not in AXES["time_s"]:
        ahead, behind = (field(table(axes, values), t + d, dimensions)[0] for d in (1e-3, -1e-3))
        assert np.max(np.abs(acceleration - (ahead - behind) / 2e-3)) < 1e-9
        assert acceleration.any() == (0 < t < 60)


@pytest.mark.parametrize("axis", AXES)
def test_an_axis_of_one_value_is_constant(axis):
    at = list(AXES).index(axis)
    one = np.take(VALUES, [1], axis=1 + at)
    single, double = (table(AXES | {axis: [2.0, 3.0][:n]}, np.repeat(one, n, axis=1 + at)) for n in (1, 2))
    for found, expected in zip(field(single, 5.0, 3), field(double, 5.0, 3), strict=True):
        assert found == pytest.approx(expected, abs=1e-14)


@pytest.mark.parametrize("t", [0.0, 4.3, 37.0])
def test_a_table_without_y_is_the_same_everywhere_across(t):
    current = table(*TABLES[2])
    for found, expected in zip(field(current, t, 3), field(current, t), strict=True):
        assert np.max(np.abs(found[:, [0, 2]] - expected)) < 1e-14
        assert not found[:, 1].any()
    for part in field({**current, "velocity_y_mps": current["velocity_x_mps"]}, t, 3):
        assert np.array_equal(part[:, 1], part[:, 0])


def test_uniform_and_profile():
    velocity, acceleration = field({"law": "uniform", "velocity_mps": [0.4, -0.2, 0.1]}, 3.0, 3)
    assert np.array_equal(velocity, np.tile([0.4, -0.2, 0.1], (200, 1))) and not acceleration.any()
    height, velocities = [0.0, 4.0, 5.0, 21.0], RNG.normal(size=(4, 3))
    for dimensions, columns in ((3, [0, 1, 2]), (2, [0, 2])):
        given = velocities * [1.0, dimensions == 3, 1.0]
        profile = {"law": "profile", "height_m": height, "velocity_mps": given.tolist()}
        velocity, acceleration = field(profile, 12.0, dimensions)
        exact = [np.interp(PLACES[:, 2], height, given[:, column]) for column in columns]
        assert velocity == pytest.approx(np.transpose(exact), abs=1e-14)
        assert not acceleration.any()


def test_a_current_across_the_plane_alone_is_a_current():
    """Only V is not zero: a record that looked at U and W alone would leave it out."""
    for current in (
        {"law": "uniform", "velocity_mps": [0.0, 0.3, 0.0]},
        table(AXES, VALUES * np.array([0.0, 1.0, 0.0]).reshape(3, 1, 1, 1, 1)),
    ):
        assert parameters_of(line(STILL, SPACE, {"current": current}))[0]["current"] == 1
