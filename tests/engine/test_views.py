"""What a run says of itself, on motions made of known lines: period 2, a torus, a failed run, one without waves."""

import math
import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from engine import Trajectory, load_scene, simulate
from engine.__main__ import main
from engine.animation import shapes_of
from engine.natural_frequencies import axial_period_s, impact_Nspm
from engine.physics.sea import elevation_m
from engine.run.rest import static_tension_N
from engine.trajectory import COLUMNS, TangentGrowth
from engine.views import FOLLOWED, doubt_of_verdict, facts, strobed_states
from tests.engine.lines import line

PERIODS, STEPS = 310, 100
GOLDEN = 0.5 * (np.sqrt(5.0) - 1.0)


def moved(ratio: float, growth: float | None = None, scene: str = "tethered_buoy", **ending) -> Trajectory:
    """r = 20 + cos(w t) + cos(ratio w t)/2 straight above the anchor; every perturbation grows by `growth` nats."""
    turns = np.arange(PERIODS * STEPS + 1) / STEPS
    angle = 2.0 * np.pi * turns
    radius_m = 20.0 + np.cos(angle) + 0.5 * np.cos(ratio * angle)
    rate_mps = -2.0 * np.pi / 5.0 * (np.sin(angle) + 0.5 * ratio * np.sin(ratio * angle))
    known = {"time_s": 5.0 * turns, "z_m": radius_m, "radius_m": radius_m, "radius_rate_mps": rate_mps}
    columns = {name: known.get(name, np.zeros(len(turns))) for name in COLUMNS}
    wobble = 0.1 * np.sin(np.arange(PERIODS))
    tangent = None if growth is None else TangentGrowth(5.0, (growth + wobble)[:, None], np.zeros(PERIODS))
    ended = {"status": "ok", "message": ""} | ending
    return Trajectory(load_scene(scene), columns=columns, statistics={}, tangent=tangent, **ended)


def test_a_motion_of_period_2():
    run = moved(0.5, -0.2)
    assert run.verdict().regime == "period-2" and run.verdict().period == 2
    points = run.section().points
    assert len(points) == PERIODS - PERIODS // 3 + 1
    np.testing.assert_allclose(points[2:], points[:-2], atol=1e-9)
    assert np.abs(points[1:] - points[:-1]).max() > 0.5
    lines = run.spectrum()
    half = np.argmax(lines.amplitude[1:-1] * (lines.angular_frequency_radps[1:-1] < 0.9 * 2 * np.pi / 5)) + 1
    assert lines.angular_frequency_radps[half] == pytest.approx(np.pi / 5)
    assert lines.amplitude[half] == pytest.approx(0.25) and lines.amplitude[half + 1] == pytest.approx(0.0, abs=1e-9)


def test_a_motion_is_judged_in_the_plane_of_its_waves_whatever_their_direction():
    """A buoy that swings with period 2 along the waves, and with period 1 across them and in height."""
    angle = 2.0 * np.pi * np.arange(PERIODS * STEPS + 1) / STEPS
    along_m, across_m = np.cos(0.5 * angle), 0.5 * np.sin(angle)
    strobed = []
    for heading in (0.0, 2.5):
        run = moved(1.0)
        scene = load_scene("tethered_buoy", {"motion.dimensions": 3, "waves.direction_rad": heading})
        x_m = math.cos(heading) * along_m - math.sin(heading) * across_m
        y_m = math.sin(heading) * along_m + math.cos(heading) * across_m
        strobed.append(strobed_states(replace(run, scene=scene, columns=run.columns | {"x_m": x_m, "y_m": y_m}), 30))
    (points, scale), (turned_points, turned_scale) = strobed
    assert np.abs(points[2:] - points[:-2]).max() < 1e-9 < 0.5 < np.abs(points[1:] - points[:-1]).max()
    np.testing.assert_allclose(turned_points, points, atol=1e-9)
    assert turned_scale == pytest.approx(scale)


