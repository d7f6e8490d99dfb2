"""Law: linear waves over finite depth H (Airy; Dean & Dalrymple, Water Wave Mechanics, ch. 3), z above the bed:

    omega^2 = g k tanh kH;  psi = k (x cos a + y sin a) - omega t + phase, amplitude A, direction a:
    U = A omega cosh kz/sinh kH cos psi along a,  W = A omega sinh kz/sinh kH sin psi;  accelerations are their rates
    at a place. A ramp sin^2(pi t/2 t_r) multiplies it; waves of a sea add.
    A JONSWAP sea of significant height H_s has the variance H_s^2/16, whatever its seed, spread as its spectrum says.

Above the still water line "extrapolate" goes on with the formulas; "zero" has no water; "wheeler" (1970) takes the
height z at z H/(H + eta), eta the surface of the whole sea, so that the crest moves as the still surface did.

The nodes are visited along a line (the engine carries exponentials and phase from node to node, and starts anew over
long elements), so lines of many kinds are tried. Tolerance: rounding of psi (1e-16 times its size) and of some hundred
multiplications: 1e-12 of the speed at the surface; finite differences by their own error.
"""

import numpy as np
import pytest
from scipy.integrate import quad

from engine import goes_in_lanes
from engine.physics.sea import HIGHEST, LOWEST, components, components_of, elevation_m, steepness_of
from engine.physics.submergence import surface
from engine.physics.waves import wave_number
from engine.run.batch import kind_of
from engine.scene.values import LARGEST, SMALLEST
from tests.engine.kernels import parameters_of, waves_at
from tests.engine.lines import SPACE, line
from tests.engine.physics.caps import linear_waves

PERIOD, DEPTH, GRAVITY = 5.0, 21.0, 9.81
OMEGA = 2 * np.pi / PERIOD
STEEP = {"waves.period_s": PERIOD, "water.depth_m": DEPTH}  # kA = 0.13, as shipped
K = wave_number(PERIOD, DEPTH)
A = 0.13 / K
S = np.linspace(0, 1, 41)[:, None]
LINES = {
    "leaning": S * [12, 16],
    "lying": S * [40, 0] + [0, 0.5],
    "loop": np.hstack([5 + 2 * np.cos(9 * S), 15 + 2 * np.sin(9 * S)]),
    "three nodes far apart": np.array([[0.0, 0.0], [30.0, 10.0], [90.0, 20.0]]),
    "scattered": np.random.default_rng(6).uniform([-50, -3], [50, 25], (41, 2)),
    "leaping": S * [3, 24.5],
    "diving back below the surface": np.hstack([4 * S, 23 * np.sin(2.8 * S)]),
    "back and forth": np.tile([[0.0, 0.1], [30.0, 21.0]], (20, 1)),
}
SHORT = (3.1, 0.2, -1.0, 0.0)
SEAS = {  # dimensions; period (s), amplitude (m), phase and direction (rad) of every wave
    "one": (2, [(PERIOD, A, 0.7, 0.0)]),
    "against x": (2, [(PERIOD, A, 0.7, np.pi)]),
    "two": (2, [(PERIOD, 0.8, 0.3, np.pi), SHORT]),
    "aslant": (3, [(PERIOD, A, 0.7, -1.1)]),
    "two, aslant": (3, [(PERIOD, 0.8, 0.3, 0.7), SHORT]),
}


def scene(*parts, **waves):
    return line(STEEP, *parts, {f"waves.{key}": value for key, value in waves.items()})


def sea_of(name, share=1.0, **changes):
    """A sea, or one of a share of its amplitudes."""
    dimensions, waves = SEAS[name]
    keys = "period_s", "amplitude_m", "phase_rad", "direction_rad"
    listed = [dict(zip(keys, (T, share * high, *others), strict=True)) for T, high, *others in waves]
    entries = {"components": listed} if len(listed) > 1 else listed[0]
    return scene({"motion.dimensions": dimensions}, **entries, **changes)


def exact(name, above, t, X):
    """Water at X (n, 3), (n, 6) = velocity, acceleration, from the formulas."""
    _, waves = SEAS[name]
    rows = [(wave_number(T, DEPTH), 2 * np.pi / T, A, phase, np.cos(a), np.sin(a)) for T, A, phase, a in waves]
    x, y, z = X.T
    if above == "wheeler":
        eta = sum(A * np.cos(k * (c * x + s * y) - omega * t + phase) for k, omega, A, phase, c, s in rows)
        z = z * DEPTH / (DEPTH + eta)
    water = linear_waves(rows, DEPTH, t, np.column_stack([x, y, z]))
    return np.where((above == "zero") & (X[:, 2:] > DEPTH), 0.0, water)


