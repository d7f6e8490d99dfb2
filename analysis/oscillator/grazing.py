"""Grazing of eq. (33): the forcing at which the always taut motion first touches the switching line g = 0.

That motion is the linear response, so that all of it is known in closed form:

    g = B - W + F/Z sin(omega t + phase - lag),   Z = |1 - omega^2 + i mu omega|,   tan lag = mu omega/(1 - omega^2)
"""

import math
from dataclasses import dataclass, replace

from analysis.oscillator.equation import SnapOscillator
from analysis.oscillator.pieces import steady_motion, tables


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
