"""The stability campaign: verdicts mean what they say, a whole small campaign works, and is not done twice;
statements of its report follow the tables, and a broken folder is refused."""

import math
import os
import time
import tomllib
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import numba
import numpy as np
import pytest

from campaigns import stability
from campaigns.machinery.cli import Running
from campaigns.machinery.folder import CampaignStopped
from campaigns.machinery.plan import Summary
from campaigns.stability import cases, checks, limits, tasks
from campaigns.stability.cases import ABOVE_BAR, REFUSED, Case, all_cases, case_row
from reports.stability.report import read_cases, unexplained_items
from tables import names
from tests.campaigns.conftest import built_twice, rows_of
from tests.reports.conftest import folder_at

NOT_STARTED = {"statuses": (REFUSED,)}
CALM = {"waves.steepness": 0.016, "water.depth_m": 22.5, "tether.nodes": 5}
DAMPED = CALM | {"tether.tension.stiffness_N": 1e8, "solver.shortest_period_s": 10.0}
STILL = {"waves": None, "tether.nodes": 5}
YIELDS = {**STILL, "tether.tension": {"law": "tanh", "p": [1000.0, 10.0, 0.0, 0.0, 0.0]}}
COLLAPSES = {"start.buoy_velocity_mps": [0.0, 0.0, -1e4], **STILL}
REST = {"length_s": 2.0, "check": "rest", "bar": 1e-9}
FINITE = {"length_s": 2.0, "check": "finite", "bar": 0.0}
INVALID = {"tether.nodes": 1}
WORDS = ["--drift-periods", "0", "--jobs", "1"]


def may(status: str) -> dict:
    return {**FINITE, "statuses": (status,), "why": "because"}


@pytest.fixture
def three_cases(monkeypatch):
    """A campaign of three cases."""
    cases = [
        Case("EI", "rest", STILL, **REST),
        Case("EI", "calm", CALM, 2.0, bar=0.05),
        Case("input", "invalid", INVALID, **FINITE, **NOT_STARTED),
    ]
    monkeypatch.setattr(tasks, "all_cases", lambda: cases)
    return cases


@pytest.mark.parametrize(
    ("case", "verdict", "status"),
    [
        (Case("x", "rest", STILL, **REST), "ok", "ok"),
        (Case("x", "rest", STILL, 2.0, "rest", -1.0), "unexplained", "ok"),
        (Case("x", "above its bar", CALM, 2.0, bar=0.0, statuses=(ABOVE_BAR,), why="because"), "known limit", "ok"),
        (Case("x", "above that of tension", CALM, 5.0, bar_tension=0.0), "unexplained", "ok"),
        (Case("x", "above it, and said", DAMPED, 5.0, bar_tension=0.0), "ok", "ok"),
        (Case("x", "invalid", INVALID, **FINITE, **NOT_STARTED), "refused", "refused"),
        (Case("x", "invalid", INVALID, **FINITE), "unexplained", "refused"),
        (Case("x", "too many samples", {"output.step_s": 1e-9}, **FINITE, **NOT_STARTED), "refused", "refused"),
        (Case("x", "no rest", YIELDS, **may("statics-failed")), "refused", "statics-failed"),
        (Case("x", "no rest", YIELDS, **FINITE), "unexplained", "statics-failed"),
    ],
)
def test_verdicts(case, verdict, status):
    row = case_row(case)
    assert (row["verdict"], row["run_status"]) == (verdict, status), row
    assert row["status"] == ("unexplained" if verdict == "unexplained" else "ok")
    assert row["dimensions"] == 2 and set(row) <= set(names(cases.COLUMNS))
    assert row["message"] or status == "ok"


def test_an_early_end_is_a_known_limit_only_where_the_case_names_it():
    status = case_row(Case("x", "a blow", COLLAPSES, **FINITE))["run_status"]
    assert status in ("newton-failed", "strain-below-minus-one")
    assert case_row(Case("x", "a blow", COLLAPSES, **may(status)))["verdict"] == "known limit"
    assert case_row(Case("x", "a blow", COLLAPSES, **may("step-limit")))["verdict"] == "unexplained"


def test_a_run_that_cannot_be_kept_stops_the_campaign_and_says_nothing_of_its_case(tmp_path):
    with pytest.raises(CampaignStopped, match="cannot write to"):
        case_row(Case("x", "rest", STILL, **REST), tmp_path / "gone" / "trajectories" / "key.nc")


def test_a_process_that_died_is_tried_again_with_the_next_call(three_cases, tmp_path, monkeypatch):
    three_cases[:] = [Case("x", "y", STILL)]
    (tmp_path / "trajectories").mkdir()
    monkeypatch.setattr("campaigns.stability.tasks.load_kernels", lambda: None)
    options = SimpleNamespace(quick=False, drift_periods=0)
    order = SimpleNamespace(how=Running(tmp_path, 1, "threading"), options=options)
    ok = {"verdict": "ok", "run_status": "ok"}
    for way, verdict in ((partial(os._exit, 1), "unexplained"), (ok.copy, "ok"), (partial(os._exit, 1), "ok")):
        monkeypatch.setattr(cases, "_judged", lambda *_, way=way: way())
        summary = tasks.judge_cases(order)
        assert [row["verdict"] for row in summary.rows] == [verdict]


def finished(status="ok", message="", samples=11, spoil=None):
    """A finished run as far as its judge looks at it: one second in samples of 0.1 s."""
    columns = {"time_s": np.arange(samples) * 0.1, "radius_m": np.ones(samples)}
    if spoil is not None:
        columns["radius_m"][3] = spoil
    scene = SimpleNamespace(sample_step_s=lambda: 0.1)
    return SimpleNamespace(columns=columns, profiles=None, status=status, message=message, scene=scene)


