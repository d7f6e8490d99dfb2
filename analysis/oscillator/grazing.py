"""Grazing of eq. (33): the forcing at which the always taut motion first touches the switching line g = 0."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq

from analysis.oscillator.equation import SnapOscillator
from analysis.oscillator.pieces import motion, tables

_SCAN = 512


@dataclass(frozen=True)
class Grazing:
    """The onset of slack.

    force      F at which the least g over a period of the taut periodic motion is 0
    time       of the touch, in units of time after the strobe, 0 <= time < T
    clearance  least g there: what is left of 0
    velocity   g' at the touch
    """

    force: float
    time: float
    clearance: float
    velocity: float


def clearance(oscillator: SnapOscillator) -> tuple[float, float, float]:
    """Least displacement of the motion of period T that is always taut, and when: (g, g', time).

    The motion is the fixed point of the taut piece over a period, g's minimum the root of g' with g'' > 0. It is a
    motion of eq. (33) itself only while the least g is at least 0; below 0 it says by how much slack is entered.
    ValueError without damping, where there is no such motion that attracts.
    """
    if oscillator.damping == 0.0:
        raise ValueError("damping: a number above 0 is needed for a taut motion that attracts")
    table = tables(oscillator)
    k = table.constants
    p0, w0 = (float(entry) for entry in table.steady[0, 1])
    c11, c12, c21, c22, q1, q2 = motion(1, oscillator.period, oscillator.phase, k, p0, w0)
    x, v = np.linalg.solve(np.eye(2) - np.array([[c11, c12], [c21, c22]]), [q1, q2])

    def state(tau):
        p11, p12, p21, p22, s1, s2 = motion(1, tau, oscillator.phase, k, p0, w0)
        return p11 * x + p12 * v + s1, p21 * x + p22 * v + s2

    times = np.linspace(0.0, oscillator.period, _SCAN + 1)
    speeds = np.array([state(tau)[1] for tau in times])
    rising = np.flatnonzero((speeds[:-1] < 0.0) & (speeds[1:] >= 0.0))
    if len(rising) == 0:  # at rest, or the minimum at the strobe itself
        return (*state(0.0), 0.0)
    minima = [brentq(lambda tau: state(tau)[1], times[j], times[j + 1], xtol=1e-15) for j in rising]
    tau = min(minima, key=lambda tau: state(tau)[0])
    return (*state(tau), tau % oscillator.period)


def grazing_force(oscillator: SnapOscillator) -> Grazing:
    """The forcing F below which eq. (33) has a motion without slack: its always taut motion touches g = 0 there.

    Found by solving clearance(F) = 0 for F, the clearance from the closed form of the taut piece, between F = 0 and
    the first doubling of F that enters slack. Below this F the motion is a plain sine about B - W, and attracts what
    starts near it; other attractors, with slack, may coexist. `oscillator.force` plays no part.

    Returns Grazing, with all fields NaN where B - W <= 0 (such a tether is slack at any F) and without damping (no
    taut motion attracts).
    """
    if oscillator.lift <= 0.0 or oscillator.damping == 0.0:
        return Grazing(np.nan, np.nan, np.nan, np.nan)

    def least(force):
        return clearance(replace(oscillator, force=force))[0]

    high = oscillator.lift
    while least(high) > 0.0:
        high *= 2.0
    force = brentq(least, 0.0, high, xtol=1e-16, rtol=4 * np.finfo(float).eps)
    g, u, time = clearance(replace(oscillator, force=force))
    return Grazing(float(force), float(time), float(g), float(u))
