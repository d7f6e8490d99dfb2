"""The out-of-plane campaign: what it runs, what a row says, what a failure does; its report's verdicts."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from campaigns import out_of_plane
from campaigns.explore.space import DIRECTIONS, SEED_MPS, in_space, velocity
from campaigns.machinery.cli import Running
from campaigns.machinery.folder import trajectory_path
from campaigns.out_of_plane.pairs import agreement
from campaigns.out_of_plane.rows import COLUMNS, bows, offplane_row
from engine import Trajectory, load_scene
from engine.physics.waves import wave_number
from engine.trajectory import Profiles
from reports.out_of_plane.report import report
from reports.out_of_plane.runs import read_study
from reports.parts.content import Figure
from tables import names
from tests.campaigns.conftest import chosen, order_of, ran, rows_of
from tests.campaigns.fake_engine import BURST_M, BURST_PERIODS, LARGE_RATE, SMALL_RATE, SpaceEngine, sines
from tests.reports.conftest import of_kind, warned


def made(place, periods, **engine):
    """The rows of a campaign of the fake engine."""
    return ran(out_of_plane, place, "--periods", periods, simulate=SpaceEngine(**engine))


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    return tmp_path_factory.mktemp("plane") / "out"


@pytest.fixture(scope="module")
def rows(place):
    return made(place, 60)


def test_everything_the_question_needs_is_run_once():
    order = order_of(out_of_plane)
    scenes = {out_of_plane.variant(case.labels): case.scene for case in order.cases}
    assert len({scene.key() for scene in scenes.values()}) == len(order.cases)
    planar = [run for run in scenes if run.dimensions == 2]
    assert len(planar) == 10 and all(scenes[run].output.lateral_growth for run in planar)
    _, depths_m = out_of_plane.depths_of(order)
    compared = [run for run in scenes if out_of_plane.compared(run, out_of_plane.base_of(order), depths_m)]
    pairs = [(depth, dimensions) for depth in (21.0, 21.6, 22.0) for dimensions in (2, 3)]
    assert sorted((run.depth_m, run.dimensions) for run in compared) == pairs


def test_an_option_of_old_scripts_is_accepted_and_changes_nothing():
    plain, with_option = (
        [case.key for case in order_of(out_of_plane, *words).cases] for words in ([], ["--no-accuracy"])
    )
    assert plain == with_option
    assert "--no-accuracy" not in out_of_plane.parser().format_help()


def test_another_scene_becomes_the_base_of_what_is_varied():
    order = order_of(out_of_plane, "--set", "water.depth_m=23", "tether.nodes=61")
    base = out_of_plane.base_of(order)
    assert (base.depth_m, base.nodes) == (23.0, 61)
    assert {23.0, 21.0} <= {case.labels["depth_m"] for case in order.cases}


def test_a_rope_of_another_length_stays_in_its_depth():
    order = order_of(out_of_plane, "--set", "tether.length_m=39", "water.depth_m=40", "tether.bending_stiffness_Nm2=2")
    assert {case.labels["depth_m"] for case in order.cases} == {40.0}
    assert {case.labels["bending_stiffness_Nm2"] for case in order.cases} == {0.5, 2.0, 20.0}


KICK_MPS = 0.5, 0.0, 0.2
OWN = {"waves.amplitude_m": 0.4, "waves.period_s": 6.0, "tether.length_m": 19.0, "start.buoy_velocity_mps": KICK_MPS}


def test_an_own_scene_runs_in_its_own_wave_and_from_its_own_kick(tmp_path):
    """Beside a lower wave in the ratio of the paper's two. A push adds to the kick, in a plane there is none."""
    (tmp_path / "own.toml").write_text(load_scene("tethered_buoy", OWN).to_toml())
    order = order_of(out_of_plane, "--scene", tmp_path / "own.toml")
    heights_m = set()
    for case in order.cases:
        waves, row = case.scene.waves, case.labels
        heights_m.add(waves.steepness / wave_number(waves.period_s, case.scene.water.depth_m, 9.81))
        pushed = np.subtract(case.scene.start.buoy_velocity_mps, KICK_MPS)
        assert np.linalg.norm(pushed) == pytest.approx(row["seed_mps"], rel=1e-6) and pushed[2] == 0.0
    assert sorted(heights_m) == pytest.approx([0.4 * 0.016 / 0.13, 0.4])


