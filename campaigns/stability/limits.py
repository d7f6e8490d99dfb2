"""A call with a time limit, in a process of its own; and whether what a run hands out is sound.

The process is ended when its time is up: the only way out of machine code that does not return. It is a fork of the
caller, so compiled kernels are at hand and nothing has to be loaded again. The time is that of the processor, so that a
busy machine does not make a slow call a hanging one; a call that only waits is ended too, later.
"""

import multiprocessing
import os
import resource
import signal
import threading
import time
import traceback
from collections.abc import Callable
from functools import cache

import numpy as np

import engine
from campaigns.machinery.pools import end_with

DONE, RAISED, LATE, DIED = "done", "traceback", "hang", "crash"
PATIENCE = 5.0  # times the limit, in seconds of the wall clock


@cache
def load_kernels() -> None:
    """Load all machine code, with laws of few scenes and without, once in a process: a fork has nothing to load."""
    carried = {"output.tangent_vectors": 1, "output.lateral_growth": True, "tether.nodes": 5}
    for changes in ({"motion.dimensions": 3}, carried):
        for law in ({}, {"tether.damping_Ns": 1.0}):
            engine.simulate(engine.load_scene("tethered_buoy", changes | law), duration_s=5.05)


def outcome_of(run, length_s: float) -> str:
    """Whether a finished run of that length is sound: "ok", or "ended" early with a reason; else the word for a fault.

    not-finite: a number that is not finite was handed out; incomplete: samples are missing; silent: it ended early
    without a reason.
    """
    arrays = [*run.columns.values()]
    if run.profiles is not None:
        arrays += vars(run.profiles).values()
    if not all(np.isfinite(array).all() for array in arrays):
        return "not-finite"
    if run.status != "ok":
        if run.message:
            return "ended"
        return "silent"
    samples = int(length_s / run.scene.sample_step_s() * (1 + 1e-12) + 1e-9) + 1
    if len(run.columns["time_s"]) == samples:
        return "ok"
    return "incomplete"


def limited(call: Callable, limit_s: float) -> tuple[str, object, float]:
    """(DONE, what `call()` returns, s), or (RAISED, LATE or DIED, what happened in words, s); s: wall time.

    limit_s: of processor time, rounded up to whole seconds. The result has to pass through a pipe (pickle).
    """
    ways = multiprocessing.get_context("fork")
    ours, theirs = ways.Pipe(duplex=False)
    began = time.perf_counter()
    process = ways.Process(target=_answer, args=(theirs, call, limit_s, os.getpid()), daemon=True)
    process.start()
    theirs.close()
    late = LATE, f"no answer within {limit_s:g} s of computing"
    try:
        way, answer = ours.recv() if ours.poll(PATIENCE * limit_s) else late
    except EOFError:
        process.join()
        died = DIED, f"its process ended with exit code {process.exitcode}"
        way, answer = late if process.exitcode == -signal.SIGXCPU else died
    finally:
        process.kill()
        process.join()
        ours.close()
    return way, answer, time.perf_counter() - began


def _answer(pipe, call: Callable, limit_s: float, parent: int) -> None:
    threading.Thread(target=end_with, args=(parent,), daemon=True).start()
    seconds = max(1, int(-(-limit_s // 1)))
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, resource.getrlimit(resource.RLIMIT_CPU)[1]))
    try:
        answer = DONE, call()
    except Exception:
        answer = RAISED, traceback.format_exc()
    pipe.send(answer)
