"""Orbits, multipliers, branches and events of maps that have them in closed form, and of eq. (33).

An event is one of its kind, once, and none where the multipliers leap: maps with known corners, folds and flips.
"""

import numpy as np
import pytest

from analysis.orbits import NoImage, OrbitMap, doubled_orbit, find_orbit, follow_branch, middle_of, scatter_of
from analysis.orbits.finding import Newton, described, solved_near
from analysis.oscillator import SnapOscillator, search_periodic_orbits, snap_map, strobed_states
from analysis.oscillator.growth import random_starts
from tests.analysis.systems import henon_step as henon
from tests.analysis.systems import logistic_step as logistic

PAPER, B = SnapOscillator(), 0.3


def delayed_logistic(z, r):
    x, y = z
    return np.array([r * x * (1.0 - y), x]), lambda V: np.array([[r * (1.0 - y), -r * x], [1.0, 0.0]]) @ V


def steep(z, r):
    """Its flip at r = 0 has d mu/d r = -2000: nine tenths of the change within a thousandth."""
    level = np.tanh(4000.0 * z[0])
    slope, spread = -1.0 - 0.5 * level, 0.5 * 4000.0 * (1.0 - level**2)
    return slope * z + 2.0 * r, lambda V: (slope - spread * z[0]) * V


def island(z, a):
    """Fixed points: the circle of radius 1/2 about z = 1, a = 2."""
    return z + 0.3 * (0.25 - (z - 1.0) ** 2 - (a - 2.0) ** 2), lambda V: (1.0 - 0.6 * (z[:, None] - 1.0)) * V


def coupled(z, r, eps=0.4):
    """A ring of logistic maps: the uniform fixed point has the multipliers (2 - r)(1 - eps + eps cos(2 pi k/n))."""

    def mixed(values):
        return (1.0 - eps) * values + 0.5 * eps * (np.roll(values, 1, axis=0) + np.roll(values, -1, axis=0))

    return mixed(r * z * (1.0 - z)), lambda V: mixed(r * (1.0 - 2.0 * z[:, None]) * V)


def of_kind(branch, kind):
    return [event for event in branch.events if event.kind == kind]


def closely(value):
    return pytest.approx(value, abs=1e-8)


def test_period_1_and_2_of_the_henon_map_have_their_multipliers():
    a = 1.0
    x = (-(1 - B) + np.sqrt((1 - B) ** 2 + 4 * a)) / (2 * a)
    single = find_orbit(OrbitMap(henon), [0.6, 0.2], a, tolerance=1e-13)
    assert single.points[0] == pytest.approx([x, B * x], abs=1e-12)
    assert single.multipliers == pytest.approx(-a * x + np.array([-1, 1]) * np.sqrt(a * a * x * x + B), abs=1e-12)
    two = find_orbit(OrbitMap(henon), [-0.4, 0.3], a, 2, tolerance=1e-13)
    trace = 4 * ((1 - B) ** 2 - a) + 2 * B
    assert (
        two.period == 2 and two.multipliers.sum() == pytest.approx(trace) and np.prod(two.multipliers) == closely(B * B)
    )
    assert two.residuals.max() < 1e-12 and two.stable is bool(np.abs(two.multipliers).max() < 1)


def test_the_least_period_is_told_and_a_map_without_orbits_is_refused_in_words():
    assert find_orbit(OrbitMap(logistic), [0.6], 2.8, 6).period == 1
    refused = find_orbit(OrbitMap(henon), [0.5, 0.1], -0.5)  # below the fold
    assert not refused.found and not refused.stable and "Newton" in refused.reason
    lost = find_orbit(OrbitMap(lambda z, r: (z * np.nan, lambda V: V)), [0.5], 1.0, 3)
    assert "not finite" in lost.reason


@pytest.mark.parametrize("skew", [5.0, 300.0])
def test_multipliers_of_a_map_far_from_normal_are_those_of_every_cyclic_order(skew):
    """Three maps of rank 4 in 300 coordinates; their product has the eigenvalues of a matrix of 4 by 4."""
    n, random = 300, np.random.default_rng(4)
    frames = [np.linalg.qr(random.normal(size=(n, 4)))[0] for _ in range(3)]
    mixed = [np.triu(random.normal(size=(4, 4)), 1) * skew + np.diag([1.2, -0.9, 0.5, 0.4]) for _ in range(3)]
    chain = [frames[(k + 1) % 3] @ mixed[k] @ frames[k].T for k in range(3)]
    exact = np.sort([1.2**3, (-0.9) ** 3, 0.5**3, 0.4**3])

    def orbit_from(first):
        steps = [lambda z, q, M=chain[(first + k) % 3]: (M @ z, lambda V: M @ V) for k in range(3)]
        system = OrbitMap(steps[0], frozen=lambda points, q, mesh: steps)
        return described(solved_near(system, np.zeros((3, n)), 0.0, Newton()), 4)[0]

    for first in range(3):
        orbit = orbit_from(first)
        values = np.sort(orbit.multipliers.real)
        assert (np.abs(values - exact) < orbit.residuals.max()).all(), "where rounding is magnified, they say so"
        assert skew > 5.0 or values == pytest.approx(exact, abs=1e-8)


