"""Law: a rod between clamps lies as Kirchhoff's equations say, in a plane (the elastica) and out of it.

The engine's rest against `rods.kirchhoff` (moments in fixed axes, solve_bvp to 1e-9).

Tolerance: order 2 in h; extension and its cube in the moment equation are in the two-point problem, and 2e-5 here.
"""

import numpy as np
import pytest

from tests.engine.lines import forces, positions
from tests.engine.spatial.rods import Rod, at_rest, kirchhoff

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


def test_a_line_that_hangs_between_opposed_clamps_is_not_twisted():
    """A U in any vertical plane, without twist, is planar; with twist its torque is the same in every such plane."""
    for twist in (0.0, 1.0):
        torsions = []
        for azimuth in (0.0, 0.6435011, np.pi / 2, -2.0):
            place = (np.cos(azimuth), np.sin(azimuth), 0.0)
            Y, _ = at_rest(Rod(EI, GI, EA, 4.0, place, twist, (0.0, 0.0, -1.0), (0.0, 0.0, 1.0)), 81)
            torsions.append(Y[0, 10])
        assert np.ptp(torsions) < 1e-8
        assert np.abs(torsions).max() < 1e-9 if twist == 0 else torsions[0] > 0.1
