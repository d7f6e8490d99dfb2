"""A dask cluster whose workers do not see the campaign's folder: the same table, and whatever dies costs what ran."""

import contextlib
import csv
import json
import os
import pickle
import shutil
import signal
import subprocess
import sys
import time
from functools import partial
from pathlib import Path

import pytest

from campaigns import buoy_sweep
from campaigns.buoy_sweep.rows import COLUMNS, buoy_row
from campaigns.machinery import cluster
from campaigns.machinery.plan import KeptRun, Plan, make_job
from campaigns.machinery.worker import received, run_one
from engine import Trajectory, load_scene
from tests.campaigns.conftest import ROOT, finished, rows_of, start_sweep, until
from tests.campaigns.fake_engine import FakeEngine, sines

distributed = pytest.importorskip("distributed")
VALUES = [f"{0.01 * number:.2f}" for number in range(1, 13)]


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
    found = []

    def start(workers: int = 2, sources: Path = ROOT) -> Dask:
        found.append(Dask(tmp_path / "cluster", sources))
        found[0].workers = [found[0].add_worker() for _ in range(workers)]
        found[0].wait_for_workers(workers)
        return found[0]

    yield start
    for process in found[0].processes if found else ():
        with contextlib.suppress(ProcessLookupError):
            process.kill()
        process.wait()


def at(found):
    return ["--backend", "dask", "--dask-address", found.address]


def done(process, code=0):
    """Wait for its end; returns stderr."""
    output, error = process.communicate(timeout=120)
    assert process.returncode == code, output + error
    assert "Traceback" not in error
    return error


def test_a_worker_is_not_told_of_the_folder_and_what_it_sends_is_kept_as_if_it_were(tmp_path):
    import cloudpickle

    place = tmp_path / "of-the-campaign"
    (place / "trajectories").mkdir(parents=True)
    describe = partial(buoy_row, transient_periods=2)
    job = make_job(load_scene("tethered_buoy", {"waves.steepness": 0.05}), 6, labels={"steepness": 0.05})
    far = Plan(place, FakeEngine(), describe, COLUMNS, "dask", row_maker="this one")
    assert b"of-the-campaign" not in cloudpickle.dumps(partial(run_one, far.for_workers()))
    sent = pickle.loads(pickle.dumps(run_one(far.for_workers(), job)))
    assert list((place / "trajectories").iterdir()) == [] and sent.content
    assert received(far, job, sent).row == run_one(Plan(place, FakeEngine(), describe, COLUMNS), job).row
    (path,) = (place / "trajectories").glob("*.nc")
    assert path.read_bytes() == sent.content and path.with_suffix(".row.json").exists()


def test_a_kept_run_takes_its_content_along_and_leaves_its_path(tmp_path):
    path = tmp_path / "run.nc"
    sines(load_scene("tethered_buoy"), 6).save(path)
    there = pickle.loads(pickle.dumps(KeptRun(path)))
    path.unlink()
    assert there.path is None and there.load().status == "ok"


@pytest.mark.slow
def test_the_results_are_those_of_processes_from_the_repeated_runs_too(dask, tmp_path):
    tables = []
    for name, more in (("loky", []), ("dask", at(dask()))):
        words = ["--steepness", *VALUES, "--periods", "12", "--transient", "2", "--no-report", *more]
        engine = FakeEngine(breaks=(0.03,), raises=(0.05,))
        assert buoy_sweep.main([*words, "--out", str(tmp_path / name)], simulate=engine) == 0
        with open(tmp_path / name / "accuracy" / "table.csv", newline="") as file:
            tables.append((rows_of(tmp_path / name), list(csv.DictReader(file)), sorted(finished(tmp_path / name))))
    assert tables[0] == tables[1] and len(tables[0][1]) == 3