def test_multipliers_that_have_not_settled_are_said_to_be_so_and_make_no_events():
    """A shift of coordinates: 0 is its only multiplier, and rounding alone makes others of modulus 1.3 of it."""
    n = 120
    shift = np.diag(np.full(n - 1, 1.6), -1)

    def step(z, r):
        return r * (shift @ z), lambda V: r * (shift @ V)

    orbit = find_orbit(OrbitMap(step), np.zeros(n), 1.0)
    assert orbit.found and not orbit.settled and not orbit.stable
    branch = follow_branch(OrbitMap(step), orbit, 0.9, 1.1, most=3)
    assert not any(orbit.settled for orbit in branch.orbits) and not branch.events


@pytest.mark.parametrize("n", [40, 300])
def test_multipliers_of_many_coordinates_are_within_their_errors(n):
    """Of 300 coordinates the spectrum is too dense for the passes: the errors say so."""
    r = 2.6
    orbit = find_orbit(OrbitMap(coupled), 0.6 + 0.05 * np.sin(np.arange(n)), r, count=5)
    assert orbit.points == pytest.approx(np.full((1, n), 1 - 1 / r), abs=1e-9)
    exact = (2 - r) * (0.6 + 0.4 * np.cos(2 * np.pi * np.arange(n) / n))
    nearest = np.abs(orbit.multipliers[:, None] - exact).min(axis=1)
    assert (nearest <= orbit.residuals + 1e-8).all()
    assert n == 300 or (orbit.residuals < 1e-8).all()


def test_folds_and_flips_of_the_henon_map_and_the_doubled_orbit():
    system = OrbitMap(henon)
    branch = follow_branch(system, find_orbit(system, [0.6, 0.2], 0.2), -1.0, 1.2, most=40)
    (fold,), (flip,) = of_kind(branch, "fold"), of_kind(branch, "flip")
    assert fold.parameter == closely(-((1 - B) ** 2) / 4) and flip.parameter == closely(3 * (1 - B) ** 2 / 4)
    assert abs(fold.parameter + (1 - B) ** 2 / 4) <= fold.error and fold.error < 1e-7
    assert fold.orbit.multipliers[0] == pytest.approx(1.0, abs=1e-4)
    assert [orbit.stable for orbit in branch.orbits].count(True) > 3 and not branch.closed
    assert branch.parameters[-1] == 1.2 and branch.ends[1] == "reaches the end of the range, 1.2"
    short = follow_branch(system, branch.orbits[0], -1.0, 0.5, longest=0.06)
    places = np.array([[*orbit.points[0], orbit.parameter] for orbit in short.orbits])
    # a correction is orthogonal to a step, and shorter than half of it
    assert 0.05 < np.linalg.norm(np.diff(places, axis=0), axis=1).max() <= np.hypot(0.06, 0.03)
    two = follow_branch(system, doubled_orbit(system, flip), -1.0, 1.2)
    (flip,) = of_kind(two, "flip")
    assert flip.parameter == closely((1 - B) ** 2 + (1 + B) ** 2 / 4) and flip.orbit.period == 2
    assert "meets the orbit of period 1" in two.ends


def test_a_branch_is_followed_one_way_and_no_farther_than_asked():
    system, limits = OrbitMap(henon), {"low": -1.0, "high": 1.2, "most": 40}
    first = find_orbit(system, [0.6, 0.2], 0.2)
    up, down = (follow_branch(system, first, **limits, ahead=ahead) for ahead in (1, -1))
    both = follow_branch(system, first, **limits)
    assert [*down.parameters, *up.parameters[1:]] == pytest.approx(both.parameters)
    assert [[event.kind for event in branch.events] for branch in (up, down)] == [["flip"], ["fold"]]
    assert up.ends == ("it was not followed that way", both.ends[1])
    assert down.ends == (both.ends[0], "it was not followed that way")
    behind = follow_branch(system, both.orbits[-2], **limits)
    assert [event.kind for event in behind.events] == ["fold", "flip"]
    short = follow_branch(system, first, **limits, ahead=-1, enough=lambda _, events: bool(events))
    assert short.parameters == pytest.approx(down.parameters[-len(short.orbits) :])
    assert len(short.orbits) < len(down.orbits) and [event.kind for event in short.events] == ["fold"]


