"""Law: small heave of a floating sphere has omega^2 = (rho g A_wp + k)/(M + s M_a + m L/3).

A_wp = pi h (2R - h) is the water plane, s the wetted share of the volume, k = EA/L the spring of the line that ties it
down. At h = R and k = 0 that is rho g pi R^2/(M + M_a/2); M_a/2 is exact for quick heave there (the free surface is
then a plane of antisymmetry of the flow about the whole sphere).
"""

import math

import numpy as np
import pytest

from engine import simulate
from tests.engine.physics.caps import afloat, volume

SWINGS = 12


def heave_frequency(scene, expected):
    """Mean over the zero crossings of z about its mean, rad/s; steps of 0.01 s, an error of (omega dt)^4 and less."""
    run = simulate(scene, duration_s=(SWINGS + 1.5) * 2 * math.pi / expected)
    assert run.status == "ok"
    t, z = run.columns["time_s"], run.columns["z_m"] - 0.5 * (run.columns["z_m"].max() + run.columns["z_m"].min())
    up = np.flatnonzero((z[:-1] < 0) & (z[1:] >= 0))[: SWINGS + 1]
    crossings = t[up] - z[up] * (t[up + 1] - t[up]) / (z[up + 1] - z[up])
    assert len(crossings) == SWINGS + 1
    return 2 * math.pi * SWINGS / (crossings[-1] - crossings[0])


@pytest.mark.parametrize("share, stiffness_N", [(0.2, 40.0), (0.5, 0.01), (0.5, 5e4), (0.85, 40.0), (0.85, 5e4)])
def test_heave(share, stiffness_N):
    """Half in the water and without a line to speak of it is the sphere alone, M = M_displaced/2."""
    D, rho, g, L = 1.5, 1027.0, 9.81, 20.0
    h, whole = D * share, rho * volume(D, D)
    wet = rho * volume(h, D)
    pulled = 0.01 * stiffness_N if stiffness_N < 100 else 500.0
    scene = afloat(
        {"buoy.mass_kg": wet - pulled / g, "buoy.added_mass_kg": whole / 2, "tether.added_mass": 0.0,
         "water.depth_m": L * (1 + pulled / stiffness_N) + h - D / 2,
         "start.buoy_velocity_mps": [0.0, 0.0, 3e-3], "solver.step_s": 0.01, "solver.newton_tolerance": 1e-12},
        area_m2=1e-6, nodes=9, **{"tension.stiffness_N": stiffness_N},
    )  # fmt: skip
    plane, line_mass = math.pi * h * (D - h), rho * 1e-6 * L
    mass = scene.buoy.mass_kg + scene.buoy.added_mass_kg * wet / whole + line_mass / 3
    expected = math.sqrt((rho * g * plane + stiffness_N / L) / mass)
    assert heave_frequency(scene, expected) == pytest.approx(expected, rel=3e-5)
