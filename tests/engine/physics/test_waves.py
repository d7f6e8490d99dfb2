"""Law: linear waves over finite depth H (Airy; Dean & Dalrymple, Water Wave Mechanics, ch. 3), z above the bed:

    omega^2 = g k tanh kH;  psi = +-k x - omega t + phase, amplitude A:
    U = +-A omega cosh kz/sinh kH cos psi,  W = A omega sinh kz/sinh kH sin psi;  accelerations are dU/dt, dW/dt at a
    place. Free of divergence and rotation; phase moves by 2 pi without effect; a ramp sin^2(pi t/2 t_r) multiplies it.

The nodes are visited along a line (the engine carries exponentials and phase from node to node, and starts anew over
long elements), so lines of many kinds are tried. Tolerance: rounding of psi (1e-16 times its size) and of some hundred
multiplications: 1e-12 of the speed at the surface; finite differences by their own error.
"""

import numpy as np
import pytest

from engine.parameters import record_of
from engine.physics.waves import wave_field, wave_number
from tests.engine.lines import line

PERIOD, DEPTH, GRAVITY = 5.0, 21.0, 9.81
OMEGA = 2 * np.pi / PERIOD
SEA = {"waves.period_s": PERIOD, "water.depth_m": DEPTH}  # kA = 0.13, as shipped


def scene(**changes):
    return line(SEA, {key.replace("__", "."): value for key, value in changes.items()})


def field(record, t, X):
    F = np.zeros((len(X), 4))
    wave_field(record, t, np.ascontiguousarray(X, float), F)
    return F


def record_from(sea):
    return record_of(sea, [])[0]


def direct(k, A, depth, t, X, direction=1.0, phase=0.0, omega=OMEGA):
    """The formulas of the head in long doubles; quotients as they stand, so kH below some 10000."""
    x, z = np.asarray(X, np.longdouble).T
    k = np.longdouble(k)
    psi = direction * k * x - np.longdouble(omega) * t + phase
    c, s = (f(k * z) / np.sinh(k * depth) * A * omega for f in (np.cosh, np.sinh))
    return np.column_stack(
        [direction * c * np.cos(psi), s * np.sin(psi), direction * omega * c * np.sin(psi), -omega * s * np.cos(psi)]
    )


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


def test_limits_of_deep_and_shallow_water():
    """Deep: k = omega^2/g, off by 2 exp(-2kH). Shallow: k = omega/sqrt(gH), off by (kH)^2/6."""
    deep = wave_number(1.0, 200.0, GRAVITY)
    assert deep == pytest.approx((2 * np.pi) ** 2 / GRAVITY, rel=1e-14)
    shallow = wave_number(1000.0, 1.0, GRAVITY)
    assert shallow == pytest.approx(2 * np.pi / 1000 / np.sqrt(GRAVITY), rel=shallow**2)


def test_steepness_is_amplitude_times_wave_number():
    steep, high = record_from(scene()), record_from(scene(waves__amplitude_m=0.13 / wave_number(5.0, 21.0)))
    assert steep["amplitude"] * steep["k"] == pytest.approx(0.13, rel=1e-15)
    assert np.array_equal(field(steep, 3.0, [[1.0, 9.0]]), field(high, 3.0, [[1.0, 9.0]]))


@pytest.mark.parametrize("direction", [0.0, np.pi])
@pytest.mark.parametrize("nodes", lines_of_nodes())
def test_kinematics(nodes, direction):
    X = lines_of_nodes()[nodes]
    record = record_from(scene(waves__direction_rad=direction, waves__phase_rad=0.7))
    k, A = wave_number(PERIOD, DEPTH), 0.13 / wave_number(PERIOD, DEPTH)
    for t in (0.0, 1.3, 297.1):
        exact = direct(k, A, DEPTH, t, X, np.cos(direction), 0.7)
        assert np.max(np.abs(field(record, t, X) - exact)) < 1e-12 * A * OMEGA


@pytest.mark.parametrize("depth, period", [(900.0, 2 * np.pi / np.sqrt(9.81)), (21.0, 60.0), (5000.0, 5.0)])
def test_deep_and_shallow_water(depth, period):
    """kH = 900 and 805 (cosh and sinh of them overflow in double precision), and 0.15."""
    sea = scene(**{"water__depth_m": depth, "waves__period_s": period, "waves__amplitude_m": 0.2})
    omega, k = 2 * np.pi / period, wave_number(period, depth)
    s = np.linspace(0, 1, 101)
    moved = min(10 / k, depth)
    for z in (depth * s, depth - moved * s, depth - moved * (1 - s), 0.9 * depth * s):
        X = np.column_stack([9 * s, z])
        exact = direct(k, 0.2, depth, 7.0, X, omega=omega)
        assert np.max(np.abs(field(record_from(sea), 7.0, X) - exact)) < 1e-12 * 0.2 * omega * max(1, 1 / (k * depth))


def test_no_flow_through_the_bed():
    F = field(record_from(scene()), 1.1, np.column_stack([np.linspace(0, 30, 30), np.zeros(30)]))
    assert np.all(np.abs(F[:, [1, 3]]) < 1e-14)
    assert np.abs(F[:, 0]).max() > 0.05


