"""Periodic orbits of eq. (33) by Newton's method on the strobed map, with their multipliers."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from analysis.oscillator.equation import SnapOscillator
from analysis.oscillator.motions import checked_start, checked_starts
from analysis.oscillator.pieces import tables
from analysis.oscillator.strobing import strobed_orbit, tangent_map
from analysis.sampling import checked_count

# Of the residual, relative to the size of the orbit. Newton's method goes on until rounding stops it; what is left then
# must be below the second number, or it was no convergence.
EXACT, CONVERGED = 1e-16, 1e-10


@dataclass(frozen=True, eq=False)
class PeriodicOrbit:
    """A periodic orbit of the strobed map P.

    period           least number of forcing periods after which it repeats
    points           (period, 2) strobed states (g, g'), in order
    multipliers      (2,) complex eigenvalues of the derivative of P^period; their product is e^{-mu period T}
    residual         largest |P^period(x) - x|
    iterations       Newton steps
    stable           both multipliers inside the unit circle
    """

    period: int
    points: np.ndarray
    multipliers: np.ndarray
    residual: float
    iterations: int

    @property
    def stable(self) -> bool:
        """Both multipliers inside the unit circle."""
        return bool(np.abs(self.multipliers).max() < 1.0)


def periodic_orbit(
    oscillator: SnapOscillator, period: int, guess: ArrayLike, iterations: int = 50
) -> PeriodicOrbit | None:
    """A periodic orbit of eq. (33) near a guess: Newton's method on P^period(x) - x = 0 with the exact tangent map.

    A step that does not shorten the residual is halved, up to ten times. Where that does not help either, the residual
    is rounding (1e-10 of the orbit's size, or less: converged) or the search has failed.

    period   forcing periods;  guess  (g, g') at the strobe
    Returns PeriodicOrbit (its `period` is the least one, a divisor of the one asked for) or None where Newton's method
    did not converge within `iterations`.
    """
    period, iterations = checked_count(period, "period"), checked_count(iterations, "iterations")
    x = np.array(checked_start(guess))
    table = tables(oscillator)
    g, v, jacobian = tangent_map(x[0], x[1], period, table)
    residual = np.array([g, v]) - x
    for taken in range(iterations):
        size = max(1.0, np.abs(x).max())
        if np.abs(residual).max() <= EXACT * size:
            return _described(x, period, taken, table)
        try:
            step = np.linalg.solve(jacobian - np.eye(2), -residual)
        except np.linalg.LinAlgError:
            return None
        for halving in range(11):
            trial = x + step / 2**halving
            g, v, trial_jacobian = tangent_map(trial[0], trial[1], period, table)
            trial_residual = np.array([g, v]) - trial
            if np.abs(trial_residual).max() < np.abs(residual).max():
                break
        else:
            close = np.abs(residual).max() <= CONVERGED * size
            return _described(x, period, taken, table) if close else None
        x, residual, jacobian = trial, trial_residual, trial_jacobian
    return None


def search_periodic_orbits(oscillator: SnapOscillator, period: int, starts: ArrayLike) -> tuple[PeriodicOrbit, ...]:
    """Periodic orbits of eq. (33) of one least period: Newton's method from many starts, each orbit once.

    period   least period wanted, in forcing periods;  starts  (n, 2) guesses: points of a section, or a grid
    Returns a tuple of PeriodicOrbit, stable ones first, then by first displacement; empty where none was met. Newton's
    method finds stable and unstable orbits alike, and a search from starts proves no completeness.
    """
    found: list[PeriodicOrbit] = []
    for start in checked_starts(starts):
        orbit = periodic_orbit(oscillator, period, start)
        if orbit is None or orbit.period != period:
            continue
        if all(np.abs(orbit.points[0] - other.points).max(axis=1).min() > 1e-6 for other in found):
            found.append(orbit)
    return tuple(sorted(found, key=lambda orbit: (not orbit.stable, orbit.points[0, 0])))


def _described(x, period, iterations, table):
    points = strobed_orbit(x[0], x[1], 0, period + 1, table)
    close = 1e-8 * max(1.0, np.abs(points).max())
    least = next(p for p in range(1, period + 1) if period % p == 0 and np.abs(points[p] - points[0]).max() < close)
    _, _, jacobian = tangent_map(x[0], x[1], least, table)
    first = int(points[:least, 0].argmin())  # the same orbit begins with the same point, whatever the guess
    ordered = np.roll(points[:least], -first, axis=0)
    residual = float(np.abs(points[least] - points[0]).max())
    return PeriodicOrbit(least, ordered, np.linalg.eigvals(jacobian).astype(complex), residual, iterations)
