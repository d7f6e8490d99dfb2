"""Periodic orbits by Newton's method, and their multipliers, both in Krylov spaces.

Newton: equation (b) of `maps` by GMRES (Saad & Schultz 1986). The eigenvalues of I - M are 1 but for a few, because a
damped system has forgotten most of its directions after a period, so that a handful of vectors solve it. Along a branch
the parameter is unknown too, and the correction is orthogonal to the tangent t of the branch (Keller 1977):

    [ I - M   -B  ] [ d_0   ]   [ R ]
    [ t_z^T   t_l ] [ delta ] = [ 0 ]                                                                     (c)

Multipliers: Rayleigh-Ritz in the block Krylov space [V, MV, M^2 V, ...], enlarged until the largest ones have settled;
at n vectors it is the whole space. The residual |M y - mu y| of each, with |y| = 1, is its error where M is normal.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse.linalg import LinearOperator, gmres

from analysis.orbits.maps import NoImage, OrbitMap, Shots, shoot
from analysis.sampling import checked_count, checked_series

TOLERANCE = 1e-9  # of the gaps, relative to the largest coordinate of the guess or 1
LINEAR = 1e-7  # what GMRES leaves of the right-hand side
MOST_VECTORS = 40  # of GMRES
HALVINGS = 6
REPEATS = 1e-6  # points this close, relative, are one: the period is a divisor of the one asked for
SEED = 16
MOST_PASSES, NEW_DIRECTION = 12, 1e-12  # of the block Krylov space


@dataclass(frozen=True, eq=False)
class Orbit:
    """A periodic orbit, or why none was found.

    points (N, n)       in order
    parameter
    multipliers (k,)    complex eigenvalues of M, the largest first, conjugate pairs together
    residuals (k,)      of each (head of this file)
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
    def stable(self) -> bool:
        """Whether all multipliers are inside the unit circle."""
        return self.found and bool(np.abs(self.multipliers).max() < 1.0)


@dataclass(frozen=True, eq=False)
class Solved:
    """What Newton's method leaves: points (N, n), parameter, the shots there, iterations, and why it failed."""

    points: np.ndarray
    parameter: float
    shots: Shots | None
    iterations: int
    reason: str = ""


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
    count        multipliers wanted (head of this file)
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
        maps = system.near(points, parameter)
    except NoImage as why:
        return not_found(np.atleast_2d(guess), parameter, 0, str(why))
    solved = corrected(maps, points, parameter, None, tolerance, iterations)
    if solved.reason:
        return not_found(solved.points, parameter, solved.iterations, solved.reason)
    orbit = described(solved, count)
    least = _least_period(orbit.points)
    if least < period:
        shots = shoot(maps[:least], orbit.points[:least], parameter, False)
        orbit = described(replace(solved, points=orbit.points[:least], shots=shots), count)
    return orbit