def test_a_sentence_of_the_paper_is_judged_in_its_waves_only(tmp_path):
    place = tmp_path / "out"
    assert made(place, 12) and len(rows_of(place, "statements.csv")) > 3
    assert ran(out_of_plane, place, "--periods", 12, "--set", "waves.amplitude_m=0.6", simulate=SpaceEngine())
    assert not rows_of(place, "statements.csv") and report(place)


def test_rows_say_decay_with_its_rate_and_bursts_with_their_size(rows):
    assert all(row["status"] == "ok" for row in rows)
    bits = SMALL_RATE * 5.0 / math.log(2.0)
    for row in chosen(rows, steepness=0.016, nodes=41, seed_direction="lateral"):
        for body in ("buoy", "rope"):
            assert row[f"{body}_motion"] == "decay" and row[f"{body}_bursts"] == ""
            rate, error = (float(row[f"{body}_rate_{end}"]) for end in ("bits_per_period", "error"))
            assert abs(rate - bits) < min(3 * error, 0.01)
            assert float(row[f"{body}_fit_span_nats"]) < -3.0
    for row in chosen(rows, steepness=0.13, dimensions=3, seed_direction="lateral", profiles=0, nodes=41):
        assert row["rope_motion"] == "bursts" and row["rope_rate_bits_per_period"] == ""
        assert int(row["rope_bursts"]) == 60 // BURST_PERIODS
        assert float(row["rope_burst_median_m"]) == pytest.approx(BURST_M, rel=0.01)
        assert float(row["rope_first_burst_period"]) == pytest.approx(BURST_PERIODS / 2, abs=0.05)
        assert float(row["rope_rise_nats"]) > 3.0 and 0.0 < float(row["rope_rise_periods"]) < BURST_PERIODS


def verdicts(place):
    """Does the small wave not grow, and the large one grow, to the size of the motion?"""
    return [row["verdict"] for row in rows_of(place, "statements.csv")][:3]


def test_a_burst_is_no_growth(rows, place):
    assert verdicts(place) == ["holds", "does not hold", "does not hold"]


def test_the_first_response_is_told_by_the_lateral_part_of_the_push(rows):
    large = chosen(rows, steepness=0.13, dimensions=3)
    gains = [float(row["buoy_early_gain_s"]) for row in large if row["seed_direction"] != "along"]
    assert np.ptp(gains) < 1e-9 * np.mean(gains)
    along = chosen(large, seed_direction="along")[0]
    assert along["buoy_early_gain_s"] == "" and float(along["buoy_lateral_max_m"]) == 0.0
    assert along["buoy_motion"] == "neither" and "zero" in along["buoy_reason"]


def test_planar_rows_have_no_lateral_columns_and_only_what_is_compared_a_verdict(rows):
    for row in chosen(rows, dimensions=2):
        assert all(row[name] == "" for name in names(COLUMNS) if name.startswith(("buoy_", "rope_")))
        assert row["loop_releases"] != "" and row["radius_max_m"] != ""
    judged = sorted((row["dimensions"], row["depth_m"]) for row in rows if row["regime"])
    assert judged == [(dimensions, depth) for dimensions in "23" for depth in ("21.0", "21.6", "22.0")]


def test_a_run_that_fails_is_a_row_and_the_rest_goes_on(tmp_path):
    rows = made(tmp_path / "out", 6, raises=(0.016,), failing=(25.0,))
    assert {row["status"] for row in chosen(rows, steepness=0.016)} == {"error"}
    failed = chosen(rows, steepness=0.13, depth_m=25.0, dimensions=3)
    assert {row["status"] for row in failed} == {"statics-failed"}
    assert all(row["buoy_motion"] == row["inplane_m"] == "" and row["seed_mps"] == "1e-05" for row in failed)
    assert chosen(rows, steepness=0.13, depth_m=22.0, status="ok")


def test_a_record_that_is_not_finite_is_measured_up_to_there():
    scene = load_scene("tethered_buoy", {"motion.dimensions": 3, "start.buoy_velocity_mps": [0, 1e-5, 0]})
    run = SpaceEngine(large="growth")(scene, 80)
    run.columns["y_m"][7000:] = math.nan
    row = offplane_row(run, 10)
    assert row["buoy_motion"] == "growth" and set(row) <= set(names(COLUMNS))
    error = row["buoy_rate_error"] * math.log(2.0)
    assert abs(row["buoy_rate_nats_per_period"] - 5.0 * LARGE_RATE["growth"]) < 3 * error < 0.1


