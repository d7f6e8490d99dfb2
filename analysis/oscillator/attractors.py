"""Periodic orbits of eq. (33), which starts settle on one, and the forcing at which slack begins.

Orbits are those of `analysis.orbits`, of the exact stroboscopic map and its exact derivative. The always taut motion is
the linear response, so that its grazing of the switching line g = 0 is known in closed form:

    g = B - W + F/Z sin(omega t + phase - lag),   Z = |1 - omega^2 + i mu omega|
"""

import math
from collections.abc import Iterable
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from analysis.orbits import Orbit, OrbitMap, find_orbit
from analysis.oscillator.equation import SnapOscillator
from analysis.oscillator.motions import checked_starts
from analysis.oscillator.pieces import tables
from analysis.oscillator.strobing import strobed_orbits, tangent_map
from analysis.periods import detect_period
from analysis.sampling import checked_count

PAPER_BOX = (-60.0, 20.0, -25.0, 25.0)  # g low, g high, g' low, g' high: the attractors and their surroundings


def snap_map(oscillator: SnapOscillator) -> OrbitMap:
    """The stroboscopic map of eq. (33) for `analysis.orbits`: states (g, g'); the parameter is the forcing F."""
    tables_by_force = {}

    def step(state, force):
        force = float(force)
        if force not in tables_by_force:
            tables_by_force.clear()
            tables_by_force[force] = tables(replace(oscillator, force=force))
        g, velocity, jacobian = tangent_map(state[0], state[1], tables_by_force[force])
        return np.array([g, velocity]), lambda vectors: jacobian @ vectors

    return OrbitMap(step)


def search_periodic_orbits(
    oscillator: SnapOscillator, period: int, starts: ArrayLike, *, same: float = 1e-6, tolerance: float = 1e-13
) -> tuple[Orbit, ...]:
    """Periodic orbits of eq. (33) of one least period: `find_orbit` from many starts, each orbit once.

    period      least period wanted, in forcing periods;  starts  (n, 2) guesses: points of a section, or a grid
    same        distance below which two orbits are one
    tolerance   of the gaps, as in `find_orbit`
    Returns a tuple of Orbit, each beginning with its leftmost point: stable ones first, then by that point; empty where
    none was met. Stable and unstable orbits are found alike, and a search from starts proves no completeness.
    """
    system, orbits = snap_map(oscillator), []
    search = {"count": 2, "tolerance": tolerance}
    for start in checked_starts(starts):
        orbit = find_orbit(system, start, oscillator.force, period, **search)
        if not orbit.found or orbit.period != period or _is_known(orbit.points[0], orbits, same):
            continue
        ordered = np.roll(orbit.points, -int(orbit.points[:, 0].argmin()), axis=0)
        orbits.append(find_orbit(system, ordered, oscillator.force, period, **search))
    return tuple(sorted(orbits, key=lambda orbit: (not orbit.stable, orbit.points[0, 0])))


def _is_known(point: np.ndarray, orbits: Iterable[Orbit], closeness: float) -> bool:
    return any(np.abs(point - known.points).max(axis=1).min() <= closeness for known in orbits)


def start_grid(columns: int, rows: int, box: tuple[float, float, float, float] = PAPER_BOX) -> np.ndarray:
    """Starts at the cell centres of a grid over a box in the (g, g') plane.

    columns, rows   cells along g and g';  box  (g low, g high, g' low, g' high), by default PAPER_BOX
    Returns (rows*columns, 2), g varying fastest.
    """
    columns, rows = checked_count(columns, "columns"), checked_count(rows, "rows")
    left, right, low, high = box
    g = left + (right - left) * (np.arange(columns) + 0.5) / columns
    v = low + (high - low) * (np.arange(rows) + 0.5) / rows
    return np.stack(np.meshgrid(g, v), axis=-1).reshape(-1, 2)


def settled_periods(
    oscillator: SnapOscillator, starts: ArrayLike, periods: int, longest_period: int = 32
) -> tuple[np.ndarray, np.ndarray]:
    """Which starts of eq. (33) have settled on a periodic motion after so many forcing periods.

    starts           (n, 2) states at time 0
    longest_period   looked for (`detect_period`) in the twelve times as many periods that follow
    Returns the periods (n,), 0 for a start that repeats after none of them, and the last states (n, 2). A slowly
    attracting orbit needs many periods: that of period 8 of the paper's numbers has a multiplier of -0.965.
    """
    points = 12 * longest_period
    sections = strobed_orbits(checked_starts(starts), checked_count(periods, "periods"), points, tables(oscillator))
    periods_found = np.zeros(len(sections), dtype=int)
    for place, section in enumerate(sections):
        if np.isfinite(section).all():
            scale = np.maximum(np.abs(section).max(axis=0), 1.0)
            periods_found[place] = detect_period(section, longest_period, scale=scale).period or 0
    return periods_found, sections[:, -1]


def grazing_force(oscillator: SnapOscillator) -> float:
    """The forcing F = (B - W) Z below which eq. (33) has a motion without slack (head of this file).

    Below this F the motion is a plain sine about B - W, and attracts what starts near it; other attractors, with slack,
    may coexist. `oscillator.force` plays no part.

    Returns NaN where B - W <= 0 (such a tether is slack at any F) and without damping (no taut motion attracts).
    """
    if oscillator.lift <= 0.0 or oscillator.damping == 0.0:
        return math.nan
    return oscillator.lift * oscillator.impedance
