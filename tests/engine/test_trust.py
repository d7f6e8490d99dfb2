"""Law: what a run says of its tensions is so: how far they hold, when, where a motion jumps, what a grid lacks."""

import re

import numpy as np
import pytest

from engine import simulate
from engine.parameters import numbers_of
from engine.parameters.scales import jumps_of
from engine.run import Idle, Run, companions, trust
from engine.run.trust import blows, errors_of_ringing, unresolved
from engine.trajectory.columns import columns_of
from tests.engine.lines import DRY, SPACE, STILL, by_table, harmonic, held, kick, line, linear, ran
from tests.engine.physics.caps import CAP

RINGING_N, LENGTH_M, EA = 500.0, 20.0, 1e8
TIMES = np.linspace(0.0, 4.0, 101)
SLACK = held(8.0, -3.0)
DEEP = STILL | {"water.depth_m": 60.0}  # the slack line hangs clear of the bed


def away(ringing_N, stiffness_N):
    """Overrides of a buoy that begins to heave with this swing of tension."""
    return {"start.buoy_displacement_m": [0.0, 0.0, -ringing_N * LENGTH_M / stiffness_N], "output.step_s": 0.01}


def moved(displacement_m, times=TIMES):
    """Overrides of a taut dry held line whose upper end goes that way (n,) along the line."""
    rows = [[0.0, 0.0, float(z - displacement_m[0])] for z in displacement_m]
    return held(0.0, 20.1, motion=by_table(list(times), rows)) | DRY


@pytest.mark.parametrize("drag", [0.0, 20.0])
def test_lost_ringing_would_die_away_as_resolved_ringing_does(drag):
    quiet = {"buoy.drag": drag, "tether.drag_normal": 0.0, "tether.drag_tangential": 0.0}
    scene = line(STILL, away(RINGING_N, 1e6), quiet, tension=linear(1e6))
    columns = ran(scene, duration_s=20.0).columns
    time_s, lost_N = columns["time_s"], np.zeros(len(columns["time_s"]))
    lost_N[0] = RINGING_N
    foretold = errors_of_ringing(Run(scene, 1.0).record, scene, time_s, lost_N)
    late = slice(-200, None)  # more than a period
    swing = columns["tension_top_high_N"][late].max() - columns["tension_top_low_N"][late].min()
    assert foretold[late].mean() == pytest.approx(swing / 2, rel=0.15)
    assert (swing < RINGING_N) == (drag > 0.0)


def test_the_error_that_is_told_is_that_of_the_tension_that_is_printed():
    """Ringing that is damped at once: its first swing is seen, all of the rest is not."""
    run = ran(line(STILL, away(RINGING_N, EA), {"solver.shortest_period_s": 1.0}, tension=linear(EA)), duration_s=5.0)
    most = run.columns["tension_top_high_N"].argmax()
    largest, when = run.columns["tension_top_high_N"][most], run.columns["time_s"][most]
    assert f"the largest tension, {largest:.4g} N at t = {when:.4g} s" in run.message


@pytest.mark.parametrize(("last_N", "told"), [(1500.0, True), (2500.0, False)])
def test_a_line_that_is_pulled_beyond_its_measured_points_says_so(last_N, told):
    """At rest the buoy pulls with 2 kN."""
    measured = {"law": "tabulated", "strain": [-0.02, 0.0, last_N / 5e4], "tension_N": [-100.0, 0.0, last_N]}
    run = ran(line({"waves": None}, nodes=11, tension=measured), duration_s=1.0)
    assert (f"measured up to {last_N:g} N" in run.message) == told


def test_a_small_part_of_the_largest_tension_is_not_told():
    run = ran(line(STILL, away(60.0, EA), {"solver.shortest_period_s": 1.0}, tension=linear(EA)), duration_s=5.0)
    assert run.statistics["unresolved_ringing_N"] > 20.0 and run.message == ""


@pytest.mark.parametrize(
    ("period_s", "steepness", "statement"),
    [(5.0, 0.13, ""), (50.0, 1e-4, ""), (50.0, 0.016, "too long to be linear"), (5.0, 0.6, "a wave of 5 s breaks")],
)
def test_waves_that_are_not_linear_are_told(period_s, steepness, statement):
    """T = 50 s in 21 m: L = 712 m, and H L^2/depth^3 = 198 of kA = 0.016; deep water breaks at 0.142 pi."""
    wave = {"waves.period_s": period_s, "waves.steepness": steepness, "buoy.submergence": "spherical-cap"}
    scene = line(wave, {"tether.nodes": 9})
    message = simulate(scene, duration_s=0.1).message
    assert (statement in message) if statement else message == ""


