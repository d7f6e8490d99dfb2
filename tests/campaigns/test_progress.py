"""The time left is right for runs that cost alike or not, whoever does them; and every campaign ends with an answer."""

import importlib
import io
import sys
import time

import numpy as np
import pytest

from campaigns.__main__ import _names
from campaigns.explore.answer import sentences
from campaigns.explore.rows import COLUMNS
from campaigns.machinery import progress
from campaigns.machinery.cli import Running
from campaigns.machinery.plan import Job, Plan, name_of
from campaigns.machinery.progress import ASKED_S, Stage, heard, shares, stage, teller
from campaigns.machinery.runner import run_jobs
from campaigns.machinery.session import MOST_LINES
from engine import load_scene, simulate, simulate_each
from engine.natural_frequencies import natural_frequencies
from tests.campaigns.fake_engine import FakeEngine, sines


def test_a_time_left_is_told_once_it_is_known():
    one = Stage("runs", 10.0)
    one.seen.extend([(0.0, 0.0), (ASKED_S, 0.0)])
    assert one.left_s() is None  # nothing is done yet
    one.seen.append((2.0 * ASKED_S, 5.0))
    assert one.left_s() == pytest.approx(ASKED_S)


def test_the_time_left_is_to_the_end_of_the_command_where_it_is_known_what_follows():
    now = time.monotonic()
    runs = Stage("runs", 40.0, "s", lambda: time.monotonic() - now + 10.0, lambda whole: 0.5 * whole, now - 10.0)
    root = Stage("command", then=lambda _: 60.0, began=now - 100.0)
    runs.seen.append((5.0, 5.0))
    assert "about 0:50 left," in runs.told([])  # 30 s and half of 40
    assert "about 1:50 left," in runs.told([root])  # and a report
    assert "about 0:30 left of this," in runs.told([root, Stage("several commands")])


def test_a_worker_says_how_far_it_is_and_one_that_sees_no_folder_says_nothing(tmp_path, monkeypatch):
    monkeypatch.setattr(progress, "TOLD_S", 0.0)
    told = teller(tmp_path, "a task")
    for share in (0.25, 0.5):
        told(share)
        assert shares(tmp_path) == {"a task": share}
    teller(tmp_path / "elsewhere", "a task")(0.7)
    teller(None, "a task")(0.7)
    assert shares(tmp_path) == {"a task": 0.5}
    assert heard(simulate, told) == heard(simulate_each, told) == {"progress": told}
    assert heard(FakeEngine(), told) == {}


def half_way(folder, run):
    """Stands in for engine.simulate: asks its progress for half, and looks at what the campaign then sees."""

    def simulated(scene, periods=None, duration_s=None, progress=None):
        progress(0.5)
        run.update(shares(folder))
        return sines(scene, periods)

    return simulated


def test_the_main_process_sees_the_share_of_a_run_while_it_goes(tmp_path):
    (tmp_path / "told").mkdir()
    (tmp_path / "trajectories").mkdir()
    job, seen = Job({}, load_scene("tethered_buoy"), 4), {}
    engine = half_way(tmp_path / "told", seen)
    run_jobs(Plan(Running(tmp_path), engine, lambda run: {}, COLUMNS, reports=tmp_path / "told"), [job])
    assert seen == {name_of([job]): 0.5}


def test_no_silence_and_the_names_of_all_stages(monkeypatch):
    monkeypatch.setattr(sys, "stderr", io.StringIO())
    monkeypatch.setattr(progress, "FIRST_S", 0.0)
    monkeypatch.setattr(progress, "SAID_S", 0.3)
    began = time.monotonic()
    with stage("campaign"), stage("runs", 100.0, "wave periods", lambda: 25.0), stage("one of them"):
        time.sleep(1.0)
    lines = sys.stderr.getvalue().splitlines()
    assert len(lines) >= int((time.monotonic() - began) / (0.3 + 2 * progress.DRAWN_S))
    assert lines[0].startswith("campaign: ")  # before the stages within it began
    head, tail = "campaign: runs: one of them: [#####-----", "25%, 0:0"
    assert all(line.startswith(head) and tail in line and "100 wave periods" in line for line in lines[1:])


