"""Law: the elimination solves J D = -residual, with J the derivative of the box equations as they are written down.

The residual is assembled in `box_equations` without the engine's kernels, J by complex step. The water is frozen: its
dependence on position is left out of the engine's Jacobian by design. Clamps: at states whose end tangents point where
they should, up to the roll, as in every state the engine meets once it has started; away from there the engine takes
the derivative for an aligned clamp. So Newton's method ends where the box equations hold, and gets there quadratically
where the water is still, also with the buoy partly in it.
"""

from itertools import pairwise

import numpy as np
import pytest

from tests.engine.box_equations import LAWS, equations, jacobian, state_of, unknowns
from tests.engine.kernels import Stage
from tests.engine.lines import DRY, Motion, kick, line
from tests.engine.physics.caps import CAP
from tests.engine.rotations import frames, product, turned_by

HELD = {"end.kind": "held", "buoy": None}
CLAMPED_BELOW, CLAMPED_ABOVE = {"anchor.rotation": "clamped"}, {"end.rotation": "clamped"}
ENDS = {
    "buoy": {},
    "held": HELD,
    "free": {"end.kind": "free", "buoy": None},
    "buoy on a clamped anchor": CLAMPED_BELOW,
    "held, clamped above": {**HELD, **CLAMPED_ABOVE},
    "held, clamped twice": {**HELD, **CLAMPED_BELOW, **CLAMPED_ABOVE, "end.twist_rad": 1.3},
}
STAGES = {"motion": (200.0, 120.0, 1.0), "statics": (1.0, 10.0, 0.0), "last statics": (1.0, 0.0, 0.0)}
NODES = 5
CASES = [
    (dimensions, end, EI)
    for dimensions in (2, 3) for end in ENDS for EI in (0.0, 24.0)
    if "clamped" not in end or (EI and dimensions == 3)
]  # fmt: skip
ROUNDING = 1e-9  # of numbers that are zero: those next to them are of order 1 and more
TURNS = [1e-4, 0.15, 1.0]  # rad between neighbours: both branches of the kernel's rotation vector, and far from small


def scene_of(dimensions, law, end, wet, EI, stretching=0.0, tangents=None, **changes):
    """A scene of few nodes; clamps point along the tangents (2, 3) of the first and the last node."""
    across = 1.0 if dimensions == 3 else 0.0
    changes = {"motion.dimensions": dimensions, **ENDS[end], **changes}
    if changes.get("end.kind") == "held":
        changes["end.position_m"] = [3.0, -2.0 * across, 18.0]
    if changes.get("end.kind") == "free":
        changes["end.force_N"] = [300, -200 * across, 900]
    for i, part in enumerate(("anchor", "end")):
        if changes.get(f"{part}.rotation") == "clamped":
            changes[f"{part}.direction"] = tangents[i].tolist()
    return line(
        {} if wet else DRY, changes, tension=LAWS[law], nodes=NODES, bending_stiffness_Nm2=EI, diameter_m=0.05,
        torsion_stiffness_Nm2=0.7 * EI, grid_stretching=stretching,
    )  # fmt: skip


def directions(rng, turn, dimensions):
    """Angles (NODES,) or Euler parameters (NODES, 4): from a random first frame, random turns from node to node."""
    if dimensions == 2:
        return 1.4 + np.cumsum(rng.normal(0, turn, NODES).clip(-2.9, 2.9))
    beta = turned_by(rng.normal(0, 1, (1, 3)))
    for _ in range(NODES - 1):
        theta = rng.normal(0, turn, (1, 3))
        beta = np.concatenate([beta, product(beta[-1:], turned_by(theta * min(1.0, 2.9 / np.linalg.norm(theta))))])
    return beta


def assert_solved(scene, stage, Y, C_tilde, F, **settings):
    still, viscosity = np.zeros((NODES, 12 if Y.shape[1] == 13 else 6)), settings.get("viscosity")
    r = equations(scene, stage, Y, still, C_tilde, F, twist=scene.end.twist_rad, **settings)
    J = jacobian(scene, stage, Y, C_tilde, F, **settings)
    assert len(J) == len(J.T) == len(r)
    D = Stage(scene).update(*stage, Y, C_tilde, F, viscosity)
    exact = np.linalg.solve(J, -r).reshape(NODES, -1)
    # each unknown against the largest of its kind along the line
    off = np.abs(D[:, unknowns(scene)] - exact).max(0)
    assert np.all(off <= 1e-6 * np.abs(exact).max(0) + ROUNDING), off / np.abs(exact).max(0)
    # and each equation against its own terms
    left = J @ D[:, unknowns(scene)].ravel() + r
    assert np.all(np.abs(left) <= 1e-6 * (np.abs(J) @ np.abs(exact).ravel() + np.abs(r)) + ROUNDING)
    assert not np.delete(D, unknowns(scene), axis=1).any()
    return r


