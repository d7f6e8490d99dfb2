"""A command says which step it is at, how much of it is done, and since when; in a file it does so rarely."""

import io
import sys
import time

import pytest

from campaigns.machinery import progress
from campaigns.machinery.cli import Running
from campaigns.machinery.plan import Job, Plan, name_of
from campaigns.machinery.progress import reporter, reports, stage
from campaigns.machinery.worker import run_jobs
from engine import load_scene
from tests.campaigns.fake_engine import sines


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.fixture
def shown(monkeypatch):
    """What three nested stages write in a second to a stream: its class -> lines."""

    def shown(stream):
        monkeypatch.setattr(sys, "stderr", stream())
        monkeypatch.setattr(progress, "FIRST_S", 0.0)
        monkeypatch.setattr(progress, "LINE_S", 0.4)
        with stage("sweep"), stage("step 3 of 9"), stage("kicks", 120, "runs", lambda: 40, lambda: "350 s simulated"):
            time.sleep(1.4)
        return sys.stderr.getvalue()

    return shown


SAID = "sweep: step 3 of 9: kicks, 40 of 120 runs, 350 s simulated, "


def test_a_file_gets_a_line_now_and_then_and_one_at_the_end(shown):
    *lines, last = shown(io.StringIO).splitlines()
    assert 2 <= len(lines) <= 6
    assert all(line.startswith(SAID) for line in lines)
    assert lines[0].endswith("0:00 since the start") or lines[0].endswith("0:01 since the start")
    assert "ended after 0:01" in last


def test_parts_are_numbered(monkeypatch):
    monkeypatch.setattr(sys, "stderr", io.StringIO())
    monkeypatch.setattr(progress, "FIRST_S", 0.0)
    with stage("sweep"):
        progress.in_parts([lambda: None, lambda: time.sleep(0.6)])
    assert sys.stderr.getvalue().startswith("sweep: part 2 of 2, 0:00 since the start")


def test_a_terminal_gets_one_line_with_a_bar_that_is_taken_away_in_the_end(shown):
    drawn = shown(Terminal)
    assert "\n" not in drawn
    assert f"{SAID}00:01 since the start |" in drawn
    assert drawn.split("\r")[-1].strip() == ""


@pytest.mark.parametrize("seconds", [0.0, 0.3])
def test_what_is_over_at_once_writes_nothing(monkeypatch, seconds):
    monkeypatch.setattr(sys, "stderr", io.StringIO())
    with stage("sweep"), stage("runs", 10, "runs"):
        time.sleep(seconds)
    assert sys.stderr.getvalue() == ""


def test_a_worker_reports_and_one_that_sees_no_folder_does_not(tmp_path, monkeypatch):
    monkeypatch.setattr(progress, "REPORT_S", 0.0)
    report = reporter(tmp_path, "a task")
    for length_s in (20.0, 50.0):
        report(1, length_s)
        assert reports(tmp_path) == {"a task": [1.0, length_s]}
    reporter(tmp_path / "elsewhere", "a task")(2, 70.0)
    reporter(None, "a task")(2, 70.0)
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
