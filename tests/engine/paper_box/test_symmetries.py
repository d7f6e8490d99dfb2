"""Turned about the vertical, a scene gives the turned motion; mirrored, the mirrored one; in a plane it stays there."""

import numpy as np
import pytest

from engine import load_scene, simulate

pytestmark = pytest.mark.slow

LENGTH_S = 2.5


def turned(vector, angle):
    x, y, z = vector
    return [x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle), z]


def run_of(angle=0.0, mirror=1.0, dimensions=3, **overrides):
    """A buoy in oblique waves and a sheared current, with a push; all of it turned by `angle`, and y times `mirror`."""
    flat = 0.0 if dimensions == 2 else mirror
    vectors = [turned([x, flat * y, z], angle) for x, y, z in ([0.2, -0.4, 0.0], [0.9, 0.5, 0.0], [0.4, 0.3, -0.1])]
    scene = load_scene(
        "tethered_buoy",
        {
            "solver.scheme": "paper-box",
            "solver.step_s": 0.0125,
            "solver.newton_tolerance": 1e-10,
            "motion.dimensions": dimensions,
            "tether.nodes": 9,
            "waves.steepness": 0.03,
            "waves.direction_rad": angle if dimensions == 2 else angle + mirror * 0.4,
            "water.depth_m": 24.0,
            "current": {"law": "profile", "height_m": [0.0, 24.0], "velocity_mps": vectors[:2]},
            "start.buoy_velocity_mps": vectors[2],
            **overrides,
        },
    )
    run = simulate(scene, duration_s=LENGTH_S)
    assert run.status == "ok", run.message
    return run


def path(run):
    return np.array([run.columns[name] for name in ("x_m", "y_m", "z_m", "tension_top_N")])


@pytest.fixture(scope="module")
def straight():
    return path(run_of())


@pytest.mark.parametrize("angle", [1.0, -2.5])
def test_turned_about_the_vertical(straight, angle):
    assert np.ptp(straight[1]) > 0.1
    found = path(run_of(angle))
    expected = np.array([*turned(straight[:3], angle), straight[3]])
    assert np.abs(found - expected).max() < 1e-8 * np.abs(straight).max()


def test_mirrored(straight):
    found = path(run_of(mirror=-1.0))
    assert np.abs(found * [[1], [-1], [1], [1]] - straight).max() < 1e-8 * np.abs(straight).max()


def test_planar_motion_in_space_is_the_motion_in_the_plane():
    plane = {"current": {"law": "uniform", "velocity_mps": [0.5, 0.0, 0.1]}, "waves.direction_rad": 0.0,
             "start.buoy_velocity_mps": [0.4, 0.0, -0.1]}  # fmt: skip
    flat, free = (run_of(dimensions=dimensions, **plane) for dimensions in (2, 3))
    assert np.abs(path(flat) - path(free)).max() < 1e-8 * np.abs(path(flat)).max()
    assert not free.columns["y_m"].any() and not free.columns["offplane_m"].any()


def test_nothing_twists_a_line_with_torque_free_ends():
    """Omega_1 = 0 in space: with the torsion of a rigid rod the motion is the same."""
    soft, stiff = (path(run_of(**{"tether.torsion_stiffness_Nm2": GIp})) for GIp in (0.0, 40.0))
    assert np.abs(soft - stiff).max() < 1e-8 * np.abs(soft).max()
