"""A dask cluster of processes that share only the machine with the test, and cannot see the campaign's folder."""

import contextlib
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import psutil

ROOT = Path(__file__).parents[2]
SECONDS = 60.0  # for a process to start: a loaded machine of two cores needs ten


def can_hide() -> bool:
    """Whether a process may be given a file system of its own here."""
    words = ["unshare", "-rm", "mount", "-t", "tmpfs", "none", "/mnt"]
    return bool(shutil.which("unshare")) and subprocess.run(words, capture_output=True).returncode == 0


class Cluster:
    """A scheduler and its workers.

    place: folder of theirs; hidden: folder that the workers shall not see; sources: PYTHONPATH of the scheduler; words:
    its command, which says its port, in place of our own.
    """

    def __init__(self, place: Path, hidden: Path, sources: Path = ROOT, words: list[str] | None = None):
        self.place, self.hidden, self.workers = place, hidden, []
        place.mkdir()
        file = place / "scheduler.json"
        own = [sys.executable, "-m", "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0"]
        words = [*(words or own), "--no-dashboard", "--scheduler-file", str(file)]
        self.scheduler = self._start("scheduler", words, sources)
        self._wait(lambda: file.exists() and file.read_text().rstrip().endswith("}"), self.scheduler)
        self.address = json.loads(file.read_text())["address"]

    def add_worker(self, sources: Path = ROOT, words: list[str] | None = None):
        """Start a worker of one thread with this PYTHONPATH, or by this command; returns its process, not waiting."""
        own = [sys.executable, "-m", "distributed.cli.dask_worker", self.address, "--nthreads", "1", "--no-nanny"]
        words = [*(words or own), "--no-dashboard"]
        if can_hide():
            words = ["unshare", "-rm", "sh", "-c", 'mount -t tmpfs none "$0" && exec "$@"', str(self.hidden), *words]
        worker = self._start(f"worker-{len(self.workers)}", words, sources)
        self.workers.append(worker)
        return worker

    def wait_for_workers(self, count: int) -> None:
        """Wait until so many are there."""
        from distributed import Client

        with Client(self.address) as client:
            client.wait_for_workers(count, timeout=SECONDS)

    def bring_machine_code(self, *folders: Path) -> None:
        """Lay copies of folders of machine code into the cache of the worker that is started next."""
        for folder in folders:
            shutil.copytree(folder, self.place / f"worker-{len(self.workers)}" / "cache" / folder.name)

    def caches(self) -> list[dict[str, int]]:
        """Files of machine code of each worker, with the time they were written."""
        folders = [self.place / f"worker-{number}" / "cache" for number in range(len(self.workers))]
        return [{path.name: path.stat().st_mtime_ns for path in folder.rglob("*.nb?")} for folder in folders]

    def end(self) -> None:
        """End what is left of it."""
        for process in (*self.workers, self.scheduler):
            for one in (*_children(process), process):
                with contextlib.suppress(psutil.NoSuchProcess):
                    one.kill()
            process.wait()

    def _start(self, name: str, words: list[str], sources: Path):
        home = self.place / name
        home.mkdir(exist_ok=True)
        env = {**os.environ, "PYTHONPATH": str(sources), "HOME": str(home), "TMPDIR": str(home)}
        env |= {"TETHER_CACHE_DIR": str(home / "cache"), "XDG_CACHE_HOME": str(home / "xdg")}
        with open(home / "log", "w") as log:
            return subprocess.Popen(words, cwd=home, env=env, stdout=log, stderr=log, stdin=subprocess.DEVNULL)

    def _wait(self, condition, process) -> None:
        end = time.monotonic() + SECONDS
        while not condition():
            assert process.poll() is None and time.monotonic() < end, "the scheduler did not start"
            time.sleep(0.05)


def _children(process) -> list:
    try:
        return psutil.Process(process.pid).children(recursive=True)
    except psutil.NoSuchProcess:
        return []


@contextlib.contextmanager
def cluster_of(place: Path, hidden: Path, workers: int = 2, sources: Path = ROOT):
    """A cluster whose workers are there, for as long as the `with` lasts. sources: PYTHONPATH of the scheduler."""
    hidden.mkdir(parents=True, exist_ok=True)
    found = Cluster(place, hidden, sources)
    try:
        for _ in range(workers):
            found.add_worker()
        found.wait_for_workers(workers)
        yield found
    finally:
        found.end()