def test_a_table_jumps_where_its_samples_begin_or_end_in_motion():
    omega, amplitude = 2 * np.pi, 0.01
    sine, cosine = (amplitude * wave(omega * TIMES) for wave in (np.sin, np.cos))
    cut = TIMES[: 1 + 80 + 5]  # ends where a cosine is fastest, nearly
    computed = jumps_of(line(moved(sine)).end)
    assert [(t, speed) for t, speed, _ in computed] == [
        (0.0, pytest.approx(omega * amplitude, rel=0.05)),
        (4.0, pytest.approx(omega * amplitude, rel=0.05)),
    ]
    assert jumps_of(line(moved(cosine)).end) == []
    assert [t for t, *_ in jumps_of(line(moved(cosine[: len(cut)], cut)).end)] == [cut[-1]]
    assert jumps_of(line(moved([0.0, 0.1, 0.1, 0.0], [0.0, 1.0, 2.0, 3.0])).end) == []
    shaken = held(0.0, 20.1, motion=harmonic([0.0, 0.0, amplitude], 1.0, phase_rad=np.pi / 3.0))
    assert jumps_of(line(shaken, DRY).end) == [(0.0, pytest.approx(omega * amplitude * 0.5), 0.0)]


@pytest.mark.parametrize("largest_s, least_N, statement", [
    (0.04, 90.0, "at t = 0 s"), (2.0, 90.0, ""), (4.0, 90.0, "at t = 4 s"), (2.0, -130.0, "at t = 4 s"),
])  # fmt: skip
def test_a_jump_is_told_only_where_it_makes_the_largest_force(largest_s, least_N, statement):
    """Of either sign: the least tension is that of the stop at the end."""
    scene, smooth = (line(moved(0.05 * wave(2 * np.pi * TIMES))) for wave in (np.sin, np.cos))
    high, low = np.full(len(TIMES), 100.0), np.full(len(TIMES), 100.0)
    high[np.searchsorted(TIMES, largest_s - 1e-9)] = 120.0
    low[-1] = least_N
    columns = {"time_s": TIMES, "tension_top_high_N": high, "tension_top_low_N": low}
    stated = blows(Run(scene, 1.0).record, scene, columns)
    assert blows(Run(smooth, 1.0).record, smooth, columns) == ""
    assert statement in stated and stated.count("at t =") == bool(statement)


@pytest.mark.parametrize("nodes, warned", [(3, True), (21, False)])
def test_a_grid_too_coarse_at_rest_is_told(nodes, warned):
    run = ran(line(DRY, SLACK, nodes=nodes), duration_s=0.1)
    fine = ran(line(DRY, SLACK, nodes=321), duration_s=0.1).columns["tension_top_N"][0]
    off = abs(run.columns["tension_top_N"][0] / fine - 1)
    assert (off > 0.05) == warned == ("at rest" in run.message)


def test_steps_too_long_for_the_largest_tension_are_told():
    """A buoy that begins to heave: backward Euler damps its first swing, by half as much in steps half as long."""
    heaving = away(1900.0, 3e6) | {"solver.integrator": "backward-euler"}
    stated = "in steps twice as long"
    coarse, fine = (
        ran(line(STILL, heaving, {"solver.step_s": step_s}, tension=linear(3e6)), duration_s=1.0)
        for step_s in (0.05, 0.0005)
    )
    largest = [run.columns["tension_top_high_N"].max() for run in (coarse, fine)]
    assert largest[0] < 0.95 * largest[1]
    assert stated in coarse.message and stated not in fine.message
    off = float(re.search(r"holds to (\S+) N, because", coarse.message)[1])
    assert off == pytest.approx(largest[1] - largest[0], rel=0.6)  # by the method's own order, 1


def test_what_is_lost_in_the_step_to_the_largest_tension_is_its_error_though_it_is_booked_a_sample_later():
    run = Run(line(STILL, away(RINGING_N, EA), tension=linear(EA)), 4.0)
    time_s = 0.05 * np.arange(81)
    high_N, lost_N = np.where(time_s == time_s[20], 100.0, 50.0), np.where(time_s == time_s[21], 30.0, 0.0)
    columns = {"time_s": time_s, "tension_top_high_N": high_N, "unresolved_N": lost_N}
    assert "holds to 30 N" in unresolved(run.record, run.tables, run.scene, columns)


