"""The commands that a user waits for, on two checkouts in turns: seconds of both, their ratio, and the bar for it.

    python -m benchmarks.half_the_time BEFORE [AFTER] [--rounds 3] [--works sweep again ...] [--growth]

BEFORE, AFTER   folders of two checkouts; AFTER is this one unless given
Works           each is a command, or a few lines of Python, in a process of its own on all cores. "cold":
                no kernel is compiled; "again": the command is given a second time. Kernels of the others are compiled
                before the clock starts. Medians over the rounds, in which the checkouts take turns.
--growth        how the time of AFTER grows with nodes, values, starts and workers. With 1 and 2 workers it is measured.
                With 2 to 64 it is simulated: the queue of a dask scheduler hands out tasks that only wait, each as long
                as a run of the sweep took, in TIMES of its time.
MoorDyn         where it is installed, `campaigns.accuracy` gives its time and ours for the regular buoy at 2 mm.
"""

import argparse
import csv
import os
import subprocess
import sys
import tempfile
import time
from functools import partial
from pathlib import Path
from statistics import median

from benchmarks.shared import in_turns, print_load, seconds

HERE = Path(__file__).parents[1]
TIMES = 0.2
ENOUGH_MM = 2.0
SWEEP = "-m", "campaigns.buoy_sweep"
ORBITS = "-m", "campaigns.orbits", "--vary", "waves.steepness", "0.1", "0.16", "--set"
RATES = """
import time
from engine import load_scene, simulate, simulate_batch
def scenes(count):
    keys = {"water.depth_m": 21.6, "output.tangent_vectors": CARRIED, "output.lateral_growth": bool(CARRIED)}
    steepness = [0.05 + 0.11 * number / (count - 1) for number in range(count)]
    return [load_scene("tethered_buoy", keys | {"waves.steepness": value}) for value in steepness]
"""
LANES = """
simulate_batch(scenes(8), periods=1)
begin = time.process_time()
simulate_batch(scenes(48), periods=40)
print(time.process_time() - begin)
"""
ALONE = """
scene = load_scene("tethered_buoy", {"water.depth_m": 21.6, "waves.steepness": 0.13, "tether.nodes": NODES})
simulate(scene, periods=1)
begin = time.process_time()
simulate(scene, periods=100)
print(time.process_time() - begin)
"""
WORKS = {  # name: bar for the ratio, words after python; {out}: a new folder
    "sweep": (0.47, (*SWEEP, "--out", "{out}")),
    "sweep, cold": (0.55, (*SWEEP, "--out", "{out}")),
    "sweep, again": (None, (*SWEEP, "--out", "{out}")),
    "sweep from rest": (0.5, (*SWEEP, "--starts", "rest", "--out", "{out}")),
    "basins 49 x 49": (0.4, ("-m", "campaigns.basins", "--grid", "49", "--out", "{out}")),
    "map 40 x 40": (0.45, ("-m", "campaigns.regime_map", "--out", "{out}")),
    "orbits, 25 m": (0.33, (*ORBITS, "water.depth_m=25", "--out", "{out}")),
    "orbits, 22.5 m": (0.33, (*ORBITS, "water.depth_m=22.5", "--out", "{out}")),
    "orbits, 21 m": (0.33, (*ORBITS, "water.depth_m=21", "--out", "{out}")),
    "lanes, 1,920 periods": (0.625, ("-c", RATES.replace("CARRIED", "0") + LANES)),
    "lanes, two perturbations": (0.625, ("-c", RATES.replace("CARRIED", "1") + LANES)),
    "alone, 100 periods": (0.8, ("-c", RATES + ALONE.replace("NODES", "41"))),
    "fast tests": (None, ("-m", "pytest", "-q", "-n", "2")),
}  # fmt: skip


def process(checkout: Path, kernels: Path, words) -> float:
    """Seconds of `python words...` in a checkout: those that it prints last, else its wall time. kernels: a folder."""
    settings = {"cwd": checkout, "capture_output": True, "text": True}
    settings["env"] = os.environ | {"PYTHONPATH": str(checkout), "TETHER_CACHE_DIR": str(kernels)}
    begin = time.perf_counter()
    ended = subprocess.run([sys.executable, *words], **settings)
    wall_s = time.perf_counter() - begin
    if ended.returncode:
        raise SystemExit(f"{checkout}: {' '.join(words)} ends with {ended.returncode}:\n{ended.stderr[-2000:]}")
    if words[0] == "-c":
        return float(ended.stdout.split()[-1])
    return wall_s


def work(checkout: Path, kernels: Path, name: str, words) -> float:
    """Seconds of one work on a checkout."""
    with tempfile.TemporaryDirectory() as folder:
        words = [word.replace("{out}", f"{folder}/out") if word == "{out}" else word for word in words]
        if name.endswith("cold"):
            kernels = Path(folder, "kernels")
        if name.endswith("again"):
            process(checkout, kernels, words)
        return process(checkout, kernels, words)


