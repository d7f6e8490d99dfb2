"""The sweep solves J D = -residual, with J the derivative of the box equations as they are written down.

The residual is assembled in `box_equations` without the engine's kernels, J by complex step. The water is frozen: its
dependence on position is left out of the engine's Jacobian by design.
"""

import numpy as np
import pytest

from engine import load_scene
from tests.engine.box_equations import jacobian, kernel_update, residual, unknowns

LAWS = {
    "linear": {"law": "linear", "stiffness_N": 5e4},
    "tanh": {"law": "tanh", "p": [2.0e4, 5.0, 0.3, -5.0e3, 1.0e4]},
    "tabulated": {"law": "tabulated", "strain": [-0.2, 0.0, 0.1, 0.3], "tension_N": [-500.0, 0.0, 3e3, 2e4]},
}
ENDS = {
    "buoy": {},
    "held": {"end.kind": "held", "end.position_m": [3.0, 0.0, 18.0], "buoy": None},
    "free": {"end.kind": "free", "end.force_N": [300.0, 0.0, 900.0], "buoy": None},
}
STAGES = {"motion": (200.0, 120.0, 1.0), "statics": (1.0, 10.0, 0.0), "last statics": (1.0, 0.0, 0.0)}


def scene_of(law, end, wet, EI, stretching):
    overrides = {
        "tether.tension": LAWS[law],
        "tether.nodes": 9,
        "tether.bending_stiffness_Nm2": EI,
        "tether.grid_stretching": stretching,
        "tether.diameter_m": 0.05,
        **ENDS[end],
    }
    if not wet:
        overrides |= {"water": None, "waves": None}
    return load_scene("tethered_buoy", overrides)


def state_of(rng, scene):
    """A state with every term of the equations at work: strain of both signs, shear, bends, motion, water."""
    n = scene.tether.nodes
    Y = np.empty((n, 6))
    Y[:, 0] = rng.uniform(-0.15, 0.35, n)
    Y[:, 1] = rng.normal(0, 300, n)
    Y[:, 2:4] = rng.normal(0, 2, (n, 2))
    Y[:, 4] = 1.4 + rng.normal(0, 0.5, n)
    Y[:, 5] = rng.normal(0, 1, n)
    if scene.tether.bending_stiffness_Nm2 == 0:
        Y[:, [1, 5]] = 0.0
    lam = 1 + Y[:, 0]
    C_tilde = np.stack([lam * np.cos(Y[:, 4]), lam * np.sin(Y[:, 4]), Y[:, 2], Y[:, 3]], 1)
    C_tilde += rng.normal(0, 0.02, (n, 4))
    F = rng.normal(0, 1.5, (n, 4)) if scene.water is not None else np.zeros((n, 4))
    return Y, C_tilde, F


@pytest.mark.parametrize("stage", STAGES)
@pytest.mark.parametrize("EI", [0.0, 24.0])
@pytest.mark.parametrize("wet", [True, False], ids=["wet", "dry"])
@pytest.mark.parametrize("end", ENDS)
@pytest.mark.parametrize("law", LAWS)
def test_update_solves_the_linearised_box_equations(law, end, wet, EI, stage):
    rng = np.random.default_rng(7)
    for stretching in (0.0, 2.0):
        scene = scene_of(law, end, wet, EI, stretching)
        for _ in range(3):
            state = (*STAGES[stage], *state_of(rng, scene))
            r = residual(scene, *state)
            J = jacobian(scene, *state)
            D = kernel_update(scene, *state)
            exact = np.linalg.solve(J, -r).reshape(len(D), -1)
            # each unknown against the largest of its kind along the line
            assert np.all(np.abs(D[:, unknowns(scene)] - exact).max(0) <= 1e-6 * np.abs(exact).max(0))
            # and each equation against its own terms
            left = J @ D[:, unknowns(scene)].ravel() + r
            assert np.all(np.abs(left) <= 1e-6 * (np.abs(J) @ np.abs(exact).ravel() + np.abs(r)))
            if EI == 0:
                assert not D[:, [1, 5]].any()


@pytest.mark.parametrize("stage", STAGES)
@pytest.mark.parametrize("EI", [0.0, 24.0])
@pytest.mark.parametrize("law", ["linear", "tanh"])
def test_with_shock_viscosity(law, EI, stage):
    rng = np.random.default_rng(8)
    viscous = {"solver.shock_viscosity": {"quadratic": 1.0, "linear": 0.2}, "solver.integrator": "generalized-alpha"}
    line = {"tether.tension": LAWS[law], "tether.nodes": 9, "tether.bending_stiffness_Nm2": EI}
    scene = load_scene("tethered_buoy", {**line, "water": None, "waves": None, **ENDS["free"], **viscous})
    for _ in range(5):
        Y, C_tilde, F = state_of(rng, scene)
        coefficients = rng.uniform(0.0, [2.0, 40.0], (9, 2))
        coefficients[rng.random(9) < 0.3] = 0.0
        state = (*STAGES[stage], Y, C_tilde, F, coefficients)
        r, J, D = residual(scene, *state), jacobian(scene, *state), kernel_update(scene, *state)
        if STAGES[stage][2]:
            assert np.abs(r - residual(scene, *state[:-1])).max() > 1e-3 * np.abs(r).max()
        exact = np.linalg.solve(J, -r).reshape(9, -1)
        assert np.all(np.abs(D[:, unknowns(scene)] - exact).max(0) <= 1e-6 * np.abs(exact).max(0))
