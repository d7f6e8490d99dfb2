"""What happens to an orbit along a branch: folds, flips and torus points, and the orbit of twice the period at a flip.

    event    function that changes its sign                    what is asked of it at its zero
    fold     change of the parameter along the branch
    flip     product of 1 + mu_i over the multipliers          one is real and near -1
    torus    product of 1 - mu_i mu_j over pairs i < j         a conjugate pair near the unit circle

A real multiplier that enters or leaves the largest ones does not change a sign; two reals with mu_i mu_j = 1 do, and
are no torus point. The zero is found between two orbits of the branch by Brent's method (1973), with one set of steps
of the system and orbits in the planes across the chord.

At a flip M v = -v. The orbit of twice the period leaves it along v, and so begins as the orbit twice, displaced by
v, Jv, ... The correction is orthogonal to v and the parameter is free (equation (c) of `finding` with t = (v, 0)).
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from analysis.orbits.finding import TOLERANCE, Orbit, corrected, described, multipliers_of, not_found, update
from analysis.orbits.maps import NoImage, OrbitMap, shoot

CLOSE = 1e-2  # of a multiplier at an event to what it should be
SHARE = 1e-9  # of a chord, to which an event is located
NEWTON = 12


@dataclass(frozen=True, eq=False)
class Event:
    """A fold, flip or torus point.

    kind        "fold", "flip" or "torus"
    parameter   where
    error       of the parameter, from the search: the nearest orbit on its other side, and Newton's next step. What
                another set of steps of the system would change is not in it
    orbit       there
    angle_rad   of the multiplier that crosses the unit circle: 0 fold, pi flip, between them torus
    """

    kind: str
    parameter: float
    error: float
    orbit: Orbit
    angle_rad: float


def folded(multipliers: np.ndarray, rate: float) -> float:
    """Change of the parameter along the branch."""
    return rate


def flipped(multipliers: np.ndarray, rate: float) -> float:
    """Product of 1 + mu."""
    return float(np.prod(1.0 + multipliers).real)


def turned(multipliers: np.ndarray, rate: float) -> float:
    """Product of 1 - mu_i mu_j over pairs."""
    i, j = np.triu_indices(len(multipliers), 1)
    return float(np.prod(1.0 - multipliers[i] * multipliers[j]).real)


TESTS = {"fold": folded, "flip": flipped, "torus": turned}
ROUNDING = 1e-10  # of a test function; a map that conserves area has 1 - mu_1 mu_2 = 0 everywhere


def events_between(system: OrbitMap, before: tuple, after: tuple, count: int, tolerance: float) -> list[Event]:
    """Events between two neighbours of a branch: places with orbit, change and rate (`analysis.orbits.branches`)."""
    found = []
    for kind, test in TESTS.items():
        ends = [test(place.orbit.multipliers, place.rate) for place in (before, after)]
        if min(np.abs(ends)) > ROUNDING and ends[0] * ends[1] < 0.0:
            found.append(_located(system, kind, before, after, ends, count, tolerance))
    return sorted((event for event in found if event is not None), key=lambda event: event.parameter,
                  reverse=after.orbit.parameter < before.orbit.parameter)  # fmt: skip


def _located(system, kind, begin, end, ends, count, tolerance):
    """The event between two places, or None where the sign changes for another reason."""
    test, size, before, after = TESTS[kind], system.parameter_size, begin.orbit, end.orbit
    move, by = after.points - before.points, after.parameter - before.parameter
    chord = np.append(move[0], by / size)
    length = np.linalg.norm(chord)
    chord /= length
    seen = {}

    def value(share):
        guess = before.points + share * move, before.parameter + share * by
        solved = corrected(maps, *guess, chord, tolerance, NEWTON)
        if solved.reason:
            raise NoImage(solved.reason)
        change, rate = update(solved.shots, np.zeros_like(solved.points), chord, 1.0)
        values = multipliers_of(solved.shots, count)[0]
        seen[share] = solved, test(values, rate / np.hypot(np.linalg.norm(change[0]), rate))
        return seen[share][1]

    guess = ends[0] / (ends[0] - ends[1])
    try:
        maps = system.near(before.points + guess * move, before.parameter + guess * by)
        share = brentq(value, 0.0, 1.0, xtol=SHARE, rtol=4 * SHARE, maxiter=40, disp=False)
        value(share)
    except (NoImage, ValueError):  # no orbit there; or none with these steps of the system: as near as the branch tells
        nearest = before if abs(ends[0]) < abs(ends[1]) else after
        return _event(kind, nearest, length * size * max(abs(begin.rate), abs(end.rate)))
    solved, at = seen[share]
    across = [other for other, worth in seen.values() if worth * at <= 0.0 and other is not solved]
    error = min((abs(other.parameter - solved.parameter) for other in across), default=0.0)
    left = abs(update(solved.shots, solved.shots.gaps, chord, 0.0)[1])  # what Newton's next step would change
    return _event(kind, described(solved, count), error + size * (left + ROUNDING))


def _event(kind, orbit, error):
    """The Event, or None where no multiplier is near what it should be."""
    mu = orbit.multipliers
    angle = {"fold": 0.0, "flip": np.pi}.get(kind)
    if kind == "torus":
        pairs = mu[mu.imag > 0.0]
        pairs = pairs[np.abs(np.abs(pairs) - 1.0) < CLOSE]
        if not len(pairs):
            return None
        angle = float(np.angle(pairs[np.argmin(np.abs(np.abs(pairs) - 1.0))]))
    elif kind == "flip" and np.abs(mu + 1.0).min() > CLOSE:
        return None
    return Event(kind, orbit.parameter, error, orbit, angle)


def doubled_orbit(
    system: OrbitMap, flip: Event, *, amplitude: float = 0.01, count: int = 6, tolerance: float = TOLERANCE
) -> Orbit:
    """The orbit of twice the period that leaves a flip (head of this file).

    flip        an Event of that kind
    amplitude   distance of its first point from that of the orbit at the flip
    Returns an Orbit, whose `reason` says where there is none: a larger amplitude may help.
    Raises ValueError for another event.
    """
    if flip.kind != "flip":
        raise ValueError(f"flip: an event of that kind is needed, given a {flip.kind}")
    orbit = flip.orbit
    v = orbit.vectors[:, np.argmin(np.abs(orbit.multipliers + 1.0))].real
    v, twice = v / np.linalg.norm(v), np.tile(orbit.points, (2, 1))
    maps = system.near(twice, orbit.parameter)
    shots = shoot(maps, twice, orbit.parameter, False)
    guess = twice + amplitude * shots.chain(v, np.zeros_like(twice))[:-1]
    solved = corrected(maps, guess, orbit.parameter, np.append(v, 0.0), tolerance, 2 * NEWTON)
    if solved.reason:
        return not_found(solved.points, solved.parameter, solved.iterations, solved.reason)
    first, half = solved.points[[0, orbit.period]]
    if np.linalg.norm(first - half) < amplitude:
        why = "Newton's method came back to the orbit of half the period"
        return not_found(solved.points, solved.parameter, solved.iterations, why)
    return described(solved, count)
