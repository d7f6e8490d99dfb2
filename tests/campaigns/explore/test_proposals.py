"""A scene with laws that the massless model lacks has the proposals of the scene without these laws."""

import numpy as np
import pytest

import engine
from campaigns.explore.proposals import proposals
from campaigns.machinery.cli import Running
from campaigns.machinery.plan import Plan
from engine.physics.waves import wave_number
from engine.scene import load_scene

COEXISTENCE = {"waves.steepness": 0.106}
DEPTH_M = 21.0
WAVE_NUMBER = wave_number(5.0, DEPTH_M)


@pytest.mark.parametrize(
    "changes",
    [
        pytest.param({"floor.stiffness_Npm3": 1e5, "floor.friction": 0.3}, id="floor"),
        pytest.param({"tether.damping_critical": 0.05}, id="damping"),
        pytest.param({"tether.submergence": "free-surface", "tether.froude_krylov": "whole"}, id="line"),
        pytest.param({"anchor.position_m": [0.0, 0.0, 2.0], "water.depth_m": DEPTH_M + 2.0}, id="raised anchor"),
        pytest.param(
            {"anchor.position_m": [1000.0, 0.0, 0.0], "waves.phase_rad": -1000.0 * WAVE_NUMBER}, id="shifted anchor"
        ),
        pytest.param(
            {"current": {"law": "profile", "height_m": [0, 20, 30], "velocity_mps": [[1, 0, 0], [0, 0, 0], [1, 0, 0]]}},
            id="sheared current",
        ),
    ],
)
def test_a_scene_with_rarer_laws_has_the_proposals_of_the_scene_without_them(tmp_path, changes):
    plan = Plan(Running(tmp_path), engine.simulate, dict, ())
    scenes = [load_scene("tethered_buoy", {**COEXISTENCE, **more}) for more in ({}, changes)]
    plain, like = proposals(plan, scenes, 6.0, 1)
    assert len(plain) == len(like) > 0
    for start, other in zip(plain, like, strict=True):
        np.testing.assert_allclose(other.kick, start.kick, atol=1e-2)
        np.testing.assert_allclose(other.displacement, start.displacement, atol=1e-2)


def test_a_wetted_cap_in_a_current_has_proposals(tmp_path):
    plan = Plan(Running(tmp_path), engine.simulate, dict, ())
    cap = {**COEXISTENCE, "buoy.submergence": "spherical-cap", "current.law": "uniform"}
    scene = load_scene("tethered_buoy", {**cap, "current.velocity_mps": [0.2, 0.0, 0.0]})
    (starts,) = proposals(plan, [scene], 6.0, 1)
    assert starts
