"""A run is told by the orbit that it comes nearer to where the orbit attracts and the distance shrinks as it must."""

import numpy as np
import pytest

from analysis import approach_evidence, approached_period, next_look
from analysis.looks import looks
from analysis.orbits import OrbitMap, find_orbit
from tests.analysis.systems import henon, henon_step

SCALE, PERIODS = np.ones(2), 1500


def record(step, start, periods=PERIODS):
    states = [np.asarray(start, float)]
    for _ in range(periods):
        states.append(step(states[-1]))
    return np.array(states)


def spiral(multiplier, cubic=0.0, fifth=0.0):
    """A focus at 0 with this multiplier, and a growth that depends on the size of the motion: a map of the plane."""

    def step(state):
        z = complex(*state)
        z = multiplier * z * (1.0 + cubic * abs(z) ** 2 + fifth * abs(z) ** 4)
        return np.array([z.real, z.imag])

    return step


def evidence_at(states, end, multipliers, orbit=((0.0, 0.0),)):
    return approach_evidence(states[: end + 1], orbit, multipliers, np.full(len(multipliers), 1e-6), SCALE)


def first_look(states, multipliers, orbit=((0.0, 0.0),)):
    """The look that tells that a record comes to an orbit; None."""
    return next(
        (n for n in looks(PERIODS) if n > next_look() and evidence_at(states, n, multipliers, orbit).passed), None
    )


@pytest.mark.parametrize("curved", [0.0, -20.0, 20.0])
@pytest.mark.parametrize(
    ("multiplier", "at_most"), [(0.9, 135), (0.985 * np.exp(1.0j), 135), (-0.97, 135), (0.99, 135), (0.999, 1440)]
)
def test_a_slow_decay_is_told_long_before_it_is_over(multiplier, at_most, curved):
    """curved: 20 changes the rate of the decay by a fifth where the run begins."""
    states = record(spiral(multiplier, curved * (1.0 - abs(multiplier))), (0.1, 0.02))
    look = next(n for n in looks(PERIODS) if n > next_look() and approached_period(states[: n + 1], SCALE) == 1)
    assert look <= at_most
    evidence = evidence_at(states, look, [multiplier])
    assert evidence.passed and evidence.value == pytest.approx(abs(multiplier), abs=0.35 * (1.0 - abs(multiplier)))


@pytest.mark.parametrize("multiplier", [1.001 * np.exp(1.0j), 1.002 * np.exp(2.0j), 1.002])
@pytest.mark.parametrize("start", [1e-3, 0.3])
def test_a_spiral_to_a_torus_beyond_its_birth_is_no_approach(multiplier, start):
    """It shrinks from outside for a thousand periods; the multiplier says that it does not go to the orbit."""
    assert first_look(record(spiral(multiplier, -0.05), (start, 0.0)), [multiplier]) is None


@pytest.mark.parametrize("off", [0.0, 1e-12, -1e-12])
def test_a_run_that_comes_to_a_saddle_near_a_node_is_not_told_there(off):
    """x' = x + a (x^2 - d^2): a node at -d, a saddle at d; along y the run comes to the saddle at 0.97 a period."""
    a, d = 0.1, 0.05

    def step(state):
        return np.array([state[0] + a * (state[0] ** 2 - d * d), 0.97 * state[1]])

    states = record(step, (d + off, 0.15), 600)
    node, saddle = [0.97, 1.0 - 2.0 * a * d], [1.0 + 2.0 * a * d, 0.97]
    for end in (135, 205, 310):
        assert np.abs(states[end, 0] - d) < 0.1 * d, "it is still at the saddle"
        assert not evidence_at(states, end, sorted(node, reverse=True), [(-d, 0.0)]).passed
        assert not evidence_at(states, end, saddle, [(d, 0.0)]).passed


def test_a_drift_a_torus_and_chaos_come_to_no_period():
    k = np.arange(466)
    wave = np.column_stack([np.cos(2.1 * k), np.sin(2.1 * k)])
    rng = np.random.default_rng(0)
    for states in (wave + 1e-3 * k[:, None], wave * (1.0 + 0.1 * np.cos(0.03 * k))[:, None], rng.normal(size=(466, 2))):
        assert approached_period(states, SCALE) is None


@pytest.mark.parametrize(("parameter", "period"), [(0.372, 2), (0.914, 4)])
def test_an_orbit_of_several_points_is_found_from_a_run_that_still_rings(parameter, period):
    """The Hénon map just beyond the flips of its periods 1 and 2, where the doubled period attracts slowly."""

    orbit = find_orbit(OrbitMap(henon_step), henon(1, parameter, skip=5000)[0], parameter, period)
    assert orbit.period == period and 0.95 < abs(orbit.multipliers[0]) < 1.0
    states = henon(PERIODS, parameter, skip=0, start=orbit.points[0] + np.array([1e-2, 0.0]))
    look = first_look(states, orbit.multipliers, orbit.points)
    assert look is not None and approached_period(states[: look + 1], SCALE) == period
    half = find_orbit(OrbitMap(henon_step), orbit.points[: period // 2].mean(axis=0), parameter, period // 2)
    assert first_look(states, half.multipliers, half.points) is None


@pytest.mark.parametrize(
    ("modulus", "error", "arrived"), [(0.67, 0.09, True), (0.95, 0.09, False), (1.01, 0.001, False)]
)
def test_a_run_on_an_orbit_need_not_come_nearer_if_the_orbit_attracts(modulus, error, arrived):
    """What is left of the distance is the scatter of the steps."""
    rng = np.random.default_rng(2)
    orbit = np.array([[0.2, 0.4], [-0.3, 0.1]])
    states = orbit[np.arange(136) % 2] + 5e-4 * rng.normal(size=(136, 2))
    evidence = approach_evidence(states, orbit, np.array([modulus]), np.array([error]), SCALE)
    assert evidence.passed == arrived
