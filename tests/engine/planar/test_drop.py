"""Law: a line that hangs from its anchor unstretched and is let go under its own weight (dry, linear law) is a bar:

    m u_tt = EA u_ss + m g,   u = 0 above, no tension below.   With tau = c t/L, c^2 = EA/m, u_0 = g L^2/(2 c^2):
    u(L, t) = u_0 tau^2 for tau < 1,   2 u_0 - u_0 (2 - tau)^2 for 1 < tau < 3,   u_0 (4 - tau)^2 to tau = 4, and again

(d'Alembert): the end falls freely until the front from the anchor meets it, comes to rest at twice the static stretch
u_0 and returns. Momentum: m int V ds changes by the weight less the force of the anchor.

Tolerance: the strain has corners, which second-order differences smear over some elements: the error of the stretch
falls with the element, 0.5 h/L of the static stretch in the first two periods; momentum is exact in the box, so over a
backward Euler step it balances to the tolerance of Newton's method.
"""

from itertools import pairwise

import numpy as np
import pytest

from tests.engine.lines import DRY, Motion, energy, equilibrium, free, line, linear, mean, positions

LENGTH, MASS, EA, G = 10.0, 0.5, 2e3, 9.81
C = np.sqrt(EA / MASS)
STATIC = G * LENGTH**2 / (2 * C**2)


def drop(nodes, **changes):
    """A line that hangs straight down, without strain, at rest."""
    scene = line(
        DRY, free(), {"solver.rtol": 1e-4, "solver.newton_tolerance": 1e-8, "output.step_s": LENGTH / C / 10}, changes,
        length_m=LENGTH, area_m2=5e-4, density_kgpm3=1000.0, nodes=nodes, bending_stiffness_Nm2=0.1, tension=linear(EA),
    )  # fmt: skip
    Y = np.zeros_like(equilibrium(scene).Y)
    Y[:, 4] = -np.pi / 2
    return scene, Motion(scene, 8 * LENGTH / C, Y)


def stretch(t):
    tau = np.mod(C * t / LENGTH, 4)
    return STATIC * np.where(tau < 1, tau**2, np.where(tau < 3, 2 - (2 - tau) ** 2, (4 - tau) ** 2))


@pytest.mark.parametrize("nodes", [41, 161])
def test_the_end_falls_to_twice_the_static_stretch(nodes):
    _, motion = drop(nodes)
    table = motion.run().table()
    t, z = table.time_s.to_numpy(), table.z_m.to_numpy()
    assert np.max(np.abs(-z - LENGTH - stretch(t))) < 0.5 * STATIC / (nodes - 1)
    assert (-z - LENGTH).max() == pytest.approx(2 * STATIC, rel=0.01)
    assert np.max(np.abs(table.x_m)) < 1e-9


def test_the_work_of_gravity_is_the_other_energy():
    """At every step: fall times weight = kinetic + stretching energy, within the damping of the corners (1 %)."""
    scene, motion = drop(161)
    balance = np.array([energy(scene, Y, motion.h) for _, Y in motion.states()])
    fallen = balance[0, 1] - balance[:, 1]
    gained = balance[:, 0] + balance[:, 2]
    assert fallen.max() == pytest.approx(MASS * G * LENGTH * 2 * STATIC * 2 / 3, rel=0.01)  # u = 2 u_static everywhere
    assert np.max(np.abs(gained - fallen)) < 0.01 * fallen.max()
    assert np.all(gained < fallen + 1e-3 * fallen.max())


@pytest.mark.parametrize("swing", [0.0, 3.0])
def test_momentum_changes_by_weight_and_anchor_force(swing):
    """Straight down, and swinging about the anchor. Velocities are some m/s known to 1e-8 of their scale, over a step
    of 1 ms."""
    step = 1e-3
    scene, motion = drop(41, **{"solver.integrator": "backward-euler", "solver.step_s": step, "output.step_s": step})
    start = motion.Y.copy()
    start[:, 2] = -swing * positions(start, motion.h)[:, 1]
    motion = Motion(scene, 0.3, start)
    history = list(motion.states())[5:]
    weight = MASS * G * LENGTH
    for (t0, before), (t1, after) in pairwise(history):
        momentum = [MASS * np.sum(motion.h[:, None] * mean(Y[:, 2:4]), axis=0) for Y in (before, after)]
        eps, S, phi = after[0, 0], after[0, 1], after[0, 4]
        anchor = EA * eps * np.array([np.cos(phi), np.sin(phi)]) + S * np.array([-np.sin(phi), np.cos(phi)])
        rate = (momentum[1] - momentum[0]) / (t1 - t0)
        assert rate == pytest.approx(np.array([0.0, -weight]) - anchor, abs=1e-4)
