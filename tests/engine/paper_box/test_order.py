"""Order 2 in space and in time: slopes within 0.1, and small errors on the coarsest grid and the longest step."""

from itertools import pairwise

import numpy as np
import pytest

from engine import load_scene, simulate
from tests.engine.lines import linear
from tests.engine.manufactured import motion as motion_of
from tests.engine.manufactured import scene_of

END_S = 1.5
RAMPED = {
    "solver.scheme": "paper-box",
    "solver.newton_tolerance": 1e-9,
    "tether.tension": linear(5e3),
    "tether.nodes": 6,
    "waves.steepness": 0.02,
    "waves.ramp_s": 4.0,
    "water.depth_m": 30.0,
    "output.profiles": True,
}
PLANE = {"current": {"law": "uniform", "velocity_mps": [1.0, 0.0, 0.8]}}
SPACE = {
    "motion.dimensions": 3,
    "current": {"law": "profile", "height_m": [0.0, 30.0], "velocity_mps": [[0.3, -0.5, 0.0], [1.0, 0.8, 0.2]]},
    "waves.direction_rad": 2.0,
}


@pytest.mark.slow
@pytest.mark.parametrize("stretching", [0.0, 1.0])
def test_in_space_towards_a_motion_that_was_chosen_first(stretching):
    errors = []  # per grid: position (m) and strain, at rest and in motion
    for nodes in (11, 21, 41):
        scene = scene_of(END_S, True, nodes, 1 / 64, stretching, scheme="paper-box", newton_tolerance=1e-7)
        run = simulate(scene, duration_s=END_S)
        assert run.status == "ok", run.message
        found = []
        for t, sample in ((0.0, 0), (END_S, -1)):
            exact = motion_of(t, run.profiles.s_m / 20.0, True)[0]
            x, _, z = exact["X"].T
            found.append(np.hypot(run.profiles.x_m[sample] - x, run.profiles.z_m[sample] - z).max())
            found.append(np.abs(run.profiles.strain[sample] - np.linalg.norm(exact["q"], axis=1) + 1).max())
        errors.append([*found, run.statistics["closure_m"], run.statistics["euler_norm_error"]])
    errors = np.array(errors)
    assert errors[0, [0, 2]].max() < 0.03
    assert np.all(np.abs(np.log2(errors[:-1, :4] / errors[1:, :4]) - 2) < 0.1), errors
    # so do, from the coarsest to the finest, what the form does not keep: the length of a bent line, and |beta|
    assert np.all(np.abs(np.log2(errors[0, 4:] / errors[2, 4:]) / 2 - 2) < 0.1), errors


@pytest.mark.slow
@pytest.mark.parametrize("motion", [PLANE, SPACE], ids=["in a plane", "in space"])
def test_in_time(motion):
    ends = []
    for steps in (40, 80, 160, 320):
        scene = load_scene("tethered_buoy", {**RAMPED, **motion, "solver.step_s": 4.0 / steps, "output.step_s": 4.0})
        run = simulate(scene, duration_s=4.0)
        assert run.status == "ok", run.message
        ends.append(np.array([run.columns[axis][-1] for axis in ("x_m", "y_m", "z_m")]))
    differences = [np.abs(fine - coarse) for coarse, fine in pairwise(ends)]
    largest = [difference.max() for difference in differences]
    assert np.all(np.abs(np.log2(np.divide(largest[:-1], largest[1:])) - 2) < 0.1), differences
    assert largest[0] < 2e-3
    if motion is SPACE:
        across = [difference[1] for difference in differences]
        assert np.all(np.abs(np.log2(np.divide(across[:-1], across[1:])) - 2) < 0.1), differences
        assert np.ptp([end[1] for end in ends]) < 1e-3 < abs(ends[-1][1])


def test_in_space_out_of_the_plane():
    """No closed form: differences between grids of 6, 11, 21 and 41 nodes at steps that are the same for all."""
    ends = []
    for nodes in (6, 11, 21, 41):
        scene = load_scene(
            "tethered_buoy", {**RAMPED, **SPACE, "tether.nodes": nodes, "solver.step_s": 0.05, "output.step_s": 3.0}
        )
        run = simulate(scene, duration_s=3.0)
        assert run.status == "ok", run.message
        ends.append(np.array([run.profiles.x_m[-1][-1], run.columns["y_m"][-1], run.profiles.z_m[-1][-1]]))
    differences = [np.abs(fine - coarse).max() for coarse, fine in pairwise(ends)]
    assert np.all(np.abs(np.log2(np.divide(differences[:-1], differences[1:])) - 2) < 0.25), differences
