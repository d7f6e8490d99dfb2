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
import operator
import os
import platform
import signal
import sys
import threading
import time
import warnings
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import CancelledError
from functools import cache, partial

from campaigns.machinery.folder import PACKAGES, CampaignStopped, made_by

JOIN_S = 30.0  # for the scheduler to answer, and then for its first worker
ASK_S = 10.0  # for all workers to say what they are
GONE_S = 120.0  # without any worker in the midst of a campaign
GROWTH_BYTES = 2e9  # of a worker, after which loky takes another one
LOOK_S = 2.0  # between two looks at the workers that are there
_NUMBERS = ("numpy", "scipy", "numba", "llvmlite")  # a worker with another version would give other last digits
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
    cluster. Gives `execute(call, tasks, alone=False, spare=[])`; with `alone` one task at a time is handed out. spare:
    functions that workers call, and take off the list, while they would wait for the last tasks; a dask cluster leaves
    them. Leaving on an exception, Ctrl-C included, stops what is running, but for what runs on the workers of somebody
    else's cluster: that ends with the run at hand. Raises CampaignStopped where a cluster cannot be reached, is lost,
    or has other sources.
    """
    if backend == "dask":
        with dask_client(jobs, address) as client:
            yield partial(_dask_results, client)
    else:
        yield partial(_joblib_results, backend, jobs)


def _joblib_results(
    backend: str, jobs: int, call: Callable, tasks: list, alone: bool = False, spare: Sequence[Callable] = ()
) -> Iterator:
    from concurrent.futures.process import BrokenProcessPool

    from joblib import Parallel, delayed, parallel_config

    handed_out = {}

    def hand_out():
        for number, task in enumerate(tasks):
            handed_out[number] = task
            yield delayed(_numbered)(call, number, task)
        while spare and handed_out:
            yield delayed(_numbered)(operator.call, -1, spare.pop(0))

    options = {"backend": backend, "n_jobs": jobs}
    if backend == "loky":
        # A loky pool of one would run in this process, and a run that kills its process would kill the campaign:
        # two processes, of which only one is given work, keep that away.
        options |= {"n_jobs": max(2, jobs), "initializer": _prepare_worker, "initargs": (os.getpid(),)}
    as_they_come = {"return_as": "generator_unordered", "batch_size": 1, "max_nbytes": None, "pre_dispatch": "n_jobs"}
    if alone or jobs == 1:
        as_they_come["pre_dispatch"] = 1
    with parallel_config(**options):
        pool = Parallel(**as_they_come)
    with warnings.catch_warnings():
        # loky warns where a worker had nothing to do for a while, and takes it for a lack of memory
        for words in (".*tasks.*", "A worker stopped while some jobs.*"):
            warnings.filterwarnings("ignore", message=words, category=UserWarning, module="joblib")
        with contextlib.closing(pool(hand_out())) as results:
            try:
                for number, result in results:
                    if number in handed_out:
                        yield handed_out.pop(number), result
            except BrokenProcessPool as error:
                raise PoolBroken(list(handed_out.values()), first_line(error)) from error


def _numbered(call: Callable, number: int, task: object) -> tuple[int, object]:
    return number, call(task)


def _prepare_worker(campaign: int) -> None:
    from joblib.externals.loky import process_executor

    dask_setup()
    # Kernels and libraries that a worker loads as it needs them are 0.4 GB. loky takes 0.3 GB for a leak, and a new
    # worker, which loads them again, costs two seconds.
    process_executor._MAX_MEMORY_LEAK_SIZE = GROWTH_BYTES
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
            cluster = LocalCluster(
                n_workers=jobs,
                threads_per_worker=1,
                dashboard_address=None,
                silence_logs="CRITICAL",
                preload=__name__,  # see `dask_setup`
            )
            address = stack.enter_context(cluster)
        # A lost connection ends the campaign in one line of its own; dask adds a page, from threads of its own.
        stack.callback(logging.disable, logging.root.manager.disable)
        logging.disable(logging.CRITICAL)
        try:
            client = stack.enter_context(Client(address, timeout=JOIN_S))
        except (OSError, TimeoutError, TypeError, ValueError) as error:  # TypeError: tls:// without certificates
            raise CampaignStopped(f"no dask cluster at {address}: {first_line(error)}") from error
        try:
            client.wait_for_workers(1, timeout=JOIN_S)
            client.run_on_scheduler(facts)  # it computes nothing, but dask unpacks there what it hands on
        except TimeoutError:
            start = f"start one: dask worker {address} --nthreads 1"
            raise CampaignStopped(f"the scheduler at {address} has no worker after {JOIN_S:g} s; {start}") from None
        except ImportError as error:
            raise CampaignStopped(_REFUSED.format(f"the scheduler: {first_line(error)}")) from error
        differences = list(_differences(client))
        if differences:
            raise CampaignStopped(_REFUSED.format("; ".join(differences)))
        yield client


@cache
def facts() -> dict[str, str]:
    """What decides the numbers that this process computes: versions, and a hash of the sources of each package."""
    from importlib import metadata  # 30 ms, which only a cluster needs

    versions = {name: metadata.version(name) for name in _NUMBERS}
    sources = {f"sources of {part}": made_by(part)[:12] for part in PACKAGES}
    return {"Python": ".".join(platform.python_version_tuple()[:2])} | versions | sources


def _differences(client) -> Iterator[str]:
    """What sets workers apart from this process, as far as they answer within ASK_S."""
    answers = {}

    def collect():
        with contextlib.suppress(Exception):
            answers.update(client.run(facts, on_error="return"))

    # dask waits for a worker that is stopped as long as it stays so; it is asked again with its first run.
    thread = threading.Thread(target=collect, daemon=True)
    thread.start()
    thread.join(ASK_S)
    for worker, answer in list(answers.items()):
        if isinstance(answer, OSError):
            continue  # it has just gone; whoever comes in its place is asked with its first run
        if isinstance(answer, Exception):
            yield f"{worker}: {first_line(answer)}"
            continue
        difference = _difference(answer, facts())
        if difference:
            yield f"{worker}: {difference}"


def _difference(of_worker: dict[str, str], of_campaign: dict[str, str]) -> str:
    """Where the facts of a worker are not those of this campaign; "" where they are."""
    differences = []
    for name, fact in of_campaign.items():
        if of_worker.get(name) != fact:
            differences.append(f"{name} {of_worker.get(name, 'none')} (here: {fact})")
    return ", ".join(differences)


def _dask_results(client, call: Callable, tasks: list, alone: bool = False, spare: Sequence[Callable] = ()) -> Iterator:
    """(task, call(task)) as results come. Raises PoolBroken with the tasks that dask gave up, CampaignStopped."""
    from distributed import KilledWorker

    checked_call = partial(_checked_call, call, facts())
    futures = {client.submit(checked_call, task, pure=False): task for task in tasks}
    unfinished, killed = set(futures), {}
    try:
        while unfinished:
            for future in _finished(client, unfinished):
                unfinished.discard(future)
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
        raise CampaignStopped(_reason(error)) from error
    finally:
        with contextlib.suppress(Exception):  # of a scheduler that is gone: there is nothing to cancel
            client.cancel(list(unfinished))
    if killed:
        raise PoolBroken([futures[future] for future in killed], first_line(killed.popitem()[1]))


def _checked_call(call: Callable, of_campaign: dict[str, str], task: object) -> object:
    """Runs in the worker; one that joined late has not been asked before."""
    difference = _difference(facts(), of_campaign)
    if difference:
        from distributed import get_worker

        raise CampaignStopped(_REFUSED.format(f"{get_worker().address}: {difference}"))
    return call(task)


def _finished(client, futures: set) -> set:
    """The futures that have ended, however long it takes, while there is somebody who could be at them."""
    from distributed import wait

    without_worker_s, warned = 0.0, False
    while without_worker_s <= GONE_S:
        with contextlib.suppress(TimeoutError):
            return wait(futures, timeout=LOOK_S, return_when="FIRST_COMPLETED").done
        without_worker_s += LOOK_S
        if client.nthreads():
            without_worker_s = 0.0
        if without_worker_s > 0.1 * GONE_S and not warned:
            print(f"\nthe dask cluster has no worker; waiting {GONE_S:g} s for one to join", file=sys.stderr)
            warned = True
    raise CampaignStopped(f"the dask cluster has had no worker for {GONE_S:g} s; {_GO_ON}")


def _reason(error: Exception) -> str:
    """Why a cluster cannot go on, in a line."""
    if isinstance(error, ImportError):
        return _REFUSED.format(first_line(error))
    if isinstance(error, CancelledError | OSError):
        return f"the dask scheduler has ended or dropped the runs ({first_line(error)}); {_GO_ON}"
    return f"a worker cannot do its part: {type(error).__name__}: {first_line(error)}; {_GO_ON}"
