"""Both schemes have one limit: at kA = 0.016 their difference falls as h^2 and dt^2 together, to micrometres.

That takes true accelerations in Morison's force; the component rates of the print move the buoy by less than 1 um here.
"""

import numpy as np
import pytest

from engine import load_scene, simulate
from engine.paper_box import run

LENGTH_S = 5.0
SMALL = {"waves.steepness": 0.016, "water.depth_m": 22.5, "output.step_s": 0.1}


def scene_of(**overrides):
    return load_scene("tethered_buoy", {**SMALL, **overrides})


def path(trajectory):
    assert trajectory.status == "ok", trajectory.message
    return np.array([trajectory.columns["x_m"], trajectory.columns["z_m"]])


@pytest.fixture(scope="module")
def limit():
    return path(simulate(scene_of(**{"tether.nodes": 161, "solver.rtol": 1e-5}), duration_s=LENGTH_S))


def boxed(nodes, step_s, accelerations):
    scene = scene_of(**{"tether.nodes": nodes, "solver.step_s": step_s, "solver.scheme": "paper-box"})
    return path(run(scene, LENGTH_S, accelerations=accelerations))


@pytest.mark.slow
def test_the_difference_from_the_conservation_form_falls_at_order_two(limit):
    errors = np.array(
        [np.abs(boxed(*grid, True) - limit).max(1) for grid in ((6, 0.1), (11, 0.05), (21, 0.025), (41, 0.0125))]
    )
    assert np.all(np.abs(np.log2(errors[:-1] / errors[1:]) - 2) < 0.1), errors
    assert errors[0].max() < 1.2e-3 and errors[-1].max() < 2e-5


def test_component_rates_matter_little():
    assert 1e-9 < np.abs(boxed(11, 0.05, True) - boxed(11, 0.05, False)).max() < 1e-6
