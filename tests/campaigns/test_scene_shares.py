"""Law: a scene pays for what it has. Counted in floating-point operations of the engine's own kernels, exactly."""

import numpy as np
import pytest

from campaigns.stability.operation_counts import operations
from campaigns.stability.scene_shares import SCENES, TABLE_1, scene_of
from engine import load_scene

WAVES = {"wave_field", "smooth_start", "small_sincos", "small_exponentials", "wave_field_3d"}
CURRENTS = {"current_field", "current_field_3d", "planar_current", "bracket"}
SPACE = {"rotation_vector", "quaternion_product", "frame", "upper_end_3d", "wave_field_3d", "current_field_3d", "lift"}


@pytest.fixture(scope="module")
def counts():
    return {name: operations(scene_of(changes)) for name, changes in SCENES.items()}


def test_counting_is_exact(counts):
    assert operations(scene_of(SCENES[TABLE_1])) == counts[TABLE_1]


def test_what_is_absent_is_not_called(counts):
    called = {name: set(entry["kernels"]) for name, entry in counts.items()}
    for name, kernels in called.items():
        scene = scene_of(SCENES[name])
        space = scene.motion.dimensions == 3
        assert bool(kernels & WAVES) == (scene.waves is not None), name
        assert bool(kernels & CURRENTS) == (scene.current is not None), name
        assert ("sweep_unbent" in kernels) == (scene.tether.bending_stiffness_Nm2 == 0), name
        assert bool(kernels & SPACE) == space, name
        assert "shock_tension" not in kernels


def test_less_in_a_scene_is_less_work(counts):
    newton = {name: entry["newton"] for name, entry in counts.items()}
    whole = newton[TABLE_1]
    assert newton["still water: no waves"] < 0.9 * whole
    assert newton["dry: no water"] < 0.75 * whole
    assert newton["no bending"] < 0.75 * whole
    assert newton["dry, no bending"] < 0.5 * whole
    assert whole < newton["and a current profile"] < 1.1 * whole
    assert newton["three dimensions, no bending"] < newton["three dimensions, dry"] < newton["three dimensions"]
    assert 2.7 * whole < newton["three dimensions"]


def test_dry_scenes_take_no_square_root_and_no_exponential(counts):
    assert counts["dry: no water"]["functions"] == counts["dry, no bending"]["functions"] == 0


def test_profiles_cost_output_and_nothing_else(counts):
    bare, kept = counts[TABLE_1], counts["and profiles kept every 0.05 s"]
    assert kept["newton"] == bare["newton"] and kept["kernels"] == bare["kernels"]
    assert bare["output"] < kept["output"] < 2.1 * bare["output"]


def test_waves_of_no_height_cost_nothing():
    still = operations(load_scene("tethered_buoy", {"waves": None}))
    flat = operations(load_scene("tethered_buoy", {"waves.steepness": 0.0}))
    assert flat["newton"] == still["newton"]


@pytest.mark.parametrize("dimensions", [2, 3])
def test_work_is_linear_in_nodes(dimensions):
    grids = np.array([21, 41, 81, 161])
    found = [
        operations(load_scene("tethered_buoy", {"tether.nodes": int(nodes), "motion.dimensions": dimensions}))["newton"]
        for nodes in grids
    ]
    per_node = np.diff(found) / np.diff(grids)
    assert per_node.max() < 1.02 * per_node.min()


def test_shock_viscosity_is_paid_for_by_those_who_ask():
    shocked = operations(load_scene("tethered_buoy", {"solver.shock_viscosity": {}}))
    assert "shock_tension" in shocked["kernels"]