def test_runs_agree_in_what_their_records_tell():
    """Ends of the range within a hundredth; without a distance of the sections, or an exponent, nothing is said."""
    wolf = "lyapunov_wolf_bits_per_period"
    planar = {"radius_min_m": 20.0, "radius_max_m": 21.0, "regime": "chaotic", wolf: 0.5, "lyapunov_wolf_error": 0.03}
    agreeing = {"range": 1, "section": 1, "exponent": 1, "regime": 1}
    for change, across, differs in (
        ({"radius_max_m": 21.005, wolf: 0.55}, 0.1, {}),
        ({"radius_max_m": 21.02, wolf: 0.65}, 0.2, {"range": 0, "section": 0, "exponent": 0}),
        ({"regime": "torus", wolf: math.nan}, 0.1, {"exponent": None, "regime": 0}),
        ({"regime": ""}, math.nan, {"section": None, "regime": None}),
    ):
        chosen_rows = agreement(planar, planar | change, across, 0.1)
        assert {name: chosen_rows[f"same_{name}"] for name in agreeing} == agreeing | differs


def test_bows_are_measured_from_the_straight_line():
    s = np.linspace(0.0, 1.0, 21)
    along, arch = np.array([[3.0], [0.0]]) * s, np.sin(np.pi * s)
    z = np.array([[4.0], [5.0]]) * s
    x = along + np.array([[0.8], [0.0]]) * 0.5 * arch  # 0.4 off at right angles: 4/5 of a shift of 0.5 in x ...
    y = np.array([[0.2], [0.0]]) * s + np.array([[0.0], [0.3]]) * arch
    assert bows(Profiles(np.array([0.0, 1.0]), s, x, y, z, *(0 * x,) * 3)) == pytest.approx((0.4 * 0.8, 0.3))


def test_a_scene_in_space_gets_a_push_only_where_it_has_none():
    resting, added = in_space(load_scene("tethered_buoy", {"output.tangent_vectors": 1}))
    assert added and resting.motion.dimensions == 3 and resting.output.tangent_vectors == 0
    assert resting.start.buoy_velocity_mps == (0.0, SEED_MPS, 0.0)
    pushed = {"motion.dimensions": 3, "start.buoy_velocity_mps": [0.1, 1e-7, 0.2]}
    unchanged, added = in_space(load_scene("tethered_buoy", pushed))
    assert not added and unchanged.start.buoy_velocity_mps == (0.1, 1e-7, 0.2)
    along_y = {"direction_rad": math.pi / 2}
    listed = {"period_s": 5.0, "components": [along_y | {"period_s": 5.0, "amplitude_m": 0.3}]}
    for waves in ({"waves.direction_rad": math.pi / 2}, {"waves": listed}):
        across, added = in_space(load_scene("tethered_buoy", {"motion.dimensions": 3, **waves}))
        assert added and across.start.buoy_velocity_mps == pytest.approx((-SEED_MPS, 0.0, 0.0), abs=1e-20)


@pytest.mark.parametrize("heading, x, y", [(0.0, 2.0, 0.0), (math.pi, -2.0, 0.0), (math.pi / 2, 0.0, 2.0)])
def test_a_kick_along_the_waves_is_no_push_across_them(heading, x, y):
    """Rounding leaves 1e-16 m/s across the waves; taken for a push, it would leave the buoy in its plane."""
    changes = {"motion.dimensions": 3, "waves.direction_rad": heading, "start.buoy_velocity_mps": [x, y, 0.5]}
    pushed, added = in_space(load_scene("tethered_buoy", changes))
    vx, vy, _ = pushed.start.buoy_velocity_mps
    assert added and vy * math.cos(heading) - vx * math.sin(heading) == pytest.approx(SEED_MPS, rel=1e-9)


def test_directions_have_the_size_of_the_push():
    for word in DIRECTIONS:
        assert np.linalg.norm(velocity(3e-4, word)) == pytest.approx(3e-4)
    assert velocity(1.0, "mirrored") == [0.0, -1.0, 0.0]


