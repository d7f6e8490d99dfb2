"""Eq. (33) is integrated exactly: against 50 digits, closed forms and symmetries; and no crossing is missed.

The 50 digits share nothing with the package: Taylor series, bisection.
"""

import numpy as np
import pytest
from mpmath import mp, mpf

from analysis.oscillator import SnapOscillator, snap_motion, strobed_states, strobed_states_within
from analysis.oscillator.crossings import NONE, first_crossing
from analysis.oscillator.pieces import motion as piece
from analysis.oscillator.pieces import tables

PAPER = SnapOscillator()
REST = (0.68, 0.0)


@pytest.mark.parametrize(
    ("oscillator", "start"),
    [
        (PAPER, REST),
        (SnapOscillator(phase=1.0), (-3.0, 2.0)),
        (SnapOscillator(damping=0.2, lift=-0.5), (-5.0, 0.0)),
        (SnapOscillator(force=0.15, phase=0.4), REST),
        (SnapOscillator(damping=0.3, frequency=0.31, force=2.0, lift=0.1), (-1.0, -0.5)),
        (SnapOscillator(damping=0.0, frequency=0.8, force=0.5, lift=0.9), (2.0, 0.0)),
        pytest.param(
            SnapOscillator(damping=1.5, frequency=2.7, force=8.0, lift=0.4), (0.3, 4.0), marks=pytest.mark.slow
        ),
    ],
)
def test_states_and_switches_against_fifty_digits(oscillator, start):
    wanted, switches = states(oscillator, start, 4)
    motion = snap_motion(oscillator, start, 4)
    got = strobed_states(oscillator, start, 5)[1:]
    assert np.abs(got - wanted).max() < 2e-12 * max(1.0, np.abs(wanted).max())
    assert len(motion.switches) == len(switches)
    assert np.abs(motion.switches - switches).max(initial=0.0) < 1e-11
    spans = np.diff([0.0, *switches, 4 * oscillator.period])  # taut and slack in turn
    slack_time = spans[int(start[0] > 0) :: 2].sum()
    assert motion.slack_fraction == pytest.approx(slack_time / (4 * oscillator.period), abs=1e-12)


def test_sampling_changes_no_state_and_no_switch():
    coarse, fine = (snap_motion(PAPER, REST, 20, samples_per_period=n) for n in (1, 97))
    assert np.array_equal(coarse.displacement, fine.displacement[::97])
    assert np.array_equal(coarse.switches, fine.switches)


def test_zoom_points_lie_in_their_boxes_and_on_the_orbit():
    boxes = [[-5.0, 0.0, -4.0, 0.0], [50.0, 60.0, 0.0, 1.0]]
    (inside, empty), seen = strobed_states_within(PAPER, REST, boxes, 30, 2000)
    section = strobed_states(PAPER, REST, 2000)
    wanted = section[(np.abs(section[:, 0] + 2.5) <= 2.5) & (np.abs(section[:, 1] + 2.0) <= 2.0)][:30]
    assert np.array_equal(inside, wanted)
    assert len(empty) == 0 and seen == 2000
    _, seen = strobed_states_within(PAPER, REST, boxes[:1], 30, 2000)
    assert np.array_equal(section[seen - 1], inside[-1])


# F = 0.2: the water pushes up (g'' > 0 near g = 0), so that the minimum of a taut piece is a minimum.
GENTLE = SnapOscillator(force=0.2)


def touching(depth, time):
    """State at the strobe of the taut piece whose displacement has a minimum of -depth at `time`."""
    table = tables(GENTLE)
    p0, w0 = table.steady[0, 1]
    c11, c12, c21, c22, q1, q2 = piece(1, time, table.theta[0], table.constants, p0, w0)
    return np.linalg.solve([[c11, c12], [c21, c22]], [-depth - q1, -q2])


