"""What the buoy sweep runs beside its values: runs in space where the plane is not enough, flying spheres again with a
wetted cap, the most violent run again with its line; and nothing twice.
"""

import io
import json
from dataclasses import dataclass, replace
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from PIL import Image

from campaigns.explore import batches
from campaigns.explore.batches import FRAMES, PERIODS, of_largest_tension
from campaigns.explore.space import SEED_MPS
from campaigns.judge import record_regime, tangent_of
from campaigns.machinery.cli import Running
from campaigns.machinery.plan import Job, Plan, Summary
from campaigns.machinery.runner import groups_of
from engine import Trajectory, load_scene
from engine.trajectory import TangentGrowth
from reports.parts.style import VERMILION
from tests.campaigns.conftest import finished, forget, judged_row, rows_of
from tests.campaigns.fake_engine import FakeEngine, shapes, sines

THREE = ("0.02", "0.05", "0.13")
SHOWN = ["--periods", "15", "--transient", "3", "--no-report", "--no-accuracy"]


@dataclass(frozen=True)
class Slackening(FakeEngine):
    """Tension with an amplitude of 20 kN times the steepness about a mean: slack where that is beyond the mean."""

    mean_N: float = 500.0
    fails_with_line: bool = False

    def __call__(self, scene, periods=None, duration_s=None):
        super().__call__(scene, periods, duration_s)
        length = periods if periods is not None else duration_s / scene.waves.period_s
        run = sines(scene, length, tension=(self.mean_N, 2e4 * scene.waves.steepness))
        if not scene.output.profiles or periods is None:
            return run
        if self.fails_with_line:
            raise ZeroDivisionError("a fault of the code")
        return replace(run, profiles=shapes(run))


def test_runs_that_failed_are_not_repeated():
    good = {"status": "ok", "run_key": "a", "tension_top_max_N": 10.0}
    wild = {"status": "newton-failed", "run_key": "b", "tension_top_max_N": 99.0}
    assert of_largest_tension([wild]) is None and of_largest_tension([good, wild]) is good


@pytest.fixture
def nine(monkeypatch, tmp_path):
    """plan, summary and cases of a planar sweep of nine values, whose sphere flies at the last four; its jobs."""
    jobs = []
    scene = load_scene("tethered_buoy", {"output.tangent_vectors": 1})
    monkeypatch.setattr(batches, "batch", lambda plan, folder, title, columns, row, of_batch: jobs.extend(of_batch))
    monkeypatch.setattr(batches, "run_of", lambda folder, row: sines(scene, 2))
    rows = [
        {"steepness": 0.02 * n, "status": "ok", "run_key": str(n), "tension_top_max_N": 1000.0 * n}
        | {"max_buoy_height_above_water_m": (1.1 if n > 5 else 0.9) * scene.buoy.diameter_m}
        for n in range(1, 10)
    ]
    cases = [Job({"steepness": row["steepness"]}, scene, 135) for row in rows]
    return Plan(Running(tmp_path, 2), None, None, (), simulate_each=list), Summary(rows, 9, 0), cases, jobs


def test_between_judged_values_there_are_about_as_many_in_each_gap_and_two_hundred_in_all(nine):
    plan, summary, cases, jobs = nine
    batches.between(plan, summary, "waves.steepness", cases)
    values, steepnesses = ([job.labels["steepness"] for job in some] for some in (cases, jobs))
    assert [job.scene.waves.steepness for job in jobs] == steepnesses and len(steepnesses) + len(values) == 200
    in_gaps = np.histogram(steepnesses, values)[0]
    assert np.ptp(in_gaps) <= 1 and in_gaps.sum() == len(steepnesses)
    for low, high in pairwise(values):
        between = [value for value in steepnesses if low < value < high]
        assert between == pytest.approx(np.linspace(low, high, len(between) + 2)[1:-1])
    assert all(job.scene.output.tangent_vectors == 0 for job in jobs)


def test_every_flying_sphere_has_a_wetted_cap(nine):
    plan, summary, cases, jobs = nine
    batches.companions(plan, summary, "waves.steepness", 1500)
    values = [job.labels["steepness"] for job in cases]
    assert [job.labels["steepness"] for job in jobs] == values[5:]
    assert {job.scene.buoy.submergence for job in jobs} == {"spherical-cap"} and {job.periods for job in jobs} == {60}