@pytest.mark.parametrize(
    ("system", "start", "at", "ends", "period", "event"),
    [
        (OrbitMap(logistic, along=lambda z, r: z * (1.0 - z)), [0.16], 3.84, (3.0, 3.84), 3, ("fold", 1 + 8**0.5, 0.0)),
        (OrbitMap(delayed_logistic), [0.4, 0.4], 1.7, (1.5, 2.4), 1, ("torus", 2.0, np.pi / 3)),
        (OrbitMap(steep), [-0.1], -0.2, (-0.3, 0.3), 1, ("flip", 0.0, np.pi)),
    ],
    ids=["period 3 of the logistic map", "delayed logistic map", "a steep multiplier, which does not leap"],
)
def test_an_event_is_told_with_its_kind_its_place_and_its_angle(system, start, at, ends, period, event):
    branch = follow_branch(system, find_orbit(system, start, at, period), *ends)
    (seen,) = branch.events
    assert (seen.kind, seen.parameter, seen.angle_rad) == (event[0], closely(event[1]), closely(event[2]))
    assert abs(seen.parameter - event[1]) <= seen.error + 1e-8


@pytest.mark.parametrize("middle", [0.55, 0.6, 0.65, 0.7, 0.75, 0.8])
def test_two_flips_between_neighbours_of_a_branch_are_both_found(middle):
    """Multiplier -1 - (1 + a) (1 - ((a - middle)/0.05)^2)/10 of the fixed point 0."""

    def bubble(z, a):
        slope = -1.0 - 0.1 * (1.0 + a) * (1.0 - ((a - middle) / 0.05) ** 2)
        return slope * z + z**3, lambda V: (slope + 3.0 * z[:, None] ** 2) * V

    system = OrbitMap(bubble)
    branch = follow_branch(system, find_orbit(system, [0.0], 0.1), 0.0, 1.0, longest=0.3)
    assert [event.kind for event in branch.events] == ["flip", "flip"]
    assert [event.parameter for event in branch.events] == closely([middle - 0.05, middle + 0.05])
    assert not all(orbit.stable for orbit in branch.orbits)


def test_a_fold_is_passed_in_a_range_so_narrow_that_it_is_a_corner():
    """Beside the fold of Henon's map x is its distance in a to the power 1/2: 0.007 over a range that counts as 1."""
    fold = -(0.7**2) / 4
    system = OrbitMap(henon, parameter_size=5e-5)
    first = find_orbit(system, [-0.33, -0.1], fold + 2e-5)
    branch = follow_branch(system, first, fold - 5e-5, fold + 5e-5, least=2e-3)
    assert [event.kind for event in branch.events] == ["fold"]
    assert branch.events[0].parameter == closely(fold)
    assert branch.ends == (f"reaches the end of the range, {fold + 5e-5:g}",) * 2


def test_an_island_closes_with_its_two_folds():
    system = OrbitMap(island)
    branch = follow_branch(system, find_orbit(system, [1.4], 2.0), 0.0, 4.0)
    assert branch.closed and "comes back" in branch.ends[0] and len(of_kind(branch, "fold")) == 2
    assert sorted(e.parameter for e in branch.events) == [closely(1.5), closely(2.5)]
    assert np.hypot([o.points[0, 0] - 1 for o in branch.orbits], branch.parameters - 2) == closely(0.5)


def test_a_system_that_takes_steps_quotes_what_other_steps_change():
    system = in_steps(1e-4, 0)
    first = find_orbit(system, [0.6], 2.8)
    branch = follow_branch(system, first, 2.5, 3.3, least=1e-3)
    (flip,) = branch.events
    assert abs(flip.parameter - 3.0) < flip.error < 2e-3
    scatter = scatter_of(system, first)
    assert len(scatter.orbits) == 2 and abs(first.multipliers[0] + 0.8) < 2 * scatter.multipliers[0] < 2e-3
    assert 0.0 < scatter.points.max() < 1e-4 and not scatter_of(OrbitMap(logistic), first).points.any()


def test_a_branch_ends_in_words_where_the_map_does():
    def breaking(z, r):
        if r > 2.9:
            raise NoImage("a loop is released")
        return logistic(z, r)

    branch = follow_branch(OrbitMap(breaking), find_orbit(OrbitMap(breaking), [0.6], 2.7), 2.5, 3.5)
    assert branch.ends[1].endswith("a loop is released") and 2.89 < branch.parameters.max() <= 2.9


