"""Law: on a straight line without mass the sphere in the waves is a pendulum on a spring, four ordinary differential
equations, whose solution the run has: fields, cap, statics and time stepping together, through the air and under water.
In still water without drag it keeps its energy,

    (M + s M_a) |V|^2/2 + M g z + rho g int V_wet dh + the stretching of its line.
"""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from engine import simulate
from tests.engine.lines import Motion, mean, positions
from tests.engine.physics.airy import direct
from tests.engine.physics.caps import Wave, afloat, condition, potential, volume

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


def drift(rtol):
    """Largest change of the energy over its kinetic part at the start, and h (m), of a sphere that floats half in the
    water, is thrown up so that it leaves it by two diameters, falls back, goes under by three, and so on; the line,
    twice its length, is so soft that it ties the sphere down with 100 N and is never slack."""
    scene = afloat(
        {"start.buoy_velocity_mps": [2.5, 0.0, 7.0], "output.step_s": 0.02, "tether.added_mass": 0.0,
         "water.depth_m": 40.0, "buoy.mass_kg": 900.0, "solver.rtol": rtol, "solver.newton_tolerance": 3e-4 * rtol},
        area_m2=1e-6, **{"tension.stiffness_N": 100.0},
    )  # fmt: skip
    motion, buoy, D = Motion(scene, 12.0), scene.buoy, scene.buoy.diameter_m
    rows = []
    for _, Y in motion.states():
        z = positions(Y, motion.h)[-1, 1]
        h = scene.water.depth_m - z + D / 2
        mass = buoy.mass_kg + buoy.added_mass_kg * volume(h, D) / volume(D, D)
        stretching = 0.5 * scene.tether.tension.stiffness_N * np.sum(motion.h * mean(Y[:, 0] ** 2))
        kinetic = 0.5 * mass * np.sum(Y[-1, 2:4] ** 2)
        rows.append([kinetic, potential(scene, z), stretching, h])
    assert motion.time_s >= 12.0
    *energies, h = np.array(rows).T
    total = np.sum(energies, axis=0)
    return np.abs(total - total[0]).max() / energies[0][0], h


def test_energy_is_kept_to_the_tolerance():
    """The forces have kinks at both ends of a passage: the error falls by less than the order of the method."""
    drifts = []
    for rtol in (3e-3, 3e-4, 3e-5):
        change, h = drift(rtol)
        assert np.sum((h[1:] - 0.75) * (h[:-1] - 0.75) < 0) >= 6 and h.min() < -3.0 and h.max() > 4.5
        drifts.append(change)
    assert drifts[0] < 2e-2 and drifts[1] < 2e-3 and drifts[2] < 2e-4
    assert drifts[2] < drifts[0] / 50
