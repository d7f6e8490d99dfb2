"""Law: the equations know the vertical and no other direction.

A scene turned about the vertical by any angle - waves, currents, starts, forces, clamps, the motion of a held end -
gives the turned motion; mirrored at the plane of the waves it gives the mirrored motion; and the roll of the local
frames about the tangent, which is free, changes nothing. Fixed steps and stages solved to rounding, before slack has
magnified rounding; each quantity relative to its size: 1e-8, mirrored 1e-12 (the same arithmetic with other signs;
the paper's scheme, which solves to 1e-10, 1e-8).
"""

import math

import numpy as np
import pytest

from tests.engine.lines import DRY, QUIET, STILL, Motion, axes_of, held, in_space, kick, ran
from tests.engine.physics.caps import CAP
from tests.engine.rotations import product
from tests.engine.rotations import turned as about_the_vertical

ANGLE = 2.5
STEPS = {"solver.step_s": 0.02, "output.profiles": True, **QUIET}
TENSIONS = ["tension_top_N", "tension_min_N", "tension_top_low_N", "tension_top_high_N"]


WAVES = {
    "waves.steepness": 0.016,
    "waves.direction_rad": 0.0,
    "water.depth_m": 22.5,
    "current": {"law": "profile", "height_m": [0.0, 22.0], "velocity_mps": [[0.1, 0.2, 0.0], [-0.1, 0.5, 0.05]]},
    **kick(0.2, 0.3, 0.1),
}
HARMONIC = {"law": "harmonic", "ramp_s": 2.0}
MOVED = HARMONIC | {"amplitude_m": [0.5, 0.3, -0.4], "period_s": 3.0}
TWISTED = {
    "rotation": "clamped", "direction": [2.0, 1.0, 0.5], "twist_rad": 2.0,
    "motion": HARMONIC | {"amplitude_m": [0.2, 0.3, 0.1], "period_s": 2.0},
}  # fmt: skip
CLAMPED = {
    "anchor": {"rotation": "clamped", "direction": [1.0, 0.2, 1.0]},
    "tether.bending_stiffness_Nm2": 50.0,
    "tether.torsion_stiffness_Nm2": 30.0,
}
LET_GO = held(5.0, 8.0, -3.0, release_s=0.5, force_N=[2.0, -1.0, 3.0]) | {"tether.bending_stiffness_Nm2": 4.0}
PAPER = {"solver.scheme": "paper-box", "solver.step_s": 0.0125, "solver.newton_tolerance": 1e-10, "tether.nodes": 9}
SCENES = {  # what is turned, run length (s)
    "buoy in small waves": (WAVES, 40.0),
    "buoy in steep waves": (WAVES | {"waves.steepness": 0.08}, 15.0),
    "without bending": (WAVES | {"tether.bending_stiffness_Nm2": 0.0}, 20.0),
    "in and out of the water": (WAVES | CAP | {"waves.steepness": 0.02, "water.depth_m": 21.0}, 10.0),
    "a held end in motion": (
        {"waves.direction_rad": 0.0, "waves.steepness": 0.05} | held(6.0, -3.0, 17.0, motion=MOVED), 6.0,
    ),
    "a held end let go": (DRY | LET_GO, 1.0),
    "clamped and twisted": (STILL | held(12.0, 9.0, 8.0, **TWISTED) | CLAMPED, 4.0),
    "the paper's scheme": (WAVES | PAPER | {"waves.steepness": 0.03}, 2.5),
}  # fmt: skip
VECTORS = ("position_m", "force_N", "direction", "amplitude_m", "velocity_mps", "buoy_velocity_mps")
TAKES_LONG = ["buoy in small waves", "the paper's scheme"]
NAMES = [pytest.param(name, marks=[pytest.mark.slow] * (name in TAKES_LONG)) for name in SCENES]


def turned(part, angle, mirror=1.0, key=VECTORS[0]):
    """A part of a scene - here a vector, or a list of them - after y -> mirror * y and a turn about the vertical."""
    if isinstance(part, dict):
        return {name: turned(value, angle, mirror, name.split(".")[-1]) for name, value in part.items()}
    if key in VECTORS:
        return about_the_vertical(np.array(part, float) * [1.0, mirror, 1.0], angle).tolist()
    if key == "direction_rad":
        return mirror * part + angle
    return mirror * part if key == "twist_rad" else part


