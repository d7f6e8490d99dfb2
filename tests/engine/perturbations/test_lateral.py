"""Law: a lateral stage solves the box equations in space, linearised about a state in the plane.

The equations in space are written out in `box_equations` without a kernel of the engine, and linearised by complex
step. States have every term at work: strains of both signs, shear, bends, turns of up to 2.9 rad
in an element, motion, water; they solve nothing, and need not, for the law to hold.

Law: on an upright tether x and y are one and the same: a lateral perturbation is the planar tangent vector turned.

The tether stands or hangs straight, at rest, in a vertical current, or bouncing along itself through strains from 0 to
twice the static one; without waves nothing in the water tells x from y. The same perturbation (q_x, V_x) and (q_y, V_y)
then grows alike in `tangent` and in `lateral`, step by step and with the same shape; both are solved to
rounding, and growth of e^10 and decay of e^-30 on the way leave 1e-7 of that.
"""

import numpy as np
import pytest

from engine.scene import build_scene
from tests.engine.box_equations import LAWS, across, lifted, response, state_of
from tests.engine.kernels import Stage
from tests.engine.lines import DRY, STILL, free, held, kick, line, uniform
from tests.engine.perturbations.test_tangent_vectors import Carried, Run
from tests.engine.physics.caps import CAP

NODES, RATE = 7, 120.0
ENDS = {"buoy": {}, "held": held(3.0, 18.0), "free": free(300.0, 900.0)}


def scene_of(end, wet, **tether):
    usual = {"nodes": NODES, "bending_stiffness_Nm2": 24.0, "grid_stretching": 1.5, "diameter_m": 0.05}
    return line(ENDS[end], {} if wet else DRY, **usual | tether)


def angles(rng, turns):
    """phi (NODES,) with turns of up to `turns` rad in an element."""
    return 1.4 + np.concatenate([[0.0], np.cumsum(rng.uniform(-turns, turns, NODES - 1))])


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
    state, dC_tilde = state_of(rng, scene, angles(rng, turns)), rng.normal(size=(NODES, 2))
    exact = space_response(scene, *state, dC_tilde, GI)
    computed = kernel_response(scene, *state, dC_tilde)
    assert np.abs(exact[:, [0, 2, 3, 5]]).max() < 1e-9 * np.abs(exact).max(), "nothing moves in the plane"
    for column in (0, 1):
        expected = exact[:, 1 + 3 * column]
        assert np.abs(computed[:, column] - expected).max() < 1e-8 * np.abs(expected).max()


def test_a_turn_of_pi_is_like_its_neighbours():
    """A loop about to be released turns by pi in one element: no pivot of the elimination may vanish there."""
    rng = np.random.default_rng(13)
    scene = scene_of("buoy", True)
    Y, C_tilde, F = state_of(rng, scene, angles(rng, 0.3))
    dC_tilde = rng.normal(size=(NODES, 2))
    computed = []
    for turn in (np.pi - 1e-7, np.pi, np.pi + 1e-7):
        bent = Y.copy()
        bent[5:, 4] += turn - (Y[5, 4] - Y[4, 4])
        computed.append(kernel_response(scene, bent, C_tilde, F, dC_tilde))
    scale = np.abs(computed[1]).max(axis=0)
    assert np.all(np.abs(computed[0] + computed[2] - 2 * computed[1]) < 1e-9 * scale)
    assert np.all(np.abs(computed[2] - computed[0]) < 1e-4 * scale)


IN_THE_SURFACE = CAP | {"water.depth_m": 20.9, "tether.submergence": "free-surface", "tether.diameter_m": 0.6}
BED = {"stiffness_Npm3": 1.0, "damping_Nspm3": 2.0, "friction": 0.5, "friction_speed_mps": 0.1}
RUNS = {
    "rising current": (STILL | uniform(w=0.6), 10.0),
    "bounce in water": (STILL | kick(w=0.8), 20.0),
    "hanging dry, bouncing": (DRY | kick(w=2.0), 10.0),
    "held in a current": (STILL | uniform(w=0.5) | held(0.0, 21.0), 5.0),
    "free, pulled": (STILL | uniform(w=0.5) | free(0.0, 300.0), 2.0),
    "damped bounce": (STILL | kick(w=0.8) | {"tether.damping_Ns": 2e3}, 10.0),
    "bounce in the surface": (STILL | kick(w=0.8) | IN_THE_SURFACE, 10.0),
    "hanging in a soft bed, bouncing": (DRY | kick(w=2.0) | {"floor": BED}, 10.0),
    "bounce, backward-euler": (STILL | kick(w=0.8) | {"solver.integrator": "backward-euler"}, 10.0),
}


def growths(scene, duration_s):
    """Growth (nats) in each step of one perturbation across and one along x, and their shapes (n, 2) at the end."""
    run = Run(scene, duration_s)
    start = run.direction(3)
    start[:, [1, 3]] = 0.0
    start /= run.norm(start)
    planar = Carried(run, start[None])
    across, rates = np.ascontiguousarray(start[:, [0, 2]]), np.zeros((len(start), 2))
    weights = np.tile([1.0, run.weight], (len(start), 1))
    computed = []
    for count in run.chunks():
        for i in range(count):
            before = planar.growth[0]
            planar.follow(i)
            computed.append((run.carry_lateral(i, 1, weights, across, rates), planar.growth[0] - before))
    return np.array(computed), across, planar.vectors[0]


@pytest.mark.parametrize("name", RUNS)
def test_across_is_along_on_an_upright_tether(name):
    overrides, duration_s = RUNS[name]
    computed, across, along = growths(line(overrides, nodes=21), duration_s)
    assert len(computed) > 15
    assert np.abs(computed[:, 0] - computed[:, 1]).max() < 1e-7
    assert np.abs(computed.sum(axis=0)).max() > 0.5, "the perturbation was meant to do something"
    assert np.abs(across - along[:, [0, 2]]).max() < 1e-6
    assert np.abs(along[:, [1, 3]]).max() < 1e-6
