"""Law: a stage that Newton calls converged satisfies the box equations, with the water where the nodes have come to
lie; and Newton's method gets there quadratically where the water is still, also with the buoy partly in it.

Airy kinematics and the positions are computed here, from their formulas.
"""

from itertools import pairwise

import numpy as np
import pytest

from engine import load_scene
from engine.time.status import OK
from tests.engine.box_equations import elements, residual
from tests.engine.kernels import Stage
from tests.engine.lines import Motion, line, positions
from tests.engine.physics.airy import direct
from tests.engine.physics.caps import CAP, Wave

T0 = 3.7  # s, any time


@pytest.mark.parametrize("EI", [0.4, 0.0])
@pytest.mark.parametrize("direction", [0.0, np.pi])
@pytest.mark.parametrize("nodes, stretching", [(11, 0.0), (41, 2.0)])
def test_a_converged_stage_satisfies_the_box_equations(nodes, stretching, direction, EI):
    current = np.array([0.3, 0.1])
    scene = load_scene(
        "tethered_buoy",
        {
            "tether.nodes": nodes,
            "tether.grid_stretching": stretching,
            "tether.bending_stiffness_Nm2": EI,
            "waves.direction_rad": direction,
            "waves.phase_rad": 0.4,
            "current": {"law": "uniform", "velocity_mps": [current[0], 0.0, current[1]]},
        },
    )
    rate, s = 300.0, np.linspace(0, 1, nodes)
    Y = np.zeros((nodes, 6))
    Y[:, 0], Y[:, 4] = 0.03, 1.45 + 0.1 * s**2  # taut, leaning, at rest, in waves of full height
    stage = Stage(scene)
    C_tilde = stage.conserved(Y)
    code, _ = stage.newton(T0, rate, rate, 1e-9, 30, Y, C_tilde)
    assert code == OK
    sea = Wave(scene)
    X = positions(Y, elements(scene))
    F = direct(sea.k, sea.A, scene.water.depth_m, T0, X, np.cos(direction), 0.4).astype(float)
    F[:, :2] += current
    left = residual(scene, rate, rate, 1.0, Y, C_tilde, F)
    # forces in newtons, velocities in m/s: 1e-6 of the loads (2000 N) and speeds (1 m/s) of the scene at hand
    size = np.concatenate([np.ones(2 * nodes), np.full(2 * nodes, 2000.0), np.ones(2 * nodes if EI else 0)])
    assert np.abs(left / size).max() < 1e-6


@pytest.mark.parametrize("depth_m", [20.6, 20.2])
@pytest.mark.parametrize("EI", [0.4, 0.0], ids=["bent", "unbent"])
@pytest.mark.parametrize("dimensions", [2, 3])
def test_newton_is_quadratic_with_the_buoy_partly_in_the_water(dimensions, EI, depth_m):
    """A stage in which the sphere goes through the surface of still water at 3 m/s: nothing is left out of the
    matrix, which has what velocity and place change."""
    velocity = [2.0, 1.0 if dimensions == 3 else 0.0, -3.0]
    changes = {"waves": None, "water.depth_m": 21.0, "motion.dimensions": dimensions, "buoy.impact_loss": 0.3}
    scene = line(CAP, changes, {"start.buoy_velocity_mps": velocity}, nodes=7, bending_stiffness_Nm2=EI)
    Y, stage, axes, rate = Motion(scene).Y.copy(), Stage(scene, depth=depth_m), dimensions, 40.0
    C_tilde = stage.conserved(Y)
    C_tilde[:, :axes] += np.random.default_rng(2).normal(0.0, 1e-3, (7, axes))

    def after(iterations):
        trial = Y.copy()
        _, used = stage.newton(0.0, rate, rate, 1e-40, iterations, trial, C_tilde)
        assert used == iterations or used > 5  # of the later ones rounding is all that is left
        return trial[:, axes : 2 * axes]

    end = after(8)
    errors = [np.abs(after(count) - end).max() for count in range(1, 6)]
    assert errors[0] > 1e-6
    for before, error in pairwise(errors):
        assert error < 40.0 * before**2 + 1e-12