@pytest.mark.parametrize(
    ("run", "outcome"),
    [
        (finished(), "ok"),
        (finished(samples=10), "incomplete"),
        (finished(spoil=np.nan), "not-finite"),
        (finished(spoil=-np.inf, status="newton-failed", message="why"), "not-finite"),
        (finished(status="newton-failed", message="why", samples=4), "ended"),
        (finished(status="newton-failed", samples=4), "silent"),
    ],
)
def test_the_judge_tells_a_fault_from_an_answer(run, outcome):
    assert limits.outcome_of(run, 1.0) == outcome


def test_a_run_is_off_by_shares_of_the_swing_of_the_finer_one(monkeypatch):
    """Of sines of ten and of one: rms 9/sqrt(2), over a swing of 2."""
    wave, line = np.sin(np.arange(1000) * 0.02 * np.pi), SimpleNamespace(tether=SimpleNamespace(length_m=20.0))

    def swings(by_m):
        columns = {"radius_m": 20.0 + by_m * wave, "tension_top_high_N": 1e3 + 0.0 * wave}
        return SimpleNamespace(status="ok", columns=columns, scene=line)

    monkeypatch.setattr(checks, "load_scene", lambda *_: None)
    monkeypatch.setattr(checks, "simulate", lambda *_, **length: swings(1.0))
    off = checks.compared(swings(10.0), Case("x", "y", {}), {}, "refinement").measured
    assert off == pytest.approx(9.0 / math.sqrt(8.0))


@numba.njit
def for_ever():
    x = 0.0
    while x < 1.0:
        x *= 0.5
    return x


@pytest.mark.parametrize(
    ("call", "way", "words"),
    [
        pytest.param(for_ever, limits.LATE, "2 s", marks=pytest.mark.slow),
        pytest.param(partial(time.sleep, 60), limits.LATE, "2 s", marks=pytest.mark.slow),
        (partial(os._exit, 3), limits.DIED, "3"),
        (lambda: 1 / 0, limits.RAISED, "ZeroDivisionError"),
        (lambda: "it is " + "done", limits.DONE, "done"),
    ],
)
def test_a_call_that_does_not_return_is_ended_and_one_that_dies_is_seen(call, way, words):
    way_found, answer, _ = limits.limited(call, 2.0)
    assert way_found == way and words in answer


def test_every_case_says_why_it_may_end_otherwise_and_has_a_name_of_its_own():
    cases = all_cases()
    assert len({(case.group, case.name) for case in cases}) == len(cases)
    for case in cases:
        assert hasattr(checks, case.check), case
        assert case.why or [*case.statuses] in ([], [REFUSED]), case
        assert case.bar > 0 or case.check == "finite", case
    assert {case.group for case in cases if case.quick} == {case.group for case in cases}


@pytest.mark.slow
def test_a_campaign_leaves_its_files_and_is_not_done_twice(three_cases, tmp_path, capsys):
    out = tmp_path / "out"
    words = [*WORDS, "--out", str(out)]
    assert stability.main(words) == 0
    rows = rows_of(out)
    assert [row["verdict"] for row in rows] == ["ok", "ok", "refused"]
    assert (out / "report.html").exists() and (out / "report.pdf").exists()
    assert (out / "trajectories" / f"{rows[0]['run_key']}.nc").exists()
    assert "3 computed, 0 found" in capsys.readouterr().out
    earlier = (out / "table.csv").read_bytes()
    assert stability.main(words) == 0
    assert "0 computed, 3 found" in capsys.readouterr().out
    assert (out / "table.csv").read_bytes() == earlier


@pytest.mark.parametrize(("verdict", "code"), [("ok", 0), ("unexplained", 1)])
def test_an_unexplained_case_ends_the_campaign_with_one(tmp_path, monkeypatch, verdict, code):
    row = {"case": "x", "verdict": verdict, "status": verdict, "run_key": "key"}
    monkeypatch.setattr(tasks, "judge_cases", lambda order: Summary([row], 0, 1))
    assert stability.main([*WORDS, "--no-report", "--out", str(tmp_path / "out")]) == code


@pytest.mark.slow
def test_the_quick_campaign(tmp_path):
    """Nothing unexplained among the cases that matter most."""
    assert stability.main(["--quick", "--no-report", "--out", str(tmp_path / "out")]) == 0


CASES = tomllib.loads(Path(__file__).with_name("judged_cases.toml").read_text(encoding="utf-8"))["cases"]


def folder(place, judged=CASES):
    rows = [{"part": "case", "about": row["group"], "dimensions": 2, **row} for row in judged]
    return folder_at(place, "stability", rows, cases.COLUMNS, quick=False, command=["python"])


def test_verdicts_and_faults_follow_the_tables(tmp_path):
    older = {"part": "fuzz", "group": "random", "verdict": "ok", "about": "", "dimensions": ""}
    judged = read_cases(folder(tmp_path / "out", [*CASES, older]))  # what earlier versions left is no case
    verdicts = ("ok", "refused", "known limit", "unexplained")
    assert [sum(row["verdict"] == word for row in judged.table) for word in verdicts] == [3, 1, 1, 0]
    assert unexplained_items(judged)[0].kind == "note"


def test_what_is_unexplained_leads(tmp_path):
    lost = {"group": "EA", "case": "stiff", "verdict": "unexplained", "run_status": "hang", "message": "no answer"}
    (notice,) = unexplained_items(read_cases(folder(tmp_path / "out", [*CASES, lost])))
    assert notice.kind == "warning" and len(notice.lines) == 1 and "stiff" in notice.lines[0]


def test_same_folder_same_bytes(tmp_path):
    page, _ = built_twice(folder(tmp_path / "out"))
    assert page.count(b"<figure") == page.count(b"<figcaption") == 2  # every case, and the times of steps
