"""Law: the motion shares the symmetry of its equations in time: an established motion repeats with the wave, and a wave
earlier by a quarter period gives the same motion a quarter period earlier.

Both on steps that fit the period, and with a strong drag on the buoy that ends the starting motion (fallen to 1e-11 m
after 60 periods, measured by the repetition itself). Turns and mirrors: `test_frame_indifference`.
"""

import numpy as np
import pytest

from engine import simulate
from tests.engine.lines import line

CALM = {"waves.steepness": 0.016, "water.depth_m": 22.5}
KEYS = ["x_m", "angle_rad", "angle_rate_radps", "z_m", "radius_m", "radius_rate_mps"]


def columns(*parts, periods):
    run = simulate(line(*parts), periods=periods)
    assert run.status == "ok"
    return run.columns


@pytest.fixture(scope="module")
def established():
    """60 periods of a strongly damped buoy on steps of T/500, under waves a quarter period apart."""
    steps = {"solver.step_s": 0.01, "solver.newton_tolerance": 1e-9, "waves.ramp_s": 10.0, "buoy.drag": 20.0}
    return [columns(CALM, steps, {"waves.phase_rad": phase}, periods=60) for phase in (0.0, -np.pi / 2)]


def test_an_established_motion_repeats_with_the_wave(established):
    motion = established[0]
    assert np.ptp(motion["x_m"][-101:]) > 0.1
    for key in KEYS:
        assert np.max(np.abs(motion[key][-101:] - motion[key][-201:-100])) < 1e-11


def test_an_earlier_wave_gives_the_same_motion_earlier(established):
    motion, early = established
    for key in KEYS:
        assert np.max(np.abs(early[key][-151:-50] - motion[key][-126:-25])) < 1e-11
