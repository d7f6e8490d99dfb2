"""Law: a straight line under compression P buckles; a disturbance of wave number k grows as exp(sigma t) with

    sigma^2 = (P k^2/(1+eps) - EI k^4/(1+eps)^4)/(m + m_a),

fastest at k^2 = P/(2 EI), where sigma = P/(2 sqrt(EI (m + m_a))) for small eps (Triantafyllou & Howell 1994).
Wet, the normal drag is quadratic in the velocity and does nothing to infinitesimal motion.

Tolerance: as for the modes of a taut line, of which this is the other sign: exact with (2/h) tan(kh/2) for k, 1e-7.
"""

import numpy as np
import pytest

from tests.engine.lines import DRY, STILL, Motion, held, line, linear
from tests.engine.modes import box, rates

LENGTH, NODES, MASS, EA, EI = 10.0, 101, 0.5, 1e6, 2.0
H = LENGTH / (NODES - 1)
FASTEST = 5  # the mode with k^2 = P/(2 EI)
P = 2 * EI * (FASTEST * np.pi / LENGTH) ** 2
STRAIN = -P / EA
WATERS = {"dry": (DRY, MASS), "wet": (STILL, MASS + 1027.0 * 5e-4)}


def compressed(water, **changes):
    return line(
        water, held(LENGTH, 0), {"gravity_mps2": 0.0}, changes, length_m=LENGTH, nodes=NODES, area_m2=5e-4,
        density_kgpm3=1000.0, bending_stiffness_Nm2=EI, tension=linear(EA),
    )  # fmt: skip


def straight(motion):
    Y = np.zeros_like(motion.Y)
    Y[:, 0] = STRAIN
    return Y


def growth(k, mass):
    squares = (P * k**2 / (1 + STRAIN) - EI * k**4 / (1 + STRAIN) ** 4) / mass
    return np.sqrt(squares[squares > 0])


@pytest.mark.parametrize("water", WATERS)
def test_growth_rates(water):
    water, mass = WATERS[water]
    motion = Motion(compressed(water))
    motion.Y[:] = straight(motion)
    found = rates(motion, 10.0)
    growing = np.sort(found.real[(found.real > 1e-4) & (np.abs(found.imag) < 1e-6)])
    modes = np.arange(1, NODES - 1)
    expected = np.sort(growth(box(modes * np.pi / LENGTH, H), mass))
    assert growing == pytest.approx(expected, rel=1e-7)
    assert growing.size == int(np.floor(np.sqrt(2) * FASTEST))  # P k^2 > EI k^4
    assert growing[-1] == pytest.approx(P / (2 * np.sqrt(EI * mass)), rel=1e-4)  # flat top: second order in (kh)^2