def test_a_motion_that_rest_does_not_lead_to_is_repeated_from_its_last_state(nine, monkeypatch):
    plan = nine[0]
    state = SimpleNamespace(at_zero=lambda: "its last state")
    monkeypatch.setattr(batches, "run_of", lambda folder, row: SimpleNamespace(final_state=state))
    starts = [batches.start_of(plan, {"found_by": found_by}) for found_by in ("rest", "kick", None)]
    assert starts == [None, "its last state", None]


def test_runs_between_that_were_begun_ahead_are_not_left_to_later_steps(nine):
    plan, summary, cases, _ = nine
    plan.spare.append("runs between")
    batches.between(plan, summary, "waves.steepness", cases)
    assert plan.spare == []


@pytest.fixture
def close_up(sweep):
    """close_up(**fields of Slackening) -> exit code, table of the folder close_up, steepness of the runs begun."""

    def run(**fake):
        code, _, begun = sweep("--steepness", *THREE, jobs=1, usual=SHOWN, kind=Slackening, **fake)
        return code, rows_of(sweep.out / "close_up") if (sweep.out / "close_up").exists() else None, begun

    run.out = sweep.out
    return run


def test_the_run_that_peaks_highest_is_kept_with_its_line_and_never_twice(close_up):
    code, (row,), begun = close_up()
    assert (code, begun) == (0, [0.02, 0.05, 0.13, 0.13])
    assert (row["steepness"], row["status"], row["periods"]) == ("0.13", "ok", str(PERIODS))
    path = close_up.out / "close_up" / "trajectories" / f"{row['run_key']}.nc"
    trajectory = Trajectory.load(path)
    assert trajectory.profiles.time_s == pytest.approx(
        np.arange(PERIODS * FRAMES + 1) * trajectory.scene.waves.period_s / FRAMES
    )
    assert close_up() == (0, [row], [])
    path.unlink()
    assert close_up()[2] == [0.13], "a sweep killed before its last run does that run alone"


def test_a_sweep_without_slack_has_none_and_empties_that_of_an_earlier_one(close_up):
    assert close_up(mean_N=5000.0)[1:] == (None, [0.02, 0.05, 0.13])
    forget(close_up.out)
    close_up()
    forget(close_up.out)
    assert close_up(mean_N=5000.0)[1] == []


def test_a_close_up_that_fails_is_a_row_and_costs_nothing_else(close_up):
    code, (row,), _ = close_up(fails_with_line=True)
    assert (code, row["status"]) == (0, "error")


@pytest.mark.slow
def test_the_report_shows_it_moving_and_as_stills_the_same_each_time(close_up):
    from reports.buoy_sweep.figures import close_up_items
    from reports.buoy_sweep.runs import read_sweep

    close_up()
    heading, figure = close_up_items(read_sweep(close_up.out))
    assert figure.picture.kind == "svg" and figure.moving.data.startswith(b"GIF89a")
    assert "kA = 0.13" in figure.caption and len(figure.moving.data) < 1e6
    assert close_up_items(read_sweep(close_up.out)) == [heading, figure]
    with Image.open(io.BytesIO(figure.moving.data)) as moving:
        colours = np.array([colour for _, colour in moving.convert("RGB").getcolors(1 << 20)])
    for wanted in ("#ffffff", VERMILION):  # paper, and the small dot that marks the moment
        off = np.abs(colours - 255 * np.array(to_rgb(wanted))).sum(axis=1)
        assert off.min() < 60, "20 of 256 in each of red, green and blue; brown instead of vermilion is 177 off"