def shown(run):
    """Columns of a run; places (m, n, 3), strains and speeds of its line."""
    lines = run.profiles
    return run.columns, np.stack([lines.x_m, lines.y_m, lines.z_m], -1), lines.strain, lines.speed_mps


def seen_from(angle, mirror, name):
    """`shown` of the run of a turned and mirrored scene, its line turned and mirrored back."""
    parts, duration_s = SCENES[name]
    columns, X, *lines = shown(ran(in_space(STEPS, turned(parts, angle, mirror)), duration_s=duration_s))
    return columns, np.array(turned(X, -angle)) * [1.0, mirror, 1.0], *lines


def assert_equal(run, other_run, relative):
    (columns, *lines), (other_columns, *other_lines) = run, other_run
    pairs = list(zip(lines, other_lines, strict=True))
    pairs += [(columns[key], other_columns[key]) for key in ("radius_m", *TENSIONS)]
    for values, other_values in pairs:
        assert np.abs(values - other_values).max() < relative * np.abs(values).max()


@pytest.mark.parametrize("name", NAMES)
def test_a_turned_scene_gives_the_turned_motion(name):
    straight = seen_from(0.0, 1.0, name)
    assert np.ptp(straight[1][..., 1]) > 0.5  # well out of any plane
    assert_equal(straight, seen_from(ANGLE, 1.0, name), 1e-8)


def test_the_table_of_a_turned_wave_is_the_turned_table():
    """Angles are measured in the plane of the waves, distances from it."""
    straight, other = (seen_from(angle, 1.0, "buoy in steep waves")[0] for angle in (0.0, ANGLE))
    for key in ("angle_rad", "angle_rate_radps", "offplane_m"):
        assert np.abs(straight[key]).max() > 0.01
        assert np.abs(straight[key] - other[key]).max() < 1e-8 * np.abs(straight[key]).max()


@pytest.mark.parametrize("name", NAMES)
def test_a_mirrored_scene_gives_the_mirrored_motion(name):
    """The mirror also turns a twist round."""
    assert_equal(seen_from(0.0, 1.0, name), seen_from(0.0, -1.0, name), 1e-8 if "paper" in name else 1e-12)


def rolled(Y, angle):
    """A state with every frame turned by an angle about its tangent: the same forces and curvatures, in other axes."""
    Y, n = Y.copy(), len(Y)
    c, s = math.cos(angle), math.sin(angle)
    Y[:, 6:10] = product(Y[:, 6:10], np.tile([math.cos(angle / 2), math.sin(angle / 2), 0.0, 0.0], (n, 1)))
    for i, j in ((1, 2), (11, 12)):
        Y[:, i], Y[:, j] = c * Y[:, i] + s * Y[:, j], c * Y[:, j] - s * Y[:, i]
    return Y


@pytest.mark.parametrize("name", ["buoy in steep waves", "a held end let go", "clamped and twisted"])
def test_the_roll_of_the_frames_changes_nothing(name):
    parts, duration_s = SCENES[name]
    runs = []
    for angle in (0.0, 2.0):
        motion = Motion(in_space(STEPS, parts), duration_s)
        motion.Y[:] = rolled(motion.Y, angle)
        motion.inner.motion.Y_before[:] = motion.Y
        normals = axes_of(motion.Y)[1]
        run = motion.run()
        assert run.status == "ok"
        runs.append((shown(run), normals, motion.Y))
    (unrolled, normals, last), (run, rolled_normals, rolled_last) = runs
    assert_equal(unrolled, run, 1e-8)
    assert np.abs(np.cos(2.0) - np.sum(normals * rolled_normals, 1)).max() < 1e-12  # it was rolled
    shear = rolled_last[:, 1:3]  # tied to nothing but the curvature, of differences of which it is made
    assert np.abs(rolled(last, 2.0)[:, 1:3] - shear).max() < 1e-6 * np.abs(shear).max()
