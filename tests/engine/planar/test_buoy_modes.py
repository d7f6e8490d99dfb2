"""Law: small free motions of the buoy on its upright tether in still water (section 4.2 of the paper).

Radial (axial bar with an end mass): lam tan lam = m L/(M + M_a), omega = lam sqrt(EA/m)/L, 0.996 rad/s, then 117 and
235 rad/s. The box has (2/h) tan(kh/2) for the first k and keeps tan kL: rounding, 1e-7 relative.

Pendulum: the string equation (T w_s/(1+eps))_s + (m + m_a) omega^2 w = 0 with T w_s/(1+eps) = (M + M_a) omega^2 w at
the top, solved here by shooting. The mode is nearly straight: with k = omega sqrt((m + m_a)/T), (kh)^2/12 is 1e-6 and
less. The paper's 0.199 rad/s is the root of (B - W)/((M + M_a) l0), with the unstretched length and a massless line.
"""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from tests.engine.lines import STILL, equilibrium, line
from tests.engine.modes import box, distance, frequencies

LENGTH, EA, MASS = 20.0, 5e4, 1140.0 * 7.85e-5
HEAVY = 1611.0 + 907.0
ADDED = 1027.0 * 7.85e-5
LIFT = (1027.0 * np.pi * 1.5**3 / 6 - 1611.0) * 9.81
WEIGHT = (1140.0 - 1027.0) * 7.85e-5 * 9.81


def axial(count, number):
    """First `count` frequencies: number(k) L tan kL = m L/(M + M_a), number(k) = k or what the box makes of it."""
    roots = [
        brentq(
            lambda lam: number(lam / LENGTH) * LENGTH * np.sin(lam) - MASS * LENGTH / HEAVY * np.cos(lam),
            j * np.pi + 1e-6, (j + 0.5) * np.pi, xtol=1e-15,
        )
        for j in range(count)
    ]  # fmt: skip
    return np.sqrt(EA / MASS) * number(np.array(roots) / LENGTH)


def pendulum():
    def top(omega):
        def slope(s, y):
            T = LIFT - WEIGHT * (LENGTH - s)
            return [y[1] * (1 + T / EA) / T, -(MASS + ADDED) * omega**2 * y[0]]

        w, pull = solve_ivp(slope, (0, LENGTH), [0.0, 1.0], rtol=1e-12, atol=1e-12, method="DOP853").y[:, -1]
        return pull - HEAVY * omega**2 * w

    return brentq(top, 0.1, 0.3, xtol=1e-14)


@pytest.mark.parametrize("nodes", [21, pytest.param(81, marks=pytest.mark.slow)])
def test_axial_modes_with_end_mass_and_the_pendulum(nodes):
    found = frequencies(equilibrium(line(STILL, nodes=nodes, bending_stiffness_Nm2=0.0)), 10.0)
    h = LENGTH / (nodes - 1)
    assert distance(found, axial(4, lambda k: box(k, h))) < 1e-7
    exact = axial(4, lambda k: k)
    assert exact[0] == pytest.approx(0.996, abs=5e-4)
    assert exact[1:3] == pytest.approx([117, 235], abs=0.5)
    for omega in exact:
        assert distance(found, np.array([omega])) < (omega * np.sqrt(MASS / EA) * h) ** 2 / 12 * 1.2 + 1e-7
    assert found[0] == pytest.approx(pendulum(), rel=1e-6)
    assert found[0] == pytest.approx(np.sqrt(LIFT / (HEAVY * LENGTH * (1 + LIFT / EA))), rel=1e-3)


@pytest.mark.parametrize("dimensions", [2, 3])
def test_bending_of_the_shipped_scene_does_not_move_the_slow_modes(dimensions):
    """A straight line between hinges needs no moment, and the axial modes have no bending in them. Rounding: 2e-6. In
    space the buoy swings alike in both directions and bobs in one."""
    found = frequencies(equilibrium(line(STILL, {"motion.dimensions": dimensions}, nodes=21)), 1.0)
    expected = [pendulum()] * (dimensions - 1) + [axial(1, lambda k: box(k, 1.0))[0]]
    assert found[:dimensions] == pytest.approx(expected, rel=2e-6)