def test_a_torus_needs_perturbations_to_be_told():
    assert moved(GOLDEN, 0.0).verdict().regime == "quasi-periodic"
    verdict = moved(GOLDEN).verdict()
    assert verdict.regime == "undecided" and "output.tangent_vectors = 1" in verdict.reason


def test_the_exponent_is_that_of_the_tangent_dynamics_where_it_was_carried():
    run = moved(GOLDEN, 0.05)
    computed, later = run.exponent(), run.exponent(transient_periods=100)
    assert abs(computed.value - 0.05 / np.log(2.0)) < 2.0 * computed.error + 1e-3 and "tangent" in computed.method
    for exponent, begin in ((computed, PERIODS // 3), (later, 100)):
        assert exponent.details["periods"] == PERIODS - begin and f"over periods {begin} to {PERIODS}" in str(exponent)
    assert "Wolf" in moved(0.5).exponent().method


def test_exponent_and_verdict_speak_of_the_same_part():
    """A motion of period 2 after 130 periods of something else, whose perturbations grew."""
    run = moved(0.5, -0.2)
    for name in ("radius_m", "radius_rate_mps"):
        run.columns[name][: 130 * STEPS] *= 1.1
    run.tangent.growth_nats[:130] += 0.5
    verdict, exponent = run.verdict(), run.exponent()
    assert verdict.transient == 130 and exponent.details["periods"] == PERIODS - 130
    assert exponent.value == pytest.approx(-0.2 / np.log(2.0), abs=0.01)
    assert "perturbations shrink" in verdict.reason


@pytest.mark.parametrize(("ratio", "growth"), [(0.5, -0.2), (GOLDEN, 0.0), (GOLDEN, 0.3)])
def test_a_run_has_one_number_for_the_growth_of_its_perturbations(ratio, growth):
    run = moved(ratio, growth)
    exponent = run.exponent()
    for number in re.findall(r"(\S+ ± \S+) bits per period", str(run.verdict())):
        assert number == f"{exponent.value:.3f} ± {exponent.error:.3f}"


@pytest.mark.parametrize(
    ("ratio", "growth", "finer", "doubted"),
    [
        (0.5, -0.2, 0.3, True),
        (0.5, -0.2, -0.3, False),
        (GOLDEN, 0.3, -0.3, True),
        (GOLDEN, 0.3, 0.2, True),
        (GOLDEN, 0.3, 0.4, False),
        (GOLDEN, 0.0, 0.3, False),
    ],
)
def test_growth_on_a_finer_grid_that_speaks_against_a_verdict_is_told(ratio, growth, finer, doubted, monkeypatch):
    """Of a period and of chaos; a torus is not asked."""
    asked = []

    def simulate_finer(scene, periods, start):
        asked.append((scene.tether.nodes, scene.solver.rtol, scene.waves.ramp_s, periods, start))
        return moved(ratio, finer)

    monkeypatch.setattr("engine.simulate", simulate_finer)
    run = moved(ratio, growth, final_state=SimpleNamespace(at_zero=lambda: "last state"))
    words = doubt_of_verdict(run)
    assert asked == [(81, pytest.approx(0.03 / 4.0), 0.0, FOLLOWED, "last state")] * (growth != 0.0)
    assert bool(words) == doubted and ("on 81 nodes" in words) == doubted
    run.columns["tension_top_low_N"][:] = 100.0
    asked.clear()
    assert doubt_of_verdict(run) == "" and not asked, "a line that was never slack has nothing to fold"


def test_a_column_is_told_by_its_name_or_refused_with_all_names():
    run = moved(0.5)
    np.testing.assert_array_equal(run.section("radius_m").points[:, 0], run.section().points[:, 0])
    for view in (run.section, run.spectrum):
        with pytest.raises(ValueError, match=r"'radius'.*radius_m.*tension_top_N"):
            view("radius")


def test_a_notebook_shows_what_the_run_did():
    shown = moved(0.5, -0.2)._repr_html_()
    assert "period-2" in shown and f"ok, {PERIODS} wave periods" in shown
    failed = moved(0.5, status="newton-failed", message="at t < 3 s")._repr_html_()
    assert "newton-failed" in failed and "t &lt; 3 s" in failed and "period-2" not in failed
    assert len(repr(moved(0.5))) < 100


def pulled():
    """The largest tension is at t = 5 s, within every beginning; the largest after t = 40 s is at t = 900 s."""
    run = moved(0.5, -0.2)
    time_s = run.columns["time_s"]
    run.columns["tension_top_high_N"] = 7e3 * (time_s == 5.0) + 5e3 * (time_s == 900.0)
    return run


def test_extremes_are_those_of_the_whole_run_and_those_after_its_beginning():
    sea, ramp = {"waves.jonswap.significant_height_m": 1.0}, {"waves.ramp_s": 40.0}
    for changes, begin_s in (({}, "516.65"), ({"waves.ramp_s": 600.0}, "600"), (sea, ""), ({**sea, **ramp}, "40")):
        words = "whole run: 0.00 (t = 0 s) to 7000.00 N at the top (t = 5 s)"
        if begin_s:
            words += f"; after t = {begin_s} s: 0.00 (t = {begin_s} s) to 5000.00 N at the top (t = 900 s)"
        assert facts(replace(pulled(), scene=line(changes)))["tension"] == words


def test_the_table_of_extremes_has_both_parts_with_moments():
    run = pulled()
    run.columns["tension_max_N"] = np.where(run.columns["time_s"] == 700.0, 8e3, 0.0)
    table = run.extremes()
    assert list(table.index.unique("part")) == ["whole run", "after t = 516.65 s"]
    assert table.loc[("whole run", "tension_top_N"), ["largest", "largest_s"]].tolist() == [7e3, 5.0]
    assert table.loc[("after t = 516.65 s", "tension_top_N"), ["largest", "largest_s"]].tolist() == [5e3, 900.0]
    assert table.loc[("after t = 516.65 s", "tension_line_N"), ["largest", "largest_s"]].tolist() == [8e3, 700.0]
    assert table.loc[("whole run", "radius_m"), "largest"] == pytest.approx(21.5)


@pytest.mark.parametrize(("most_N", "told"), [(7.2e3, False), (8e3, True)])
def test_a_line_that_bears_more_below_its_top_is_told_with_its_place(most_N, told):
    """The largest tension at the top is 7 kN."""
    run = pulled()
    run.columns["tension_max_N"] = np.where(run.columns["time_s"] == 700.0, most_N, 0.0)
    run.columns["tension_max_s_m"] = np.full(len(run.columns["time_s"]), 2.5)
    assert facts(run).get("line") == ("bears up to 8000.00 N (t = 700 s), 2.5 m from the anchor" if told else None)


def snapping() -> Trajectory:
    """A motion whose tension is zero for half of each period, and then a half sine of 6 kN."""
    run = moved(0.5)
    tension_N = np.maximum(6e3 * np.sin(2.0 * np.pi * run.columns["time_s"] / 5.0), 0.0)
    tension_N[0] = 2e3  # at rest
    for name in ("tension_top_N", "tension_top_high_N", "tension_top_low_N"):
        run.columns[name] = tension_N
    return run


def test_snaps_of_a_run_are_one_a_pull_and_know_the_rope():
    """The first pull has no slack before it. Impact: sqrt(k (M + M_a)) with k = EA/l0 = 2500 N/m."""
    run = snapping()
    table = run.snaps(static_N=2e3)
    assert len(table) == PERIODS - 1
    np.testing.assert_allclose(np.diff(table.taut_s), 5.0, atol=1e-9)
    np.testing.assert_allclose(table.peak_over_static, 3.0, rtol=1e-3)
    impact = table.peak_N / (table.taut_speed_mps * np.sqrt(2500.0 * (1611.0 + 907.0)))
    rising = table.taut_speed_mps > 0.0
    np.testing.assert_allclose(table.peak_over_impact[rising], impact[rising], rtol=1e-6)
    assert table.attrs["slack_N"] == pytest.approx(100.0) and set(table.attrs["units"]) == set(table.columns)
    assert facts(run)["snaps"].startswith(f"whole run: {PERIODS - 1} in 1550 s; the hardest pulls with 6000.00 N")
    assert len(run.snaps(static_N=2e3, snap_share=3.1)) == 0
    assert len(run.snaps(static_N=2e3, transient_s=1000.0)) == PERIODS - 200


def test_a_run_that_blew_up_has_the_snaps_before():
    run = snapping()
    run.columns["tension_top_N"][-1000:] = np.nan
    assert len(run.snaps(static_N=2e3)) == PERIODS - 11


def test_a_line_without_tension_at_rest_needs_one_for_its_snaps():
    with pytest.raises(ValueError, match="static_N"):
        replace(moved(0.5), scene=load_scene("falling_chain")).snaps()


def test_ringing_of_the_line_is_that_of_a_wave_to_the_anchor_and_back():
    """2 l sqrt(m/EA) of the shipped rope: 53.5 ms."""
    scene = line()
    assert axial_period_s(scene, 2e3) == pytest.approx(2.0 * 20.0 * np.sqrt(1140.0 * 7.85e-5 / 5e4), rel=1e-6)
    assert impact_Nspm(load_scene("hanging_line"), 10.0) is None


def test_mistakes_get_one_line(tmp_path):
    run = moved(0.5)
    assert run["radius_m"] is run.columns["radius_m"]
    assert run.table().attrs["units"]["tension_top_N"] == "N"
    for call, error, words in (
        (lambda: run["tension"], ValueError, "no column 'tension'.*tension_top_N"),
        (lambda: run.save(tmp_path / "none" / "run.nc"), FileNotFoundError, "there is no folder"),
        (lambda: run.animate(tmp_path / "run.gif"), ValueError, "output.profiles"),
        (lambda: run.animate(tmp_path / "run.mp4"), ValueError, "ends in .gif"),
        (lambda: run.spectrum(transient_periods=310), ValueError, "less than the 310 periods"),
        (lambda: run.snaps(static_N="much"), ValueError, "much"),
        (lambda: simulate("tethered_buoy", periods="3"), ValueError, "periods: given '3'"),
        (lambda: simulate("tethered_buoy", periods=-3), ValueError, "periods: given -3; allowed: a number above 0"),
        (lambda: simulate("tethered_buoy", periods=3, progress="yes"), ValueError, "progress: given 'yes'"),
        (lambda: simulate(None, periods=3), TypeError, "scene: given None"),
        (lambda: simulate("tethered_bouy", periods=3), ValueError, "did you mean 'tethered_buoy'"),
    ):
        with pytest.raises(error, match=words) as caught:
            call()
        assert "\n" not in str(caught.value)


def test_a_name_is_a_scene_and_a_run_with_shapes_moves(tmp_path):
    changes = {"tether.nodes": 5, "tether.grid_stretching": 1.0, "waves.steepness": 0.01, "output.profiles": True}
    run = simulate(line(changes), periods=2)
    run.animate(tmp_path / "run.gif", begin_s=1.0, duration_s=2.0)
    assert (tmp_path / "run.gif").read_bytes().startswith(b"GIF")
    (tmp_path / "mine.toml").write_text(run.scene.to_toml())
    from_file = simulate(tmp_path / "mine.toml", periods=2)
    np.testing.assert_array_equal(from_file["tension_top_N"], run["tension_top_N"])
    profiles = run.profiles
    np.testing.assert_array_equal(run["tension_anchor_N"], profiles.tension_N[:, 0])
    np.testing.assert_array_equal(run["tension_max_N"], profiles.tension_N.max(axis=1))
    np.testing.assert_allclose(run["tension_max_s_m"], profiles.s_m[profiles.tension_N.argmax(axis=1)])


def test_the_surface_in_a_moving_picture_is_that_over_the_anchor():
    place = {"anchor.position_m": [7.0, 9.0, 0.0], "motion.dimensions": 3, "waves.direction_rad": 0.5 * np.pi}
    scene = line(place, {"waves.steepness": 0.05, "output.profiles": True}, nodes=5)
    run = simulate(scene, periods=3)
    across_m, height_m = shapes_of(run).water
    nearest = np.argmin(np.abs(across_m))
    heights = elevation_m(scene, run.profiles.time_s, 7.0 + across_m[nearest], 9.0) + scene.water.depth_m
    assert height_m[:, nearest] == pytest.approx(heights[-len(height_m) :], abs=1e-9)


def test_a_periodic_section_is_a_dot_and_not_its_rounding():
    from matplotlib import pyplot

    axes = moved(1.0).plot()
    (low, high), (slow, fast) = axes["section"].get_xlim(), axes["section"].get_ylim()
    assert high - low > 0.009 * 3.0 and fast - slow > 0.009 * 3.7
    assert "angle" in axes
    pyplot.close(axes["section"].figure)


def test_what_has_no_period_or_no_end_is_refused_in_words():
    hanging = moved(0.5, scene="hanging_line")
    for view in (hanging.spectrum, hanging.section, hanging.exponent):
        with pytest.raises(ValueError, match="no period"):
            view()
    with pytest.raises(ValueError, match="regular waves"):
        hanging.verdict()
    with pytest.raises(ValueError, match="reached its end"):
        moved(0.5, status="newton-failed").verdict()


def test_the_figure_is_a_file_or_stays_open_for_changes(tmp_path):
    """Also that of a run that blew up, as far as it goes, and of one without waves."""
    from matplotlib import pyplot

    whole, hanging = moved(0.5), moved(0.5, scene="hanging_line")
    failed = moved(0.5, status="not-finite")
    failed.columns["radius_m"][-5:] = np.nan
    for run, panel, kind, mark in (
        (whole, "section", "png", b"\x89PNG"),
        (hanging, "path", "svg", b"<?xml"),
        (failed, "path", "pdf", b"%PDF"),
    ):
        path = tmp_path / f"run.{kind}"
        assert panel in run.plot(path) and path.read_bytes().startswith(mark)
    open_figures = pyplot.get_fignums()
    axes = whole.plot()
    assert len(pyplot.get_fignums()) == len(open_figures) + 1
    pyplot.close(axes["section"].figure)


def test_the_command_runs_a_scene_and_saves_its_figure(tmp_path, capsys):
    words = ["tethered_buoy", "--set", "tether.nodes=5", "waves.steepness=0.01", "--periods", "6"]
    assert main([*words, "--out", str(tmp_path / "run.png")]) == 0
    text = capsys.readouterr().out
    assert "6 wave periods, 30 s" in text and "undecided: too short" in text and "run.png" in text
    assert [path.name for path in tmp_path.iterdir()] == ["run.png"]


def test_the_command_lists_the_scenes(capsys):
    assert main([]) == 0
    assert "tethered_buoy" in capsys.readouterr().out


def test_the_static_tension_of_a_run_that_goes_on_is_that_of_rest_and_not_its_first():
    scene = line({"tether.nodes": 9})
    first = simulate(scene, periods=2)
    later = simulate(scene, periods=1, start=first)
    assert static_tension_N(scene, first.columns) == first.columns["tension_top_N"][0]
    assert abs(later.columns["tension_top_N"][0] / first.columns["tension_top_N"][0] - 1.0) > 0.01
    assert static_tension_N(scene, later.columns) == pytest.approx(first.columns["tension_top_N"][0], rel=1e-12)


def test_the_static_tension_of_a_buoy_that_is_let_go_is_its_lift_and_not_what_it_was_held_with():
    scene = line({"tether.nodes": 9, "start.buoy_displacement_m": [0.0, 0.0, 0.5]})
    lift_N = (scene.water.density_kgpm3 * np.pi * 1.5**3 / 6.0 - scene.buoy.mass_kg) * scene.gravity_mps2
    begun = {"radius_rate_mps": np.zeros(1), "angle_rate_radps": np.zeros(1), "tension_top_N": np.full(1, 3e3)}
    assert static_tension_N(scene, begun) == pytest.approx(lift_N, rel=1e-6)
