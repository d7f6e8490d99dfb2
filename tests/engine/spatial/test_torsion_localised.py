"""Law: a long rod under tension T that is twisted past M^2 = 4 EI T and slackened buckles into one place. With
m = M/(2 sqrt(EI T)) its ends have come closer by D and are turned against each other by R,

    D = 4 sqrt(EI/T) sqrt(1 - m^2),   R = M L/GIp + 4 arccos m,   and it stands D/2 off its axis

(Coyne, IEEE J. Oceanic Eng. 15, 1990; van der Heijden & Thompson, Nonlinear Dynamics 21, 2000). From the first
integrals of Kirchhoff's equations, u = cos theta: M = EI psi_s sin^2 theta + M u, and the energy
(2T/EI) (1-u)^2 (1 + u - 2 m^2) = u_s^2; |M|^2 = M^2 + T^2 rho^2 for the distance rho from the axis.

Law (Calugareanu, White, Fuller): what the clamps are turned against each other is twist and writhe,

    Phi/(2 pi) = O1 L/(2 pi) + Wr,   Wr = (1/4 pi) int int (t1 x t2).(x1 - x2)/|x1 - x2|^3 ds1 ds2

over the rod and two straight lines that carry its clamped ends on to infinity; and it changes by two whole turns where
the rod passes through itself, which the model lets it do: it knows no contact. The writhe is that of the polygon
through the nodes (Klenin & Langowski, Biopolymers 54, 2000, method 1a), order h^2 from that of the curve, as is O1.

Law: the shipped twisted rope, slackened slowly in still water, goes through these equilibria: m from D = 8 EI m
sqrt(1-m^2)/M, M = (R - 4 arccos m) GIp/L. A half of it is 6.7 decay lengths long, which moves T and torque by 0.09 %
and the deflection by 0.11 %; the clamp's tilt of 0.01 rad moves the forces by 3e-4 and the deflection by 1 mm; drag is
quadratic and leaves slow motion. The fold is met at 1.0009 of its slack on 241 nodes, 0.9998 on 481.
"""

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar

from engine import load_scene
from tests.engine.lines import Motion, axes_of, forces, positions

FAR = 1e4


def writhe(x):
    """Of a polygon (n, 3): for each pair of segments the solid angle under which they are seen to cross."""

    def unit(p, q):
        c = np.cross(p, q)
        size = np.linalg.norm(c, axis=-1, keepdims=True)
        return c / np.where(size > 0, size, 1.0)

    total = 0.0
    for i in range(len(x) - 3):
        a, b, c, d = x[i], x[i + 1], x[i + 2 : -1], x[i + 3 :]
        n = [unit(c - a, d - a), unit(d - a, d - b), unit(d - b, c - b), unit(c - b, c - a)]
        angles = [np.arcsin(np.clip(np.sum(n[k] * n[(k + 1) % 4], axis=1), -1, 1)) for k in range(4)]
        total += np.sum(sum(angles) * np.sign(np.sum(np.cross(d - c, b - a) * (c - a), axis=1)))
    return total / (2 * np.pi)


def link(Y, h, below, above):
    """Twist and writhe of a state, turns."""
    x = positions(Y, h)
    line = np.vstack([x[0] - FAR * np.array(below), x, x[-1] + FAR * np.array(above)])
    return Y[0, 10] * h.sum() / (2 * np.pi), writhe(line)


@pytest.mark.parametrize("slack, lost", [pytest.param(1.1, 0, marks=pytest.mark.slow), (1.2, 2)])
def test_link_is_kept_until_the_rope_passes_through_itself(slack, lost):
    """The shipped rope, twisted by 1.25 turns: a loop at 1.1 m of slack; at 1.2 m it has thrown itself over."""
    rows = [[0, 0, 0], [0, 0, 0], [0, 0, -slack], [0, 0, -slack]]
    scene = load_scene("twisted_rope", {"end.motion.displacement_m": rows, "output.step_s": 5.0})
    motion = Motion(scene, 100.0)
    above = np.array(scene.end.direction) / np.linalg.norm(scene.end.direction)
    history = []
    for t, Y in motion.states():
        given = 1.25 * (np.sin(np.pi * t / 20) ** 2 if t < 10 else 1.0)
        history.append(given - sum(link(Y, motion.h, (0, 0, 1), above)))
    assert np.abs(np.array(history) - np.round(history)).max() < 5e-3
    assert np.all(np.diff(np.round(history)) >= 0)
    assert round(history[-1]) == lost


def torque_of(scene, m):
    tether = scene.tether
    return (scene.end.twist_rad - 4 * np.arccos(m)) * tether.torsion_stiffness_Nm2 / tether.length_m


def slack_of(scene, m):
    """D of the localised buckles with the turn of the scene."""
    return 8 * scene.tether.bending_stiffness_Nm2 * m * np.sqrt(1 - m**2) / torque_of(scene, m)


def fold_of(scene):
    """m at the greatest D that any of them has."""
    return minimize_scalar(lambda m: -slack_of(scene, m), bounds=(0.45, 0.99), options={"xatol": 1e-10}).x


def test_the_rope_rests_as_the_localised_buckle():
    """Tension, torque, the deflection and the steepest tangent in the middle, which is turned back: a loop."""
    scene = load_scene("twisted_rope", {"tether.nodes": 241})
    motion = Motion(scene, 100.0)
    assert motion.run().status == "ok"
    tether, Y, x = scene.tether, motion.Y, positions(motion.Y, motion.h)
    assert x[-1, 2] == pytest.approx(4.903, abs=1e-4)
    slack, EI, GI = tether.length_m - x[-1, 2], tether.bending_stiffness_Nm2, tether.torsion_stiffness_Nm2
    m = brentq(lambda m: slack_of(scene, m) - slack, fold_of(scene), 1 - 1e-12)
    torque = torque_of(scene, m)
    computed = [np.linalg.norm(forces(Y, tether.tension)[120]), GI * Y[0, 10], np.hypot(*x[:, :2].T).max()]
    assert computed == pytest.approx([torque**2 / (4 * EI * m**2), torque, slack / 2], rel=1e-2)
    steepest = 2 * m**2 - 1  # 1 - cos theta = 2 (1 - m^2) in the middle
    assert axes_of(Y)[0][:, 2].min() == pytest.approx(steepest, abs=0.02) and steepest < -0.2


@pytest.mark.slow
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
