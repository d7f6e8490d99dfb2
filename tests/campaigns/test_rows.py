"""A row says what the analytic motion is; what cannot be said stays empty."""

import math
from dataclasses import replace

import numpy as np
import pytest

from campaigns.explore.rows import COLUMNS
from engine import load_scene
from engine.trajectory import TangentGrowth
from tables import names
from tests.campaigns.conftest import judged_row
from tests.campaigns.fake_engine import STATISTICS, sines

PERIODS, TRANSIENT = 90, 10
SETTLED = {
    "strobed_period", "radius_min_m", "radius_max_m", "angle_min_rad", "angle_max_rad", "tension_top_min_N",
    "tension_top_max_N", "slack_fraction", "compression_fraction", "snaps_per_wave", "tension_anchor_max_N",
    "tension_line_max_N", "tension_line_max_s_m",
}  # fmt: skip


@pytest.fixture(scope="module")
def scene():
    return load_scene("tethered_buoy")


def measured(scene, **run):
    return judged_row(sines(scene, PERIODS, **run), TRANSIENT)


def row_from_rest(scene, **run):
    """The row of a run that begins at rest, at its mean tension, which so is its static tension."""
    trajectory = sines(scene, PERIODS, **run)
    for name in ("radius_rate_mps", "angle_rate_radps"):
        trajectory.columns[name][0] = 0.0
    return judged_row(trajectory, TRANSIENT)


def test_extremes_of_sines_and_those_of_tension_between_the_samples(scene):
    row = measured(scene)
    assert (row["radius_min_m"], row["radius_max_m"]) == pytest.approx((19.0, 21.0), abs=1e-12)
    assert (row["angle_min_rad"], row["angle_max_rad"]) == pytest.approx((-0.3, 0.3), abs=1e-12)
    # The fake's solver steps see 10 N more and less than its samples.
    assert (row["tension_top_min_N"], row["tension_top_max_N"]) == pytest.approx((1490.0, 2510.0), abs=1e-9)


def test_full_evidence_is_told_beside_a_verdict_that_does_not_rest_on_it(scene):
    dynamics, full = (judged_row(sines(scene, 135), None, full=most) for most in (None, 1500))
    assert dynamics["regime"] == full["regime"] == "period-1" and "lyapunov_wolf_error" not in dynamics
    assert math.isfinite(full["lyapunov_wolf_error"])
    assert full["evidence"].startswith(f"{dynamics['evidence']}; samples alone, period: ")


def test_the_rope_and_the_buoy_leave_the_plane_after_the_transient(scene):
    run = sines(load_scene("tethered_buoy", {"motion.dimensions": 3}), PERIODS)
    before = run.columns["time_s"] < TRANSIENT * scene.waves.period_s - 1e-9
    for name, least_m in (("y_m", -0.5), ("offplane_m", 0.75)):
        run.columns[name][:] = np.where(before, 3.0, least_m)
    row = judged_row(run, TRANSIENT)
    assert (row["buoy_lateral_max_m"], row["rope_lateral_max_m"]) == (0.5, 0.75)


def test_across_the_plane_is_across_the_waves_whatever_their_direction():
    turned = {"motion.dimensions": 3, "waves.direction_rad": 2.5}
    run = sines(load_scene("tethered_buoy", turned), PERIODS)
    along_m, across_m = run.columns["x_m"].copy(), 0.25
    run.columns["x_m"][:] = along_m * math.cos(2.5) - across_m * math.sin(2.5)
    run.columns["y_m"][:] = along_m * math.sin(2.5) + across_m * math.cos(2.5)
    assert judged_row(run, TRANSIENT)["buoy_lateral_max_m"] == pytest.approx(across_m, abs=1e-12)


def test_a_run_in_three_dimensions_repeats_though_nothing_else_confirms_it(scene):
    """Its transient, of which it knows nothing, is a third."""
    run = sines(load_scene("tethered_buoy", {"motion.dimensions": 3}), 150)
    run.columns["tension_top_high_N"][run.columns["time_s"] < 49.0 * scene.waves.period_s] = 9000.0
    row = judged_row(run)
    assert (row["regime"], row["transient_periods"]) == ("period-1", 50)
    assert row["tension_top_max_N"] < 9000.0 == row["tension_top_start_N"]


@pytest.mark.parametrize("mean", [2000.0, 500.0, 250.0, 0.0, -600.0])
def test_slack_and_compression_of_a_sine(scene, mean):
    """500 sin lies below a level for acos(-level/500)/pi of the time; 100 samples a period, errors of second order."""
    row = row_from_rest(scene, tension=(mean, 500.0))
    for name, level in (("slack_fraction", max(0.05 * mean, 0.0)), ("compression_fraction", 0.0)):
        share = math.acos(max(-1.0, min((mean - level) / 500.0, 1.0))) / math.pi
        assert row[name] == pytest.approx(share, abs=1e-3)


@pytest.mark.parametrize(
    ("harmonic", "period"),
    [(2.0, 1), (0.0, 1), ((math.sqrt(5.0) - 1.0) / 2.0, None)],
)
def test_a_harmonic_of_the_wave_and_a_buoy_at_rest_have_period_1_and_a_motion_that_never_repeats_none(
    scene, harmonic, period
):
    """The golden ratio of frequencies never repeats."""
    assert measured(scene, harmonic=harmonic)["strobed_period"] == period


