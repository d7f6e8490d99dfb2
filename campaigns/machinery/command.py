"""A campaign's command from the words of its line to its exit code: faults, interruptions and stops in a line each."""

import os
import shlex
import sys
from collections.abc import Callable
from pathlib import Path

from campaigns.machinery.cli import EXIT_BAD_INPUT, EXIT_FAILED, EXIT_INTERRUPTED, complaint
from campaigns.machinery.folder import CampaignStopped, write_failure


def command(module: str, argv: list[str] | None, read_order: Callable, work: Callable) -> int:
    """A campaign's command, from the words of its line (None: those of this process) to its exit code.

    read_order(argv, faults) -> the order, checked, with a `cli.Running` named how; work(order, argv) -> exit code.
    """
    argv = list(sys.argv[1:] if argv is None else argv)
    faults: list[str] = []
    # A closed stream (>&-) is None, which progress bars and workers write to.
    sys.stdout, sys.stderr = (stream or open(os.devnull, "w") for stream in (sys.stdout, sys.stderr))
    try:
        order = read_order(argv, faults)
    except KeyboardInterrupt:
        print("\ninterrupted; nothing was run or written", file=sys.stderr)
        return EXIT_INTERRUPTED
    except ModuleNotFoundError as missing:
        install = ".venv/bin/pip install -c constraints.txt -e ."
        print(f"python -m {module}: no package {missing.name!r} in {sys.executable}: {install}", file=sys.stderr)
        return EXIT_FAILED
    if faults:
        print(complaint(f"python -m {module}", faults), file=sys.stderr)
        return EXIT_BAD_INPUT
    try:
        return work(order, argv)
    except KeyboardInterrupt:
        _say_interrupted(order.how.out, command_line(module, argv))
        return EXIT_INTERRUPTED
    except CampaignStopped as reason:
        print(f"python -m {module}: {reason}", file=sys.stderr)
    except OSError as error:
        print(f"python -m {module}: {write_failure(order.how.out, error)}", file=sys.stderr)
    return EXIT_FAILED


def command_line(module: str, argv: list[str]) -> list[str]:
    """The command as the user would type it again."""
    return ["python", "-m", module, *argv]


def _say_interrupted(out: Path, again: list[str]) -> None:
    kept = sum(1 for _ in (out / "trajectories").glob("*.nc"))
    text = f"interrupted; {kept} finished runs are in {out}\nto go on with the rest: {shlex.join(again)}"
    print(f"\n{text}", file=sys.stderr)
