"""Law: steady rotation about an axis, and what a pendulum that swings in all directions keeps.

Conical pendulum, a heavy bob on a light elastic line, dry: at the angle a from the vertical T = M g/cos a, length l = L
(1 + T/EA), omega^2 = g/(l cos a). Spherical pendulum: M X_tt = -T(|X|) X/|X| - M g z, by scipy, with its energy and its
angular momentum about the vertical. The line's own mass m L/M = 1e-5 and weight move both by shares of 1e-5.
"""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.engine.lines import DRY, Motion, in_space, linear, positions
from tests.engine.rotations import parameters_of_frames

G, L, M, EA = 9.81, 5.0, 100.0, 2e4
STEPS = {"solver.rtol": 1e-5, "output.step_s": 0.05}
ACROSS = [0.0, 1.0, 0.0]


@pytest.mark.parametrize("angle, speed", [(0.8, 2.0), (1.0, None)], ids=["spherical", "conical"])
def test_a_pendulum_keeps_energy_and_angular_momentum(angle, speed):
    """A heavy bob on 11 nodes of a light line in the plane x-z, `angle` from below the anchor, thrown along y; at the
    speed omega l sin a it is a conical pendulum."""
    scene = in_space(
        DRY, STEPS, {"buoy.mass_kg": M}, length_m=L, nodes=11, area_m2=1e-6, density_kgpm3=200.0,
        bending_stiffness_Nm2=0.0, tension=linear(EA),
    )  # fmt: skip
    strain = M * G / np.cos(angle) / EA
    length = L * (1 + strain)
    radius, height = length * np.sin(angle), -length * np.cos(angle)
    thrown = speed or radius * np.sqrt(-G / height)
    Y = np.zeros((11, 13))
    Y[:, 0], Y[:, 4] = strain, thrown * np.linspace(0, 1, 11)
    Y[:, 6:10] = parameters_of_frames(*np.tile([[[np.sin(angle), 0.0, -np.cos(angle)]], [ACROSS]], (1, 11, 1)))
    motion = Motion(scene, 15.0, Y)
    t, X, V = zip(*((t, positions(Y, motion.h)[-1], Y[-1, 3:6].copy()) for t, Y in motion.states()), strict=True)
    t, X, V = np.array(t), np.array(X).T, np.array(V).T

    def pull(s, y):
        r = np.linalg.norm(y[:3])
        return [*y[3:], *(-EA * (r / L - 1) * y[:3] / r / M - [0, 0, G])]

    start = [radius, 0.0, height, 0.0, thrown, 0.0]
    exact = solve_ivp(pull, (0, t[-1]), start, t_eval=t, rtol=1e-11, atol=1e-11, method="DOP853").y[:3]
    assert (np.ptp(np.hypot(X[0], X[1])) > 1.0) == (speed is not None)
    assert np.abs(X - exact).max() < 1e-3 * max(1.0, radius)
    r = np.linalg.norm(X, axis=0)
    energy = 0.5 * M * np.sum(V**2, 0) + M * G * X[2] + 0.5 * EA * (r - L) ** 2 / L
    spin = X[0] * V[1] - X[1] * V[0]
    assert np.ptp(energy) < 1e-4 * 0.5 * M * thrown**2
    assert np.ptp(spin) < 1e-4 * spin[0]
