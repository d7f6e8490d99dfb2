"""A sweep of the fake engine in this process, or in one of its own, with its table."""

import csv
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from campaigns import buoy_sweep
from tests.campaigns.fake_engine import FakeEngine

ROOT = Path(__file__).parents[2]
USUAL = ["--periods", "6", "--transient", "2", "--no-report", "--no-accuracy"]


def rows_of(out):
    """table.csv as a list of dicts of strings."""
    with open(Path(out) / "table.csv", newline="") as file:
        return list(csv.DictReader(file))


def finished(out):
    """Finished runs: file name -> (inode, time of writing), which a rewritten file cannot keep."""
    return {path.name: (path.stat().st_ino, path.stat().st_mtime_ns) for path in Path(out, "trajectories").glob("*.nc")}


@pytest.fixture
def sweep(tmp_path):
    """sweep(*options, backend=, jobs=, **fields of the FakeEngine) -> exit code, rows, steepness of the runs begun."""
    out = tmp_path / "out"

    def run(*options, backend="threading", jobs=2, **fake):
        log = tmp_path / "log"
        log.unlink(missing_ok=True)
        engine = FakeEngine(log=str(log), **fake)
        words = [*map(str, options), *USUAL, "--backend", backend, "--jobs", str(jobs), "--out", str(out)]
        code = buoy_sweep.main(words, simulate=engine)
        return code, rows_of(out), sorted(engine.begun())

    run.out = out
    return run


def start_sweep(out, *options, session=False, **fake):
    """The sweep as a process of its own; with `session` in a process group of its own."""
    words = [sys.executable, "-m", "tests.campaigns.fake_sweep", *map(str, options), *USUAL, "--out", str(out)]
    return subprocess.Popen(
        words,
        cwd=ROOT,
        env=os.environ | {"FAKE": json.dumps(fake)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=session,
        preexec_fn=_hear_interrupts,
    )


def _hear_interrupts():
    # Whoever starts the tests in the background of a script hands down a Ctrl-C that is ignored.
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def until(condition, process, seconds=40.0):
    """Wait for the condition while the process lives."""
    end = time.monotonic() + seconds
    while not condition():
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < end, "nothing happened"
        time.sleep(0.01)
