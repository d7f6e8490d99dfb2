"""Periodic orbits of eq. (33) by Newton's method, which starts end on them, and the forcing at which slack begins.

The always taut motion is the linear response, so that its grazing of the switching line g = 0 is known in closed form:

    g = B - W + F/Z sin(omega t + phase - lag),   Z = |1 - omega^2 + i mu omega|,   tan lag = mu omega/(1 - omega^2)
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from analysis.oscillator.equation import SnapOscillator
from analysis.oscillator.motions import checked_start, checked_starts
from analysis.oscillator.pieces import steady_motion, tables
from analysis.oscillator.strobing import strobed_orbits, tangent_map
from analysis.sampling import checked_count

# Of the residual, relative to the size of the orbit. Newton's method goes on until rounding stops it; what is left then
# must be below the second number, or it was no convergence.
EXACT, CONVERGED = 1e-16, 1e-10
PAPER_BOX = (-60.0, 20.0, -25.0, 25.0)  # g low, g high, g' low, g' high: the attractors and their surroundings
_LOOK_EVERY = 64
_NEARLY = 1e-3


@dataclass(frozen=True, eq=False)
class PeriodicOrbit:
    """A periodic orbit of the strobed map P.

    period           least number of forcing periods after which it repeats
    points           (period, 2) strobed states (g, g'), in order
    multipliers      (2,) complex eigenvalues of the derivative of P^period; their product is e^{-mu period T}
    residual         largest |P^period(x) - x|
    iterations       Newton steps
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
    orbits: list[PeriodicOrbit] = []
    for start in checked_starts(starts):
        orbit = periodic_orbit(oscillator, period, start)
        if orbit is None or orbit.period != period:
            continue
        if all(np.abs(orbit.points[0] - known.points).max(axis=1).min() > 1e-6 for known in orbits):
            orbits.append(orbit)
    return tuple(sorted(orbits, key=lambda orbit: (not orbit.stable, orbit.points[0, 0])))


def _described(x, period, iterations, table):
    points = strobed_orbits(x[None], 0, period + 1, table)[0]
    close = 1e-8 * max(1.0, np.abs(points).max())
    least = next(p for p in range(1, period + 1) if period % p == 0 and np.abs(points[p] - points[0]).max() < close)
    _, _, jacobian = tangent_map(x[0], x[1], least, table)
    first = int(points[:least, 0].argmin())  # the same orbit begins with the same point, whatever the guess
    ordered = np.roll(points[:least], -first, axis=0)
    residual = float(np.abs(points[least] - points[0]).max())
    return PeriodicOrbit(least, ordered, np.linalg.eigvals(jacobian).astype(complex), residual, iterations)


@dataclass(frozen=True, eq=False)
class SnapBasins:
    """Where a set of starts ends.

    label (n,)          index into `orbits`; `len(orbits)` for starts that did not
                        settle on a periodic orbit within the time given (a chaotic attractor, or a long transient)
    settled (n,)        periods after which the orbit was seen to repeat; -1 for the others
    orbits              tuple of (period, 2) arrays: the strobed points of each periodic attractor found, in order,
                        the one with the most starts first
    shares              (len(orbits) + 1,) share of the starts on each, the aperiodic last
    errors              binomial standard errors of the shares, as if the starts had been drawn at random
    periods             forcing periods given to every start
    """

    label: np.ndarray
    settled: np.ndarray
    orbits: tuple[np.ndarray, ...]
    shares: np.ndarray
    errors: np.ndarray
    periods: int


def start_grid(columns: int, rows: int, box: tuple[float, float, float, float] = PAPER_BOX) -> np.ndarray:
    """Starts at the cell centres of a grid over a box in the (g, g') plane, for basins drawn as an image.

    columns, rows   cells along g and g';  box  (g low, g high, g' low, g' high), by default PAPER_BOX
    Returns (rows*columns, 2), g varying fastest.
    """
    columns, rows = checked_count(columns, "columns"), checked_count(rows, "rows")
    left, right, low, high = box
    g = left + (right - left) * (np.arange(columns) + 0.5) / columns
    v = low + (high - low) * (np.arange(rows) + 0.5) / rows
    return np.stack(np.meshgrid(g, v), axis=-1).reshape(-1, 2)


def snap_basins(
    oscillator: SnapOscillator, starts: ArrayLike, periods: int = 3000, longest_period: int = 32
) -> SnapBasins:
    """Basins of eq. (33): the periodic attractors that starts end on, each verified by Newton's method.

    An orbit that repeats itself to 1e-3 after p periods is a candidate only: attraction may be slow (the period-8
    orbit of the paper's parameters has a multiplier of -0.965), and a chaotic orbit returns that close by chance. It
    has settled when Newton's method, begun there, finds a stable orbit of that period, and the start's own orbit is
    nearer to it 64 p periods later than it was; otherwise it goes on with the periods it has left.

    starts           (n, 2) states at time 0 (`start_grid`, or random)
    periods          forcing periods given to each; a start that has not settled by then is called aperiodic, which for
                     a slowly attracting orbit only means "not yet": look at `settled`
    longest_period   looked for
    Returns SnapBasins. ValueError for starts that are not finite. A start whose orbit cannot be computed is aperiodic.
    Source: basins by recurrence, after Datseris & Wagemakers 2022, with Newton's method in place of cells.
    """
    state = checked_starts(starts).copy()
    periods, longest = checked_count(periods, "periods"), checked_count(longest_period, "longest_period")
    table, recent = tables(oscillator), np.empty((len(state), 0, 2))
    label, settled = np.full((2, len(state)), -1)
    orbits: list[np.ndarray] = []
    waiting = np.arange(len(state))
    for passed in range(_LOOK_EVERY, periods + 1, _LOOK_EVERY):
        further = strobed_orbits(state[waiting], 0, _LOOK_EVERY + 1, table)[:, 1:]
        state[waiting], recent = further[:, -1], np.concatenate([recent, further], axis=1)[:, -2 * longest :]
        for i, period in zip(waiting, _repeats(recent, longest), strict=True):
            if period and (orbit := _attracted(oscillator, state[i], int(period), table)) is not None:
                label[i], settled[i] = _index(orbits, orbit), passed
        recent, waiting = recent[label[waiting] < 0], waiting[label[waiting] < 0]
    return _counted(label, settled, orbits, periods)


def _repeats(recent, longest):
    """Least period p after which orbits (n, m, 2) repeat themselves at their end; 0 for the others, and for all
    while m is below twice the longest period looked for."""
    repeats_after = np.zeros(len(recent), dtype=int)
    for p in range(longest if recent.shape[1] >= 2 * longest else 0, 0, -1):
        difference = np.abs(recent[:, -p:] - recent[:, -2 * p : -p]).max(axis=(1, 2))
        repeats_after[difference <= _NEARLY] = p  # a state that is NaN repeats nothing
    return repeats_after


def _attracted(oscillator, state, period, table):
    """Points of the stable orbit on which a state that nearly repeats will end; None where there is none."""
    orbit = periodic_orbit(oscillator, period, state)
    if orbit is None or not orbit.stable:
        return None
    start, end = strobed_orbits(state[None], 0, 64 * period + 1, table)[0, [0, -1]]
    return orbit.points if _distance(end, orbit.points) <= max(_distance(start, orbit.points), 1e-9) else None


def _index(orbits, orbit):
    for index, orbit_seen in enumerate(orbits):
        if len(orbit_seen) == len(orbit) and _distance(orbit[0], orbit_seen) < 1e-6:
            return index
    orbits.append(orbit)
    return len(orbits) - 1


def _distance(state, orbit):
    return np.abs(state - orbit).max(axis=1).min()


def _counted(label, settled, orbits, periods):
    counts = np.bincount(label[label >= 0], minlength=len(orbits))
    order = np.argsort(-counts, kind="stable")
    rank = np.append(np.argsort(order, kind="stable"), len(orbits))  # the last one serves the label -1
    label = rank[label]
    shares = np.bincount(label, minlength=len(orbits) + 1) / len(label)
    errors = np.sqrt(shares * (1.0 - shares) / len(label))
    return SnapBasins(label, settled, tuple(orbits[i] for i in order), shares, errors, periods)


@dataclass(frozen=True)
class Grazing:
    """The onset of slack.

    force      F at which the least g over a period of the taut periodic motion is 0
    time       of the touch, in units of time after the strobe, 0 <= time < T
    clearance  least g there: what rounding leaves of 0
    velocity   g' at the touch, the same
    """

    force: float
    time: float
    clearance: float
    velocity: float


def clearance(oscillator: SnapOscillator) -> tuple[float, float, float]:
    """Least displacement of the motion of period T that is always taut, and when: (g, g', time).

    The motion is a motion of eq. (33) itself only while the least g is at least 0; below 0 it says by how much slack is
    entered. ValueError without damping, where there is no such motion that attracts.
    """
    mu, omega = oscillator.damping, oscillator.frequency
    if mu == 0.0:
        raise ValueError("damping: a number above 0 is needed for a taut motion that attracts")
    lag = math.atan2(mu * omega, 1.0 - omega**2)
    time = ((lag - 0.5 * math.pi - oscillator.phase) / omega) % oscillator.period
    phase = omega * time + oscillator.phase
    return (*steady_motion(1, tables(oscillator).constants, math.sin(phase), math.cos(phase)), time)


def grazing_force(oscillator: SnapOscillator) -> Grazing:
    """The forcing F = (B - W) Z below which eq. (33) has a motion without slack (head of this file).

    Below this F the motion is a plain sine about B - W, and attracts what starts near it; other attractors, with slack,
    may coexist. `oscillator.force` plays no part.

    Returns Grazing, with all fields NaN where B - W <= 0 (such a tether is slack at any F) and without damping (no
    taut motion attracts).
    """
    if oscillator.lift <= 0.0 or oscillator.damping == 0.0:
        return Grazing(math.nan, math.nan, math.nan, math.nan)
    force = oscillator.lift * oscillator.impedance
    g, u, time = clearance(replace(oscillator, force=force))
    return Grazing(force, time, g, u)
