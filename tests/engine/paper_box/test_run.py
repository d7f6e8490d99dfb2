"""solver.scheme = "paper-box" from the outside: an ordinary trajectory, or a fault of the scene."""

import numpy as np
import pytest

from engine import SceneError, Trajectory, load_scene, simulate, simulate_batch
from engine.paper_box import run
from engine.paper_box.frame import TO_PAPER, parameters_of, rotation, to_fixed
from engine.paper_box.line import line_of
from engine.paper_box.start import from_space, lifted, planar_guess
from engine.paper_box.water import positions

SMALL = {"solver.scheme": "paper-box", "waves.steepness": 0.016, "tether.nodes": 7, "solver.step_s": 0.05}


def scene_of(**overrides):
    return load_scene("tethered_buoy", {**SMALL, **overrides})


def test_a_file_keeps_it_whole(tmp_path):
    told = []
    scene = scene_of(**{"output.profiles": True, "solver.step_s": 0.0125})
    found = run(scene, 2.0, told.append)
    found.save(tmp_path / "run.nc")
    back = Trajectory.load(tmp_path / "run.nc")
    assert back.scene == scene and back.statistics == found.statistics
    assert all(np.array_equal(back.columns[name], found.columns[name]) for name in found.columns)
    assert np.array_equal(back.profiles.strain, found.profiles.strain)
    assert len(back.columns["time_s"]) == 41 and told == sorted(told) and 0 < told[-1] <= 1


def test_rates_and_angles_belong_to_the_positions():
    columns = simulate(scene_of(**{"output.step_s": 0.05}), duration_s=3.0).columns
    t = columns["time_s"]
    for value, rate in (("radius_m", "radius_rate_mps"), ("angle_rad", "angle_rate_radps")):
        by_differences = (columns[value][2:] - columns[value][:-2]) / (t[2:] - t[:-2])
        assert np.abs(by_differences - columns[rate][1:-1]).max() < 0.01 * np.ptp(columns[rate])
    assert np.all(columns["tension_top_low_N"] <= columns["tension_top_N"])
    assert np.all(columns["tension_top_high_N"] >= columns["tension_top_N"])


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


@pytest.mark.parametrize("key, value", [("tether.bending_stiffness_Nm2", 0.0), ("output.tangent_vectors", 1)])
def test_scenes_that_it_cannot_do(key, value):
    with pytest.raises(SceneError, match=key):
        scene_of(**{key: value})


def test_nothing_twists_a_line_with_torque_free_ends():
    """Omega_1 = 0 in space: with the torsion of a rigid rod the motion is the same."""
    aside = {"motion.dimensions": 3, "start.buoy_velocity_mps": [0.4, 0.3, -0.1], "solver.newton_tolerance": 1e-10}
    soft, stiff = (
        simulate(scene_of(**aside, **{"tether.torsion_stiffness_Nm2": GIp}), duration_s=2.5) for GIp in (0.0, 40.0)
    )
    assert soft.status == stiff.status == "ok" and np.ptp(soft.columns["y_m"]) > 0.1
    for name in ("x_m", "y_m", "z_m", "tension_top_N"):
        assert np.abs(soft.columns[name] - stiff.columns[name]).max() < 1e-8 * np.abs(soft.columns[name]).max()


@pytest.mark.parametrize("azimuth", [0.0, 2.0])
def test_frames_of_the_engine_and_of_the_paper(azimuth):
    """A planar equilibrium lifted at an azimuth, and the same given in the engine's axes, is one shape."""
    scene = scene_of(**{"motion.dimensions": 3, "current": {"law": "uniform", "velocity_mps": [1.0, 0.0, 0.0]}})
    line = line_of(scene)
    code, flat = planar_guess(scene, line)
    assert code == 0
    Y6 = np.zeros((7, 6))
    a = 2 * np.arctan2(flat[9], flat[6])
    Y6[:, 0], Y6[:, 1], Y6[:, 4], Y6[:, 5] = flat[0], -flat[1], np.pi / 2 - a, -flat[12]
    found = lifted(Y6, azimuth)
    up, along, across = positions(line, found)
    flat_up, flat_along, _ = positions(line, flat)
    assert np.allclose([up, along, across], [flat_up, flat_along * np.cos(azimuth), flat_along * np.sin(azimuth)])
    rng = np.random.default_rng(1)
    found[3:6] = rng.normal(0, 1, (3, 7))
    velocity = to_fixed(found[6:10], found[3:6])
    given = found.copy()
    to_engine = np.argsort(TO_PAPER)
    given[6:10] = parameters_of(rotation(found[6:10])[:, to_engine])
    given[3:6] = velocity[to_engine]
    back = from_space(given.T)
    assert np.allclose(rotation(back[6:10]), rotation(found[6:10]))
    assert np.allclose(np.delete(back, slice(6, 10), 0), np.delete(found, slice(6, 10), 0))
