"""Order 2 in space: slopes within 0.1, small errors on the coarsest grid (in time: `tests/engine/time/test_order.py`).

Both schemes have one limit: at kA = 0.016 their difference falls as h^2 and dt^2 together, to micrometres. That takes
true accelerations in Morison's force; the component rates of the print move the buoy by less than 1 um here.
"""

import numpy as np
import pytest

from engine import load_scene, simulate
from engine.paper_box import run as run_boxed
from tests.engine.lines import linear
from tests.engine.manufactured import motion as motion_of
from tests.engine.manufactured import scene_of

END_S = 1.5
CALM_S = 5.0
CALM = {"waves.steepness": 0.016, "water.depth_m": 22.5, "output.step_s": 0.1}
SPACE = {
    "solver.scheme": "paper-box",
    "solver.newton_tolerance": 1e-9,
    "tether.tension": linear(5e3),
    "waves.steepness": 0.02,
    "waves.ramp_s": 4.0,
    "water.depth_m": 30.0,
    "motion.dimensions": 3,
    "current": {"law": "profile", "height_m": [0.0, 30.0], "velocity_mps": [[0.3, -0.5, 0.0], [1.0, 0.8, 0.2]]},
    "waves.direction_rad": 2.0,
}


def slopes(errors):
    """Orders of convergence between errors on grids or steps that are halved."""
    return np.log2(np.divide(errors[:-1], errors[1:]))


def path(run):
    """Places (3, samples) of the buoy, m."""
    assert run.status == "ok", run.message
    return np.array([run.columns[axis] for axis in ("x_m", "y_m", "z_m")])


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
    assert np.all(np.abs(slopes(errors[:, :4]) - 2) < 0.1), errors
    # so do, from the coarsest to the finest, what the form does not keep: the length of a bent line, and |beta|
    assert np.all(np.abs(slopes(errors[::2, 4:]) / 2 - 2) < 0.1), errors


def test_in_space_out_of_the_plane():
    """No closed form: differences between grids of 6, 11, 21 and 41 nodes at steps that are the same for all."""
    ends = []
    for nodes in (6, 11, 21, 41):
        steps = {"tether.nodes": nodes, "solver.step_s": 0.05, "output.step_s": 3.0}
        ends.append(path(simulate(load_scene("tethered_buoy", {**SPACE, **steps}), duration_s=3.0))[:, -1])
    differences = np.abs(np.diff(ends, axis=0)).max(1)
    assert np.all(np.abs(slopes(differences) - 2) < 0.25), differences


def calm(nodes, step_s, accelerations):
    scheme = {"tether.nodes": nodes, "solver.step_s": step_s, "solver.scheme": "paper-box"}
    return path(run_boxed(load_scene("tethered_buoy", {**CALM, **scheme}), CALM_S, accelerations=accelerations))


@pytest.mark.slow
def test_the_difference_from_the_conservation_form_falls_at_order_two():
    fine = load_scene("tethered_buoy", {**CALM, "tether.nodes": 161, "solver.rtol": 1e-5})
    limit = path(simulate(fine, duration_s=CALM_S))
    grids = ((6, 0.1), (11, 0.05), (21, 0.025), (41, 0.0125))
    errors = np.array([np.abs(calm(*grid, True) - limit).max(1)[[0, 2]] for grid in grids])
    assert np.all(np.abs(slopes(errors) - 2) < 0.1), errors
    assert errors[0].max() < 1.2e-3 and errors[-1].max() < 2e-5


def test_component_rates_matter_little():
    assert 1e-9 < np.abs(calm(11, 0.05, True) - calm(11, 0.05, False)).max() < 1e-6
