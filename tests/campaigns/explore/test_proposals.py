"""A scene with laws that the massless model lacks has the proposals of the scene without these laws."""

import numpy as np
import pytest

import engine
from campaigns.explore.proposals import proposals
from campaigns.machinery.cli import Running
from campaigns.machinery.plan import Plan
from engine.physics.waves import wave_number
from engine.scene import build_scene, load_scene
from tests.engine.time.test_similarity import MODEL, factor, in_other_units

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


def test_the_kicks_of_a_model_are_those_of_its_prototype(tmp_path):
    """By Froude's law, as their speeds without --kick-speed."""
    plan = Plan(Running(tmp_path), engine.simulate, dict, ())
    scene = load_scene("tethered_buoy", COEXISTENCE)
    model = build_scene(in_other_units(scene.as_dict(), MODEL))
    starts, of_model = proposals(plan, [scene, model], None, 1)
    assert len(starts) == len(of_model) > 0
    for start, other in zip(starts, of_model, strict=True):
        np.testing.assert_allclose(np.array(other.kick) / factor("m/s", MODEL), start.kick, rtol=1e-3)
        np.testing.assert_allclose(np.array(other.displacement) / factor("m", MODEL), start.displacement, rtol=1e-3)