@pytest.mark.parametrize("period", [SMALLEST, 1e-6, 0.5, 1.5, 5.0, 12.0, 300.0, 1e5, LARGEST])
@pytest.mark.parametrize("depth", [SMALLEST, 1e-6, 0.3, 21.0, 4000.0, LARGEST])
def test_the_wave_number_meets_the_dispersion_relation(period, depth):
    k = wave_number(period, depth, GRAVITY)
    assert GRAVITY * k * np.tanh(k * depth) == pytest.approx((2 * np.pi / period) ** 2, rel=1e-13)


@pytest.mark.parametrize("above", ["extrapolate", "zero", "wheeler"])
@pytest.mark.parametrize("name", SEAS)
@pytest.mark.parametrize("nodes", LINES)
def test_kinematics(nodes, name, above):
    space = SEAS[name][0] == 3
    X = np.insert(LINES[nodes], 1, (7.0 - LINES[nodes][:, 0]) * space, axis=1)
    for t in (0.0, 1.3, 297.1):
        places, expected = X, exact(name, above, t, X)
        if not space:
            places, expected = X[:, [0, 2]], expected[:, [0, 2, 3, 5]]
        computed = waves_at(sea_of(name, above_still_water=above), t, places, background=3.0) - 3.0
        assert np.max(np.abs(computed - expected)) < 1e-12 * A * OMEGA
    assert np.abs(expected[X[:, 2] > DEPTH]).any() == (above != "zero" and bool(np.any(X[:, 2] > DEPTH)))


@pytest.mark.parametrize("depth, period", [(900.0, 2 * np.pi / np.sqrt(9.81)), (21.0, 60.0), (5000.0, 5.0)])
def test_deep_and_shallow_water(depth, period):
    """kH = 900 and 805 (cosh and sinh of them overflow in double precision), and 0.15."""
    sea = scene({"water.depth_m": depth}, period_s=period, amplitude_m=0.2)
    omega, k = 2 * np.pi / period, wave_number(period, depth)
    s = np.linspace(0, 1, 101)
    moved = min(10 / k, depth)
    for z in (depth * s, depth - moved * s, depth - moved * (1 - s), 0.9 * depth * s):
        X = np.column_stack([9 * s, z])
        field = linear_waves([(k, omega, 0.2, 0.0, 1.0, 0.0)], depth, 7.0, X)
        assert np.max(np.abs(waves_at(sea, 7.0, X) - field)) < 1e-12 * 0.2 * omega * max(1, 1 / (k * depth))


@pytest.mark.parametrize("t", [0.5, 3.9, 7.5, 20.0])
@pytest.mark.parametrize("name", ["one", "two"])
def test_acceleration_is_the_rate_of_velocity_at_a_place(name, t):
    """Central differences of step 1e-4 s: omega^3 d^2/6, about 1e-8 of the speed. At still water W is that of eta."""
    sea, X, d = sea_of(name, ramp_s=8.0), LINES["leaning"], 1e-4
    rate = (waves_at(sea, t + d, X)[:, :2] - waves_at(sea, t - d, X)[:, :2]) / (2 * d)
    assert np.max(np.abs(rate - waves_at(sea, t, X)[:, 2:])) < 5e-8
    if t > 8.0:
        rising = np.diff(elevation_m(sea, np.array([t - d, t + d]), 2.0)) / (2 * d)
        assert rising == pytest.approx(waves_at(sea, t, [[2.0, DEPTH]])[0, 1], abs=1e-6)


@pytest.mark.parametrize("above", ["extrapolate", "wheeler"])
@pytest.mark.parametrize("name", SEAS)
def test_the_ramp_starts_from_still_water_and_ends_in_the_full_wave(name, above):
    ramped = sea_of(name, ramp_s=8.0, above_still_water=above)
    full, low = (sea_of(name, share, above_still_water=above) for share in (1.0, 0.5))
    X = LINES["leaning"]
    X = X if SEAS[name][0] == 2 else np.insert(X, 1, 3.0, axis=1)
    assert not waves_at(ramped, 0.0, X).any()
    half, of_half = (waves_at(sea, 4.0, X)[:, : X.shape[1]] for sea in (ramped, low))
    assert half == pytest.approx(of_half, abs=1e-13)
    for t in (8.0, 9.7):
        assert waves_at(ramped, t, X) == pytest.approx(waves_at(full, t, X), abs=1e-13)
    assert elevation_m(ramped, 4.0, X[:, 0]) == pytest.approx(0.5 * elevation_m(full, 4.0, X[:, 0]), abs=1e-13)


