"""What a wave period costs alone and side by side (`engine.simd`), on one core and two, in regular waves and in seas.

    python -m benchmarks.lanes_speed [--rounds N] [--periods N]

Sweep    the buoy at H = 21.6 m, 41 nodes, default tolerance; steepnesses evenly from 0.05 to 0.16, 48 of them: without
         perturbations, and with those that a campaign of more than 40 periods carries.
Seas     the buoy with the wetted cap, H = 22.5 m: JONSWAP, H_s 1.6 m, T_p 5 s, seeds 1 to 16; beside them 16 regular
         waves with kA from 0.10 to 0.13.
Figure   ms a wave period: of processor time (`process_time`), and of wall time with two processes. Alone goes every
         sixth run.
Noise    The settings take turns; medians over the rounds. Compilation is outside: of every setting a short call comes
         before the clock starts.
"""

import time
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from statistics import median

import numpy as np

from benchmarks.shared import in_turns, parser, print_load, seconds
from engine import load_scene, simulate, simulate_batch

BUOY = {"water.depth_m": 22.5, "buoy.submergence": "spherical-cap"}
TANGENT = {"output.tangent_vectors": 1}
WHEELER = {"waves.above_still_water": "wheeler"}
RUNS = 16
REGULAR = "regular wave, wetted cap"


def regular(keys, steepness):
    return [load_scene("tethered_buoy", keys | {"waves.steepness": float(value)}) for value in steepness]


def seas(extra, components=64):
    scenes = []
    for seed in range(1, RUNS + 1):
        jonswap = {"significant_height_m": 1.6, "components": components, "seed": seed}
        scenes.append(load_scene("tethered_buoy", BUOY | extra | {"waves.period_s": 5.0, "waves.jonswap": jonswap}))
    return scenes


def alone(scenes, periods):
    for scene in scenes:
        simulate(scene, periods=periods)


def in_lanes(scenes, periods):
    simulate_batch(scenes, periods=periods)


def by_two(pool, scenes, periods):
    list(pool.map(partial(in_lanes, periods=periods), (scenes[::2], scenes[1::2])))


def cost(work, clock, scenes, periods):
    """ms a wave period by that clock."""
    return 1e3 * seconds(partial(work, scenes, periods), clock) / (len(scenes) * periods)


def main() -> None:
    options = parser(__doc__, 3)
    options.add_argument("--periods", type=float, default=40, help="length of the runs in wave periods (default 40)")
    arguments = options.parse_args()
    print_load()
    sweep, moderate = np.linspace(0.05, 0.16, 48), np.linspace(0.10, 0.13, RUNS)
    kinds = {
        "sweep": regular({"water.depth_m": 21.6}, sweep),
        "sweep, two perturbations": regular({"water.depth_m": 21.6, "output.lateral_growth": True} | TANGENT, sweep),
        REGULAR: regular(BUOY, moderate),
        "regular wave, a tangent vector": regular(BUOY | TANGENT, moderate),
        "sea of 64 waves": seas({}),
        "sea of 256 waves": seas({}, 256),
        "sea of 64 waves, a tangent vector": seas(TANGENT),
        "the same, Wheeler": seas(WHEELER),
        "the same, Wheeler, a tangent vector": seas(WHEELER | TANGENT),
    }
    with ProcessPoolExecutor(2) as pool:
        calls = {}
        for kind, scenes in kinds.items():
            for way, work, clock, members in (
                ("alone", alone, time.process_time, scenes[::6]),
                ("in lanes", in_lanes, time.process_time, scenes),
                ("in lanes, wall", in_lanes, time.perf_counter, scenes),
                ("two processes, wall", partial(by_two, pool), time.perf_counter, scenes),
            ):
                work(members, 0.1)
                calls[kind, way] = partial(cost, work, clock, members, arguments.periods)
        costs = {setting: median(values) for setting, values in in_turns(calls, arguments.rounds).items()}
    for (kind, way), cost_ms in costs.items():
        gain, ratio = costs[kind, "alone"] / cost_ms, cost_ms / costs[REGULAR, way]
        speed = f"{cost_ms:7.2f} ms, {1e3 / cost_ms:5.0f} periods a second, {gain:.2f} times as fast as alone"
        print(f"{speed}, {ratio:.2f} times a {REGULAR}: {kind}, {way}")
    print_load()


if __name__ == "__main__":
    main()
