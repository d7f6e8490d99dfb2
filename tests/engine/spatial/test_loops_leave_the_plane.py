"""Law: kA = 0.13, a push of 1e-5 m/s. The rope opens its loops out of the plane by itself, with a limit in the mesh.

In the plane the same scenes need a loop release every four periods or so. Two runs of 200 periods on 161 nodes and four
short ones: a quarter of a minute.
"""

import math

import numpy as np
import pytest

from engine import load_scene, simulate

PUSHED = {"waves.steepness": 0.13, "motion.dimensions": 3, "start.buoy_velocity_mps": [0.0, 1e-5, 0.0]}
REPORTED_NODES = 161
FIRST_LOOP_PERIODS = 14  # the first loop is over by then at both depths


def pushed(depth_m, nodes, periods):
    run = simulate(load_scene("tethered_buoy", {**PUSHED, "water.depth_m": depth_m, "tether.nodes": nodes}), periods)
    assert run.status == "ok", run.message
    assert run.statistics["loop_releases"] == 0
    return run


def first_loop_m(run):
    """Largest lateral distance of the rope in the wave period after it first stands 5 cm off the plane."""
    off, time = run.columns["offplane_m"], run.columns["time_s"]
    start = int(np.argmax(off > 0.05))
    assert off[start] > 0.05 and time[start] < FIRST_LOOP_PERIODS * 5.0
    return off[(time >= time[start]) & (time < time[start] + 5.0)].max()


@pytest.mark.slow
@pytest.mark.parametrize("depth_m", [21.6, 22.0])
def test_loops_open_by_themselves_and_their_size_has_a_limit_in_the_mesh(depth_m):
    fine = pushed(depth_m, REPORTED_NODES, 200)
    assert fine.statistics["max_turn_rad"] < 0.5 * math.pi
    assert np.abs(fine.columns["y_m"]).max() < 0.05 < 0.1 < fine.columns["offplane_m"].max()
    sizes = [first_loop_m(pushed(depth_m, nodes, FIRST_LOOP_PERIODS)) for nodes in (41, 81)]
    sizes.append(first_loop_m(fine))
    assert max(sizes) < 1.2 * min(sizes), sizes
