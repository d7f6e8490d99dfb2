"""What happens to an orbit along a branch: folds, flips and torus points, and the orbit of twice the period at a flip.

    event    function that changes its sign along the branch   what is asked of the zero
    fold     product of 1 - mu_i over the multipliers          the parameter turns back
    flip     product of 1 + mu_i                               one is real and near -1
    torus    product of 1 - mu_i mu_j over pairs i < j         a conjugate pair is near the unit circle

A real multiplier that enters or leaves the largest ones does not change a sign; two reals with mu_i mu_j = 1 do, and
are no torus point. The zero is found between two orbits of the branch by Brent's method (1973), with one set of steps
of the system and orbits in the planes across the chord; on its other meshes by one secant.

At a flip M v = -v. The orbit of twice the period leaves it along v, and so begins as the orbit twice, displaced by
v, Jv, ... The correction is orthogonal to v and the parameter is free (equation (b) of `spaces` with t = (v, 0)).
"""

from collections import namedtuple
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from analysis.orbits.finding import (
    KEPT,
    TOLERANCE,
    Newton,
    Orbit,
    corrected,
    described,
    not_found,
    real_span,
    solved_near,
)
from analysis.orbits.maps import NoImage, OrbitMap, shoot
from analysis.orbits.spaces import Space

CLOSE, ROUGH = 1e-2, 0.1  # of a multiplier at an event to what it should be; of a system in steps
ACCURACY = 1e-9  # of a chord, to which an event is located
ROUNDING = 1e-10  # of a test function; a map that conserves area has 1 - mu_1 mu_2 = 0 everywhere
NEARBY = 0.3  # distance, in chords, over which the slope of a test function is taken
ON_WAY = 0.01  # of the change of the parameter
# An orbit of a branch; change (N, n) and rate: the tangent, of the points and of the parameter; slopes (N, n)
Place = namedtuple("Place", "orbit change rate slopes")


@dataclass(frozen=True, eq=False)
class Event:
    """A fold, flip or torus point.

    kind        "fold", "flip" or "torus"
    parameter   where
    error       of the parameter: of the search, and what the other meshes of the system change; inf where one of them
                has no such orbit
    orbit       there
    angle_rad   of the multiplier that crosses the unit circle: 0 fold, pi flip, between them torus
    """

    kind: str
    parameter: float
    error: float
    orbit: Orbit
    angle_rad: float


def turned(multipliers: np.ndarray) -> float:
    """Product of 1 - mu_i mu_j over pairs."""
    i, j = np.triu_indices(len(multipliers), 1)
    return float(np.prod(1.0 - multipliers[i] * multipliers[j]).real)


TESTS = {
    "fold": lambda multipliers: float(np.prod(1.0 - multipliers).real),
    "flip": lambda multipliers: float(np.prod(1.0 + multipliers).real),
    "torus": turned,
}


def near_orbits(tolerance: float) -> Newton:
    """From one orbit to the next: where Newton's method is slow, a shorter step is better."""
    return Newton(tolerance, 8, 2, KEPT)


def events_between(
    system: OrbitMap, before: Place, after: Place, count: int, tolerance: float, accuracy: float
) -> list[Event]:
    """Events between two neighbours of a branch; none where their multipliers are not settled."""
    found = []
    if not (before.orbit.settled and after.orbit.settled):
        return found
    for kind, test in TESTS.items():
        ends = [test(place.orbit.multipliers) for place in (before, after)]
        if min(np.abs(ends)) > ROUNDING and ends[0] * ends[1] < 0.0:
            found.append(_Chord(system, test, before, after, count, tolerance).event(kind, accuracy))
    backwards = after.orbit.parameter < before.orbit.parameter
    return sorted((event for event in found if event), key=lambda event: event.parameter, reverse=backwards)


