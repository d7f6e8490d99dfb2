"""A full disk stops the campaign with one line; finished runs stay, and with room the same command goes on."""

import shutil
import subprocess

import pytest

from engine import Trajectory
from tests.campaigns.conftest import finished, rows_of, start_sweep

VALUES = [f"{0.01 * number:.2f}" for number in range(1, 13)]


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


def run(out, **fake):
    process = start_sweep(out, "--steepness", *VALUES, **fake)
    _, error = process.communicate(timeout=60)
    assert "Traceback" not in error
    return process.returncode, error


@pytest.mark.slow
def test_small_disk(small_disk):
    out = small_disk / "out"
    code, error = run(out)
    assert code == 1
    assert "is full" in error
    before = finished(out)
    assert 0 < len(before) < len(VALUES)
    for name in before:
        Trajectory.load(out / "trajectories" / name)
    rows_of(out)
    assert not list(out.rglob(".*.tmp"))
    subprocess.run(["mount", "-o", "remount,size=8m", str(small_disk)], check=True)
    assert run(out)[0] == 0
    assert before.items() <= finished(out).items()
    assert [row["status"] for row in rows_of(out)] == ["ok"] * len(VALUES)


def test_disk_full_from_the_start(small_disk):
    with open(small_disk / "filling", "wb", buffering=0) as file, pytest.raises(OSError):
        while True:
            file.write(bytes(4096))
    code, error = run(small_disk / "out")
    assert code == 1
    assert "is full" in error


def test_no_space_within_a_run_stops_the_campaign(sweep, capfd):
    code, rows, _ = sweep("--steepness", *VALUES, no_space=(0.06,), jobs=1)
    assert code == 1
    assert [row["status"] for row in rows] == ["ok"] * 5
    error = capfd.readouterr().err
    assert "is full" in error
    assert "Traceback" not in error
    assert len(sweep("--steepness", *VALUES)[2]) == len(VALUES) - 5


def test_table_that_does_not_fit_leaves_the_old_one(sweep, monkeypatch):
    _, rows, _ = sweep("--steepness", "0.01", "0.02")

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("campaigns.machinery.folder.write_atomic", full)
    code, left, _ = sweep("--steepness", *VALUES)
    assert (code, left) == (1, rows)
