"""Random scenes against the engine: what each does, in one word and one line (`campaigns.stability --fuzz N`).

Valid scenes are ok, ended or refused, invalid ones refused; anything else is a fault of the program (`OUTCOMES`).

Each has a process of its own, ended when its time is up (`limited`): the only way out of machine code that does not
return. The process is a fork of the caller, so compiled kernels are at hand and nothing has to be loaded again. The
time is that of the processor, so that a busy machine does not make a slow call a hanging one; a call that only waits is
ended too, later.
"""

import multiprocessing
import os
import re
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
from campaigns.stability.random_scenes import VALID, faults_of
from engine.parameters.limits import longest_step
from engine.scene import build_scene
from tables import Column

DONE, RAISED, LATE, DIED = "done", "traceback", "hang", "crash"
PATIENCE = 5.0  # times the limit, in seconds of the wall clock
LIMIT_S = 60.0
SOUND = ("ok", "ended", "refused")
OUTCOMES = {
    "ok": "ran to its end; every sample is there and finite",
    "ended": "ended early with a status and a reason; finite up to there",
    "refused": "not started; every fault is named with its key and with what is allowed",
    "hang": "no answer within the time limit",
    "crash": "its process died",
    "traceback": "an exception that is no refusal",
    "not-finite": "a number that is not finite was handed out",
    "incomplete": "samples are missing",
    "silent": "ended early without a reason",
    "accepted": "an invalid scene was not refused",
    "unclear": "a message without a key or without what is allowed",
}
SAMPLES = 40  # a run lasts for so many output samples ...
STEPS = 1e4  # ... and for no more of the longest steps: what is asked for has to be possible in the time limit
CLEAR = re.compile(r"^.+: .*(allowed|unknown key|which law = .* does not have)", re.DOTALL)
LONGEST_LINE = 400
COLUMNS = (
    Column("kind", symbol="scenes", meaning="valid: to be run or refused in words; invalid: to be refused"),
    Column("number", "", "number", "number of the scene among those of its kind", 0),
    Column("outcome", symbol="outcome", meaning="ok, ended and refused are sound; anything else is a fault"),
    Column("meaning", symbol="meaning", meaning="the outcome in words"),
    Column("status", symbol="ended", meaning="how the run of a valid scene ended"),
    Column("message", symbol="message", meaning="the reason that the user is given"),
    Column("wall_s", "s", "wall", "wall-clock time of the scene", 2),
)


@cache
def load_kernels() -> None:
    """Load all machine code, with laws of few scenes and without, once in a process: a fork has nothing to load."""
    carried = {"output.tangent_vectors": 1, "output.lateral_growth": True, "tether.nodes": 5}
    for changes in ({"motion.dimensions": 3}, carried):
        for law in ({}, {"tether.damping_Ns": 1.0}):
            engine.simulate(engine.load_scene("tethered_buoy", changes | law), duration_s=5.05)


def judged(kind: str, raw: dict) -> dict[str, object]:
    """What the engine makes of a scene: {"outcome", "status" of its run, "message", "wall_s"}."""
    answer_of = run_valid if kind == VALID else refuse_invalid
    way, answer, wall_s = limited(lambda: answer_of(raw), LIMIT_S)
    outcome, status, message = answer if way == DONE else (way, "", answer)
    return {"outcome": outcome, "meaning": OUTCOMES[outcome], "status": status, "message": message, "wall_s": wall_s}


def refuse_invalid(raw: dict) -> tuple[str, str, str]:
    """(outcome, "", message) of a scene that has to be refused."""
    lines = faults_of(raw)
    unclear = [line for line in lines if not CLEAR.match(line) or len(line) > LONGEST_LINE]
    return "unclear" if unclear else "refused" if lines else "accepted", "", "; ".join(unclear or lines)


def run_valid(raw: dict) -> tuple[str, str, str]:
    """(outcome, status, message) of the run of a valid scene. Raises what is no refusal in words."""
    scene = build_scene(raw)
    length_s = min(SAMPLES * scene.sample_step_s(), STEPS * longest_step(scene)[1])
    try:
        run = engine.simulate(scene, duration_s=length_s)
    except ValueError as error:
        if not CLEAR.match(str(error)):
            raise
        return "refused", "", str(error)
    return outcome_of(run, length_s)


def outcome_of(run, length_s: float) -> tuple[str, str, str]:
    """(outcome, status, message) of a finished run of that length."""
    arrays = [*run.columns.values()]
    if run.profiles is not None:
        arrays += vars(run.profiles).values()
    if not all(np.isfinite(array).all() for array in arrays):
        return "not-finite", run.status, run.message
    if run.status == "ok":
        missing = len(run.columns["time_s"]) != int(length_s / run.scene.sample_step_s() * (1 + 1e-12) + 1e-9) + 1
        return ("incomplete" if missing else "ok"), run.status, run.message
    return ("ended" if run.message else "silent"), run.status, run.message


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
