"""What happens to an orbit along a branch: folds, flips and torus points, and the orbit of twice the period at a flip.

    event    function that changes its sign along the branch   what is asked of the zero
    fold     product of 1 - mu_i over the multipliers          the parameter turns back
    flip     product of 1 + mu_i                               one is real and near -1
    torus    product of 1 - mu_i mu_j over pairs i < j         a conjugate pair is near the unit circle

A real multiplier that enters or leaves the largest ones does not change a sign; two reals with mu_i mu_j = 1 do, and
are no torus point. The zero is found between two orbits of the branch by Brent's method (1973), with one set of steps
of the system and orbits in the planes across the chord; on its other meshes by one secant. These agree better with each
other than with orbits that have steps of their own, so the error counts the zero between two of the latter, too.

At a flip M v = -v. The orbit of twice the period leaves it along v, and so begins as the orbit twice, displaced by
v, Jv, ... The correction is orthogonal to v and the parameter is free (equation (b) of `spaces` with t = (v, 0)).
"""

from collections import namedtuple
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from analysis.orbits.finding import (
    KEPT,
    ROUGH,
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

CLOSE = 2e-3  # of a multiplier on both sides of an event to what it is there; `finding.SETTLED` is below
ACCURACY = 1e-9  # of a chord, to which an event is located
CLOSER, LEAST = 1e-2, 1e-9  # an event is located this much better, to so much at best, until its multiplier is CLOSE
ROUNDING = 1e-10  # of a test function; a map that conserves area has 1 - mu_1 mu_2 = 0 everywhere
WIDE = 0.1, 0.2, 0.4, 0.8  # chords: so near to an event one set of steps of the system suits the orbits on both sides
# From one orbit to the next: where Newton's method is slow, a shorter step is better.
NEAR_ORBITS = Newton(iterations=8, halvings=2, kept=KEPT)
# An orbit of a branch; change (N, n) and rate: the tangent, of the points and of the parameter; slopes (N, n)
Place = namedtuple("Place", "orbit change rate slopes")


@dataclass(frozen=True, eq=False)
class Event:
    """A fold, flip or torus point.

    kind        "fold", "flip" or "torus"
    parameter   where
    error       of the parameter: of the search, and what other steps of the system change; inf where a mesh has no such
                orbit
    orbit       there
    angle_rad   of the multiplier that crosses the unit circle: 0 fold, pi flip, between them torus
    """

    kind: str
    parameter: float
    error: float
    orbit: Orbit
    angle_rad: float


def pairs_of(multipliers: np.ndarray) -> np.ndarray:
    """1 - mu_i mu_j over pairs."""
    i, j = np.triu_indices(len(multipliers), 1)
    return 1.0 - multipliers[i] * multipliers[j]


FACTORS = {
    "fold": lambda multipliers: 1.0 - multipliers,
    "flip": lambda multipliers: 1.0 + multipliers,
    "torus": pairs_of,
}


def test_of(factors: Callable, orbit: Orbit) -> float:
    """The product that changes its sign at an event."""
    return float(np.prod(factors(orbit.multipliers)).real)


def events_between(system: OrbitMap, begin: Place, end: Place, count: int, accuracy: float) -> list[Event]:
    """Events between two neighbours of a branch; none where their multipliers are not settled.

    Raises NoImage where multipliers leap across the unit circle, or an orbit in between is not found.
    """
    events = []
    if not (begin.orbit.settled and end.orbit.settled):
        return events
    for kind, factors in FACTORS.items():
        chord = _Chord(system, factors, begin.orbit, end, count)
        ends = [chord.test(place.orbit) for place in (begin, end)]
        if min(np.abs(ends)) > ROUNDING and ends[0] * ends[1] < 0.0:
            event = chord.event(kind, accuracy)
            events += [event] if event else []
    backwards = end.orbit.parameter < begin.orbit.parameter
    return sorted(events, key=lambda event: event.parameter, reverse=backwards)


class _Chord:
    """Orbits between two neighbours, in the planes across the way from one to the other."""

    def __init__(self, system, factors, begin, end, count):
        self.system, self.factors, self.slopes, self.count = system, factors, end.slopes, count
        way = end.orbit.points[0] - begin.points[0]
        by = (end.orbit.parameter - begin.parameter) / system.parameter_size
        self.across = system.row(way, by) / system.length(way, by)
        self.orbits = {0.0: begin, 1.0: end.orbit}
        self.values = {share: self.test(orbit) for share, orbit in self.orbits.items()}
        self.maps = None  # None: every orbit takes steps of its own

    def test(self, orbit):
        return test_of(self.factors, orbit)

    def between(self, share):
        """Points and parameter at a share of the way, from the nearest orbits found; beyond the ends, from these."""
        shares = sorted(self.orbits)
        right = min(max(int(np.searchsorted(shares, share)), 1), len(shares) - 1)
        a, b = shares[right - 1 : right + 1] if 0.0 <= share <= 1.0 else (0.0, 1.0)
        lower, upper, part = self.orbits[a], self.orbits[b], (share - a) / (b - a)
        points = lower.points + part * (upper.points - lower.points)
        return points, lower.parameter + part * (upper.parameter - lower.parameter)

    def solved(self, maps, share, tolerance):
        """What Newton's method finds at a share of the way. maps: None for steps of its own."""
        newton = NEAR_ORBITS._replace(tolerance=tolerance)
        arguments = *self.between(share), newton, self.across, real_span(self.orbits[0.0].vectors), self.slopes
        if maps is None:
            return solved_near(self.system, *arguments)
        return corrected(maps, *arguments)

    def look(self, maps, share):
        """The orbit at a share of the way."""
        return described(self.solved(maps, share, self.system.tolerance), self.count)[0]

    def value(self, share):
        """The test function."""
        if share not in self.values:
            self.orbits[share] = self.look(self.maps, share)
            self.values[share] = self.test(self.orbits[share])
        return self.values[share]

    def bracket(self, low, high, accuracy):
        """The share of the zero, and the two shares nearest to it with the zero between them."""
        share = brentq(self.value, low, high, xtol=accuracy, rtol=4e-16 + accuracy, maxiter=60, disp=False)
        opposite = [other for other in self.values if self.values[other] * self.values[share] <= 0.0]
        return share, *sorted((share, min(opposite, key=lambda other: abs(other - share))))

    def crossing(self, low, high):
        """The parameter of the zero by interpolation between two orbits with the zero between them."""
        rising = sorted((low, high), key=self.values.get)
        parameters = [self.orbits[share].parameter for share in rising]
        return float(np.interp(0.0, [self.values[share] for share in rising], parameters))

    def event(self, kind, accuracy):
        """The event; None where the sign changes for another reason. Raises NoImage (`events_between`)."""
        low, high = 0.0, 1.0
        if self.system.frozen is not None:
            share, low, high = self.bracket(low, high, WIDE[0])
            with_own_steps = self.crossing(low, high)
            self.maps, self.values = self.system.near(self.orbits[share].points, self.orbits[share].parameter), {}
            tried = ((low - wide, high + wide) for wide in WIDE)
            low, high = next((pair for pair in tried if self.value(pair[0]) * self.value(pair[1]) < 0.0), (None, None))
            if low is None:
                return None  # it is the sign of the steps that changes
        while True:  # a continuous multiplier closes in, one that leaps does not
            share, low, high = self.bracket(low, high, accuracy)
            orbit, sides = self.orbits[share], (self.orbits[low], self.orbits[high])
            off = max(np.abs(self.factors(side.multipliers)).min() for side in sides)
            if off <= CLOSE or accuracy <= LEAST:
                break
            accuracy *= CLOSER
        if off > CLOSE:
            if _unstable(sides[0]) == _unstable(sides[1]):
                return None  # one that enters or leaves the largest ones
            leap = " to ".join(f"{np.abs(side.multipliers).max():.3g}" for side in sides)
            parameter = f"{orbit.parameter:.6g}, where the map is not smooth"
            raise NoImage(f"the largest multiplier leaps from {leap} in modulus at {parameter}")
        angle = angle_of(kind, orbit.multipliers)
        if angle is None or not orbit.settled:
            return None
        if self.maps is None:
            search = self.system.parameter_size * max(ROUNDING, orbit.gap)
            value, error = orbit.parameter, abs(sides[1].parameter - sides[0].parameter) + search
        else:
            value, error = self.on_meshes(orbit, share)
            error = max(error, abs(value - with_own_steps))
        if kind == "fold" and not self.turns(orbit, error):
            return None
        return Event(kind, value, error, orbit, angle)

    def on_meshes(self, orbit, share):
        """The median of the parameters of the event on all meshes, and its error; inf where a mesh has no event."""
        try:
            parameters = np.array([self.elsewhere(mesh, share) for mesh in range(self.system.meshes)])
        except ArithmeticError:
            return orbit.parameter, np.inf
        middle = float(np.median(parameters))
        return middle, float(np.abs(middle - parameters).max())

    def turns(self, orbit, error):
        """Whether the parameter turns back at an orbit. Where steps scatter it by more than it changes along the chord,
        it is compared a chord away on both sides. An orbit whose halves are as near as that is no fold, but the flip of
        half its period."""
        ends = self.orbits[0.0], self.orbits[1.0]
        if self.maps is not None:
            half, odd = divmod(orbit.period, 2)
            ways = ends[1].points[0] - ends[0].points[0], orbit.points[0] - orbit.points[half]
            chord, halves_distance = (self.system.length(way, 0.0) for way in ways)
            if half and not odd and halves_distance < chord:
                return False
            if min(abs(end.parameter - orbit.parameter) for end in ends) <= error:
                with suppress(ArithmeticError):
                    ends = self.solved(None, -1.0, ROUGH), self.solved(None, 2.0, ROUGH)
        return np.prod([end.parameter - orbit.parameter for end in ends]) > 0.0

    def elsewhere(self, mesh, share):
        """The parameter of the event with the steps of a mesh at the orbit that was found: one orbit there, and slopes
        from the chord, because those of a map in steps are rough from one orbit to the next."""
        orbit, far = self.orbits[share], max(self.values, key=lambda other: abs(other - share))
        shifted = self.look(self.system.near(orbit.points, orbit.parameter, mesh), share)
        slope = (self.orbits[far].parameter - orbit.parameter) / (self.values[far] - self.values[share])
        return float(shifted.parameter + (self.values[share] - self.test(shifted)) * slope)


def _unstable(orbit):
    return int((np.abs(orbit.multipliers) > 1.0).sum())


def angle_of(kind: str, multipliers: np.ndarray) -> float | None:
    """Of the multiplier that crosses the unit circle there; None where none does, as two reals with mu_i mu_j = 1."""
    if kind != "torus":
        return {"fold": 0.0, "flip": np.pi}[kind]
    pairs = multipliers[multipliers.imag > 0.0]
    off = np.abs(np.abs(pairs) - 1.0)
    return float(np.angle(pairs[np.argmin(off)])) if len(off) and off.min() < CLOSE else None


def doubled_orbit(system: OrbitMap, flip: Event, *, amplitude: float = 0.01, count: int = 6) -> Orbit:
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
        solved = solved_near(system, guess, orbit.parameter, Newton(), system.row(v, 0.0), directions)
        first, half = solved.points[[0, orbit.period]]
        if system.length(first - half, 0.0) < amplitude:
            raise NoImage("Newton's method came back to the orbit of half the period")
        return described(solved, count)[0]
    except ArithmeticError as why:
        return not_found(twice, orbit.parameter, why)
