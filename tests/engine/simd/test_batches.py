"""Law: a run in a batch is the run alone, bit for bit, whatever the others are or do, and however it goes.

A batch goes through the lanes of vectors where the engine can (`engine.simd`), run by run elsewhere; `simulate` alone
goes through numbers.
"""

from itertools import pairwise

import numpy as np
import pytest

from engine import goes_in_lanes, simulate, simulate_batch, simulate_each
from engine.run import Run
from engine.run.batch import kind_of
from engine.time.status import WORDS
from tests.engine.lines import DRY, SEA, STILL, assert_same, free, held, kick, line, ran, uniform
from tests.engine.physics.caps import CAP

STEEP = {"waves.steepness": 0.13, "water.depth_m": 21.6}
CARRIED = {"output.tangent_vectors": 2, "output.lateral_growth": True}
TABLE = {"law": "tabulated", "strain": [-0.2, 0.0, 0.1], "tension_N": [-5e3, 0.0, 5e3]}
TANH = {"law": "tanh", "p": [2.0e4, 5.0, 0.0, 0.0, 1.0e4]}
PROFILE = {"law": "profile", "height_m": [0.0, 30.0], "velocity_mps": [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]}
GRID = {"tether.nodes": 61, "tether.grid_stretching": 1.5}
SLACK = {**CAP, "tether.length_m": 30.0, "tether.density_kgpm3": 1400.0}
BED = {"floor.stiffness_Npm3": 1e4, "floor.damping_Nspm3": 600.0, "floor.friction": 0.3}
UNBENT = {"tether.bending_stiffness_Nm2": 0.0}
MIXED = [  # scenes that share a batch, though not all of them lanes
    {},
    {"tether.nodes": 21, "waves.period_s": 4.0, "solver.integrator": "trbdf2"},
    {**GRID, "output.profiles": True, "output.profiles_step_s": 1.0},
    {"tether.tension": TANH, "solver.integrator": "midpoint"},
    {"tether.tension": TABLE, "waves.above_still_water": "wheeler"},
    {"current": PROFILE, "solver.integrator": "generalized-alpha", "waves.direction_rad": np.pi},
    {**UNBENT, "waves.steepness": 0.02, "output.step_s": 0.11},
    {"waves.ramp_s": 5.0, "solver.integrator": "backward-euler", "output.profiles": True},
    {**DRY, **kick(1.0)},
    STILL | held(12.0, 5.0),
    {**DRY, **free(50.0, 80.0), **UNBENT, "solver.integrator": "trbdf2", "tether.nodes": 7},
]
KINDS = {  # what every lane has in common
    "the shipped scene": {"tether.nodes": 41},
    "TR-BDF2, stretched grid": {"solver.integrator": "trbdf2", "tether.grid_stretching": 1.5},
    "fixed steps, an even number of nodes": {"tether.nodes": 20, "solver.step_s": 0.01},
    "a stiff line that rings": {"tether.tension.stiffness_N": 1e7, "tether.nodes": 11},
    "ringing that is damped": {"tether.tension.stiffness_N": 1e7, "tether.nodes": 11, "solver.shortest_period_s": 10.0},
    "a current, wheeler, a tanh law with a barrier": {
        **uniform(0.4, 0.0, 0.1), "waves.above_still_water": "wheeler", "tether.tension": TANH,
        "tether.compression_barrier_N": 50.0,
    },
    "dry above the surface, against x, a ramp": {
        "waves.above_still_water": "zero", "waves.direction_rad": np.pi, "waves.ramp_s": 7.0,
    },
    "no bending, small waves": {**UNBENT, "waves.steepness": 0.02},
    "no waves, a kick": {**STILL, **kick(1.5, 0.0, 0.5)},
    "in air": {**DRY, **kick(2.0, 0.0, -1.0)},
    "perturbations": {"tether.nodes": 11, **CARRIED},
    "in and out of the water": {"tether.nodes": 11, **CARRIED, **CAP, "water.depth_m": 21.0},
    "the same, wheeler": {"tether.nodes": 11, **CAP, "water.depth_m": 21.0, "waves.above_still_water": "wheeler"},
    "a sea": {"tether.nodes": 11, **SEA},
    "a sea, in and out of the water": {"tether.nodes": 11, **SEA, **CAP, "output.tangent_vectors": 1},
    "on the bed": {"tether.nodes": 11, **SLACK, **BED, "output.tangent_vectors": 1},
    "on the bed, at the surface, a raised anchor, the whole push": {
        "tether.nodes": 11, **SLACK, **BED, **CARRIED, "tether.submergence": "free-surface",
        "tether.froude_krylov": "whole", "anchor.position_m": [2.0, 0.0, 0.5],
    },
    "a tangent vector": {"tether.nodes": 11, "output.tangent_vectors": 1},
    "lateral growth": {"tether.nodes": 11, "output.lateral_growth": True},
}  # fmt: skip
ENDINGS = {  # status word -> what makes a run of the batch end so
    "turn-unresolved": {"solver.max_loop_releases": 0},
    "step-underflow": {"solver.rtol": 1e-7, "solver.min_step_s": 0.01},
    "step-limit": {"solver.rtol": 1e-14, "solver.newton_tolerance": 1e-14, "tether.nodes": 21},
    "newton-failed": {"solver.min_step_s": 0.01, "solver.max_newton_iterations": 2},
    "not-finite": {"start.buoy_displacement_m": [0.0, 0.0, 190.0], "waves.period_s": 1.0},
    "strain-below-minus-one": kick(w=-900.0),
    "statics-failed": {"buoy.mass_kg": 1e30},
}


