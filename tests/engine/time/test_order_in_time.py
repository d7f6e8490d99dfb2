"""Every integrator shows its stated order: fixed steps halved, the whole line compared at one time, slope within 0.1.

The scenes are smooth: sin^2 rises a wave that ends at its full height, and a current keeps the relative velocity from
changing its sign, because |v| v has a kink in its second derivative there that no method of order 4 survives.
The tether is soft, so that its fastest waves (6 nodes) are resolved by the steps: orders, not order reductions.
"""

from itertools import pairwise

import numpy as np
import pytest

from engine import load_scene, simulate

SOFT = {"law": "linear", "stiffness_N": 5e3}
DRIFT = {"law": "uniform", "velocity_mps": [1.0, 0.0, 0.8]}
SCENES = {  # overrides, run length (s)
    "ramped waves": (
        {"waves.steepness": 0.02, "water.depth_m": 30.0, "waves.ramp_s": 8.0, "tether.tension": SOFT, "current": DRIFT},
        8.0,
    ),
    "sudden waves": (
        {"waves.steepness": 0.02, "water.depth_m": 30.0, "tether.tension": SOFT, "current": DRIFT},
        4.0,
    ),
    "struck dry line": (
        {
            "water": None,
            "waves": None,
            "buoy.mass_kg": 10.0,
            "start.buoy_velocity_mps": [1.0, 0.0, 0.0],
            "tether.tension": {"law": "linear", "stiffness_N": 500.0},
        },
        2.0,
    ),
}


def line_at_end(name, integrator, spectral_radius, steps):
    """Positions (2, nodes), m, after a number of equal steps."""
    overrides, end_s = SCENES[name]
    scene = load_scene(
        "tethered_buoy",
        {
            **overrides,
            "tether.nodes": 6,
            "solver.integrator": integrator,
            "solver.spectral_radius": spectral_radius,
            "solver.step_s": end_s / steps,
            "solver.newton_tolerance": 1e-20,  # to rounding: the acceptance test squares the last update
            "solver.max_newton_iterations": 50,
            "output.step_s": end_s,
            "output.profiles": True,
        },
    )
    run = simulate(scene, duration_s=end_s)
    assert run.status == "ok" and run.statistics["newton_failures"] == 0
    return np.stack([run.profiles.x_m[-1], run.profiles.z_m[-1]])


def slopes(*case, steps):
    """log2 of the ratios of successive differences over steps, 2 steps, 4 steps, 8 steps; and the differences (m)."""
    lines = [line_at_end(*case, steps << i) for i in range(4)]
    differences = [np.hypot(*(fine - coarse)).max() for coarse, fine in pairwise(lines)]
    return np.log2(np.divide(differences[:-1], differences[1:])), differences


@pytest.mark.parametrize(
    "integrator, spectral_radius, order, steps",
    [
        ("esdirk43", 0.5, 4, 40),
        ("trbdf2", 0.5, 2, 80),
        ("midpoint", 0.5, 2, 80),
        ("generalized-alpha", 1.0, 2, 80),
        ("generalized-alpha", 0.8, 2, 80),
        ("generalized-alpha", 0.5, 2, 80),
        ("generalized-alpha", 0.0, 2, 80),
        ("backward-euler", 0.5, 1, 80),
    ],
)
def test_order_on_a_smooth_motion_in_waves(integrator, spectral_radius, order, steps):
    found, differences = slopes("ramped waves", integrator, spectral_radius, steps=steps)
    assert np.all(np.abs(found - order) < 0.1), (found, differences)
    # and it is a small error: at 0.1 s and less, a centimetre for order 1, a millimetre for 2, a micrometre for 4
    assert differences[0] < {1: 2e-2, 2: 2e-3, 4: 1e-6}[order]


@pytest.mark.parametrize(
    "name, integrator, spectral_radius, order, steps",
    [
        ("struck dry line", "esdirk43", 0.5, 4, 160),
        ("struck dry line", "backward-euler", 0.5, 1, 80),
        ("sudden waves", "trbdf2", 0.5, 2, 80),
        ("sudden waves", "midpoint", 0.5, 2, 80),
        ("sudden waves", "generalized-alpha", 0.0, 2, 80),
    ],
)
def test_order_after_a_sudden_start(name, integrator, spectral_radius, order, steps):
    """The rates at t = 0 are unknown then: methods that use them begin with a few small steps of backward Euler."""
    found, differences = slopes(name, integrator, spectral_radius, steps=steps)
    assert np.all(np.abs(found - order) < 0.1), (found, differences)
