"""The stability campaign: verdicts mean what they say, a whole small campaign works, and is not done twice."""

import csv
import json
import subprocess
import sys
from pathlib import Path

import pytest

from campaigns import stability
from campaigns.columns import names
from campaigns.machinery.folder import CampaignStopped
from campaigns.machinery.row_cache import kept_row
from campaigns.stability import run, tasks
from campaigns.stability.cases import ABOVE_BAR, REFUSED, Case, all_cases
from campaigns.stability.run import case_row

ROOT = Path(__file__).resolve().parents[2]
CALM = {"waves.steepness": 0.016, "water.depth_m": 22.5, "tether.nodes": 5}
STILL = {"waves": None, "tether.nodes": 5}
YIELDS = {**STILL, "tether.tension": {"law": "tanh", "p": [1000.0, 10.0, 0.0, 0.0, 0.0]}}
COLLAPSES = {"start.buoy_velocity_mps": [0.0, 0.0, -1e4], **STILL}
WHY = "because"


@pytest.mark.parametrize(
    ("case", "verdict", "status"),
    [
        (Case("x", "rest", STILL, 2.0, "rest", 1e-9), "ok", "ok"),
        (Case("x", "rest", STILL, 2.0, "rest", -1.0), "unexplained", "ok"),
        (Case("x", "above its bar", CALM, 2.0, "refined", 0.0, (ABOVE_BAR,), WHY), "known limit", "ok"),
        (Case("x", "invalid", {"tether.nodes": 1}, 2.0, ends=(REFUSED,)), "refused", "refused"),
        (Case("x", "invalid", {"tether.nodes": 1}, 2.0), "unexplained", "refused"),
        (Case("x", "too many samples", {"output.step_s": 1e-9}, 2.0, ends=(REFUSED,)), "refused", "refused"),
        (Case("x", "no rest", YIELDS, 2.0, ends=("statics-failed",), limit=WHY), "refused", "statics-failed"),
        (Case("x", "no rest", YIELDS, 2.0), "unexplained", "statics-failed"),
    ],
)
def test_verdicts(case, verdict, status):
    row = case_row(case)
    assert (row["verdict"], row["run_status"]) == (verdict, status), row
    assert row["status"] == ("unexplained" if verdict == "unexplained" else "ok")
    assert set(row) <= set(names(run.COLUMNS))
    assert row["message"] or status == "ok"


def test_an_early_end_is_a_known_limit_only_where_the_case_names_it():
    status = case_row(Case("x", "a blow", COLLAPSES, 1.0))["run_status"]
    assert status in ("newton-failed", "strain-below-minus-one")
    assert case_row(Case("x", "a blow", COLLAPSES, 1.0, ends=(status,), limit=WHY))["verdict"] == "known limit"
    assert case_row(Case("x", "a blow", COLLAPSES, 1.0, ends=("step-limit",)))["verdict"] == "unexplained"


@pytest.mark.slow
def test_a_case_that_does_not_return_raises_or_dies_is_unexplained(monkeypatch):
    import os
    import time

    for way, status in (
        (lambda *_: time.sleep(60), "hang"),
        (lambda *_: 1 / 0, "traceback"),
        (lambda *_: os._exit(1), "crash"),
    ):
        monkeypatch.setattr(run, "_judged", way)
        row = case_row(Case("x", "y", STILL, 1.0, options={"limit_s": 0.5}))
        assert (row["verdict"], row["run_status"]) == ("unexplained", status)


def test_a_run_that_cannot_be_kept_stops_the_campaign_and_says_nothing_of_its_case(tmp_path):
    with pytest.raises(CampaignStopped, match="cannot write to"):
        case_row(Case("x", "rest", STILL, 2.0, "rest", 1e-9), tmp_path / "gone" / "trajectories" / "key.nc")


