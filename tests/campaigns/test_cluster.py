"""A cluster whose workers see no folder of the campaign: the same table, and whatever dies costs what was running."""

import csv
import json
import os
import shutil
import signal
from functools import partial

import pytest

from campaigns import buoy_sweep
from campaigns.buoy_sweep.rows import COLUMNS, buoy_row
from campaigns.machinery.plan import Plan, make_job
from campaigns.machinery.runner import run_campaign
from engine import Trajectory, load_scene
from tests.campaigns.clusters import ROOT, can_hide, cluster_of
from tests.campaigns.conftest import finished, rows_of, start_sweep, until
from tests.campaigns.fake_engine import FakeEngine

pytest.importorskip("distributed")
pytestmark = pytest.mark.slow
VALUES = [f"{0.01 * number:.2f}" for number in range(1, 13)]


@pytest.fixture
def place(tmp_path):
    """The client's folder, which workers do not see; what workers log is beside it."""
    folder = tmp_path / "client"
    folder.mkdir()
    return folder


@pytest.fixture
def cluster(tmp_path, place):
    with cluster_of(tmp_path / "cluster", place) as found:
        yield found


def at(found):
    return ["--backend", "dask", "--dask-address", found.address]


def done(process, code=0):
    """Wait for its end; returns stderr."""
    output, error = process.communicate(timeout=120)
    assert process.returncode == code, output + error
    assert "Traceback" not in error
    return error


def begun(log):
    return [f"{float(line):.2f}" for line in log.read_text().split()]


def contents(out):
    return {path.name: path.read_bytes() for path in (out / "trajectories").glob("*.nc")}


def test_the_results_are_those_of_processes(cluster, place):
    words = ["--steepness", *VALUES]
    done(start_sweep(place / "loky", *words, breaks=(0.03,), raises=(0.05,)))
    done(start_sweep(place / "dask", *words, *at(cluster), breaks=(0.03,), raises=(0.05,)))
    assert rows_of(place / "dask") == rows_of(place / "loky")
    assert contents(place / "dask") == contents(place / "loky") and len(contents(place / "dask")) == len(VALUES) - 1
    assert json.loads((place / "dask" / "provenance.json").read_text())["dask_address"] == cluster.address
    files = finished(place / "dask")
    done(start_sweep(place / "dask", *words, *at(cluster)))
    assert files.items() <= finished(place / "dask").items()


def test_rows_made_from_two_runs_find_the_other_one(cluster, place):
    """The repeated runs of a sweep are held against files that only the client has."""
    tables = []
    for name, more in (("loky", []), ("dask", at(cluster))):
        words = ["--steepness", "0.02", "0.13", "--periods", "12", "--transient", "2", "--no-report", *more]
        assert buoy_sweep.main([*words, "--out", str(place / name)], simulate=FakeEngine()) == 0
        with open(place / name / "accuracy" / "table.csv", newline="") as file:
            tables.append(list(csv.DictReader(file)))
    assert tables[0] == tables[1]
    assert len(tables[0]) == 3 and {row["error_m"] for row in tables[0]} == {"0.0"}


def test_a_worker_killed_in_mid_sweep_costs_its_running_job(cluster, place, tmp_path):
    log = tmp_path / "log"
    process = start_sweep(place / "out", "--steepness", *VALUES, *at(cluster), log=str(log), sleep_s=0.3)
    until(lambda: len(finished(place / "out")) >= 2, process)
    cluster.workers[0].send_signal(signal.SIGKILL)
    done(process)
    assert [row["status"] for row in rows_of(place / "out")] == ["ok"] * len(VALUES)
    # what it was running, and at most one that it had ended and not handed over yet
    assert set(begun(log)) == set(VALUES) and len(begun(log)) - len(VALUES) <= 2
    done(start_sweep(place / "loky", "--steepness", *VALUES))
    assert rows_of(place / "out") == rows_of(place / "loky")


def test_a_batch_that_is_lost_is_done_again(cluster, place, tmp_path):
    engine = FakeEngine(log=str(tmp_path / "log"), dies_once=(0.08,))
    (place / "trajectories").mkdir()
    describe = partial(buoy_row, transient_periods=2)
    where = "dask", 2, cluster.address
    plan = Plan(place, engine, describe, COLUMNS, *where, show_progress=False, simulate_each=engine.each)
    scenes = {value: load_scene("tethered_buoy", {"waves.steepness": float(value)}) for value in VALUES}
    jobs = [make_job(scene, 6, labels={"steepness": value}) for value, scene in scenes.items()]
    summary = run_campaign(plan, jobs)
    assert [row["status"] for row in summary.rows] == ["ok"] * len(VALUES)
    assert len(finished(place)) == len(VALUES)
    again = [value for value in VALUES if begun(tmp_path / "log").count(value) > 1]
    assert "0.08" in again and len(again) <= 8


