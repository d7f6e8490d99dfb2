"""Law: every way in which a run can end is reached by a scene that asks for it, and says so in its status; in a plane,
and in space, after a blow across the plane where the end is the same with it.

No run raises, hangs, or hands out a number that is not finite; samples up to the end are kept.
"""

import time

import numpy as np
import pytest

from engine import load_scene, simulate
from engine.time.status import WORDS
from tests.engine.lines import SPACE, STILL, harmonic, held, kick, line

NO_COMPRESSION = {"law": "tabulated", "strain": [-0.5, 0.0, 0.1], "tension_N": [0.0, 0.0, 5000.0]}
PAPER = {"solver.scheme": "paper-box", "tether.nodes": 11, "water.depth_m": 21.6}
FLAT_IN_SLACK = {"law": "tabulated", "strain": [-0.2, -0.1, 0.0, 0.5], "tension_N": [0.0, 0.0, 0.0, 2.5e4]}
YIELDING = {"law": "tanh", "p": [1000.0, 10.0, 0.0, 0.0, 0.0]}  # at half the lift of the buoy: nothing is at rest
LOOPS = {"waves.steepness": 0.13, "water.depth_m": 21.6, "solver.rtol": 1e-3, "tether.nodes": 81}
FEW_RELEASES = {"water.depth_m": 21.6, "solver.max_loop_releases": 2}
ENDS = {  # name: (overrides, run length in s, status words allowed)
    "tolerance below the shortest step": ({"solver.min_step_s": 0.05, "solver.rtol": 1e-4}, 50.0, {"step-underflow"}),
    "long fixed steps into a snap": (
        {"solver.integrator": "midpoint", "solver.step_s": 0.025, "solver.min_step_s": 0.02},
        200.0,
        {"newton-failed"},
    ),
    "loops without release": ({**LOOPS, "solver.loop_release": False}, 70.0, {"turn-unresolved"}),
    "more loops than allowed": (FEW_RELEASES, 200.0, {"turn-unresolved"}),
    "no stiffness in compression": ({"tether.tension": NO_COMPRESSION}, 200.0, {"strain-below-minus-one"}),
    "a blow along a line without stiffness in compression": (
        {**STILL, **kick(w=-60.0), "tether.tension": NO_COMPRESSION},
        5.0,
        {"strain-below-minus-one"},
    ),
    "a blow along an unbent line": (
        {**STILL, **kick(w=-300.0), "tether.bending_stiffness_Nm2": 0.0},
        5.0,
        {"newton-failed", "strain-below-minus-one", "step-limit"},  # ill-posed: how it breaks is not the point
    ),
    "a buoy at rest 400 m above the water": ({"tether.tension.stiffness_N": 100.0}, 5.0, {"statics-failed"}),
    "short waves continued to 190 m above the water": (
        {"start.buoy_displacement_m": [0.0, 0.0, 190.0], "waves.period_s": 1.0},
        5.0,
        {"not-finite"},
    ),
    "no strain is in equilibrium": ({**STILL, "tether.tension": YIELDING}, 1.0, {"statics-failed"}),
    "the paper's scheme in slack": ({**PAPER, "solver.step_s": 0.005}, 8.0, {"shape-lost"}),
    "the paper's scheme at usual steps": ({**PAPER, "tether.nodes": 21}, 8.0, {"newton-failed"}),
    "the paper's scheme under a law without slope in slack": (
        {**PAPER, "solver.step_s": 0.01, "tether.tension": FLAT_IN_SLACK, "water.depth_m": 22.0},
        8.0,
        {"tension-flat"},
    ),
    "steps far below what the run could ever finish with": (
        {"solver.rtol": 1e-12, "solver.newton_tolerance": 1e-14},
        5.0,
        {"step-limit"},
    ),
}
IN_A_PLANE = ["loops without release", "more loops than allowed"]  # struck across, a loop leaves the plane
STRUCK = kick(v=1e-3)


