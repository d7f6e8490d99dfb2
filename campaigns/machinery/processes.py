"""Worker processes: they leave Ctrl-C to the campaign, end when it ends, and are missed when they die."""

import os
import signal
import time


class PoolBroken(Exception):
    """A worker process died. `suspects`: the unfinished jobs that had been handed out, at least one."""

    def __init__(self, suspects: list, reason: str):
        self.suspects = suspects
        super().__init__(reason)


def ignore_interrupt() -> None:
    """Let this process be deaf to Ctrl-C."""
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