def test_a_run_that_kills_every_worker_stops_the_campaign_and_new_workers_finish_it(cluster, place, monkeypatch, capfd):
    monkeypatch.setattr("campaigns.machinery.cluster.GONE_S", 1.0)
    monkeypatch.setattr("campaigns.machinery.cluster._LOOK_S", 0.2)
    words = ["--steepness", *VALUES, "--periods", "6", "--transient", "2", "--no-report", "--no-accuracy", *at(cluster)]
    deadly = FakeEngine(dies=(0.04,), sleep_s=0.3)  # time for the runs before it to be handed over
    assert buoy_sweep.main([*words, "--out", str(place / "out")], simulate=deadly) == 1
    error = capfd.readouterr().err
    assert "has had no worker for 1 s" in error and "run the same command again" in error and "Traceback" not in error
    kept = finished(place / "out")
    assert 0 < len(kept) < len(VALUES)
    cluster.add_worker()
    cluster.wait_for_workers(1)
    assert buoy_sweep.main([*words, "--out", str(place / "out")], simulate=FakeEngine()) == 0
    assert kept.items() <= finished(place / "out").items() and len(finished(place / "out")) == len(VALUES)


def test_a_scheduler_that_dies_stops_the_campaign_in_one_line(cluster, place):
    process = start_sweep(place / "out", "--steepness", *VALUES, *at(cluster), sleep_s=0.3)
    until(lambda: len(finished(place / "out")) >= 2, process)
    cluster.scheduler.kill()
    error = done(process, code=1)
    assert "the dask scheduler has ended" in error and "finished runs are kept" in error
    for name in finished(place / "out"):
        Trajectory.load(place / "out" / "trajectories" / name)


def test_interrupt(cluster, place, tmp_path):
    words = ["--steepness", *VALUES, *at(cluster)]
    process = start_sweep(place / "out", *words, session=True, sleep_s=0.3)
    until(lambda: len(finished(place / "out")) >= 2, process)
    os.killpg(process.pid, signal.SIGINT)
    assert "to go on with the rest" in done(process, code=130)
    kept = finished(place / "out")
    done(start_sweep(place / "out", *words))
    assert kept.items() <= finished(place / "out").items()
    assert [row["status"] for row in rows_of(place / "out")] == ["ok"] * len(VALUES)


def changed(folder):
    """A copy of the workbench that differs in a comment."""
    for part in ("machine_code", "engine", "analysis", "campaigns", "reports", "tests"):
        shutil.copytree(ROOT / part, folder / part, ignore=shutil.ignore_patterns("__pycache__"))
    with open(folder / "engine" / "scales.py", "a") as file:
        file.write("# changed\n")
    return folder


def absent(folder):
    """What a worker finds where the workbench is not installed, wherever the tests run."""
    # An editable install finds `campaigns.machinery` behind a package of ours that has no such part.
    (folder / "campaigns").mkdir(parents=True)
    (folder / "campaigns" / "__init__.py").write_text("raise ModuleNotFoundError(\"No module named 'campaigns'\")\n")
    return folder


@pytest.mark.parametrize(("there", "word"), [(changed, "sources of engine"), (absent, "No module named 'campaigns")])
def test_a_worker_of_another_version_is_refused(tmp_path, place, there, word):
    with cluster_of(tmp_path / "cluster", place, workers=1) as found:
        found.add_worker(there(tmp_path / "other"))
        found.wait_for_workers(2)
        error = done(start_sweep(place / "out", "--steepness", *VALUES, *at(found)), code=1)
    assert "refused" in error and word in error and "tcp://127.0.0.1" in error
    assert "numba" not in error  # it names what differs, and only that
    assert finished(place / "out") == {}


def test_a_scheduler_without_the_workbench_is_refused(tmp_path, place):
    with cluster_of(tmp_path / "cluster", place, workers=1, sources=absent(tmp_path / "other")) as found:
        error = done(start_sweep(place / "out", "--steepness", *VALUES, *at(found)), code=1)
    assert "refused" in error and "the scheduler: No module named" in error


def test_one_that_joins_later_is_refused_too(tmp_path, place):
    """The first worker is kept busy until the other one has been given a run."""
    with cluster_of(tmp_path / "cluster", place, workers=1) as found:
        log = tmp_path / "log"
        process = start_sweep(place / "out", "--steepness", *VALUES, *at(found), log=str(log), sleep_s=600.0)
        until(log.exists, process)
        found.add_worker(changed(tmp_path / "other"))
        error = done(process, code=1)
    assert "refused" in error and "sources of engine" in error


def test_workers_do_not_see_the_folder(cluster, place):
    """What this file rests on; where no process may have a file system of its own, they only are not told of it."""
    if not can_hide():
        pytest.skip("a file system for one process is not permitted here")
    (place / "file").touch()
    from distributed import Client

    with Client(cluster.address) as client:
        assert set(map(tuple, client.run(os.listdir, str(place)).values())) == {()}


def test_a_stopped_worker_keeps_nobody_from_starting(cluster, place):
    """dask asks every worker what it is, and waits for one that is stopped for as long as it is."""
    cluster.workers[0].send_signal(signal.SIGSTOP)
    process = start_sweep(place / "out", "--steepness", *VALUES, *at(cluster))
    try:
        until(lambda: len(finished(place / "out")) >= 2, process)
    finally:
        cluster.workers[0].send_signal(signal.SIGCONT)
    done(process)
    assert [row["status"] for row in rows_of(place / "out")] == ["ok"] * len(VALUES)
