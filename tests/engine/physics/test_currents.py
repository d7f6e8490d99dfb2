"""Law: a current is linear between the values of its table in x, z and t, and constant beyond them; its local
acceleration is its rate at a place.

Against scipy's RegularGridInterpolator with the arguments clipped to the table; both do the same few multiplications:
1e-13. Rates by central differences within a cell, where the current is linear in time: rounding over the step, 1e-9.
"""

import numpy as np
import pytest
from scipy.interpolate import RegularGridInterpolator

from engine.parameters import record_of
from engine.physics.currents import current_field
from tests.engine.lines import STILL, line

X_M, HEIGHT, TIME = [-10.0, -2.0, 0.0, 7.0, 30.0], [0.0, 1.0, 5.0, 20.0], [0.0, 10.0, 11.0, 60.0]
RNG = np.random.default_rng(7)
U, W = RNG.normal(size=(2, 4, 4, 5))
TABLE = {
    "law": "table", "x_m": X_M, "height_m": HEIGHT, "time_s": TIME,
    "velocity_x_mps": U.tolist(), "velocity_z_mps": W.tolist(),
}  # fmt: skip
PLACES = np.column_stack([RNG.uniform(-15, 40, 200), RNG.uniform(-3, 25, 200)])
TIMES = [-1.0, 0.0, 3.3, 10.0, 10.4, 35.0, 60.0, 99.0]


def field(current, t, X, before=()):
    tables = list(before)
    record = record_of(line(STILL, {"current": current}), tables)[0]
    F = np.zeros((len(X), 4))
    current_field(record, np.concatenate(tables), t, np.ascontiguousarray(X, float), F)
    return F


def interpolated(axes, values, points):
    clipped = [np.clip(point, axis[0], axis[-1]) for axis, point in zip(axes, points, strict=True)]
    return RegularGridInterpolator(axes, values)(np.stack(np.broadcast_arrays(*clipped), axis=-1))


@pytest.mark.parametrize("t", TIMES)
def test_table(t):
    F = field(TABLE, t, PLACES)
    for column, values in ((0, U), (1, W)):
        exact = interpolated((TIME, HEIGHT, X_M), values, (t, PLACES[:, 1], PLACES[:, 0]))
        assert np.max(np.abs(F[:, column] - exact)) < 1e-13


def test_the_table_gives_back_its_own_values():
    for i, t in enumerate(TIME):
        for j, z in enumerate(HEIGHT):
            F = field(TABLE, t, np.column_stack([X_M, np.full(5, z)]))
            assert F[:, 0] == pytest.approx(U[i, j], abs=1e-14)
            assert F[:, 1] == pytest.approx(W[i, j], abs=1e-14)


@pytest.mark.parametrize("t", [-1.0, 3.3, 10.4, 35.0, 99.0])
def test_local_acceleration(t):
    d = 1e-3
    rate = (field(TABLE, t + d, PLACES)[:, :2] - field(TABLE, t - d, PLACES)[:, :2]) / (2 * d)
    found = field(TABLE, t, PLACES)[:, 2:]
    assert np.max(np.abs(found - rate)) < 1e-9
    assert found.any() == (0 < t < 60)


def test_axes_of_one_value_are_constants():
    for axes, shape in (("time_s", (1, 4, 5)), ("height_m", (4, 1, 5)), ("x_m", (4, 4, 1))):
        single = {**TABLE, axes: [2.0]}
        u, w = (values[: shape[0], : shape[1], : shape[2]] for values in (U, W))
        single.update(velocity_x_mps=u.tolist(), velocity_z_mps=w.tolist())
        doubled = {**TABLE, axes: [2.0, 3.0]}
        axis = ("time_s", "height_m", "x_m").index(axes)
        for key, values in (("velocity_x_mps", u), ("velocity_z_mps", w)):
            doubled[key] = np.repeat(values, 2, axis=axis).tolist()
        assert field(single, 5.0, PLACES) == pytest.approx(field(doubled, 5.0, PLACES), abs=1e-14)


def test_profile_is_numpys_interp():
    height, u, w = [0.0, 4.0, 5.0, 21.0], [0.0, 0.3, -0.2, 1.5], [0.0, 0.1, 0.0, -0.1]
    profile = {"law": "profile", "height_m": height, "velocity_mps": [[a, 0.0, b] for a, b in zip(u, w, strict=True)]}
    F = field(profile, 12.0, PLACES)
    assert F[:, 0] == pytest.approx(np.interp(PLACES[:, 1], height, u), abs=1e-14)
    assert F[:, 1] == pytest.approx(np.interp(PLACES[:, 1], height, w), abs=1e-14)
    assert not F[:, 2:].any()


def test_uniform():
    F = field({"law": "uniform", "velocity_mps": [0.4, 0.0, -0.1]}, 3.0, PLACES)
    assert np.array_equal(F, np.tile([0.4, -0.1, 0.0, 0.0], (200, 1)))


def test_a_table_is_found_behind_other_tables():
    assert np.array_equal(field(TABLE, 3.3, PLACES), field(TABLE, 3.3, PLACES, [np.full(17, 1e9)]))
