"""Runs that share a worker: every run is saved as it ends, and what goes wrong with one costs the others nothing."""

from functools import partial

import pytest

from campaigns.buoy_sweep.rows import COLUMNS, buoy_row
from campaigns.machinery.cli import Running
from campaigns.machinery.folder import CampaignStopped
from campaigns.machinery.plan import Job, Plan
from campaigns.machinery.runner import FEWEST, MOST, groups_of, run_campaign
from engine import load_scene
from tests.campaigns.conftest import finished, rows_of
from tests.campaigns.fake_engine import FakeEngine

VALUES = [0.02, 0.03, 0.05, 0.08, 0.1, 0.11, 0.13, 0.14]


@pytest.fixture
def campaign(tmp_path):
    """campaign(values, **fields of the FakeEngine) -> summary, steepness of the runs begun in order."""
    (tmp_path / "trajectories").mkdir()

    def run(values=VALUES, jobs=2, backend="loky", changes=None, **fake):
        log = tmp_path / "log"
        log.unlink(missing_ok=True)
        engine = FakeEngine(log=str(log), **fake)
        describe = partial(buoy_row, transient_periods=2)
        how = Running(tmp_path, jobs, backend)
        plan = Plan(how, engine, describe, COLUMNS, simulate_each=engine.each, show_progress=False)
        run.engine = engine
        return run_campaign(plan, jobs_of(values, changes)), engine.begun()

    run.out = tmp_path
    return run


def jobs_of(values, changes=None):
    scenes = {value: load_scene("tethered_buoy", {"waves.steepness": value, **(changes or {})}) for value in values}
    return [Job({"steepness": value}, scene, 6) for value, scene in scenes.items()]


def statuses(rows):
    return {float(row["steepness"]): row["status"] for row in rows}


@pytest.mark.parametrize("jobs", [1, 2])
def test_every_run_becomes_a_row_once(campaign, jobs):
    summary, begun = campaign(jobs=jobs)
    assert statuses(summary.rows) == dict.fromkeys(VALUES, "ok")
    assert sorted(begun) == VALUES and summary.computed == len(VALUES)
    again, begun = campaign(jobs=jobs)
    assert begun == [] and again.found == len(VALUES)
    assert [row["run_key"] for row in again.rows] == [row["run_key"] for row in summary.rows]


def test_a_run_that_kills_its_worker_leaves_the_finished_ones_finished(campaign):
    """One worker, in order: 0.02 to 0.05 are on disk when it dies; 0.08 dies twice more alone, the rest runs alone."""
    summary, begun = campaign(jobs=1, dies=(0.08,))
    assert statuses(summary.rows) == dict.fromkeys(VALUES, "ok") | {0.08: "worker-died"}
    assert {value: begun.count(value) for value in VALUES} == dict.fromkeys(VALUES, 1) | {0.08: 3}


@pytest.mark.parametrize(
    ("fake", "status"),
    [({"raises": (0.08,)}, "error"), ({"breaks": (0.08,)}, "newton-failed"), ({"exits": (0.08,)}, "error")],
)
def test_a_run_that_fails_is_a_row_and_the_others_are_not(campaign, fake, status):
    summary, _ = campaign(**fake)
    assert statuses(summary.rows) == dict.fromkeys(VALUES, "ok") | {0.08: status}


def test_a_full_disk_stops_the_campaign_and_keeps_what_is_finished(campaign):
    with pytest.raises(CampaignStopped, match="full"):
        campaign(jobs=1, no_space=(0.1,))
    assert len(finished(campaign.out)) >= 4
    done = len(finished(campaign.out))
    assert statuses(rows_of(campaign.out)).keys() <= set(VALUES)
    summary, begun = campaign()
    assert summary.found == done and len(begun) == len(VALUES) - done


def groups(tmp_path, jobs, backend="loky", **how):
    return groups_of(Plan(Running(tmp_path, 2, backend), None, None, (), **how), jobs)


def test_groups_are_even_and_hold_every_job_once(tmp_path):
    many, together = jobs_of([round(0.01 + 0.0005 * i, 4) for i in range(250)]), {"simulate_each": FakeEngine().each}
    found = groups(tmp_path, many, **together)
    sizes = [len(group) for group in found]
    assert len(found) % 2 == 0 and max(sizes) - min(sizes) <= 1 and max(sizes) <= MOST
    assert sorted(job.key for group in found for job in group) == sorted(job.key for job in many)
    assert groups(tmp_path, many[: FEWEST - 1], **together) == []
    # the engine runs one by one what keeps profiles, and threads share no worker
    assert groups(tmp_path, jobs_of(VALUES, {"output.profiles": True}), **together) == []
    assert groups(tmp_path, jobs_of(VALUES), "threading", **together) == groups(tmp_path, jobs_of(VALUES)) == []
