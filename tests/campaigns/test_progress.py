"""A command shows its stage, how much of it is done and the time since the start; in a file it does so rarely."""

import io
import shutil
import sys
import time
from contextlib import nullcontext
from types import SimpleNamespace

import pytest

import engine
from campaigns.machinery import progress, runner
from campaigns.machinery.cli import Running
from campaigns.machinery.long_runs import Part
from campaigns.machinery.plan import Job, Outcome, Plan, Summary, name_of
from campaigns.machinery.progress import reporter, reports, stage
from campaigns.machinery.worker import run_jobs
from engine import load_scene
from tests.campaigns.fake_engine import sines

KICKS = "sweep: step 3 of 9: kicks, 40 of 120 runs, 350 s simulated"


class Terminal(io.StringIO):
    def isatty(self):
        return True


class Passed(Exception):
    """The seconds that a test draws are over."""


@pytest.fixture
def draw(monkeypatch):
    """draw(seconds): draws the open stages for that long, on a clock that only drawing moves on."""
    clock = SimpleNamespace(now_s=time.monotonic(), end_s=0.0)

    def sleep(seconds):
        clock.now_s += seconds
        if clock.now_s > clock.end_s:
            raise Passed

    def for_seconds(seconds):
        clock.end_s = clock.now_s + seconds
        with pytest.raises(Passed):
            progress._keep_drawing()

    fake = SimpleNamespace(monotonic=lambda: clock.now_s, time=time.time, sleep=sleep)
    with progress._lock, monkeypatch.context() as patch:  # the lock stops the thread of an earlier test
        patch.setattr(progress, "_start_drawing", lambda: None)
        patch.setattr(progress, "time", fake)
        yield for_seconds


def lines_of_kicks(draw, seconds, monkeypatch, stream=io.StringIO):
    """What three nested stages of that length write to a stream."""
    monkeypatch.setattr(sys, "stderr", stream())
    with stage("sweep"), stage("step 3 of 9"), stage("kicks", 120, "runs", lambda: 40, lambda: "350 s simulated"):
        draw(seconds)
    return sys.stderr.getvalue()


def test_a_file_gets_a_line_after_5_s_then_every_10_s_and_one_at_the_end(draw, monkeypatch):
    times = "0:05 since the start", "0:15 since the start", "0:25 since the start", "ended after 0:30"
    assert lines_of_kicks(draw, 30.0, monkeypatch).splitlines() == [f"{KICKS}, {words}" for words in times]


def test_a_stage_that_is_over_before_5_s_writes_nothing(draw, monkeypatch):
    assert lines_of_kicks(draw, 4.9, monkeypatch) == ""


def test_parts_are_numbered(draw, capsys):
    with stage("sweep"):
        progress.in_parts([lambda: None, lambda: draw(6.0)])
    assert capsys.readouterr().err == "sweep: part 2 of 2, 0:05 since the start\n"


def test_a_terminal_gets_one_line_with_a_bar_that_is_taken_away_in_the_end(draw, monkeypatch):
    drawn = lines_of_kicks(draw, 30.5, monkeypatch, Terminal)
    assert "\n" not in drawn and f"{KICKS}, 00:30 since the start |" in drawn
    assert drawn.split("\r")[-1].strip() == ""


def test_a_worker_reports_and_one_that_sees_no_folder_does_not(tmp_path, monkeypatch):
    monkeypatch.setattr(progress, "REPORT_S", 0.0)
    report = reporter(tmp_path, "a task")
    for length_s in (20.0, 50.0):
        report(1, length_s)
        assert reports(tmp_path) == {"a task": [1.0, length_s]}
    for folder in (tmp_path / "elsewhere", None):
        reporter(folder, "a task")(2, 70.0)
    assert reports(tmp_path) == {"a task": [1.0, 50.0]}


def test_the_seconds_that_a_run_has_simulated_are_seen_while_it_goes(tmp_path):
    (tmp_path / "trajectories").mkdir()
    job, seen = Job({}, load_scene("tethered_buoy"), 4), {}

    def half_way(scene, periods=None, duration_s=None, progress=None):
        progress(0.5)
        seen.update(reports(tmp_path))
        return sines(scene, periods)

    run_jobs(Plan(Running(tmp_path), half_way, lambda run: {}, (), reports=tmp_path), [job])
    assert seen == {name_of([job]): [0.0, 10.0]}  # of four waves of 5 s


