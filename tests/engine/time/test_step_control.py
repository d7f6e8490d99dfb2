"""Step control: the error follows rtol at the rate of theory, and a rejected trial leaves no trace.

With an error estimate of local order p + 1 the steps go as rtol^(1/(p+1)); a method that goes on at order m then has a
global error as rtol^(m/(p+1)): 1 for the 4(3) pair, 2/3 for TR-BDF2 (order 2, held by an estimate of local order 3).
"""

import numpy as np
import pytest

from engine.run import Run
from tests.engine.lines import line, ran

REGULAR = {  # small waves, with a current that keeps |v| v away from its kink
    "waves.steepness": 0.016,
    "water.depth_m": 22.5,
    "waves.ramp_s": 10.0,
    "solver.max_step_s": 1.0,
    "current": {"law": "uniform", "velocity_mps": [1.0, 0.0, 0.8]},
}


@pytest.fixture(scope="module")
def reference():
    fine = {"solver.step_s": 2e-3, "solver.newton_tolerance": 1e-18, "solver.max_newton_iterations": 40}
    return ran(line(REGULAR, fine), 6).columns


def error_of(run, reference):
    """rms distance (m) of the buoy from where it should be."""
    return np.sqrt(np.mean(sum((run.columns[name] - reference[name]) ** 2 for name in ("x_m", "z_m"))))


@pytest.mark.parametrize(
    "integrator, loose, tight, rate", [("esdirk43", 1e-5, 1e-7, 1.0), ("trbdf2", 1e-3, 1e-5, 2 / 3)]
)
def test_error_falls_with_the_tolerance(reference, integrator, loose, tight, rate):
    runs = [ran(line(REGULAR, {"solver.integrator": integrator, "solver.rtol": r}), 6) for r in (loose, tight)]
    errors = [error_of(run, reference) for run in runs]
    measured = np.log(errors[0] / errors[1]) / np.log(loose / tight)
    assert abs(measured - rate) < 0.15, (errors, measured)
    steps = np.log(runs[1].statistics["steps"] / runs[0].statistics["steps"]) / np.log(loose / tight)
    assert abs(steps - (0.25 if integrator == "esdirk43" else 1 / 3)) < 0.1, steps


def test_default_tolerance_is_good_to_centimetres_in_small_waves(reference):
    """The default, without the cap on the step that the shipped scene has: fewer than 10 steps a period."""
    run = ran(line(REGULAR), 6)
    assert run.statistics["steps"] < 60 and error_of(run, reference) < 0.01


def run_to(seconds):
    """A run in steep waves stopped at its first step beyond a time."""
    run = Run(line({"waves.steepness": 0.13, "solver.max_step_s": 5.0, "solver.rtol": 1e-3}), 60.0)
    run.advance(round(seconds / 0.05) + 1)
    return run


def one_step(run, dt, dt_before):
    """Next accepted step from a first try of dt: (new state, rates, dt accepted, rejections, failures)."""
    state = run.state
    before = {name: state[name] for name in ("t", "steps", "rejected", "failures")}
    state["dt"], state["dt_before"] = dt, dt_before
    while state["steps"] == before["steps"]:
        state["samples"] = 0  # the kernel returns at the next sample it stores, and each step now stores one
        run.advance(1)
        assert state["status"] == 0
    assert state["steps"] == before["steps"] + 1
    counts = [int(state[name] - before[name]) for name in ("rejected", "failures")]
    return run.motion.Y.copy(), run.motion.K.copy(), float(state["dt_before"]), *counts


@pytest.mark.parametrize("seconds", [2.0, 7.0, 11.0])
@pytest.mark.parametrize("first_try", [0.3, 2.0])
def test_a_rejected_trial_leaves_no_trace(seconds, first_try):
    """The step taken after rejections is, bit for bit, the one taken where it was tried at once."""
    run = run_to(seconds)
    dt_before = float(run.state["dt_before"])
    Y, K, dt, rejected, failures = one_step(run, first_try, dt_before)
    assert rejected + failures > 0
    # a failure of Newton's method also forgets the step before, which serves only the first guess
    again = one_step(run_to(seconds), dt, 0.0 if failures else dt_before)
    assert again[3:] == (0, 0)
    assert np.array_equal(again[0], Y) and np.array_equal(again[1], K) and again[2] == dt


def test_rejections_and_failures_are_counted():
    statistics = ran(line({"waves.steepness": 0.13, "water.depth_m": 22.5}), 10).statistics
    assert statistics["rejected_steps"] > 0 and statistics["newton_failures"] > 0
    # five stages a step, at least one iteration each
    assert statistics["newton_iterations"] >= 5 * (statistics["steps"] + statistics["rejected_steps"] - 3)


def test_no_step_is_longer_than_allowed():
    for longest in (0.1, 0.02):
        run = ran(line({"waves.steepness": 0.016, "solver.max_step_s": longest}), duration_s=10.0)
        assert run.statistics["steps"] >= 10.0 / longest
