"""Law: linear waves over finite depth H (Airy; Dean & Dalrymple, Water Wave Mechanics, ch. 3), z above the bed:

    omega^2 = g k tanh kH;  psi = +-k x - omega t + phase, amplitude A:
    U = +-A omega cosh kz/sinh kH cos psi,  W = A omega sinh kz/sinh kH sin psi;  accelerations are dU/dt, dW/dt at a
    place. Free of divergence and rotation; phase moves by 2 pi without effect; a ramp sin^2(pi t/2 t_r) multiplies it.
    In space a wave in direction a at a place is the wave in direction 0 at the place turned back, its vectors turned.

The nodes are visited along a line (the engine carries exponentials and phase from node to node, and starts anew over
long elements), so lines of many kinds are tried. Tolerance: rounding of psi (1e-16 times its size) and of some hundred
multiplications: 1e-12 of the speed at the surface; finite differences by their own error.
"""

import numpy as np
import pytest

from engine.physics.waves import wave_number
from tests.engine.kernels import parameters_of, waves_at
from tests.engine.lines import SPACE, line
from tests.engine.physics.airy import direct
from tests.engine.rotations import turned

PERIOD, DEPTH, GRAVITY = 5.0, 21.0, 9.81
OMEGA = 2 * np.pi / PERIOD
SEA = {"waves.period_s": PERIOD, "water.depth_m": DEPTH}  # kA = 0.13, as shipped
K = wave_number(PERIOD, DEPTH)
A = 0.13 / K
RNG = np.random.default_rng(12)
PLACES = np.column_stack([RNG.uniform(-15, 40, 60), RNG.uniform(-20, 20, 60), RNG.uniform(-3, 25, 60)])
ROPE = np.column_stack([np.linspace(0, 7, 41), np.linspace(0, -5, 41), np.linspace(0, 22, 41)])


def scene(*parts, **waves):
    return line(SEA, *parts, {f"waves.{key}": value for key, value in waves.items()})


def lines_of_nodes():
    s = np.linspace(0, 1, 41)
    rng = np.random.default_rng(6)
    return {
        "upright": np.column_stack([0 * s, 20 * s]),
        "leaning": np.column_stack([12 * s, 16 * s]),
        "lying": np.column_stack([40 * s, 0.5 + 0 * s]),
        "loop": np.column_stack([5 + 2 * np.cos(9 * s), 15 + 2 * np.sin(9 * s)]),
        "three nodes far apart": np.array([[0.0, 0.0], [30.0, 10.0], [90.0, 20.0]]),
        "scattered": np.column_stack([rng.uniform(-50, 50, 41), rng.uniform(0, 21, 41)]),
        "leaping": np.column_stack([3 * s, 24.5 * s]),
        "back and forth": np.tile([[0.0, 0.1], [30.0, 21.0]], (20, 1)),
    }


@pytest.mark.parametrize("period", [0.5, 1.5, 5.0, 12.0, 300.0, 1e5])
@pytest.mark.parametrize("depth", [0.3, 21.0, 4000.0])
def test_the_wave_number_meets_the_dispersion_relation(period, depth):
    k = wave_number(period, depth, GRAVITY)
    assert GRAVITY * k * np.tanh(k * depth) == pytest.approx((2 * np.pi / period) ** 2, rel=1e-13)


def test_steepness_is_amplitude_times_wave_number():
    steep, high = scene(), scene(amplitude_m=A)
    p = parameters_of(steep)[0]
    assert p["amplitude"] * p["k"] == pytest.approx(0.13, rel=1e-15)
    assert np.array_equal(waves_at(steep, 3.0, [[1.0, 9.0]]), waves_at(high, 3.0, [[1.0, 9.0]]))


@pytest.mark.parametrize("direction", [0.0, np.pi])
@pytest.mark.parametrize("nodes", lines_of_nodes())
def test_kinematics(nodes, direction):
    X = lines_of_nodes()[nodes]
    for t in (0.0, 1.3, 297.1):
        exact = direct(K, A, DEPTH, t, X, np.cos(direction), 0.7)
        found = waves_at(scene(direction_rad=direction, phase_rad=0.7), t, X)
        assert np.max(np.abs(found - exact)) < 1e-12 * A * OMEGA


@pytest.mark.parametrize("depth, period", [(900.0, 2 * np.pi / np.sqrt(9.81)), (21.0, 60.0), (5000.0, 5.0)])
def test_deep_and_shallow_water(depth, period):
    """kH = 900 and 805 (cosh and sinh of them overflow in double precision), and 0.15."""
    sea = scene({"water.depth_m": depth}, period_s=period, amplitude_m=0.2)
    omega, k = 2 * np.pi / period, wave_number(period, depth)
    s = np.linspace(0, 1, 101)
    moved = min(10 / k, depth)
    for z in (depth * s, depth - moved * s, depth - moved * (1 - s), 0.9 * depth * s):
        X = np.column_stack([9 * s, z])
        exact = direct(k, 0.2, depth, 7.0, X, omega=omega)
        assert np.max(np.abs(waves_at(sea, 7.0, X) - exact)) < 1e-12 * 0.2 * omega * max(1, 1 / (k * depth))


def test_a_phase_of_2_pi_or_a_period_changes_nothing():
    X = lines_of_nodes()["leaning"]
    one = waves_at(scene(phase_rad=0.7), 2.0, X)
    assert np.max(np.abs(waves_at(scene(phase_rad=0.7 + 2 * np.pi), 2.0, X) - one)) < 1e-13
    assert np.max(np.abs(waves_at(scene(phase_rad=0.7), 2.0 + PERIOD, X) - one)) < 1e-13


