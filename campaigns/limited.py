"""A call in a process of its own that is ended when its time is up: the only way out of machine code that does not return.

The process is a fork of the caller, so compiled kernels are at hand and nothing has to be loaded again.
"""

import multiprocessing
import time
import traceback
from collections.abc import Callable

DONE, RAISED, LATE, DIED = "done", "raised", "late", "died"


def limited(call: Callable, limit_s: float) -> tuple[str, object, float]:
    """(DONE, what `call()` returns) | (RAISED, (class name, message, traceback)) | (LATE, None) | (DIED, exit code).

    The third entry is the wall time in s. The result has to pass through a pipe (pickle).
    """
    ways = multiprocessing.get_context("fork")
    ours, theirs = ways.Pipe(duplex=False)
    began = time.perf_counter()
    process = ways.Process(target=_answer, args=(theirs, call), daemon=True)
    process.start()
    theirs.close()
    try:
        kind, answer = ours.recv() if ours.poll(limit_s) else (LATE, None)
    except EOFError:
        process.join()
        kind, answer = DIED, process.exitcode
    finally:
        process.kill()
        process.join()
        ours.close()
    return kind, answer, time.perf_counter() - began


def _answer(pipe, call: Callable) -> None:
    try:
        answer = DONE, call()
    except Exception as error:
        answer = RAISED, (type(error).__name__, str(error), traceback.format_exc())
    pipe.send(answer)
