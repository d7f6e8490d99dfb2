"""Where runs execute: processes (loky), threads, or a dask cluster, behind one switch.

`opened(...)` gives a function `execute(call, jobs)` that yields `call(job)` for every job as results come. Only results
small enough to be one table row cross between processes. When a worker process dies, `execute` raises `PoolBroken` with
the jobs that may have killed it; the next `execute` starts afresh.

loky and threads run through joblib. dask does not: joblib 1.6 waits for ever when a dask worker is lost (its backend
never hears of futures that end in an error). dask's own futures are used; a lost worker costs only the run it had.
"""

import contextlib
import os
import signal
import threading
import time
import warnings
from collections.abc import Callable, Iterator

from campaigns.machinery.folder import CampaignStopped

_DASK_WAIT_S = 20  # for a scheduler to answer and for its first worker


class PoolBroken(Exception):
    """A worker process died. `suspects`: the unfinished jobs that had been handed out, at least one."""

    def __init__(self, suspects: list, reason: str):
        self.suspects = suspects
        super().__init__(reason)


@contextlib.contextmanager
def opened(backend: str, jobs: int, address: str | None = None) -> Iterator[Callable]:
    """A pool for as long as the `with` lasts.

    backend: "loky", "threading" or "dask"; jobs: runs at the same time; address: of a dask scheduler, None for a local
    cluster. Gives `execute(call, jobs, alone=False)`; with `alone` one job at a time is handed out. Leaving on an
    exception, Ctrl-C included, stops what is running. Raises CampaignStopped where dask cannot be reached.
    """
    if backend == "dask":
        with _dask_client(jobs, address) as client:
            yield lambda call, work, alone=False: _dask_results(client, call, work)
    elif backend == "loky":
        yield lambda call, work, alone=False: _joblib_results("loky", jobs, call, work, alone)
    else:
        yield lambda call, work, alone=False: _joblib_results("threading", jobs, call, work, alone)


def _ignore_interrupt() -> None:
    # Ctrl-C reaches every process of the terminal; only the campaign itself decides what it means.
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _prepare_worker(campaign: int) -> None:
    _ignore_interrupt()
    threading.Thread(target=end_with, args=(campaign,), daemon=True).start()


def end_with(campaign: int) -> None:
    """End this process when its parent has ended."""
    # A killed campaign leaves its workers behind: at work, beside the campaign that is started next, or waiting for
    # five minutes. The system gives an orphan another parent, and that it can see.
    while os.getppid() == campaign:
        time.sleep(0.5)
    os._exit(1)


def _joblib_results(backend: str, jobs: int, call: Callable, work: list, alone: bool) -> Iterator:
    from concurrent.futures.process import BrokenProcessPool

    from joblib import Parallel, delayed, parallel_config

    handed_out = {}

    def hand_out():
        for number, job in enumerate(work):
            handed_out[number] = job
            yield delayed(_numbered)(call, number, job)

    # A loky pool of one would run in this process, and a run that kills its process would kill the campaign:
    # two processes, of which only one is given work, keep that away.
    one = alone or jobs == 1
    options = {"backend": backend, "n_jobs": jobs}
    if backend == "loky":
        options |= {"n_jobs": max(2, jobs), "initializer": _prepare_worker, "initargs": (os.getpid(),)}
    as_they_come = {"return_as": "generator_unordered", "batch_size": 1, "pre_dispatch": 1 if one else "n_jobs"}
    with parallel_config(**options):
        pool = Parallel(**as_they_come, max_nbytes=None)
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message=".*tasks.*", category=UserWarning, module="joblib")
        results = pool(hand_out())
        with contextlib.closing(results):
            try:
                for number, result in results:
                    del handed_out[number]
                    yield result
            except BrokenProcessPool as error:
                raise PoolBroken(list(handed_out.values()), _first_line(error)) from error


def _numbered(call: Callable, number: int, job: object) -> tuple[int, object]:
    return number, call(job)


@contextlib.contextmanager
def _dask_client(jobs: int, address: str | None) -> Iterator:
    import dask
    from distributed import Client, LocalCluster

    local = address is None
    with contextlib.ExitStack() as stack:
        if local:
            # A run whose worker dies is not tried again by dask: the runner does that, one run at a time.
            stack.enter_context(dask.config.set({"distributed.scheduler.allowed-failures": 0}))
            address = stack.enter_context(
                LocalCluster(n_workers=jobs, threads_per_worker=1, dashboard_address=None, silence_logs="CRITICAL")
            )
        try:
            client = stack.enter_context(Client(address, timeout=_DASK_WAIT_S))
            client.wait_for_workers(1, timeout=_DASK_WAIT_S)
            if local:
                client.register_plugin(_deaf_to_interrupts())
        except (OSError, TimeoutError, ValueError) as error:
            raise CampaignStopped(f"no dask cluster at {address}: {_first_line(error)}") from error
        yield client


def _deaf_to_interrupts():
    from distributed import WorkerPlugin

    class DeafToInterrupts(WorkerPlugin):
        """As `_ignore_interrupt`, also for workers that dask starts in place of lost ones."""

        def setup(self, worker):
            _ignore_interrupt()

    return DeafToInterrupts()


def _dask_results(client, call: Callable, work: list) -> Iterator:
    from distributed import as_completed

    futures = {client.submit(call, job, pure=False): job for job in work}
    killed = []
    try:
        for future in as_completed(futures):
            if future.status == "finished":
                yield future.result()
            else:
                killed.append((futures[future], future.exception()))
            future.release()
    finally:
        client.cancel([future for future in futures if not future.done()])
    if killed:
        raise PoolBroken([job for job, _ in killed], _first_line(killed[0][1]))


def _first_line(error: BaseException | None) -> str:
    return str(error).strip().split("\n")[0] or type(error).__name__
