"""solver.scheme = "paper-box" from the outside: an ordinary trajectory, or a fault of the scene.

Where the scheme fails it stops, says why, and keeps finite samples up to there.
"""

import math

import numpy as np
import pytest

from engine import SceneError, load_scene, simulate, simulate_batch
from engine.paper_box.driver import run
from engine.paper_box.line import line_of
from engine.paper_box.nodal import positions
from engine.paper_box.start import lifted

SMALL = {"solver.scheme": "paper-box", "waves.steepness": 0.016, "tether.nodes": 7, "solver.step_s": 0.05}
SNAP = {"solver.scheme": "paper-box", "waves.steepness": 0.13, "water.depth_m": 21.6}


def scene_of(**overrides):
    return load_scene("tethered_buoy", {**SMALL, **overrides})


def test_progress_is_told_and_every_sample_is_there():
    told = []
    found = run(scene_of(**{"output.profiles": True, "solver.step_s": 0.0125}), 2.0, told.append)
    assert len(found.columns["time_s"]) == 41 and found.profiles.strain.shape == (41, 7)
    assert told == sorted(told) and 0 < told[-1] <= 1


def test_samples_between_steps():
    """Steps that do not divide the samples: interpolated, to the error of the steps."""
    even = simulate(scene_of(**{"output.step_s": 0.1}), duration_s=2.0)
    odd = simulate(scene_of(**{"output.step_s": 0.1, "solver.step_s": 0.03}), duration_s=2.0)
    assert np.array_equal(even.columns["time_s"], odd.columns["time_s"])
    assert np.abs(even.columns["radius_m"] - odd.columns["radius_m"]).max() < 2e-3


def test_a_batch_may_mix_schemes():
    scenes = [scene_of(), scene_of(**{"solver.scheme": "conservation"})]
    boxed, conserved = simulate_batch(scenes, duration_s=1.0)
    assert "closure_m" in boxed.statistics and "closure_m" not in conserved.statistics
    assert np.abs(boxed.columns["radius_m"] - conserved.columns["radius_m"]).max() < 1e-3


def test_a_tether_without_bending_is_refused():
    with pytest.raises(SceneError, match=r"tether\.bending_stiffness_Nm2"):
        scene_of(**{"tether.bending_stiffness_Nm2": 0.0})


def test_nothing_twists_a_line_with_torque_free_ends():
    """Omega_1 = 0 in space: with the torsion of a rigid rod the motion is the same."""
    aside = {"motion.dimensions": 3, "start.buoy_velocity_mps": [0.4, 0.3, -0.1], "solver.newton_tolerance": 1e-10}
    soft, stiff = (
        simulate(scene_of(**aside, **{"tether.torsion_stiffness_Nm2": GIp}), duration_s=2.5) for GIp in (0.0, 40.0)
    )
    assert soft.status == stiff.status == "ok" and np.ptp(soft.columns["y_m"]) > 0.1
    for name in ("x_m", "y_m", "z_m", "tension_top_N"):
        assert np.abs(soft.columns[name] - stiff.columns[name]).max() < 1e-8 * np.abs(soft.columns[name]).max()


def test_a_planar_equilibrium_is_turned_to_any_azimuth():
    scene = scene_of(**{"motion.dimensions": 3, "current": {"law": "uniform", "velocity_mps": [1.0, 0.0, 0.0]}})
    line, leaning = line_of(scene), np.zeros((scene.tether.nodes, 6))
    leaning[:, 4] = np.linspace(1.4, 0.3, len(leaning))
    up, along, _ = positions(line, lifted(leaning))
    assert np.ptp(along) > 5.0
    assert np.allclose(positions(line, lifted(leaning, 2.0)), [up, along * np.cos(2.0), along * np.sin(2.0)])


@pytest.mark.slow
def test_turns_that_the_nodes_do_not_resolve():
    """With the other guard away the turns reach the bound next; both numbers are in the statistics."""
    scene = load_scene("tethered_buoy", {**SNAP, "tether.nodes": 21, "solver.step_s": 0.005})
    found = run(scene, 8.0, most_gap=math.inf)
    assert found.status == "turn-unresolved"
    assert found.statistics["max_turn_rad"] > math.pi / 2 and found.statistics["closure_m"] > 0.2
    assert f"{found.statistics['max_turn_rad']:.3g} rad" in found.message
