"""Law: the motion shares the symmetries of its equations.

Mirror x -> -x: a wave from the other side, with currents and start velocities mirrored, gives the mirrored motion. The
kernels do the same arithmetic with other signs, so only sines and cosines of other angles round differently: near
rounding (1e-12 m) for the regular case for 20 periods, and for the violent one (kA = 0.13, H = 21.6) until the tether
first goes slack. Slack amplifies roundings, to 4 mm in 50 s at such depths.

Time: an established motion repeats with the wave, and a wave earlier by a quarter
period gives the same motion a quarter period earlier. Both on steps that fit the period, and with a strong drag on the
buoy that ends the starting motion (fallen to 1e-11 m after 60 periods, measured by the repetition itself).
"""

import numpy as np
import pytest

from engine import simulate
from tests.engine.lines import line

CALM = {"waves.steepness": 0.016, "water.depth_m": 22.5}
VIOLENT = {"waves.steepness": 0.13, "water.depth_m": 21.6}
SHEAR = {"law": "profile", "height_m": [0.0, 22.0]}
ODD = ["x_m", "angle_rad", "angle_rate_radps"]
EVEN = ["z_m", "radius_m", "radius_rate_mps"]
TENSIONS = ["tension_top_N", "tension_min_N", "tension_top_low_N", "tension_top_high_N"]


def columns(*parts, periods):
    run = simulate(line(*parts), periods=periods)
    assert run.status == "ok"
    return run.columns


def differences(one, other, mirrored, until_s=np.inf):
    """Largest difference of lengths, angles and rates; and of tensions, N."""
    soon = one["time_s"] <= until_s
    sign = -1 if mirrored else 1
    shape = [np.abs(one[key] - sign * other[key])[soon].max() for key in ODD]
    shape += [np.abs(one[key] - other[key])[soon].max() for key in EVEN]
    return max(shape), max(np.abs(one[key] - other[key])[soon].max() for key in TENSIONS)


def mirror_images(*parts, periods):
    def side(sign):
        current = {**SHEAR, "velocity_mps": [[0.0, 0.0, 0.0], [0.2 * sign, 0.0, 0.0]]}
        return {
            "waves.direction_rad": 0.0 if sign > 0 else np.pi,
            "start.buoy_velocity_mps": [0.1 * sign, 0.0, 0.05],
            "current": current,
        }

    return [columns(*parts, side(sign), periods=periods) for sign in (1, -1)]


@pytest.mark.parametrize("option", ["extrapolate", "zero", "wheeler"])
def test_a_mirrored_wave_gives_the_mirrored_motion(option):
    pair = mirror_images(CALM, {"waves.above_still_water": option}, periods=20)
    assert np.ptp(pair[0]["x_m"]) > 0.1
    lengths, tensions = differences(*pair, mirrored=True)
    assert lengths < 1e-12
    assert tensions < 1e-8


def test_the_mirror_holds_through_slack_to_the_growth_of_roundings():
    pair = mirror_images(VIOLENT, periods=10)
    slack = np.flatnonzero(pair[0]["tension_min_N"] < 0)
    assert slack.size > 50
    lengths, tensions = differences(*pair, mirrored=True, until_s=pair[0]["time_s"][slack[0]])
    assert lengths < 1e-12 and tensions < 1e-8
    lengths, _ = differences(*pair, mirrored=True)
    assert lengths < 4e-3


@pytest.fixture(scope="module")
def established():
    """60 periods of a strongly damped buoy on steps of T/500, under waves a quarter period apart."""
    steps = {"solver.step_s": 0.01, "solver.newton_tolerance": 1e-9, "waves.ramp_s": 10.0, "buoy.drag": 20.0}
    return [columns(CALM, steps, {"waves.phase_rad": phase}, periods=60) for phase in (0.0, -np.pi / 2)]


def test_an_established_motion_repeats_with_the_wave(established):
    motion = established[0]
    assert np.ptp(motion["x_m"][-101:]) > 0.1
    for key in ODD + EVEN:
        assert np.max(np.abs(motion[key][-101:] - motion[key][-201:-100])) < 1e-11


def test_an_earlier_wave_gives_the_same_motion_earlier(established):
    motion, early = established
    for key in ODD + EVEN:
        assert np.max(np.abs(early[key][-151:-50] - motion[key][-126:-25])) < 1e-11