def test_a_wave_from_the_other_side_is_the_mirror_image():
    X = lines_of_nodes()["leaning"]
    there = field(record_from(scene(waves__phase_rad=0.7)), 2.0, X)
    back = field(record_from(scene(waves__phase_rad=0.7, waves__direction_rad=np.pi)), 2.0, X * [-1, 1])
    assert np.max(np.abs(back - there * [-1, 1, -1, 1])) < 1e-13


def test_a_phase_of_2_pi_or_a_period_changes_nothing():
    X = lines_of_nodes()["leaning"]
    one = field(record_from(scene(waves__phase_rad=0.7)), 2.0, X)
    assert np.max(np.abs(field(record_from(scene(waves__phase_rad=0.7 + 2 * np.pi)), 2.0, X) - one)) < 1e-14 * 10
    assert np.max(np.abs(field(record_from(scene(waves__phase_rad=0.7)), 2.0 + PERIOD, X) - one)) < 1e-14 * 10


@pytest.mark.parametrize("direction", [0.0, np.pi])
def test_free_of_divergence_and_rotation(direction):
    """Central differences of step 1e-3 m: error k^3 d^2/6 of the speed, about 1e-9."""
    record = record_from(scene(waves__direction_rad=direction))
    centres = lines_of_nodes()["scattered"]
    d = 1e-3
    dx, dz = (
        (field(record, 1.7, centres + shift) - field(record, 1.7, centres - shift)) / (2 * d)
        for shift in ([d, 0.0], [0.0, d])
    )
    assert np.max(np.abs(dx[:, 0] + dz[:, 1])) < 1e-8
    assert np.max(np.abs(dz[:, 0] - dx[:, 1])) < 1e-8
    assert np.max(np.abs(dx)) > 0.01


@pytest.mark.parametrize("ramp", [0.0, 8.0])
@pytest.mark.parametrize("t", [0.5, 3.9, 7.5, 20.0])
def test_acceleration_is_the_rate_of_velocity_at_a_place(t, ramp):
    """Central differences of step 1e-4 s: omega^3 d^2/6, about 1e-8 of the speed."""
    record, X, d = record_from(scene(waves__ramp_s=ramp)), lines_of_nodes()["leaning"], 1e-4
    rate = (field(record, t + d, X)[:, :2] - field(record, t - d, X)[:, :2]) / (2 * d)
    assert np.max(np.abs(rate - field(record, t, X)[:, 2:])) < 5e-8


def test_the_ramp_starts_from_still_water_and_ends_in_the_full_wave():
    ramped, full, X = record_from(scene(waves__ramp_s=8.0)), record_from(scene()), lines_of_nodes()["leaning"]
    assert not field(ramped, 0.0, X).any()
    assert field(ramped, 4.0, X)[:, :2] == pytest.approx(0.5 * field(full, 4.0, X)[:, :2], abs=1e-13)
    for t in (8.0, 9.7):
        assert field(ramped, t, X) == pytest.approx(field(full, t, X), abs=1e-13)


def test_above_the_still_water_line():
    """extrapolate: the formulas go on; zero: no water above H; Wheeler (1970): the height z is taken at
    z H/(H + eta), eta = A cos psi, so that the crest moves as the still surface did, and the bed is the bed."""
    X = lines_of_nodes()["leaping"]
    above = X[:, 1] > DEPTH
    k, A, t = wave_number(PERIOD, DEPTH), 0.13 / wave_number(PERIOD, DEPTH), 1.9
    plain = direct(k, A, DEPTH, t, X)
    options = ("extrapolate", "zero", "wheeler")
    extrapolated, none, wheeler = (field(record_from(scene(waves__above_still_water=o)), t, X) for o in options)
    assert above.sum() >= 5 and np.abs(plain[above, 0]).min() > 0.1
    assert np.max(np.abs(extrapolated - plain)) < 1e-12
    assert not none[above].any()
    assert np.max(np.abs(none[~above] - plain[~above])) < 1e-12
    eta = A * np.cos(k * X[:, 0] - OMEGA * t)
    stretched = direct(k, A, DEPTH, t, np.column_stack([X[:, 0], X[:, 1] * DEPTH / (DEPTH + eta)]))
    assert np.max(np.abs(wheeler - stretched)) < 1e-12


def test_a_line_that_dives_back_below_the_surface_feels_the_same_water():
    """With "zero" the recurrence goes on through nodes that are above the surface."""
    s = np.linspace(0, 1, 41)
    X = np.column_stack([4 * s, 23 * np.sin(2.8 * s)])
    F = field(record_from(scene(waves__above_still_water="zero")), 0.4, X)
    k, A = wave_number(PERIOD, DEPTH), 0.13 / wave_number(PERIOD, DEPTH)
    below = X[:, 1] <= DEPTH
    assert 5 < np.count_nonzero(~below) < 35
    assert np.max(np.abs(F - direct(k, A, DEPTH, 0.4, X))[below]) < 1e-12


def test_the_field_is_added_to_what_is_there():
    X, record = lines_of_nodes()["leaning"], record_from(scene())
    F = np.full((41, 4), 3.0)
    wave_field(record, 2.0, X, F)
    assert F == pytest.approx(3.0 + field(record, 2.0, X), abs=1e-15)
