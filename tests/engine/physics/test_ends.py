"""Law: a held end moves as its scene states, and is free once it is let go.

Displacements are written out here from their statements in the scene; the engine knows only velocities, which central
differences of step 1e-4 s check to 1e-6 (error of the square of the step).
"""

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

from engine.physics.ends import end_velocity
from tests.engine.kernels import parameters_of, upper_end_of
from tests.engine.lines import SPACE, STILL, equilibrium, held, line, linear, positions, ran

PLACE = (3.0, 20.2)
TIMES, DISPLACEMENTS = [1.0, 3.0, 4.0, 8.0, 13.0], [[0, 0, 0], [1, 0, 0.2], [1.5, 0, 0.2], [-1, 0, 0.1], [0, 0, 0.5]]


def moved(**motion):
    return held(*PLACE, motion=motion)


def harmonic(t, amplitude, period, phase=0.0, ramp=0.0):
    """amplitude (r(t) sin(2 pi t/period + phase) - its value at 0), r = sin^2(pi t/(2 ramp)), then 1."""

    def shape(t):
        r = np.sin(0.5 * np.pi * t / ramp) ** 2 if t < ramp else 1.0
        return r * np.sin(2 * np.pi * t / period + phase)

    return np.array(amplitude) * (shape(t) - shape(0.0))


def velocity(changes, t, dimensions=2):
    p, tables = parameters_of(line(STILL, changes, {"motion.dimensions": dimensions}), [np.full(5, 1e9)])
    return np.array(end_velocity(p, tables, t))


HARMONIC = {"amplitude_m": [1.0, 0.3, 0.5], "period_s": 5.0}


@pytest.mark.parametrize("ramp", [0.0, 6.0])
@pytest.mark.parametrize("t", [0.3, 2.2, 5.9, 6.1, 123.4])
def test_the_velocity_is_the_rate_of_the_stated_oscillation(ramp, t):
    changes = moved(law="harmonic", **HARMONIC, phase_rad=0.7, ramp_s=ramp)
    ahead, behind = (harmonic(at, [1.0, 0.3, 0.5], 5.0, 0.7, ramp) for at in (t + 1e-4, t - 1e-4))
    assert velocity(changes, t, 3) == pytest.approx((ahead - behind) / 2e-4, abs=1e-6)
    assert not harmonic(0.0, [1.0, 0.3, 0.5], 5.0, 0.7, ramp).any()


@pytest.mark.parametrize("t", [0.3, 2.2, 5.9, 123.4])
def test_the_velocity_on_a_circle_is_the_rate_of_the_stated_round(t, R=0.2, T=1.25, phase=0.4, ramp=2.5):
    """R r(t) (cos, -sin): from +x down, at once after the ramp."""
    rounds = {"radius_m": R, "period_s": T, "phase_rad": phase, "ramp_s": ramp}

    def place(at):
        r = np.sin(0.5 * np.pi * min(at / ramp, 1.0)) ** 2
        return R * r * np.array([np.cos(2 * np.pi * at / T + phase), 0.0, -np.sin(2 * np.pi * at / T + phase)])

    computed = velocity(moved(law="circular", **rounds), t)
    assert computed == pytest.approx((place(t + 1e-4) - place(t - 1e-4)) / 2e-4, abs=1e-5)


