"""How fast runs go side by side (`engine.simd`), against the same runs one by one, on one core and on two.

    python -m benchmarks.lanes_speed [--rounds N] [--periods N]

Sweep    the buoy at H = 21.6 m, 41 nodes, default tolerance; steepnesses evenly from 0.05 to 0.16, 48 of them, 40 wave
         periods each: without perturbations, and with those that a campaign of more than 40 periods carries.
Figure   wave periods a second and core: of processor time (`process_time`), and of wall time with two processes.
Noise    The settings take turns; medians over the rounds. Compilation and statics are outside the first figure, and
         one call before the clock starts keeps compilation out of the second.
Equal    every trajectory of the batch is compared with the run alone, bit for bit.
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


def batch(extra, periods, clock=time.process_time, steepness=STEEPNESS):
    """Wave periods a second of a batch, by that clock."""
    members, began = scenes(extra, steepness), clock()
    simulate_batch(members, periods=periods)
    return len(members) * periods / (clock() - began)


def alone(extra, periods):
    """The same of every sixth run alone."""
    members, began = scenes(extra, STEEPNESS[::6]), time.process_time()
    for scene in members:
        simulate(scene, periods=periods)
    return len(members) * periods / (time.process_time() - began)


def on_two(pool, extra, periods):
    """Wave periods a second of wall time by two processes, each with half of the steepnesses."""
    began = time.perf_counter()
    halves = [pool.submit(batch, extra, periods, steepness=STEEPNESS[half::2]) for half in range(2)]
    for half in halves:
        half.result()
    return len(STEEPNESS) * periods / (time.perf_counter() - began)


def equal(periods):
    """Are the batch's trajectories and growths those of the runs alone?"""
    for scene, run in zip(scenes(CARRIED), simulate_batch(scenes(CARRIED), periods=periods), strict=True):
        alone = simulate(scene, periods=periods)
        same = all(np.array_equal(alone.columns[name], run.columns[name]) for name in alone.columns)
        same &= np.array_equal(alone.tangent.growth_nats, run.tangent.growth_nats)
        same &= np.array_equal(alone.tangent.lateral_nats, run.tangent.lateral_nats)
        if not same:
            return False
    return True


def sweep(rounds, periods):
    for name, extra in (("without perturbations", {}), ("with two perturbations", CARRIED)):
        simulate_batch(scenes(extra)[:2], periods=0.1)
        simulate(scenes(extra)[0], periods=0.1)
        with ProcessPoolExecutor(2) as pool:
            on_two(pool, extra, 0.1)
            calls = {
                "one by one": partial(alone, extra, periods),
                "in a batch": partial(batch, extra, periods),
                "in a batch, wall": partial(batch, extra, periods, time.perf_counter),
                "by two processes, wall": partial(on_two, pool, extra, periods),
            }
            rates = {how: median(values) for how, values in in_turns(calls, rounds).items()}
        for how, rate in rates.items():
            print(f"{name}, {how}: {rate:.0f} wave periods a second, {rate / rates['one by one']:.2f} times one by one")


def main() -> None:
    options = parser(__doc__, 5)
    options.add_argument("--periods", type=float, default=40, help="length of the runs in wave periods (default 40)")
    given = options.parse_args()
    print_load()
    first = seconds(lambda: simulate_batch(scenes({})[:2], periods=0.1))
    print(f"first batch (compilation, or loading what is compiled): {first:.1f} s")
    sweep(given.rounds, given.periods)
    print(f"48 runs of 12 periods bit for bit those alone: {equal(12)}")
    print_load()


if __name__ == "__main__":
    main()
