"""Folds, flips and torus points of orbits followed over two parameters.

Orbits over two parameters p = (p_1, p_2) are a smooth surface in (z_0, p), round folds too. On it a curve is followed
on which the test function g of the event (`events.FACTORS`) is zero. Lengths are those of `OrbitMap.row`.

    predict    a step h along the last chord t of the curve
    correct    orbits at the prediction + sigma s, with corrections orthogonal to t and to s, where s is the direction
               of the surface orthogonal to t; secants in sigma lead to g = 0
    accept     where |sigma| is below h/2 and the chord turns by less than 26 degrees; else h is halved

A cusp needs no care, because the curve is smooth in (z_0, p): there only its shadow on the plane of p turns back. A
system that is computed in steps takes one set of them for all orbits of one point. What its other sets change of the
parameters, and what a more accurate system changes, is together the error of the point. The first direction comes from
differences of g in two directions of the surface.

Special points are zeros of functions of the multipliers, smooth along the curve, and extremes of the second parameter.
Where the search between two points of the curve fails, that is told as a point which was not found.
"""

from collections import namedtuple
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from analysis.orbits.branches import FEW, GROW, NEAR, ON_CHORD, STRAIGHT
from analysis.orbits.events import FACTORS, NEAR_ORBITS, angle_of, test_of
from analysis.orbits.finding import Orbit, corrected, described, real_span
from analysis.orbits.maps import NoImage, NotSolved, OrbitMap, shoot, slopes_of
from analysis.orbits.spaces import Space

SECANTS = 10
# of a step: differences of g for the first direction; in a system in steps only where a whole step is too far, and
# secants up to this length leave the slope of g as it is
PROBE = 0.1
ON_CURVE = 1e-11  # sigma, in steps, of a smooth system
# of a system that is computed in steps: sigma, in longest steps, and to how much of a chord special points are sought
CLOSE, ROUGH = 1e-2, 1e-3
# gaps: of a smooth system; of one in steps before they are chosen again; then, as its steps change a point by more
SMOOTHLY, ROUGHLY, IN_STEPS = (NEAR_ORBITS._replace(tolerance=gap) for gap in (1e-11, 1e-4, 1e-6))
BESIDE = 0.1  # of a chord, from an extremum to the points that say whether the shadow turns back there: a cusp
RESONANCES = {"1:3": 2.0 * np.pi / 3.0, "1:4": 0.5 * np.pi}  # angles of torus points
LEAP = 0.1  # of a test of special points at its zero, beside the smaller one of its neighbours: it is not continuous
COMPLEX = "multipliers", "vectors"  # of an orbit
Kept = Callable[[tuple, Callable[[], dict]], dict]


@dataclass(frozen=True, eq=False)
class CurvePoint:
    """A fold, flip or torus point at two parameters.

    parameters (2,)
    errors (2,)       of each where the other is held; inf: not known, for the `reason`
    orbit             there; its parameter is the array (2,)
    angle_rad         of the multiplier that crosses the unit circle
    across (N, n + 2) direction of the surface across the curve: changes of each point, and of the parameters
    slope             of the test function g along it
    kind              "", or of a special point: "cusp", "extremum" of the second parameter, "1:1", "fold-flip", "1:2",
                      "1:3", "1:4"
    found             whether it is: a special point whose search failed is the middle of the interval between its
                      neighbours, its errors are half of that, and its orbit is that of the first neighbour
    reason            why an error is not known, or why the search failed
    """

    parameters: np.ndarray
    errors: np.ndarray
    orbit: Orbit
    angle_rad: float
    across: np.ndarray
    slope: float
    kind: str = ""
    found: bool = True
    reason: str = ""