def test_a_turning_buoy_has_the_period_of_its_turn(scene):
    run = sines(scene, PERIODS)
    angle = np.pi * run.columns["time_s"] / scene.waves.period_s  # half a turn a period, unwrapped
    run.columns["angle_rad"][:] = angle
    run.columns["angle_rate_radps"][:] = np.pi / scene.waves.period_s
    run.columns["x_m"][:] = run.columns["radius_m"] * np.sin(angle)
    run.columns["z_m"][:] = run.columns["radius_m"] * np.cos(angle)
    assert judged_row(run, TRANSIENT)["strobed_period"] == 2


def test_height_of_the_sphere_above_still_water(scene):
    height = measured(scene, radius=(19.0, 0.0))["max_buoy_height_above_water_m"]
    assert height == pytest.approx(19.0 + 0.75 - 21.0, abs=1e-12)  # at angle 0, a sample


@pytest.mark.parametrize("periods", [1, TRANSIENT, TRANSIENT + 0.9])
def test_record_within_the_transient_fills_statistics_only(scene, periods):
    row = judged_row(sines(scene, periods, status="newton-failed", message="why"), TRANSIENT)
    assert not SETTLED & row.keys()
    assert (row["status"], row["message"]) == ("newton-failed", "why")
    assert {name: row[name] for name in STATISTICS} == STATISTICS


def test_a_failed_run_is_measured_up_to_its_end_or_its_first_sample_that_is_not_finite(scene):
    run = sines(scene, PERIODS, status="not-finite")
    assert judged_row(run, TRANSIENT)["radius_max_m"] == pytest.approx(21.0)
    run.columns["radius_m"][5000:] = 1e9
    run.columns["radius_m"][5000] = math.nan
    row = judged_row(run, TRANSIENT)
    assert (row["status"], row["radius_max_m"]) == ("not-finite", pytest.approx(21.0))


def test_record_without_samples(scene):
    run = sines(scene, 1, status="statics-failed")
    empty = type(run)(scene, run.status, "", {name: values[:0] for name, values in run.columns.items()}, {})
    row = judged_row(empty, TRANSIENT)
    assert {name for name, entry in row.items() if entry is not None} == {"status", "message"}


@pytest.mark.parametrize(("released", "empty"), [(TRANSIENT - 1, False), (TRANSIENT, True), (PERIODS - 1, True)])
def test_growth_across_the_plane_is_told_where_no_loop_was_released(scene, released, empty):
    nats, events = np.full(PERIODS, -0.5 * math.log(2.0)), np.zeros(PERIODS)
    events[released] = 1.0
    nats[:TRANSIENT] = 3.0
    run = replace(sines(scene, PERIODS), tangent=TangentGrowth(5.0, np.empty((PERIODS, 0)), events, nats))
    row = judged_row(run, TRANSIENT)
    assert "regime" not in row, "nothing was carried in the plane"
    growth = row["offplane_growth_bits_per_period"], row["offplane_growth_error"]
    assert growth == ((None, None) if empty else pytest.approx((-0.5, 0.0), abs=1e-12))


def test_every_entry_has_a_column_and_the_public_ones_are_there(scene):
    public = """steepness status regime radius_min_m radius_max_m angle_min_rad angle_max_rad tension_top_min_N
        tension_top_max_N slack_fraction lyapunov_wolf_bits_per_period lyapunov_wolf_error
        lyapunov_tangent_bits_per_period lyapunov_tangent_error offplane_growth_bits_per_period offplane_growth_error
        max_turn_rad loop_releases steps rejected_steps newton_iterations wall_s"""
    assert {*measured(scene), *public.split()} <= set(names(COLUMNS))


@pytest.mark.parametrize(("harmonic", "period"), [(1.0, 1), (0.5, 2), (1.0 / 3.0, 3), (0.2, 5)])
def test_snaps_a_wave_are_those_of_whole_periods_of_the_motion(scene, harmonic, period):
    """A sine of 1800 about 1000 N is slack once in its period, and then snaps to 2800 N."""
    row = row_from_rest(scene, tension=(1000.0, 1800.0), harmonic=harmonic)
    assert row["strobed_period"] == period and row["snaps_per_wave"] == pytest.approx(1.0 / period, rel=1e-9)
    assert row["snap_peak_median_N"] == pytest.approx(2810.0, rel=1e-3)  # the steps of the fake see 10 N more
    assert row["snap_peak_max_N"] == pytest.approx(row["tension_top_max_N"], rel=1e-3)
    assert (row["tension_line_max_N"], row["tension_line_max_s_m"]) == (row["tension_top_max_N"], 20.0)


def test_the_largest_tension_along_the_line_has_its_place(scene):
    run = sines(scene, PERIODS)
    for sample, tension_N, place_m in ((200, 9e3, 3.0), (5000, 8e3, 7.0)):  # the first one within the transient
        run.columns["tension_max_N"][sample], run.columns["tension_max_s_m"][sample] = tension_N, place_m
    row = judged_row(run, TRANSIENT)
    assert (row["tension_line_max_N"], row["tension_line_max_s_m"]) == (8e3, 7.0)
