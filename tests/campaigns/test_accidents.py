"""An accident costs what was running and nothing else: a run that fails is a row with its reason; a campaign that is
killed, interrupted or out of disk leaves a readable folder, and the same command completes the rest and only that.
"""

import os
import shutil
import signal
import subprocess
import time

import psutil
import pytest

from tests.campaigns.conftest import (
    VALUES,
    check_and_complete,
    done,
    finished,
    rows_of,
    sound_part,
    start_sweep,
    statuses,
    until,
)

FEW = (0.02, 0.03, 0.05, 0.08, 0.13)
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
        ("threading", 2, {"raises": FEW}, "error", "ZeroDivisionError"),
        ("loky", 2, {"dies": (0.05,)}, "worker-died", "running alone"),
        ("loky", 2, {"dies": (0.02, 0.08)}, "worker-died", "running alone"),
        ("loky", 2, {"dies_once": (0.05,)}, "ok", ""),
        pytest.param("loky", 1, {"dies": (0.05,)}, "worker-died", "running alone", marks=SLOW),
        pytest.param("dask", 2, {"dies": (0.05,)}, "worker-died", "running alone", marks=SLOW),
    ],
)
def test_a_run_that_fails_is_a_row_and_the_others_are_what_they_would_have_been(
    sweep, backend, jobs, fake, status, word
):
    if backend == "dask":
        pytest.importorskip("distributed")
    ((how, failing),) = fake.items()
    code, rows, begun = sweep("--steepness", *FEW, backend=backend, jobs=jobs, **fake)
    assert code == 0
    assert statuses(rows) == dict.fromkeys(FEW, "ok") | dict.fromkeys(failing, status)
    assert all(word in row["message"] for row in rows if row["status"] != "ok")
    # once more alone, where it may have killed its process: no run kills more than two
    assert max(begun.count(value) for value in failing) == (2 if how.startswith("dies") else 1)


def test_a_run_that_ended_early_keeps_its_record_and_is_not_tried_again(sweep):
    _, rows, _ = sweep("--steepness", *FEW, breaks=(0.05,))
    assert f"{rows[2]['run_key']}.nc" in finished(sweep.out)
    assert rows[2]["steps"] == "7"
    assert rows[2]["radius_max_m"] == ""
    assert sweep("--steepness", *FEW, breaks=(0.05,))[2] == []


def test_an_analysis_that_fails_is_a_row_and_the_record_is_kept(sweep, monkeypatch):
    def broken(*_):
        raise FloatingPointError("no such thing")

    monkeypatch.setattr("campaigns.buoy_sweep.rows.settled", broken)
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
def test_kill_9_of_the_campaign(tmp_path):
    out, log = tmp_path / "out", tmp_path / "log"
    process = start_sweep(out, "--steepness", *VALUES, log=str(log), sleep_s=0.3)
    until(lambda: len(finished(out)) >= 3, process)
    workers = psutil.Process(process.pid).children(recursive=True)
    process.kill()
    process.communicate()
    assert psutil.wait_procs(workers, timeout=20)[1] == []  # none computes on for nobody
    (out / "trajectories" / ".half-written.nc.tmp").write_bytes(b"CDF")  # what a kill within a write leaves
    check_and_complete(out, log)


@pytest.mark.slow
@pytest.mark.parametrize("backend", ["loky", "threading", "dask"])
def test_interrupt(tmp_path, backend):
    if backend == "dask":
        pytest.importorskip("distributed")
    out, log = tmp_path / "out", tmp_path / "log"
    process = start_sweep(out, "--steepness", *VALUES, "--backend", backend, session=True, log=str(log), sleep_s=0.3)
    until(lambda: len(finished(out)) >= 3, process)
    os.killpg(process.pid, signal.SIGINT)  # a terminal sends it to every process of the campaign
    error = done(process, code=130)
    assert "to go on with the rest: python -m campaigns.buoy_sweep --steepness 0.01" in error
    assert len(rows_of(out)) > 0
    begun = len(log.read_text().split())
    time.sleep(0.7)
    assert len(log.read_text().split()) == begun
    check_and_complete(out, log)


@pytest.mark.slow
def test_a_second_campaign_in_the_folder_is_turned_away(tmp_path):
    out = tmp_path / "out"
    first = start_sweep(out, "--steepness", "0.01", "0.02", "0.03", "0.04", sleep_s=1.0)
    until(lambda: (out / "table.csv").exists(), first)
    assert f"in use by process {first.pid}" in done(start_sweep(out, "--steepness", "0.05"), code=1)
    assert "0.05" not in (out / "provenance.json").read_text()
    done(first)
    assert len(finished(out)) == 4


@pytest.fixture
def small_disk(tmp_path):
    """A disk with room for some of the runs."""
    place = tmp_path / "disk"
    place.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=512k", "tmpfs", str(place)]
    if not shutil.which("mount") or subprocess.run(mount, capture_output=True).returncode != 0:
        pytest.skip("mounting a small disk is not permitted here")
    yield place
    subprocess.run(["umount", str(place)], check=True)


@pytest.mark.slow
def test_a_disk_that_fills_up(small_disk, tmp_path):
    out, log = small_disk / "out", tmp_path / "log"
    assert "is full" in done(start_sweep(out, "--steepness", *VALUES, log=str(log)), code=1)
    assert sound_part(out) and not list(out.rglob(".*.tmp"))
    subprocess.run(["mount", "-o", "remount,size=8m", str(small_disk)], check=True)
    check_and_complete(out, log)


def test_a_disk_that_is_full_from_the_start(small_disk):
    with open(small_disk / "filling", "wb", buffering=0) as file, pytest.raises(OSError):
        while True:
            file.write(bytes(4096))
    assert "is full" in done(start_sweep(small_disk / "out", "--steepness", *VALUES), code=1)


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
    code, left, _ = sweep("--steepness", *VALUES)
    assert (code, left) == (1, rows)