@pytest.mark.parametrize("overrides, warned", [
    ({}, True), ({"tether.drag_normal": 0.001}, False), ({"tether.damping_critical": 0.1}, False),
    ({"waves.steepness": 0.001}, False),
])  # fmt: skip
def test_a_slack_line_that_nothing_calms_is_told(overrides, warned):
    undamped = {"tether.drag_normal": 0.0, "tether.drag_tangential": 0.0, "tether.nodes": 11, "waves.steepness": 0.1}
    run = simulate(line(undamped | overrides), periods=6)
    assert ("neither drag nor damping" in run.message) == warned


@pytest.mark.parametrize("drag_normal", [0.0, 1.0])
def test_a_held_slack_line_that_no_drag_across_it_calms_is_told(drag_normal):
    """A short rope is eased by a quarter and pulled taut again, in water, with drag along it."""
    eased = by_table([0.0, 1.0, 2.0], [[0.0] * 3, [-0.5, 0.0, -0.5], [0.0] * 3])
    rope = {"tether.length_m": 3.0, "tether.drag_normal": drag_normal, "tether.drag_tangential": 0.2}
    scene = line(STILL, held(2.0, 2.25, motion=eased), rope, nodes=41, tension=linear(1e5))
    assert ("nor damping, so that its folds" in simulate(scene, duration_s=4.0).message) == (drag_normal == 0.0)


@pytest.mark.parametrize("density_kgpm3, warned", [(1140.0, False), (5e5, True)])
def test_a_buoy_that_does_not_carry_its_line_is_told(density_kgpm3, warned):
    run = ran(line({"tether.density_kgpm3": density_kgpm3, "waves": None}, nodes=11), duration_s=1.0)
    assert (run.columns["tension_top_N"][0] < 0.0) == warned == ("does not carry the line" in run.message)


def test_a_line_that_floats_and_presses_its_buoy_falls_nowhere():
    rope = {"tether.density_kgpm3": 910.0, "tether.length_m": 22.0, "buoy.submergence": "spherical-cap", "waves": None}
    run = ran(line(rope, nodes=11), duration_s=1.0)
    assert run.columns["tension_top_N"][0] < 0.0 and "does not carry" not in run.message


LOWERED = by_table([0.0, 3.0], [[0.0, 0.0, 0.0], [-4.0, 0.0, -5.0]])


@pytest.mark.parametrize("water", [DRY, DEEP])
def test_compression_that_the_grid_cannot_buckle_is_told_where_no_drag_calms_the_line(water):
    """A line is lowered at one end; a finer grid has another largest tension, by no more than the compression."""
    lowered = held(12.0, 15.9, motion=LOWERED) | {"tether.bending_stiffness_Nm2": 4.0}
    coarse, fine = (ran(line(water, lowered, nodes=nodes, tension=linear(1e6)), duration_s=5.0) for nodes in (41, 161))
    off_N = abs(coarse.columns["tension_top_high_N"].max() - fine.columns["tension_top_high_N"].max())
    stated = re.search(r"without drag across .* holds to (\S+) N", coarse.message)
    assert (stated is not None) == (water is DRY) and "pressed together" not in fine.message
    if stated:
        assert 5.0 < off_N < float(stated[1])


@pytest.mark.parametrize("amplitude_m, warned", [(0.1, False), (0.68, True)])
def test_a_slack_fraction_that_the_grid_decides_is_told(amplitude_m, warned):
    """A long thin line is shaken along itself: where it goes slack, it does so for longer on a finer grid."""
    motion = harmonic([0.0, 0.0, amplitude_m], 1.4, ramp_s=1.4)
    deep = {"water.depth_m": 165.0, "anchor.position_m": [0.0, 0.0, 79.0]} | held(50.1, -43.05, motion=motion)
    keys = {"length_m": 66.0, "area_m2": 3.4e-5, "density_kgpm3": 3000.0, "bending_stiffness_Nm2": 0.017}
    runs = [ran(line(STILL, deep, tension=linear(1.24e5), nodes=nodes, **keys), duration_s=8.0) for nodes in (41, 161)]
    tensions = [run.columns["tension_top_N"] for run in runs]
    shares = [float(np.mean(tension_N <= 0.05 * tension_N[0])) for tension_N in tensions]
    words = r"at most (\S+) % of its tension at rest for (\S+) of the time in place of (\S+), so that"
    stated = re.search(words, runs[0].message)
    assert (stated is not None) == warned
    if stated:
        threshold = float(stated[1]) / 100.0
        share = np.mean(tensions[0] <= threshold * tensions[0][0])
        assert float(stated[3]) == pytest.approx(share, abs=0.005)
    assert (abs(shares[0] - shares[1]) > 0.05) == warned