def test_a_table_is_passed_through_monotonically_and_at_rest_before_and_after():
    p, tables = parameters_of(line(STILL, moved(law="table", time_s=TIMES, displacement_m=DISPLACEMENTS)))
    t = np.linspace(0, 15, 30001)
    v = np.array([end_velocity(p, tables, at) for at in t])
    place = np.vstack([np.zeros(3), np.cumsum(0.5 * (v[1:] + v[:-1]) * np.diff(t)[:, None], axis=0)])
    at = [round(knot / 15 * 30000) for knot in (*TIMES, 15.0)]
    assert place[at] == pytest.approx(np.array([*DISPLACEMENTS, DISPLACEMENTS[-1]]), abs=1e-7)  # trapezoidal sums
    assert not v[t <= TIMES[0]].any() and not v[t >= TIMES[-1]].any()
    assert np.abs(np.diff(v, axis=0)).max() < 5e-3  # no jump: accelerations are below 5 m/s2
    for i in range(4):
        assert np.all(np.sign(v[at[i] : at[i + 1]]) * np.sign(np.diff(DISPLACEMENTS, axis=0)[i]) >= 0)
    # between the second and the last but one knot it is scipy's own monotone cubic
    inner = (t > TIMES[1]) & (t < TIMES[-2])
    assert v[inner] == pytest.approx(PchipInterpolator(TIMES, DISPLACEMENTS).derivative()(t[inner]), abs=1e-12)


@pytest.mark.parametrize("force", [None, [30.0, 0.0, 9.0]])
def test_an_end_is_held_up_to_its_release_and_free_after_it(force):
    p, tables = parameters_of(line(STILL, held(3.0, 19.0, release_s=2.5, force_N=force)))
    N, V, V_tilde = np.array([700.0, 800.0]), np.array([0.2, 0.3]), np.array([0.1, 0.1])
    f = np.array(force or [0.0, 0.0, 0.0])[[0, 2]]
    # a step that ends at the release may miss it by rounding
    held_s, free_s = (0.0, 2.0, 2.5, np.nextafter(2.5, 3.0)), (2.5 + 1e-9, 2.6, 1e6)
    for times, expected in ((held_s, (V, 0.0, np.eye(2))), (free_s, (N - f, 1.0, np.zeros((2, 2))))):
        for t in times:
            computed = upper_end_of(p, tables, t, 8.0, 1.0, N, V, V_tilde, np.zeros(4))
            assert all(map(np.array_equal, computed, expected))


def test_an_end_that_was_let_go_bears_nothing_at_any_sample():
    """A short stiff rod, in steps of .1 s that are 60 times as long as the period of its axial waves."""
    rod = {"length_m": 4.1, "area_m2": 4e-4, "bending_stiffness_Nm2": 900.0, "tension": linear(1.6e7)}
    let_go = held(1.39, -2.27, release_s=1.0) | {"water.depth_m": 10.0, "anchor.position_m": [0.0, 0.0, 5.0]}
    columns = ran(line(STILL, let_go, {"tether.damping_critical": 0.07}, **rod), duration_s=5.0).columns
    held_N, free_N = columns["tension_top_N"][0], columns["tension_top_N"][columns["time_s"] > 1.2]
    assert np.abs(free_N).max() < 1e-2 * abs(held_N)


def test_release_and_motion_begin_from_the_equilibrium_of_the_held_end():
    still = equilibrium(line(STILL, held(3, 19)))
    motion = {"law": "harmonic", "amplitude_m": [1.0, 0.0, 0.0], "period_s": 5.0, "phase_rad": 0.7}
    for keys in ({"release_s": 2.5}, {"motion": motion}):
        start = equilibrium(line(STILL, held(3, 19, **keys)))
        assert np.abs(start.Y - still.Y).max() < 1e-9
        assert positions(start.Y, start.h)[-1] == pytest.approx([3.0, 19.0], abs=1e-9)


def test_a_clamp_points_along_the_line_between_the_ends_unless_told_otherwise():
    clamped = {"anchor.rotation": "clamped"}
    upwards = parameters_of(line(SPACE, clamped))[0]
    assert [upwards[f"below_{axis}"] for axis in "xyz"] == [0.0, 0.0, 1.0]
    p = parameters_of(line(SPACE, clamped, held(3.0, 4.0, 12.0, rotation="clamped")))[0]
    for name in ("below", "above"):
        computed = [p[f"{name}_{axis}"] for axis in "xyz"]
        assert computed == pytest.approx([3 / 13, 4 / 13, 12 / 13], rel=1e-15)
