"""Periodic orbits by Newton's method, with their multipliers; the equations are (a) and (b) of `spaces`."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from analysis.orbits.maps import TOLERANCE, NoImage, NotSolved, OrbitMap, Shots, shoot, slopes_of
from analysis.orbits.spaces import Space
from analysis.sampling import checked_count, checked_series

ROUGH, KEPT = 1e-4, 0.05  # tolerance before steps are chosen again; share of a gap that a derivative nearby may leave
SHARE_LEFT = 0.03  # of the gaps that another mesh makes of an orbit, where it is found again for its error only
MOVED = 1e-3  # from a guess, beyond which its steps do not suit an orbit
REPEATS = 1e-6  # points this close, relative, are one: the period is a divisor of the one asked for
SETTLED = 1e-3  # error of a multiplier, relative


@dataclass(frozen=True, eq=False)
class Orbit:
    """A periodic orbit, or why none was found.

    points (N, n)       in order
    parameter
    multipliers (k,)    complex, the largest first, conjugate pairs together
    residuals (k,)      their errors, of the iteration alone (`Space.multipliers`)
    vectors (n, k)      eigenvectors at the first point, of length 1
    gap                 largest |P(z_i) - z_{i+1}|
    iterations          of Newton's method, with the last steps of the system
    reason              why no orbit was found, a sentence; empty for an orbit
    """

    points: np.ndarray
    parameter: float
    multipliers: np.ndarray
    residuals: np.ndarray
    vectors: np.ndarray
    gap: float
    iterations: int
    reason: str = ""

    @property
    def period(self) -> int:
        """Periods after which it repeats."""
        return len(self.points)

    @property
    def found(self) -> bool:
        """Whether it is an orbit."""
        return not self.reason

    @property
    def settled(self) -> bool:
        """Whether each multiplier is known to 1e-3 of its modulus, or to be inside the unit circle."""
        modulus = np.abs(self.multipliers)
        return self.found and bool(((self.residuals < SETTLED * modulus) | (modulus + self.residuals < 1.0)).all())

    @property
    def stable(self) -> bool:
        """Whether all multipliers are known to be inside the unit circle."""
        return self.settled and bool(np.abs(self.multipliers).max() < 1.0)


@dataclass(frozen=True, eq=False)
class Scatter:
    """What other meshes change of an orbit: its errors. Inf where one of them has no orbit nearby.

    points (N, n)        largest differences of the coordinates
    multipliers (k,)     largest |difference| to the nearest multiplier
    orbits               those of the other meshes that were found
    """

    points: np.ndarray
    multipliers: np.ndarray
    orbits: tuple[Orbit, ...]


class Solved(NamedTuple):
    """What Newton's method finds: points (N, n), parameter, the maps and their shots there, iterations, the directions
    (n, k) that mattered, and the last derivative, of an orbit nearby; None where none was needed."""

    points: np.ndarray
    parameter: float
    maps: Sequence[OrbitMap]
    shots: Shots
    iterations: int
    directions: np.ndarray
    space: Space | None


class Newton(NamedTuple):
    """How Newton's method goes: to a tolerance of the gaps, in how many iterations at most, each halved how often. A
    derivative is kept for the next one where no more than the share `kept` of the gaps is left."""

    tolerance: float = TOLERANCE
    iterations: int = 20
    halvings: int = 6
    kept: float = 0.0


def find_orbit(
    system: OrbitMap,
    start: ArrayLike,
    parameter: float,
    period: int = 1,
    *,
    count: int = 6,
    tolerance: float | None = None,
    iterations: int = 20,
    halvings: int = 6,
) -> Orbit:
    """The periodic orbit near a start: Newton's method on all its points at once, with its multipliers.

    start        (n,) a state, whose images are the first guess, or (period, n): a guess of every point
    count        multipliers wanted, the largest
    tolerance    of the gaps, relative to the largest coordinate of the start or 1; None: that of the system
    iterations   of Newton's method
    halvings     of a step that does not shorten the gaps
    Returns an Orbit: `period` is the least one, a divisor of the one asked for. Where none was found, `reason` says
    why, and the points are those of the start. Stable and unstable orbits are found alike; no search is complete.
    Raises ValueError for a start that is not finite or of another shape.
    """
    period, guess = checked_count(period, "period"), checked_series(start, "start", (1, 2))
    if tolerance is None:
        tolerance = system.tolerance
    try:
        points = _images(system, guess, parameter, period) if guess.ndim == 1 else guess
        if len(points) != period:
            raise ValueError(f"start: {period} points are needed, given {len(points)}")
        while True:
            solved = solved_near(system, points, parameter, Newton(tolerance, iterations, halvings))
            least = _least_period(system, solved.points)
            if least == len(points):
                return described(solved, count)[0]
            guess = points = solved.points[:least]
    except ArithmeticError as why:
        return not_found(np.atleast_2d(guess), parameter, why)


def scatter_of(system: OrbitMap, orbit: Orbit, share_left: float = SHARE_LEFT) -> Scatter:
    """The errors of an orbit: it is found again with every other mesh of the system, at the same parameter.

    share_left: of the gaps that the other mesh makes of the orbit; 0: they are closed to the tolerance of the system.
    """
    points, rivals, directions = np.zeros_like(orbit.points), [], real_span(orbit.vectors)
    size = max(1.0, np.abs(orbit.points).max())
    try:
        for mesh in range(1, system.meshes):
            maps = system.near(orbit.points, orbit.parameter, mesh)
            shots = shoot(maps, orbit.points, orbit.parameter)
            newton = Newton(max(system.tolerance, share_left * shots.residual / size), kept=KEPT)
            solved = corrected(maps, orbit.points, orbit.parameter, newton, None, directions, shots=shots)
            rivals.append(described(solved, len(orbit.multipliers))[0])
            points = np.maximum(points, np.abs(rivals[-1].points - orbit.points))
    except ArithmeticError:
        return Scatter(np.full_like(points, np.inf), np.full_like(orbit.residuals, np.inf), tuple(rivals))
    return Scatter(points, changes(orbit, rivals), tuple(rivals))


def middle_of(system: OrbitMap, orbit: Orbit) -> tuple[Orbit, np.ndarray]:
    """Of the orbits on all meshes, that whose leading multiplier is in the middle, and the errors (k,) of multipliers.

    One mesh in three may give a false value; its distance is then the error.
    """
    scatter = scatter_of(system, orbit, share_left=0.0)
    candidates = sorted((orbit, *scatter.orbits), key=lambda one: abs(one.multipliers[0]))
    middle = candidates[len(candidates) // 2]
    lost = len(candidates) < system.meshes
    return middle, np.full_like(middle.residuals, np.inf) if lost else changes(middle, candidates)


def changes(orbit: Orbit, rivals: Sequence[Orbit]) -> np.ndarray:
    """Errors (k,) of the multipliers: largest |difference| to the nearest one of each of the others."""
    errors = orbit.residuals
    for rival in rivals:
        errors = np.maximum(errors, np.abs(rival.multipliers - orbit.multipliers[:, None]).min(axis=1))
    return errors


def corrected(
    maps: Sequence[OrbitMap],
    points: np.ndarray,
    parameter: float,
    newton: Newton,
    row: np.ndarray | None = None,
    directions: np.ndarray | None = None,
    slopes: np.ndarray | None = None,
    space: Space | None = None,
    shots: Shots | None = None,
) -> Solved:
    """Newton's method on the gaps: at a fixed parameter, or with corrections orthogonal to a row (n + 1,), and of m
    parameters (m,) to m rows (m, n + m).

    directions (n, k): with which the spaces begin; slopes (N, n) and space: approximate ones. shots: of the points,
    where they are known. Raises NoImage where it fails.
    """
    n, size, last = points.shape[1], maps[0].parameter_size, space
    if directions is None:
        directions = np.empty((n, 0))
    # of the guess: far away any gap is small beside the points
    enough = newton.tolerance * max(1.0, np.abs(points).max())
    if shots is None:
        shots = shoot(maps, points, parameter)
    taken = 0
    while shots.residual > enough:
        if taken == newton.iterations:
            raise NotSolved(f"{taken} Newton steps leave {shots.residual:.1e}")
        if fresh := space is None:
            first = directions
            if row is not None:
                first = np.hstack([directions, np.atleast_2d(row)[:, :n].T])
            space = Space(shots.linearised, first, maps[0].abreast)
        if row is not None and slopes is None:
            slopes = slopes_of(maps, shots, points, parameter)
        change, delta = space.solve(shots.gaps, slopes, row)
        last, directions, reason = space, space.strongest(), "a Newton step does not shorten the gaps"
        for share in 0.5 ** np.arange(newton.halvings + 1):
            trial = points + share * change, parameter + share * delta * size
            try:
                tried = shoot(maps, *trial)
            except ArithmeticError as why:
                reason = why
                continue
            if tried.residual < shots.residual:
                if tried.residual > newton.kept * shots.residual:
                    space = slopes = None
                (points, parameter), shots, taken = trial, tried, taken + 1
                break
        else:
            if fresh:
                failure = NotSolved if isinstance(reason, str) else NoImage
                raise failure(f"{reason}; {shots.residual:.1e} is left")
            space = slopes = None
    parameter = np.asarray(parameter, float)
    return Solved(points, parameter if parameter.ndim else float(parameter), maps, shots, taken, directions, last)


def solved_near(
    system: OrbitMap,
    points: np.ndarray,
    parameter: float,
    newton: Newton,
    row: np.ndarray | None = None,
    directions: np.ndarray | None = None,
    slopes: np.ndarray | None = None,
) -> Solved:
    """`corrected`, roughly with the steps of the system at the guess, and then with those at the orbit."""
    maps = system.near(points, parameter)
    if system.frozen is None:
        return corrected(maps, points, parameter, newton, row, directions, slopes)
    rough = corrected(maps, points, parameter, newton._replace(tolerance=ROUGH), row, directions, slopes)
    shots = rough.shots
    if np.linalg.norm(rough.points - points, axis=1).max() > MOVED:
        maps, shots = system.near(rough.points, rough.parameter), None
    newton = newton._replace(kept=max(newton.kept, KEPT))
    return corrected(maps, rough.points, rough.parameter, newton, row, rough.directions, slopes, rough.space, shots)


def described(solved: Solved, count: int) -> tuple[Orbit, Space]:
    """The Orbit that Newton's method has found, with its multipliers, and the space in which they were found."""
    space = Space(solved.shots.linearised, solved.directions, solved.maps[0].abreast)
    spectrum = space.multipliers(count)
    return Orbit(solved.points, solved.parameter, *spectrum, solved.shots.residual, solved.iterations), space


def not_found(points: np.ndarray, parameter: float, reason: object) -> Orbit:
    """The Orbit that says why there is none."""
    multipliers, vectors = np.empty(0, complex), np.empty((points.shape[1], 0), complex)
    return Orbit(points, parameter, multipliers, np.empty(0), vectors, np.nan, 0, str(reason))


def real_span(vectors: np.ndarray) -> np.ndarray:
    """Real vectors that span complex ones and their conjugates."""
    return np.hstack([vectors.real, vectors.imag[:, vectors.imag.any(axis=0)]])


def _images(system, z, parameter, period):
    """z and its images, `period` states (period, n)."""
    states = [z]
    for _ in range(period - 1):
        states.append(system.step(states[-1], parameter)[0])
    if not np.isfinite(states).all():
        raise NoImage("an image of the start is not finite")
    return np.array(states)


def _least_period(system, points):
    """The least period of points, those of a computed system as close as its steps leave them."""
    close = MOVED if system.frozen else REPEATS * max(1.0, np.abs(points).max())
    for period in range(1, len(points)):
        shifts = points - np.roll(points, -period, axis=0)
        if len(points) % period == 0 and max(system.length(change, 0.0) for change in shifts) < close:
            return period
    return len(points)
