"""Every integrator shows its stated order in space too: fixed steps halved, the whole line compared at one time.

As in the plane (tests/engine/test_order_in_time.py): a soft line of 6 nodes, whose fastest waves the steps resolve;
sin^2 raises waves that come in at an angle, and a current that is not in their plane keeps the relative velocity from
changing its sign, because |v| v has a kink in its second derivative there.
"""

from itertools import pairwise

import numpy as np
import pytest

from engine import simulate
from tests.engine.spatial.lines import in_space

ASKEW = {
    "water.depth_m": 30.0,
    "waves.direction_rad": 0.6,
    "current": {"law": "uniform", "velocity_mps": [1.0, -0.7, 0.8]},
    "tether.tension": {"law": "linear", "stiffness_N": 5e3},
}
SCENES = {  # overrides, run length (s)
    "ramped waves": (
        {"waves.steepness": 0.02, "waves.ramp_s": 8.0, **ASKEW},
        8.0,
    ),
    "sudden waves": (
        {"waves.steepness": 0.02, **ASKEW},
        4.0,
    ),
    "a blow from two sides on a dry line": (
        {
            "water": None,
            "waves": None,
            "buoy.mass_kg": 10.0,
            "start.buoy_velocity_mps": [1.0, 0.6, 0.0],
            "tether.tension": {"law": "linear", "stiffness_N": 500.0},
        },
        2.0,
    ),
}


def line_at_end(name, integrator, spectral_radius, steps):
    """Positions (3, nodes), m, after a number of equal steps."""
    overrides, end_s = SCENES[name]
    scene = in_space(
        overrides,
        {
            "solver.integrator": integrator,
            "solver.spectral_radius": spectral_radius,
            "solver.step_s": end_s / steps,
            "solver.newton_tolerance": 1e-20,
            "solver.max_newton_iterations": 50,
            "output.step_s": end_s,
            "output.profiles": True,
        },
        nodes=6,
    )
    run = simulate(scene, duration_s=end_s)
    assert run.status == "ok" and run.statistics["newton_failures"] == 0
    return np.stack([getattr(run.profiles, f"{axis}_m")[-1] for axis in "xyz"])


@pytest.mark.parametrize(
    "name, integrator, spectral_radius, order, steps",
    [
        ("ramped waves", "esdirk43", 0.5, 4, 40),
        ("ramped waves", "trbdf2", 0.5, 2, 80),
        ("ramped waves", "midpoint", 0.5, 2, 80),
        ("ramped waves", "generalized-alpha", 0.8, 2, 80),
        ("ramped waves", "generalized-alpha", 0.5, 2, 80),
        ("ramped waves", "generalized-alpha", 0.0, 2, 80),
        ("ramped waves", "backward-euler", 0.5, 1, 80),
        ("a blow from two sides on a dry line", "esdirk43", 0.5, 4, 160),
        ("a blow from two sides on a dry line", "backward-euler", 0.5, 1, 80),
        ("sudden waves", "trbdf2", 0.5, 2, 80),
        ("sudden waves", "midpoint", 0.5, 2, 80),
        ("sudden waves", "generalized-alpha", 0.0, 2, 80),
    ],
)
def test_order(name, integrator, spectral_radius, order, steps):
    lines = [line_at_end(name, integrator, spectral_radius, steps << i) for i in range(4)]
    assert np.abs(lines[-1][1]).max() > 0.1  # well out of the plane
    differences = [np.linalg.norm(fine - coarse, axis=0).max() for coarse, fine in pairwise(lines)]
    found = np.log2(np.divide(differences[:-1], differences[1:]))
    assert np.all(np.abs(found - order) < 0.1), (found, differences)
    assert differences[0] < {1: 2e-2, 2: 2e-3, 4: 1e-6}[order]
