"""How long things take before anything is computed: cold compile, cached start, `--help` of every command line.

    python -m benchmarks.start_up [--rounds N] [--cold-rounds N] [--core N]

Cold    a process, from nothing to the end of a simulation of one wave period of the shipped scene, with an empty folder
        for compiled kernels; less the same with the kernels there, it is the compilation.
Cached  the same process with the kernels there; beside it an empty Python process and the imports alone.
Help    `python -m NAME --help` of everything in campaigns and reports that is a command line.
"""

import os
import subprocess
import sys
import tempfile
from functools import partial
from pathlib import Path
from statistics import median

from benchmarks.shared import in_turns, on_one_core, parser, print_load, seconds, show

ROOT = Path(__file__).resolve().parents[1]
ONE_PERIOD = (
    "from engine import load_scene, simulate; assert simulate(load_scene('tethered_buoy'), periods=1).status == 'ok'"
)
CACHED = "cached start: from nothing to the end of one wave period"


def run(kernels: Path, *words: str) -> float:
    """Wall time of `python words...` with the folder `kernels` for compiled code."""
    settings = {"cwd": ROOT, "env": os.environ | {"TETHER_CACHE_DIR": str(kernels)}, "stdout": subprocess.DEVNULL}
    return seconds(partial(subprocess.run, [sys.executable, *words], check=True, **settings))


def main() -> None:
    mains = [*sorted((ROOT / "campaigns").rglob("__main__.py")), *sorted((ROOT / "reports").rglob("__main__.py"))]
    options = parser(__doc__, 7, on_one_core=True)
    options.add_argument("--cold-rounds", type=int, default=3, help="cold compiles (default 3)")
    arguments = options.parse_args()
    on_one_core(arguments.core)
    print_load()
    warm = {
        "an empty Python process": ("-c", "pass"),
        "imports of the engine, kernels loaded": ("-c", "from engine import simulate"),
        CACHED: ("-c", ONE_PERIOD),
    }
    for path in mains:
        name = ".".join(path.parent.relative_to(ROOT).parts)
        warm[f"python -m {name} --help"] = ("-m", name, "--help")
    with tempfile.TemporaryDirectory() as folder:
        cold = [run(Path(folder, str(i)), "-c", ONE_PERIOD) for i in range(arguments.cold_rounds)]
        calls = {name: partial(run, Path(folder, "0"), *words) for name, words in warm.items()}
        times_of = in_turns(calls, arguments.rounds)
    show("cold start: the same with no compiled kernels", cold, "s")
    print(f"{median(cold) - median(times_of[CACHED]):10.4g} s  of that, compilation")
    for name, times in times_of.items():
        show(name, times, "s")
    print_load()


if __name__ == "__main__":
    main()
