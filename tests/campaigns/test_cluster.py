"""A dask cluster whose workers do not see the campaign's folder: the same table, and whatever dies costs what ran."""

import contextlib
import json
import os
import pickle
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from campaigns import buoy_sweep
from campaigns.explore.judgement import Judgement
from campaigns.explore.rows import COLUMNS, buoy_row
from campaigns.machinery import pools
from campaigns.machinery.cli import Running
from campaigns.machinery.plan import Job, Plan
from campaigns.machinery.runner import run_campaign
from engine import load_scene
from tests.campaigns.conftest import USUAL, VALUES, until
from tests.campaigns.fake_engine import FakeEngine
from tests.pages import ROOT

distributed = pytest.importorskip("distributed")


class Dask:
    """A scheduler and workers as processes of their own; sources: PYTHONPATH of a process."""

    def __init__(self, place: Path, sources: Path = ROOT):
        self.place, self.processes = place, []
        place.mkdir()
        file = place / "scheduler.json"
        words = ["dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--scheduler-file", str(file)]
        self.scheduler = self._started(words, sources)
        until(lambda: file.exists() and file.read_text().rstrip().endswith("}"), self.scheduler)
        self.address = json.loads(file.read_text())["address"]

    def add_worker(self, sources: Path = ROOT):
        return self._started(["dask_worker", self.address, "--nthreads", "1", "--no-nanny"], sources)

    def wait_for_workers(self, count: int) -> None:
        with distributed.Client(self.address) as client:
            client.wait_for_workers(count, timeout=60)

    def _started(self, words: list[str], sources: Path):
        home = self.place / str(len(self.processes))
        home.mkdir()
        env = os.environ | {"PYTHONPATH": str(sources), "TMPDIR": str(home)}
        command = [sys.executable, "-m", f"distributed.cli.{words[0]}", *words[1:], "--no-dashboard"]
        with open(home / "log", "w") as log:
            self.processes.append(subprocess.Popen(command, cwd=home, env=env, stdout=log, stderr=log))
        return self.processes[-1]


@pytest.fixture
def dask(tmp_path):
    """dask(workers, scheduler's sources) -> a running cluster; all its processes end with the test."""
    cluster = []

    def start(workers: int = 2, sources: Path = ROOT) -> Dask:
        cluster.append(Dask(tmp_path / "cluster", sources))
        cluster[0].workers = [cluster[0].add_worker() for _ in range(workers)]
        cluster[0].wait_for_workers(workers)
        return cluster[0]

    yield start
    for process in cluster[0].processes if cluster else ():
        with contextlib.suppress(ProcessLookupError):
            process.kill()
        process.wait()


def at(cluster):
    return ["--backend", "dask", "--dask-address", cluster.address]


def judge(run, checks, orbits):
    """Stands in for `judgement_of`: the orbit that it computes is kept."""
    orbits.finished("an orbit", lambda: {"period": 2})
    return Judgement(2)


def test_a_worker_is_not_told_of_the_folder_and_what_it_sends_is_kept_as_if_it_were(tmp_path, monkeypatch):
    import cloudpickle

    def elsewhere(call, tasks, alone=False, spare=()):
        sent = cloudpickle.dumps(call)
        assert b"of-the-campaign" not in sent
        for task in tasks:
            outcomes = pickle.loads(sent)(pickle.loads(cloudpickle.dumps(task)))
            assert list((place / "trajectories").iterdir()) == [] and outcomes[0][1].content
            yield task, pickle.loads(pickle.dumps(outcomes))

    job = Job({"steepness": 0.05}, load_scene("tethered_buoy", {"waves.steepness": 0.05}), 6)
    places = [tmp_path / "here", tmp_path / "of-the-campaign"]
    rows = []
    for place, backend in zip(places, ("threading", "dask"), strict=True):
        (place / "trajectories").mkdir(parents=True)
        plan = Plan(Running(place, 1, backend), FakeEngine(), buoy_row, COLUMNS, "this one", judge)
        rows += run_campaign(plan, [job]).rows
        monkeypatch.setattr("campaigns.machinery.tasks.opened", lambda *_: contextlib.nullcontext(elsewhere))
    assert rows[0] == rows[1]
    for name in (f"{job.key}.nc", f"{job.key}.row.json", "an orbit.orbit.json"):
        local, remote = (place / "trajectories" / name for place in places)
        assert local.read_bytes() == remote.read_bytes()


