"""Law: a lateral perturbation of a buoy at rest is a pendulum, and nothing damps it.

Tether of constant tension (weightless in water, or so light in air that it does not matter), mass m + m_a per length:
k L tan k L = (m + m_a) L/(M + M_a) with k^2 = omega^2 (m + m_a)(1 + eps)/T; the light one in air is the mathematical
pendulum, omega^2 = g/((1 + eps) L). The mode is straight to (kL)^2/6 < 1e-3, so the grid and the bending stiffness move
it by 1e-6 and less. Frequencies come from the eigenvalues of one stage, as in `modes`; growth from a run. At rest drag
is of second order, so there is no damping in water either.
"""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from engine import simulate
from tests.engine.kernels import Stage
from tests.engine.lines import DRY, STILL, equilibrium, line, linear
from tests.engine.modes import eigenvalues_of

LENGTH, AREA, EA = 20.0, 7.85e-5, 5e4
AFLOAT = line(STILL, {"tether.density_kgpm3": 1027.0})
LIGHT = DRY | {"tether.density_kgpm3": 1e-2, "tether.tension": linear(1e5)}
HANGING = line(LIGHT)


def eigenvalues(scene, rate):
    """lambda (1/s) of small lateral motions about rest, slowest first: a stage makes c (c - A)^-1 of its C~."""
    Y, stage = equilibrium(scene).Y, Stage(scene)
    n, F = len(Y), stage.water(0.0, Y)

    def response(dC_tilde):
        return stage.lateral(rate, Y, np.zeros((n, 4)), F, dC_tilde)

    return eigenvalues_of(np.array([response(unit.reshape(n, 2)).ravel() for unit in np.eye(2 * n)]).T, rate)


def afloat():
    mass, heavy = (1027.0 + 1027.0) * AREA, 1611.0 + 907.0
    T = (1027.0 * math.pi * 1.5**3 / 6 - 1611.0) * 9.81
    kL = brentq(lambda x: x * math.tan(x) - mass * LENGTH / heavy, 1e-3, 1.0, xtol=1e-15)
    return kL / LENGTH * math.sqrt(T / (mass * (1 + T / EA)))


def hanging():
    return math.sqrt(9.81 / (LENGTH * (1 + 1611.0 * 9.81 / 1e5)))


@pytest.mark.parametrize("scene, omega", [(AFLOAT, afloat()), (HANGING, hanging())], ids=["afloat", "hanging in air"])
def test_frequency_and_no_growth(scene, omega):
    slowest = eigenvalues(scene, 1.0)[:2]
    assert np.sort(slowest.imag) == pytest.approx([-omega, omega], rel=3e-6)
    assert np.abs(slowest.real).max() < 1e-7 * omega


def test_a_dry_pendulum_neither_grows_nor_decays():
    """Its energy is the square of the length of the perturbation, so it keeps that to what the integrator takes.

    The first 100 s rid the perturbation of its fast modes, which the integrator damps; of the pendulum ESDIRK4(3) with
    steps of 0.1 s takes (omega dt)^4 times less than a tenth a second, 1e-6. The light tether has another energy than
    the weights say, T being not quite the scale: 1e-4.
    """
    run = simulate(line(LIGHT, {"output.lateral_growth": True}), duration_s=400.0)
    assert run.status == "ok"
    assert run.tangent.growth_nats.shape == (400, 0) and run.tangent.period_s == 1.0
    later = run.tangent.lateral_nats[100:]
    assert np.abs(later).max() < 1e-4
    assert abs(later.mean()) < 1e-6