@pytest.mark.parametrize("depth", [1e-1, 1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13])
@pytest.mark.parametrize("time", [1.7, 2.0301, 2.4999])
def test_double_crossings_of_any_depth_are_found(depth, time):
    state = touching(depth, time)
    assert state[0] > 0, "a taut start"
    first, second = snap_motion(GENTLE, state, 1).switches[:2]
    assert first < time < second + 1e-9
    # depth = g'' w^2/2 with g'' = lift + F sin(omega t) at a minimum on g = 0
    push = 0.68 + 0.2 * np.sin(1.14 * time)
    # (rounding of g, 3e-14 of terms of size 2, blurs the time of a crossing at a slope of 4e-7 by some 4e-7)
    assert np.isclose(time - first, np.sqrt(2 * depth / push), rtol=0.3, atol=5e-7)


@pytest.mark.parametrize("clearance", [1e-1, 1e-5, 1e-9, 1e-12])
def test_a_near_miss_is_no_crossing(clearance):
    result = first_crossing(1, 0.0, *touching(-clearance, 2.0), 0, tables(GENTLE))
    assert result == NONE or result > 2.5


@pytest.mark.parametrize(
    ("start", "lift"),
    [((0.0, 0.0), 0.68), ((0.0, 0.0), -0.3), ((0.0, 1.0), 0.0), ((0.0, -1.0), 0.0)],
)
def test_starts_on_the_switching_line_take_the_side_they_move_to_(start, lift):
    motion = snap_motion(SnapOscillator(force=0.0, lift=lift), start, 1, samples_per_period=1000)
    side = np.sign(start[1]) or np.sign(lift)
    assert np.sign(motion.displacement[5]) == side
    assert len(motion.switches) == 0 or motion.switches[0] > 0.5


def test_rest_on_the_switching_line_stays_there():
    assert not strobed_states(SnapOscillator(force=0.0, lift=0.0), (0.0, 0.0), 100).any()


DIGITS = 50
ORDER, STEPS = 40, 48


def taylor(a, t, x, v, o):
    """Taylor coefficients of g at time t on a piece, from the recurrence of the differential equation."""
    mu, omega, force, lift = (mpf(repr(n)) for n in (o.damping, o.frequency, o.force, o.lift))
    phase = mpf(repr(o.phase))
    c = [mpf(x), mpf(v)]
    for n in range(ORDER):
        forcing = force * omega**n * mp.sin(omega * t + phase + n * mp.pi / 2) / mp.factorial(n) + (
            lift if n == 0 else 0
        )
        c.append((forcing - mu * (n + 1) * c[n + 1] - a * c[n]) / ((n + 1) * (n + 2)))
    return c


def value(c, h):
    return mp.polyval(c[::-1], h), mp.polyval([n * c[n] for n in range(len(c) - 1, 0, -1)], h)


def states(o, start, periods):
    """States after 1 ... periods forcing periods, and the switching times. A switch is where g changes sign between the
    ends of a (small) step, so the start must be one that does not graze."""
    with mp.workdps(DIGITS):
        x, v = (mpf(repr(float(entry))) for entry in start)
        period = 2 * mp.pi / mpf(repr(o.frequency))
        result, switches = [], []
        a = 1 if x > 0 or (x == 0 and v > 0) else 0
        for n in range(periods):
            t, end = n * period, (n + 1) * period
            while t < end:
                h = min(period / STEPS, end - t)
                c = taylor(a, t, x, v, o)
                g, u = value(c, h)
                if (g > 0) != (a == 1):
                    low, high = mpf(0), h
                    for _ in range(150):
                        middle = (low + high) / 2
                        low, high = (middle, high) if (value(c, middle)[0] > 0) == (a == 1) else (low, middle)
                    h = high
                    g, u = value(c, h)
                    g, a = mpf(0), 1 - a
                    switches.append(float(t + h))
                x, v, t = g, u, t + h
                if abs(end - t) < mpf(10) ** (-DIGITS + 10):
                    break
            result.append((float(x), float(v)))
        return result, switches