def steep(*parts):
    changes = dict(STEEP)
    for part in parts:
        changes |= part
    return line(changes)


def lots(base, values=(0.05, 0.1, 0.13, 0.16), key="waves.steepness"):
    """Scenes that differ in one value."""
    return [steep({"tether.nodes": 21}, base, {key: value}) for value in values]


def assert_alone(scenes, runs, **length):
    for scene, run in zip(scenes, runs, strict=True):
        assert_same(run, ran(scene, **length))


def test_a_mixed_batch():
    scenes = [steep(member) for member in MIXED]
    assert_alone(scenes, simulate_batch(scenes, duration_s=30.0), duration_s=30.0)


TAKES_LONG = "the same, wheeler", "in and out of the water", "a sea", "a sea, in and out of the water"
NAMES = [pytest.param(name, marks=[pytest.mark.slow] * (name in TAKES_LONG)) for name in KINDS]


def scenes_of(kind):
    """Scenes of a kind: of other seas, of lines with other drag where the waves are those of the kind, or in other
    waves."""
    changes = KINDS[kind]
    if "sea" in kind:
        return lots(changes, (1, 2, 3), "waves.jonswap.seed")
    if "waves.steepness" in changes or "waves" in changes:
        return lots(changes, (0.8, 1.0, 1.3), "tether.drag_normal")
    return lots(changes)


@pytest.mark.parametrize("kind", NAMES)
def test_a_lane_is_the_run_alone(kind):
    """With samples at times of their own; that of the shipped scene over its first loops (t = 53 s)."""
    duration_s = 63.3 if kind == "the shipped scene" else 21.3
    scenes = scenes_of(kind)
    assert all(goes_in_lanes(scene) for scene in scenes)
    runs = simulate_batch(scenes, duration_s=duration_s)
    assert_alone(scenes, runs, duration_s=duration_s)
    if kind == "the shipped scene":
        for name in ("loop_releases", "newton_failures", "rejected_steps"):
            assert sum(run.statistics[name] for run in runs) >= 1


def test_neither_order_nor_company_matters():
    """More runs than lanes, of different lengths and kinds: a lane takes what comes when it is free."""
    scenes = lots({"tether.nodes": 11}, np.linspace(0.02, 0.16, 11)) + lots({}, (0.1, 0.1))
    first = simulate_batch(scenes, duration_s=21.0)
    order = np.random.default_rng(3).permutation(len(scenes))
    again = simulate_batch([scenes[i] for i in order], duration_s=21.0)
    for place, i in enumerate(order):
        assert_same(again[place], first[i])
    for i in (0, 5, 12):
        assert_same(simulate(scenes[i], duration_s=21.0), first[i])
    assert_same(first[-1], first[-2])  # of one scene: nothing is shared, nothing is random