@pytest.mark.parametrize("direction", [0.0, np.pi])
def test_free_of_divergence_and_rotation(direction):
    """Central differences of step 1e-3 m: error k^3 d^2/6 of the speed, about 1e-9."""
    sea, centres, d = scene(direction_rad=direction), lines_of_nodes()["scattered"], 1e-3
    dx, dz = (
        (waves_at(sea, 1.7, centres + shift) - waves_at(sea, 1.7, centres - shift)) / (2 * d)
        for shift in ([d, 0.0], [0.0, d])
    )
    assert np.max(np.abs(dx[:, 0] + dz[:, 1])) < 1e-8
    assert np.max(np.abs(dz[:, 0] - dx[:, 1])) < 1e-8
    assert np.max(np.abs(dx)) > 0.01


@pytest.mark.parametrize("ramp", [0.0, 8.0])
@pytest.mark.parametrize("t", [0.5, 3.9, 7.5, 20.0])
def test_acceleration_is_the_rate_of_velocity_at_a_place(t, ramp):
    """Central differences of step 1e-4 s: omega^3 d^2/6, about 1e-8 of the speed."""
    sea, X, d = scene(ramp_s=ramp), lines_of_nodes()["leaning"], 1e-4
    rate = (waves_at(sea, t + d, X)[:, :2] - waves_at(sea, t - d, X)[:, :2]) / (2 * d)
    assert np.max(np.abs(rate - waves_at(sea, t, X)[:, 2:])) < 5e-8


def test_the_ramp_starts_from_still_water_and_ends_in_the_full_wave():
    ramped, full, X = scene(ramp_s=8.0), scene(), lines_of_nodes()["leaning"]
    assert not waves_at(ramped, 0.0, X).any()
    assert waves_at(ramped, 4.0, X)[:, :2] == pytest.approx(0.5 * waves_at(full, 4.0, X)[:, :2], abs=1e-13)
    for t in (8.0, 9.7):
        assert waves_at(ramped, t, X) == pytest.approx(waves_at(full, t, X), abs=1e-13)


def test_above_the_still_water_line():
    """extrapolate: the formulas go on; zero: no water above H; Wheeler (1970): the height z is taken at
    z H/(H + eta), eta = A cos psi, so that the crest moves as the still surface did, and the bed is the bed."""
    X, t = lines_of_nodes()["leaping"], 1.9
    above = X[:, 1] > DEPTH
    plain = direct(K, A, DEPTH, t, X)
    options = ("extrapolate", "zero", "wheeler")
    extrapolated, none, wheeler = (waves_at(scene(above_still_water=option), t, X) for option in options)
    assert above.sum() >= 5 and np.abs(plain[above, 0]).min() > 0.1
    assert np.max(np.abs(extrapolated - plain)) < 1e-12
    assert not none[above].any()
    assert np.max(np.abs(none[~above] - plain[~above])) < 1e-12
    eta = A * np.cos(K * X[:, 0] - OMEGA * t)
    stretched = direct(K, A, DEPTH, t, np.column_stack([X[:, 0], X[:, 1] * DEPTH / (DEPTH + eta)]))
    assert np.max(np.abs(wheeler - stretched)) < 1e-12


def test_a_line_that_dives_back_below_the_surface_feels_the_same_water():
    """With "zero" the recurrence goes on through nodes that are above the surface."""
    s = np.linspace(0, 1, 41)
    X = np.column_stack([4 * s, 23 * np.sin(2.8 * s)])
    F = waves_at(scene(above_still_water="zero"), 0.4, X)
    below = X[:, 1] <= DEPTH
    assert 5 < np.count_nonzero(~below) < 35
    assert np.max(np.abs(F - direct(K, A, DEPTH, 0.4, X))[below]) < 1e-12


def test_the_field_is_added_to_what_is_there():
    X = lines_of_nodes()["leaning"]
    assert waves_at(scene(), 2.0, X, there=3.0) == pytest.approx(3.0 + waves_at(scene(), 2.0, X), abs=1e-15)


@pytest.mark.parametrize("option", ["extrapolate", "zero", "wheeler"])
@pytest.mark.parametrize("X", [PLACES, ROPE], ids=["scattered", "rope"])
def test_along_x_the_wave_in_space_is_that_of_the_plane(X, option):
    changes = {"above_still_water": option, "phase_rad": 0.7, "ramp_s": 8.0}
    space = waves_at(scene(SPACE, **changes), 3.1, X)
    assert np.max(np.abs(space[:, [0, 2, 3, 5]] - waves_at(scene(**changes), 3.1, X[:, [0, 2]]))) < 1e-14
    assert not space[:, [1, 4]].any()


@pytest.mark.parametrize("angle", [0.3, np.pi / 2, 2.0, np.pi, -1.1, 40.0])
def test_a_turned_wave_is_the_wave_turned(angle):
    """Along an axis it leaves the other alone exactly: anything across would be a seed of motion out of its plane."""
    for X in (PLACES, ROPE):
        plain = waves_at(scene(SPACE), 3.1, X).reshape(-1, 2, 3)
        there = waves_at(scene(SPACE, direction_rad=angle), 3.1, turned(X, angle))
        assert np.max(np.abs(there.reshape(-1, 2, 3) - turned(plain, angle))) < 1e-12
        for axis, other in ((np.pi, [1, 4]), (np.pi / 2, [0, 3])):
            assert angle != axis or not there[:, other].any()
