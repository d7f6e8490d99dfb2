"""How fast runs go side by side (`engine.simd`), against the same runs one by one, on one core and on two.

    python -m benchmarks.lanes_speed [--rounds N] [--periods N]

Sweep    the buoy at H = 21.6 m, 41 nodes, default tolerance; steepnesses evenly from 0.05 to 0.16, 48 of them, 40 wave
         periods each: without perturbations, and with those that a campaign of more than 40 periods carries.
Figure   wave periods a second and core: of processor time (`process_time`), and of wall time with two processes.
Noise    The settings take turns; medians over the rounds. Compilation and statics are outside the first figure, and
         one call before the clock starts keeps compilation out of the second.
"""

import time
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from statistics import median

import numpy as np

from benchmarks.shared import in_turns, parser, print_load, seconds
from engine import load_scene, simulate, simulate_batch

STEEPNESS = np.linspace(0.05, 0.16, 48)
WATER = {"water.depth_m": 21.6}
CARRIED = {"output.tangent_vectors": 1, "output.lateral_growth": True}


def scenes(extra, steepness=STEEPNESS):
    return [load_scene("tethered_buoy", WATER | extra | {"waves.steepness": float(value)}) for value in steepness]


def rate(call, members, periods, clock):
    """Wave periods a second of call(members) by that clock."""
    return len(members) * periods / seconds(partial(call, members), clock)


def one_by_one(members, periods):
    for scene in members:
        simulate(scene, periods=periods)


def half(extra, periods, number):
    """Every second run of the sweep, in a process of its own."""
    simulate_batch(scenes(extra, STEEPNESS[number::2]), periods=periods)


def sweep(rounds, periods):
    for name, extra in (("without perturbations", {}), ("with two perturbations", CARRIED)):
        members = scenes(extra)
        batch = partial(simulate_batch, periods=periods)
        simulate_batch(members[:8], periods=0.1)
        simulate(members[0], periods=0.1)
        with ProcessPoolExecutor(2) as pool:
            list(pool.map(partial(half, extra, 0.1), range(2)))
            on_two = lambda _: list(pool.map(partial(half, extra, periods), range(2)))  # noqa: B023, E731
            calls = {
                "one by one": (partial(one_by_one, periods=periods), members[::6], periods, time.process_time),
                "in a batch": (batch, members, periods, time.process_time),
                "in a batch, wall": (batch, members, periods, time.perf_counter),
                "by two processes, wall": (on_two, members, periods, time.perf_counter),
            }
            rates = in_turns({setting: partial(rate, *call) for setting, call in calls.items()}, rounds)
        single_rate = median(rates["one by one"])
        for setting, values in rates.items():
            batch_rate = median(values)
            ratio = batch_rate / single_rate
            print(f"{name}, {setting}: {batch_rate:.0f} wave periods a second, {ratio:.2f} times one by one")


def main() -> None:
    options = parser(__doc__, 5)
    options.add_argument("--periods", type=float, default=40, help="length of the runs in wave periods (default 40)")
    arguments = options.parse_args()
    print_load()
    first = seconds(lambda: simulate_batch(scenes({})[:8], periods=0.1))
    print(f"first batch (compilation, or loading what is compiled): {first:.1f} s")
    sweep(arguments.rounds, arguments.periods)
    print_load()


if __name__ == "__main__":
    main()
