"""A dask cluster of processes that share only the machine with the test, and cannot see the campaign's folder."""

import contextlib
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).parents[2]
SECONDS = 60.0  # for a process to start: a loaded machine of two cores needs ten


def can_hide() -> bool:
    """Whether a process may be given a file system of its own here."""
    words = ["unshare", "-rm", "mount", "-t", "tmpfs", "none", "/mnt"]
    return bool(shutil.which("unshare")) and subprocess.run(words, capture_output=True).returncode == 0


class Cluster:
    """A scheduler and its workers. place: folder of theirs; hidden: folder that the workers shall not see."""

    def __init__(self, place: Path, hidden: Path, sources: Path):
        self.place, self.hidden, self.workers = place, hidden, []
        place.mkdir()
        file = place / "scheduler.json"
        words = ["distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard"]
        words = [sys.executable, "-m", *words, "--scheduler-file", str(file)]
        self.scheduler = self._start("scheduler", words, sources)
        self._wait(file.exists, self.scheduler)
        self.address = json.loads(file.read_text())["address"]

    def add_worker(self, sources: Path = ROOT):
        """Start a worker of one thread with this PYTHONPATH; returns its process without waiting for it."""
        words = [sys.executable, "-m", "distributed.cli.dask_worker", self.address, "--nthreads", "1"]
        words += ["--no-dashboard", "--no-nanny"]
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

    def caches(self) -> list[set[str]]:
        """Names of the files of machine code of each worker."""
        folders = [self.place / f"worker-{number}" / "cache" for number in range(len(self.workers))]
        return [{path.name for path in folder.rglob("*.nb?")} for folder in folders]

    def end(self) -> None:
        """End what is left of it."""
        for process in (*self.workers, self.scheduler):
            process.kill()
            process.wait()

    def _start(self, name: str, words: list[str], sources: Path):
        home = self.place / name
        home.mkdir()
        env = {**os.environ, "PYTHONPATH": str(sources), "HOME": str(home), "TMPDIR": str(home)}
        env |= {"TETHER_CACHE_DIR": str(home / "cache"), "XDG_CACHE_HOME": str(home / "xdg")}
        with open(home / "log", "w") as log:
            return subprocess.Popen(words, cwd=home, env=env, stdout=log, stderr=log, stdin=subprocess.DEVNULL)

    def _wait(self, condition, process) -> None:
        end = time.monotonic() + SECONDS
        while not condition():
            assert process.poll() is None and time.monotonic() < end, "the scheduler did not start"
            time.sleep(0.05)


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
