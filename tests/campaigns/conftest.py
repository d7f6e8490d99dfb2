"""A sweep of the fake engine in this process, or in one of its own, with its table."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from campaigns import buoy_sweep
from campaigns.explore.judgement import judgement_of
from campaigns.explore.rows import buoy_row
from campaigns.machinery.store import Store
from engine import Trajectory
from reports import build
from tables import read_rows
from tests.campaigns.fake_engine import FakeEngine
from tests.pages import ROOT

USUAL = ["--periods", "6", "--transient", "2", "--no-report", "--no-accuracy"]
VALUES = [f"{0.01 * number:.2f}" for number in range(1, 13)]  # of a sweep long enough for an accident in its midst


def rows_of(out, table="table.csv"):
    """A table as a list of dicts of strings."""
    return read_rows(Path(out, table))


def ran(campaign, out, *words, **how):
    """The table of a campaign that is run in this process without a report, and that ends well."""
    usual = ["--no-report", "--backend", "threading", "--jobs", "2", "--out", str(out)]
    assert campaign.main([*map(str, words), *usual], **how) == 0
    return rows_of(out)


def order_of(campaign, *words):
    """The order that a campaign reads from words without a fault."""
    order = campaign.read_order([*map(str, words)], faults := [])
    assert faults == []
    return order


def chosen(rows, **wanted):
    """The rows with these entries, of which there are some."""
    chosen_rows = [row for row in rows if {name: str(entry) for name, entry in wanted.items()}.items() <= row.items()]
    assert chosen_rows
    return chosen_rows


def built_twice(folder):
    """The page of a folder and its PDF, which are the same when they are drawn again."""
    files = [path.read_bytes() for path in build(folder)]
    assert [path.read_bytes() for path in build(folder, again=True)] == files
    return files


def statuses(rows):
    """Steepness -> status."""
    return {float(row["steepness"]): row["status"] for row in rows}


def finished(out, files="trajectories/*.nc"):
    """Finished runs: file name -> (inode, time of writing), which a rewritten file cannot keep."""
    return {path.name: (path.stat().st_ino, path.stat().st_mtime_ns) for path in Path(out).glob(files)}


def untimed(rows):
    """Rows without the time that their runs took."""
    return [{**row, "wall_s": ""} for row in rows]


def forget(out):
    """Remove all runs and rows of a folder."""
    for path in (out / "trajectories").iterdir():
        path.unlink()


@pytest.fixture
def sweep(tmp_path):
    """sweep(*options, backend=, jobs=, usual=, kind=, **fields of that kind of FakeEngine).

    Returns exit code, rows, steepness of the runs begun.
    """
    out = tmp_path / "out"

    def run(*options, backend="threading", jobs=2, usual=USUAL, kind=FakeEngine, **fake):
        log = tmp_path / "log"
        log.unlink(missing_ok=True)
        engine = kind(log=str(log), **fake)
        words = [*map(str, options), *usual, "--backend", backend, "--jobs", str(jobs), "--out", str(out)]
        code = buoy_sweep.main(words, simulate=engine)
        return code, rows_of(out), sorted(engine.begun())

    run.out = out
    return run


def until(condition, process, seconds=40.0):
    """Wait for the condition while the process lives."""
    end = time.monotonic() + seconds
    while not condition():
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < end, "nothing happened"
        time.sleep(0.01)


def _hear_interrupts():
    # Whoever starts the tests in the background of a script hands down a Ctrl-C that is ignored.
    signal.signal(signal.SIGINT, signal.SIG_DFL)


class Campaign:
    """The sweep of VALUES as a process of its own, with the log of the runs begun."""

    def __init__(self, place: Path):
        self.out, self.log = place / "out", place / "log"

    def start(self, *options, values=VALUES, session=False, **fake):
        """fake: fields of the FakeEngine; session: in a process group of its own."""
        words = ["--steepness", *values, *USUAL, *options, "--out", str(self.out)]
        return subprocess.Popen(
            [sys.executable, "-m", "tests.campaigns.fake_engine", *words],
            cwd=ROOT,
            env=os.environ | {"FAKE": json.dumps({"log": str(self.log), **fake})},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=session,
            preexec_fn=_hear_interrupts,
        )

    def begin(self, *options, finished=2, **fake):
        """Start it and wait for so many finished runs."""
        process = self.start(*options, sleep_s=0.3, **fake)
        until(lambda: len(self.finished()) >= finished, process)
        return process

    def done(self, process, code=0):
        """Wait for the end of a sweep; returns what it said of its faults, which is no traceback."""
        output, error = process.communicate(timeout=120)
        assert process.returncode == code, output + error
        assert "Traceback" not in error
        return error

    def finished(self):
        return finished(self.out)

    def begun(self):
        """How many runs were begun."""
        return len(self.log.read_text().split())

    def check_all_ok(self):
        assert [row["status"] for row in rows_of(self.out)] == ["ok"] * len(VALUES)

    def sound_part(self):
        """The finished runs of a campaign that was stopped in its midst; each of them can be read, as can the table."""
        earlier = self.finished()
        assert 0 < len(earlier) < len(VALUES)
        for name in earlier:
            Trajectory.load(self.out / "trajectories" / name)
        assert {f"{row['run_key']}.nc" for row in rows_of(self.out)} <= earlier.keys()
        return earlier

    def complete(self, *options):
        """The same command does the rest, and only that."""
        earlier = self.sound_part()
        self.log.unlink(missing_ok=True)
        self.done(self.start(*options))
        assert earlier.items() <= self.finished().items()
        assert self.begun() == len(VALUES) - len(earlier)
        self.check_all_ok()
        assert not list(self.out.rglob(".*.tmp"))


def judged_row(run, transient_periods=None, full=None, orbits=None):
    """The row of a run, judged as in a sweep. orbits: where these are kept, nowhere by default."""
    return buoy_row(run, judgement_of(run, None, orbits or Store(None), transient_periods, full))


@pytest.fixture
def campaign(tmp_path):
    return Campaign(tmp_path)