@pytest.mark.slow
@pytest.mark.parametrize(("large", "grows"), [("growth", "holds"), ("decay", "does not hold")])
def test_the_paper_is_borne_out_where_its_large_wave_grows_to_the_size_of_the_motion(tmp_path, large, grows):
    made(tmp_path, 80, large=large)
    assert verdicts(tmp_path) == ["holds", grows, grows]
    pairs = rows_of(tmp_path, "pairs.csv")
    assert [row["depth_m"] for row in pairs] == ["21.0", "21.6", "22.0"]
    assert all(row[name] == "1" for row in pairs for name in row if name.startswith("same_"))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("failing", "figures"), [((25.0,), [3, 1]), ((21.0, 21.6, 22.0), [1, 1])], ids=["a depth", "the base"]
)
def test_what_failed_or_is_lost_is_named_and_the_rest_is_shown(failing, figures, tmp_path):
    """The figure over the depth is drawn from the table; the others need trajectories of the base."""
    made(tmp_path, 80, raises=(0.016,), failing=failing)
    items = report(tmp_path).items
    assert any("statics-failed" in line for line in warned(items))
    assert any("a fault of the code" in line for line in warned(items))
    assert verdicts(tmp_path)[0] == "–", "nothing is said of the small wave"
    for path in (tmp_path / "trajectories").glob("*.nc"):
        path.unlink()
    later = report(tmp_path).items
    assert [len(of_kind(page, Figure)) for page in (items, later)] == figures
    assert sum("missing" in line for line in warned(later)) > 10


@pytest.mark.slow
def test_with_the_engine_no_loop_is_released_in_space_and_a_mirrored_push_mirrors_the_motion(tmp_path):
    """Past the first loop in the plane, after 11 periods."""
    words = ["--periods", "14", "--transient", "4", "--no-report", "--out", str(tmp_path)]
    order = order_of(out_of_plane, *words)
    base = out_of_plane.base_of(order)
    cases = []
    for case in order.cases:
        variant = out_of_plane.variant(case.labels)
        if replace(variant, steepness=base.steepness, seed_direction=base.seed_direction) == base:
            cases.append(case)
    order.cases = cases
    assert out_of_plane.STUDY.conduct(order, words) == 0
    study = read_study(tmp_path)
    assert {run["status"] for run in study.runs} == {"ok"}
    pushed = [run for run in study.runs if run["seed_direction"] in ("lateral", "mirrored")]
    assert len(pushed) == 4 and not any(run["loop_releases"] for run in pushed)
    assert study.select(seed_direction="along")[0]["rope_lateral_max_m"] == 0.0
    for steepness in (out_of_plane.SMALL, out_of_plane.LARGE):
        runs = [study.select(steepness=steepness, seed_direction=word)[0] for word in ("lateral", "mirrored")]
        y, mirrored = (Trajectory.load(trajectory_path(tmp_path, run["run_key"])).columns["y_m"] for run in runs)
        assert np.array_equal(y, -mirrored)


def test_the_size_in_the_plane_is_half_of_the_larger_swing_after_the_transient():
    run = sines(load_scene("tethered_buoy"), 20)
    early = run.columns["time_s"] < 5.0 * run.scene.waves.period_s
    for name, swing_m in (("x_m", 3.0), ("z_m", 4.0)):
        run.columns[name][:] = np.where(early, 50.0, swing_m * np.sin(np.arange(len(early)) * np.pi / 50.0))
    assert offplane_row(run, 6)["inplane_m"] == pytest.approx(4.0, rel=1e-3)


def test_buoy_and_rope_leave_the_plane_farthest_in_runs_of_their_own(tmp_path):
    rows, place = [], {"steepness": 0.13, "status": "ok", "bending_stiffness_Nm2": 0.4, "nodes": 41}
    for depth_m, buoy_m, rope_m in ((21.0, 0.1, 0.2), (22.0, 0.05, 0.4)):
        rows.append({**place, "depth_m": depth_m, "buoy_lateral_max_m": buoy_m, "rope_lateral_max_m": rope_m})
    (line,) = out_of_plane.answer(SimpleNamespace(how=Running(tmp_path)), rows)
    buoy, rope = line.split("the rope by")
    assert "0.1 m (H = 21 m" in buoy and "0.4 m (H = 22 m" in rope
