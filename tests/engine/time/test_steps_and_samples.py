"""Step control: the error follows rtol at the rate of theory, and a rejected trial leaves no trace.

With an error estimate of local order p + 1 the steps go as rtol^(1/(p+1)); a method that goes on at order m then has a
global error as rtol^(m/(p+1)): 1 for the 4(3) pair, 2/3 for TR-BDF2 (order 2, held by an estimate of local order 3).

Samples lie on an even grid that does not depend on the steps, and are as accurate as the steps.
"""

import numpy as np
import pytest

from engine.own_mooring.ropes import rope_of
from engine.own_mooring.scene import Mooring, scene_text
from engine.run import Run
from engine.scene import scene_from_toml
from engine.simd.elementary import strain_within
from engine.time.integrators import esdirk43, trbdf2
from engine.time.steps import embedded_error
from engine.time.time_loop import weights_within
from tests.engine.kernels import Stage
from tests.engine.lines import STILL, Motion, by_table, held, line, orders, ran, uniform
from tests.engine.time.test_order import ASIDE, SCENES

REGULAR = {  # small waves, with a current that keeps |v| v away from its kink
    "waves.steepness": 0.016,
    "water.depth_m": 22.5,
    "waves.ramp_s": 10.0,
    "solver.max_step_s": 1.0,
    "solver.shortest_period_s": 1e9,  # the tolerance alone chooses the steps, not the heave of the line
    **uniform(1.0, 0.0, 0.8),
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
    assert ran(line(REGULAR, {"solver.max_step_s": 0.1}), 6).statistics["steps"] >= 300


@pytest.mark.parametrize("method", [esdirk43, trbdf2])
def test_the_estimate_is_the_rms_of_what_the_embedded_method_differs_by_over_the_tolerance(method):
    """Along the line in its strain, across it in its angle, of velocities in the speed of the scene."""
    name = method.__name__.rpartition(".")[2]
    scene, dt, s = line({"solver.integrator": name, "solver.rtol": 0.02}), 0.1, len(method.A)
    stage, Y = Stage(scene), Motion(scene).Y.copy()
    Y[:, 4] += np.linspace(0.0, 2.0, len(Y))
    stage.places(Y)
    K = np.random.default_rng(1).normal(size=(s, len(Y), 4))
    error = dt * np.tensordot(method.A[-1] - method.B_EMBEDDED, K, 1)
    c, sine, p = np.cos(Y[:, 4]), np.sin(Y[:, 4]), stage.p
    parts = (error[:, 0] * c + error[:, 1] * sine) * p["per_strain"], error[:, 1] * c - error[:, 0] * sine
    squares = parts[0] ** 2 + parts[1] ** 2 + np.sum(error[:, 2:] ** 2, 1) * p["per_speed"] ** 2
    found = embedded_error(p, stage.tables, dt, K, stage.Q, np.empty(s), np.empty(4))
    assert found == pytest.approx(np.sqrt(squares.mean()) / 0.02, rel=1e-12)


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


STEEP = {"waves.steepness": 0.13, "water.depth_m": 22.5}


@pytest.mark.parametrize(
    "overrides, length, step_s, count",
    [
        ({"waves.period_s": 7.3}, {"periods": 2}, 0.073, 201),
        ({"output.step_s": 0.7}, {"duration_s": 10.0}, 0.7, 15),
        ({"output.step_s": 0.1}, {"duration_s": 0.3}, 0.1, 4),  # 0.3/0.1 is below 3 in binary
        ({"output.step_s": 0.001}, {"duration_s": 0.5}, 0.001, 501),  # many samples in one step
        ({"output.step_s": 20.0}, {"duration_s": 10.0}, 20.0, 1),  # only the start
        ({"waves": None}, {"duration_s": 1.0}, 0.05, 21),
    ],
)
def test_samples_are_even_counted_and_start_at_zero(overrides, length, step_s, count):
    time_s = ran(line({"water.depth_m": 22.5}, overrides), **length).columns["time_s"]
    assert len(time_s) == count
    assert time_s[0] == 0.0
    assert np.allclose(time_s, step_s * np.arange(count), rtol=1e-14, atol=0)


def test_a_coarse_grid_is_a_part_of_a_fine_one():
    """What is asked for never changes the steps: samples at the same time are the same to the last bit."""
    fine = ran(line(STEEP, {"output.step_s": 0.025}), duration_s=20.0).columns
    coarse = ran(line(STEEP, {"output.step_s": 0.1}), duration_s=20.0).columns
    for name in fine:
        if not name.endswith(("low_N", "high_N")) and name not in ("time_s", "angle_rad"):
            assert np.array_equal(fine[name][::4], coarse[name]), name
    # extremes since the sample before: the fine grid also counts its samples in between, and can only find more
    low, high = (fine[f"tension_top_{name}_N"][1:].reshape(-1, 4) for name in ("low", "high"))
    assert np.all(low.min(axis=1) <= coarse["tension_top_low_N"][1:])
    assert np.all(high.max(axis=1) >= coarse["tension_top_high_N"][1:])
    at_anchor = fine["tension_anchor_high_N"][1:].reshape(-1, 4).max(axis=1)
    assert np.all(at_anchor >= coarse["tension_anchor_high_N"][1:])


def test_a_snap_between_two_samples_is_seen_at_both_ends_of_the_line():
    """A stiff rope snaps within a hundredth of the wave period: such samples alone showed 89 % of its pull."""
    mooring = Mooring(1.19, 10.5, rope_of("hmpe", 0.0311), 10.1, 3.01, 8.61)
    scene = scene_from_toml(scene_text(mooring, "mine"))
    dense = scene.with_values("output", step_s=scene.waves.period_s / 3000)
    for place in ("anchor", "top"):
        most_N = [run.columns[f"tension_{place}_high_N"].max() for run in (ran(scene, 10), ran(dense, 10))]
        assert most_N[0] == pytest.approx(most_N[1], rel=0.03)


SMOOTH = {
    **SCENES["ramped waves"][0],
    **ASIDE[2][0],
    "tether.nodes": 6,
    "solver.newton_tolerance": 1e-18,
    "solver.max_newton_iterations": 40,
    "output.step_s": 0.05,
}
NAMES = ("x_m", "z_m", "radius_m", "angle_rad", "radius_rate_mps")


@pytest.mark.parametrize("integrator, order", [("esdirk43", 4), ("trbdf2", 2), ("midpoint", 2), ("backward-euler", 1)])
def test_dense_output_keeps_the_order_of_the_method(integrator, order):
    """Samples inside long steps (8, then 4 and 2 to a step) against a run with steps of a tenth of a sample."""
    reference = ran(line(SMOOTH, {"solver.step_s": 0.005}), duration_s=8.0).columns
    errors = []
    for step_s in (0.4, 0.2, 0.1):
        scene = line(SMOOTH, {"solver.integrator": integrator, "solver.step_s": step_s})
        columns = ran(scene, duration_s=8.0).columns
        errors.append([np.abs(columns[name] - reference[name]).max() for name in NAMES])
    assert np.all(np.abs(orders(errors)[-1] - order) < 0.1), errors


@pytest.mark.parametrize("integrator", ["esdirk43", "generalized-alpha"])
def test_profiles_agree_with_samples(integrator):
    """The tension is that of the law; profiles may be rarer than samples."""
    requested = {**STEEP, "output.profiles": True, "solver.integrator": integrator}
    run = ran(line(requested), 4)
    columns, lines = run.columns, run.profiles
    assert np.array_equal(lines.time_s, columns["time_s"])
    assert lines.x_m.shape == (401, 41) and lines.s_m[0] == 0 and lines.s_m[-1] == pytest.approx(20.0, rel=1e-14)
    assert np.allclose(lines.x_m[:, -1], columns["x_m"], rtol=0, atol=1e-12)
    assert np.allclose(lines.z_m[:, -1], columns["z_m"], rtol=0, atol=1e-12)
    assert np.allclose(lines.tension_N[:, -1], columns["tension_top_N"], rtol=0, atol=1e-9)
    assert np.allclose(lines.tension_N.min(axis=1), columns["tension_min_N"], rtol=0, atol=1e-9)
    assert not lines.x_m[:, 0].any() and not lines.z_m[:, 0].any()
    assert np.allclose(lines.tension_N, 5e4 * lines.strain)
    speed = np.hypot(columns["radius_rate_mps"], columns["radius_m"] * columns["angle_rate_radps"])
    assert np.allclose(lines.speed_mps[:, -1], speed)
    rarer = ran(line(requested, {"output.profiles_step_s": 0.5}), 4).profiles
    assert np.allclose(rarer.time_s, 0.5 * np.arange(41)) and np.allclose(rarer.x_m, lines.x_m[::10], atol=1e-12)


def test_tension_extremes_bracket_the_samples_and_see_what_lies_between():
    columns = ran(line(STEEP, {"output.step_s": 2.0, "solver.rtol": 1e-3}), 10).columns
    top, low, high = (columns[f"tension_top_{name}N"] for name in ("", "low_", "high_"))
    assert np.all(low <= top) and np.all(high >= top)
    assert np.all(low[1:] <= top[:-1]) and np.all(high[1:] >= top[:-1])
    # samples every 2 s miss most peaks; they are there all the same, as samples of 1 ms find them
    fine = ran(line(STEEP, {"output.step_s": 0.001, "solver.rtol": 1e-3}), 10).columns["tension_top_N"]
    peaks = fine[:-1].reshape(-1, 2000).max(axis=1)
    assert np.max(peaks - np.maximum(top[1:], top[:-1])) > 1000
    assert np.abs(high[1:] - peaks).max() < 0.02 * np.ptp(fine)


@pytest.mark.parametrize("scheme", ["conservation", "paper-box"])
def test_rates_are_the_derivatives_of_the_samples(scheme):
    steps = {"output.step_s": 0.05, "solver.step_s": 0.05, "tether.nodes": 7} if scheme == "paper-box" else {}
    waves = {"waves.steepness": 0.016, "water.depth_m": 22.5, "solver.scheme": scheme, "output.step_s": 0.01}
    columns = ran(line(waves, steps), duration_s=8.0).columns
    span = columns["time_s"][2:] - columns["time_s"][:-2]
    for name, rate in (("radius_m", "radius_rate_mps"), ("angle_rad", "angle_rate_radps")):
        off = (columns[name][2:] - columns[name][:-2]) / span - columns[rate][1:-1]
        assert np.abs(off)[columns["time_s"][1:-1] > 1.0].max() < 2e-2 * np.abs(columns[rate]).max()


def interpolated(dt, speed_radps, false_rate=0.0):
    """Strain at 0.3 of a step of dt (s), and what it is: q turns at speed_radps and is stretched by 0.01 sin 3 t."""
    ends = []
    for t in (0.4, 0.4 + dt):
        strain, rate, angle = 0.01 * np.sin(3 * t), 0.03 * np.cos(3 * t) + false_rate, speed_radps * t
        along, across = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
        ends.append((np.hstack([(1 + strain) * along, 0, 0]), np.hstack([rate * along + speed_radps * across, 0, 0])))
    (C0, K0), (C1, K1) = ends
    return strain_within(weights_within(True, 0.3, dt), C0, C1, K0, K1), 0.01 * np.sin(3 * (0.4 + 0.3 * dt))


def test_strains_between_steps_are_of_fourth_order_and_no_rate_counts_where_a_node_turns():
    errors = [abs(np.subtract(*interpolated(dt, 2.0))) for dt in (0.02, 0.01)]
    assert abs(np.log2(errors[0] / errors[1]) - 4.0) < 0.1, errors
    turned = [interpolated(0.1, 5.0, false_rate)[0] for false_rate in (0.0, 1.0)]
    assert turned[0] == pytest.approx(turned[1], rel=0, abs=1e-12)


def test_between_steps_that_damp_the_waves_of_a_held_line_its_tension_swings_no_further_than_at_their_stages():
    """A rope lowered on a bed whose friction damps its waves: long steps, after which rates keep what values have lost.

    A cubic through them went to 14.5 N instead of 6.3.
    """
    motion = by_table([0.0, 1.0, 5.0], [[0.0] * 3, [0.0, 0.0, -2.0], [0.0, 0.0, -2.0]])
    changes = {"floor": {"stiffness_Npm3": 1e4, "damping_Nspm3": 1e3, "friction": 0.3}, "output.profiles": True}
    changes |= STILL | held(16.0, 4.0, motion=motion) | {"output.step_s": 0.01}
    loose, tight = (ran(line(changes, {"solver.rtol": rtol}), duration_s=2.0) for rtol in (0.03, 1e-4))
    assert "ringing" not in loose.message and "axial waves" not in loose.message
    assert loose.statistics["steps"] < 0.5 * tight.statistics["steps"]
    for name in ("tension_top_N", "tension_top_high_N"):
        assert loose.columns[name].max() == pytest.approx(tight.columns[name].max(), rel=0.05)
    assert np.abs(loose.profiles.tension_N - tight.profiles.tension_N)[5:].max() < 1.5
