"""What stands around a command does not break it: a terminal without some letters, a reader that leaves, a switch of
Numba, what a killed command left behind."""

import os
import signal
import subprocess
import sys
import tempfile

import pytest

from campaigns.machinery.folder import PROGRESS, claimed
from tests.campaigns.conftest import sweep
from tests.pages import ROOT
from tests.processes import python

__all__ = ["sweep"]  # a fixture
ODD = "été 浮标 Ω"


@pytest.mark.parametrize(
    "command",
    [
        ["campaigns", ODD],
        ["campaigns.sweep", "--scene", ODD, "--vary", ODD, "0", "1", "2"],
        ["engine", ODD],
        ["analysis", ODD],
        ["reports", ODD],
    ],
    ids=lambda command: command[0],
)
def test_a_refusal_is_printed_whatever_letters_it_holds(command):
    process = python("-m", *command, PYTHONIOENCODING="ascii")
    assert process.returncode == 2 and "Traceback" not in process.stderr
    assert ascii(ODD[-1])[1:-1] in process.stderr


@pytest.mark.parametrize("command", ["campaigns", "engine"])
def test_a_reader_that_leaves_is_no_fault(command):
    read, write = os.pipe()
    os.close(read)
    variables = os.environ | {"PYTHONPATH": str(ROOT)}
    process = subprocess.run(
        [sys.executable, "-m", command], stdout=write, stderr=subprocess.PIPE, env=variables, cwd=ROOT
    )
    os.close(write)
    assert (process.returncode, process.stderr) == (0, b"")


@pytest.mark.parametrize("first", ["", "import numba; "])
def test_numba_compiles_though_it_is_told_not_to(first):
    code = f"{first}import machine_code, numba; print(type(numba.njit(lambda x: x)).__name__)"
    process = python("-c", code, NUMBA_DISABLE_JIT="1")
    assert process.stdout.split() == ["CPUDispatcher"] and "NUMBA_DISABLE_JIT is ignored, because" in process.stderr
    assert python("-c", code, NUMBA_DISABLE_JIT="0").stderr == ""


def test_a_campaign_leaves_nothing_in_the_temporary_folder(sweep, monkeypatch, tmp_path):
    """Not while it runs either, because then it may be killed."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "nowhere"))
    code, rows, _ = sweep("--steepness", "0.02", "0.05")
    assert code == 0 and len(rows) == 2 and not list(tmp_path.glob(f"out/{PROGRESS}*"))


def test_what_a_killed_campaign_left_of_its_progress_goes_with_the_next_one(tmp_path):
    code = (
        "import os, signal, tempfile; from pathlib import Path; import campaigns.machinery.folder as folder\n"
        f"with folder.claimed(Path({str(tmp_path)!r})):\n"
        f"    Path(tempfile.mkdtemp(prefix=folder.PROGRESS, dir={str(tmp_path)!r}), 'task').write_text('0.5')\n"
        "    os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    assert python("-c", code).returncode == -signal.SIGKILL
    assert list(tmp_path.glob(f"{PROGRESS}*/task"))
    with claimed(tmp_path):
        assert not list(tmp_path.glob(f"{PROGRESS}*"))
