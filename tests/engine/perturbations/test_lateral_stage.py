"""Law: a lateral stage solves the box equations in space, linearised about a state in the plane.

The equations in space are written out in `box_equations` without a kernel of the engine, and linearised by complex
step. States have every term at work: strains of both signs, shear, bends, turns of up to 2.9 rad
in an element, motion, water; they solve nothing, and need not, for the law to hold.
"""

import numpy as np
import pytest

from engine import load_scene
from engine.scene import build_scene
from tests.engine.box_equations import LAWS, across, lifted, response
from tests.engine.kernels import Stage
from tests.engine.lines import DRY, free, held

NODES, RATE = 7, 120.0
ENDS = {"buoy": {}, "held": held(3.0, 18.0), "free": free(300.0, 900.0)}


def scene_of(end, wet, **tether):
    usual = {"nodes": NODES, "bending_stiffness_Nm2": 24.0, "grid_stretching": 1.5, "diameter_m": 0.05}
    return load_scene(
        "tethered_buoy", {f"tether.{k}": v for k, v in (usual | tether).items()} | ENDS[end] | ({} if wet else DRY)
    )


def state_of(rng, wet, turns):
    """phi (n,), planar Y (n, 6), C_tilde and F (n, 4) of a random state whose elements turn by up to `turns` rad."""
    Y = np.empty((NODES, 6))
    Y[:, 0] = rng.uniform(-0.15, 0.35, NODES)
    Y[:, 1] = rng.normal(0, 300, NODES)
    Y[:, 2:4] = rng.normal(0, 2, (NODES, 2))
    Y[:, 4] = 1.4 + np.concatenate([[0.0], np.cumsum(rng.uniform(-turns, turns, NODES - 1))])
    Y[:, 5] = rng.normal(0, 1, NODES)
    lam = 1 + Y[:, 0]
    C_tilde = np.stack([lam * np.cos(Y[:, 4]), lam * np.sin(Y[:, 4]), Y[:, 2], Y[:, 3]], 1)
    C_tilde += rng.normal(0, 0.02, (NODES, 4))
    return Y, C_tilde, rng.normal(0, 1.5, (NODES, 4)) if wet else np.zeros((NODES, 4))


def kernel_response(scene, Y, C_tilde, F, dC_tilde):
    stage = Stage(scene)
    return stage.lateral(RATE, Y, RATE * (stage.conserved(Y) - C_tilde), F, dC_tilde)


def space_response(scene, Y, C_tilde, F, dC_tilde, GI):
    """The same (n, 6), from the equations in space."""
    sections = scene.as_dict()
    sections["motion"] |= {"dimensions": 3}
    sections["tether"] |= {"torsion_stiffness_Nm2": GI}
    change = np.zeros((NODES, 6))
    change[:, [1, 4]] = dC_tilde
    return response(build_scene(sections), RATE, lifted(Y), across(C_tilde), across(F), change)


@pytest.mark.parametrize("turns", [0.5, 2.9])
@pytest.mark.parametrize("wet, law, GI", [(True, "tanh", 400.0), (False, "linear", 0.0004)])
@pytest.mark.parametrize("end", ENDS)
def test_it_solves_the_linearised_equations_in_space(end, wet, law, GI, turns):
    """Torsional stiffness has no part in it."""
    rng = np.random.default_rng(11)
    scene = scene_of(end, wet, tension=LAWS[law])
    state, dC_tilde = state_of(rng, wet, turns), rng.normal(size=(NODES, 2))
    exact = space_response(scene, *state, dC_tilde, GI)
    found = kernel_response(scene, *state, dC_tilde)
    assert np.abs(exact[:, [0, 2, 3, 5]]).max() < 1e-9 * np.abs(exact).max(), "nothing moves in the plane"
    for column in (0, 1):
        expected = exact[:, 1 + 3 * column]
        assert np.abs(found[:, column] - expected).max() < 1e-8 * np.abs(expected).max()


def test_a_turn_of_pi_is_like_its_neighbours():
    """A loop about to be released turns by pi in one element: no pivot of the elimination may vanish there."""
    rng = np.random.default_rng(13)
    scene = scene_of("buoy", True)
    Y, C_tilde, F = state_of(rng, True, 0.3)
    dC_tilde = rng.normal(size=(NODES, 2))
    found = []
    for turn in (np.pi - 1e-7, np.pi, np.pi + 1e-7):
        bent = Y.copy()
        bent[5:, 4] += turn - (Y[5, 4] - Y[4, 4])
        found.append(kernel_response(scene, bent, C_tilde, F, dC_tilde))
    scale = np.abs(found[1]).max(axis=0)
    assert np.all(np.abs(found[0] + found[2] - 2 * found[1]) < 1e-9 * scale)
    assert np.all(np.abs(found[2] - found[0]) < 1e-4 * scale)