def multipliers_of(shots: Shots, count: int = 6, tolerance: float = 1e-9) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The largest multipliers: values (k,), residuals (k,) and eigenvectors (n, k), by block Rayleigh-Ritz.

    count       wanted; k is one larger where a conjugate pair would be cut, and n at most
    tolerance   of their residuals; where twelve passes do not reach it, the residuals say so
    """
    n = shots.gaps.shape[1]
    block = np.linalg.qr(np.random.default_rng(SEED).normal(size=(n, min(n, count + 2))))[0]
    basis = image = np.empty((n, 0))
    for _ in range(MOST_PASSES):
        basis, image = np.hstack([basis, block]), np.hstack([image, shots.carried(block)])
        values, small = np.linalg.eig(basis.T @ image)
        order = np.argsort(-np.abs(values), kind="stable")
        # of a pair, LAPACK gives the one with the positive imaginary part first
        cut = count + 1 if len(order) > count and values[order[count - 1]].imag > 0.0 else count
        values, small = values[order[:cut]], small[:, order[:cut]]
        residuals = np.linalg.norm(image @ small - (basis @ small) * values, axis=0)
        if residuals.max() < tolerance or basis.shape[1] >= n:
            break
        rest = image[:, -block.shape[1] :]
        for _ in range(2):  # once leaves rounding
            rest = rest - basis @ (basis.T @ rest)
        left, sizes, _ = np.linalg.svd(rest, full_matrices=False)
        block = left[:, sizes > NEW_DIRECTION * max(1.0, np.linalg.norm(image, 2))][:, : n - basis.shape[1]]
        if block.shape[1] == 0:  # M maps the space to itself
            break
        # a small direction is orthogonal to the others only to its rounding
        block = np.linalg.qr(block - basis @ (basis.T @ block))[0]
    return values.astype(complex), residuals, (basis @ small).astype(complex)


def corrected(
    maps: Sequence[OrbitMap],
    points: np.ndarray,
    parameter: float,
    tangent: np.ndarray | None,
    tolerance: float,
    iterations: int,
) -> Solved:
    """Newton's method on the gaps: at a fixed parameter, or orthogonally to a tangent (n + 1,) of the branch."""
    free, size, reason = tangent is not None, maps[0].parameter_size, ""
    enough = tolerance * max(1.0, np.abs(points).max())  # of the guess: far away any gap is small beside the points
    try:
        shots = shoot(maps, points, parameter, free)
    except NoImage as why:
        return Solved(points, parameter, None, 0, str(why))
    for taken in range(iterations + 1):
        if shots.residual <= enough:
            return Solved(points, parameter, shots, taken)
        if taken == iterations:
            break
        change, delta = update(shots, shots.gaps, tangent, 0.0)
        for halving in range(HALVINGS + 1):
            share, reason = 0.5**halving, "a Newton step does not shorten the gaps"
            trial = points + share * change, parameter + share * delta * size
            try:
                tried = shoot(maps, *trial, free)
            except NoImage as why:
                reason = str(why)
                continue
            if tried.residual < shots.residual:
                break
        else:
            return Solved(points, parameter, shots, taken, f"{reason}; {shots.residual:.1e} is left")
        (points, parameter), shots = trial, tried
    return Solved(points, parameter, shots, iterations, f"{iterations} Newton steps leave {shots.residual:.1e}")


def update(shots: Shots, known: np.ndarray, tangent: np.ndarray | None, along: float) -> tuple[np.ndarray, float]:
    """Solve (c) for known parts (N, n) in the place of the gaps, and `along` in the place of 0: d (N, n) and delta."""
    n, zero = known.shape[1], np.zeros(known.shape[1])
    R = shots.chain(zero, known)[-1] if known.any() else zero
    if tangent is None:
        first, delta = _solved(lambda v: v - shots.carried(v[:, None])[:, 0], R), 0.0
    else:
        B = shots.chain(zero, shots.slopes)[-1]

        def bordered(v):
            d = v[:n] - shots.carried(v[:n, None])[:, 0] - B * v[n]
            return np.append(d, tangent @ v)

        found = _solved(bordered, np.append(R, along))
        first, delta = found[:n], float(found[n])
    return shots.chain(first, known + delta * shots.slopes)[:-1], delta


def described(solved: Solved, count: int) -> Orbit:
    """The Orbit that Newton's method has found, with its multipliers."""
    shots = solved.shots
    return Orbit(
        solved.points, float(solved.parameter), *multipliers_of(shots, count), shots.residual, solved.iterations
    )


def _solved(product, right):
    """GMRES without restarts; what it leaves is left to Newton's next step."""
    vectors = min(len(right), MOST_VECTORS)
    operator = LinearOperator((len(right), len(right)), matvec=lambda v: product(v.ravel()), dtype=float)
    return gmres(operator, right, rtol=LINEAR, atol=0.0, restart=vectors, maxiter=1)[0]


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


def not_found(points: np.ndarray, parameter: float, iterations: int, reason: str) -> Orbit:
    """The Orbit that says why there is none."""
    multipliers, vectors = np.empty(0, complex), np.empty((points.shape[1], 0), complex)
    return Orbit(points, parameter, multipliers, np.empty(0), vectors, np.nan, iterations, reason)
