"""An accident costs what was running and nothing else: a run that fails is a row with its reason; a campaign that is
killed, interrupted or out of disk leaves a readable folder, and the same command completes the rest and only that.
"""

import os
import shutil
import signal
import subprocess
import time
from dataclasses import replace
from functools import partial

import psutil
import pytest

from campaigns.explore.judgement import Judgement
from campaigns.explore.rows import COLUMNS, buoy_row
from campaigns.machinery.cli import Running
from campaigns.machinery.folder import PROGRESS, CampaignStopped, claimed, write_new
from campaigns.machinery.long_runs import until_judged
from campaigns.machinery.plan import Job, Plan
from campaigns.machinery.runner import FEWEST, MOST, groups_of, run_campaign, spare_groups
from engine import load_scene
from tests.campaigns.conftest import VALUES, finished, rows_of, statuses, until
from tests.campaigns.fake_engine import FakeEngine

FIVE = (0.02, 0.03, 0.05, 0.08, 0.13)
SLOW = pytest.mark.slow


@pytest.mark.parametrize(
    ("backend", "jobs", "fake", "status", "word"),
    [
        *(
            (backend, 2, fake, status, word)
            for backend in ("loky", "threading")
            for fake, status, word in (
                ({"raises": (0.05,)}, "error", "ZeroDivisionError"),
                ({"exits": (0.05,)}, "error", "SystemExit"),
                ({"breaks": (0.05,)}, "newton-failed", "no convergence"),
            )
        ),
        ("threading", 2, {"raises": FIVE}, "error", "ZeroDivisionError"),
        pytest.param("loky", 2, {"dies": (0.02, 0.08)}, "worker-died", "running alone", marks=SLOW),
        pytest.param("loky", 2, {"dies_once": (0.05,)}, "ok", "", marks=SLOW),
        pytest.param("dask", 2, {"dies": (0.05,)}, "worker-died", "running alone", marks=SLOW),
    ],
)
def test_a_run_that_fails_is_a_row_and_the_others_are_what_they_would_have_been(
    sweep, backend, jobs, fake, status, word
):
    if backend == "dask":
        pytest.importorskip("distributed")
    ((accident, failing),) = fake.items()
    code, rows, begun = sweep("--steepness", *FIVE, backend=backend, jobs=jobs, **fake)
    assert code == 0
    assert statuses(rows) == dict.fromkeys(FIVE, "ok") | dict.fromkeys(failing, status)
    assert all(word in row["message"] for row in rows if row["status"] != "ok")
    # once more alone, where it may have killed its process: no run kills more than two
    assert max(begun.count(value) for value in failing) == (2 if accident.startswith("dies") else 1)


def test_a_run_that_ended_early_keeps_its_record_and_is_not_tried_again(sweep):
    _, rows, _ = sweep("--steepness", *FIVE, breaks=(0.05,))
    assert f"{rows[2]['run_key']}.nc" in finished(sweep.out)
    assert rows[2]["steps"] == "7"
    assert rows[2]["radius_max_m"] == ""
    assert sweep("--steepness", *FIVE, breaks=(0.05,))[2] == []


def test_an_analysis_that_fails_is_a_row_and_the_record_is_kept(sweep, monkeypatch):
    def broken(*_):
        raise FloatingPointError("no such thing")

    monkeypatch.setattr("campaigns.explore.rows.settled", broken)
    code, rows, _ = sweep("--steepness", "0.05")
    assert (code, rows[0]["status"]) == (0, "analysis-failed")
    assert "no such thing" in rows[0]["message"]
    assert len(finished(sweep.out)) == 1
    monkeypatch.undo()
    assert sweep("--steepness", "0.05")[1][0]["status"] == "ok"


def test_an_engine_that_changes_under_the_campaign_stops_it(sweep, monkeypatch, capfd):
    hashes = iter(["before"])
    monkeypatch.setattr("engine.source_hash", lambda: next(hashes, "after"))
    code, rows, begun = sweep("--steepness", "0.05")
    assert (code, rows, begun) == (1, [], [])
    assert "sources" in capfd.readouterr().err