def cases():
    for name in ENDS:
        for dimensions in (2, 3):
            takes_long = name.startswith("the paper's scheme") or (dimensions == 3 and name.startswith("steps far"))
            yield pytest.param(name, dimensions, marks=[pytest.mark.slow] * takes_long)


@pytest.mark.parametrize("name, dimensions", list(cases()))
def test_a_run_ends_with_its_reason(name, dimensions):
    overrides, duration_s, allowed = ENDS[name]
    struck = STRUCK if dimensions == 3 and name not in IN_A_PLANE else {}
    scene = line(struck | overrides | {"motion.dimensions": dimensions})
    began = time.process_time()
    run = simulate(scene, duration_s=duration_s)
    assert time.process_time() - began < 60  # of this process: a busy machine does not count
    assert run.status in allowed, (run.status, run.message)
    assert run.message
    samples = len(run.columns["time_s"])
    end_s, step_s = run.statistics["end_time_s"], scene.sample_step_s()
    assert end_s < duration_s
    # every sample up to the end, and none after it
    if run.statistics["steps"] == 0:
        assert samples == 0
    else:
        assert (samples - 1) * step_s <= end_s < samples * step_s * (1 + 1e-9)
    for column in run.columns.values():
        assert len(column) == samples and np.all(np.isfinite(column))
    if name == "long fixed steps into a snap":
        assert "lower solver.step_s, or add nodes" in run.message
    if name == "more loops than allowed":
        assert run.statistics["loop_releases"] == 2 and "2 loop releases" in run.message


@pytest.mark.parametrize("changes", [
    {"solver.scheme": "paper-box", "output.profiles": True, "tether.tension": YIELDING},
    {"tether.length_m": 1e30, **held(13.0, 18.0)},
], ids=["profiles of the paper's scheme", "a line folded into nothing"])  # fmt: skip
def test_without_a_rest_there_is_a_record_all_the_same(changes):
    run = simulate(line({**STILL, **changes}), duration_s=1.0)
    assert run.status == "statics-failed" and run.message
    assert len(run.columns["time_s"]) == 0
    assert run.profiles is None or run.profiles.x_m.shape == (0, run.scene.tether.nodes)


def test_every_status_is_reached():
    certain = [allowed for _, _, allowed in ENDS.values() if len(allowed) == 1]
    assert set().union(*certain) | {"ok"} == set(WORDS.values())


@pytest.mark.parametrize("turns", [1, 100])
def test_a_twist_that_is_too_much_ends_as_a_row_too(turns):
    """Up to 160 N m put within 2 s into a slack line of EI = 0.4: a status and finite samples, whatever it does."""
    end = held(12.0, 3.0, 8.0, rotation="clamped", twist_rad=2 * np.pi * turns, twist_ramp_s=2.0)
    scene = {**STILL, **end, "anchor.rotation": "clamped", "tether.torsion_stiffness_Nm2": 5.0, **SPACE}
    run = simulate(line(scene), duration_s=3.0)
    assert run.status == "ok" or run.message
    assert turns > 1 or run.status == "ok"
    assert all(np.all(np.isfinite(column)) for column in run.columns.values())


@pytest.mark.slow
def test_a_run_that_newton_s_failures_hold_ends_with_its_reason():
    """A bent chain in space without stiffness in torsion: without the rule ten minutes of steps of a microsecond."""
    shaken = harmonic([0.1, 0.0, 0.1], 2.0, ramp_s=1.0)
    bent = {"tether.bending_stiffness_Nm2": 0.1, "tether.torsion_stiffness_Nm2": 0.0, "tether.nodes": 25}
    run = simulate(
        load_scene("falling_chain", {"motion.dimensions": 3, "end.motion": shaken, "solver.rtol": 0.003, **bent}),
        duration_s=10.0,
    )
    assert run.status == "step-limit" and "Newton's method failed at a sixth" in run.message
    assert 5 * run.statistics["newton_failures"] > run.statistics["steps"] and run.statistics["end_time_s"] < 5.0
