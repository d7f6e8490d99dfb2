"""What a run says of itself, on motions made of known lines: period 2, a torus, a failed run, one without waves."""

from dataclasses import replace

import numpy as np
import pytest

from engine import Trajectory, load_scene, simulate
from engine.__main__ import main
from engine.run.rest import static_tension_N
from engine.trajectory import COLUMNS, TangentGrowth
from engine.views import facts

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
    said = {"status": "ok", "message": ""} | ending
    return Trajectory(load_scene(scene), columns=columns, statistics={}, tangent=tangent, **said)


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


def test_a_torus_needs_perturbations_to_be_told():
    assert moved(GOLDEN, 0.0).verdict().regime == "quasi-periodic"
    alone = moved(GOLDEN).verdict()
    assert alone.regime == "undecided" and "output.tangent_vectors = 1" in alone.reason


def test_the_exponent_is_that_of_the_tangent_dynamics_where_it_was_carried():
    found = moved(GOLDEN, 0.05).exponent()
    assert abs(found.value - 0.05 / np.log(2.0)) < 2.0 * found.error + 1e-3 and "tangent" in found.method
    assert found.details["periods"] == PERIODS - PERIODS // 3
    assert moved(GOLDEN, 0.05).exponent(transient_periods=100).details["periods"] == PERIODS - 100
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


def test_extremes_are_those_of_the_whole_run_and_those_after_its_beginning():
    """The largest tension is at t = 5 s, within every beginning; the largest after t = 40 s is at t = 900 s."""
    sea = {"waves.jonswap.significant_height_m": 1.0}
    whole, kept = "7000.00 N at the top (t = 5 s)", "5000.00 N at the top (t = 900 s)"
    for changes, later in (
        ({}, f"after t = 516.65 s: 0.00 (t = 516.65 s) to {kept}"),
        ({"waves.ramp_s": 600.0}, f"after t = 600 s: 0.00 (t = 600 s) to {kept}"),
        (sea, ""),
        ({**sea, "waves.ramp_s": 40.0}, f"after t = 40 s: 0.00 (t = 40 s) to {kept}"),
    ):
        run = replace(moved(0.5, -0.2), scene=load_scene("tethered_buoy", changes))
        time_s = run.columns["time_s"]
        run.columns["tension_top_high_N"] = np.where(time_s == 5.0, 7e3, np.where(time_s == 900.0, 5e3, 1.0))
        said = "; ".join(filter(None, (f"whole run: 0.00 (t = 0 s) to {whole}", later)))
        assert facts(run)["tension"] == said


def test_what_has_no_period_or_no_end_is_refused_in_words():
    still = moved(0.5, scene="hanging_line")
    for view in (still.spectrum, still.section, still.exponent):
        with pytest.raises(ValueError, match="no period"):
            view()
    with pytest.raises(ValueError, match="regular waves"):
        still.verdict()
    with pytest.raises(ValueError, match="reached its end"):
        moved(0.5, status="newton-failed").verdict()


@pytest.mark.parametrize(("scene", "panel"), [("tethered_buoy", "section"), ("hanging_line", "path")])
def test_the_figure_is_a_file_or_stays_open_for_changes(scene, panel, tmp_path):
    from matplotlib import pyplot

    run = moved(0.5, scene=scene)
    for kind, mark in (("png", b"\x89PNG"), ("svg", b"<?xml"), ("pdf", b"%PDF")):
        run.plot(tmp_path / f"run.{kind}")
        assert (tmp_path / f"run.{kind}").read_bytes().startswith(mark)
    before = pyplot.get_fignums()
    axes = run.plot()
    assert len(pyplot.get_fignums()) == len(before) + 1 and panel in axes
    pyplot.close(axes[panel].figure)


def test_a_run_that_blew_up_is_drawn_as_far_as_it_goes(tmp_path):
    run = moved(0.5, status="not-finite")
    run.columns["radius_m"][-5:] = np.nan
    run.plot(tmp_path / "run.png")
    assert "path" in run.plot(tmp_path / "run.svg")


def test_the_command_runs_a_scene_and_saves_its_figure(tmp_path, capsys):
    words = ["tethered_buoy", "--set", "tether.nodes=5", "waves.steepness=0.01", "--periods", "6"]
    assert main([*words, "--out", str(tmp_path / "run.png")]) == 0
    said = capsys.readouterr().out
    assert "6 wave periods, 30 s" in said and "undecided: too short" in said and "run.png" in said
    assert [path.name for path in tmp_path.iterdir()] == ["run.png"]


def test_the_command_lists_the_scenes(capsys):
    assert main([]) == 0
    assert "tethered_buoy" in capsys.readouterr().out


def test_the_static_tension_of_a_run_that_goes_on_is_that_of_rest_and_not_its_first():
    scene = load_scene("tethered_buoy", {"tether.nodes": 9})
    first = simulate(scene, periods=2)
    later = simulate(scene, periods=1, start=first)
    assert static_tension_N(scene, first.columns) == first.columns["tension_top_N"][0]
    assert abs(later.columns["tension_top_N"][0] / first.columns["tension_top_N"][0] - 1.0) > 0.01
    assert static_tension_N(scene, later.columns) == pytest.approx(first.columns["tension_top_N"][0], rel=1e-12)