@pytest.mark.slow
def test_kill_9_of_the_campaign(campaign):
    process = campaign.begin(finished=3)
    workers = psutil.Process(process.pid).children(recursive=True)
    process.kill()
    process.communicate()
    assert psutil.wait_procs(workers, timeout=20)[1] == []  # none computes on for nobody
    (campaign.out / "trajectories" / ".half-written.nc.tmp").write_bytes(b"CDF")  # what a kill within a write leaves
    campaign.complete()


@pytest.mark.slow
@pytest.mark.parametrize("backend", ["loky", "threading", "dask"])
def test_interrupt(campaign, backend):
    if backend == "dask":
        pytest.importorskip("distributed")
    process = campaign.begin("--backend", backend, finished=3, session=True)
    os.killpg(process.pid, signal.SIGINT)  # a terminal sends it to every process of the campaign
    error = campaign.done(process, code=130)
    assert "to go on with the rest: python -m campaigns.buoy_sweep --steepness 0.01" in error
    assert len(rows_of(campaign.out)) > 0
    begun = campaign.begun()
    time.sleep(0.7)
    assert campaign.begun() == begun
    campaign.complete()


@pytest.mark.slow
def test_a_second_campaign_in_the_folder_is_turned_away(campaign):
    first = campaign.start(values=VALUES[:4], sleep_s=1.0)
    until((campaign.out / "table.csv").exists, first)
    assert f"in use by process {first.pid}" in campaign.done(campaign.start(values=["0.05"]), code=1)
    assert "0.05" not in (campaign.out / "provenance.json").read_text()
    campaign.done(first)
    assert len(campaign.finished()) == 4


@pytest.fixture
def small_disk(campaign, tmp_path):
    """A disk with room for some of the runs, in which the campaign has its folder."""
    place = tmp_path / "disk"
    place.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=512k", "tmpfs", str(place)]
    if not shutil.which("mount") or subprocess.run(mount, capture_output=True).returncode != 0:
        pytest.skip("mounting a small disk is not permitted here")
    campaign.out = place / "out"
    yield place
    subprocess.run(["umount", str(place)], check=True)


@pytest.mark.slow
def test_a_disk_that_fills_up(small_disk, campaign):
    assert "is full" in campaign.done(campaign.start(), code=1)
    assert campaign.sound_part() and not list(campaign.out.rglob(".*.tmp"))
    subprocess.run(["mount", "-o", "remount,size=8m", str(small_disk)], check=True)
    campaign.complete()


def test_a_folder_that_is_let_go_holds_nothing_half_written(tmp_path):
    with claimed(tmp_path):
        (tmp_path / "trajectories" / ".a.nc.7-77.tmp").write_bytes(b"CDF")
        (tmp_path / f"{PROGRESS}a").mkdir()
    assert not [*tmp_path.rglob(".*.tmp"), *tmp_path.glob(f"{PROGRESS}*")]


def test_a_file_that_has_its_content_already_is_left_as_it_is(tmp_path):
    path = tmp_path / "answer.txt"
    write_new(path, b"the answer")
    inode = path.stat().st_ino
    write_new(path, b"the answer")
    assert path.stat().st_ino == inode
    write_new(path, b"another")
    assert path.read_bytes() == b"another"


def test_no_space_within_a_run_stops_the_campaign(sweep, capfd):
    code, rows, _ = sweep("--steepness", *VALUES, no_space=(0.06,), jobs=1)
    assert code == 1
    assert [row["status"] for row in rows] == ["ok"] * 5
    error = capfd.readouterr().err
    assert "is full" in error and "Traceback" not in error
    assert len(sweep("--steepness", *VALUES)[2]) == len(VALUES) - 5


