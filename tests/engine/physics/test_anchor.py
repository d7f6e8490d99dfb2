"""Law: what a line does is told from its anchor; where the anchor is changes only the water that it meets.

An anchor at x along the waves is the same wave at the phase - k x; an anchor at height z above the bed is the same
current z lower. A buoy that the line cannot hold under water is refused, one that it can hold is not.
"""

import numpy as np
import pytest

from engine import simulate
from engine.physics.waves import wave_number
from tests.engine.lines import STILL, held, kick, line, ran
from tests.engine.physics.caps import CAP

WAVES = {"waves.steepness": 0.05, "waves.ramp_s": 5.0}
PROFILE = {"law": "profile", "height_m": [0.0, 40.0], "velocity_mps": [[0.1, 0.0, 0.0], [0.9, 0.0, 0.0]]}
LOWER = {"law": "profile", "height_m": [-12.0, 28.0], "velocity_mps": [[0.1, 0.0, 0.0], [0.9, 0.0, 0.0]]}
TIGHT = {"solver.rtol": 1e-3, "solver.newton_tolerance": 1e-10}


def tensions(scene):
    columns = ran(scene, duration_s=6.0).columns
    return np.array([columns[name] for name in ("x_m", "z_m", "radius_m", "tension_top_N")])


@pytest.mark.parametrize("end", [{}, held(6.0, 17.0), CAP], ids=["buoy", "held", "cap"])
def test_along_the_waves_it_is_a_phase(dimensions, end):
    common = {**WAVES, **TIGHT, **end, "motion.dimensions": dimensions}
    k = wave_number(5.0, 21.0)
    moved = tensions(line(common, {"anchor.position_m": [7.0, 0.0, 0.0]}, nodes=9))
    assert moved == pytest.approx(tensions(line(common, {"waves.phase_rad": k * 7.0}, nodes=9)), rel=1e-5, abs=1e-4)


def test_above_the_bed_it_meets_what_flows_there(dimensions):
    common = {"waves": None, **TIGHT, "motion.dimensions": dimensions}
    shifts = [{"anchor.position_m": [0.0, 0.0, 12.0], "water.depth_m": 33.0, "current": PROFILE}, {"current": LOWER}]
    high, low = (tensions(line(common, shift, kick(1.0), nodes=9)) for shift in shifts)
    np.testing.assert_allclose(high, low, rtol=1e-6, atol=1e-6)


def lowest_point(anchor_m):
    """Of the sphere at rest, m: the linear line holds it l0 (1 + (B - W - w0 l0/2)/EA) - D/2 above its anchor."""
    lift = (1027.0 * np.pi * 1.5**3 / 6 - 1611.0) * 9.81
    weight = (1140.0 - 1027.0) * 7.85e-5 * 20.0 * 9.81
    return anchor_m + 20.0 * (1 + (lift - weight / 2) / 5e4) - 0.75


@pytest.mark.parametrize("anchor_m", [0.0, 11.0])
@pytest.mark.parametrize("cap, dry_m, warned", [({}, 0.076, True), ({}, 0.074, False), (CAP, 0.076, False)])
def test_a_run_says_that_a_twentieth_of_its_buoy_is_out_of_the_water(cap, dry_m, warned, anchor_m):
    place = {"anchor.position_m": [0.0, 0.0, anchor_m], "water.depth_m": lowest_point(anchor_m) + 1.5 - dry_m}
    run = simulate(line(STILL, place, cap, nodes=5), duration_s=0.1)
    assert ("spherical-cap" in run.message) == warned, run.message
