"""A batch is its members, each on its own: the same bits as single runs, whatever the others are or do."""

from itertools import pairwise

import numpy as np
import pytest

from engine import load_scene, simulate
from engine.run import Run
from engine import simulate_batch

STEEP = {"waves.steepness": 0.13, "water.depth_m": 21.6}
MEMBERS = [
    {**STEEP},
    {**STEEP, "tether.nodes": 21, "waves.period_s": 4.0, "solver.integrator": "trbdf2"},
    {
        **STEEP,
        "tether.nodes": 61,
        "tether.grid_stretching": 1.5,
        "output.profiles": True,
        "output.profiles_step_s": 1.0,
    },
    {**STEEP, "tether.tension": {"law": "tanh", "p": [2.0e4, 5.0, 0.0, 0.0, 1.0e4]}, "solver.integrator": "midpoint"},
    {
        **STEEP,
        "tether.tension": {"law": "tabulated", "strain": [-0.2, 0.0, 0.1], "tension_N": [-5e3, 0.0, 5e3]},
        "waves.above_still_water": "wheeler",
    },
    {
        **STEEP,
        "current": {"law": "profile", "height_m": [0.0, 30.0], "velocity_mps": [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]},
        "solver.integrator": "generalized-alpha",
        "waves.direction_rad": np.pi,
    },
    {**STEEP, "tether.bending_stiffness_Nm2": 0.0, "waves.steepness": 0.02, "output.step_s": 0.11},
    {**STEEP, "waves.ramp_s": 5.0, "solver.integrator": "backward-euler", "output.profiles": True},
]
DRY = [
    {"water": None, "waves": None, "start.buoy_velocity_mps": [1.0, 0.0, 0.0]},
    {"waves": None, "buoy": None, "end.kind": "held", "end.position_m": [12.0, 0.0, 5.0]},
    {
        "water": None,
        "waves": None,
        "buoy": None,
        "end.kind": "free",
        "end.force_N": [50.0, 0.0, 80.0],
        "tether.bending_stiffness_Nm2": 0.0,
        "solver.integrator": "trbdf2",
        "tether.nodes": 7,
    },
]
LOSER = {**STEEP, "tether.tension": {"law": "tabulated", "strain": [-0.5, 0.0, 0.1], "tension_N": [0.0, 0.0, 5000.0]}}
# a law that yields at half the lift of the buoy
UNSETTLED = {"tether.tension": {"law": "tanh", "p": [1000.0, 10.0, 0.0, 0.0, 0.0]}}


def scenes_of(members):
    return [load_scene("tethered_buoy", member) for member in members]


def assert_equal(one, other):
    """Everything but the time it took, bit for bit."""
    assert one.status == other.status and one.message == other.message and one.scene == other.scene
    for name, column in one.columns.items():
        assert np.array_equal(column, other.columns[name]), name
    for name, value in one.statistics.items():
        if name != "wall_s":
            assert value == other.statistics[name], name
    assert (one.profiles is None) == (other.profiles is None)
    if one.profiles is not None:
        for name, values in vars(one.profiles).items():
            assert np.array_equal(values, getattr(other.profiles, name)), name


@pytest.mark.parametrize("first", [0, 1, 6])
def test_members_in_waves_equal_single_runs(first):
    """Long enough for several calls of the kernel, whose lengths follow the first member."""
    scenes = scenes_of(MEMBERS[first:] + MEMBERS[:first])
    runs = simulate_batch(scenes, periods=12.5)
    for scene, run in zip(scenes, runs, strict=True):
        assert run.status == "ok"
        assert_equal(run, simulate(scene, periods=12.5))
        # periods count in each member's own waves
        assert run.columns["time_s"][-1] == pytest.approx(12.5 * scene.waves.period_s, abs=scene.sample_step_s())


def test_wet_and_dry_members_equal_single_runs():
    scenes = scenes_of([*MEMBERS[:3], *DRY])
    for scene, run in zip(scenes, simulate_batch(scenes, duration_s=12.0), strict=True):
        assert run.status == "ok"
        assert_equal(run, simulate(scene, duration_s=12.0))


def test_a_member_that_fails_disturbs_no_other():
    scenes = scenes_of([MEMBERS[0], LOSER, MEMBERS[1], UNSETTLED, MEMBERS[2]])
    runs = simulate_batch(scenes, periods=7)
    assert [run.status == "ok" for run in runs] == [True, False, True, False, True]
    assert runs[1].status == "strain-below-minus-one" and runs[3].status == "statics-failed"
    assert 0 < len(runs[1].columns["time_s"]) < 701 and len(runs[3].columns["time_s"]) == 0
    for scene, run in zip(scenes, runs, strict=True):
        assert_equal(run, simulate(scene, periods=7))


def test_two_equal_members_are_equal():
    """61 wave periods of a motion that amplifies rounding: nothing is shared, nothing is random."""
    scene = load_scene("tethered_buoy", STEEP)
    one, other = simulate_batch([scene, scene], periods=61)
    assert_equal(one, other)


@pytest.mark.parametrize("chunk", [1, 7, 1000, 10**6])
def test_chunks_do_not_change_the_result(chunk):
    scene = load_scene("tethered_buoy", {**STEEP, "output.profiles": True})
    batch = Run(scene, 60.0)
    while not batch.done():
        batch.advance(chunk)
    assert_equal(batch.trajectory(), simulate(scene, duration_s=60.0))


def test_progress_rises_to_one():
    for members, periods in (([STEEP], 65), (MEMBERS[:3], 31), ([STEEP, LOSER], 31)):
        seen = []
        simulate_batch(scenes_of(members), periods=periods, progress=seen.append)
        assert len(seen) >= 3
        assert all(0 < a <= b <= 1 for a, b in pairwise(seen)) and seen[0] < seen[-1] == 1.0


def test_progress_does_not_change_the_result():
    scene = load_scene("tethered_buoy", STEEP)
    assert_equal(simulate(scene, periods=25, progress=lambda fraction: None), simulate(scene, periods=25))


def test_an_exception_from_progress_comes_through():
    """Ctrl-C is one."""

    def stop(fraction):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        simulate(load_scene("tethered_buoy", STEEP), periods=25, progress=stop)


def test_an_empty_batch_is_empty():
    assert simulate_batch([], duration_s=1.0) == []


@pytest.mark.parametrize(
    "length", [{}, {"periods": 1, "duration_s": 1.0}, {"duration_s": 0.0}, {"periods": -1}, {"duration_s": np.inf}]
)
def test_bad_run_lengths_raise(length):
    with pytest.raises(ValueError):
        simulate(load_scene("tethered_buoy", STEEP), **length)


def test_periods_need_waves():
    with pytest.raises(ValueError, match="waves"):
        simulate(load_scene("tethered_buoy", {"waves": None}), periods=1)