def test_a_table_that_does_not_fit_leaves_the_old_one(sweep, monkeypatch):
    _, rows, _ = sweep("--steepness", "0.01", "0.02")

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("campaigns.machinery.folder.write_atomic", full)
    code, rows_left, _ = sweep("--steepness", *VALUES)
    assert (code, rows_left) == (1, rows)


def plan_of(folder, engine, jobs=2):
    """Of runs that share workers."""
    describe = partial(buoy_row, judgement=Judgement(2))
    return Plan(Running(folder, jobs, "loky"), engine, describe, COLUMNS, simulate_each=engine.each)


LATER = [0.04, 0.06, 0.07, 0.09]


@pytest.mark.parametrize(
    ("accident", "status"), [("", "ok"), ("raises", "error"), pytest.param("dies", "worker-died", marks=SLOW)]
)
def test_workers_that_would_wait_do_runs_of_a_later_step_which_begins_none_of_them_again(tmp_path, accident, status):
    (tmp_path / "trajectories").mkdir()
    failing = {accident: (0.06,)} if accident else {}
    engine = FakeEngine(log=str(tmp_path / "log"), sleep_s=0.3, **failing)
    plan = plan_of(tmp_path, engine)
    for job in jobs_of(LATER):
        plan.spare.extend(spare_groups(plan, tmp_path / "later", [job]))
    summary = run_campaign(plan, jobs_of(FIVE))
    assert statuses(summary.rows) == dict.fromkeys(FIVE, "ok")
    on_disk = len(finished(tmp_path / "later"))
    assert 0 < on_disk < 4 - len(plan.spare) + 1
    later = replace(plan, how=replace(plan.how, out=tmp_path / "later"), spare=[])
    summary = run_campaign(later, jobs_of(LATER))
    assert summary.found == on_disk
    assert statuses(summary.rows) == dict.fromkeys(LATER, "ok") | ({0.06: status} if accident else {})
    if accident != "dies":  # a process that dies takes the runs of the other one with it
        repeated = {value for value in engine.begun() if engine.begun().count(value) > 1}
        assert repeated == set(*failing.values())


EIGHT = [0.02, 0.03, 0.05, 0.08, 0.1, 0.11, 0.13, 0.14]


@pytest.fixture
def side_by_side(tmp_path):
    """Runs that share a worker: together(jobs, **fields of the FakeEngine) -> summary, steepness of the runs begun."""
    (tmp_path / "trajectories").mkdir()

    def run(jobs=2, **fake):
        log = tmp_path / "log"
        log.unlink(missing_ok=True)
        engine = FakeEngine(log=str(log), **fake)
        return run_campaign(plan_of(tmp_path, engine, jobs), jobs_of(EIGHT)), engine.begun()

    run.out = tmp_path
    return run


def jobs_of(values, changes=None):
    scenes = {value: load_scene("tethered_buoy", {"waves.steepness": value, **(changes or {})}) for value in values}
    return [Job({"steepness": value}, scene, 6) for value, scene in scenes.items()]


@pytest.mark.parametrize("jobs", [1, 2])
def test_every_run_that_shares_a_worker_becomes_a_row_once(side_by_side, jobs):
    summary, begun = side_by_side(jobs=jobs)
    assert statuses(summary.rows) == dict.fromkeys(EIGHT, "ok")
    assert sorted(begun) == EIGHT and summary.computed == len(EIGHT)
    second, begun = side_by_side(jobs=jobs)
    assert begun == [] and second.found == len(EIGHT)
    assert [row["run_key"] for row in second.rows] == [row["run_key"] for row in summary.rows]


@pytest.mark.parametrize(
    ("accident", "status", "times"),
    [
        ("raises", "error", 2),
        ("breaks", "newton-failed", 1),
        ("exits", "error", 2),
        pytest.param("dies", "worker-died", 3, marks=pytest.mark.slow),
    ],
)
def test_a_run_that_fails_costs_those_beside_it_nothing(side_by_side, accident, status, times):
    """One worker, in order: 0.02 to 0.05 are on disk when it dies; 0.08 dies twice more alone, the rest runs alone.

    Where 0.08 breaks off with an exception it is tried once more, alone.
    """
    summary, begun = side_by_side(jobs=1, **{accident: (0.08,)})
    assert statuses(summary.rows) == dict.fromkeys(EIGHT, "ok") | {0.08: status}
    assert {value: begun.count(value) for value in EIGHT} == dict.fromkeys(EIGHT, 1) | {0.08: times}