def kicked(speed_mps, nodes):
    """The run of a buoy on a stiff rope in still water, thrown downwards."""
    sphere = {"buoy.diameter_m": 1.09, "buoy.mass_kg": 555.0, "buoy.added_mass_kg": 351.0, "water.depth_m": 31.1}
    thrown = kick(-1.33 * speed_mps, 0.0, -speed_mps)
    rope = {"length_m": 29.5, "area_m2": 7.9e-4, "density_kgpm3": 1405.0, "bending_stiffness_Nm2": 300.0}
    return ran(line(STILL, sphere, thrown, nodes=nodes, tension=linear(7.1e6), **rope), duration_s=4.0)


@pytest.mark.parametrize("speed_mps, nodes, warned", [(0.01, 21, False), (0.4, 31, True)])
def test_a_largest_tension_that_the_grid_decides_is_told(speed_mps, nodes, warned):
    coarse, fine = kicked(speed_mps, nodes), kicked(speed_mps, 4 * (nodes - 1) + 1)
    largest_N = [run.columns["tension_top_high_N"].max() for run in (coarse, fine)]
    stated = re.search(r"nodes at .* the largest tension is (\S+) N in place of (\S+) N", coarse.message)
    assert (stated is not None) == warned == (abs(largest_N[0] / largest_N[1] - 1.0) > 0.05)
    if stated:
        assert float(stated[2]) == pytest.approx(largest_N[0], rel=1e-3)


@pytest.mark.parametrize("steepness, nodes, warned", [(0.15, 41, True), (0.15, 81, False), (0.01, 41, False)])
def test_the_first_waves_tell_of_a_grid_too_coarse_for_a_light_buoy(steepness, nodes, warned):
    """A thin rope carries a buoy of 27 kg; both go on for twelve waves, of which the first five are repeated."""
    rope = {"length_m": 44.5, "area_m2": 8.4e-5, "density_kgpm3": 2600.0, "bending_stiffness_Nm2": 0.3}
    buoy = CAP | {"buoy.diameter_m": 0.404, "buoy.mass_kg": 27.0, "buoy.added_mass_kg": 17.7}
    waves = {"waves.period_s": 4.0, "waves.steepness": steepness, "waves.ramp_s": 5.0, "water.depth_m": 44.54}
    scene = line(buoy, waves, tension=linear(4.3e5), nodes=nodes, drag_normal=0.53, **rope)
    message = ran(scene, duration_s=48.0).message
    assert ("in the first 25 s," in message and "grid or tolerance decide" in message) == warned


def test_a_run_from_a_kick_in_waves_is_not_repeated(monkeypatch):
    monkeypatch.setattr(companions, "_differences", None)  # to call it is an error
    scene = line({"waves.steepness": 0.1, **kick(1.0), "tether.nodes": 11})
    assert ran(scene, duration_s=1.0).message == ""


def differing(grid, tension=0.0, slack=0.0, then=0.0, half=0.0):
    """Of the run on another grid, in per cent: of the largest tension, of a slack fraction of 40 %, of the tension at
    the time of the largest, and of the slack fraction for half the threshold."""
    fractions = np.array([0.3, 0.4, 0.5]), np.array([0.3 + half / 100.0, 0.4 + slack / 100.0, 0.5])
    tensions = {"tension": tension / 100.0, "at_peak_N": 100.0 - then, "at_peak": then / 100.0}
    return companions._Differences(
        100.0, 100.0 + tension, **tensions, slack=fractions[0], other_slack=fractions[1], settings=grid
    )


ENDS_EARLY = "ends early"


def outcome(monkeypatch, coarse, fine, water=DEEP, pressed_N=0.0, told="", depends=False):
    """The grid of which `other_grids` speaks, "agree", or nothing; a run that is None is not to be made.

    depends: the slack fraction depends on its threshold.
    """
    monkeypatch.setattr(companions, "_depends_on_threshold", lambda *_: depends)
    run = Run(line(water, SLACK), 0.1)
    columns = {"tension_top_high_N": np.array([9.0, 100.0]), "tension_min_N": np.array([-pressed_N, 0.0])}

    def differences(run, columns, duration_s, grid):
        made = coarse if grid is companions.COARSE else fine
        assert made is not None
        return None if made is ENDS_EARLY else made

    monkeypatch.setattr(companions, "_differences", differences)
    others = companions.other_grids(run, columns, doubted=told == "measured", bounded=told == "bounded")
    if others.agree:
        assert not others.words
        return "agree"
    return others.words.partition(" ")[0]