@pytest.mark.parametrize("t", [3.0, 9.7])
def test_the_surface_that_wets_a_buoy_is_that_of_the_waves_also_while_they_grow(t):
    """Elevation, slope and rate, by central differences of step 1e-4."""
    sea, x, d = sea_of("against x", ramp_s=8.0), 2.0, 1e-4
    eta, slope, _, rate, _ = surface(parameters_of(sea)[0], t, 1.0, -x)
    assert eta == pytest.approx(elevation_m(sea, t, x), abs=1e-12)
    assert rate == pytest.approx((elevation_m(sea, t + d, x) - elevation_m(sea, t - d, x)) / (2 * d), abs=1e-6)
    assert -slope == pytest.approx((elevation_m(sea, t, x + d) - elevation_m(sea, t, x - d)) / (2 * d), abs=1e-6)


def test_steepness_is_amplitude_times_wave_number_and_an_axis_is_an_axis():
    """Anything across an axis would be a seed of motion out of the plane."""
    assert np.array_equal(waves_at(scene(), 3.0, [[1.0, 9.0]]), waves_at(scene(amplitude_m=A), 3.0, [[1.0, 9.0]]))
    assert steepness_of(scene()) == pytest.approx(steepness_of(scene(amplitude_m=A)), rel=1e-12)
    X = np.insert(LINES["leaning"], 1, 3.0, axis=1)
    for angle, across in ((0.0, [1, 4]), (np.pi, [1, 4]), (np.pi / 2, [0, 3])):
        assert not waves_at(scene(SPACE, direction_rad=angle), 3.1, X)[:, across].any()


def test_under_another_gravity_a_wave_in_space_is_that_of_the_plane():
    moon, X = {"gravity_mps2": 1.62, "buoy.mass_kg": 1700.0}, LINES["leaning"]
    plane, space = waves_at(scene(moon), 3.1, X), waves_at(scene(moon, SPACE), 3.1, np.insert(X, 1, 3.0, axis=1))
    assert space[:, [0, 2, 3, 5]] == pytest.approx(plane, abs=1e-12)
    assert np.abs(plane - waves_at(scene(), 3.1, X)).max() > 0.1


def jonswap(**keys):
    return line({"waves.jonswap": keys})


@pytest.mark.parametrize("gamma", [1.0, 3.3, 7.0])
@pytest.mark.parametrize("count", [8, 64, 500])
def test_a_jonswap_sea_carries_the_energy_of_its_height(gamma, count):
    def density(f, power=0):
        """f^power S(f) of the head of `engine.physics.sea`, c = 1, T_p = 8 s."""
        ratio, sigma = 8.0 * f, 0.07 if 8.0 * f < 1.0 else 0.09
        return f**power * ratio**-5 * np.exp(-1.25 / ratio**4) * gamma ** np.exp(-((ratio - 1) ** 2) / (2 * sigma**2))

    periods, amplitudes, phases = components(2.0, 8.0, gamma, count, seed=5)
    assert np.sum(amplitudes**2) / 2.0 == pytest.approx(2.0**2 / 16.0, rel=1e-12)
    assert len(set(periods)) == count and np.all((phases >= 0.0) & (phases < 2.0 * np.pi))
    # Each component lies in its part of the band and carries the energy of it: no mean is off by more than a part.
    energy, part = amplitudes**2 / 2.0, (HIGHEST - LOWEST) / 8.0 / count
    of_f, total = (quad(density, LOWEST / 8, HIGHEST / 8, args=(n,), points=[1 / 8], limit=200)[0] for n in (1, 0))
    assert np.sum(energy / periods) / np.sum(energy) == pytest.approx(of_f / total, abs=part)


def test_the_seed_is_the_sea():
    first, repeated, reseeded = (components_of(jonswap(significant_height_m=1.0, seed=seed)) for seed in (3, 3, 4))
    assert all(np.array_equal(a, b) for a, b in zip(first, repeated, strict=True))
    assert not np.array_equal(first[0], reseeded[0]) and not np.array_equal(first[2], reseeded[2])
    assert np.array_equal(first[1], reseeded[1])  # every seed has the same energy at the same frequencies


def test_a_regular_wave_is_no_sea():
    """It takes the way that it took before; both share batches, each with its kind."""
    plain, sea = sea_of("one"), sea_of("two")
    assert (parameters_of(plain)[0]["sea_n"], parameters_of(sea)[0]["sea_n"]) == (0, 1)
    assert goes_in_lanes(plain) and goes_in_lanes(sea) and kind_of(plain) != kind_of(sea)