@pytest.mark.slow
def test_a_full_disk_stops_the_campaign_and_keeps_what_is_finished(side_by_side):
    with pytest.raises(CampaignStopped, match="full"):
        side_by_side(jobs=1, no_space=(0.1,))
    begun, on_disk = (side_by_side.out / "log").read_text().split(), len(finished(side_by_side.out))
    assert begun.index("0.1") == on_disk > 0, "all that ran before it are on disk"
    assert statuses(rows_of(side_by_side.out)).keys() <= set(EIGHT)
    summary, begun = side_by_side()
    assert summary.found == on_disk and len(begun) == len(EIGHT) - on_disk


def groups(tmp_path, jobs, backend="loky", **options):
    return groups_of(Plan(Running(tmp_path, 2, backend), None, None, (), **options), jobs)


def test_groups_are_even_and_hold_every_job_once(tmp_path):
    jobs, side_by_side = (
        jobs_of([round(0.01 + 0.0005 * i, 4) for i in range(250)]),
        {"simulate_each": FakeEngine().each},
    )
    grouped = groups(tmp_path, jobs, **side_by_side)
    sizes = [len(group) for group in grouped]
    assert len(grouped) % 2 == 0 and max(sizes) - min(sizes) <= 1 and max(sizes) <= MOST
    assert sorted(job.key for group in grouped for job in group) == sorted(job.key for job in jobs)
    assert groups(tmp_path, jobs[: 2 * FEWEST - 1], **side_by_side) == []  # of two workers
    # the engine runs one by one what keeps profiles, and threads share no worker
    assert groups(tmp_path, jobs_of(EIGHT, {"output.profiles": True}), **side_by_side) == []
    assert groups(tmp_path, jobs_of(EIGHT), "threading", **side_by_side) == groups(tmp_path, jobs_of(EIGHT)) == []


def test_jobs_that_last_as_long_as_they_need_share_no_group_with_those_of_one_length(tmp_path):
    jobs = jobs_of([0.01 + 0.01 * i for i in range(12)])
    lasting = [replace(job, going=until_judged) for job in jobs[::2]]
    grouped = groups(tmp_path, [*lasting, *jobs[1::2]], simulate_each=FakeEngine().each)
    assert sum(map(len, grouped)) == len(jobs)
    assert all(len({job.going for job in group}) == 1 for group in grouped)


def test_no_group_gets_cheap_runs_beside_all_the_dear_ones(tmp_path):
    """Eight runs on 81 nodes cost as much as 31 on 21 nodes."""
    jobs = jobs_of([0.01 + 0.005 * i for i in range(16)], {"tether.nodes": 21})
    jobs += jobs_of([0.1 + 0.005 * i for i in range(8)], {"tether.nodes": 81})
    costs = []
    for group in groups(tmp_path, jobs, simulate_each=FakeEngine().each):
        costs.append(sum(job.scene.tether.nodes for job in group))
    assert sum(costs) == 16 * 21 + 8 * 81 and max(costs) <= 8 * 81


def test_few_jobs_of_another_length_share_one_worker_while_others_work(tmp_path):
    jobs, side_by_side = jobs_of([0.01 + 0.01 * i for i in range(12)]), {"simulate_each": FakeEngine().each}
    few = [replace(job, periods=7) for job in jobs[:FEWEST]]
    *_, last = groups(tmp_path, [*jobs, *few], **side_by_side)
    assert {job.key for job in last} == {job.key for job in few}
    assert groups(tmp_path, few, **side_by_side) == []
    assert len(groups(tmp_path, [*jobs, *few[1:]], **side_by_side)) == 2
