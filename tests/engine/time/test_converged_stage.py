"""A stage that Newton calls converged satisfies the box equations, with the water where the nodes have come to lie.

Airy kinematics and the positions are computed here, from their formulas.
"""

import numpy as np
import pytest
from scipy.optimize import brentq

from engine import load_scene
from engine.parameters import record_of
from engine.planar.elimination import WIDTH as SWEEP_WIDTH
from engine.planar.node import WIDTH
from engine.time.newton import newton
from engine.time.status import OK
from tests.engine.box_equations import elements, residual

T0 = 3.7  # s, any time


def airy(scene, t, X):
    """(n, 4): velocity and local acceleration of linear waves at positions X (n, 2)."""
    H, wave = scene.water.depth_m, scene.waves
    om = 2 * np.pi / wave.period_s
    k = brentq(lambda k: scene.gravity_mps2 * k * np.tanh(k * H) - om**2, 1e-6, 10, xtol=1e-15)
    A = wave.steepness / k
    psi = k * X[:, 0] * np.cos(wave.direction_rad) - om * t + wave.phase_rad
    horizontal = A * om * np.cosh(k * X[:, 1]) / np.sinh(k * H) * np.cos(wave.direction_rad)
    vertical = A * om * np.sinh(k * X[:, 1]) / np.sinh(k * H)
    velocity = horizontal * np.cos(psi), vertical * np.sin(psi)
    acceleration = om * horizontal * np.sin(psi), -om * vertical * np.cos(psi)
    return np.stack([*velocity, *acceleration], axis=1)


def positions(scene, Y):
    q = (1 + Y[:, :1]) * np.stack([np.cos(Y[:, 4]), np.sin(Y[:, 4])], 1)
    h = elements(scene)[:, None]
    return np.concatenate([[[0, 0]], np.cumsum(h * (q[1:] + q[:-1]) / 2, 0)])


@pytest.mark.parametrize("EI", [0.4, 0.0])
@pytest.mark.parametrize("direction", [0.0, np.pi])
@pytest.mark.parametrize("nodes, stretching", [(11, 0.0), (41, 2.0)])
def test_a_converged_stage_satisfies_the_box_equations(nodes, stretching, direction, EI):
    current = np.array([0.3, 0.1])
    scene = load_scene(
        "tethered_buoy",
        {
            "tether.nodes": nodes,
            "tether.grid_stretching": stretching,
            "tether.bending_stiffness_Nm2": EI,
            "waves.direction_rad": direction,
            "waves.phase_rad": 0.4,
            "current": {"law": "uniform", "velocity_mps": [current[0], 0.0, current[1]]},
        },
    )
    tables = []
    p = record_of(scene, tables)[0]
    tables = np.concatenate(tables)
    n, rate, tolerance = nodes, 300.0, 1e-9
    s = np.linspace(0, 1, n)
    Y = np.zeros((n, 6))
    Y[:, 0], Y[:, 4] = 0.03, 1.45 + 0.1 * s**2  # taut, leaning, at rest, in waves of full height
    lam = 1 + Y[:, 0]
    C_tilde = np.stack([lam * np.cos(Y[:, 4]), lam * np.sin(Y[:, 4]), 0 * s, 0 * s], 1)
    work = [np.zeros((n, width)) for width in (2, 4, WIDTH, SWEEP_WIDTH, 6)]
    code, _ = newton(p, tables, T0, 1.0, rate, rate, tolerance, 30, Y, C_tilde, *work)
    assert code == OK
    F = airy(scene, T0, positions(scene, Y))
    F[:, :2] += current
    left = residual(scene, rate, rate, 1.0, Y, C_tilde, F)
    # forces in newtons, velocities in m/s: 1e-6 of the loads (2000 N) and speeds (1 m/s) of the scene at hand
    size = np.concatenate([np.ones(2 * n), np.full(2 * n, 2000.0), np.ones(2 * n if EI else 0)])
    assert np.abs(left / size).max() < 1e-6
