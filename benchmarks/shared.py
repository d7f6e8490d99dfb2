"""What benchmarks share: one core, settings in turns, medians, and small pictures for the documents."""

import argparse
import os
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median

DOCS = Path(__file__).parents[1] / "docs"


def command_line(doc: str) -> argparse.ArgumentParser:
    """A command line; its description is the first paragraph of the module's text."""
    return argparse.ArgumentParser(description=doc.split("\n\n")[0])


def parser(doc: str, rounds: int, on_one_core: bool = False) -> argparse.ArgumentParser:
    """A command line with --rounds, and with --core for `on_one_core`."""
    parser = command_line(doc)
    parser.add_argument("--rounds", type=int, default=rounds, help=f"turns of every setting (default {rounds})")
    if on_one_core:
        parser.add_argument("--core", type=int, help="the core to run on (default: the last one allowed; Linux)")
    return parser


def on_one_core(core: int | None) -> None:
    """Keep this process, and those that it starts, on one core."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0)) if core is None else core})


def print_load() -> None:
    """The load of the machine, without which no time means anything."""
    print(f"load: {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")


def seconds(call: Callable[[], object], clock: Callable[[], float] = time.perf_counter) -> float:
    """Time of a call by a clock; without one, wall time."""
    start = clock()
    call()
    return clock() - start


def in_turns(calls: dict[str, Callable[[], float]], rounds: int) -> dict[str, list[float]]:
    """What each call returns in every round; the calls take turns (A B C A B C ...)."""
    results: dict[str, list[float]] = {name: [] for name in calls}
    for _ in range(rounds):
        for name, call in calls.items():
            results[name].append(call())
    return results


def show(name: str, values: list[float], unit: str) -> None:
    """A line with median, least and most."""
    print(f"{median(values):10.4g} {unit}  {name} ({min(values):.3g} to {max(values):.3g})")


def shrink(path: Path, colours: int) -> None:
    """A PNG in few colours, so that the repository stays small."""
    from PIL import Image

    Image.open(path).convert("RGB").quantize(colours).save(path, optimize=True)
    print(f"docs/{path.name}: {path.stat().st_size / 1000:.0f} kB")