@pytest.mark.parametrize("changes", [CARRIED, {"solver.integrator": "midpoint"}], ids=["in lanes", "one by one"])
def test_periods_count_in_each_members_own_waves(changes):
    scenes = lots(changes, (4.0, 5.0, 6.0), "waves.period_s")
    runs = simulate_batch(scenes, periods=9)
    assert_alone(scenes, runs, periods=9)
    for scene, run in zip(scenes, runs, strict=True):
        assert run.columns["time_s"][-1] == pytest.approx(9 * scene.waves.period_s, abs=scene.sample_step_s())


@pytest.mark.parametrize(
    "word, other", [*((word, {}) for word in ENDINGS), ("strain-below-minus-one", {"tether.tension": TABLE})]
)
def test_a_run_that_ends_early_disturbs_no_other(word, other):
    nodes = {"tether.nodes": ENDINGS[word].get("tether.nodes", 41)}
    good, lost = lots(nodes | other, (0.1, 0.13, 0.15)), steep(nodes, ENDINGS[word])
    first, ended, *others = simulate_batch([good[0], lost, *good[1:]], duration_s=60.0)
    assert ended.status == word
    assert_same(ended, simulate(lost, duration_s=60.0))
    assert_alone(good, [first, *others], duration_s=60.0)


def test_the_endings_are_all_there_are():
    """Of planar runs in the engine's own scheme; tension-flat and shape-lost are the paper's."""
    assert set(ENDINGS) == set(WORDS.values()) - {"ok", "tension-flat", "shape-lost"}


def test_runs_come_as_they_end():
    """A run that ends early is handed out while the others go on, and one in a lane of its own waits for none."""
    short = steep({"tether.nodes": 11, "solver.max_loop_releases": 0})
    scenes = [*lots({"tether.nodes": 11}, (0.05, 0.08, 0.1)), short]
    order = [i for i, _ in simulate_each(scenes, duration_s=150.0)]
    assert order[0] == 3 and sorted(order) == [0, 1, 2, 3]


@pytest.mark.parametrize(
    "change",
    [
        {"motion.dimensions": 3},
        {"output.profiles": True},
        {"solver.integrator": "midpoint"},
        {"solver.shock_viscosity": {}},
        {"tether.damping_critical": 0.1},
        {"solver.scheme": "paper-box", "solver.step_s": 0.01},
        {"tether.tension": TABLE},
        held(3.0, 19.0),
    ],
)
def test_what_the_lanes_do_not_cover_stays_out(change):
    assert not goes_in_lanes(steep(change))


def test_runs_that_carry_unlike_perturbations_share_no_batch():
    carried = {**CARRIED}, {**CARRIED, "output.tangent_vectors": 1}, {**CARRIED, "output.lateral_growth": False}
    assert len({kind_of(steep(changes)) for changes in carried}) == 3


@pytest.mark.parametrize("chunk", [1, 7, 10**6])
def test_chunks_do_not_change_the_result(chunk):
    scene = steep({"output.profiles": True})
    batch = Run(scene, 60.0)
    while not batch.done():
        batch.advance(chunk)
    assert_same(batch.trajectory(), ran(scene, duration_s=60.0))


@pytest.mark.slow
def test_progress_rises_to_one_and_does_not_change_the_result():
    for scenes in ([steep()], [steep(member) for member in MIXED[:3]], [steep(), steep(ENDINGS["turn-unresolved"])]):
        seen = []
        runs = simulate_batch(scenes, periods=65, progress=seen.append)
        assert len(seen) >= 3
        assert all(0 < a <= b <= 1 for a, b in pairwise(seen)) and seen[0] < seen[-1] == 1.0
    assert_same(runs[0], simulate(scenes[0], periods=65))


def test_an_exception_from_progress_comes_through():
    """Ctrl-C is one."""

    def stop(fraction):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        simulate(steep(), periods=25, progress=stop)


@pytest.mark.parametrize(
    "length", [{}, {"periods": 1, "duration_s": 1.0}, {"duration_s": 0.0}, {"periods": -1}, {"duration_s": np.inf}]
)
def test_bad_run_lengths_raise(length):
    assert simulate_batch([], duration_s=1.0) == []
    with pytest.raises(ValueError):
        simulate(steep(), **length)
    with pytest.raises(ValueError, match="waves"):
        simulate(steep(STILL), periods=1)
