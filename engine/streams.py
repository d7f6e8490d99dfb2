"""A command at its terminal: faulty options, and standard output and error.

Whatever a title holds can be printed, and a reader may stop reading.
"""

import argparse
import difflib
import os
import sys
from collections.abc import Callable, Iterable


class Parser(argparse.ArgumentParser):
    """The options of a command. A faulty option raises ValueError, so that it is told together with other faults."""

    def error(self, message):
        raise ValueError(message)

    def close_to(self, word: str, *further: str) -> str:
        """ "; did you mean --set?" for a word that is close to an option, or to a further one; else ""."""
        names = list(further)
        for action in self._actions:
            names += action.option_strings
        for name in difflib.get_close_matches(word.partition("=")[0], names, n=1, cutoff=0.75):
            return f"; did you mean {name}?"
        return ""


def close_to(name: str, names: Iterable[str]) -> str:
    """ "; did you mean ...?" where a name is close to one of these, else ""."""
    for close in difflib.get_close_matches(name, list(names), n=1):
        return f"; did you mean {close!r}?"
    return ""


def refused(command: str, faults: list[str], consequence: str) -> int:
    """Tell the faults of a command, a line each, and what follows from them. Returns the exit code, 2."""
    head = f"{command}: "
    if len(faults) > 1:
        head += f"{len(faults)} faults\n  "
    print(head + "\n  ".join(faults) + f"\n{consequence}", file=sys.stderr)
    return 2


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
