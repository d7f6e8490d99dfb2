"""Where runs execute: processes (loky), threads, or a dask cluster, behind one switch.

`opened(...)` gives a function `execute(call, tasks)` that yields (task, call(task)) for every task as results come.
When a worker process dies, `execute` raises `PoolBroken` with the tasks that may have killed it; the next `execute`
starts afresh. loky and threads run through joblib. dask runs through its own futures, not joblib's backend for dask,
which waits for ever when a worker is lost (joblib 1.6).

The workers of a dask cluster may be on other machines that see no folder of ours. docs/developing.md says what may
go wrong there, and what becomes of it. A cluster that is lost, or is of another version, is CampaignStopped, one line:
finished runs are on disk, and the same command goes on.
"""

import contextlib
import logging
import os
import platform
import signal
import sys
import threading
import time
import warnings
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError
from functools import cache, partial
from importlib import metadata

from campaigns.machinery.folder import CampaignStopped, made_by

JOIN_S = 30.0  # for the scheduler to answer, and then for its first worker
ASK_S = 10.0  # for all workers to say what they are
GONE_S = 120.0  # without any worker in the midst of a campaign
LOOK_S = 2.0  # between two looks at the workers that are there
_NUMBERS = ("numpy", "scipy", "numba", "llvmlite")  # a worker with another version would give other last digits
_PARTS = ("machine_code", "engine", "analysis", "campaigns", "reports", "tables")
_GO_ON = "finished runs are kept; mend the cluster and run the same command again"
_REFUSED = "refused, not the same version as here: {}; install there what is installed here, and start it again"


class PoolBroken(Exception):
    """A worker process died. `suspects`: the unfinished tasks that had been handed out, at least one."""

    def __init__(self, suspects: list, reason: str):
        self.suspects = suspects
        super().__init__(reason)


@contextlib.contextmanager
def opened(backend: str, jobs: int, address: str | None = None) -> Iterator[Callable]:
    """A pool for as long as the `with` lasts.

    backend: "loky", "threading" or "dask"; jobs: runs at the same time; address: of a dask scheduler, None for a local
    cluster. Gives `execute(call, tasks, alone=False)`; with `alone` one task at a time is handed out. Leaving on an
    exception, Ctrl-C included, stops what is running, but for what runs on the workers of somebody else's cluster: that
    ends with the run at hand. Raises CampaignStopped where a cluster cannot be reached, is lost, or has other sources.
    """
    if backend == "dask":
        with dask_client(jobs, address) as client:
            yield partial(_dask_results, client)
    else:
        yield partial(_joblib_results, backend, jobs)


def _joblib_results(backend: str, jobs: int, call: Callable, tasks: list, alone: bool = False) -> Iterator:
    from concurrent.futures.process import BrokenProcessPool

    from joblib import Parallel, delayed, parallel_config

    handed_out = {}

    def hand_out():
        for number, task in enumerate(tasks):
            handed_out[number] = task
            yield delayed(_numbered)(call, number, task)

    options = {"backend": backend, "n_jobs": jobs}
    if backend == "loky":
        # A loky pool of one would run in this process, and a run that kills its process would kill the campaign:
        # two processes, of which only one is given work, keep that away.
        options |= {"n_jobs": max(2, jobs), "initializer": _prepare_worker, "initargs": (os.getpid(),)}
    as_they_come = {"return_as": "generator_unordered", "batch_size": 1, "max_nbytes": None}
    with parallel_config(**options):
        pool = Parallel(**as_they_come, pre_dispatch=1 if alone or jobs == 1 else "n_jobs")
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message=".*tasks.*", category=UserWarning, module="joblib")
        with contextlib.closing(pool(hand_out())) as results:
            try:
                for number, result in results:
                    yield handed_out.pop(number), result
            except BrokenProcessPool as error:
                raise PoolBroken(list(handed_out.values()), first_line(error)) from error


def _numbered(call: Callable, number: int, task: object) -> tuple[int, object]:
    return number, call(task)


def _prepare_worker(campaign: int) -> None:
    dask_setup()
    threading.Thread(target=end_with, args=(campaign,), daemon=True).start()


def dask_setup(worker: object = None) -> None:
    """Let this process be deaf to Ctrl-C. dask calls it by this name in workers of a local cluster, new ones too."""
    # Ctrl-C reaches every process of the terminal; only the campaign itself decides what it means.
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def end_with(campaign: int) -> None:
    """End this process when its parent has ended; campaign: process id of the parent."""
    # A killed campaign leaves its workers behind: at work, beside the campaign that is started next, or waiting for
    # five minutes. The system gives an orphan another parent, and that it can see.
    while os.getppid() == campaign:
        time.sleep(0.5)
    os._exit(1)


def first_line(error: BaseException | None) -> str:
    """An exception in one line."""
    return str(error).strip().split("\n")[0] or type(error).__name__


