"""Law: in space a wave is that of the plane, turned about the vertical; a current is linear in each of x, y, z, t.

A wave in direction a at a place is the wave in direction 0 at the place turned back by a, its vectors turned by a. A
current table is linear between its values, so that a function with no more than first powers of each of x, y, z and t
comes back exactly. Tolerances: rounding of some hundred multiplications, 1e-12 of the numbers that are multiplied.
"""

import numpy as np
import pytest
from scipy.interpolate import RegularGridInterpolator

from engine.parameters import record_of
from engine.physics.currents import current_field, current_field_3d
from engine.physics.waves import wave_field, wave_field_3d
from tests.engine.lines import STILL, line

RNG = np.random.default_rng(12)
SPACE = {"motion.dimensions": 3}
PLACES = np.column_stack([RNG.uniform(-15, 40, 60), RNG.uniform(-20, 20, 60), RNG.uniform(-3, 25, 60)])
ROPE = np.column_stack([np.linspace(0, 7, 41), np.linspace(0, -5, 41), np.linspace(0, 22, 41)])
X_M, Y_M, HEIGHT, TIME = [-10.0, -2.0, 7.0, 30.0], [-8.0, 0.0, 3.0], [0.0, 1.0, 5.0, 20.0], [0.0, 10.0, 60.0]


def turned(vectors, angle):
    """Vectors (..., 3) turned about z."""
    c, s = np.cos(angle), np.sin(angle)
    return vectors @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])


def waves(X, t, changes=(), **more):
    record = record_of(line(SPACE, {"waves.phase_rad": 0.7}, dict(changes), more), [])[0]
    F = np.zeros((len(X), 6))
    wave_field_3d(record, t, np.ascontiguousarray(X, float), F)
    return F


def currents(current, t, X, *changes):
    tables = [np.full(17, 1e9)]
    record = record_of(line(STILL, SPACE, {"current": current}, *changes), tables)[0]
    F = np.zeros((len(X), 6))
    current_field_3d(record, np.concatenate(tables), t, np.ascontiguousarray(X, float), F)
    return F


def table(velocities, x=X_M, y=Y_M, z=HEIGHT, t=TIME):
    """velocities: three arrays (nt, nz, ny, nx)."""
    values = {f"velocity_{axis}_mps": part.tolist() for axis, part in zip("xyz", velocities, strict=True)}
    return {"law": "table", "x_m": list(x), "y_m": list(y), "height_m": list(z), "time_s": list(t), **values}


@pytest.mark.parametrize("option", ["extrapolate", "zero", "wheeler"])
@pytest.mark.parametrize("X", [PLACES, ROPE], ids=["scattered", "rope"])
def test_along_x_the_wave_is_that_of_the_plane(X, option):
    changes = {"waves.above_still_water": option, "waves.phase_rad": 0.7, "waves.ramp_s": 8.0}
    F = np.zeros((len(X), 4))
    wave_field(record_of(line(changes), [])[0], 3.1, np.ascontiguousarray(X[:, [0, 2]]), F)
    space = waves(X, 3.1, changes)
    assert np.max(np.abs(space[:, [0, 2, 3, 5]] - F)) < 1e-14
    assert not space[:, [1, 4]].any()


@pytest.mark.parametrize("angle", [0.3, np.pi / 2, 2.0, np.pi, -1.1, 40.0])
def test_a_turned_wave_is_the_wave_turned(angle):
    for X in (PLACES, ROPE):
        plain = waves(X, 3.1)
        there = waves(turned(X, angle), 3.1, {"waves.direction_rad": angle})
        assert np.max(np.abs(there[:, :3] - turned(plain[:, :3], angle))) < 1e-12
        assert np.max(np.abs(there[:, 3:] - turned(plain[:, 3:], angle))) < 1e-12


def test_waves_along_an_axis_leave_the_other_alone():
    """Exactly: anything across the wave would be a seed of motion out of its plane."""
    assert not waves(PLACES, 3.1, {"waves.direction_rad": np.pi})[:, [1, 4]].any()
    assert not waves(PLACES, 3.1, {"waves.direction_rad": np.pi / 2})[:, [0, 3]].any()


