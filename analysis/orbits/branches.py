"""A periodic orbit followed along a parameter, round folds: pseudo-arclength continuation (Keller 1977).

    predict    (z, lambda) + h t, t the tangent at the last orbit, of length 1 in (z_0, lambda/parameter_size)
    correct    Newton's method, each correction orthogonal to t: `spaces`, (b). A system that is computed in steps
               takes those of the predicted orbit first, and then those of the orbit
    accept     where t turns by less than 26 degrees and the correction is shorter than half of h; else h is halved

h grows by half after three Newton steps or fewer. Where parameter_size is small, a fold is a corner: if no h succeeds,
a larger one serves until h is the first one again. A branch has come back to its beginning, an island, where its first
orbit, begun at any of its points, lies on the last chord.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from analysis.orbits.events import ACCURACY, FACTORS, NEAR_ORBITS, Event, Place, events_between, test_of
from analysis.orbits.finding import Orbit, described, real_span, solved_near
from analysis.orbits.maps import NoImage, NotSolved, OrbitMap, shoot, slopes_of
from analysis.orbits.spaces import Space
from analysis.sampling import checked_positive

STRAIGHT = 0.9  # least cosine between tangents of neighbours
NEAR = 0.5  # longest correction, in steps
GROW, FEW = 1.5, 3
WIDER, WIDEST = 4.0, 16.0  # sizes of the parameter where no step succeeds, in its own size
ON_CHORD = 0.2  # distance from a chord, in its lengths
NOT_FOLLOWED = "it was not followed that way"


@dataclass(frozen=True, eq=False)
class Branch:
    """Orbits along a branch, in order.

    orbits    tuple of Orbit; of an island, the last is the first again
    closed    whether it is an island
    ends      why it ends where it begins, and where it ends: two sentences
    events    tuple of Event, in order
    """

    orbits: tuple[Orbit, ...]
    closed: bool
    ends: tuple[str, str]
    events: tuple[Event, ...]

    @property
    def parameters(self) -> np.ndarray:
        """(m,) of the orbits."""
        return np.array([orbit.parameter for orbit in self.orbits])


def follow_branch(
    system: OrbitMap,
    orbit: Orbit,
    low: float,
    high: float,
    *,
    step: float = 0.05,
    least: float = 1e-4,
    longest: float = 0.2,
    most: int = 200,
    count: int = 6,
    accuracy: float = ACCURACY,
    ahead: int = 0,
    enough: Callable[[Orbit, Sequence[Event]], bool] | None = None,
) -> Branch:
    """The branch of an orbit, stable or not, with its folds, flips and torus points.

    orbit                  where it begins, low <= its parameter <= high
    low, high              of the parameter; the branch ends with orbits at these values
    step, least, longest   arclength from one orbit to the next: first, smallest, largest. `least` must not fall below
                           what a new set of steps of the system changes of an orbit
    most                   orbits each way
    count                  as in `find_orbit`
    accuracy               of events, in lengths of a step
    ahead                  0: both ways; 1: only the way on which the parameter grows at first; -1: on which it falls
    enough                 called after each orbit, with this orbit and all events so far that way; True ends the branch
    Returns a Branch. Where it cannot be followed farther, its ends say why: it raises nothing for that.
    Raises ValueError for an orbit that was not found, and for one outside of the range.
    """
    if not orbit.found or not low <= orbit.parameter <= high:
        raise ValueError(f"orbit: one within {low:g} and {high:g} is needed, given {orbit.parameter:g}, {orbit.reason}")
    step = checked_positive(step, "step")
    follower = _Follower(system, low, high, least, longest, most, count, accuracy, enough)
    first = follower.place(orbit)
    places, events, closed = [first], [], False
    begin = end = NOT_FOLLOWED
    if ahead >= 0:
        further, events, end, closed = follower.one_way(first, step)
        places += further
    if closed:
        begin = end
    elif ahead <= 0:
        back, earlier_events, begin, _ = follower.one_way(_reversed(first), step)
        places, events = [*map(_reversed, back[::-1]), *places], earlier_events[::-1] + events
    return Branch(tuple(place.orbit for place in places), closed, (begin, end), tuple(events))


@dataclass(frozen=True, eq=False)
class _Follower:
    """What stays the same along a branch: the arguments of `follow_branch`."""

    system: OrbitMap
    low: float
    high: float
    least: float
    longest: float
    limit: int
    count: int
    accuracy: float
    enough: Callable[[Orbit, Sequence[Event]], bool] | None

    def place(self, orbit):
        """The orbit with its tangent in the direction of a growing parameter."""
        maps = self.system.near(orbit.points, orbit.parameter)
        shots = shoot(maps, orbit.points, orbit.parameter)
        slopes = slopes_of(maps, shots, orbit.points, orbit.parameter)
        space = Space(shots.linearised, real_span(orbit.vectors), self.system.abreast)
        across = np.append(np.zeros(orbit.points.shape[1]), 1.0)
        for _ in range(2):  # near a fold the first is not accurate
            change, rate = tangent_of(self.system, space, slopes, across)
            across = self.system.row(change[0], rate)
        return Place(orbit, change, rate, slopes)

    def one_way(self, first, step):
        """Places after the first; events between them; why they end; whether they come back to the first."""
        places, events, closed, reason = [first], [], False, f"followed over {self.limit} orbits"
        events_before = []  # how many events were known before each step
        first_step = step  # a longer one is halved where two zeros may lie in it
        follower, wide = self, 1.0
        while len(places) <= self.limit:
            last, closing = places[-1], None
            end, limited = follower._limit(last, step)
            if limited == 0.0:
                reason = f"reaches the end of the range, {end:g}"
                break
            try:
                place, easy = follower._next(last, limited, end)
                if _meets_half(self.system, last.orbit.points, place.orbit.points):
                    reason = f"meets the orbit of period {last.orbit.period // 2}"
                    break
                turn, length = self._turn(*places[-2:], place)
                if length > first_step:
                    step = 0.5 * length
                    if turn < 0.0:
                        places.pop()
                        del events[events_before.pop() :]
                    continue
                if len(places) > 2:
                    closing = _come_back(self.system, first, last, place)
                place = closing or place
                between = events_between(follower.system, last, place, self.count, self.accuracy)
            except ArithmeticError as why:
                step = 0.5 * limited
                if step < self.least and isinstance(why, NotSolved) and wide < WIDEST:
                    wide *= WIDER
                    follower, places[-1] = follower._widened(last, WIDER)
                    step = first_step
                elif step < self.least:
                    reason = f"at {last.orbit.parameter:.6g} no step above {self.least:g} succeeds: {why}"
                    break
                continue
            places.append(place)
            events_before.append(len(events))
            events += between
            if closing:
                closed = True
                reason = "comes back to its beginning"
                break
            if self.enough and self.enough(place.orbit, events):
                reason = "followed as far as asked"
                break
            if easy:
                step = min(step * GROW, self.longest)
            if wide > 1.0 and step > first_step:
                follower, places[-1] = follower._widened(place, 1.0 / wide)
                wide, step = 1.0, first_step
        return places[1:], events, reason, closed

    def _widened(self, place, by):
        """The same with a parameter whose size is that many times as large, and a place with the tangent of that."""
        system = replace(self.system, parameter_size=by * self.system.parameter_size)
        length = system.length(place.change[0], place.rate / by)
        change, rate = place.change / length, place.rate / by / length
        return replace(self, system=system), place._replace(change=change, rate=rate, slopes=by * place.slopes)

    def _limit(self, place, step):
        """The end of the range that a step would reach, or None; and the step, cut there."""
        end = self.high if place.rate > 0.0 else self.low
        room = (end - place.orbit.parameter) / self.system.parameter_size
        return (end, room / place.rate) if abs(place.rate) * step >= abs(room) else (None, step)

    def _next(self, place, step, end):
        """The place one step on, and whether Newton's method was quick. Raises NoImage where there is none.

        end: value at which the parameter is held, at the end of the range; None within it.
        """
        size, tangent = self.system.parameter_size, self.system.row(place.change[0], place.rate)
        points = place.orbit.points + step * place.change
        parameter = place.orbit.parameter + step * place.rate * size if end is None else end
        across, directions = tangent if end is None else None, real_span(place.orbit.vectors)
        newton = NEAR_ORBITS._replace(tolerance=self.system.tolerance)
        solved = solved_near(self.system, points, parameter, newton, across, directions, place.slopes)
        if self.system.length(solved.points[0] - points[0], (solved.parameter - parameter) / size) > NEAR * step:
            raise NotSolved("the branch turns too sharply: the map is not smooth there, or steps scatter the orbit")
        if not self.low <= solved.parameter <= self.high:
            raise NoImage("the orbit found is out of the range")
        orbit, space = described(solved, self.count)
        slopes = slopes_of(solved.maps, solved.shots, solved.points, solved.parameter)
        change, rate = tangent_of(self.system, space, slopes, tangent)
        if tangent @ np.append(change[0], rate) < STRAIGHT:
            raise NotSolved("the branch turns too sharply: the map is not smooth there, or steps scatter the orbit")
        return Place(orbit, change, rate, slopes), solved.iterations <= FEW

    def _turn(self, *places):
        """Where a test function may be zero twice between two neighbours of three places; 0, 0 where it is not.

        It is judged by the parabola through its values. Returns its turning point, counted from the second place (below
        0: between the first two), and how far apart the two neighbours are.
        """
        if len(places) < 3:
            return 0.0, 0.0
        steps = []
        for place, following in pairwise(places):
            way = following.orbit.points[0] - place.orbit.points[0]
            rate = (following.orbit.parameter - place.orbit.parameter) / self.system.parameter_size
            steps.append(self.system.length(way, rate))
        for factors in FACTORS.values():
            values = [test_of(factors, place.orbit) for place in places]
            bend, slope, value = np.polyfit([-steps[0], 0.0, steps[1]], values, 2)
            alike = min(value * values[0], value * values[2]) > 0.0
            if alike and 0.0 < 4.0 * bend * value < slope**2:
                turn = -0.5 * slope / bend
                if -steps[0] < turn < steps[1]:
                    return turn, steps[int(turn > 0.0)]
        return 0.0, 0.0


def tangent_of(system, space, slopes, direction):
    """The tangent in the direction of the row before (n + 1,): change (N, n) of the points, rate of the parameter."""
    change, rate = space.solve(np.zeros_like(slopes), slopes, direction, 1.0)
    length = system.length(change[0], rate)
    return change / length, rate / length


def _reversed(place):
    return place._replace(change=-place.change, rate=-place.rate)


def _meets_half(system, previous, following):
    """Whether the two halves of an orbit of even period have changed places in between."""
    half, odd = divmod(len(previous), 2)
    if odd or not half:
        return False
    return float(system.row(previous[0] - previous[half], 0.0) @ np.append(following[0] - following[half], 0.0)) < 0.0


def _come_back(system, first, last, place):
    """The first place, begun where the branch comes back to it, if that lies on the chord from here; else None."""
    begin = np.append(last.orbit.points[0], last.orbit.parameter / system.parameter_size)
    chord = np.append(place.orbit.points[0], place.orbit.parameter / system.parameter_size) - begin
    across, length = system.row(chord[:-1], chord[-1]), system.length(chord[:-1], chord[-1])
    for k in range(first.orbit.period):
        points, change = np.roll(first.orbit.points, -k, axis=0), np.roll(first.change, -k, axis=0)
        way = np.append(points[0], first.orbit.parameter / system.parameter_size) - begin
        share = across @ way / length**2
        off = way - share * chord
        straight = across @ np.append(change[0], first.rate) > 0.5 * system.length(change[0], first.rate) * length
        if 0.0 < share <= 1.0 and system.length(off[:-1], off[-1]) < ON_CHORD * length and straight:
            return first._replace(orbit=replace(first.orbit, points=points), change=change)
    return None
