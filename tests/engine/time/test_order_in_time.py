"""Law: every integrator shows its stated order, in a plane and in space: fixed steps halved, the whole line compared at
one time, slope within 0.1.

The scenes are smooth: sin^2 raises a wave that ends at its full height, and a current keeps the relative velocity from
changing its sign, because |v| v has a kink in its second derivative there that no method of order 4 survives. In space
waves and current come in at an angle.
The tether is soft, so that its fastest waves (6 nodes) are resolved by the steps: orders, not order reductions.
"""

from itertools import pairwise

import numpy as np
import pytest

from engine import simulate
from tests.engine.lines import DRY, line, linear

WAVES = {"waves.steepness": 0.02, "water.depth_m": 30.0, "tether.tension": linear(5e3)}
STRUCK = {**DRY, "buoy.mass_kg": 10.0, "tether.tension": linear(500.0)}
SCENES = {  # overrides, run length (s)
    "ramped waves": ({**WAVES, "waves.ramp_s": 8.0}, 8.0),
    "sudden waves": (WAVES, 4.0),
    "struck dry line": (STRUCK, 2.0),
}
ASIDE = {
    2: ({"current": {"law": "uniform", "velocity_mps": [1.0, 0.0, 0.8]}}, [1.0, 0.0, 0.0]),
    3: ({"current": {"law": "uniform", "velocity_mps": [1.0, -0.7, 0.8]}, "waves.direction_rad": 0.6}, [1.0, 0.6, 0.0]),
}


def line_at_end(name, dimensions, integrator, spectral_radius, steps):
    """Positions (3, nodes), m, after a number of equal steps."""
    overrides, end_s = SCENES[name]
    currents, blow = ASIDE[dimensions]
    scene = line(
        overrides,
        {"start.buoy_velocity_mps": blow} if name == "struck dry line" else currents,
        {
            "motion.dimensions": dimensions,
            "solver.integrator": integrator,
            "solver.spectral_radius": spectral_radius,
            "solver.step_s": end_s / steps,
            "solver.newton_tolerance": 1e-20,  # to rounding: the acceptance test squares the last update
            "solver.max_newton_iterations": 50,
            "output.step_s": end_s,
            "output.profiles": True,
        },
        nodes=6,
    )
    run = simulate(scene, duration_s=end_s)
    assert run.status == "ok" and run.statistics["newton_failures"] == 0
    return np.stack([getattr(run.profiles, f"{axis}_m")[-1] for axis in "xyz"])


@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize(
    "name, integrator, spectral_radius, order, steps",
    [
        ("ramped waves", "esdirk43", 0.5, 4, 40),
        ("ramped waves", "trbdf2", 0.5, 2, 80),
        ("ramped waves", "midpoint", 0.5, 2, 80),
        ("ramped waves", "generalized-alpha", 1.0, 2, 80),
        ("ramped waves", "generalized-alpha", 0.5, 2, 80),
        ("ramped waves", "generalized-alpha", 0.0, 2, 80),
        ("ramped waves", "backward-euler", 0.5, 1, 80),
        # rates at t = 0 are unknown after a sudden start: methods that use them begin with small backward Euler steps
        ("struck dry line", "esdirk43", 0.5, 4, 160),
        ("struck dry line", "backward-euler", 0.5, 1, 80),
        ("sudden waves", "trbdf2", 0.5, 2, 80),
        ("sudden waves", "midpoint", 0.5, 2, 80),
        ("sudden waves", "generalized-alpha", 0.0, 2, 80),
    ],
)
def test_order(name, integrator, spectral_radius, order, steps, dimensions):
    lines = [line_at_end(name, dimensions, integrator, spectral_radius, steps << i) for i in range(4)]
    assert (np.abs(lines[-1][1]).max() > 0.1) == (dimensions == 3)  # well out of the plane
    differences = [np.linalg.norm(fine - coarse, axis=0).max() for coarse, fine in pairwise(lines)]
    found = np.log2(np.divide(differences[:-1], differences[1:]))
    assert np.all(np.abs(found - order) < 0.1), (found, differences)
    # and it is a small error: at 0.1 s and less, a centimetre for order 1, a millimetre for 2, a micrometre for 4
    assert name == "struck dry line" or differences[0] < {1: 2e-2, 2: 2e-3, 4: 1e-6}[order]
