"""Eq. (33) is integrated exactly: against integrations in 50 digits and by an adaptive Runge-Kutta method."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from analysis.oscillator import SnapOscillator, snap_motion, strobed_states
from tests.analysis.oscillator.exact import states

PAPER = SnapOscillator()


def test_states_after_one_and_ten_periods():
    # 20 digits, from an independent computation
    section = strobed_states(PAPER, (0.68, 0.0), 11)
    assert np.abs(section[1] - [-3.55986388534503379680, -3.15377852305124935959]).max() < 1e-12
    assert np.abs(section[10] - [-20.3682913974351795585, -2.33939200511708733634]).max() < 1e-11


@pytest.mark.parametrize(
    ("oscillator", "start"),
    [
        (PAPER, (0.68, 0.0)),
        (SnapOscillator(phase=1.0), (-3.0, 2.0)),
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


def test_motion_between_strobes_against_runge_kutta():
    motion = snap_motion(PAPER, (0.68, 0.0), 3, samples_per_period=50)

    def rates(t, y):
        return [y[1], 1.4 * np.sin(1.14 * t) + 0.68 - 0.025 * y[1] - max(y[0], 0.0)]

    other = solve_ivp(
        rates, (0, motion.time[-1]), (0.68, 0), "DOP853", motion.time, rtol=1e-12, atol=1e-12, max_step=0.01
    )
    assert np.abs(motion.displacement - other.y[0]).max() < 1e-8
    assert np.abs(motion.velocity - other.y[1]).max() < 1e-8


def test_always_taut_is_the_linear_response():
    oscillator = SnapOscillator(force=0.15, phase=0.4)
    steady = strobed_states(oscillator, (0.6, 0.0), 1, transient_periods=3000)[0]
    response = (
        0.15 / (1 - 1.14**2 + 0.025j * 1.14) * np.exp(0.4j)
    )  # of F exp(i (omega t + phase)), imaginary part taken
    assert np.allclose(steady, [0.68 + response.imag, (1.14j * response).imag], rtol=0, atol=1e-12)
    assert snap_motion(oscillator, steady, 5).slack_fraction == 0.0


def test_always_slack_is_a_forced_particle_with_drag():
    oscillator = SnapOscillator(damping=0.2, lift=-0.5)
    motion = snap_motion(oscillator, (-5.0, 0.0), 200)
    terminal = (motion.displacement[-1] - motion.displacement[-65]) / oscillator.period
    assert motion.slack_fraction == pytest.approx(1.0, abs=1e-13)
    assert np.isclose(terminal, -0.5 / 0.2, rtol=1e-9)


def test_sampling_changes_no_state_and_no_switch():
    coarse, fine = (snap_motion(PAPER, (0.68, 0.0), 20, samples_per_period=n) for n in (1, 97))
    assert np.array_equal(coarse.displacement, fine.displacement[::97])
    assert np.array_equal(coarse.switches, fine.switches)


def test_shifting_time_by_part_of_a_period_shifts_the_section():
    # State at t = T/4 from phase 0 is a start at phase pi/2: both must go on alike.
    quarter = snap_motion(PAPER, (0.68, 0.0), 1, samples_per_period=4)
    start = quarter.displacement[1], quarter.velocity[1]
    shifted = snap_motion(SnapOscillator(phase=np.pi / 2), start, 3, samples_per_period=4)
    straight = snap_motion(PAPER, (0.68, 0.0), 4, samples_per_period=4)
    assert np.abs(shifted.displacement - straight.displacement[1:14]).max() < 1e-11


@pytest.mark.parametrize(
    "numbers",
    [{"damping": -0.1}, {"damping": 2.0}, {"frequency": 0.0}, {"force": -1.0}, {"lift": np.nan}, {"phase": np.inf},
     {"damping": 0.0, "frequency": 1.0}],
)  # fmt: skip
def test_numbers_without_a_meaning_are_refused(numbers):
    with pytest.raises(ValueError, match=next(iter(numbers))):
        SnapOscillator(**numbers)


def test_a_start_that_is_not_finite_is_refused():
    with pytest.raises(ValueError, match="start"):
        strobed_states(PAPER, (np.nan, 0.0), 5)