@pytest.mark.slow
def test_a_worker_killed_in_mid_sweep_costs_its_running_job(dask, tmp_path):
    log, out, found = tmp_path / "log", tmp_path / "out", dask()
    process = start_sweep(out, "--steepness", *VALUES, *at(found), log=str(log), sleep_s=0.3)
    until(lambda: len(finished(out)) >= 2, process)
    found.workers[0].send_signal(signal.SIGKILL)
    done(process)
    assert [row["status"] for row in rows_of(out)] == ["ok"] * len(VALUES)
    # what it was running, and at most one that it had ended and not handed over yet
    assert len(log.read_text().split()) - len(VALUES) <= 2


@pytest.mark.slow
def test_a_run_that_kills_every_worker_stops_the_campaign_and_new_workers_finish_it(dask, tmp_path, monkeypatch, capfd):
    monkeypatch.setattr(cluster, "GONE_S", 1.0)
    monkeypatch.setattr(cluster, "LOOK_S", 0.2)
    found, out = dask(), tmp_path / "out"
    words = ["--steepness", *VALUES, "--periods", "6", "--transient", "2", "--no-report", "--no-accuracy", *at(found)]
    deadly = FakeEngine(dies=(0.04,), sleep_s=0.3)  # time for the runs before it to be handed over
    assert buoy_sweep.main([*words, "--out", str(out)], simulate=deadly) == 1
    error = capfd.readouterr().err
    assert "has had no worker for 1 s" in error and "run the same command again" in error
    kept = finished(out)
    assert 0 < len(kept) < len(VALUES)
    found.add_worker()
    found.wait_for_workers(1)
    assert buoy_sweep.main([*words, "--out", str(out)], simulate=FakeEngine()) == 0
    assert kept.items() <= finished(out).items() and len(finished(out)) == len(VALUES)


@pytest.mark.slow
@pytest.mark.parametrize("whose", ["scheduler", "campaign"])
def test_a_scheduler_or_a_campaign_that_dies_leaves_sound_runs(dask, tmp_path, whose):
    found, out = dask(), tmp_path / "out"
    process = start_sweep(out, "--steepness", *VALUES, *at(found), sleep_s=0.3)
    until(lambda: len(finished(out)) >= 2, process)
    (found.scheduler if whose == "scheduler" else process).kill()
    if whose == "scheduler":
        error = done(process, code=1)
        assert "the dask scheduler has ended" in error and "finished runs are kept" in error
    else:
        process.communicate()
    kept = finished(out)
    for name in kept:
        Trajectory.load(out / "trajectories" / name)
    more = at(found) if whose == "campaign" else []
    done(start_sweep(out, "--steepness", *VALUES, *more))
    assert kept.items() <= finished(out).items() and len(rows_of(out)) == len(VALUES)


def changed(folder):
    """A copy of the workbench that differs in a comment."""
    for part in ("machine_code", "engine", "analysis", "campaigns", "reports", "tests"):
        shutil.copytree(ROOT / part, folder / part, ignore=shutil.ignore_patterns("__pycache__"))
    with open(folder / "engine" / "__init__.py", "a") as file:
        file.write("# changed\n")
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
def test_another_version_is_refused_by_name(dask, tmp_path, worker, scheduler, word):
    found = dask(1, scheduler(tmp_path / "other") if scheduler else ROOT)
    if worker:
        found.add_worker(worker(tmp_path / "other"))
        found.wait_for_workers(2)
    error = done(start_sweep(tmp_path / "out", "--steepness", *VALUES, *at(found), sleep_s=1.0), code=1)
    assert "refused" in error and word in error and "numba" not in error
    assert worker is not changed or "sources of engine" in error


@pytest.mark.slow
def test_a_stopped_worker_keeps_nobody_from_starting(dask, tmp_path):
    found = dask()
    found.workers[0].send_signal(signal.SIGSTOP)
    process = start_sweep(tmp_path / "out", "--steepness", *VALUES, *at(found))
    try:
        until(lambda: len(finished(tmp_path / "out")) >= 2, process)
        time.sleep(0.2)
    finally:
        found.workers[0].send_signal(signal.SIGCONT)
    done(process)
    assert [row["status"] for row in rows_of(tmp_path / "out")] == ["ok"] * len(VALUES)
