"""What an irregular sea costs beside a regular wave: ms of processor time a wave period, alone and in lanes.

    python -m benchmarks.sea_speed [--rounds N] [--periods N]

The buoy with the wetted cap, H = 22.5 m, 41 nodes, defaults. Seas: JONSWAP, H_s 1.6 m, T_p 5 s, seeds 1 to 16. The
regular waves have kA from 0.10 to 0.13. Settings take turns; medians over the rounds, and the ratio to the regular wave
of the same round. Compilation is outside.
"""

import time
from functools import partial
from statistics import median

import numpy as np

from benchmarks.shared import in_turns, parser, print_load, seconds
from engine import load_scene, simulate, simulate_batch

BUOY = {"water.depth_m": 22.5, "buoy.submergence": "spherical-cap"}
RUNS = 16
TANGENT = {"output.tangent_vectors": 1}
WHEELER = {"waves.above_still_water": "wheeler"}


def regular(extra):
    steepness = np.linspace(0.10, 0.13, RUNS)
    return [load_scene("tethered_buoy", BUOY | extra | {"waves.steepness": float(value)}) for value in steepness]


def seas(extra, components=64):
    scenes = []
    for seed in range(1, RUNS + 1):
        jonswap = {"significant_height_m": 1.6, "components": components, "seed": seed}
        scenes.append(load_scene("tethered_buoy", BUOY | extra | {"waves.period_s": 5.0, "waves.jonswap": jonswap}))
    return scenes


def alone(scenes, periods):
    for scene in scenes[:4]:
        simulate(scene, periods=periods)
    return 4


def in_lanes(scenes, periods):
    simulate_batch(scenes, periods=periods)
    return len(scenes)


def cost(work, scenes, periods):
    """ms a wave period."""
    runs = []
    taken_s = seconds(lambda: runs.append(work(scenes, periods)), time.process_time)
    return 1e3 * taken_s / (runs[0] * periods)


def main() -> None:
    options = parser(__doc__, 3)
    options.add_argument("--periods", type=int, default=40, help="length of the runs in wave periods (default 40)")
    arguments = options.parse_args()
    print_load()
    kinds = {
        "regular": regular({}),
        "regular, a tangent vector": regular(TANGENT),
        "sea of 64 waves": seas({}),
        "sea of 256 waves": seas({}, 256),
        "sea of 64 waves, a tangent vector": seas(TANGENT),
        "the same, Wheeler": seas(WHEELER),
        "the same, Wheeler, a tangent vector": seas(WHEELER | TANGENT),
    }
    for name, work in (("alone", alone), ("in lanes", in_lanes)):
        calls = {}
        for kind, scenes in kinds.items():
            work(scenes, 1)
            calls[kind] = partial(cost, work, scenes, arguments.periods)
        costs = in_turns(calls, arguments.rounds)
        for kind, values in costs.items():
            ratios = [value / usual for value, usual in zip(values, costs["regular"], strict=True)]
            print(
                f"{name:8s} {median(values):7.2f} ms a period, {median(ratios):5.2f} times regular: {kind}", flush=True
            )
    print_load()


if __name__ == "__main__":
    main()
