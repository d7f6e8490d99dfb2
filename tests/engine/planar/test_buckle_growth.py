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


@pytest.mark.parametrize("water", WATERS)
@pytest.mark.parametrize("mode", [2, FASTEST])
def test_a_sinusoidal_disturbance_grows_at_that_rate(water, mode):
    """From 1e-9 rad, six e-foldings with the growing eigenvector: no decaying part, no noise of note. Drag at speeds of
    1e-7 m/s is 1e-7 of inertia. Step: 1/50 of a growth time, fourth order."""
    water, mass = WATERS[water]
    k = box(mode * np.pi / LENGTH, H)
    sigma = growth(np.array([k]), mass)[0]
    scene = compressed(
        water, **{"solver.step_s": 0.02 / sigma, "solver.newton_tolerance": 1e-13, "output.step_s": 0.5 / sigma}
    )
    lam, duration = 1 + STRAIN, 6 / sigma
    motion = Motion(scene)
    s, size = motion.s, 1e-9
    start = straight(motion)
    phase = mode * np.pi / LENGTH * s
    start[:, 4] = size * np.cos(phase)
    start[:, 5] = -size * k * np.sin(phase)
    start[:, 1] = size * EI * k**2 * np.cos(phase) / lam**3
    start[:, 3] = sigma * size * lam / k * np.sin(phase)  # w_s = (1 + eps) phi
    motion = Motion(scene, duration, start)
    motion.inner.state["status"] = 0  # the bent static shape between the ends is not where this run starts
    history = [(t, Y[0, 4]) for t, Y in motion.states()]
    assert int(motion.inner.state["status"]) == 0
    time, tilt = np.array(history[2:]).T
    assert np.polyfit(time, np.log(tilt / size), 1)[0] == pytest.approx(sigma, rel=1e-4)
