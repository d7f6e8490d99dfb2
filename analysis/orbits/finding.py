"""Periodic orbits by Newton's method, with their multipliers; the equations are (a) and (b) of `spaces`."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from analysis.orbits.maps import NoImage, OrbitMap, Shots, shoot, slopes_of
from analysis.orbits.spaces import Space
from analysis.sampling import checked_count, checked_series

TOLERANCE = 1e-9  # of the gaps, relative to the largest coordinate of the guess or 1
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
    iterations          of Newton's method
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


@dataclass(frozen=True, eq=False)
class Solved:
    """What Newton's method leaves: points (N, n), parameter, the shots there, iterations, directions (n, k) that
    mattered, and why it failed."""

    points: np.ndarray
    parameter: float
    shots: Shots | None
    iterations: int
    directions: np.ndarray
    reason: str = ""


class Correction(NamedTuple):
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
    tolerance: float = TOLERANCE,
    iterations: int = 20,
) -> Orbit:
    """The periodic orbit near a start: Newton's method on all its points at once, with its multipliers.

    start        (n,) a state, whose images are the first guess, or (period, n): a guess of every point
    count        multipliers wanted, the largest
    tolerance    of the gaps, relative to the largest coordinate of the start or 1
    iterations   of Newton's method; a step that does not shorten the gaps is halved up to six times
    Returns an Orbit: `period` is the least one, a divisor of the one asked for. Where none was found, `reason` says
    why, and the points are the last ones. Stable and unstable orbits are found alike; a search proves no completeness.
    Raises ValueError for a start that is not finite or of another shape.
    """
    period, guess = checked_count(period, "period"), checked_series(start, "start", (1, 2))
    try:
        points = _images(system, guess, parameter, period) if guess.ndim == 1 else guess
        if len(points) != period:
            raise ValueError(f"start: {period} points are needed, given {len(points)}")
        maps, solved = solved_near(system, points, parameter, None, Correction(tolerance, iterations))
        if solved.reason:
            return not_found(solved)
        least = _least_period(solved.points)
        if least < period:
            shots = shoot(maps[:least], solved.points[:least], parameter)
            solved = Solved(solved.points[:least], parameter, shots, solved.iterations, solved.directions)
        return described(solved, count)[0]
    except ArithmeticError as why:
        return not_found(Solved(np.atleast_2d(guess), parameter, None, 0, guess, str(why)))


def scatter_of(system: OrbitMap, orbit: Orbit, *, tolerance: float = TOLERANCE) -> Scatter:
    """The errors of an orbit: it is found again with every other mesh of the system, at the same parameter."""
    others = []
    points, multipliers = np.zeros_like(orbit.points), orbit.residuals.copy()
    for mesh in range(1, system.meshes):
        other = _on_mesh(system, orbit, mesh, tolerance)
        if other.reason:
            return Scatter(np.full_like(points, np.inf), np.full_like(multipliers, np.inf), tuple(others))
        others.append(other)
        points = np.maximum(points, np.abs(other.points - orbit.points))
        apart = np.abs(other.multipliers - orbit.multipliers[:, None]).min(axis=1)
        multipliers = np.maximum(multipliers, apart)
    return Scatter(points, multipliers, tuple(others))


def _on_mesh(system, orbit, mesh, tolerance):
    directions = real_span(orbit.vectors)
    try:
        how = Correction(tolerance)
        _, solved = solved_near(system, orbit.points, orbit.parameter, None, how, directions, mesh=mesh)
        return not_found(solved) if solved.reason else described(solved, len(orbit.multipliers))[0]
    except ArithmeticError as why:
        return not_found(Solved(orbit.points, orbit.parameter, None, 0, directions, str(why)))


def corrected(
    maps: Sequence[OrbitMap],
    points: np.ndarray,
    parameter: float,
    tangent: np.ndarray | None,
    how: Correction,
    directions: np.ndarray | None = None,
    slopes: np.ndarray | None = None,
) -> Solved:
    """Newton's method on the gaps: at a fixed parameter, or orthogonally to a tangent (n + 1,) of the branch.

    directions (n, k): with which the spaces begin; slopes (N, n): approximate ones.
    """
    n, size, space = points.shape[1], maps[0].parameter_size, None
    directions = np.empty((n, 0)) if directions is None else directions
    enough = how.tolerance * max(1.0, np.abs(points).max())  # of the guess: far away any gap is small beside the points
    shots, taken = shoot(maps, points, parameter), 0
    while shots.residual > enough and taken < how.iterations:
        fresh = space is None
        if fresh:
            space = Space(shots.linearised, directions if tangent is None else np.c_[directions, tangent[:n]])
            if tangent is not None and slopes is None:
                slopes = slopes_of(maps, shots, points, parameter)
        change, delta = space.solve(shots.gaps, slopes, tangent)
        directions = space.strongest()
        for halving in range(how.halvings + 1):
            share, reason = 0.5**halving, "a Newton step does not shorten the gaps"
            trial = points + share * change, parameter + share * delta * size
            try:
                tried = shoot(maps, *trial)
            except ArithmeticError as why:
                reason = str(why)
                continue
            if tried.residual < shots.residual:
                break
        else:
            if fresh:
                return Solved(points, parameter, shots, taken, directions, f"{reason}; {shots.residual:.1e} is left")
            space = slopes = None
            continue
        if tried.residual > how.kept * shots.residual:
            space = slopes = None
        (points, parameter), shots, taken = trial, tried, taken + 1
    reason = "" if shots.residual <= enough else f"{taken} Newton steps leave {shots.residual:.1e}"
    return Solved(points, parameter, shots, taken, directions, reason)


def solved_near(
    system: OrbitMap, points: np.ndarray, parameter: float, *more, mesh: int = 0
) -> tuple[Sequence[OrbitMap], Solved]:
    """`corrected` with the steps of the system at the guess, and again with those at the orbit where it lies apart."""
    maps = system.near(points, parameter, mesh)
    solved = corrected(maps, points, parameter, *more)
    if system.frozen and not solved.reason and np.linalg.norm(solved.points - points, axis=1).max() > MOVED:
        maps = system.near(solved.points, solved.parameter, mesh)
        solved = corrected(maps, solved.points, solved.parameter, *more)
    return maps, solved


def described(solved: Solved, count: int) -> tuple[Orbit, Space]:
    """The Orbit that Newton's method has found, with its multipliers, and the space in which they were found."""
    space = Space(solved.shots.linearised, solved.directions)
    found = space.multipliers(count)
    return Orbit(solved.points, float(solved.parameter), *found, solved.shots.residual, solved.iterations), space


def not_found(solved: Solved) -> Orbit:
    """The Orbit that says why there is none."""
    multipliers, vectors = np.empty(0, complex), np.empty((solved.points.shape[1], 0), complex)
    return Orbit(
        solved.points, solved.parameter, multipliers, np.empty(0), vectors, np.nan, solved.iterations, solved.reason
    )


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


def _least_period(points):
    close = REPEATS * max(1.0, np.abs(points).max())
    divisors = (p for p in range(1, len(points)) if len(points) % p == 0)
    return next((p for p in divisors if np.abs(points - np.roll(points, -p, axis=0)).max() < close), len(points))