@pytest.mark.parametrize("period", [1, 3, 8])
def test_orbits_of_eq_33_repeat_have_its_contraction_and_the_same_multipliers_from_any_strobe(period):
    system, starts = snap_map(PAPER), random_starts(60, 100 + period)
    orbits = search_periodic_orbits(PAPER, period, starts)
    assert orbits
    for orbit in orbits:
        strobes = strobed_states(PAPER, orbit.points[0], period + 1)
        assert strobes[:period] == pytest.approx(orbit.points, abs=1e-8 * np.abs(orbit.multipliers[0]).clip(1.0))
        contraction = np.exp(-PAPER.damping * period * PAPER.period)
        assert np.prod(orbit.multipliers).real == pytest.approx(contraction, rel=1e-8)
        rotated = find_orbit(system, np.roll(orbit.points, 1, axis=0), PAPER.force, period, tolerance=1e-13)
        assert rotated.multipliers == pytest.approx(orbit.multipliers, rel=1e-8, abs=1e-8)


def bent(below, above, square=0.0):
    """x' = slope x + r + square x^2, the slope `below` 0 and `above`: its fixed point crosses 0 at r = 0."""

    def step(z, r):
        slope = below if z[0] < 0.0 else above
        return slope * z + r + square * z**2, lambda V: (slope + 2.0 * square * z[:, None]) * V

    return step


def collision(below, above):
    """The normal form of a border collision: (trace, determinant) on both sides of x = 0."""

    def step(z, r):
        trace, determinant = below if z[0] <= 0.0 else above
        matrix = np.array([[trace, 1.0], [-determinant, 0.0]])
        return matrix @ z + [r, 0.0], lambda V: matrix @ V

    return step


def quintic(z, r, c=0.2):
    """x' = -(1 + r) x - c x^3 + x^5: period 2 with r = -c x^2 + x^4 leaves the flip at 0 and folds at -c^2/4."""
    return -(1.0 + r) * z - c * z**3 + z**5, lambda V: (-(1.0 + r) - 3.0 * c * z**2 + 5.0 * z**4)[:, None] * V


def in_steps(size, seed, step=logistic, apart=2.0):
    """A map with steps: they change the parameter by the share `size`, as irregularly as a mesh that adapts itself.
    apart: of the meshes at one orbit (rad)."""

    def frozen(points, r, mesh=0):
        shift = size * np.sin(1e7 * (r + float(points[0][0])) + apart * mesh + seed)
        return [lambda z, s: step(z, s * (1.0 + shift))] * len(points)

    return OrbitMap(step, frozen=frozen, meshes=3)


def crossing_0(system, start=(-0.1,), **more):
    return follow_branch(system, find_orbit(system, start, -0.2), -0.3, 0.3, **more)


@pytest.mark.parametrize("square", [0.0, 0.05])
@pytest.mark.parametrize(
    "slopes", [(-0.7, -1.6), (-0.95, -1.05), (-0.97, -1.6), (-0.3, -9.0), (0.8, 1.5), (0.99, 1.2), (0.4, -1.7)]
)
def test_a_corner_of_a_map_is_no_flip_and_no_fold(slopes, square):
    branch = crossing_0(OrbitMap(bent(*slopes, square)))
    assert not branch.events and branch.parameters.max() < 2e-3
    assert "no step above" in branch.ends[1], "the branch says why it ends at the corner"


PAIR, FLIP = ((0.5, 0.6), (0.5, 2.2)), ((-1.5, 0.6), (-1.9, 0.8))
SMOOTH = {"least": 1e-4, "accuracy": 1e-9}
IN_STEPS = {"least": 2e-3, "accuracy": 1e-2}


@pytest.mark.parametrize(
    ("sides", "size", "settings", "beyond"),
    [
        *((sides, 0.0, SMOOTH, 1e-9) for sides in (PAIR, ((0.5, 0.99), (0.5, 1.01)), ((-0.5, 0.6), (0.4, 5.0)))),
        *((sides, 1e-3, IN_STEPS, 2e-3) for sides in (PAIR, FLIP)),
    ],
)
def test_multipliers_that_leap_across_the_unit_circle_are_no_event_whatever_the_steps(sides, size, settings, beyond):
    step = collision(*sides)
    branch = crossing_0(in_steps(size, 1, step) if size else OrbitMap(step), [-0.1, 0.0], **settings)
    assert not branch.events and "not smooth" in branch.ends[1]
    assert size or branch.parameters.max() > -1e-3
    assert branch.parameters.max() <= beyond