def parts_of_two_periods(scene, trajectory, row, checks):
    """What a run does that lasts three parts."""
    if row is None or row["periods"] < 6:
        return Part(scene, 2, trajectory)
    return None


@pytest.mark.parametrize("going", [None, parts_of_two_periods])
def test_a_run_has_simulated_all_its_seconds_in_the_end_and_never_fewer_than_before(tmp_path, going, monkeypatch):
    (tmp_path / "trajectories").mkdir()
    job, seen_s = Job({}, load_scene("tethered_buoy"), 6, going=going), [0.0]

    def at_once(scene, periods=None, duration_s=None, progress=None, start=None):
        for share in (0.0, 1.0):
            progress(share)
            for _, length_s in reports(tmp_path).values():
                seen_s.append(length_s)
        run = sines(scene, periods)
        if start is not None:
            run.columns["time_s"] += start.columns["time_s"][-1]
        return run

    def row(run):
        return {"status": "ok", "periods": run.columns["time_s"][-1] / 5.0}

    for report_s in (0.0, 100.0):  # between two reports
        monkeypatch.setattr(progress, "REPORT_S", report_s)
        shutil.rmtree(tmp_path / "trajectories")
        (tmp_path / "trajectories").mkdir()
        run_jobs(Plan(Running(tmp_path), at_once, row, (), reports=tmp_path), [job])
        assert reports(tmp_path) == {name_of([job]): [1.0, 30.0]}
        assert seen_s == sorted(seen_s)
        seen_s.clear()


def test_the_count_of_runs_never_falls_while_the_results_of_a_group_come_in(tmp_path, monkeypatch):
    """A group has reported its five runs, and a sixth, which runs alone, that it has ended."""
    jobs = [Job({}, load_scene("tethered_buoy", {"waves.steepness": 0.01 * number}), 4) for number in range(1, 8)]
    group, counts = tuple(jobs[:5]), []

    def results_of(how, groups, call, *further):
        def count():
            (counting,) = [opened.count() for opened in progress._open if opened.total]
            counts.append(counting)

        reporter(call.args[0].reports, name_of(group))(5, 100.0)
        reporter(call.args[0].reports, name_of([jobs[5]]))(1, 20.0)
        count()
        for job in group:
            yield job.key, Outcome(job.key, {})
            count()

    monkeypatch.setattr(runner, "as_completed", results_of)
    monkeypatch.setattr(runner, "groups_of", lambda plan, jobs: [group])
    list(runner._computed(Plan(Running(tmp_path), None, None, ()), jobs, 0))
    assert counts == [6] * 6


@pytest.mark.parametrize(("tangent_vectors", "carrying"), [(0, False), (1, False), (0, True)])
def test_what_runs_side_by_side_need_is_compiled_before_they_begin(tangent_vectors, carrying, tmp_path, monkeypatch):
    """Beside the lanes: what their companions need, which go alone, and those that leave the lanes in the end."""
    compiled = []

    def at_once(call, tasks):
        return [(task, call(task)) for task in tasks]

    monkeypatch.setattr(engine, "compile_piece", lambda key, scene: compiled.append(key[1]))
    monkeypatch.setattr(runner, "_ready", set())
    monkeypatch.setattr(runner, "run_campaign", lambda plan, jobs: Summary([], 0, 0))
    monkeypatch.setattr(runner, "opened", lambda *pool: nullcontext(at_once))
    jobs = []
    for number in range(1, 9):
        changes = {"waves.steepness": 0.01 * number, "output.tangent_vectors": tangent_vectors}
        jobs.append(Job({}, load_scene("tethered_buoy", changes), 4, carrying=carrying))
    runner.run(Plan(Running(tmp_path), engine.simulate, None, (), simulate_each=engine.simulate_each), jobs)
    assert {"rest", "advance", "march"} <= {*compiled}
    assert ({"follow", "carry"} <= {*compiled}) == bool(tangent_vectors or carrying)