class _Chord:
    """Orbits between two places, in the planes across the way from one to the other."""

    def __init__(self, system, test, begin, end, count, tolerance):
        self.system, self.test, self.begin, self.end = system, test, begin, end
        self.count, self.tolerance, self.size = count, tolerance, system.parameter_size
        way = end.orbit.points[0] - begin.orbit.points[0]
        by = (end.orbit.parameter - begin.orbit.parameter) / self.size
        self.length = system.length(way, by)
        self.across = system.row(way, by) / self.length
        self.seen = {share: (place.orbit, test(place.orbit.multipliers)) for share, place in ((0.0, begin), (1.0, end))}

    def between(self, share):
        """Points, parameter and slopes at a share of the way, from the nearest orbits that were found."""
        a = max((s for s in self.seen if s <= share), default=0.0)
        b = min((s for s in self.seen if s >= share), default=1.0)
        before, after = self.seen[a][0], self.seen[b][0]
        part = (share - a) / (b - a) if b > a else 0.0
        points = before.points + part * (after.points - before.points)
        parameter = before.parameter + part * (after.parameter - before.parameter)
        return points, parameter, self.begin.slopes + share * (self.end.slopes - self.begin.slopes)

    def look(self, maps, share):
        """The orbit at a share of the way, and the test function there."""
        points, parameter, slopes = self.between(share)
        directions = real_span(self.begin.orbit.vectors)
        solved = corrected(maps, points, parameter, near_orbits(self.tolerance), self.across, directions, slopes)
        orbit, _ = described(solved, self.count)
        return orbit, self.test(orbit.multipliers)

    def event(self, kind, accuracy):
        """The event, or None where the sign changes for another reason."""
        begin, end = self.begin.orbit, self.end.orbit
        first, last = self.seen[0.0][1], self.seen[1.0][1]
        turns = kind != "fold" or self.begin.rate * self.end.rate < 0.0

        def value(share):
            if share not in self.seen:
                self.seen[share] = self.look(maps, share)
            return self.seen[share][1]

        try:
            points, parameter, _ = self.between(first / (first - last))
            maps = self.system.near(points, parameter)
            share = brentq(value, 0.0, 1.0, xtol=accuracy, rtol=4e-16 + accuracy, maxiter=40, disp=False)
        except ArithmeticError:  # no orbit there, or none with these steps of the system: as near as the branch tells
            nearest = begin if abs(first) < abs(last) else end
            error = self.length * self.size * max(abs(self.begin.rate), abs(self.end.rate))
            return _event(kind, nearest, nearest.parameter, error, ROUGH) if turns else None
        orbit, at = self.seen[share]
        inside = (orbit.parameter - begin.parameter) / (end.parameter - begin.parameter or 1.0)
        if not turns and ON_WAY < inside < 1.0 - ON_WAY:
            return None
        if self.system.frozen is None:
            across = [other.parameter for s, (other, worth) in self.seen.items() if worth * at <= 0.0 and s != share]
            error = min((abs(other - orbit.parameter) for other in across), default=0.0)
            return _event(kind, orbit, orbit.parameter, error + self.size * ROUNDING)
        try:
            every = [self.elsewhere(mesh, share) for mesh in range(self.system.meshes)]
        except ArithmeticError:
            return _event(kind, orbit, orbit.parameter, np.inf, ROUGH)
        middle = float(np.median(every))
        return _event(kind, orbit, middle, max(abs(middle - other) for other in every), ROUGH)

    def elsewhere(self, mesh, share):
        """The parameter of the event with the steps of a mesh at the orbit that was found: one orbit there, and slopes
        from the chord, because those of a map in steps are rough from one orbit to the next."""
        found, at = self.seen[share]
        nearby = min((s for s in self.seen if s != share), key=lambda s: abs(abs(s - share) - NEARBY))
        orbit, worth = self.seen[nearby]
        maps = self.system.near(found.points, found.parameter, mesh)
        other, there = self.look(maps, share)
        return other.parameter + there / (at - worth) * (orbit.parameter - found.parameter)


def _event(kind, orbit, parameter, error, close=CLOSE):
    """The Event, or None where no multiplier is near what it should be."""
    mu = orbit.multipliers
    angle = {"fold": 0.0, "flip": np.pi}.get(kind)
    if kind == "torus":
        pairs = mu[mu.imag > 0.0]
        pairs = pairs[np.abs(np.abs(pairs) - 1.0) < close]
        if not len(pairs):
            return None
        angle = float(np.angle(pairs[np.argmin(np.abs(np.abs(pairs) - 1.0))]))
    elif kind == "flip" and np.abs(mu + 1.0).min() > close:
        return None
    return Event(kind, float(parameter), float(error), orbit, angle) if orbit.settled else None


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
    orbit, twice = flip.orbit, np.tile(flip.orbit.points, (2, 1))
    v = orbit.vectors[:, np.argmin(np.abs(orbit.multipliers + 1.0))].real
    v, directions = v / system.length(v, 0.0), real_span(orbit.vectors)
    try:
        shots = shoot(system.near(twice, orbit.parameter), twice, orbit.parameter)
        ways = Space(shots.linearised, v[:, None]).ways[:-1]
        guess = twice + amplitude * np.linalg.norm(v) * np.array(ways)[:, :, 0]
        solved = solved_near(system, guess, orbit.parameter, Newton(tolerance), system.row(v, 0.0), directions)
        first, half = solved.points[[0, orbit.period]]
        if system.length(first - half, 0.0) < amplitude:
            raise NoImage("Newton's method came back to the orbit of half the period")
        return described(solved, count)[0]
    except ArithmeticError as why:
        return not_found(twice, orbit.parameter, why)
