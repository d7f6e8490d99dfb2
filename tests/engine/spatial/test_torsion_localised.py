"""Law: a long rod under tension T that is twisted past M^2 = 4 EI T and slackened buckles into one place. With
m = M/(2 sqrt(EI T)) its ends have come closer by D and are turned against each other by R,

    D = 4 sqrt(EI/T) sqrt(1 - m^2),   R = M L/GIp + 4 arccos m,   and it stands D/2 off its axis

(Coyne, IEEE J. Oceanic Eng. 15, 1990; van der Heijden & Thompson, Nonlinear Dynamics 21, 2000). From the first
integrals of Kirchhoff's equations, u = cos theta: M = EI psi_s sin^2 theta + M u, and the energy
(2T/EI) (1-u)^2 (1 + u - 2 m^2) = u_s^2; |M|^2 = M^2 + T^2 rho^2 for the distance rho from the axis.

Tolerance: D and R given, the box finds T, M and the deflection to order 2. The tails are cut at L/2, where they are
exp(-sqrt(T/EI) sqrt(1-m^2) L/2) of the whole: 5e-5 and less, and what is found is moved by the square of it.
"""

import numpy as np
import pytest

from tests.engine.lines import forces, positions
from tests.engine.spatial.rod_equations import Localised, kirchhoff
from tests.engine.spatial.rods import Rod, at_rest

EI, EA, LENGTH = 0.4, 1e5, 20.0


def found(buckle, nodes):
    """T, M and the deflection in the middle over those of the closed form."""
    rod = buckle.rod(LENGTH, EA)
    Y, h = at_rest(rod, nodes, lambda s: buckle.state(rod, s))
    N, x = forces(Y, EA), positions(Y, h)
    assert np.ptp(N, axis=0).max() < 1e-7
    deflection = np.hypot(*x[nodes // 2, 1:])
    return np.array(
        [np.linalg.norm(N[0]) / buckle.T, rod.GI * Y[0, 10] / buckle.torque, deflection / buckle.deflection]
    )


@pytest.mark.parametrize("GI", [0.3, 0.04])
@pytest.mark.parametrize("m", [0.9, 0.8, 0.6])
def test_the_localised_buckle(m, GI):
    """GIp = EI/10 is the paper's rope: it turns by 40 rad/m, which no node sees."""
    buckle = Localised(EI, GI, 2.0, m)
    coarse, middle, fine = (found(buckle, nodes) - 1 for nodes in (321, 641, 1281))
    assert np.log2((coarse - middle) / (middle - fine)) == pytest.approx(2, abs=0.1)
    assert fine + (fine - middle) / 3 == pytest.approx(0, abs=2e-4)
    assert np.all(np.abs(fine) < 2e-3)


def test_a_rod_between_clamps_that_are_not_in_line():
    """The buckle between clamps tilted by 0.04 rad, against the two-point problem: order 2.

    From 0.1 rad on there is a second equilibrium, straighter, and rounding chooses which one is found.
    """
    buckle = Localised(EI, 0.3, 2.0, 0.8)
    aligned = buckle.rod(10.0, EA)
    rod = Rod(EI, 0.3, EA, 10.0, aligned.place, aligned.twist, (1.0, 0.0, 0.0), (np.cos(0.04), np.sin(0.04), 0.0))
    answers = []
    for nodes in (161, 321, 641):
        Y, h = at_rest(rod, nodes, lambda s: buckle.state(aligned, s))
        answers.append(np.concatenate([forces(Y, EA)[0], [rod.GI * Y[0, 10]]]))
    _, N, O1 = kirchhoff(rod, Y, h)
    coarse, middle, fine = (np.abs(answer - [*N, rod.GI * O1]).max() for answer in answers)
    assert np.log2([coarse / middle, middle / fine]) == pytest.approx(2, abs=0.15)
    assert fine < 5e-3 * buckle.T