@pytest.mark.parametrize("coarse, fine, water, pressed_N, told, expected", [
    (1.0, None, DEEP, 0.0, "", ""),  # no hint: no finer run
    (1.0, 2.0, DRY, 0.0, "", "fine"),  # nothing calms waves across the line
    (1.0, 4.0, DEEP, 20.0, "", "fine"),  # pressed together before its largest tension
    (1.0, None, DEEP, 5.0, "", ""),
    (2.9, 1.6, DRY, 0.0, "", "fine"),
    (2.9, 1.4, DRY, 0.0, "", ""),
    (2.0, 4.0, DEEP, 0.0, "", "fine"),
    (9.0, 2.0, DEEP, 0.0, "", ""),  # the finer run decides
    (4.0, 2.0, DEEP, 0.0, "", "fine"),  # the differences do not shrink
    (16.0, None, DEEP, 0.0, "", "coarse"),  # too large for a finer run to refute
    (14.0, 2.0, DEEP, 0.0, "", ""),
    (9.0, None, DEEP, 0.0, "measured", "coarse"),
    (4.0, None, DEEP, 0.0, "measured", ""),
    (9.0, None, DEEP, 0.0, "bounded", "coarse"),
    (6.0, None, DEEP, 0.0, "bounded", ""),  # too far from the run to refute a bound
    (4.0, 5.0, DEEP, 0.0, "bounded", "fine"),
    (4.0, 1.6, DEEP, 0.0, "bounded", ""),
    (4.0, 1.4, DEEP, 0.0, "bounded", "agree"),  # the bound is refuted
    (1.0, 1.0, DEEP, 0.0, "bounded", "agree"),
    (4.0, None, DRY, 0.0, "bounded", ""),  # nothing calms waves across the line
    (4.0, None, DRY, 0.0, "", "coarse"),  # folds and waves that scatter
    (4.0, 1.0, DEEP, 20.0, "", ""),  # drag calms the folds
])  # fmt: skip
def test_which_other_grid_decides_by_its_largest_tension(coarse, fine, water, pressed_N, told, expected, monkeypatch):
    finer = None if fine is None else differing("fine", fine)
    assert outcome(monkeypatch, differing("coarse", coarse), finer, water, pressed_N, told) == expected


@pytest.mark.parametrize("coarse, fine, told, expected", [
    (3.6, 9.0, "", "coarse"),
    (3.4, 3.9, "", ""),
    (3.0, 4.1, "", "fine"),
    (1.0, 2.1, "bounded", ""),
    (1.0, 1.9, "bounded", "agree"),
])  # fmt: skip
def test_which_other_grid_decides_by_its_slack_fraction(coarse, fine, told, expected, monkeypatch):
    pair = differing("coarse", slack=coarse), differing("fine", slack=fine)
    assert outcome(monkeypatch, *pair, told=told) == expected


@pytest.mark.parametrize("half, expected", [(5.6, "coarse"), (5.4, "")])
def test_half_the_elements_tell_a_slack_fraction_for_half_the_threshold(half, expected, monkeypatch):
    assert outcome(monkeypatch, differing("coarse", half=half), differing("fine")) == expected


@pytest.mark.parametrize("fine, expected", [
    (differing("fine", slack=2.1), "fine"),
    (differing("fine", slack=1.9), ""),
    (differing("fine", then=1.6), "fine"),
    (differing("fine", then=1.4), ""),
])  # fmt: skip
def test_a_hint_on_twice_the_elements_is_told_without_drag(fine, expected, monkeypatch):
    assert outcome(monkeypatch, differing("coarse"), fine, DRY) == expected
    assert outcome(monkeypatch, differing("coarse", slack=2.1), fine, DEEP) == ""


def test_a_slack_fraction_that_depends_on_its_threshold_calls_for_a_finer_grid(monkeypatch):
    assert outcome(monkeypatch, differing("coarse"), differing("fine", slack=4.1), depends=True) == "fine"


@pytest.mark.parametrize(("load_N", "depends"), [(2.0, False), (8.0, True), (12.0, False)])
def test_a_slack_fraction_depends_on_its_threshold_where_a_tension_lies_between_half_and_twice(
    load_N, depends, monkeypatch
):
    """Threshold of 5 N; a tension of 100 N is load_N for a tenth of the time."""
    monkeypatch.setattr(companions, "static_tension_N", lambda *_: 100.0)
    tension_N = np.where(np.arange(100) < 10, load_N, 100.0)
    assert companions._depends_on_threshold(None, {"tension_top_N": tension_N}) == depends


