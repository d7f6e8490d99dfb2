"""Standard output and error of a command: whatever a title holds can be printed, and a reader may stop reading."""

import os
import sys
from collections.abc import Callable


def open_streams() -> None:
    """Let this process print any letter, as "\\u4e2d" where the terminal has none, and to a stream that is closed."""
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name) or open(os.devnull, "w")
        if hasattr(stream, "reconfigure"):  # not that of a notebook
            stream.reconfigure(errors="backslashreplace")
        setattr(sys, name, stream)


def printed(command: Callable[[], int]) -> int:
    """The exit code of a function that prints; 0 where nobody reads to the end, as behind `| head`."""
    try:
        code = command()
        sys.stdout.flush()
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # for the flush at the end of the process
        return 0
    return code