@pytest.mark.parametrize("name", [name for name in _names() if name != "time_series"])
def test_every_campaign_has_an_answer(name):
    assert importlib.import_module(f"campaigns.{name}").STUDY.answer is not None


def row(steepness, regime="period-1", peak=3000.0, **known):
    usual = {"radius_min_m": 20.0, "radius_max_m": 21.0, "slack_fraction": 0.0, "max_buoy_height_above_water_m": 0.5}
    return (
        {"steepness": steepness, "dimensions": 2, "status": "ok", "regime": regime, "tension_top_max_N": peak}
        | usual
        | known
    )


def test_the_answer_of_a_sweep_names_regimes_jumps_chaos_and_the_load_that_may_be_used():
    chaos = {"lyapunov_tangent_bits_per_period": 0.09, "lyapunov_tangent_error": 0.01, "loop_releases": 3}
    after = {"radius_min_m": 17.0, "slack_fraction": 0.6}
    rows = [
        *(row(0.01 * number, peak=3000.0 + number) for number in range(1, 6)),
        row(0.06, "period-2", 9000.0, **after),
        row(0.07, "chaotic", 9100.0, **after, **chaos),
        row(0.08, "undecided", 9050.0, **after),
        {"steepness": 0.09, "status": "newton-failed", "regime": None, "tension_top_max_N": None},
    ]
    scene = load_scene("tethered_buoy")
    times = 9100.0 / natural_frequencies(scene).static_tension_N
    regular = [
        "Regular up to kA = 0.06: period 1 and 2.",
        "Between kA = 0.05 and 0.06 the motion jumps to one 4 times as large: peak tension 3 -> 9 kN, "
        "swing of r 1.00 -> 4.00 m, time with less than 5 % of the static tension 0 -> 60 %.",
        "Chaotic at kA = 0.07: neighbours part by 0.09 bits a wave (standard error 0.01).",
        "Not decided: tests disagree at kA = 0.08.",
    ]
    largest = f"Largest tension 9.1 kN at kA = 0.07 ({times:.1f} times static)"

    def answer(rows, companions=()):
        return [line.partition(" Checked")[0] for line in sentences(rows, "steepness", "kA", scene, companions)]

    assert answer(rows[::-1]) == [
        *regular,
        f"{largest}.",
        "It is no load to design for, because loops were released (motion.dimensions).",
        "Largest tension without that: 9.05 kN at kA = 0.08.",
    ]
    for one in rows[5:8]:
        one["max_buoy_height_above_water_m"] = 1.1 * scene.buoy.diameter_m
    length = {"periods": 90, "transient_periods": 45, "max_buoy_height_above_water_m": 9.0}
    capped = {0.07: 4000.0, 0.08: 5000.0}
    companions = [row(kA, "", peak, role="wetted cap", **length) for kA, peak in capped.items()]
    assert answer(rows, companions) == [
        *regular,
        f"{largest}; with the wetted cap 4 kN.",
        "It is no load to design for, because the sphere flies above still water with all its buoyancy "
        "(buoy.submergence) and loops were released (motion.dimensions).",
        "With the wetted cap the largest tension is 5 kN at kA = 0.08.",
    ]


@pytest.mark.parametrize("count", [0, 1, 2, 40])
def test_an_answer_is_short_whatever_was_run(count):
    words = ["period-1", "period-12", "quasi-periodic", "chaotic", "transient", "undecided", ""]
    rng = np.random.default_rng(count)
    rows = [
        row(0.01 * n, rng.choice(words), float(10 ** rng.uniform(3.0, 5.0)), loop_releases=n % 2) for n in range(count)
    ]
    said = sentences(rows, "steepness", "kA", load_scene("tethered_buoy"))
    assert 1 <= len(said) <= MOST_LINES and all(len(line) < 400 and "nan" not in line for line in said)
