"""Where the stored energy of the breaking line goes: end work, kinetic energy, shocks.

    stored + kinetic + lost in shocks = stored at rest + work of the end force,  which is below zero

Stored energy W = integral of T d eps is counted from the strain at which T = 0, where it is least. A shock loses the
area between the law and its chord (`simple_wave.dissipation`) per unit of unstretched length that it passes.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from analysis.sampling import locked
from campaigns.breaking_line.theory.fitted import strains_at_end
from campaigns.breaking_line.theory.law import energy, riemann, strain_of_tension, wave_speed
from campaigns.breaking_line.theory.simple_wave import dissipation

POINTS = 4001  # per smooth part of the line


@dataclass(frozen=True, eq=False)
class EnergyBudget:
    """Energies of the breaking line; all (times,), in J.

    time_s           [s]
    stored_J         elastic, counted from T = 0
    kinetic_J        axial
    end_work_J       done on the line by the end force since the start; negative
    lost_J           in shocks since the start
    closure_J        stored at rest + end work - stored - kinetic - lost: the error of the solution
    rest_J           stored before the break, one number
    """

    time_s: np.ndarray
    stored_J: np.ndarray
    kinetic_J: np.ndarray
    end_work_J: np.ndarray
    lost_J: np.ndarray
    closure_J: np.ndarray
    rest_J: float


def fitted_energy(motion, times_s):
    """Energy budget of an exact motion, by quadrature over its smooth parts and along its shock path.

    motion    FittedBreak;  times_s (times,) [s], none after its valid_until_s
    Returns an EnergyBudget whose closure_J measures the error of the motion and of the quadratures together: below 1e-5
    of rest_J with 400 lines up to the fixed end.
    """
    law, times = motion.law, np.asarray(times_s, float)
    least = energy(law, strain_of_tension(law, 0.0, 0.0))
    rest = motion.length * (energy(law, motion.strain0) - least)
    stored, kinetic, work = np.empty((3, len(times)))
    for i, t in enumerate(times):
        stored[i] = kinetic[i] = 0.0
        edges = _smooth_parts(motion, t)
        for low, high in pairwise(edges):
            s = np.linspace(low, high, POINTS)
            s[-1] = np.nextafter(high, low) if high < motion.length else high  # the state ahead of a shock at `high`
            strain, velocity, _ = motion.at(s, t)
            stored[i] += np.trapezoid(energy(law, strain) - least, s)
            kinetic[i] += np.trapezoid(0.5 * law[5] * velocity**2, s)
        work[i] = _end_work(motion, t)
    lost = _lost(motion, times)
    arrays = (times, stored, kinetic, work, lost, rest + work - stored - kinetic - lost)
    return EnergyBudget(*(locked(array) for array in arrays), float(rest))


def _smooth_parts(motion, t):
    """Places between which the motion is smooth: the ends, the front, the shock, where slack begins."""
    inner = []
    for strain, left in ((motion.strain0, 0.0), (strain_of_tension(motion.law, 0.0, 0.0), motion.decay_s)):
        inner.append(motion.length - wave_speed(motion.law, strain) * max(t - left, 0.0))
    shock = motion.shock
    if len(shock.time_s) > 1 and shock.time_s[0] <= t < shock.time_s[-1]:
        inner.append(float(shock.at(t)[0]))
    return [0.0, *sorted(x for x in inner if 0.0 < x < motion.length), motion.length]


def _end_work(motion, t):
    """Integral of F u over the break, u = p - phi at the end; Gauss-Legendre in 64 panels."""
    until = min(t, motion.decay_s)
    x, w = np.polynomial.legendre.leggauss(8)
    panels = np.linspace(0.0, until, 65)
    times = (0.5 * (panels[:-1] + panels[1:])[:, None] + 0.5 * np.diff(panels)[:, None] * x).ravel()
    weights = (0.5 * np.diff(panels)[:, None] * w).ravel()
    force = motion.tension0 * np.cos(0.5 * np.pi * times / motion.decay_s) ** 2
    phi = riemann(motion.law, strains_at_end(motion.law, motion.tension0, motion.decay_s, times))
    return float(np.sum(weights * force * (motion.outgoing(times) - phi)))


def _lost(motion, times):
    shock = motion.shock
    if len(shock.time_s) < 2:
        return np.zeros(len(times))
    power = np.array([dissipation(motion.law, a, b) for a, b in zip(shock.ahead, shock.behind, strict=True)])
    lost = np.append(0.0, np.cumsum(0.5 * (power[1:] + power[:-1]) * np.diff(shock.time_s)))
    return np.interp(times, shock.time_s, lost)