@pytest.mark.parametrize("coarse, expected", [
    (differing("coarse", 9.0), "coarse"),
    (differing("coarse", 7.0), ""),
    (ENDS_EARLY, companions.UNCOMPARED.partition(" ")[0]),
])  # fmt: skip
def test_where_the_finer_run_ends_early_the_coarser_one_speaks(coarse, expected, monkeypatch):
    assert outcome(monkeypatch, coarse, ENDS_EARLY) == expected


def test_the_same_largest_tension_of_another_snap_calls_for_a_finer_grid(monkeypatch):
    assert outcome(monkeypatch, differing("coarse", then=9.0), differing("fine", 4.0)) == "fine"


@pytest.mark.parametrize("agree", [False, True])
def test_a_refuted_bound_is_not_told_but_lost_ringing_is(agree, monkeypatch):
    monkeypatch.setattr(trust, "other_grids", lambda *_, **known: companions.OtherGrids("", agree))
    monkeypatch.setattr(trust, "words_of_folds", lambda *_: "folds")
    monkeypatch.setattr(trust, "unresolved", lambda *_: "ringing")
    run = Run(line(DRY, SLACK), 0.1)
    run.finish(lambda simulated_s: None)
    columns = columns_of(run.output.samples[: run.goal], run.scene)
    assert trust.doubts_of(run, columns) == ("ringing" if agree else "ringing; folds")


def test_the_tension_of_another_run_is_also_that_at_the_time_of_the_largest(monkeypatch):
    """Two snaps, which bear 100 and 98 N; in the other run 60 and 101 N."""
    run = Run(line(DEEP, SLACK), 0.5)
    base, other = np.zeros(31), np.zeros(31)
    base[[10, 25]], other[[11, 25]] = (100.0, 98.0), (60.0, 101.0)
    made = {"tension_top_high_N": other, "tension_top_N": other, "time_s": np.arange(31.0)}
    monkeypatch.setattr(companions, "_columns_of_companion", lambda *_: made)
    monkeypatch.setattr(companions, "static_tension_N", lambda *_: np.nan)
    differences = companions._differences(run, {**made, "tension_top_high_N": base}, 0.5, companions.COARSE)
    assert (differences.tension, differences.at_peak) == pytest.approx((0.01, 0.4))


@pytest.mark.parametrize("grid", [companions.COARSE, companions.FINE])
def test_a_line_has_the_same_damping_on_other_grids(grid):
    """Its share of the critical damping of an element is then another, because elements are."""
    run = Idle(line(DRY, SLACK, damping_critical=0.1, nodes=21), 0.5)
    other = companions._on_grid(run, grid)[0]
    assert numbers_of(other)[0]["damping"] == pytest.approx(run.record["damping"])


@pytest.mark.parametrize(("step_s", "told"), [(0.05, True), (0.02, False), (0.01, False)])
def test_a_slack_fraction_that_is_read_off_too_few_samples_is_told(step_s, told, monkeypatch):
    """The tension is above the threshold for 0.07 of each 0.17 s, for 5 s."""
    run = Run(line(DEEP, SLACK), 0.5)
    time_s = np.arange(0.0, 5.0, step_s)
    monkeypatch.setattr(companions, "static_tension_N", lambda *_: 100.0)
    words = trust._few_samples(run, {"time_s": time_s, "tension_top_N": np.where(time_s % 0.17 < 0.07, 1000.0, 0.0)})
    assert ("holds to 0.04; lower output.step_s" in words) == told and bool(words) == told


@pytest.mark.parametrize(("nodes", "EI", "told"), [(161, 0.4, True), (161, 40.0, False), (41, 0.4, True)])
def test_a_bend_at_a_clamp_that_the_grid_does_not_resolve_is_told(nodes, EI, told):
    """A clamp leans by 60 degrees. The line bends within sqrt(EI/T), 14 or 141 mm; elements are 125 or 500 mm long.
    On 41 nodes a run in waves fails at once.
    """
    leaning = {"anchor.rotation": "clamped", "anchor.direction": [0.866, 0.0, 0.5], "waves": None}
    run = simulate(line(SPACE, leaning, nodes=nodes, bending_stiffness_Nm2=EI), duration_s=0.2)
    assert ("at a clamp the line bends" in run.message) == told
