"""Where runs execute: processes (loky), threads, or a dask cluster, behind one switch.

`opened(...)` gives a function `execute(call, jobs)` that yields `call(job)` for every job as results come. Only results
small enough to be one table row cross between processes. When a worker process dies, `execute` raises `PoolBroken` with
the jobs that may have killed it; the next `execute` starts afresh.

loky and threads run through joblib; dask does not (`campaigns.machinery.cluster`).
"""

import contextlib
import os
import threading
import warnings
from collections.abc import Callable, Iterator

from campaigns.machinery import cluster
from campaigns.machinery.processes import PoolBroken, end_with, first_line, ignore_interrupt


@contextlib.contextmanager
def opened(backend: str, jobs: int, address: str | None = None) -> Iterator[Callable]:
    """A pool for as long as the `with` lasts.

    backend: "loky", "threading" or "dask"; jobs: runs at the same time; address: of a dask scheduler, None for a local
    cluster. Gives `execute(call, jobs, alone=False)`; with `alone` one job at a time is handed out. Leaving on an
    exception, Ctrl-C included, stops what is running, but for what runs on the workers of somebody else's cluster: that
    ends with the run at hand. Raises CampaignStopped where a cluster cannot be reached, is lost, or has other sources.
    """
    if backend == "dask":
        with cluster.client(jobs, address) as client:
            yield lambda call, work, alone=False: cluster.results(client, call, work)
    elif backend == "loky":
        yield lambda call, work, alone=False: _joblib_results("loky", jobs, call, work, alone)
    else:
        yield lambda call, work, alone=False: _joblib_results("threading", jobs, call, work, alone)


def _prepare_worker(campaign: int) -> None:
    ignore_interrupt()
    threading.Thread(target=end_with, args=(campaign,), daemon=True).start()


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
                raise PoolBroken(list(handed_out.values()), first_line(error)) from error


def _numbered(call: Callable, number: int, job: object) -> tuple[int, object]:
    return number, call(job)