@pytest.mark.parametrize(
    "stage, wet", [("motion", True), ("motion", False), ("statics", True), ("last statics", False)]
)
@pytest.mark.parametrize("dimensions, end, EI", CASES)
def test_update_solves_the_linearised_box_equations(dimensions, end, EI, stage, wet):
    rng = np.random.default_rng(7)
    for law, stretching, turn in zip(LAWS, (0.0, 2.0, 0.0), TURNS, strict=True):
        turns = directions(rng, turn, dimensions)
        tangents = frames(turns)[[0, -1], 0] if dimensions == 3 else None
        scene = scene_of(dimensions, law, end, wet, EI, stretching, tangents)
        assert_solved(scene, STAGES[stage], *state_of(rng, scene, turns))


@pytest.mark.parametrize("EI", [0.0, 24.0])
@pytest.mark.parametrize("law", ["linear", "tanh"])
def test_with_shock_viscosity(law, EI, dimensions):
    rng = np.random.default_rng(8)
    viscous = {"solver.shock_viscosity": {"quadratic": 1.0, "linear": 0.2}, "solver.integrator": "generalized-alpha"}
    scene = scene_of(dimensions, law, "free", False, EI, **viscous)
    for stage in STAGES.values():
        state = state_of(rng, scene, directions(rng, 0.5, dimensions))
        viscosity = rng.uniform(0.0, [2.0, 40.0], (NODES, 2))
        viscosity[rng.random(NODES) < 0.3] = 0.0
        r, without = (assert_solved(scene, stage, *state, viscosity=v) for v in (viscosity, 0.0 * viscosity))
        if stage[2]:
            assert np.abs(r - without).max() > 1e-3 * np.abs(r).max()


BED = {"stiffness_Npm3": 3e5, "damping_Nspm3": 2e4, "friction": 0.6, "friction_speed_mps": 0.5}
LOW = {"end.kind": "held", "end.position_m": [18.0, 0.0, 0.4], "buoy": None, "waves": None, "floor": BED}


FALLING = {"waves": None, "water.depth_m": 21.0, "buoy.impact_loss": 0.3, **kick(2.0, 0.0, -3.0)}
EXTRAS = {  # scene, and what its record has for the stage: the line is lifted, the bed soft, the buoy at the surface
    "damping": ({"water": None, "waves": None, "tether.damping_Ns": 3e3}, {}),
    "surface": ({"waves": None, "tether.submergence": "free-surface", "tether.diameter_m": 8.0}, {"anchor_z": 8.0}),
    "bed": (LOW, {"anchor_z": -0.1, "bed_onset": 0.5}),
    "buoy in the water by more than half": (CAP | FALLING, {"depth": 20.6}),
    "buoy in the water by less than half": (CAP | FALLING, {"depth": 20.2}),
}


@pytest.mark.parametrize("name", EXTRAS)
@pytest.mark.parametrize("EI", [0.4, 0.0], ids=["bent", "unbent"])
def test_newton_is_quadratic_with_each_law_of_few_scenes(dimensions, EI, name):
    """Still water, a line that moves and turns: nothing is left out of the matrix."""
    changes, record = EXTRAS[name]
    scene = line(changes, {"motion.dimensions": dimensions}, nodes=7, bending_stiffness_Nm2=EI)
    stage, rate, rng = Stage(scene, **record), 40.0, np.random.default_rng(2)
    Y = Motion(scene).Y.copy()
    velocity = slice(dimensions, 2 * dimensions)
    Y[1:, velocity] += rng.normal(0.0, 0.3, (6, dimensions))
    if scene.end.kind == "held":
        Y[-1, velocity] = 0.0
    C_tilde = stage.conserved(Y)
    C_tilde[:, :dimensions] += rng.normal(0.0, 2e-3, (7, dimensions))

    def after(iterations):
        trial = Y.copy()
        _, used = stage.newton(0.0, rate, rate, 1e-40, iterations, trial, C_tilde)
        assert used == iterations or used > 4  # of the later ones rounding is all that is left
        return trial[:, velocity]

    end = after(10)
    errors = [np.abs(after(count) - end).max() for count in range(1, 7)]
    assert errors[0] > 1e-6
    for before, error in pairwise(errors):
        assert error < 40.0 * before**2 + 1e-11, errors