@dataclass(frozen=True, eq=False)
class Curve:
    """A curve of one kind of event.

    points    tuple of CurvePoint, in order
    closed    whether its last point is the first again
    ends      why it ends where it begins, and where it ends: "ends at" where the event does, as where a release of
              loops begins, "numerical failure" where only the computation does
    special   tuple of CurvePoint, in order: points with a `kind`, those that were not found included
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
    kept: Kept = lambda _, compute: compute(),
    sharper: OrbitMap | None = None,
) -> Curve:
    """The curve of an event, both ways.

    system                 its `step` takes an array (2,) of parameters; `parameter_size` (2,)
    kind                   "fold", "flip" or "torus"
    points, parameters     of the orbit at or near the event: (N, n) and (2,)
    low, high              (2,) of the parameters: the curve ends with points on this border
    step, least, longest   from one point to the next, as in `follow_branch`
    most                   points each way
    count                  multipliers that are looked at
    kept                   (arguments, compute) -> compute(), or what it gave for equal arguments before: numbers, words
                           and arrays of a point. With a store of them a curve that was stopped goes on
    sharper                computed more accurately, in the same coordinates: what it changes is in the errors
    Returns a Curve. Where it cannot be followed farther, its ends say why.
    Raises NoImage where there is no such event near the start.
    """
    follower = _Follower(
        system, kind, np.asarray(low, float), np.asarray(high, float), least, longest, most, count, kept, sharper
    )
    first, tangent = follower.first(points, parameters, step)
    along, end, closed = follower.one_way(first, tangent, step)
    begin = end
    if not closed:
        behind, begin, _ = follower.one_way(first, -tangent, step)
        along = [*behind[:0:-1], *along]
    return Curve(kind, tuple(along), closed, (begin, end), tuple(follower.special(along, closed)))


# Orbits on a line across the curve: direction (N, n + 2), rows (2, n + 2) to which they are corrected orthogonally,
# slopes (N, n, 2) of the maps, step of the curve
_Beside = namedtuple("_Beside", "across rows slopes step")


@dataclass(frozen=True, eq=False)
class _Follower:
    """What stays the same along a curve."""

    system: OrbitMap
    kind: str
    low: np.ndarray
    high: np.ndarray
    least: float
    longest: float
    most: int
    count: int
    kept: Kept
    sharper: OrbitMap | None

    @property
    def size(self):
        """(2,) of the parameters."""
        return self.system.parameter_size * np.ones(2)

    def test(self, orbit):
        """g: with the multipliers that are known."""
        return test_of(FACTORS[self.kind], orbit)

    def place(self, orbit):
        """(N, n + 2) of an orbit: its points, each with the parameters in their sizes."""
        return self.direction(orbit.points, orbit.parameter / self.size)

    def direction(self, change, rate):
        """(N, n + 2) of changes (N, n) of the points and one (2,) of the parameters."""
        return np.hstack([change, np.tile(rate, (len(change), 1))])

    def row(self, direction):
        """Row (n + 2,) of the inner product with a direction (N, n + 2), in what is seen of the first point."""
        return self.system.row(direction[0, :-2], direction[0, -2:])

    def length(self, direction):
        return self.system.length(direction[0, :-2], direction[0, -2:])

    def shifted(self, orbit, direction, by):
        """Points and parameters beside an orbit."""
        return orbit.points + by * direction[:, :-2], orbit.parameter + by * direction[0, -2:] * self.size

    def orbit_at(self, maps, guess, rows, slopes, vectors, space=None, newton=None):
        """The orbit at a guess (points (N, n), parameters (2,)), corrected orthogonally to two rows, and its Space.

        slopes (N, n, 2), vectors (n, k), space: of an orbit nearby, with which Newton's method begins.
        """
        if newton is None:
            newton = SMOOTHLY if self.system.frozen is None else IN_STEPS
        solved = corrected(maps, *guess, newton, rows, real_span(vectors), slopes, space)
        orbit, space = described(solved, self.count)
        if not orbit.settled:
            raise NotSolved("the multipliers of the orbit are not known well")
        return orbit, space

    def leaving(self, space, slopes, rows, parts):
        """The direction in which the surface leaves an orbit with given parts (2,) along two rows, made of length 1."""
        direction = self.direction(*space.solve(np.zeros(slopes.shape[:2]), slopes, rows, parts))
        return direction / self.length(direction)

    def plane(self, space, slopes, rows):
        """Two directions (2, N, n + 2), orthonormal, in which the surface leaves an orbit. rows: tell them apart."""
        first = self.leaving(space, slopes, rows, (1.0, 0.0))
        second = self.leaving(space, slopes, rows, (0.0, 1.0))
        second = second - (self.row(first) @ second[0]) * first
        return np.array([first, second / self.length(second)])

    def first(self, points, parameters, step):
        """The point nearest to a start and within the ranges, and the direction (N, n + 2) of the curve there."""
        maps = self.system.near(points, parameters)
        shots = shoot(maps, points, parameters)
        slopes = slopes_of(maps, shots, points, parameters)
        space = Space(shots.linearised, np.empty((points.shape[1], 0)), maps[0].abreast)
        multipliers, _, vectors = space.multipliers(self.count)
        rows = np.hstack([np.zeros((2, points.shape[1])), np.eye(2)])
        if self.kind == "fold":  # there the surface is upright over the first parameter
            vector = vectors[:, np.argmin(np.abs(multipliers - 1.0))].real
            rows[0] = self.system.row(vector, np.zeros(2))
        orbit, space = self.orbit_at(maps, (points, parameters), rows, slopes, vectors)
        for _ in range(2):
            plane = self.plane(space, slopes, rows)
            rows = np.array([self.row(direction) for direction in plane])
        slopes_of_test = self.slopes_of_test(orbit, space, plane, rows, slopes, step)
        steepest = np.hypot(*slopes_of_test)
        if not steepest > 0.0:
            raise NoImage("the test function does not change near the event")
        on_first, on_second = slopes_of_test / steepest
        along, across = on_first * plane[1] - on_second * plane[0], on_first * plane[0] + on_second * plane[1]
        start = CurvePoint(orbit.parameter, np.zeros(2), orbit, 0.0, across, steepest)
        point, _ = self.on_curve((orbit.points, orbit.parameter), along, start, step, along)
        limit = self._beyond(point.parameters)
        if limit is not None:
            point = self._at_border(point, along, limit)
        return point, along if along[0, -1] >= 0.0 else -along

    def slopes_of_test(self, orbit, space, plane, rows, slopes, step):
        """Slopes of g in the directions of a plane.

        In a system in steps each orbit takes its own. On the steps of one orbit, g nearby follows these steps more than
        the orbits. So g is compared between orbits that are a whole step apart, or less where that is too far.
        """
        probe = PROBE * step if self.system.frozen is None else step
        while True:
            differences = []
            try:
                for direction in plane:
                    guess = self.shifted(orbit, direction, probe)
                    maps = self.system.near(*guess)
                    neighbour, _ = self.orbit_at(maps, guess, rows, slopes, orbit.vectors, space)
                    differences.append(self.test(neighbour) - self.test(orbit))
                return np.array(differences) / probe
            except ArithmeticError:
                probe *= 0.5
                if probe < PROBE * step:
                    raise

    def on_curve(self, guess, along, last, step, tangent):
        """The point of the curve orthogonal to a direction `along`, near a guess, and how many orbits it took.

        last: the point before. tangent: of the curve, with which errors are measured; None: they are not.
        """
        arguments = (*guess, along, last.across, last.slope, last.orbit.vectors, step, tangent)
        record = self.kept(arguments, lambda: self._record(*arguments))
        if record["failure"]:
            raise (NotSolved if record["numerical"] else NoImage)(record["failure"])
        return _point_of(record["point"]), record["taken"]

    def _record(self, *arguments):
        """The point as `kept` has it, or why there is none."""
        try:
            point, taken = self._solved(*arguments)
        except ArithmeticError as why:
            return {"failure": str(why), "numerical": isinstance(why, NotSolved)}
        orbit = dict(vars(point.orbit))
        for name in COMPLEX:
            orbit[name] = np.stack([orbit[name].real, orbit[name].imag], axis=-1)
        return {"failure": "", "taken": taken, "point": vars(point) | {"orbit": orbit}}

    def _solved(self, points, parameters, along, across, slope, vectors, step, tangent):
        guess, space = (points, parameters), None
        rows = np.array([self.row(along), self.row(across)])
        maps = self.system.near(*guess)
        slopes = slopes_of(maps, shoot(maps, *guess), *guess)
        if self.system.frozen is not None:  # roughly with the steps of the guess, then with those of the orbit
            rough, space = self.orbit_at(maps, guess, rows, slopes, vectors, newton=ROUGHLY)
            across = self.leaving(space, slopes, rows, (0.0, 1.0))
            guess, vectors = self.shifted(rough, across, self.secant(rough, slope, step)), rough.vectors
            maps, rows[1] = self.system.near(*guess), self.row(across)
        orbit, space = self.orbit_at(maps, guess, rows, slopes, vectors, space)
        across = self.leaving(space, slopes, rows, (0.0, 1.0))
        rows[1] = self.row(across)
        beside = _Beside(across, rows, slopes, step)
        orbit, space, slope, by, taken = self.secants(maps, orbit, space, beside, slope, 1)
        angle = angle_of(self.kind, orbit.multipliers)
        if angle is None:
            raise NoImage("no pair of multipliers is on the unit circle: it has become two reals of product 1")
        point = CurvePoint(orbit.parameter, np.full(2, np.inf), orbit, angle, across, slope)
        if tangent is not None:
            errors, reason = self.errors(orbit, space, beside, slope, by, tangent[0, -2:])
            point = replace(point, errors=errors, reason=reason)
        return point, taken

    def secant(self, orbit, slope, step):
        """How far g = 0 is from an orbit across the curve, half a step at most."""
        return float(np.clip(-self.test(orbit) / slope, -0.5 * step, 0.5 * step))

    def secants(self, maps, orbit, space, beside, slope, least):
        """The orbit beside one, along the surface, near g = 0; its Space; the slope of g; how far g = 0 is; orbits that
        were computed, `least` or more.

        A secant that leaves an interval in which g changes its sign gives way to the middle of that. In a system in
        steps a short secant does not change the slope, because the steps scatter g.
        """
        across, rows, slopes, step = beside
        enough, blurred = ON_CURVE * step, 0.0
        if self.system.frozen is not None:  # steps of a system scatter g alike after short and long steps of a curve
            enough, blurred = CLOSE * self.longest, max(self.least, PROBE * step)
        begin, sigma, value = orbit, 0.0, self.test(orbit)
        sides = {}  # sign of g -> sigma
        for taken in range(SECANTS + 1):
            by = self.secant(orbit, slope, step)
            if abs(by) < enough and taken >= least:
                return orbit, space, slope, by, taken
            sides[value > 0.0] = sigma
            if len(sides) == 2 and not min(sides.values()) < sigma + by < max(sides.values()):
                by = 0.5 * sum(sides.values()) - sigma
            sigma += by
            if abs(sigma) > NEAR * step:
                raise NotSolved("the curve turns too sharply")
            guess = self.shifted(begin, across, sigma)
            orbit, space = self.orbit_at(maps, guess, rows, slopes, begin.vectors, space)
            last_value, value = value, self.test(orbit)
            if abs(by) > blurred and value != last_value:
                slope = (value - last_value) / by
        raise NotSolved(f"{SECANTS} secants do not end on the curve")

    def errors(self, orbit, space, beside, slope, by, along):
        """Errors (2,) of the parameters of an orbit, and why one is not known: from the orbits of the other meshes and
        of the sharper system, and from the distance `by` to g = 0. along (2,): direction of the curve."""
        rivals = [(self.system, mesh) for mesh in range(1, self.system.meshes)]
        if self.sharper is not None:
            rivals.append((self.sharper, 0))
        # Other orbits move the curve across its direction a: by d x a / a_2 along key 1 where key 2 is held. At a fold
        # they move it off the surface, too, so that sigma does not tell how far.
        normal, guess = np.array([along[1], -along[0]]) / self.size, (orbit.points, orbit.parameter)
        ends, errors, reason = [self.shifted(orbit, beside.across, by)[1]], np.full(2, np.inf), ""
        try:
            for system, mesh in rivals:
                maps = system.near(*guess, mesh)
                rival = self.orbit_at(maps, guess, beside.rows, beside.slopes, orbit.vectors, space)
                rival, _, _, by, _ = self.secants(maps, *rival, beside, slope, 0)
                ends.append(self.shifted(rival, beside.across, by)[1])
        except ArithmeticError as why:
            return errors, f"errors are not known, because other steps lose the point: {why}"
        shifts = np.abs([normal @ (end - orbit.parameter) for end in ends])
        alike, sharp = np.split(shifts, [self.system.meshes])
        moved = alike.max() + sharp.max(initial=0.0) + orbit.gap
        for k in range(2):
            if moved <= abs(along[1 - k]):
                errors[k] = self.size[k] * moved / abs(along[1 - k])
            else:
                reason = f"error {k + 1} is not known, because the curve is parallel to key {k + 1} there"
        return errors, reason

    def one_way(self, first, tangent, step):
        """Points from the first one on, why they end, and whether they come back to it.

        Where no step leads on, the last point is dropped and the curve goes on from the one before, because steps of a
        system may have misled it. The curve ends where that leads no farther.
        """
        points = [first]
        farthest = 0  # points that there were when the last one was dropped
        while len(points) <= self.most:
            last = points[-1]
            try:
                limit = self._beyond(last.parameters + step * tangent[0, -2:] * self.size)
                if limit is None:
                    point, taken = self._next(last, tangent, step)
                    limit = self._beyond(point.parameters)
                if limit is not None:
                    point = self._at_border(last, tangent, limit)
                    other = self._beyond(point.parameters)
                    if other is not None:  # the curve leaves the range of that key first
                        limit, point = other, self._at_border(last, tangent, other)
                    if point is not last:
                        points.append(point)
                    k, end = limit
                    return points, f"reaches the end of the range of key {k + 1}, {end:g}", False
            except ArithmeticError as why:
                if step > self.least:
                    step = max(0.5 * step, self.least)
                    continue
                if isinstance(why, NotSolved) and len(points) > max(2, farthest):
                    farthest = len(points)
                    points.pop()
                    chord = self.place(last.orbit) - self.place(points[-1].orbit)
                    step = min(GROW * self.length(chord), self.longest)
                    before = self.place(points[-1].orbit) - self.place(points[-2].orbit)
                    tangent = before / self.length(before)
                    continue
                place = " and ".join(f"{value:.6g}" for value in last.parameters)
                words = "numerical failure beyond" if isinstance(why, NotSolved) else "ends at"
                return points, f"{words} {place}, with steps down to {self.least:g}: {why}", False
            chord = self.place(point.orbit) - self.place(last.orbit)
            if len(points) > 3 and self._passes(first, last, chord):
                return [*points, first], "comes back to its beginning", True
            points.append(point)
            tangent = chord / self.length(chord)
            if taken < FEW:
                step = min(step * GROW, self.longest)
        return points, f"followed over {self.most} points", False

    def _next(self, last, tangent, step):
        guess = self.shifted(last.orbit, tangent, step)
        point, taken = self.on_curve(guess, tangent, last, step, tangent)
        chord = self.place(point.orbit) - self.place(last.orbit)
        if self.row(tangent) @ chord[0] < STRAIGHT * self.length(chord):
            raise NotSolved("the curve turns too sharply")
        return point, taken

    def _beyond(self, parameters):
        """(k, end) of the parameter that is out of its range; None within it."""
        for k in range(2):
            for end, out in ((self.low[k], self.low[k] - parameters[k]), (self.high[k], parameters[k] - self.high[k])):
                if out > 1e-9 * (self.high[k] - self.low[k]):
                    return k, float(end)
        return None

    def _at_border(self, last, tangent, limit):
        """The point at which the curve reaches the end of the range of parameter k: the last one, if it is there."""
        k, end = limit
        step = (end - last.parameters[k]) / self.size[k] / tangent[0, -2 + k]
        if abs(step) < 1e-9 * self.longest:
            return last
        guess = self.shifted(last.orbit, tangent, step)
        guess[1][k] = end
        along = self.direction(np.zeros_like(last.orbit.points), np.eye(2)[k])
        point = self.on_curve(guess, along, last, max(abs(step), self.least), tangent)[0]
        parameters = point.parameters.copy()
        parameters[k] = end  # but for rounding it is there already
        return replace(point, parameters=parameters)

    def _passes(self, first, last, chord):
        """Whether the first point lies on a chord that begins at the last one."""
        way = self.place(first.orbit) - self.place(last.orbit)
        share = self.row(chord) @ way[0] / self.length(chord) ** 2
        return 0.0 < share <= 1.0 and self.length(way - share * chord) < ON_CHORD * self.length(chord)

    def special(self, points, closed) -> Iterator[CurvePoint]:
        """Special points between neighbours."""
        following = [*points[2:], points[1] if closed else None]
        for begin, end, after in zip(points, points[1:], following, strict=False):
            for name, function in self._tests():
                if function(begin.orbit) * function(end.orbit) < 0.0:
                    yield self._zero(name, function, begin, end)
            if after is None:
                continue
            rise, following_rise = end.parameters - begin.parameters, after.parameters - end.parameters
            if rise[1] * following_rise[1] < 0.0:
                yield self._extremum(begin, end, after)

    def _tests(self) -> Iterator[tuple[str, Callable]]:
        """Functions of an orbit that change sign at special points."""
        if self.kind == "torus":
            for name, angle in RESONANCES.items():
                yield name, lambda orbit, angle=angle: (angle_of("torus", orbit.multipliers) or np.nan) - angle
            return
        root, name = {"fold": (1.0, "1:1"), "flip": (-1.0, "1:2")}[self.kind]
        # slope of the characteristic polynomial: it stays smooth where two multipliers meet in its root
        yield name, lambda orbit: float(np.polyval(np.polyder(np.poly(orbit.multipliers)), root).real)
        if self.kind == "fold":
            yield "fold-flip", lambda orbit: float(np.prod(1.0 + orbit.multipliers).real)

    def _between(self, begin, end, share, measured=False):
        """The point of the curve at a share of the chord between two."""
        chord = self.place(end.orbit) - self.place(begin.orbit)
        length = self.length(chord)
        guess, along = self.shifted(begin.orbit, chord, share), chord / length
        return self.on_curve(guess, along, begin, length, along if measured else None)[0]

    def _zero(self, name, function, begin, end):
        """The special point between two points."""
        looked = {0.0: begin, 1.0: end}
        least = min(abs(function(point.orbit)) for point in looked.values())

        def value(share):
            if share not in looked:
                looked[share] = self._between(begin, end, share)
            return function(looked[share].orbit)

        try:
            share = brentq(value, 0.0, 1.0, xtol=1e-12 if self.system.frozen is None else ROUGH)
            if not abs(value(share)) <= LEAP * least:
                raise NotSolved("its test function leaps")
            return replace(self._between(begin, end, share, measured=True), kind=name)
        except ArithmeticError as why:
            return _lost(name, begin, end, why)

    def _extremum(self, before, middle, after):
        """The cusp or the extremum of the second parameter between three points."""
        sign = np.sign(middle.parameters[1] - before.parameters[1])
        settings = {"xatol": 1e-9, "maxiter": 60} if self.system.frozen is None else {"xatol": 0.02, "maxiter": 8}

        def depth(share):
            return -sign * self._between(before, after, share).parameters[1]

        try:
            share = minimize_scalar(depth, bounds=(0.0, 1.0), method="bounded", options=settings).x
            point = self._between(before, after, share, measured=True)
            sides = [self._between(before, after, share + by).parameters for by in (-BESIDE, BESIDE)]
        except ArithmeticError as why:
            return _lost("extremum", before, after, why)
        behind, ahead = ((side - point.parameters) / self.size for side in sides)
        cusp = self.kind == "fold" and behind @ ahead > 0.0  # there the shadow turns back
        return replace(point, kind="cusp" if cusp else "extremum")


def _lost(name, begin, end, why):
    """The special point between two whose search failed."""
    middle, half = 0.5 * (begin.parameters + end.parameters), 0.5 * abs(end.parameters - begin.parameters)
    ends = " and ".join("({:.6g}, {:.6g})".format(*point.parameters) for point in (begin, end))
    reason = f"the search between {ends} fails: {why}"
    return replace(begin, parameters=middle, errors=half, kind=name, found=False, reason=reason)


def _point_of(values):
    """The CurvePoint of a record, in which arrays may be lists, and complex numbers are pairs."""
    values, orbit = dict(values), dict(values["orbit"])
    for name in "parameters", "errors", "across":
        values[name] = np.array(values[name])
    for name in "points", "parameter", "residuals":
        orbit[name] = np.array(orbit[name])
    for name in COMPLEX:
        orbit[name] = orbit[name] @ np.array([1.0, 1.0j])
    return CurvePoint(**values | {"orbit": Orbit(**orbit)})
