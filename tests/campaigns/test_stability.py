"""The stability campaign: verdicts mean what they say, a whole small campaign works, and is not done twice."""

import json
from functools import partial

import pytest

from campaigns import stability
from campaigns.columns import names
from campaigns.machinery.folder import CampaignStopped, kept_row
from campaigns.stability import cases, checks, tasks
from campaigns.stability.cases import ABOVE_BAR, REFUSED, Case, all_cases, case_row
from tests.campaigns.conftest import rows_of

NOT_STARTED = {"statuses": (REFUSED,)}
CALM = {"waves.steepness": 0.016, "water.depth_m": 22.5, "tether.nodes": 5}
STILL = {"waves": None, "tether.nodes": 5}
YIELDS = {**STILL, "tether.tension": {"law": "tanh", "p": [1000.0, 10.0, 0.0, 0.0, 0.0]}}
COLLAPSES = {"start.buoy_velocity_mps": [0.0, 0.0, -1e4], **STILL}
REST = {"length_s": 2.0, "check": "rest", "bar": 1e-9}
FINITE = {"length_s": 2.0, "check": "finite", "bar": 0.0}
INVALID = {"tether.nodes": 1}
WORDS = ["--drift-periods", "0", "--jobs", "1"]


def may(status: str) -> dict:
    return {**FINITE, "statuses": (status,), "why": "because"}


@pytest.mark.parametrize(
    ("case", "verdict", "status"),
    [
        (Case("x", "rest", STILL, **REST), "ok", "ok"),
        (Case("x", "rest", STILL, 2.0, "rest", -1.0), "unexplained", "ok"),
        (Case("x", "above its bar", CALM, 2.0, bar=0.0, statuses=(ABOVE_BAR,), why="because"), "known limit", "ok"),
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
    assert set(row) <= set(names(cases.COLUMNS))
    assert row["message"] or status == "ok"


def test_an_early_end_is_a_known_limit_only_where_the_case_names_it():
    status = case_row(Case("x", "a blow", COLLAPSES, **FINITE))["run_status"]
    assert status in ("newton-failed", "strain-below-minus-one")
    assert case_row(Case("x", "a blow", COLLAPSES, **may(status)))["verdict"] == "known limit"
    assert case_row(Case("x", "a blow", COLLAPSES, **may("step-limit")))["verdict"] == "unexplained"


def test_a_run_that_cannot_be_kept_stops_the_campaign_and_says_nothing_of_its_case(tmp_path):
    with pytest.raises(CampaignStopped, match="cannot write to"):
        case_row(Case("x", "rest", STILL, **REST), tmp_path / "gone" / "trajectories" / "key.nc")


def test_a_process_that_died_is_tried_again_with_the_next_call(tmp_path, monkeypatch):
    import os

    (tmp_path / "trajectories").mkdir()
    monkeypatch.setattr("campaigns.stability.fuzz.load_kernels", lambda: None)
    task = tasks.Task("case", Case("x", "y", STILL))
    ok = {"verdict": "ok", "run_status": "ok"}
    for way, verdict, kept in ((partial(os._exit, 1), "unexplained", False), (ok.copy, "ok", True)):
        monkeypatch.setattr(cases, "_judged", lambda *_, way=way: way())
        assert tasks.result(tmp_path, "maker", task)["verdict"] == verdict
        assert (kept_row(tmp_path, task.key(), "maker") is not None) == kept


def test_every_case_says_why_it_may_end_otherwise_and_has_a_name_of_its_own():
    cases = all_cases()
    assert len({(case.group, case.name) for case in cases}) == len(cases)
    for case in cases:
        assert hasattr(checks, case.check), case
        assert case.why or [*case.statuses] in ([], [REFUSED]), case
        assert case.bar > 0 or case.check == "finite", case
    assert {case.group for case in cases if case.quick} == {case.group for case in cases}


@pytest.fixture
def few(monkeypatch):
    """A campaign of three cases, one line and one scene that is timed."""
    cases = [
        Case("EI", "rest", STILL, **REST),
        Case("EI", "calm", CALM, 2.0, bar=0.05),
        Case("input", "invalid", INVALID, **FINITE, **NOT_STARTED),
    ]
    monkeypatch.setattr(tasks, "all_cases", lambda: cases)
    monkeypatch.setattr("campaigns.stability.step_maps.LINES", {"taut": ("taut", 0.02, 0.05, 2)})
    monkeypatch.setattr("campaigns.stability.step_maps.METHODS", ("backward-euler",))
    monkeypatch.setattr("campaigns.stability.scene_shares.SCENES", {"Table 1": {"tether.nodes": 5}})
    return cases


@pytest.mark.slow
def test_a_campaign_leaves_its_files_and_is_not_done_twice(few, tmp_path, capsys):
    out = tmp_path / "out"
    words = ["--fuzz", "6", *WORDS, "--out", str(out)]
    assert stability.main(words) == 0
    rows = rows_of(out)
    assert [row["verdict"] for row in rows] == ["ok", "ok", "refused", "ok", "ok"]
    assert len(rows_of(out, "fuzz.csv")) == 12
    assert json.loads((out / "step_maps.json").read_text())["taut"]["methods"]["backward-euler"]["largest"] < 1.001
    assert (out / "report.html").exists() and (out / "report.pdf").exists()
    assert (out / "trajectories" / f"{rows[0]['run_key']}.nc").exists()
    assert "6 computed, 0 found" in capsys.readouterr().out
    before = (out / "table.csv").read_bytes()
    assert stability.main(words) == 0
    assert "0 computed, 6 found" in capsys.readouterr().out
    assert (out / "table.csv").read_bytes() == before


@pytest.mark.slow
def test_an_unexplained_case_ends_the_campaign_with_one(few, tmp_path):
    few[:] = [Case("EI", "no rest", YIELDS, **FINITE)]
    assert stability.main(["--fuzz", "0", *WORDS, "--out", str(tmp_path / "out")]) == 1
    assert (tmp_path / "out" / "report.html").exists()


@pytest.mark.slow
def test_the_quick_campaign(tmp_path):
    """Nothing unexplained among the cases that matter most and forty random scenes of each kind."""
    assert stability.main(["--quick", "--no-report", "--out", str(tmp_path / "out")]) == 0
