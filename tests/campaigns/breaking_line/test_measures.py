"""Law: measured on the exact motion itself, speeds, shocks and errors are those of theory.

The profiles are of the characteristics with a fitted shock, at 801 places every half millisecond (3201 places, 120
times up to the birth of a shock): what is left is their interpolation and the extrapolation of the measures.
"""

from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest

from campaigns.breaking_line import motion_measures as measures
from tests.engine.physics.breaking import CASES, theory

LENGTH = 60.0
SHOCKED = ("3", "4", "4p")


def exact_profiles(case, times, nodes=801):
    s = np.linspace(0.0, LENGTH, nodes)
    states = [theory(case).motion.at(s, float(t)) for t in times]
    strain, speed, tension = (np.array([state[i] for state in states]) for i in range(3))
    return SimpleNamespace(time_s=np.asarray(times), s_m=s, strain=strain, tension_N=tension, speed_mps=np.abs(speed))


@cache
def whole(case):
    return exact_profiles(case, np.arange(0.0, theory(case).arrival_s, 5e-4))


@pytest.mark.parametrize("case", CASES)
def test_the_exact_motion_has_its_fronts_no_error_and_no_ripple(case):
    speeds = theory(case).speeds
    if case != "4":  # its shock eats the front
        assert measures.front_speed(whole(case), theory(case)) == pytest.approx(speeds.front_speed_mps, rel=3e-3)
    if not case.endswith("p"):
        slack = measures.slack_front_speed(whole(case), theory(case))
        assert slack == pytest.approx(speeds.slack_front_speed_mps, rel=5e-3)
    above, rise = measures.strain_overshoot(whole(case), 0.98 * theory(case).arrival_s)
    assert above < 1e-9 and rise < 1e-6
    assert measures.strain_error(whole(case), theory(case)) == 0.0


@pytest.mark.parametrize("case", SHOCKED)
def test_the_shock_and_where_it_is_born(case):
    _, places, exact = measures.shock_track(whole(case), theory(case))
    assert len(places) >= 10 and np.abs(places - exact).max() < LENGTH / 800
    birth = theory(case).start
    profiles = exact_profiles(case, np.linspace(0.0, 0.6, 120) * birth.time_s, nodes=3201)
    assert measures.shock_birth(profiles, theory(case)) == pytest.approx(birth.distance_m, rel=0.02)


def test_a_shifted_ruffled_copy_shows_its_error_and_ripple():
    exact = whole("4")
    shifted = SimpleNamespace(**{**vars(exact), "strain": np.roll(exact.strain, 8, axis=1)})
    shifted.strain[:, :8] = exact.strain[:, :1]
    _, places, where = measures.shock_track(shifted, theory("4"))
    assert np.median(places - where) == pytest.approx(8 * LENGTH / 800, rel=0.1)
    ruffled = SimpleNamespace(**{**vars(exact), "strain": exact.strain.copy()})
    ruffled.strain[1:] += 0.003 * (np.arange(801) % 2)
    above, rise = measures.strain_overshoot(ruffled, 0.05)
    static = exact.strain[0, 0]
    assert above == pytest.approx(0.003 / static, rel=1e-6) and rise == pytest.approx(0.003 / static, rel=0.05)
    assert measures.strain_error(ruffled, theory("4")) == pytest.approx(0.0015, rel=0.01)


def test_a_shock_arrives_before_the_front_that_it_has_eaten():
    assert theory("4").arrival_s == pytest.approx(0.06024, abs=1e-5)
    assert theory("4").arrival_s < theory("4").speeds.front_arrival_s
    assert theory("2").arrival_s == theory("2").speeds.front_arrival_s


def test_turns_are_followed_round():
    angle = np.linspace(3.0 * np.pi, 0.0, 200)  # one and a half times round, level at the broken end
    x, z = np.concatenate([[0.0], np.cumsum(np.cos(angle))]), np.concatenate([[0.0], np.cumsum(np.sin(angle))])
    profiles = SimpleNamespace(x_m=x[None, :], z_m=z[None, :])
    assert measures.tilts(profiles)[0] == pytest.approx(angle, abs=1e-9)


def test_recoil_of_a_line_that_moves_as_told():
    s = np.linspace(0.0, 60.0, 61)
    x0 = 1.2 * s
    folded = np.where(s < 5.0, -0.45 + 0.1 * s, x0 * 62.0 / 72.0)
    z = np.where(s < 5.0, 0.3 * s, -0.1)
    profiles = SimpleNamespace(
        time_s=np.array([0.0, 0.1]), s_m=s, x_m=np.array([x0, folded]), z_m=np.array([0.0 * s, z])
    )
    found = measures.recoil(profiles, 0.1)
    assert found["recoil_m"] == found["recoil_120ms_m"] == pytest.approx(10.0)
    assert found["x_min_m"] == pytest.approx(-0.45) and found["left_of_fixed_end_m"] == pytest.approx(4.0)
    assert found["vertical_m"] == pytest.approx(1.2) and found["vertical_beyond_m"] == pytest.approx(0.1)
    assert found["buckled_m"] == pytest.approx(5.0)
