"""Runs that go side by side are the runs alone, bit for bit, whatever else is in the batch and however it goes.

A batch goes through the lanes of vectors where the engine can (`engine.simd`); `simulate` alone goes through numbers.
"""

import numpy as np
import pytest

from engine import goes_in_lanes, load_scene, simulate, simulate_batch, simulate_each
from engine.time.status import WORDS
from tests.engine.simd.test_batches import assert_equal

STEEP = {"water.depth_m": 21.6, "waves.steepness": 0.13, "tether.nodes": 21}
CARRIED = {"output.tangent_vectors": 2, "output.lateral_growth": True}
KINDS = {  # what every lane has in common
    "the shipped scene": {"tether.nodes": 41},
    "an even number of nodes": {"tether.nodes": 20},
    "TR-BDF2, stretched grid": {"solver.integrator": "trbdf2", "tether.grid_stretching": 1.5},
    "fixed steps": {"solver.step_s": 0.01},
    "a current, wheeler": {
        "current": {"law": "uniform", "velocity_mps": [0.4, 0.0, 0.1]},
        "waves.above_still_water": "wheeler",
    },
    "dry above the surface, against x, a ramp": {
        "waves.above_still_water": "zero",
        "waves.direction_rad": np.pi,
        "waves.ramp_s": 7.0,
    },
    "a tanh law with a barrier": {
        "tether.tension": {"law": "tanh", "p": [2.0e4, 5.0, 0.0, 0.0, 1.0e4]},
        "tether.compression_barrier_N": 50.0,
    },
    "no bending, small waves": {"tether.bending_stiffness_Nm2": 0.0, "waves.steepness": 0.02},
    "no waves, a kick": {"waves": None, "start.buoy_velocity_mps": [1.5, 0.0, 0.5]},
    "in air": {"water": None, "waves": None, "start.buoy_velocity_mps": [2.0, 0.0, -1.0]},
}


def lots(base, values=(0.05, 0.08, 0.1, 0.13, 0.16), key="waves.steepness"):
    """Scenes that differ in one value."""
    return [load_scene("tethered_buoy", STEEP | base | {key: value}) for value in values]


def assert_same_growth(one, other):
    assert np.array_equal(one.tangent.growth_nats, other.tangent.growth_nats)
    assert np.array_equal(one.tangent.released, other.tangent.released)
    assert np.array_equal(one.tangent.lateral_nats, other.tangent.lateral_nats)


@pytest.mark.parametrize("kind", KINDS)
def test_a_lane_is_the_run_alone(kind):
    """Over the first loops of the steep ones (t = 53 s), with samples at times of their own."""
    varied = "tether.drag_normal" if KINDS[kind].get("waves", 1) is None or "steepness" in str(KINDS[kind]) else None
    scenes = lots(KINDS[kind], (0.8, 1.0, 1.3), varied) if varied else lots(KINDS[kind])
    assert all(goes_in_lanes(scene) for scene in scenes)
    for scene, run in zip(scenes, simulate_batch(scenes, duration_s=63.3), strict=True):
        assert run.status == "ok"
        assert_equal(run, simulate(scene, duration_s=63.3))


def test_loops_are_released_in_lanes_too():
    runs = simulate_batch(lots({}), duration_s=63.3)
    assert sum(run.statistics["loop_releases"] for run in runs) >= 1
    assert sum(run.statistics["newton_failures"] for run in runs) >= 1
    assert sum(run.statistics["rejected_steps"] for run in runs) >= 1


@pytest.mark.parametrize("carried", [CARRIED, {"output.tangent_vectors": 1}, {"output.lateral_growth": True}])
def test_perturbations_in_lanes_are_those_of_the_run_alone(carried):
    scenes = lots(carried | {"tether.nodes": 11}, (0.05, 0.1, 0.13))
    for scene, run in zip(scenes, simulate_batch(scenes, duration_s=61.0), strict=True):
        alone = simulate(scene, duration_s=61.0)
        assert_equal(run, alone)
        if alone.tangent.lateral_nats is None:
            assert np.array_equal(run.tangent.growth_nats, alone.tangent.growth_nats)
        else:
            assert_same_growth(run, alone)
        assert len(alone.tangent.released) == 12 and np.isfinite(alone.tangent.growth_nats).all()


