"""Law: on a straight line without mass the sphere in the waves is a pendulum on a spring, four ordinary differential
equations, whose solution the run has: fields, cap, statics and time stepping together, through the air and under water.
"""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from engine import simulate
from tests.engine.physics.airy import direct
from tests.engine.physics.caps import Wave, afloat, condition, volume

DEPTH, LENGTH, EA, DURATION_S = 21.0, 10.0, 3636.0, 8.0
THROWN = [0.5, 0.0, 6.0]


def scene_of(rtol, **waves):
    given = {"period_s": 5.0, "steepness": 0.16} | waves
    return afloat(
        {"water.depth_m": DEPTH, "waves": given, "buoy.mass_kg": 500.0, "buoy.drag": 0.2, "buoy.impact_loss": 0.3,
         "tether.added_mass": 0.0, "start.buoy_velocity_mps": THROWN, "solver.rtol": rtol},
        depth_m=DEPTH, length_m=LENGTH, area_m2=1e-9, density_kgpm3=1000.0, bending_stiffness_Nm2=1e-6,
        **{"tension.stiffness_N": EA},
    )  # fmt: skip


def airy(scene, place, t):
    """Water velocity and acceleration (3,) of a wave along x, written from its formulas."""
    wave, above, (x, _, z) = Wave(scene), scene.waves.above_still_water, place
    if above == "zero" and z > DEPTH:
        return np.zeros(3), np.zeros(3)
    if above == "wheeler":
        z *= DEPTH / (DEPTH + wave.elevation(place, t))
    F = direct(wave.k, wave.A, DEPTH, t, [[x, z]], phase=wave.phase)[0].astype(float)
    return np.insert(F[:2], 1, 0.0), np.insert(F[2:], 1, 0.0)


def ode(scene):
    """Places (., 3) of the sphere at the samples of the run."""
    buoy, rho, g = scene.buoy, scene.water.density_kgpm3, scene.gravity_mps2
    D = buoy.diameter_m

    def rate(t, state):
        place, V = state[:3], state[3:]
        pull = EA * (math.sqrt(place @ place) / LENGTH - 1) * place / math.sqrt(place @ place)
        e = condition(scene, t, place, V, np.zeros(3), pull, *airy(scene, place, t))
        h = DEPTH + Wave(scene).elevation(place, t) - place[2] + D / 2
        return np.concatenate([V, -e / (buoy.mass_kg + buoy.added_mass_kg * volume(h, D) / volume(D, D))])

    def left(z):
        return (rho * volume(DEPTH - z + D / 2, D) - buoy.mass_kg) * g - EA * (z / LENGTH - 1)

    start = [0.0, 0.0, brentq(left, LENGTH, DEPTH + D / 2, xtol=1e-13), *THROWN]
    times = np.linspace(0.0, DURATION_S, round(DURATION_S / scene.sample_step_s()) + 1)
    return solve_ivp(rate, (0.0, DURATION_S), start, "DOP853", times, rtol=1e-8, atol=1e-9, max_step=0.05).y[:3].T


@pytest.mark.slow
@pytest.mark.parametrize(
    "above, rtol, error_m", [("extrapolate", 1e-5, 4e-3), ("wheeler", 1e-5, 4e-3), ("zero", 1e-4, 6e-2)]
)
def test_the_run_is_the_solution_of_the_ode(above, rtol, error_m):
    """Over eight seconds of leaps. The water of "zero" jumps at still water: a tighter tolerance takes 60000 steps."""
    scene = scene_of(rtol, above_still_water=above)
    run = simulate(scene, duration_s=DURATION_S)
    exact = ode(scene)
    assert run.status == "ok" and exact[:, 2].max() > DEPTH + 2.0 and exact[:, 2].min() < DEPTH - 1.5
    places = run.table()[["x_m", "y_m", "z_m"]].to_numpy()
    assert np.abs(places - exact).max() < error_m