@pytest.mark.parametrize("c", [0.05, 0.2, 0.5])
def test_a_flip_and_the_fold_beside_it_are_told_once_each(c):
    system = OrbitMap(lambda z, r: quintic(z, r, c))
    single = follow_branch(system, find_orbit(system, [0.01], -0.3), -0.4, 0.2)
    (flip,) = single.events
    assert flip.kind == "flip" and flip.parameter == closely(0.0)
    two = follow_branch(system, doubled_orbit(system, flip, amplitude=0.01), -0.4, 0.2, step=0.02, longest=0.05)
    assert [fold.parameter for fold in of_kind(two, "fold")] == [closely(-(c**2) / 4)]
    assert "meets the orbit of period 1" in two.ends


@pytest.mark.parametrize(
    ("step", "start"),
    [
        (lambda z, r: logistic(z, r + 1.0), 0.0),
        (bent(-0.3, -0.8), -0.1),
        (bent(0.2, 0.4), -0.1),
        (bent(-1.2, -1.7), -0.1),
    ],
)
def test_a_corner_that_leaves_the_stability_and_a_multiplier_1_without_a_turn_are_no_events(step, start):
    """0 is a fixed point of the logistic map for every r: at r = 1 it meets another."""
    branch = crossing_0(OrbitMap(step), [start])
    assert not branch.events and branch.parameters.max() == 0.3


@pytest.mark.parametrize("seed", range(6))
def test_steps_make_no_fold_of_a_flip_and_hide_no_flip(seed):
    system = in_steps(2e-4, seed)
    single = follow_branch(system, find_orbit(system, [0.6], 2.8), 2.6, 3.3, least=1e-3, accuracy=1e-2)
    (flip,) = single.events
    assert flip.kind == "flip" and abs(flip.parameter - 3.0) < 2e-3
    two = doubled_orbit(system, flip, amplitude=0.03)
    branch = follow_branch(system, two, 2.8, 3.4, least=2e-3, accuracy=1e-2)
    assert not branch.events and any("meets the orbit" in end for end in branch.ends)


def test_the_error_of_an_event_counts_what_steps_change_from_one_orbit_to_the_next_though_meshes_agree():
    off = []
    for seed in range(12):
        system = in_steps(2e-4, seed, apart=1e-4)
        branch = follow_branch(system, find_orbit(system, [0.6], 2.8), 2.6, 3.3, least=1e-3, accuracy=1e-2)
        (flip,) = branch.events
        off.append(abs(flip.parameter - 3.0) / flip.error)
    assert np.median(off) < 1.0 and np.mean(np.array(off) < 2.0) > 0.7


@pytest.mark.parametrize("false", range(3))
def test_of_three_sequences_of_steps_a_false_one_is_not_believed_and_its_distance_is_the_error(false):
    shifts = np.array([0.05 if mesh == false else 1e-3 * mesh for mesh in range(3)])

    def frozen(points, r, mesh=0):
        return [lambda z, s: logistic(z, s + shifts[mesh])] * len(points)

    system = OrbitMap(logistic, frozen=frozen, meshes=3)
    orbit, errors = middle_of(system, find_orbit(system, [0.6], 2.5))
    middle = np.median(shifts)
    assert orbit.multipliers[0] == pytest.approx(2.0 - 2.5 - middle, abs=1e-4)
    assert errors[0] == pytest.approx(abs(shifts - middle).max(), abs=1e-4)


def test_a_map_that_carries_eight_directions_at_once_gives_its_multipliers_in_fewer_turns():
    """A linear map of 60 coordinates, 20 of them slow: an orbit needs many directions, most of them at no cost."""
    generator = np.random.default_rng(3)
    basis, _ = np.linalg.qr(generator.normal(size=(60, 60)))
    moduli = np.concatenate([np.linspace(0.95, 0.4, 20), np.full(40, 1e-4)])
    matrix, turns = basis @ np.diag(moduli) @ basis.T, []

    def step(z, shift):
        def linearised(V):
            turns.append(-(-V.shape[1] // 8))
            return matrix @ V

        return matrix @ z + shift, linearised

    counts = []
    for abreast in (1, 8):
        turns.clear()
        orbit = find_orbit(OrbitMap(step, abreast=abreast), np.ones(60), 0.3, count=4)
        assert orbit.multipliers == pytest.approx(moduli[:4], abs=1e-8)
        counts.append(sum(turns))
    assert counts[1] < 0.85 * counts[0]
