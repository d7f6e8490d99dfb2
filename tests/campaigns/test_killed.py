"""kill -9 and Ctrl-C in mid-sweep leave a readable folder; the same command completes the rest and only that.

Two campaigns never write into one folder at the same time, and a dead one does not keep the folder.
"""

import os
import signal
import time

import psutil
import pytest

from campaigns.machinery.folder import claimed
from engine import Trajectory
from tests.campaigns.conftest import finished, rows_of, start_sweep, until

VALUES = [f"{0.01 * number:.2f}" for number in range(1, 13)]


def check_and_complete(out, log):
    before = finished(out)
    assert 0 < len(before) < len(VALUES)
    for name in before:
        Trajectory.load(out / "trajectories" / name)
    assert {f"{row['run_key']}.nc" for row in rows_of(out)} <= before.keys()
    log.unlink()
    process = start_sweep(out, "--steepness", *VALUES, log=str(log))
    output = process.communicate()
    assert process.returncode == 0, output
    after = finished(out)
    assert before.items() <= after.items()
    assert len(log.read_text().split()) == len(VALUES) - len(before)
    assert [row["status"] for row in rows_of(out)] == ["ok"] * len(VALUES)
    assert not list(out.rglob(".*.tmp"))


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
    _, error = process.communicate(timeout=30)
    assert process.returncode == 130, error
    assert "Traceback" not in error
    assert "to go on with the rest: python -m campaigns.buoy_sweep --steepness 0.01" in error
    assert len(rows_of(out)) > 0
    begun = len(log.read_text().split())
    time.sleep(0.7)
    assert len(log.read_text().split()) == begun
    check_and_complete(out, log)


def test_second_campaign_in_the_folder_is_turned_away(tmp_path):
    out = tmp_path / "out"
    first = start_sweep(out, "--steepness", "0.01", "0.02", "0.03", "0.04", sleep_s=1.0)
    until(lambda: (out / "table.csv").exists(), first)
    second = start_sweep(out, "--steepness", "0.05")
    _, error = second.communicate(timeout=60)
    assert second.returncode == 1
    assert f"in use by process {first.pid}" in error
    assert "0.05" not in (out / "provenance.json").read_text()
    output = first.communicate(timeout=60)
    assert first.returncode == 0, output
    assert len(finished(out)) == 4


def test_lock_dies_with_its_holder(tmp_path):
    first = start_sweep(tmp_path, "--steepness", "0.01", "0.02", "0.03", sleep_s=1.0)
    until(lambda: (tmp_path / "table.csv").exists(), first)
    first.kill()
    first.communicate()
    with claimed(tmp_path):
        pass