def compare(checkouts: dict[str, Path], names, rounds: int, folder: Path) -> None:
    """Print the table of works."""
    print(f"{'work':26s} {'before s':>9s} {'after s':>9s} {'ratio':>6s}  bar")
    for name in names:
        bar, words = WORKS[name]
        calls = {}
        for place, checkout in checkouts.items():
            kernels = folder / place
            if not name.endswith("cold"):
                work(checkout, kernels, name, words)
            calls[place] = partial(work, checkout, kernels, name, words)
        taken = {place: median(values) for place, values in in_turns(calls, rounds).items()}
        ratio = taken["after"] / taken["before"]
        verdict = ""
        if bar is not None:
            verdict = f"{bar:.3g} {'met' if ratio <= bar else 'MISSED'}"
        print(f"{name:26s} {taken['before']:9.2f} {taken['after']:9.2f} {ratio:6.3f}  {verdict}", flush=True)


def growth(checkout: Path, kernels: Path) -> None:
    """Print how time grows with nodes, values, starts and workers."""
    for nodes in (6, 11, 21, 41, 81, 161):
        taken_s = process(checkout, kernels, ("-c", RATES + ALONE.replace("NODES", str(nodes))))
        print(f"{taken_s:9.2f} s  100 periods alone, {nodes} nodes", flush=True)
    rest = *SWEEP, "--starts", "rest", "--no-report", "--no-between", "--no-accuracy"
    with tempfile.TemporaryDirectory() as folder:
        for values in (15, 30, 60):
            out = Path(folder, str(values))
            words = *rest, "--steepness-range", "0.05", "0.16", str(values), "--out", str(out)
            print(f"{process(checkout, kernels, words):9.2f} s  sweep from rest, {values} values", flush=True)
        for starts in (12, 24, 48):
            words = "-m", "campaigns.basins", "--grid", str(starts), "--no-report", "--out", f"{folder}/b{starts}"
            print(f"{process(checkout, kernels, words):9.2f} s  basins, {starts} x {starts} starts", flush=True)
        for jobs in (1, 2):
            words = *rest, "--steepness-range", "0.05", "0.16", "60", "--jobs", str(jobs), "--out", f"{folder}/j{jobs}"
            print(f"{process(checkout, kernels, words):9.2f} s  sweep from rest, {jobs} workers, measured", flush=True)
        with (out / "table.csv").open() as file:
            tasks_s = [float(row["wall_s"]) for row in csv.DictReader(file) if row["wall_s"]]
    for workers in (2, 4, 8, 16, 32, 64):
        print(
            f"{simulated(tasks_s, workers):9.2f} s  its {len(tasks_s)} runs, {workers} workers, simulated", flush=True
        )


def simulated(tasks_s: list[float], workers: int) -> float:
    """Seconds that tasks of these lengths take through the queue of a dask scheduler with so many workers."""
    from distributed import Client, LocalCluster

    options = {"n_workers": workers, "threads_per_worker": 1, "processes": False, "dashboard_address": None}
    with LocalCluster(**options) as cluster, Client(cluster) as client:
        client.gather(client.map(time.sleep, [0.1] * workers, pure=False))
        waits = [TIMES * task_s for task_s in tasks_s]
        return seconds(lambda: client.gather(client.map(time.sleep, waits, pure=False))) / TIMES


def beside_moordyn(checkout: Path, kernels: Path) -> None:
    """Print what the regular buoy costs at an error of ENOUGH_MM, of this engine and of MoorDyn."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder, "out")
        process(checkout, kernels, ("-m", "campaigns.accuracy", "--works", "regular", "--no-report", "--out", str(out)))
        least_s: dict[str, float] = {}
        with (out / "table.csv").open() as file:
            for row in csv.DictReader(file):
                if row["status"] == "ok" and row["round"] and row["error"] and float(row["error"]) <= ENOUGH_MM:
                    method = row["method"]
                    least_s[method] = min(float(row["wall_s"]), least_s.get(method, float("inf")))
    for method, run_s in sorted(least_s.items(), key=lambda pair: pair[1]):
        print(f"{run_s:9.4f} s  regular buoy to {ENOUGH_MM:g} mm, {method}")
    if "MoorDyn" not in least_s:
        print("MoorDyn: not installed, or not so accurate")


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    options.add_argument("before", type=Path)
    options.add_argument("after", type=Path, nargs="?", default=HERE)
    options.add_argument("--rounds", type=int, default=3)
    options.add_argument("--works", nargs="+", choices=WORKS, default=[*WORKS])
    options.add_argument("--growth", action="store_true")
    arguments = options.parse_args()
    checkouts = {"before": arguments.before.resolve(), "after": arguments.after.resolve()}
    print_load()
    with tempfile.TemporaryDirectory() as folder:
        compare(checkouts, arguments.works, arguments.rounds, Path(folder))
        if arguments.growth:
            growth(checkouts["after"], Path(folder, "after"))
            beside_moordyn(checkouts["after"], Path(folder, "after"))
    print_load()


if __name__ == "__main__":
    main()
