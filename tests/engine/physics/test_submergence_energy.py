"""Law: in still water without drag a sphere that goes in and out of it keeps its energy,

    (M + s M_a) |V|^2/2 + M g z + rho g int V_wet dh + the stretching of its line,

but for what an impact is told to lose: loss M_a s' h_t^3/2 a second while it enters. A sphere that floats half in the
water is thrown up so that it leaves the water by two diameters, falls back, goes under by three, and so on; the line,
twice its length, is so soft that it ties the sphere down with 100 N and is never slack. The forces have kinks at both
ends of a passage, so the error falls with the tolerance by less than the order of the method.
"""

from functools import cache

import numpy as np
import pytest

from tests.engine.lines import Motion, mean, positions
from tests.engine.physics.caps import afloat, potential, volume

THROWN = {"up": [0.0, 0.0, 7.0], "aslant": [2.5, 0.0, 7.0]}
DURATION_S = 12.0


@cache
def history(thrown, loss=0.0, output_s=0.02, **solver):
    """Times (s), energy over its kinetic part at the start less one at the start, h (m), and V (., 2) of the sphere."""
    scene = afloat(
        {"start.buoy_velocity_mps": THROWN[thrown], "output.step_s": output_s, "tether.added_mass": 0.0,
         "water.depth_m": 40.0, "buoy.mass_kg": 900.0, "buoy.impact_loss": loss,
         **{f"solver.{key}": value for key, value in solver.items()}},
        area_m2=1e-6, **{"tension.stiffness_N": 100.0},
    )  # fmt: skip
    motion, buoy, D = Motion(scene, DURATION_S), scene.buoy, scene.buoy.diameter_m
    assert motion.status == 0
    rows = []
    for t, Y in motion.states():
        z = positions(Y, motion.h)[-1, 1]
        h = scene.water.depth_m - z + D / 2
        mass = buoy.mass_kg + buoy.added_mass_kg * volume(h, D) / volume(D, D)
        stretching = 0.5 * scene.tether.tension.stiffness_N * np.sum(motion.h * mean(Y[:, 0] ** 2))
        kinetic = 0.5 * mass * np.sum(Y[-1, 2:4] ** 2)
        rows.append([t, kinetic, potential(scene, z), stretching, h, *Y[-1, 2:4]])
    assert int(motion.inner.state["status"]) == 0
    t, *energies, h, u, w = np.array(rows).T
    total = np.sum(energies, axis=0)
    return scene, t, (total - total[0]) / energies[0][0], h, np.column_stack([u, w])


def passages(h):
    """How often the centre goes through the surface."""
    return int(np.sum((h[1:] - 0.75) * (h[:-1] - 0.75) < 0))


@pytest.mark.parametrize("thrown", THROWN)
def test_energy_is_kept_to_the_tolerance(thrown):
    drifts = []
    for rtol in (3e-3, 3e-4, 3e-5):
        _, _, change, h, _ = history(thrown, rtol=rtol, newton_tolerance=3e-4 * rtol)
        assert passages(h) >= 6 and h.min() < -3.0 and h.max() > 4.5
        drifts.append(np.abs(change).max())
    assert drifts[0] < 2e-2 and drifts[1] < 2e-3 and drifts[2] < 2e-4
    assert drifts[2] < drifts[0] / 50


def test_an_impact_loses_what_it_is_told_to():
    """All of von Karman's loss, and nothing on the way out, in the air or under water."""
    scene, t, change, h, V = history("up", loss=1.0, output_s=0.002, rtol=1e-5, newton_tolerance=1e-9)
    D = scene.buoy.diameter_m
    inside = np.clip(h / D, 0.0, 1.0)
    entering = np.maximum(-V[:, 1], 0.0)
    slope = scene.buoy.added_mass_kg * 6 * inside * (1 - inside) / D
    power = 0.5 * slope * entering**3
    start = scene.buoy.mass_kg + scene.buoy.added_mass_kg * (inside[0] ** 2 * (3 - 2 * inside[0]))
    lost = np.concatenate([[0.0], np.cumsum(0.5 * np.diff(t) * (power[1:] + power[:-1]))]) / (0.5 * start * 49.0)
    assert lost[-1] > 0.3
    assert np.abs(change + lost).max() < 2e-3
