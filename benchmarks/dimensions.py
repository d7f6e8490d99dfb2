"""What the third dimension costs: milliseconds per wave period in space and in the plane, side by side on one core.

The same scene, tolerance, grid and length of run; plane and space in turns, medians over the rounds, ratio of each
round.    python -m benchmarks.dimensions
"""

import statistics

from engine import load_scene, simulate

ROUNDS, PERIODS = 9, 40
WORKS = {
    "kA 0.016, H 22.5 m": {"waves.steepness": 0.016, "water.depth_m": 22.5},
    "kA 0.13,  H 22.5 m": {"waves.steepness": 0.13, "water.depth_m": 22.5},
    "kA 0.13,  H 21.6 m": {"waves.steepness": 0.13, "water.depth_m": 21.6},
    "the same, 161 nodes": {"waves.steepness": 0.13, "water.depth_m": 21.6, "tether.nodes": 161},
}
SEED = {"motion.dimensions": 3, "start.buoy_velocity_mps": [0.0, 1e-5, 0.0]}


def milliseconds(scene):
    """Per wave period, and microseconds per Newton iteration."""
    found = simulate(scene, periods=PERIODS)
    assert found.status == "ok", found.message
    wall, iterations = found.statistics["wall_s"], found.statistics["newton_iterations"]
    return 1e3 * wall / PERIODS, 1e6 * wall / iterations


def main():
    for name, changes in WORKS.items():
        plane, space = load_scene("tethered_buoy", changes), load_scene("tethered_buoy", {**changes, **SEED})
        milliseconds(plane), milliseconds(space)
        pairs = [(milliseconds(plane), milliseconds(space)) for _ in range(ROUNDS)]
        plane_ms, plane_us, space_ms, space_us = (
            statistics.median(one[i][j] for one in pairs) for i in range(2) for j in range(2)
        )
        ratio = statistics.median(two[0] / one[0] for one, two in pairs)
        print(
            f"{name}: {plane_ms:6.2f} and {space_ms:6.2f} ms per period, {ratio:4.2f} times; "
            f"per iteration {plane_us:.2f} and {space_us:.2f} us"
        )


if __name__ == "__main__":
    main()
