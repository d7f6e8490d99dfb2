"""A run that fails, in whatever way, is a row with its reason; the others are what they would have been."""

import pytest

from tests.campaigns.conftest import finished

VALUES = ("0.02", "0.03", "0.05", "0.08", "0.13")


def outcome(rows):
    return {row["steepness"]: row["status"] for row in rows}


@pytest.mark.parametrize(
    ("fake", "status", "word"),
    [
        ({"raises": (0.05,)}, "error", "ZeroDivisionError"),
        ({"exits": (0.05,)}, "error", "SystemExit"),
        ({"breaks": (0.05,)}, "newton-failed", "no convergence"),
    ],
)
@pytest.mark.parametrize("backend", ["loky", "threading"])
def test_failed_run_is_a_row(sweep, backend, fake, status, word):
    code, rows, _ = sweep("--steepness", *VALUES, backend=backend, **fake)
    assert code == 0
    assert outcome(rows) == dict.fromkeys(VALUES, "ok") | {"0.05": status}
    assert word in rows[2]["message"]


def test_run_that_ended_early_keeps_its_record_and_is_not_tried_again(sweep):
    _, rows, _ = sweep("--steepness", *VALUES, breaks=(0.05,))
    assert f"{rows[2]['run_key']}.nc" in finished(sweep.out)
    assert rows[2]["steps"] == "7"
    assert rows[2]["radius_max_m"] == ""
    assert sweep("--steepness", *VALUES, breaks=(0.05,))[2] == []


def test_analysis_that_fails_is_a_row_and_the_record_is_kept(sweep, monkeypatch):
    def broken(*_):
        raise FloatingPointError("no such thing")

    monkeypatch.setattr("campaigns.buoy_sweep.rows.settled", broken)
    code, rows, _ = sweep("--steepness", "0.05")
    assert (code, rows[0]["status"]) == (0, "analysis-failed")
    assert "no such thing" in rows[0]["message"]
    assert len(finished(sweep.out)) == 1
    monkeypatch.undo()
    assert sweep("--steepness", "0.05")[1][0]["status"] == "ok"


@pytest.mark.parametrize("jobs", [pytest.param(1, marks=pytest.mark.slow), 2])
def test_run_that_kills_its_process_is_a_row(sweep, jobs):
    code, rows, begun = sweep("--steepness", *VALUES, backend="loky", jobs=jobs, dies=(0.05,))
    assert code == 0
    assert outcome(rows) == dict.fromkeys(VALUES, "ok") | {"0.05": "worker-died"}
    assert begun.count(0.05) == 2


def test_two_runs_that_kill_their_processes_are_two_rows(sweep):
    _, rows, _ = sweep("--steepness", *VALUES, backend="loky", dies=(0.02, 0.08))
    assert outcome(rows) == dict.fromkeys(VALUES, "ok") | {"0.02": "worker-died", "0.08": "worker-died"}


def test_process_that_is_killed_once_costs_nothing(sweep):
    _, rows, begun = sweep("--steepness", *VALUES, backend="loky", dies_once=(0.05,))
    assert outcome(rows) == dict.fromkeys(VALUES, "ok")
    assert begun.count(0.05) == 2


def test_all_runs_failing_is_still_a_table(sweep):
    code, rows, _ = sweep("--steepness", *VALUES, raises=tuple(map(float, VALUES)))
    assert code == 0
    assert set(outcome(rows).values()) == {"error"}


def test_engine_that_changes_under_the_campaign_stops_it(sweep, monkeypatch, capfd):
    hashes = iter(["before"])
    monkeypatch.setattr("engine.source_hash", lambda: next(hashes, "after"))
    monkeypatch.setattr("campaigns.machinery.session.begun", lambda *_: ({}, False))
    code, rows, begun = sweep("--steepness", "0.05")
    assert (code, rows, begun) == (1, [], [])
    assert "sources" in capfd.readouterr().err
