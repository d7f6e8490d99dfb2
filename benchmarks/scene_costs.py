"""What a Newton iteration costs in each kind of scene, with and without the laws of few scenes.

    python -m benchmarks.scene_costs [--rounds N] [--beside CHECKOUT]

Scenes   Kinds of record (`engine.record`): a buoy, its cap, perturbations, a held line, three dimensions; then a buoy
         and its cap with each law of `engine.physics.extras`, over the same scene without.
Figure   us of processor time an iteration, start included, least of runs of a second; rounds take turns, medians.
Beside   Another checkout (its kernels are compiled first): its figures for the scenes without these laws, the ratio of
         ours to them, and whether the columns of the runs are the same, bit for bit.
"""

import hashlib
import json
import os
import subprocess
import sys
import time
from pathlib import Path
from statistics import median

from benchmarks.shared import in_turns, parser, print_load, seconds
from engine import load_scene, simulate

HERE = Path(__file__).parents[1]
CAP = {"buoy.submergence": "spherical-cap"}
SPACE = {"motion.dimensions": 3}
SCENES = {  # name: shipped scene, changes, duration in s
    "buoy": ("tethered_buoy", {}, 15.0),
    "cap": ("tethered_buoy", CAP, 15.0),
    "perturbations": ("tethered_buoy", {"output.tangent_vectors": 1, "output.lateral_growth": True}, 10.0),
    "shaken line": ("shaken_line", {}, 3.0),
    "buoy in space": ("tethered_buoy", SPACE, 5.0),
    "twisted rope": ("twisted_rope", {}, 1.0),
}
LAWS = {
    "damping": {"tether.damping_critical": 0.5},
    "surface": {"tether.submergence": "free-surface"},
    "push": {"tether.froude_krylov": "whole"},
    "bed": {"floor": {"stiffness_Npm3": 1e6, "damping_Nspm3": 1e4, "friction": 0.3}},
    "anchor": {"anchor.position_m": [1.0, 0.0, 0.1]},
}
WITH = {}
for kind, changes, duration_s in (("cap", CAP, 15.0), ("cap in space", CAP | SPACE, 5.0)):
    for law, keys in ({"no law": {}} | LAWS).items():
        WITH[f"{kind}, {law}"] = ("tethered_buoy", changes | keys, duration_s)


def costs(names):
    """{name: (us a Newton iteration, hash of the columns)} of scenes, on this checkout."""
    results = {}
    for name in names:
        base, changes, duration_s = (SCENES | WITH)[name]
        if base == "tethered_buoy":
            changes = {"water.depth_m": 22.5} | changes
        scene = load_scene(base, changes)
        run, least, end = simulate(scene, duration_s=duration_s), float("inf"), time.monotonic() + 1.0
        content = b"".join(column.tobytes() for column in run.columns.values())
        while time.monotonic() < end:
            took_s = seconds(lambda scene=scene, s=duration_s: simulate(scene, duration_s=s), time.process_time)
            least = min(least, 1e6 * took_s / run.statistics["newton_iterations"])
        results[name] = least, hashlib.sha256(content).hexdigest()
    return results


def costs_in(folder, names):
    """`costs` in a process of its own, with the engine of that checkout."""
    command = [sys.executable, str(Path(__file__)), "--once", *names]
    process = subprocess.run(
        command,
        cwd=folder,
        env=os.environ | {"PYTHONPATH": str(folder)},
        capture_output=True,
        check=True,
    )
    return json.loads(process.stdout)


def beside_in_words(name, time_us, rounds):
    """The cost of a scene on the other checkout, and whether its columns are the same."""
    other_us = median(costs[name][0] for costs in rounds["beside"])
    equal = rounds["here"][0][name][1] == rounds["beside"][0][name][1]
    bits = "same bits" if equal else "OTHER NUMBERS"
    return f" {other_us:7.2f} us beside, ratio {time_us / other_us:.3f}, {bits}"


def main() -> None:
    options = parser(__doc__, 3)
    options.add_argument("--beside", metavar="CHECKOUT", type=Path, help="folder of another checkout")
    arguments = options.parse_args()
    print_load()
    calls = {"here": lambda: costs_in(HERE, [*SCENES, *WITH])}
    if arguments.beside is not None:
        calls["beside"] = lambda: costs_in(arguments.beside, [*SCENES])
    rounds = in_turns(calls, arguments.rounds)
    times_us = {name: median(costs[name][0] for costs in rounds["here"]) for name in SCENES | WITH}
    for name, time_us in times_us.items():
        kind, _, law = name.partition(", ")
        line = f"{name:24s} {time_us:7.2f} us"
        if law:
            line += f" {time_us / times_us[f'{kind}, no law']:5.2f} times that without"
        elif arguments.beside is not None:
            line += beside_in_words(name, time_us, rounds)
        print(line)
    print_load()


if __name__ == "__main__":
    if sys.argv[1:2] == ["--once"]:
        print(json.dumps(costs(sys.argv[2:])))
    else:
        main()
