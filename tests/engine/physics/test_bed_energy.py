"""Law: the energy budget of a line that falls on the bed and slides on it closes; friction takes mu N u, summed."""

import math

import numpy as np
import pytest

from tests.engine.lines import DRY, held, line, linear, ran
from tests.engine.physics.test_bed import CHAIN, EA, WEIGHT

STIFF, DAMPING, MU, V_S = 1e5, 4e3, 0.3, 0.1


@pytest.mark.slow
def test_the_budget_has_what_the_bed_takes(dimensions):
    across = 1.0 if dimensions == 3 else 0.0
    ways = [[0.0, 0.0, 0.0], [-0.5, 0.0, -4.0], [-2.0, across, -4.0]]
    moved = {"law": "table", "time_s": [0.0, 1.5, 3.0], "displacement_m": ways}
    floor = {"stiffness_Npm3": STIFF, "damping_Nspm3": DAMPING, "friction": MU, "friction_speed_mps": V_S}
    kept = {"output.step_s": 2e-3, "output.profiles": True, "output.energy": True}
    fixed = {"solver.integrator": "midpoint", "solver.step_s": 1e-3, "motion.dimensions": dimensions}
    scene = line(DRY, held(18.6, 5.0, motion=moved), {"floor": floor, "tether.tension": linear(EA)}, kept, fixed,
                 nodes=21, **CHAIN)  # fmt: skip
    run = ran(scene, duration_s=4.0)
    budget, at = run.energy, run.profiles
    taken = budget.bed_damping_J[-1] + budget.friction_J[-1]
    assert np.abs(budget.remainder_J()).max() < 1e-3 * taken
    assert np.all(np.diff(budget.bed_damping_J) >= 0.0)
    assert np.all(np.diff(budget.friction_J) >= 0.0)
    assert budget.bed_J[-1] > budget.bed_J[0] > 0.0
    # friction, from places and speeds of the nodes
    width = math.sqrt(4e-4 / math.pi)
    onset, depth = WEIGHT / (STIFF * width), np.maximum(-at.z_m, 0.0)
    vx, vy, vz = (np.gradient(part, at.time_s, axis=0) for part in (at.x_m, at.y_m, at.z_m))
    soft = np.minimum(depth / onset, 1.0)
    y = np.where(depth > onset, depth - onset / 2, 0.5 * depth * soft)
    N = np.maximum(STIFF * width * y - DAMPING * width * soft * vz, 0.0)
    power = np.trapezoid(MU * N * (vx**2 + vy**2) / np.sqrt(vx**2 + vy**2 + V_S**2), at.s_m, axis=1)
    assert budget.friction_J[-1] == pytest.approx(np.trapezoid(power, at.time_s), rel=0.02)