@pytest.mark.slow
def test_a_run_that_kills_every_worker_stops_the_campaign_and_new_workers_finish_it(dask, campaign, monkeypatch, capfd):
    monkeypatch.setattr(pools, "GONE_S", 1.0)
    monkeypatch.setattr(pools, "LOOK_S", 0.2)
    cluster = dask()
    words = ["--steepness", *VALUES, *USUAL, *at(cluster), "--out", str(campaign.out)]
    deadly = FakeEngine(dies=(0.04,), sleep_s=0.3)  # time for the runs before it to be handed over
    assert buoy_sweep.main(words, simulate=deadly) == 1
    error = capfd.readouterr().err
    assert "has had no worker for 1 s" in error and "run the same command again" in error
    campaign.sound_part()
    cluster.add_worker()
    cluster.wait_for_workers(1)
    campaign.complete(*at(cluster))


@pytest.mark.slow
@pytest.mark.parametrize("lost", ["worker", "scheduler", "campaign"])
def test_whoever_is_killed_costs_what_was_running(dask, campaign, lost):
    cluster = dask()
    process = campaign.begin(*at(cluster))
    {"worker": cluster.workers[0], "scheduler": cluster.scheduler, "campaign": process}[lost].kill()
    if lost == "campaign":
        process.communicate()
        campaign.complete(*at(cluster))
    elif lost == "scheduler":
        error = campaign.done(process, code=1)
        assert "the dask scheduler has ended" in error and "finished runs are kept" in error
        campaign.complete()
    else:
        campaign.done(process)
        campaign.check_all_ok()
        assert campaign.begun() - len(VALUES) <= 2  # what it was running, and at most one ended and not handed over yet


def changed(folder):
    """A copy of the workbench that differs in its code."""
    for part in ("machine_code", "tables", "engine", "analysis", "campaigns", "reports", "tests"):
        shutil.copytree(ROOT / part, folder / part, ignore=shutil.ignore_patterns("__pycache__"))
    with open(folder / "engine" / "__init__.py", "a") as file:
        file.write("changed = True\n")
    return folder


def absent(folder):
    """What a process finds where the workbench is not installed, wherever the tests run."""
    # An editable install finds `campaigns.machinery` behind a package of ours that has no such part.
    (folder / "campaigns").mkdir(parents=True)
    (folder / "campaigns" / "__init__.py").write_text("raise ModuleNotFoundError(\"No module named 'campaigns'\")\n")
    return folder


@pytest.mark.slow
@pytest.mark.parametrize(
    ("worker", "scheduler", "word"),
    [
        (changed, None, "tcp://127.0.0.1"),
        (absent, None, "No module named 'campaigns'"),
        (None, absent, "the scheduler: No module named"),
    ],
)
def test_another_version_is_refused_by_name(dask, campaign, tmp_path, worker, scheduler, word):
    cluster = dask(1, scheduler(tmp_path / "other") if scheduler else ROOT)
    if worker:
        cluster.add_worker(worker(tmp_path / "other"))
        cluster.wait_for_workers(2)
    error = campaign.done(campaign.start(*at(cluster), sleep_s=1.0), code=1)
    assert "refused" in error and word in error and "numba" not in error
    assert worker is not changed or "sources of engine" in error


@pytest.mark.slow
def test_a_stopped_worker_keeps_nobody_from_starting(dask, campaign):
    cluster = dask()
    cluster.workers[0].send_signal(signal.SIGSTOP)
    process = campaign.start(*at(cluster))
    try:
        until(lambda: len(campaign.finished()) >= 2, process)
        time.sleep(0.2)
    finally:
        cluster.workers[0].send_signal(signal.SIGCONT)
    campaign.done(process)
    campaign.check_all_ok()
