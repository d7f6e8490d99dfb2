"""Law: a straight rod whose clamps are turned by Phi against each other carries the torque GIp Phi/L and nothing else,
as long as M = GIp Phi/L stays below the torque at which it buckles. With alpha = M/(2 EI), beta^2 = alpha^2 - T/EI,

    EI w'''' - i M w''' - T w'' = 0,  w = y + i z,  w = w' = 0 at both ends
    has a solution where   beta L (cos beta L - cos alpha L) = (T L^2/(2 EI)) sin beta L,

from w = A + B s + C exp(i (alpha+beta) s) + D exp(i (alpha-beta) s). Far apart clamps: beta = 0, M^2 = 4 EI T (Love);
without tension the least root is M L/EI = 8.9868, twice that of tan x = x (Greenhill).

Tolerance: straight rods to rounding. The critical torque is where the answer to a slight misalignment of a clamp has
a pole; its inverse is taken there by a parabola through three twists (2e-4), and the box errs in h^2.
"""

import numpy as np
import pytest
from scipy.optimize import brentq

from tests.engine.lines import DRY, SPACE, Motion, axes_of, equilibrium, held, line, linear, positions

EI, GI, EA, LENGTH = 0.4, 0.3, 1e5, 5.0
ALONG_X = (1.0, 0.0, 0.0)


def clamped(place, below, above, twist, nodes, *changes, length_m=LENGTH):
    """The scene of a dry, weightless line to a place, between clamps of these directions, twisted by `twist` rad."""
    anchor = {"anchor": {"rotation": "clamped", "direction": list(below)}}
    end = held(*place, rotation="clamped", direction=list(above), twist_rad=twist)
    return line(
        DRY, SPACE, {"gravity_mps2": 0.0}, anchor, end, *changes, length_m=length_m, nodes=nodes,
        bending_stiffness_Nm2=EI, torsion_stiffness_Nm2=GI, tension=linear(EA),
    )  # fmt: skip


def straight(twist, tension, nodes, *changes, axis=ALONG_X, above=None):
    place = LENGTH * (1 + tension / EA) * np.array(axis)
    return clamped(place, axis, above or axis, twist, nodes, *changes)


def critical_torque(tension):
    def torque(beta):
        return 2 * EI * np.sqrt(beta**2 + tension / EI)

    def condition(beta):
        alpha = torque(beta) / (2 * EI)
        left = beta * LENGTH * (np.cos(beta * LENGTH) - np.cos(alpha * LENGTH))
        return (left - tension * LENGTH**2 / (2 * EI) * np.sin(beta * LENGTH)) / beta**3  # beta = 0 is no solution

    betas = np.linspace(1e-2, 12.0, 5000) / LENGTH
    values = np.array([condition(beta) for beta in betas])
    first = np.flatnonzero(values[1:] * values[:-1] < 0)[0]
    return torque(brentq(condition, betas[first], betas[first + 1], xtol=1e-14))


@pytest.mark.parametrize("twist", [0.3, -3.0, 40.0, 400.0])
@pytest.mark.parametrize("axis", [ALONG_X, (0.0, 0.0, 1.0), (0.6, 0.48, 0.64)])
def test_a_straight_rod_is_only_twisted(twist, axis):
    tension = 2 * max(1.0, (GI * twist / LENGTH) ** 2 / (4 * EI))
    rest = equilibrium(straight(twist, tension, 41, axis=axis))
    assert GI * rest.Y[:, 10] == pytest.approx(GI * twist / LENGTH, rel=1e-14)
    assert np.abs(rest.Y[:, [1, 2]]).max() < 1e-9 * tension and np.abs(rest.Y[:, [11, 12]]).max() < 1e-9
    assert positions(rest.Y, rest.h) == pytest.approx(np.outer(rest.s, axis) * (1 + tension / EA), abs=1e-9)


def test_twist_put_in_slowly_moves_nothing_else():
    """Torque GIp Phi(t)/L at every step, Phi = Phi_0 sin^2(pi t/(2 ramp)), at 0.9 of the critical torque."""
    tension = 3.0
    twist = 0.9 * critical_torque(tension) * LENGTH / GI
    scene = straight(twist, tension, 41, {"end.twist_ramp_s": 4.0, "output.step_s": 0.1})
    history = list(Motion(scene, 5.0).states())
    assert len(history) > 40
    for t, Y in history[1:]:
        given = twist * (np.sin(np.pi * t / 8) ** 2 if t < 4 else 1.0)
        assert Y[:, 10] * LENGTH == pytest.approx(given, rel=1e-12, abs=1e-12)
        assert np.abs(axes_of(Y)[0][:, 1:]).max() < 1e-9 and np.abs(Y[:, 4:6]).max() < 1e-9


def buckling_twist(nodes, tension):
    """Pole of the deflection under a clamp misaligned by 1e-7 rad over the exact critical twist, from twists below."""
    exact = critical_torque(tension) * LENGTH / GI
    shares = np.array([0.99, 0.995, 0.998])
    inverse = []
    for share in shares:
        tilted = equilibrium(straight(share * exact, tension, nodes, above=(1.0, 1e-7, 0.0)))
        x = positions(tilted.Y, tilted.h)
        inverse.append(1e-7 / np.hypot(*x[nodes // 2, 1:]))
    roots = np.polynomial.Polynomial.fit(shares, inverse, 2).roots().real
    return roots[np.argmin(np.abs(roots - 1))]


@pytest.mark.parametrize("tension", [0.5, 5.0])
def test_it_buckles_at_the_exact_critical_twist(tension):
    coarse, middle, fine = (buckling_twist(nodes, tension) for nodes in (41, 81, 161))
    assert np.log2((coarse - middle) / (middle - fine)) == pytest.approx(2, abs=0.1)
    assert fine + (fine - middle) / 3 == pytest.approx(1, abs=3e-4)
    assert fine == pytest.approx(1, abs=1e-3)


@pytest.mark.parametrize("twist", [0.0, 1.0])
def test_a_line_that_hangs_between_opposed_clamps_is_not_twisted(twist):
    """A U in any vertical plane, without twist, is planar; with twist its torque is the same in every such plane."""
    torsions = []
    for azimuth in (0.0, 0.6435011, np.pi / 2, -2.0):
        place = np.cos(azimuth), np.sin(azimuth), 0.0
        rest = equilibrium(clamped(place, (0.0, 0.0, -1.0), (0.0, 0.0, 1.0), twist, 81, length_m=4.0))
        torsions.append(rest.Y[0, 10])
    assert np.ptp(torsions) < 1e-8
    assert np.abs(torsions).max() < 1e-9 if twist == 0 else torsions[0] > 0.1
