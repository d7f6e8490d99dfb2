"""What the shock of the breaking line dissipates.

A shock loses the area between the law and its chord (`simple_wave.dissipation`) per unit of unstretched length that it
passes; stored + kinetic + lost = stored at rest + work of the end force, which is below zero.
"""

import numpy as np

from campaigns.breaking_line.theory.fitted import FittedBreak
from campaigns.breaking_line.theory.simple_wave import dissipation


def lost_energy(motion: FittedBreak, times_s: np.ndarray) -> np.ndarray:
    """Energy [J] lost in the shock of an exact motion up to times (m,) [s]."""
    times, shock = np.asarray(times_s, float), motion.shock
    if len(shock.time_s) < 2:
        return np.zeros(len(times))
    power = np.array([dissipation(motion.law, a, b) for a, b in zip(shock.ahead, shock.behind, strict=True)])
    lost = np.append(0.0, np.cumsum(0.5 * (power[1:] + power[:-1]) * np.diff(shock.time_s)))
    return np.interp(times, shock.time_s, lost)
