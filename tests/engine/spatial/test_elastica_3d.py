"""Law: a rod between clamps lies as Kirchhoff's equations say, in a plane (the elastica) and out of it.

The engine's rest against `rod_equations.kirchhoff` (moments in fixed axes, solve_bvp to 1e-9), and against the uniform
helix, which is exact: with t at the angle theta to the axis, turning at the rate p, and twist O1,

    N = F along the axis,  F = p GIp O1 - EI p^2 cos theta,   |curvature| = p sin theta.

Tolerance: order 2 in h; extension and its cube in the moment equation are in the two-point problem, and 2e-5 here.
"""

import numpy as np
import pytest

from tests.engine.lines import axes_of, forces, positions
from tests.engine.rotations import conjugate, product, shortest
from tests.engine.spatial.rod_equations import kirchhoff
from tests.engine.spatial.rods import Rod, at_rest, state_of

EI, GI, EA = 0.4, 0.3, 1e5
CASES = {
    "in a plane, an arch": ((2.0, 1.0, 2.0), 0.0, (1.0, 0.5, 1.0), (1.0, 0.5, 1.0)),
    "in a plane, an S": ((2.0, 1.0, 2.0), 0.0, (0.0, 0.0, 1.0), (0.0, 0.0, 1.0)),
    "out of a plane": ((2.0, 1.0, 1.5), 0.0, (1.0, 0.0, 0.0), (0.0, 0.6, 0.8)),
    "and twisted": ((2.0, 1.0, 1.5), 3.0, (1.0, 0.0, 0.0), (0.0, 0.6, 0.8)),
    "and twisted the other way": ((2.0, 1.0, 1.5), -3.0, (1.0, 0.0, 0.0), (0.0, 0.6, 0.8)),
}


def answer(rod, Y, h):
    """O1, N and the place of the middle."""
    return np.concatenate([Y[:1, 10], forces(Y, EA).mean(axis=0), positions(Y, h)[len(h) // 2]])


@pytest.mark.parametrize("case", CASES)
def test_the_rest_of_a_clamped_rod(case):
    rod = Rod(EI, GI, EA, 4.0, *CASES[case])
    answers = []
    for nodes in (41, 81, 161):
        Y, h = at_rest(rod, nodes)
        answers.append(answer(rod, Y, h))
        assert forces(Y, EA) == pytest.approx(np.tile(answers[-1][1:4], (nodes, 1)), abs=1e-8)
    solution, N, O1 = kirchhoff(rod, Y, h)
    exact = np.concatenate([[O1], N, solution.sol(2.0)[:3]])
    coarse, middle, fine = (np.abs(a - exact) for a in answers)
    steady = fine > 1e-6
    assert steady.sum() >= 6
    assert np.log2(coarse / middle)[steady] == pytest.approx(2, abs=0.1)
    assert np.log2(middle / fine)[steady] == pytest.approx(2, abs=0.1)
    assert fine.max() < 3e-4
    # shape: the points of the fine grid lie on the solution
    s = np.concatenate([[0.0], np.cumsum(h)])
    assert positions(Y, h) == pytest.approx(solution.sol(s)[:3].T, abs=3e-4)
    if "in a plane" in case and "out" not in case:
        assert np.abs(Y[:, 10]).max() < 1e-9
        assert np.abs(positions(Y, h) @ np.cross(rod.place, rod.below)).max() < 1e-9


@pytest.mark.parametrize("azimuth", [0.0, 0.6435011, np.pi / 2, -2.0])
def test_a_line_that_hangs_between_opposed_clamps_is_not_twisted(azimuth):
    """A U in any vertical plane, without twist, is planar; with twist its torque is the same in every such plane."""
    place = (np.cos(azimuth), np.sin(azimuth), 0.0)
    for twist, torque in ((0.0, 0.0), (1.0, 0.2161)):
        rod = Rod(EI, GI, EA, 4.0, place, twist, (0.0, 0.0, -1.0), (0.0, 0.0, 1.0))
        Y, _ = at_rest(rod, 81)
        assert Y[0, 10] == pytest.approx(torque, abs=1e-4 if twist else 1e-9)


def helix(p, theta, O1, length):
    """The rod held as a helix about x, its force, and its exact state as a function of s."""
    F = 0.0
    for _ in range(5):  # extension enters by its cube (16)
        lam = 1 + F * np.cos(theta) / EA
        F = (p * GI * O1 - EI * p**2 * np.cos(theta)) / lam**3
    end = lam * np.array([np.cos(theta) * length, np.sin(theta) * np.sin(p * length) / p,
                          np.sin(theta) * (1 - np.cos(p * length)) / p])  # fmt: skip

    def state(rod, s):
        c, sn = np.cos(p * s), np.sin(p * s)
        one = np.ones_like(s)
        t = np.stack([np.cos(theta) * one, np.sin(theta) * c, np.sin(theta) * sn], 1)
        bend = p * np.sin(theta) * np.stack([0 * s, -sn, c], 1)  # t_s
        normal, side = bend / (p * np.sin(theta)), np.cross(t, bend) / (p * np.sin(theta))
        roll = -p * np.cos(theta) * s[:, None]  # the torsion of the curve, taken back
        n = np.cos(roll) * normal + np.sin(roll) * side
        return state_of(rod, s, t, n, GI * O1 * t + EI * np.cross(t, bend), np.array([F, 0.0, 0.0]))

    open_rod = Rod(EI, GI, EA, length, tuple(end), 0.0)
    exact = state(open_rod, np.linspace(0, length, 200))
    t = axes_of(exact)[0][[0, -1]]
    chord = end / np.linalg.norm(end)

    start = product(product(shortest(chord, t[1]), shortest(t[0], chord)), exact[:1, 6:10])
    r = product(conjugate(start), exact[-1:, 6:10])[0]
    twist = 2 * np.arctan2(r[1], r[0]) + O1 * length
    rod = Rod(EI, GI, EA, length, tuple(end), twist, tuple(t[0]), tuple(t[1]))
    return rod, F, lambda s: state(rod, s)


@pytest.mark.parametrize("p, theta, O1", [(1.2, 0.8, 2.0), (-1.2, 0.8, 2.0), (2.5, 0.5, 0.0), (0.8, 1.2, -3.0)])
def test_a_uniform_helix(p, theta, O1):
    """More than a turn of it, of either hand, pushed and pulled."""
    errors = []
    rod, F, exact = helix(p, theta, O1, 6.0)
    for nodes in (61, 121, 241):
        Y, h = at_rest(rod, nodes, exact)
        bend = np.hypot(Y[:, 11], Y[:, 12])
        N = forces(Y, EA).mean(axis=0) - [F, 0, 0]
        shape = positions(Y, h) - positions(exact(np.linspace(0, 6.0, nodes)), h)
        bent = np.abs(bend - abs(p) * np.sin(theta)).max()
        errors.append([np.linalg.norm(N), abs(Y[0, 10] - O1), bent, np.abs(shape).max()])
    coarse, middle, fine = np.array(errors)
    assert np.log2(coarse / middle) == pytest.approx(2, abs=0.2)
    assert np.log2(middle / fine) == pytest.approx(2, abs=0.2)
    assert np.all(fine < 0.01)
