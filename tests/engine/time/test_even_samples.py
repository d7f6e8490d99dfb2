"""Samples lie on an even grid that does not depend on the steps, and are as accurate as the steps."""

import numpy as np
import pytest

from tests.engine.lines import line, orders, ran
from tests.engine.time.test_order import ASIDE, SCENES

STEEP = {"waves.steepness": 0.13, "water.depth_m": 22.5}


@pytest.mark.parametrize(
    "overrides, length, step_s, count",
    [
        ({}, {"periods": 3}, 0.05, 301),
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
        if name not in ("tension_top_low_N", "tension_top_high_N", "time_s", "angle_rad"):
            assert np.array_equal(fine[name][::4], coarse[name]), name
    # extremes since the sample before: the fine grid also counts its samples in between, and can only find more
    low, high = (fine[f"tension_top_{name}_N"][1:].reshape(-1, 4) for name in ("low", "high"))
    assert np.all(low.min(axis=1) <= coarse["tension_top_low_N"][1:])
    assert np.all(high.max(axis=1) >= coarse["tension_top_high_N"][1:])


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
    asked = {**STEEP, "output.profiles": True, "solver.integrator": integrator}
    run = ran(line(asked), 4)
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
    rarer = ran(line(asked, {"output.profiles_step_s": 0.5}), 4).profiles
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
    asked = {"waves.steepness": 0.016, "water.depth_m": 22.5, "solver.scheme": scheme, "output.step_s": 0.01, **steps}
    columns = ran(line(asked), duration_s=8.0).columns
    span = columns["time_s"][2:] - columns["time_s"][:-2]
    for name, rate in (("radius_m", "radius_rate_mps"), ("angle_rad", "angle_rate_radps")):
        off = (columns[name][2:] - columns[name][:-2]) / span - columns[rate][1:-1]
        assert np.abs(off)[columns["time_s"][1:-1] > 1.0].max() < 2e-2 * np.abs(columns[rate]).max()
