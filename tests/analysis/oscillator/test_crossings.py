"""No crossing is missed: double crossings of any depth within one interval of the tables, grazing, rest."""

import numpy as np
import pytest

from analysis.oscillator import SnapOscillator, snap_motion, strobed_states
from analysis.oscillator.crossings import NONE, first_crossing
from analysis.oscillator.pieces import motion as piece
from analysis.oscillator.pieces import tables


def touching(depth, time, oscillator):
    """State at the strobe of the taut piece whose displacement has a minimum of -depth at `time`."""
    table = tables(oscillator)
    p0, w0 = table.steady[0, 1]
    c11, c12, c21, c22, q1, q2 = piece(1, time, table.theta[0], table.constants, p0, w0)
    return np.linalg.solve([[c11, c12], [c21, c22]], [-depth - q1, -q2])


@pytest.mark.parametrize("depth", [1e-1, 1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13])
@pytest.mark.parametrize("time", [1.7, 2.0301, 2.4999])
def test_double_crossings_of_any_depth_are_found(depth, time):
    # F = 0.2: the water pushes up (g'' > 0 near g = 0), so that the minimum is a minimum.
    oscillator = SnapOscillator(force=0.2)
    state = touching(depth, time, oscillator)
    if state[0] <= 0:
        pytest.skip("this start is slack")
    motion = snap_motion(oscillator, state, 1)
    first, second = motion.switches[:2]
    assert first < time < second + 1e-9
    # depth = g'' w^2/2 with g'' = lift + F sin(omega t) at a minimum on g = 0
    push = 0.68 + 0.2 * np.sin(1.14 * time)
    # (rounding of g, 3e-14 of terms of size 2, blurs the time of a crossing at a slope of 4e-7 by some 4e-7)
    assert np.isclose(time - first, np.sqrt(2 * depth / push), rtol=0.3, atol=5e-7)


@pytest.mark.parametrize("clearance", [1e-1, 1e-5, 1e-9, 1e-12])
def test_a_near_miss_is_no_crossing(clearance):
    oscillator = SnapOscillator(force=0.2)
    state = touching(-clearance, 2.0, oscillator)
    table = tables(oscillator)
    found = first_crossing(1, 0.0, state[0], state[1], 0, table)
    assert found == NONE or found > 2.5


def test_first_crossing_against_a_fine_scan():
    generator = np.random.default_rng(5)
    oscillator = SnapOscillator()
    for x, v in generator.normal(0.0, 3.0, (60, 2)):
        motion = snap_motion(oscillator, (x, v), 1, samples_per_period=20000)
        changes = np.flatnonzero(np.diff(np.sign(motion.displacement)))
        assert len(changes) == len(motion.switches)
        if len(changes):
            assert np.abs(motion.time[changes] - motion.switches).max() < oscillator.period / 15000


def test_displacement_is_zero_at_every_switch():
    oscillator = SnapOscillator()
    motion = snap_motion(oscillator, (0.68, 0.0), 50, samples_per_period=2000)
    for switch in motion.switches[:40]:
        # from the samples before it only: the third derivative jumps at the switch
        j = np.searchsorted(motion.time, switch)
        before = np.polynomial.Polynomial.fit(motion.time[j - 6 : j], motion.displacement[j - 6 : j], 5)
        assert abs(before(switch)) < 1e-10


@pytest.mark.parametrize(
    ("start", "lift"), [((0.0, 0.0), 0.68), ((0.0, 0.0), -0.3), ((0.0, 1.0), 0.0), ((0.0, -1.0), 0.0)]
)
def test_starts_on_the_switching_line_take_the_side_they_move_to(start, lift):
    motion = snap_motion(SnapOscillator(force=0.0, lift=lift), start, 1, samples_per_period=1000)
    side = np.sign(start[1]) or np.sign(lift)
    assert np.sign(motion.displacement[5]) == side
    assert len(motion.switches) == 0 or motion.switches[0] > 0.5


def test_rest_on_the_switching_line_stays_there():
    states = strobed_states(SnapOscillator(force=0.0, lift=0.0), (0.0, 0.0), 100)
    assert np.array_equal(states, np.zeros((100, 2)))
