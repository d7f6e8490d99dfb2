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
PLANE, PROFILE = table(FLAT, VALUES[[0, 2], :, :, 0]), [0.0, 4.0, 5.0, 21.0]
VELOCITIES = RNG.normal(size=(4, 3))
CURRENTS = {  # dimensions, and the current
    "in a plane": (2, PLANE),
    "in space": (3, table(AXES, VALUES)),
    "the same everywhere across": (3, PLANE),
    "with a velocity across": (3, {**PLANE, "velocity_y_mps": PLANE["velocity_x_mps"]}),
    "uniform": (3, {"law": "uniform", "velocity_mps": [0.4, -0.2, 0.1]}),
    "profile in a plane": (2, {"law": "profile", "height_m": PROFILE, "velocity_mps": VELOCITIES * [1.0, 0.0, 1.0]}),
    "profile": (3, {"law": "profile", "height_m": PROFILE, "velocity_mps": VELOCITIES}),
} | {
    f"one value of {name}": (3, table(AXES | {name: [2.0]}, np.take(VALUES, [1], axis=1 + at)))
    for at, name in enumerate(AXES)
}


def field(current, t, dimensions):
    """Velocity and acceleration, (200, dimensions) each; the table lies behind others."""
    scene = line(STILL, {"current": current, "motion.dimensions": dimensions})
    X = PLACES if dimensions == 3 else PLACES[:, [0, 2]]
    return np.split(current_at(scene, t, X, [np.full(17, 1e9)]), 2, axis=1)


def exact(current, t):
    """Velocity (200, 3) by scipy; an axis of one value has it everywhere."""
    if current["law"] == "uniform":
        return np.tile(current["velocity_mps"], (200, 1))
    if current["law"] == "profile":
        return np.transpose([np.interp(PLACES[:, 2], current["height_m"], part) for part in current["velocity_mps"].T])
    points = {"time_s": np.full(200, t), "x_m": PLACES[:, 0], "y_m": PLACES[:, 1], "height_m": PLACES[:, 2]}
    axes = {name: current[name] for name in AXES if name in current}
    clipped = np.stack([np.clip(points[name], axis[0], axis[-1]) for name, axis in axes.items()], axis=-1)
    computed = np.zeros((200, 3))
    for component, name in enumerate("xyz"):
        if f"velocity_{name}_mps" in current:
            values, grid = np.array(current[f"velocity_{name}_mps"]), []
            for at, axis in enumerate(axes.values()):
                values = np.repeat(values, 2, axis=at) if len(axis) == 1 else values
                grid.append([axis[0], axis[0] + 1.0] if len(axis) == 1 else axis)
            computed[:, component] = RegularGridInterpolator(grid, values)(clipped)
    return computed


@pytest.mark.parametrize("name", CURRENTS)
@pytest.mark.parametrize("t", TIMES)
def test_a_current_is_linear_between_its_values(t, name):
    dimensions, current = CURRENTS[name]
    velocity, acceleration = field(current, t, dimensions)
    columns = [0, 1, 2] if dimensions == 3 else [0, 2]
    assert np.max(np.abs(velocity - exact(current, t)[:, columns])) < 1e-13
    if t not in AXES["time_s"]:
        ahead, behind = (field(current, t + d, dimensions)[0] for d in (1e-3, -1e-3))
        assert np.max(np.abs(acceleration - (ahead - behind) / 2e-3)) < 1e-9
        assert acceleration.any() == (0 < t < 60 and len(current.get("time_s", [0.0])) > 1)


def test_a_current_across_the_plane_alone_is_a_current():
    """Only V is not zero: a record that looked at U and W alone would leave it out."""
    for current in (
        {"law": "uniform", "velocity_mps": [0.0, 0.3, 0.0]},
        table(AXES, VALUES * np.array([0.0, 1.0, 0.0]).reshape(3, 1, 1, 1, 1)),
    ):
        assert parameters_of(line(STILL, SPACE, {"current": current}))[0]["current"] == 1
