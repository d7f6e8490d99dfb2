"""Runs on a dask cluster: its workers are other processes, maybe on other machines that see no folder of ours.

dask's own futures are used, not joblib's backend for dask, which waits for ever when a worker is lost (joblib 1.6).
What goes wrong, and what becomes of it:

    a worker dies          dask gives its runs to another one; a run whose workers die more often than the scheduler
                           allows is a suspect of `PoolBroken`, and is tried alone once more
    no worker is there     the campaign waits JOIN_S for the first one, GONE_S for one to come back, and stops
    the scheduler dies     the campaign stops; so it does where a worker has other sources or libraries than we have

"Stops" is CampaignStopped, one line: finished runs are on disk, and the same command goes on.
"""

import contextlib
import logging
import platform
import queue
import sys
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError
from functools import cache, partial
from importlib import metadata

from campaigns.machinery.folder import CampaignStopped
from campaigns.machinery.processes import PoolBroken, first_line, ignore_interrupt
from campaigns.machinery.row_cache import made_by

JOIN_S = 30.0  # for the scheduler to answer, and then for its first worker
ASK_S = 10.0  # for all workers to say what they are
GONE_S = 120.0  # without any worker in the midst of a campaign
LOOK_S = 2.0  # between two looks at the workers that are there
_NUMBERS = ("numpy", "scipy", "numba", "llvmlite")  # a worker with another version would give other last digits
_PARTS = ("machine_code", "engine", "analysis", "campaigns", "reports")
_GO_ON = "finished runs are kept; mend the cluster and run the same command again"


class _OtherVersion(Exception):
    """Raised in a worker that must not take part; str() says why."""


@contextlib.contextmanager
def client(jobs: int, address: str | None) -> Iterator:
    """A client of the scheduler at `address`, or of a local cluster of `jobs` processes (None).

    Raises CampaignStopped where no scheduler answers, no worker joins, or scheduler or workers have another version.
    """
    import dask
    from distributed import Client, LocalCluster

    local = address is None
    with contextlib.ExitStack() as stack:
        if local:
            # A run whose worker dies is not tried again by dask: the runner does that, one run at a time.
            stack.enter_context(dask.config.set({"distributed.scheduler.allowed-failures": 0}))
            own = {"n_workers": jobs, "threads_per_worker": 1, "dashboard_address": None, "silence_logs": "CRITICAL"}
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
        except TimeoutError:
            start = f"start one: dask worker {address} --nthreads 1"
            raise CampaignStopped(f"the scheduler at {address} has no worker after {JOIN_S:g} s; {start}") from None
        if faults := list(_differences(found)):
            raise CampaignStopped(_refusal("; ".join(faults)))
        if local:
            found.register_plugin(_deaf_to_interrupts())
        yield found


def _deaf_to_interrupts():
    from distributed import WorkerPlugin

    class DeafToInterrupts(WorkerPlugin):
        """As `ignore_interrupt`, also for workers that dask starts in place of lost ones."""

        def setup(self, worker):
            ignore_interrupt()

    return DeafToInterrupts()


@cache
def facts() -> dict[str, str]:
    """What decides the numbers that this process computes: versions, and a hash of the sources of each package."""
    versions = {name: metadata.version(name) for name in _NUMBERS}
    sources = {f"sources of {part}": made_by({}, part)[:12] for part in _PARTS}
    return {"Python": ".".join(platform.python_version_tuple()[:2])} | versions | sources


def _differences(found) -> Iterator[str]:
    """What sets scheduler and workers apart from this process, as far as they say so within ASK_S."""
    try:
        found.run_on_scheduler(facts)  # it computes nothing, but dask unpacks there what it hands on
    except ImportError as error:
        yield f"the scheduler: {first_line(error)}"
    came: queue.Queue = queue.Queue()

    def ask() -> None:
        with contextlib.suppress(Exception):
            came.put(found.run(facts, on_error="return"))

    # dask waits for a worker that is stopped as long as it stays so; who does not answer is asked with its first run.
    threading.Thread(target=ask, daemon=True).start()
    with contextlib.suppress(queue.Empty):
        for worker, there in came.get(timeout=ASK_S).items():
            if isinstance(there, OSError):
                continue  # it has just gone; whoever comes in its place is asked with its first run
            if off := first_line(there) if isinstance(there, Exception) else _difference(there, facts()):
                yield f"{worker}: {off}"


def _difference(there: dict[str, str], here: dict[str, str]) -> str:
    off = [f"{name} {there.get(name, 'none')} (here: {here[name]})" for name in here if there.get(name) != here[name]]
    return ", ".join(off)


def results(found, call: Callable, work: list) -> Iterator:
    """call(job) for every job, as results come. Raises PoolBroken with the jobs that dask gave up, CampaignStopped."""
    from distributed import KilledWorker

    ask = partial(_asked, call, facts())
    futures = {found.submit(ask, job, pure=False): job for job in work}
    left, killed, last = set(futures), [], None
    try:
        while left:
            for future in _done(found, left):
                left.discard(future)
                try:
                    result = future.result()
                except KilledWorker as error:
                    killed.append(futures[future])
                    last = error
                    continue
                except Exception as error:
                    raise CampaignStopped(_reason(error)) from error
                future.release()
                yield result
    finally:
        with contextlib.suppress(Exception):  # of a scheduler that is gone: there is nothing to cancel
            found.cancel(list(left))
    if killed:
        raise PoolBroken(killed, first_line(last))


def _asked(call: Callable, here: dict[str, str], job: object) -> object:
    # In the worker; one that joined late has not been asked before.
    if off := _difference(facts(), here):
        from distributed import get_worker

        raise _OtherVersion(f"{get_worker().address}: {off}")
    return call(job)


def _done(found, left: set) -> set:
    """The futures that have ended, however long it takes, while there is somebody who could be at them."""
    from distributed import wait

    alone_s, said = 0.0, False
    while True:
        try:
            return wait(left, timeout=LOOK_S, return_when="FIRST_COMPLETED").done
        except TimeoutError:
            pass
        except Exception as error:
            raise CampaignStopped(_reason(error)) from error
        try:
            alone_s = 0.0 if found.nthreads() else alone_s + LOOK_S
        except Exception as error:
            raise CampaignStopped(_reason(error)) from error
        if alone_s > GONE_S:
            raise CampaignStopped(f"the dask cluster has had no worker for {GONE_S:g} s; {_GO_ON}")
        if alone_s > 0.1 * GONE_S and not said:
            print(f"\nthe dask cluster has no worker; waiting {GONE_S:g} s for one to join", file=sys.stderr)
            said = True


def _reason(error: BaseException) -> str:
    if isinstance(error, _OtherVersion | ImportError):
        return _refusal(first_line(error))
    if isinstance(error, CancelledError | OSError):
        return f"the dask scheduler has ended or dropped the runs ({first_line(error)}); {_GO_ON}"
    return f"a worker cannot do its part: {type(error).__name__}: {first_line(error)}; {_GO_ON}"


def _refusal(fault: str) -> str:
    cure = "install there what is installed here, and start it again"
    return f"refused, not the same version as here: {fault}; {cure}"
