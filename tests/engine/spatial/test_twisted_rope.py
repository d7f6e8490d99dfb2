"""Law: the shipped twisted rope, slackened slowly in still water, goes through the equilibria of a clamped rod.

Against the localised buckle of a long rod (`test_torsion_localised`) with the same slack D and turn R: m from
D = 8 EI m sqrt(1-m^2)/M, M = (R - 4 arccos m) GIp/L.

Tolerance: a half of it is 6.7 decay lengths long, which moves T and torque by 0.09 % and the deflection by 0.11 %; the
clamp's tilt of 0.01 rad moves the forces by 3e-4 and the deflection by 1 mm; drag is quadratic and leaves slow motion.
The fold is met at 1.0009 of its slack on 241 nodes, 0.9998 on 481.
"""

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar

from engine import load_scene
from tests.engine.lines import Motion, axes_of, forces, positions
from tests.engine.spatial.rod_equations import Localised


def torque_of(scene, m):
    tether = scene.tether
    return (scene.end.twist_rad - 4 * np.arccos(m)) * tether.torsion_stiffness_Nm2 / tether.length_m


def slack_of(scene, m):
    """D of the localised buckles with the turn of the scene."""
    return 8 * scene.tether.bending_stiffness_Nm2 * m * np.sqrt(1 - m**2) / torque_of(scene, m)


def fold_of(scene):
    """m at the greatest D that any of them has."""
    return minimize_scalar(lambda m: -slack_of(scene, m), bounds=(0.45, 0.99), options={"xatol": 1e-10}).x


def buckle_of(scene, slack):
    """The stable localised buckle of this slack."""
    EI, GI = scene.tether.bending_stiffness_Nm2, scene.tether.torsion_stiffness_Nm2
    m = brentq(lambda m: slack_of(scene, m) - slack, fold_of(scene), 1 - 1e-12)
    return Localised(EI, GI, torque_of(scene, m) ** 2 / (4 * EI * m**2), m)


def test_it_rests_as_the_localised_buckle():
    """Tension, torque and the deflection in the middle; the middle is turned back: a loop."""
    scene = load_scene("twisted_rope", {"tether.nodes": 241})
    motion = Motion(scene, 100.0)
    assert motion.run().status == "ok"
    tether, Y, x = scene.tether, motion.Y, positions(motion.Y, motion.h)
    assert x[-1, 2] == pytest.approx(4.903, abs=1e-4)
    buckle = buckle_of(scene, tether.length_m - x[-1, 2])
    T, torque = np.linalg.norm(forces(Y, tether.tension)[120]), tether.torsion_stiffness_Nm2 * Y[0, 10]
    found = [T, torque, np.hypot(*x[:, :2].T).max()]
    assert found == pytest.approx([buckle.T, buckle.torque, buckle.deflection], rel=1e-2)
    assert np.cos(buckle.angles(np.zeros(1))[0][0]) < -0.2


def test_the_tangent_turns_from_the_axis_past_a_right_angle():
    motion = Motion(load_scene("twisted_rope", {"output.step_s": 5.0}), 70.0)
    steepest = np.array([axes_of(Y)[0][:, 2].min() for _, Y in motion.states()])
    assert steepest[2] > 0.9999  # twisted by all its 1.25 turns, and straight
    assert np.all(np.diff(steepest[3:]) < 0)
    assert steepest[-1] < -0.15


@pytest.mark.parametrize("share, thrown", [(0.998, False), (1.004, True)])
def test_it_throws_its_loop_over_where_the_localised_buckles_end(share, thrown):
    """Beyond the fold no buckle has so much slack: the loop opens, and the pull falls to a quarter (241 nodes)."""
    scene = load_scene("twisted_rope")
    slack = share * slack_of(scene, fold_of(scene))
    slow = {"law": "table", "time_s": [0, 10, 70, 130, 190]}
    down = [0, 0, -1.1, *(scene.tether.length_m - slack - scene.end.position_m[2],) * 2]
    moved = {"end.motion": slow | {"displacement_m": [[0, 0, z] for z in down]}}
    run = Motion(load_scene("twisted_rope", {"tether.nodes": 241, "solver.max_step_s": 0.5} | moved), 400.0).run()
    assert run.status == "ok"
    assert (run.table().tension_top_N.iloc[-1] < 1.5) == thrown