def test_a_process_that_died_is_tried_again_with_the_next_call(tmp_path, monkeypatch):
    import os
    from functools import partial

    (tmp_path / "trajectories").mkdir()
    monkeypatch.setattr("campaigns.stability.fuzz.load_kernels", lambda: None)
    task = tasks.Task("case", Case("x", "y", STILL, 1.0))
    for way, kept in ((partial(os._exit, 1), False), (lambda: {"verdict": "ok", "run_status": "ok"}, True)):
        monkeypatch.setattr(run, "_judged", lambda *_, way=way: way())
        tasks.do(tmp_path, "maker", task)
        assert (kept_row(tmp_path, task.key(), "maker") is not None) == kept


def test_every_case_says_why_it_may_end_otherwise_and_has_a_name_of_its_own():
    cases = all_cases()
    names = [(case.group, case.name) for case in cases]
    assert len(set(names)) == len(names)
    for case in cases:
        assert case.check in dir(__import__("campaigns.stability.checks", fromlist=["*"])), case
        assert case.limit or set(case.ends) <= {REFUSED}, case
        assert case.bar > 0 or case.check == "finite", case
    assert {case.group for case in cases if case.quick} == {case.group for case in cases}


@pytest.fixture
def few(monkeypatch):
    """A campaign of three cases, and no counting of shares."""
    cases = [
        Case("EI", "rest", STILL, 2.0, "rest", 1e-9),
        Case("EI", "calm", CALM, 2.0, "refined", 0.05),
        Case("input", "invalid", {"tether.nodes": 1}, 2.0, ends=(REFUSED,)),
    ]
    monkeypatch.setattr(tasks, "all_cases", lambda: cases)
    monkeypatch.setattr("campaigns.stability.step_maps.LINES", {"taut": ("taut", 0.02, 0.05, 2)})
    monkeypatch.setattr("campaigns.stability.step_maps.METHODS", ("backward-euler",))
    monkeypatch.setattr("campaigns.stability.scene_shares.SCENES", {"Table 1": {"tether.nodes": 5}})
    return cases


@pytest.mark.slow
def test_a_campaign_leaves_its_files_and_is_not_done_twice(few, tmp_path, capsys):
    words = ["--fuzz", "6", "--drift-periods", "0", "--out", str(tmp_path / "out"), "--jobs", "1"]
    assert stability.main(words) == 0
    out = tmp_path / "out"
    rows = list(csv.DictReader(open(out / "table.csv", encoding="utf-8")))
    assert [row["verdict"] for row in rows] == ["ok", "ok", "refused", "ok", "ok"]
    assert len(list(csv.DictReader(open(out / "fuzz.csv", encoding="utf-8")))) == 12
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
    few[:] = [Case("EI", "no rest", YIELDS, 1.0)]
    words = ["--fuzz", "0", "--drift-periods", "0", "--out", str(tmp_path / "out"), "--jobs", "1"]
    assert stability.main(words) == 1
    assert "Unexplained" in (tmp_path / "out" / "report.html").read_text(encoding="utf-8")


def test_every_fault_is_named_at_once_and_nothing_is_written(tmp_path, capsys):
    words = ["--fuzz", "-1", "--seed", "x", "--drift-periods", "10", "--bogus", "--out", str(tmp_path / "new")]
    assert stability.main(words) == 2
    said = capsys.readouterr().err
    for word in ("--fuzz", "--seed", "--drift-periods", "--bogus"):
        assert word in said
    assert not (tmp_path / "new").exists()


def test_help_loads_nothing_heavy():
    code = "import sys, campaigns.stability as o; o.parser().format_help(); print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert not {"numpy", "numba", "pandas", "scipy", "matplotlib", "pydantic"} & set(loaded.split())


@pytest.mark.slow
def test_the_quick_campaign(tmp_path):
    """Nothing unexplained among the cases that matter most and forty random scenes of each kind."""
    assert stability.main(["--quick", "--out", str(tmp_path / "out")]) == 0
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "Nothing unexplained" in page and "none hung, crashed, raised" in page
