"""Law: with the wetted cap Newton's method converges quadratically: the matrix has what velocity and place change.

Still water, so that nothing is left out of it; a stage in which the sphere goes through the surface at 3 m/s.
"""

from itertools import pairwise

import numpy as np
import pytest

from engine.planar import state as planar
from engine.spatial import state as spatial
from engine.time.newton import newton
from tests.engine.physics.caps import CAP
from tests.engine.lines import Motion, line

RATE, MOST = 40.0, 8


@pytest.mark.parametrize("depth_m", [20.6, 20.2])
@pytest.mark.parametrize("EI", [0.4, 0.0], ids=["bent", "unbent"])
@pytest.mark.parametrize("dimensions", [2, 3])
def test_it_is_quadratic(dimensions, EI, depth_m):
    velocity = [2.0, 1.0 if dimensions == 3 else 0.0, -3.0]
    changes = {"waves": None, "water.depth_m": 21.0, "motion.dimensions": dimensions, "buoy.impact_loss": 0.3}
    motion = Motion(line(CAP, changes, {"start.buoy_velocity_mps": velocity}, nodes=7, bending_stiffness_Nm2=EI))
    record, Y, n = motion.record.copy(), motion.Y.copy(), 7
    record["depth"] = depth_m
    kind = spatial if dimensions == 3 else planar
    half = dimensions
    X, F, Q, E, D, C_tilde = kind.work_arrays.py_func(record, n)
    C = np.zeros((n, 2 * half))
    kind.conserved(record, Y, C)
    C_tilde[:] = C
    C_tilde[:, :half] += np.random.default_rng(2).normal(0.0, 1e-3, (n, half))

    def after(iterations):
        trial = Y.copy()
        work = trial, C_tilde, X, F, Q, E, D
        _, used = newton(record, motion.tables, 0.0, 1.0, RATE, RATE, 1e-40, iterations, *work)
        assert used == iterations or used > 5  # of the later ones rounding is all that is left
        return trial[:, half : 2 * half]

    end = after(MOST)
    errors = [np.abs(after(count) - end).max() for count in range(1, 6)]
    assert errors[0] > 1e-6
    for before, error in pairwise(errors):
        assert error < 40.0 * before**2 + 1e-12
