"""Law: with everything in the plane x-z, three dimensions give the motion of the planar engine, and y is exactly zero.

Both solve the same box equations with other unknowns: they differ by rounding, until slack magnifies that. At kA =
0.13, H = 22.5 m rounding grows along the slack rope to decimetres after 6 periods (the planar engine does the same to
itself with other roundings), while the buoy stays within millimetres.

Law: a line whose ends are free to turn carries no torque, and its Euler parameters keep length one, also through slack
and loops that leave the plane. (A mirrored blow gives the mirrored motion: `tests/campaigns/test_out_of_plane.py`.)

kA = 0.13, H = 21.6 m with a lateral blow to the buoy: 15 periods, the first loop at 53 s among them.
"""

import numpy as np
import pytest

from tests.engine.lines import DRY, SPACE, Motion, harmonic, held, in_space, kick, line, ran, uniform
from tests.engine.physics.caps import CAP
from tests.engine.rotations import conjugate, product

CALM = {"waves.steepness": 0.016, "water.depth_m": 22.5}
STEEP = {"waves.steepness": 0.13, "water.depth_m": 22.5}
SHAKEN = harmonic([0.4, 0.0, 0.3], 3.0, ramp_s=3.0)
SCENES = {
    "calm": (CALM, 40.0),
    "towards -x, in a current": (
        {**CALM, "waves.direction_rad": np.pi, **uniform(0.3, 0.0, 0.05)}, 20.0,
    ),
    "without bending": ({**CALM, "tether.bending_stiffness_Nm2": 0.0}, 20.0),
    "in and out of the water": ({**CAP, "waves.steepness": 0.02, "water.depth_m": 21.0}, 30.0),
    "held and shaken": (  # slack lines magnify what Newton's method leaves, 300 times less than by default here
        {**CALM, **held(8.0, 17.0), "end.motion": SHAKEN, "solver.newton_tolerance": 1e-6}, 15.0,
    ),
    "the paper's scheme": (
        {**CALM, **uniform(0.5, 0.0, 0.1), "tether.nodes": 9,
         "solver.scheme": "paper-box", "solver.step_s": 0.0125, "solver.newton_tolerance": 1e-10}, 2.5,
    ),
    "let go in air": ({**DRY, **held(10.0, -15.0), "end.release_s": 0.5, "tether.bending_stiffness_Nm2": 4.0}, 2.0),
}  # fmt: skip


def both(*parts, duration_s):
    runs = [ran(line(*parts, {"output.profiles": True}, changes), duration_s=duration_s) for changes in ({}, SPACE)]
    assert not runs[1].profiles.y_m.any() and not runs[1].columns["offplane_m"].any()
    return runs


def distances(plane, space):
    """Of each node at each time, m."""
    one, other = plane.profiles, space.profiles
    return np.hypot(one.x_m - other.x_m, one.z_m - other.z_m)


@pytest.mark.parametrize("name", [pytest.param(n, marks=[pytest.mark.slow] * (n[-6:] == "scheme")) for n in SCENES])
def test_a_regular_motion_is_the_same(name):
    parts, duration_s = SCENES[name]
    plane, space = both(parts, duration_s=duration_s)
    assert np.ptp(plane.profiles.x_m, axis=0).max() > 0.1
    assert distances(plane, space).max() < 1e-6
    assert np.abs(plane.columns["angle_rad"] - space.columns["angle_rad"]).max() < 1e-6  # both along the waves
    tension = plane.columns["tension_top_N"]
    assert np.abs(tension - space.columns["tension_top_N"]).max() < 1e-4 * np.abs(tension).max()


def test_a_loop_in_an_exactly_planar_motion_is_released_as_in_the_plane():
    """kA = 0.13, H = 21.6 m: nothing takes it out of the plane, so it is pulled tight, and the run goes on after it."""
    parts = {"waves.steepness": 0.13, "water.depth_m": 21.6, "solver.rtol": 1e-3}
    plane, space = both(parts, duration_s=70.0)
    counts = [run.statistics["loop_releases"] for run in (plane, space)]
    assert min(counts) >= 1
    assert distances(plane, space)[:, -1].max() < 0.05


@pytest.mark.parametrize("velocity", [1e-5, 0.1])
def test_no_torque_unit_length_and_no_roll(velocity):
    """From node to node the frame turns about an axis in its own normal plane: no first component, to rounding."""
    blow = {"water.depth_m": 21.6, "output.profiles": True, **kick(v=velocity)}
    motion = Motion(in_space(STEEP, blow), 75.0)
    run = motion.run()
    assert run.status == "ok" and run.statistics["loop_releases"] == 0
    assert np.abs(run.profiles.y_m).max() > 0.05
    assert np.abs(motion.Y[:, 10]).max() == 0.0
    beta = motion.Y[:, 6:10]
    assert np.abs(np.linalg.norm(beta, axis=1) - 1).max() < 1e-13
    assert np.abs(product(conjugate(beta[:-1]), beta[1:])[:, 1]).max() < 1e-12


def test_a_clamped_end_that_is_let_go_loses_its_torque():
    """Twisted by a turn between two clamps: O1 is that twist over the length, less what the shape gives, then zero."""
    end = {"kind": "held", "position_m": [14.0, 4.0, 12.0], "rotation": "clamped", "twist_rad": 6.0, "release_s": 0.5}
    scene = in_space(
        {"waves": None, "buoy": None, "end": end, "anchor.rotation": "clamped", "output.step_s": 0.02},
        bending_stiffness_Nm2=50.0, torsion_stiffness_Nm2=40.0,
    )  # fmt: skip
    motion = Motion(scene, 0.8)
    history = [(t, Y[:, 10].copy()) for t, Y in motion.states()]
    assert int(motion.inner.state["status"]) == 0
    for t, torsion in history:
        assert np.ptp(torsion) == 0.0  # one number along the line
        assert torsion[0] == pytest.approx(0.3, rel=0.1) if t < 0.5 else t < 0.51 or torsion[0] == 0.0
