"""Law: small free motions of a straight line between held ends are sines of wave number k = j pi/L, with

    axial       omega^2 = EA k^2/m
    transverse  (m + m_a) omega^2 = T k^2/(1+eps) + EI k^4/(1+eps)^4        (k per unstretched length)

from (3), (16) and (24) linearised about a uniform strain eps: m w_tt = N_s, N = T phi + S, w_s = (1+eps) phi,
EI phi_ss = -(1+eps)^3 S. Without strain it is the pinned beam under tension (Timoshenko, Vibration Problems in
Engineering), with EI = 0 the string, with T = 0 the pinned beam. In space every transverse frequency comes twice.

Tolerance: sines satisfy the box equations too, with (2/h) tan(kh/2) for k, so the spatial operator must give that
number to rounding: 2e-7 relative (central differences of 1e-5, eigenvalues of a matrix of some hundred rows); and the
closed form itself to the error of the box in k, (kh)^2/12, to the power in which k enters.

Under compression P = -T the line buckles: waves for which omega^2 < 0 grow, fastest that of k^2 = P/(2 EI), where the
rate is P (1+eps)/(2 sqrt(EI (m + m_a))) (Triantafyllou & Howell 1994). Quadratic drag does nothing to them.
"""

import numpy as np
import pytest

from tests.engine.lines import DRY, STILL, Motion, equilibrium, held, line, linear
from tests.engine.modes import box, distance, frequencies, rates

LENGTH, NODES, MASS, EA = 10.0, 21, 0.5, 1e4
H = LENGTH / (NODES - 1)
K = np.arange(1, 7) * np.pi / LENGTH
ALONG_X, LEANING, ASKEW = [1.0, 0.0, 0.0], [-0.8, 0.0, 0.6], [0.4, -0.7, 0.3]
WATERS = {"dry": 0.0, "wet": 2.5}  # coefficients of added mass


def taut(strain, EI, water="dry", direction=ALONG_X, dimensions=2, nodes=NODES):
    place = LENGTH * (1 + strain) * np.array(direction) / np.linalg.norm(direction)
    return line(
        DRY if water == "dry" else STILL, held(*place), {"gravity_mps2": 0.0, "motion.dimensions": dimensions},
        length_m=LENGTH, nodes=nodes, area_m2=5e-4, density_kgpm3=1000.0, bending_stiffness_Nm2=EI,
        added_mass=WATERS[water], tension=linear(EA),
    )  # fmt: skip


def square(k, strain, EI, mass=MASS):
    """omega^2 of transverse motion."""
    lam = 1 + strain
    return (EA * strain * k**2 / lam + EI * k**4 / lam**4) / mass


def transverse(k, strain, EI, mass=MASS):
    return np.sqrt(square(k, strain, EI, mass))


@pytest.mark.parametrize("strain, EI", [(0.3, 0.0), (0.0, 2.0), (0.02, 2.0), (0.3, 2.0)])
@pytest.mark.parametrize(
    "dimensions, direction, water",
    [
        (2, ALONG_X, "dry"),
        (2, LEANING, "wet"),
        (3, [0.0, 0.0, -1.0], "dry"),
        (3, ASKEW, "wet"),
    ],
)
def test_a_line_vibrates_as_a_tensioned_pinned_beam(strain, EI, dimensions, direction, water):
    """In whatever direction it lies; added mass slows transverse motion and leaves axial motion alone."""
    mass = MASS + WATERS[water] * 1027.0 * 5e-4
    modes = frequencies(equilibrium(taut(strain, EI, water, direction, dimensions)), 10.0)
    assert distance(modes, transverse(box(K, H), strain, EI, mass), dimensions - 1) < 2e-7
    assert distance(modes, np.sqrt(EA / MASS) * box(K, H)) < 2e-7
    power = 2 if EI and strain == 0 else 1
    assert distance(modes[:1], transverse(K[:1], strain, EI, mass)) < power * (K[0] * H) ** 2 / 12 * 1.1


def test_the_frequencies_come_in_no_other_place():
    modes = frequencies(equilibrium(taut(0.02, 2.0)), 10.0)
    every = box(np.arange(1, NODES - 1) * np.pi / LENGTH, H)
    both = np.concatenate([transverse(every, 0.02, 2.0), np.sqrt(EA / MASS) * every])
    slow = modes[modes < 200]
    assert slow.size == np.count_nonzero(both < 200)
    assert distance(both, slow) < 1e-7


@pytest.mark.parametrize("water", ["dry", "wet"])
def test_a_compressed_line_buckles(water):
    EI, nodes, fastest = 2.0, 101, 5
    strain = -2 * EI * (fastest * np.pi / LENGTH) ** 2 / EA
    motion = Motion(taut(0.0, EI, water, nodes=nodes))
    motion.Y[:] = 0.0
    motion.Y[:, 0] = strain
    modes, mass = rates(motion, 10.0), MASS + WATERS[water] * 1027.0 * 5e-4
    growing = np.sort(modes.real[(modes.real > 1e-4) & (np.abs(modes.imag) < 1e-6)])
    squares = -square(box(np.arange(1, nodes - 1) * np.pi / LENGTH, LENGTH / (nodes - 1)), strain, EI, mass)
    assert growing == pytest.approx(np.sort(np.sqrt(squares[squares > 0])), rel=1e-7)
    assert growing.size == int(np.floor(np.sqrt(2) * fastest))  # P k^2 > EI k^4
    fastest_rate = -strain * EA * (1 + strain) / (2 * np.sqrt(EI * mass))
    assert growing[-1] == pytest.approx(fastest_rate, rel=1e-4)  # flat top: second order in (kh)^2
