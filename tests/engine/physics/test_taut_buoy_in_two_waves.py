"""Law: a sphere without drag on a taut, nearly massless line answers two waves of less than a millimetre linearly.

m x'' = -(P/z) x + (rho V + M_a) dU/dt, so that x is Duhamel's integral of the load, here by quadrature: from rest,
start of the waves included. P is the pull of the line, z the height of the sphere above its anchor; m has a third of
the line's mass and added mass (Rayleigh).
"""

import numpy as np
import pytest
from scipy.integrate import quad

from engine import simulate
from engine.physics.sea import rows_of
from tests.engine.lines import line

WAVES = [
    {"period_s": 6.0, "amplitude_m": 0.0004, "phase_rad": 0.3},
    {"period_s": 4.3, "amplitude_m": 0.0003, "phase_rad": 2.0},
]


def test_surge_is_duhamels_integral():
    keys = {"waves.components": WAVES, "waves.steepness": None, "water.depth_m": 25.0, "tether.nodes": 11}
    keys |= {"tether.tension": {"law": "linear", "stiffness_N": 1.0e6}, "solver.max_step_s": 0.05}
    keys |= {"tether.drag_normal": 0.0, "tether.drag_tangential": 0.0, "buoy.drag": 0.0, "buoy.submergence": "full"}
    scene = line(keys)
    run = simulate(scene, duration_s=40.0)
    buoy, height = scene.buoy, run["z_m"][0]
    displaced = scene.water.density_kgpm3 * np.pi * buoy.diameter_m**3 / 6.0
    tether, density = scene.tether, scene.water.density_kgpm3
    own_mass = tether.density_kgpm3 * tether.area_m2 + tether.added_mass * density * np.pi * tether.diameter_m**2 / 4.0
    moved = buoy.mass_kg + buoy.added_mass_kg + own_mass * tether.length_m / 3.0
    driven = displaced + buoy.added_mass_kg
    own = np.sqrt((displaced - buoy.mass_kg) * scene.gravity_mps2 / height / moved)
    k, omega, phase, *_, amplitude = rows_of(scene).T
    acceleration = amplitude * omega**2 * np.cosh(k * height) / np.sinh(k * scene.water.depth_m)

    def share(s, t):
        load = driven * np.sum(acceleration * np.sin(phase - omega * s))
        return np.sin(own * (t - s)) / (moved * own) * load

    at = np.arange(40, len(run["time_s"]), 40)
    exact = [quad(share, 0.0, t, args=(t,), epsabs=1e-10, limit=200)[0] for t in run["time_s"][at]]
    assert np.ptp(exact) > 0.001
    assert run["x_m"][at] == pytest.approx(exact, abs=2e-3 * np.max(np.abs(exact)))
