"""Laws of runs whose sphere may leave the water: one that stays in it is the run of the whole sphere, bit for bit; a
mirrored wave gives the mirrored motion; a plane in space is the plane; runs side by side are the runs alone.
"""

import numpy as np
import pytest

from engine import goes_in_lanes, simulate, simulate_batch
from tests.engine.lines import line
from tests.engine.physics.caps import CAP
from tests.engine.simd.equal import assert_equal
from tests.engine.simd.test_batches import CARRIED
from tests.engine.time.test_symmetries import differences, mirror_images

LEAPING = CAP | {"waves.steepness": 0.13, "water.depth_m": 21.0}
ABOVE = ["extrapolate", "zero", "wheeler"]


@pytest.mark.parametrize("dimensions", [2, 3])
def test_a_buoy_that_stays_under_water_is_the_whole_sphere(dimensions):
    """Small waves over 25 m of water: its top stays below the troughs."""
    deep = {"water.depth_m": 25.0, "waves.steepness": 0.08, "tether.nodes": 21, "motion.dimensions": dimensions}
    run, other = simulate(line(deep, CAP), periods=6), simulate(line(deep), periods=6)
    assert run.status == other.status == "ok" and np.ptp(run.columns["x_m"]) > 1.0
    assert run.columns["z_m"].max() + 0.75 < 25.0 - 0.08 / 0.16
    for key, values in other.columns.items():
        assert np.array_equal(run.columns[key], values), key
    assert run.statistics["newton_iterations"] == other.statistics["newton_iterations"]


@pytest.mark.parametrize("option", ABOVE)
def test_a_mirrored_wave_gives_the_mirrored_motion(option):
    """While the line is taut: slack amplifies roundings."""
    crossing = CAP | {"waves.steepness": 0.02, "water.depth_m": 21.0, "waves.above_still_water": option}
    pair = mirror_images(crossing, periods=8)
    top = pair[0]["z_m"].max() + 0.75
    assert top > 21.2 and pair[0]["tension_min_N"].min() > 0
    lengths, tensions = differences(*pair, mirrored=True)
    assert lengths < 1e-11 and tensions < 1e-7


@pytest.mark.parametrize("option", ABOVE)
def test_a_motion_in_a_plane_is_the_same_in_space(option):
    """Through the first leaps; what slack makes of roundings is smaller by then than the tolerance of the steps."""
    changes = LEAPING | {"waves.above_still_water": option, "tether.nodes": 21, "solver.rtol": 1e-3}
    flat, space = (simulate(line(changes, {"motion.dimensions": d}), periods=3) for d in (2, 3))
    assert flat.status == space.status == "ok"
    assert flat.columns["z_m"].max() > 20.4
    for key in ("x_m", "z_m"):
        assert np.abs(flat.columns[key] - space.columns[key]).max() < 1e-5
    assert not space.columns["y_m"].any()


def test_waves_from_the_side_give_the_motion_turned():
    """Across x, in space: the surface over the buoy belongs to the direction of the waves."""
    changes = LEAPING | {"tether.nodes": 21, "motion.dimensions": 3, "solver.rtol": 1e-3}
    ahead, across = (simulate(line(changes, {"waves.direction_rad": a}), periods=3) for a in (0.0, np.pi / 2))
    for one, other in (("x_m", "y_m"), ("z_m", "z_m")):
        assert np.abs(ahead.columns[one] - across.columns[other]).max() < 1e-5


@pytest.mark.parametrize("option", ABOVE)
def test_a_lane_is_the_run_alone(option):
    base = LEAPING | {"waves.above_still_water": option, "tether.nodes": 11} | CARRIED
    scenes = [line(base, {"waves.steepness": kA}) for kA in (0.05, 0.13, 0.16)]
    assert all(goes_in_lanes(scene) for scene in scenes)
    for scene, run in zip(scenes, simulate_batch(scenes, duration_s=41.0), strict=True):
        assert run.status == "ok"
        assert_equal(run, simulate(scene, duration_s=41.0))
