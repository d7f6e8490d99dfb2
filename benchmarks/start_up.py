"""How long things take before anything is computed: cold compile, cached start, `--help` of every command line.

    python -m benchmarks.start_up [--rounds N] [--core N]

Cold    a process, from nothing to the end of a simulation of one wave period of the shipped scene, with
        an empty folder for compiled kernels; less the same with the kernels there, it is the compilation.
Cached  the same process with the kernels there; beside it an empty Python process and the imports alone.
Help    `python -m NAME --help` of everything in campaigns and reports that is a command line.
Everything runs as a process of its own, in turns (A B C A B C ...), on one core; medians over the rounds, wall clock.
"""

import argparse
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

from engine import source_hash

ROOT = Path(__file__).resolve().parents[1]
ONE_PERIOD = (
    "from engine import load_scene, simulate; assert simulate(load_scene('tethered_buoy'), periods=1).status == 'ok'"
)
IMPORTS = "from engine import simulate"


def seconds(arguments, kernels):
    """Wall time of `python arguments...` with the folder `kernels` for compiled code."""
    environment = os.environ | {"TETHER_CACHE_DIR": str(kernels)}
    began = time.perf_counter()
    subprocess.run([sys.executable, *arguments], cwd=ROOT, env=environment, check=True, stdout=subprocess.DEVNULL)
    return time.perf_counter() - began


def command_lines():
    """Names of the packages of campaigns and reports that can be run."""
    mains = [path for package in ("campaigns", "reports") for path in sorted((ROOT / package).rglob("__main__.py"))]
    return [".".join(path.parent.relative_to(ROOT).parts) for path in mains]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--rounds", type=int, default=7, help="turns of every warm timing (default 7)")
    parser.add_argument("--cold-rounds", type=int, default=3, help="cold compiles (default 3)")
    parser.add_argument("--core", type=int, help="the core to run on (default: the last one allowed; Linux)")
    given = parser.parse_args()
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0)) if given.core is None else given.core})
    print(f"load at the start: {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
    warm = {
        "an empty Python process": ["-c", "pass"],
        "imports of the engine, kernels loaded": ["-c", IMPORTS],
        "cached start: from nothing to the end of one wave period": ["-c", ONE_PERIOD],
    } | {f"python -m {name} --help": ["-m", name, "--help"] for name in command_lines()}
    sources = source_hash.__wrapped__()
    with tempfile.TemporaryDirectory() as folder:
        cold = [seconds(["-c", ONE_PERIOD], Path(folder, str(i))) for i in range(given.cold_rounds)]
        kernels = Path(folder, "0")
        found = {label: [] for label in warm}
        for _ in range(given.rounds):
            for label, arguments in warm.items():
                found[label].append(seconds(arguments, kernels))
    if source_hash.__wrapped__() != sources:
        raise SystemExit("the engine's sources changed during the timing: run it again")
    cached = median(found["cached start: from nothing to the end of one wave period"])
    show("cold start: the same with no compiled kernels", cold)
    print(f"{median(cold) - cached:8.2f} s  of that, compilation")
    for label, times in found.items():
        show(label, times)
    print(f"load at the end: {os.getloadavg()[0]:.1f}")


def show(label, times):
    print(f"{median(times):8.2f} s  {label} ({min(times):.2f} to {max(times):.2f})")


if __name__ == "__main__":
    main()
