"""The sweep in space solves J D = -residual, with J the derivative of the box equations as they are written down.

The residual is assembled in `box_equations` without the engine's kernels and with the rotation between nodes taken from
matrices, J by complex step. Rotations: increments are rotation vectors in local axes. Clamps: at states whose end
tangents point where they should, up to the roll, as in every state the engine meets once it has started; away from
there the engine takes the derivative for an aligned clamp. The water is frozen, as in the plane.
"""

import numpy as np
import pytest

from engine import load_scene
from tests.engine.spatial.box_equations import equations, frames, jacobian, kernel_update, product, roll, unknowns

LAWS = {
    "linear": {"law": "linear", "stiffness_N": 5e4},
    "tanh": {"law": "tanh", "p": [2.0e4, 5.0, 0.3, -5.0e3, 1.0e4]},
    "tabulated": {"law": "tabulated", "strain": [-0.2, 0.0, 0.1, 0.3], "tension_N": [-500.0, 0.0, 3e3, 2e4]},
}
PLACE = [3.0, -2.0, 18.0]
HELD = {"end.kind": "held", "end.position_m": PLACE, "buoy": None}
CLAMPED_BELOW, CLAMPED_ABOVE = {"anchor.rotation": "clamped"}, {"end.rotation": "clamped"}
ENDS = {
    "buoy": {},
    "held": HELD,
    "free": {"end.kind": "free", "end.force_N": [300.0, -200.0, 900.0], "buoy": None},
    "buoy on a clamped anchor": CLAMPED_BELOW,
    "held, clamped above": {**HELD, **CLAMPED_ABOVE},
    "held, clamped twice": {**HELD, **CLAMPED_BELOW, **CLAMPED_ABOVE, "end.twist_rad": 1.3},
}
STAGES = {"motion": (200.0, 120.0, 1.0), "statics": (1.0, 10.0, 0.0), "last statics": (1.0, 0.0, 0.0)}
NODES = 6
CASES = [(end, EI) for end in ENDS for EI in (0.0, 24.0) if EI or "clamped" not in end]
ROUNDING = 1e-9  # of numbers that are zero: those next to them are of order 1 and more
TURNS = [1e-4, 0.15, 1.0]  # rad between neighbours: both branches of the kernel's rotation vector, and far from small


def scene_of(law, end, wet, EI, stretching, tangents):
    """A scene of few nodes; clamps point along the tangents (2, 3) of the first and the last node."""
    overrides = {
        "motion.dimensions": 3,
        "tether.tension": LAWS[law],
        "tether.nodes": NODES,
        "tether.bending_stiffness_Nm2": EI,
        "tether.torsion_stiffness_Nm2": 0.7 * EI,
        "tether.grid_stretching": stretching,
        "tether.diameter_m": 0.05,
        **ENDS[end],
    }
    for part, tangent in zip(("anchor", "end"), tangents, strict=True):
        if overrides.get(f"{part}.rotation") == "clamped":
            overrides[f"{part}.direction"] = tangent.tolist()
    if not wet:
        overrides |= {"water": None, "waves": None}
    return load_scene("tethered_buoy", overrides)


def turned_by(theta):
    """Euler parameters (m, 4) of rotation vectors (m, 3)."""
    angle = np.linalg.norm(theta, axis=1, keepdims=True)
    return np.concatenate([np.cos(angle / 2), np.sinc(angle / (2 * np.pi)) * theta / 2], 1)


def directions(rng, turn):
    """Euler parameters (NODES, 4): from a random first frame, random turns from node to node."""
    beta = turned_by(rng.normal(0, 1, (1, 3)))
    for _ in range(NODES - 1):
        theta = rng.normal(0, turn, (1, 3))
        theta *= min(1.0, 2.9 / np.linalg.norm(theta))
        beta = np.concatenate([beta, product(beta[-1:], turned_by(theta))])
    return beta


def state_of(rng, scene, beta):
    """A state with every term of the equations at work: strain of both signs, shear, turns about every axis, motion,
    water; torsion where both ends are clamped."""
    n = scene.tether.nodes
    Y = np.empty((n, 13))
    Y[:, 0] = rng.uniform(-0.15, 0.35, n)
    Y[:, 1:3] = rng.normal(0, 300, (n, 2))
    Y[:, 3:6] = rng.normal(0, 2, (n, 3))
    Y[:, 6:10] = beta
    Y[:, 10] = 0.0
    if scene.anchor.rotation == scene.end.rotation == "clamped":
        # 0.3 rad more than the twist: Euler parameters know the rest of a whole number of double turns only
        Y[:, 10] = (scene.end.twist_rad + 0.3 - roll(Y, scene)) / scene.tether.length_m
    Y[:, 11:] = rng.normal(0, 1, (n, 2))
    if scene.tether.bending_stiffness_Nm2 == 0:
        Y[:, [1, 2, 10, 11, 12]] = 0.0
    C_tilde = np.concatenate([(1 + Y[:, :1]) * frames(beta)[:, 0], Y[:, 3:6]], 1) + rng.normal(0, 0.02, (n, 6))
    F = rng.normal(0, 1.5, (n, 6)) if scene.water is not None else np.zeros((n, 6))
    return Y, C_tilde, F


@pytest.mark.parametrize("stage", STAGES)
@pytest.mark.parametrize("wet", [True, False], ids=["wet", "dry"])
@pytest.mark.parametrize("end, EI", CASES)
def test_update_solves_the_linearised_box_equations(end, EI, wet, stage):
    rng = np.random.default_rng(7)
    for law, stretching, turn in zip(LAWS, (0.0, 2.0, 0.0), TURNS, strict=True):
        beta = directions(rng, turn)
        scene = scene_of(law, end, wet, EI, stretching, frames(beta)[[0, -1], 0])
        Y, C_tilde, F = state_of(rng, scene, beta)
        still = np.zeros((len(Y), 12))
        r = equations(scene, STAGES[stage], Y, still, C_tilde, F, scene.end.twist_rad)
        J = jacobian(scene, STAGES[stage], Y, C_tilde, F)
        assert len(J) == len(J.T) == len(r)
        D = kernel_update(scene, *STAGES[stage], Y, C_tilde, F)
        exact = np.linalg.solve(J, -r).reshape(len(D), -1)
        # each unknown against the largest of its kind along the line
        off = np.abs(D[:, unknowns(scene)] - exact).max(0)
        assert np.all(off <= 1e-6 * np.abs(exact).max(0) + ROUNDING), off / np.abs(exact).max(0)
        # and each equation against its own terms
        left = J @ D[:, unknowns(scene)].ravel() + r
        assert np.all(np.abs(left) <= 1e-6 * (np.abs(J) @ np.abs(exact).ravel() + np.abs(r)) + ROUNDING)
        if EI == 0:
            assert not D[:, [1, 2, 6, 9, 10, 11]].any()