@contextlib.contextmanager
def dask_client(jobs: int, address: str | None) -> Iterator:
    """A client of the scheduler at `address`, or of a local cluster of `jobs` processes (None).

    Raises CampaignStopped where no scheduler answers, no worker joins, or scheduler or workers have another version.
    """
    import dask
    from distributed import Client, LocalCluster

    with contextlib.ExitStack() as stack:
        if address is None:
            # A run whose worker dies is not tried again by dask: the runner does that, one run at a time.
            stack.enter_context(dask.config.set({"distributed.scheduler.allowed-failures": 0}))
            own = {"n_workers": jobs, "threads_per_worker": 1, "dashboard_address": None, "silence_logs": "CRITICAL"}
            own["preload"] = __name__  # see `dask_setup`
            address = stack.enter_context(LocalCluster(**own))
        # A lost connection ends the campaign in one line of its own; dask adds a page, from threads of its own.
        stack.callback(logging.disable, logging.root.manager.disable)
        logging.disable(logging.CRITICAL)
        try:
            found = stack.enter_context(Client(address, timeout=JOIN_S))
        except (OSError, TimeoutError, TypeError, ValueError) as error:  # TypeError: tls:// without certificates
            raise CampaignStopped(f"no dask cluster at {address}: {first_line(error)}") from error
        try:
            found.wait_for_workers(1, timeout=JOIN_S)
            found.run_on_scheduler(facts)  # it computes nothing, but dask unpacks there what it hands on
        except TimeoutError:
            start = f"start one: dask worker {address} --nthreads 1"
            raise CampaignStopped(f"the scheduler at {address} has no worker after {JOIN_S:g} s; {start}") from None
        except ImportError as error:
            raise CampaignStopped(_REFUSED.format(f"the scheduler: {first_line(error)}")) from error
        if faults := "; ".join(_differences(found)):
            raise CampaignStopped(_REFUSED.format(faults))
        yield found


@cache
def facts() -> dict[str, str]:
    """What decides the numbers that this process computes: versions, and a hash of the sources of each package."""
    versions = {name: metadata.version(name) for name in _NUMBERS}
    sources = {f"sources of {part}": made_by({}, part)[:12] for part in _PARTS}
    return {"Python": ".".join(platform.python_version_tuple()[:2])} | versions | sources


def _differences(found) -> Iterator[str]:
    """What sets workers apart from this process, as far as they say so within ASK_S."""
    said: dict[str, object] = {}

    def ask() -> None:
        with contextlib.suppress(Exception):
            said.update(found.run(facts, on_error="return"))

    # dask waits for a worker that is stopped as long as it stays so; who does not answer is asked with its first run.
    asking = threading.Thread(target=ask, daemon=True)
    asking.start()
    asking.join(ASK_S)
    for worker, there in list(said.items()):
        if isinstance(there, OSError):
            continue  # it has just gone; whoever comes in its place is asked with its first run
        if off := first_line(there) if isinstance(there, Exception) else _difference(there, facts()):
            yield f"{worker}: {off}"


def _difference(there: dict[str, str], here: dict[str, str]) -> str:
    off = [f"{name} {there.get(name, 'none')} (here: {here[name]})" for name in here if there.get(name) != here[name]]
    return ", ".join(off)


def _dask_results(found, call: Callable, tasks: list, alone: bool = False) -> Iterator:
    """(task, call(task)) as results come. Raises PoolBroken with the tasks that dask gave up, CampaignStopped."""
    from distributed import KilledWorker

    ask = partial(_asked, call, facts())
    futures = {found.submit(ask, task, pure=False): task for task in tasks}
    left, killed = set(futures), {}
    try:
        while left:
            for future in _done(found, left):
                left.discard(future)
                try:
                    result = future.result()
                except KilledWorker as error:
                    killed[future] = error
                    continue
                future.release()
                yield futures[future], result
    except CampaignStopped:
        raise
    except Exception as error:
        raise CampaignStopped(_said(error)) from error
    finally:
        with contextlib.suppress(Exception):  # of a scheduler that is gone: there is nothing to cancel
            found.cancel(list(left))
    if killed:
        raise PoolBroken([futures[future] for future in killed], first_line(killed.popitem()[1]))


def _asked(call: Callable, here: dict[str, str], task: object) -> object:
    """Runs in the worker; one that joined late has not been asked before."""
    if off := _difference(facts(), here):
        from distributed import get_worker

        raise CampaignStopped(_REFUSED.format(f"{get_worker().address}: {off}"))
    return call(task)


def _done(found, left: set) -> set:
    """The futures that have ended, however long it takes, while there is somebody who could be at them."""
    from distributed import wait

    alone_s, said = 0.0, False
    while alone_s <= GONE_S:
        with contextlib.suppress(TimeoutError):
            return wait(left, timeout=LOOK_S, return_when="FIRST_COMPLETED").done
        alone_s = 0.0 if found.nthreads() else alone_s + LOOK_S
        if alone_s > 0.1 * GONE_S and not said:
            print(f"\nthe dask cluster has no worker; waiting {GONE_S:g} s for one to join", file=sys.stderr)
            said = True
    raise CampaignStopped(f"the dask cluster has had no worker for {GONE_S:g} s; {_GO_ON}")


def _said(error: Exception) -> str:
    """Why a cluster cannot go on, in a line."""
    if isinstance(error, ImportError):
        return _REFUSED.format(first_line(error))
    if isinstance(error, CancelledError | OSError):
        return f"the dask scheduler has ended or dropped the runs ({first_line(error)}); {_GO_ON}"
    return f"a worker cannot do its part: {type(error).__name__}: {first_line(error)}; {_GO_ON}"