def test_auto_runs_in_space_what_released_loops_in_the_plane_says_so_and_decides_again_from_the_files(sweep):
    _, planar, begun = sweep("--steepness", *THREE, loops=(0.05, 0.13))
    assert begun == [0.02, 0.05, 0.13] and [row["dimensions"] for row in planar] == ["2", "2", "2"]
    assert [row["loop_releases"] for row in planar] == ["0", "3", "3"]
    assert all(row["buoy_lateral_max_m"] == row["planar_loop_releases"] == "" for row in planar)
    code, rows, begun = sweep("--steepness", *THREE, "--dimensions", "auto", loops=(0.05, 0.13))
    assert code == 0 and begun == [0.05, 0.13], "the planar runs are there"
    assert [row["dimensions"] for row in rows] == ["2", "3", "3"]
    assert [row["planar_loop_releases"] for row in rows] == ["", "3", "3"]
    assert [row["loop_releases"] for row in rows] == ["0", "0", "0"]
    assert rows[1]["planar_radius_max_m"] == rows[1]["radius_max_m"] != ""
    assert rows[1]["buoy_lateral_max_m"] == "0.0" and rows[0]["buoy_lateral_max_m"] == ""
    files = finished(sweep.out)
    assert len(files) == 5
    assert sweep("--steepness", *THREE, "--dimensions", "auto", loops=(0.05, 0.13)) == (0, rows, [])
    assert finished(sweep.out) == files


def test_without_loops_auto_is_the_planar_sweep(sweep):
    _, planar, _ = sweep("--steepness", *THREE)
    assert sweep("--steepness", *THREE, "--dimensions", "auto") == (0, planar, [])


@pytest.mark.parametrize(
    ("words", "push", "added"),
    [([], SEED_MPS, SEED_MPS), (["--set", "start.buoy_velocity_mps=[0,1e-7,0]"], 1e-7, None)],
)
def test_three_pushes_a_scene_that_starts_in_its_plane_and_says_so(sweep, words, push, added):
    _, rows, begun = sweep("--steepness", *THREE, "--dimensions", "3", *words, loops=(0.13,))
    assert begun == [0.02, 0.05, 0.13] and {row["dimensions"] for row in rows} == {"3"}
    provenance = json.loads((sweep.out / "provenance.json").read_text())
    assert (provenance["dimensions"], provenance["push_mps"]) == ("3", added)
    as_run = load_scene(sweep.out / "scene.toml")
    assert as_run.motion.dimensions == 3 and as_run.start.buoy_velocity_mps == (0.0, push, 0.0)


def test_a_failed_run_in_space_is_a_row_of_three_dimensions(sweep):
    _, rows, _ = sweep("--steepness", "0.05", "--dimensions", "3", raises=(0.05,))
    assert (rows[0]["status"], rows[0]["dimensions"]) == ("error", "3")


def test_a_row_in_space_is_judged_by_its_samples():
    scene = load_scene("tethered_buoy", {"motion.dimensions": 3, "start.buoy_velocity_mps": [0, 1e-5, 0]})
    row = judged_row(sines(scene, 120), 20)
    assert row["regime"] == "period-1"
    assert row["lyapunov_tangent_bits_per_period"] is None and row["regime_tighter"] is None
    assert "regime" not in judged_row(sines(scene, 59), 20), "too short for a verdict"


def test_what_a_record_was_before_its_transient_ended_changes_no_exponent():
    run = sines(load_scene("tethered_buoy"), 200)
    before = run.columns["time_s"] < 50.0 * run.scene.waves.period_s
    noisy = run.columns["radius_m"] + before * np.random.default_rng(2).normal(size=len(before))
    other = replace(run, columns=run.columns | {"radius_m": noisy})
    wolf, of_other = (record_regime(record, 50)[1] for record in (run, other))
    assert (of_other.value, of_other.error) == (wolf.value, wolf.error)
    growth_nats = np.full((200, 1), np.log(2.0))
    growth_nats[:50] = 3.0
    grown = replace(run, tangent=TangentGrowth(5.0, growth_nats, np.zeros(200)))
    assert tangent_of(grown, 50).value == pytest.approx(1.0)


def test_a_run_from_a_state_shares_no_worker_with_runs_from_rest(nine):
    plan, _, cases, _ = nine
    mixed = [replace(job, going=None if i % 2 else print) for i, job in enumerate(cases * 2)]
    groups = groups_of(plan, mixed)
    assert sum(map(len, groups)) == len(mixed)
    assert all(len({job.going for job in group}) == 1 for group in groups)
