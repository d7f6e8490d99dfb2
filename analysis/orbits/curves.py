"""Folds, flips and torus points of orbits followed over two parameters.

Orbits over two parameters p = (p_1, p_2) are a smooth surface in (z_0, p), round folds too. On it a curve is followed
on which the test function g of the event (`events.FACTORS`) is zero. Lengths are those of `OrbitMap.row`.

    predict    a step h along the last chord t of the curve
    correct    orbits at the prediction + sigma s, with corrections orthogonal to t and to s, where s is the direction
               of the surface orthogonal to t; secants in sigma lead to g = 0
    accept     where |sigma| is below h/2 and the chord turns by less than 26 degrees; else h is halved

A cusp needs no care, because the curve is smooth in (z_0, p): there only its shadow on the plane of p turns back. A
system that is computed in steps takes one set of them for all orbits of one point; what its other sets change of sigma
is the error of the point. The first direction comes from differences of g in two directions of the surface.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from analysis.orbits.branches import FEW, GROW, NEAR, ON_CHORD, STRAIGHT
from analysis.orbits.events import FACTORS, NEAR_ORBITS, angle_of
from analysis.orbits.finding import MOVED, Orbit, corrected, described, real_span
from analysis.orbits.maps import NoImage, OrbitMap, shoot, slopes_of
from analysis.orbits.spaces import Space

SECANTS = 10
PROBE = 0.1  # of a step: differences of g for the first direction
ON_CURVE = 1e-11  # sigma, in steps, of a smooth system
ROUGH = 1e-3  # the same of a system that is computed in steps, and to how much of a chord its special points are sought
CUSP = 0.05  # speed of the shadow at an extremum, beside that of its neighbours, below which it is a cusp
RESONANCES = {"1:3": 2.0 * np.pi / 3.0, "1:4": 0.5 * np.pi}  # angles of torus points


@dataclass(frozen=True, eq=False)
class CurvePoint:
    """A fold, flip or torus point at two parameters.

    parameters (2,)
    errors (2,)       of each where the other is held: inf where it cannot be held, or where other steps lose the point
    orbit             there; its parameter is the array (2,)
    angle_rad         of the multiplier that crosses the unit circle
    kind              "", or of a special point: "cusp", "extremum" of the second parameter, "1:1", "fold-flip", "1:2",
                      "1:3", "1:4"
    place (n + 2,)    z_0 and the parameters in their sizes
    """

    parameters: np.ndarray
    errors: np.ndarray
    orbit: Orbit
    angle_rad: float
    place: np.ndarray
    kind: str = ""


@dataclass(frozen=True, eq=False)
class Curve:
    """A curve of one kind of event.

    points    tuple of CurvePoint, in order
    closed    whether its last point is the first again
    ends      why it ends where it begins, and where it ends
    special   tuple of CurvePoint, in order: points with a `kind`
    """

    kind: str
    points: tuple[CurvePoint, ...]
    closed: bool
    ends: tuple[str, str]
    special: tuple[CurvePoint, ...]

    @property
    def parameters(self) -> np.ndarray:
        """(m, 2) of the points."""
        return np.array([point.parameters for point in self.points])


def follow_curve(
    system: OrbitMap,
    kind: str,
    points: np.ndarray,
    parameters: np.ndarray,
    low: np.ndarray,
    high: np.ndarray,
    *,
    step: float = 0.05,
    least: float = 1e-3,
    longest: float = 0.2,
    most: int = 100,
    count: int = 6,
) -> Curve:
    """The curve of an event, both ways.

    system                 its `step` takes an array (2,) of parameters; `parameter_size` (2,)
    kind                   "fold", "flip" or "torus"
    points, parameters     of the orbit at or near the event: (N, n) and (2,)
    low, high              (2,) of the parameters: the curve ends with points on this border
    step, least, longest   from one point to the next, as in `follow_branch`
    most                   points each way
    count                  multipliers that are looked at
    Returns a Curve. Where it cannot be followed farther, its ends say why.
    Raises NoImage where there is no such event near the start.
    """
    follower = _Follower(system, kind, np.asarray(low, float), np.asarray(high, float), least, longest, most, count)
    first, tangent, across = follower.first(np.asarray(points, float), np.asarray(parameters, float), step)
    ahead, end, closed = follower.one_way(first, tangent, across, step)
    along, begin = [first, *ahead], end
    if not closed:
        behind, begin, _ = follower.one_way(first, -tangent, across, step)
        along = [*behind[::-1], *along]
    return Curve(kind, tuple(along), closed, (begin, end), tuple(follower.special(along)))


@dataclass(eq=False)
class _Follower:
    """What stays the same along a curve, and the slope of the test function by sigma that was last met."""

    system: OrbitMap
    kind: str
    low: np.ndarray
    high: np.ndarray
    least: float
    longest: float
    most: int
    count: int
    slope: float = 0.0

    @property
    def tolerance(self):
        return ON_CURVE if self.system.frozen is None else ROUGH

    def test(self, orbit):
        """g: with the multipliers that are known."""
        return float(np.prod(FACTORS[self.kind](orbit.multipliers)).real)

    def row(self, direction):
        """Row (n + 2,) of the inner product with a direction (n + 2,)."""
        return self.system.row(direction[:-2], direction[-2:])

    def length(self, direction):
        return self.system.length(direction[:-2], direction[-2:])

    def orbit_at(self, maps, guess, rows, directions, slopes=None):
        """The orbit at a guess (points (N, n), parameters (2,)), corrected orthogonally to two rows."""
        solved = corrected(maps, *guess, NEAR_ORBITS, rows, directions, slopes)
        orbit, _ = described(solved, self.count)
        if not orbit.settled:
            raise NoImage("the multipliers of the orbit are not known well")
        return orbit

    def plane(self, maps, orbit, rows):
        """Two directions, (2, N, n) and (2, 2), in which the surface leaves an orbit, orthonormal; rows (2, n + 2) that
        tell them apart. The first is orthogonal to the second row."""
        shots = shoot(maps, orbit.points, orbit.parameter)
        slopes = slopes_of(maps, shots, orbit.points, orbit.parameter)
        space = Space(shots.linearised, real_span(orbit.vectors), maps[0].abreast)
        changes, rates = [], []
        for right in np.eye(2):
            change, rate = space.solve(np.zeros_like(orbit.points), slopes, rows, right)
            for known_change, known_rate in zip(changes, rates, strict=True):
                share = self.system.row(change[0], rate) @ np.append(known_change[0], known_rate)
                change, rate = change - share * known_change, rate - share * known_rate
            length = self.system.length(change[0], rate)
            changes.append(change / length)
            rates.append(rate / length)
        return np.array(changes), np.array(rates)

    def first(self, points, parameters, step):
        """The point nearest to a start, the direction (n + 2,) of the curve there, and that across it."""
        maps = self.system.near(points, parameters)
        fixed = np.hstack([np.zeros((2, points.shape[1])), np.eye(2)])
        shots = shoot(maps, points, parameters)
        multipliers, _, vectors = Space(shots.linearised, np.empty((points.shape[1], 0)), maps[0].abreast).multipliers(
            self.count
        )
        rows = fixed
        if self.kind == "fold":  # there the surface is upright over the first parameter
            vector = vectors[:, np.argmin(np.abs(multipliers - 1.0))].real
            rows = np.array([self.system.row(vector, np.zeros(2)), fixed[1]])
        orbit = self.orbit_at(maps, (points, parameters), rows, real_span(vectors))
        for _ in range(2):
            changes, rates = self.plane(maps, orbit, rows)
            rows = np.array([self.system.row(c[0], r) for c, r in zip(changes, rates, strict=True)])
        value, slopes = self.test(orbit), []
        for change, rate in zip(changes, rates, strict=True):
            by = PROBE * step
            guess = orbit.points + by * change, orbit.parameter + by * rate * self.system.parameter_size
            beside = self.orbit_at(maps, guess, rows, real_span(orbit.vectors))
            slopes.append((self.test(beside) - value) / by)
        self.slope = float(np.hypot(*slopes))
        if not self.slope > 0.0:
            raise NoImage("the test function does not change near the event")
        along = np.array([-slopes[1], slopes[0]]) / self.slope
        across = np.array(slopes) / self.slope
        directions = np.hstack([changes[:, 0], rates])
        tangent, across = along @ directions, across @ directions
        point, _ = self.on_curve((orbit.points, orbit.parameter), tangent, across, orbit, step)
        if tangent[-1] < 0.0:
            tangent = -tangent
        return point, tangent, across

    def on_curve(self, guess, along, across, last, step):
        """The point of the curve orthogonal to a direction `along`, near a guess, and how many orbits it took.

        across (n + 2,): roughly the other direction of the surface. last: the orbit before.
        """
        directions, way = real_span(last.vectors), None
        for refined in (False, True):
            maps = self.system.near(*guess)
            rows = np.array([self.row(along), self.row(across)])
            orbit = self.orbit_at(maps, guess, rows, directions)
            changes, rates = self.plane(maps, orbit, rows[::-1])
            way = changes[0], rates[0]  # across, orthogonal to `along`
            rows = np.array([self.row(along), self.system.row(changes[0, 0], rates[0])])
            orbit, _, taken = self.secants(maps, orbit, way, rows, step)
            moved = np.linalg.norm(orbit.points - guess[0], axis=1).max()
            if self.system.frozen is None or refined or moved < MOVED:
                break
            guess = orbit.points, orbit.parameter
        return self.described(orbit, way, rows, step), taken

    def secants(self, maps, orbit, way, rows, step):
        """The orbit beside one, along the surface, with g = 0; sigma; orbits that were computed."""
        change, rate = way
        begin, directions = orbit, real_span(orbit.vectors)
        sigma, value = 0.0, self.test(orbit)
        slope = self.slope
        for taken in range(1, SECANTS + 1):
            by = float(np.clip(-value / slope, -0.5 * step, 0.5 * step)) if slope else PROBE * step
            if abs(by) < self.tolerance * step and taken > 1:
                break
            sigma += by
            if abs(sigma) > NEAR * step:
                raise NoImage("the curve turns too sharply")
            guess = begin.points + sigma * change, begin.parameter + sigma * rate * self.system.parameter_size
            orbit = self.orbit_at(maps, guess, rows, directions)
            following = self.test(orbit)
            if by and following != value:
                slope = (following - value) / by
            value = following
            if abs(by) < self.tolerance * step:
                break
        else:
            raise NoImage(f"{SECANTS} secants do not end on the curve")
        self.slope = slope
        return orbit, sigma, taken

    def described(self, orbit, way, rows, step):
        """The CurvePoint in the middle of those of all meshes, with errors from the others."""
        angle = angle_of(self.kind, orbit.multipliers)
        if angle is None:
            raise NoImage("no pair of multipliers is on the unit circle: it has become two reals of product 1")
        rate = way[1]
        orbits, sigmas, off = [orbit], [0.0], 0.0
        slope = self.slope
        try:
            for mesh in range(1, self.system.meshes):
                maps = self.system.near(orbit.points, orbit.parameter, mesh)
                guess = orbit.points, orbit.parameter
                beside = self.orbit_at(maps, guess, rows, real_span(orbit.vectors))
                rival, sigma, _ = self.secants(maps, beside, way, rows, step)
                orbits.append(rival)
                sigmas.append(sigma)
        except ArithmeticError:
            off = np.inf
        self.slope = slope
        middle = int(np.argsort(sigmas)[len(sigmas) // 2])
        off += max(abs(sigma - sigmas[middle]) for sigma in sigmas)
        orbit = orbits[middle]
        off += max(orbit.gap, self.tolerance * step if self.system.frozen is None else 0.0)
        errors = self._errors(off, rate, rows[0][-2:])
        place = np.append(orbit.points[0], orbit.parameter / self.system.parameter_size)
        return CurvePoint(orbit.parameter, errors, orbit, angle, place)

    def _errors(self, off, rate, along):
        """Errors (2,) of each parameter at a fixed other, for a displacement `off` of the curve along the surface.

        rate, along (2,): what the displacement and the curve change of the parameters.
        """
        size = self.system.parameter_size * np.ones(2)
        area = abs(rate[0] * along[1] - rate[1] * along[0])
        errors = np.full(2, np.inf)
        for k in range(2):
            if abs(along[1 - k]) > 0.0 and np.isfinite(off):
                errors[k] = size[k] * off * area / abs(along[1 - k])
        return errors

    def one_way(self, first, tangent, across, step):
        """Points after the first, why they end, and whether they come back to it."""
        points = [first]
        while len(points) <= self.most:
            last = points[-1]
            try:
                limit = self._beyond(last.parameters + step * tangent[-2:] * self.system.parameter_size)
                if limit is None:
                    point, taken = self._next(last, tangent, across, step)
                    limit = self._beyond(point.parameters)
                if limit is not None:
                    point = self._at_border(last, tangent, across, limit)
                    points.append(point)
                    k, end = limit
                    return points[1:], f"reaches the end of the range of key {k + 1}, {end:g}", False
            except ArithmeticError as why:
                step *= 0.5
                if step < self.least:
                    place = " and ".join(f"{value:.6g}" for value in last.parameters)
                    return points[1:], f"at {place} no step above {self.least:g} succeeds: {why}", False
                continue
            chord = point.place - last.place
            if len(points) > 3 and self._passes(first, last, chord):
                return [*points[1:], first], "comes back to its beginning", True
            points.append(point)
            tangent = chord / self.length(chord)
            if taken <= FEW:
                step = min(step * GROW, self.longest)
        return points[1:], f"followed over {self.most} points", False

    def _next(self, last, tangent, across, step):
        guess = self._shifted(last.orbit, tangent, step)
        point, taken = self.on_curve(guess, tangent, across, last.orbit, step)
        chord = point.place - last.place
        if self.row(tangent) @ chord < STRAIGHT * self.length(chord):
            raise NoImage("the curve turns too sharply")
        return point, taken

    def _shifted(self, orbit, tangent, step):
        """Points and parameters a step along a direction (n + 2,); the points after the first stay, as Newton's method
        carries them along."""
        points = orbit.points.copy()
        points[0] += step * tangent[:-2]
        return points, orbit.parameter + step * tangent[-2:] * self.system.parameter_size

    def _beyond(self, parameters):
        """(k, end) of the parameter that is out of its range; None within it."""
        for k in range(2):
            for end, out in ((self.low[k], self.low[k] - parameters[k]), (self.high[k], parameters[k] - self.high[k])):
                if out > 1e-9 * (self.high[k] - self.low[k]):
                    return k, float(end)
        return None

    def _at_border(self, last, tangent, across, limit):
        """The point at which the curve reaches the end of the range of parameter k."""
        k, end = limit
        size = (self.system.parameter_size * np.ones(2))[k]
        step = (end - last.parameters[k]) / size / tangent[-2 + k]
        if abs(step) < 1e-9 * self.longest:
            raise NoImage("the curve begins at the end of the range")
        guess = self._shifted(last.orbit, tangent, step)
        guess[1][k] = end
        along = np.zeros(len(tangent))
        along[-2 + k] = 1.0
        return self.on_curve(guess, along, across, last.orbit, max(abs(step), self.least))[0]

    def _passes(self, first, last, chord):
        """Whether the first point lies on a chord that begins at the last one."""
        way, across = first.place - last.place, self.row(chord)
        share = across @ way / self.length(chord) ** 2
        return 0.0 < share <= 1.0 and self.length(way - share * chord) < ON_CHORD * self.length(chord)

    def special(self, points) -> Iterator[CurvePoint]:
        """Special points between neighbours."""
        for place, (begin, end) in enumerate(pairwise(points)):
            chord = end.place - begin.place
            for name, function in self._tests():
                values = function(begin.orbit), function(end.orbit)
                if np.isfinite(values).all() and values[0] * values[1] < 0.0:
                    yield from self._zero(name, function, begin, end)
            if place + 2 < len(points):
                following = points[place + 2].parameters[1] - end.parameters[1]
                if chord[-1] * following < 0.0:
                    yield from self._extremum(begin, end, points[place + 2])

    def _tests(self) -> Iterator[tuple[str, Callable]]:
        """Functions of an orbit that change sign at special points."""
        if self.kind == "torus":
            for name, angle in RESONANCES.items():
                yield name, lambda orbit, angle=angle: (angle_of("torus", orbit.multipliers) or np.nan) - angle
            return
        root = 1.0 if self.kind == "fold" else -1.0

        def of_others(orbit):
            rest = np.delete(orbit.multipliers, np.argmin(np.abs(orbit.multipliers - root)))
            return float(np.prod(1.0 - root * rest).real)

        yield {"fold": "1:1", "flip": "1:2"}[self.kind], of_others
        if self.kind == "fold":
            yield "fold-flip", lambda orbit: float(np.prod(1.0 + orbit.multipliers).real)

    def _between(self, begin, end, share):
        """The point of the curve at a share of the chord between two."""
        chord = end.place - begin.place
        length = self.length(chord)
        guess_points = begin.orbit.points + share * (end.orbit.points - begin.orbit.points)
        guess = guess_points, begin.parameters + share * (end.parameters - begin.parameters)
        across = np.random.default_rng(1).normal(size=len(chord))
        if self.system.seen is not None:
            across[:-2] = self.system.seen @ (np.linalg.pinv(self.system.seen) @ across[:-2])
        across -= (self.row(chord) @ across) / length**2 * chord
        return self.on_curve(guess, chord / length, across / self.length(across), begin.orbit, length)[0]

    def _zero(self, name, function, begin, end):
        """The special point between two points; none where the search fails."""
        accuracy = 1e-12 if self.system.frozen is None else ROUGH
        try:
            share = brentq(lambda s: function(self._between(begin, end, s).orbit), 0.0, 1.0, xtol=accuracy, disp=False)
            yield self._named(name, self._between(begin, end, share))
        except (ArithmeticError, ValueError):
            return

    def _extremum(self, before, middle, after):
        """The cusp or the extremum of the second parameter between three points; none where the search fails."""
        sign = np.sign(middle.parameters[1] - before.parameters[1])
        settings = {"xatol": 1e-9, "maxiter": 60} if self.system.frozen is None else {"xatol": 0.02, "maxiter": 8}
        found = {}

        def depth(share):
            found[share] = self._between(before, after, share)
            return -sign * found[share].parameters[1]

        try:
            share = minimize_scalar(depth, bounds=(0.0, 1.0), method="bounded", options=settings).x
            point = found[share]
            sides = [self._between(before, after, share + by).parameters for by in (-0.05, 0.05)]
        except (ArithmeticError, KeyError):
            return
        size = self.system.parameter_size * np.ones(2)
        speed = np.linalg.norm((sides[1] - sides[0]) / size) / 0.1
        chord = after.place - before.place
        cusp = self.kind == "fold" and speed < CUSP * self.length(chord)
        yield self._named("cusp" if cusp else "extremum", point)

    @staticmethod
    def _named(name, point):
        return CurvePoint(point.parameters, point.errors, point.orbit, point.angle_rad, point.place, name)
