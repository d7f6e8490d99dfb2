"""Held, moved, released and free ends: in their place, and on the way of the conservation form at order 2."""

import numpy as np
import pytest

from engine import simulate
from tests.engine.lines import held, line, linear

pytestmark = pytest.mark.slow

AIR = {"water": None, "waves": None, "tether.bending_stiffness_Nm2": 24.0}
SOFT = {"tether.tension": linear(500.0)}
SHAKEN = {"law": "harmonic", "amplitude_m": [0.8, 0.0, -0.6], "period_s": 1.5, "phase_rad": 0.3, "ramp_s": 1.0}
MOVED = {  # from rest: the slope of the first piece is zero
    "law": "table",
    "time_s": [0.0, 0.1, 1.3, 3.0],
    "displacement_m": [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.6, 0.0, -0.5], [0.6, 0.0, -0.5]],
}


def run_of(scheme, nodes, step_s, overrides, duration_s=1.0):
    solver = {"solver.scheme": scheme, "solver.step_s": step_s}
    if scheme == "conservation":
        solver = {"solver.rtol": 1e-5}
    output = {"tether.nodes": nodes, "output.profiles": True, "output.step_s": 0.1}
    scene = line(AIR, solver, output, overrides)
    found = simulate(scene, duration_s=duration_s)
    assert found.status == "ok", found.message
    return found


def places(found):
    """Nodes (3, samples, n), m."""
    return np.stack([getattr(found.profiles, f"{axis}_m") for axis in "xyz"])


@pytest.mark.parametrize("motion", [SHAKEN, MOVED], ids=["shaken", "moved by a table"])
def test_a_moved_end_shakes_the_line_as_in_the_conservation_form(motion):
    moved = SOFT | held(12.0, 18.0, motion=motion)
    limit = places(run_of("conservation", 81, None, moved))
    assert np.ptp(limit[0][:, 40]) > 0.05  # its middle moves
    errors = []
    for nodes, step_s in ((6, 0.02), (11, 0.01), (21, 0.005)):
        found = places(run_of("paper-box", nodes, step_s, moved))
        errors.append(np.abs(found - limit[:, :, :: 80 // (nodes - 1)]).max())
    assert errors[-1] < 0.015
    assert errors[0] / errors[2] > 8, errors  # 16 at order 2, on grids fine enough for the bends at the ends


def test_a_released_end_falls_freely():
    """Let go under its own support force nothing happens; without force the line falls, free of moment."""
    still = run_of("paper-box", 21, 0.005, held(12.0, 15.0), 0.5)
    T = still.columns["tension_top_N"][0]
    assert np.abs(still.columns["tension_top_N"] - T).max() < 1e-6 * T
    dropped = run_of("paper-box", 21, 0.005, held(12.0, 15.0, release_s=0.2), 0.5)
    assert np.abs(dropped.columns["tension_top_N"][:3] - T).max() < 1e-6 * T
    assert np.abs(dropped.columns["z_m"][:3] - 15.0).max() < 1e-6
    assert dropped.columns["z_m"][-1] < 14.9


def test_a_held_end_is_in_its_place_in_space():
    """Slack, in a current across the plane of the chord: the shape turns about the chord, the end stays."""
    place = [12.0, 9.0, 5.0]
    water = {"depth_m": 30.0, "density_kgpm3": 1027.0}
    current = {"water": water, "current": {"law": "uniform", "velocity_mps": [-0.3, 0.5, 0.0]}, "motion.dimensions": 3}
    found = run_of("paper-box", 21, 0.005, current | held(*place), 0.2)
    assert np.abs(places(found)[:, :, -1] - np.array(place)[:, None]).max() < 1e-8
    middle = found.columns["offplane_m"][0]
    assert middle > 9.0 + 1e-3  # blown out to the side


def test_a_free_end_hangs_under_its_force_in_any_direction():
    """Weightless and stiff against stretching: the line lies along the force."""
    force = [30.0, -40.0, 20.0]
    pulled = {"motion.dimensions": 3, "gravity_mps2": 0.0, "buoy": None, "end.kind": "free", "end.force_N": force}
    found = run_of("paper-box", 5, 0.01, pulled, 0.05)
    size = np.linalg.norm(force)
    assert places(found)[:, -1, -1] == pytest.approx(20.0 * (1 + size / 5e4) * np.array(force) / size, rel=1e-9)