@pytest.mark.parametrize("t", [0.0, 4.3, 10.0, 37.0])
def test_a_table_gives_back_what_is_linear_in_each_of_its_axes(t):
    powers = RNG.normal(size=(3, 2, 2, 2, 2))

    def exact(t, z, y, x, component):
        return np.polynomial.polynomial.polyval3d(
            x, y, z, np.transpose(powers[component, 0] + t * powers[component, 1], (2, 1, 0))
        )

    grid = np.meshgrid(TIME, HEIGHT, Y_M, X_M, indexing="ij")
    velocities = [np.vectorize(exact)(*grid, component) for component in range(3)]
    inside = np.clip(PLACES, [X_M[0], Y_M[0], HEIGHT[0]], [X_M[-1], Y_M[-1], HEIGHT[-1]])
    x, y, z = inside.T
    F = currents(table(velocities), t, PLACES)
    size = np.abs(velocities).max()
    for component in range(3):
        assert np.max(np.abs(F[:, component] - exact(t, z, y, x, component))) < 1e-12 * size
        rate = exact(1.0, z, y, x, component) - exact(0.0, z, y, x, component)
        rate = rate if 0 < t else 0 * rate
        assert np.max(np.abs(F[:, 3 + component] - rate)) < 1e-12 * size


def test_a_table_of_any_numbers_is_that_of_scipy():
    velocities = RNG.normal(size=(3, 3, 4, 3, 4))
    inside = np.clip(PLACES, [X_M[0], Y_M[0], HEIGHT[0]], [X_M[-1], Y_M[-1], HEIGHT[-1]])
    points = np.column_stack([np.full(len(inside), 11.0), inside[:, ::-1]])
    F = currents(table(velocities), 11.0, PLACES)
    for component in range(3):
        exact = RegularGridInterpolator((TIME, HEIGHT, Y_M, X_M), velocities[component])(points)
        assert np.max(np.abs(F[:, component] - exact)) < 1e-13


@pytest.mark.parametrize("t", [0.0, 4.3, 37.0])
def test_a_table_without_y_is_the_same_everywhere_across(t):
    u, w = RNG.normal(size=(2, 3, 4, 4))
    flat = {"law": "table", "x_m": X_M, "height_m": HEIGHT, "time_s": TIME}
    flat.update(velocity_x_mps=u.tolist(), velocity_z_mps=w.tolist())
    tables, F = [], np.zeros((len(PLACES), 4))
    record = record_of(line(STILL, {"current": flat}), tables)[0]
    current_field(record, np.concatenate(tables), t, np.ascontiguousarray(PLACES[:, [0, 2]]), F)
    space = currents(flat, t, PLACES)
    assert np.max(np.abs(space[:, [0, 2, 3, 5]] - F)) < 1e-14
    assert not space[:, [1, 4]].any()
    across = currents({**flat, "velocity_y_mps": u.tolist()}, t, PLACES)
    assert np.array_equal(across[:, [1, 4]], across[:, [0, 3]])


def test_uniform_and_profile_have_three_components():
    uniform = currents({"law": "uniform", "velocity_mps": [0.4, -0.2, 0.1]}, 3.0, PLACES)
    assert np.array_equal(uniform, np.tile([0.4, -0.2, 0.1, 0.0, 0.0, 0.0], (len(PLACES), 1)))
    height, velocity = [0.0, 4.0, 21.0], RNG.normal(size=(3, 3))
    F = currents({"law": "profile", "height_m": height, "velocity_mps": velocity.tolist()}, 3.0, PLACES)
    for component in range(3):
        exact = np.interp(PLACES[:, 2], height, velocity[:, component])
        assert F[:, component] == pytest.approx(exact, abs=1e-14)
    assert not F[:, 3:].any()


def test_a_current_across_the_plane_alone_is_a_current():
    """Only V is not zero: a record that looked at U and W alone would leave it out."""
    for current in (
        {"law": "uniform", "velocity_mps": [0.0, 0.3, 0.0]},
        table([np.zeros((3, 4, 3, 4)), np.ones((3, 4, 3, 4)), np.zeros((3, 4, 3, 4))]),
    ):
        assert record_of(line(STILL, SPACE, {"current": current}), [])[0]["current"] == 1