def test_neither_order_nor_company_matters():
    """More runs than lanes, of different lengths and kinds: a lane takes what comes when it is free."""
    scenes = lots({"tether.nodes": 11}, np.linspace(0.02, 0.16, 11)) + lots({}, (0.1, 0.12))
    lengths = {"duration_s": 21.0}
    first = simulate_batch(scenes, **lengths)
    order = np.random.default_rng(3).permutation(len(scenes))
    again = simulate_batch([scenes[i] for i in order], **lengths)
    for place, i in enumerate(order):
        assert_equal(again[place], first[i])
    for i in (0, 5, 12):
        assert_equal(simulate(scenes[i], **lengths), first[i])


def test_runs_of_different_lengths_share_a_batch():
    """Lengths follow from each scene's own wave period."""
    scenes = lots({}, (4.0, 5.0, 6.0), "waves.period_s")
    for scene, run in zip(scenes, simulate_batch(scenes, periods=9), strict=True):
        assert run.columns["time_s"][-1] == pytest.approx(9 * scene.waves.period_s, abs=scene.sample_step_s())
        assert_equal(run, simulate(scene, periods=9))


ENDINGS = {  # status word -> what makes a run of the batch end so
    "turn-unresolved": {"solver.max_loop_releases": 0},
    "step-underflow": {"solver.rtol": 1e-7, "solver.min_step_s": 0.01},
    "step-limit": {"solver.rtol": 1e-14, "solver.newton_tolerance": 1e-14, "tether.nodes": 21},
    "newton-failed": {"solver.min_step_s": 0.01, "solver.max_newton_iterations": 2},
    "not-finite": {"tether.tension.stiffness_N": 100.0, "waves.period_s": 1.0},
    "strain-below-minus-one": {"start.buoy_velocity_mps": [0.0, 0.0, -900.0]},
    "statics-failed": {"buoy.mass_kg": 1e30},
}


@pytest.mark.parametrize("word", ENDINGS)
def test_a_run_that_ends_early_disturbs_no_other(word):
    nodes = {"tether.nodes": ENDINGS[word].get("tether.nodes", 41)}
    good = lots(nodes, (0.1, 0.13, 0.15))
    lost = load_scene("tethered_buoy", STEEP | nodes | ENDINGS[word])
    runs = simulate_batch([good[0], lost, *good[1:]], duration_s=60.0)
    alone = simulate(lost, duration_s=60.0)
    assert alone.status == word
    assert_equal(runs[1], alone)
    for scene, run in zip(good, [runs[0], *runs[2:]], strict=True):
        assert run.status == "ok"
        assert_equal(run, simulate(scene, duration_s=60.0))


def test_the_endings_are_all_there_are():
    """Of planar runs in the engine's own scheme; tension-flat and shape-lost are the paper's."""
    assert set(ENDINGS) == set(WORDS.values()) - {"ok", "tension-flat", "shape-lost"}


def test_runs_come_as_they_end():
    """A run that ends early is handed out while the others go on, and one in a lane of its own waits for none."""
    short = load_scene("tethered_buoy", STEEP | {"tether.nodes": 11, "solver.max_loop_releases": 0})
    scenes = [*lots({"tether.nodes": 11}, (0.05, 0.08, 0.1)), short]
    order = [i for i, _ in simulate_each(scenes, duration_s=150.0)]
    assert order[0] == 3 and sorted(order) == [0, 1, 2, 3]


@pytest.mark.parametrize(
    "change",
    [
        {"motion.dimensions": 3},
        {"output.profiles": True},
        {"solver.integrator": "midpoint"},
        {"solver.scheme": "paper-box", "solver.step_s": 0.01},
        {"tether.tension": {"law": "tabulated", "strain": [-0.2, 0.0, 0.1], "tension_N": [-5e3, 0.0, 5e3]}},
        {"buoy": None, "end.kind": "held", "end.position_m": [3.0, 0.0, 19.0]},
    ],
)
def test_what_the_lanes_do_not_cover_stays_out(change):
    assert not goes_in_lanes(load_scene("tethered_buoy", STEEP | change))
