"""One reference for a breaking line at any places and times: exact where it can be, finite volumes after that."""

from dataclasses import dataclass

import numpy as np

from analysis.line_waves.captured import captured_break
from analysis.line_waves.fitted import ShockPath
from analysis.line_waves.fitting import fitted_break
from analysis.line_waves.law import checked_law, riemann, strain_of_tension
from analysis.line_waves.volumes import HALF, tension
from analysis.sampling import checked_series, locked


@dataclass(frozen=True, eq=False)
class BreakReference:
    """The breaking line at given places and times.

    time_s (times,), s_m (places,)
    strain, velocity_mps, tension_N     (times, places)
    exact                    (times,) True: by characteristics, False: by finite volumes
    shock                    ShockPath of the exact part
    exact_until_s            when it ends
    """

    time_s: np.ndarray
    s_m: np.ndarray
    strain: np.ndarray
    velocity_mps: np.ndarray
    tension_N: np.ndarray
    exact: np.ndarray
    shock: ShockPath
    exact_until_s: float


def reference_break(parameters, mass, length, tension0, decay_s, times_s, places_m, cells=8000, barrier_N=0.0):
    """Exact strain, speed and tension of the breaking line where known, and those of fine finite volumes elsewhere.

    parameters    p1 ... p5 of eq. (20);  mass [kg/m];  length [m];  tension0 [N];  decay_s [s]
    times_s       (times,) increasing [s];  places_m (places,) from the fixed end [m], the nodes of a grid for instance
    cells         of the finite volumes, which run only when a time needs them;  barrier_N  as in `captured_break`
    Returns a BreakReference. Exact up to the first of: a second shock, a strain below -1/2 with a barrier (there the
    law is another one). After that values between the middles of cells are interpolated, error h [eps] at shocks.
    Sources: `fitting`, `captured`.
    """
    times, places = checked_series(times_s, "times_s"), checked_series(places_m, "places_m")
    if len(times) == 0 or times[0] < 0.0 or np.any(np.diff(times) <= 0.0):
        raise ValueError("times_s: increasing times >= 0 are needed")
    motion = fitted_break(parameters, mass, length, tension0, decay_s, max(times[-1], 1e-9))
    until = min(motion.valid_until_s, first_below(motion, HALF - 1.0) if barrier_N > 0.0 else np.inf)
    exact = times <= until
    strain, velocity = np.empty((2, len(times), len(places)))
    for i in np.flatnonzero(exact):
        strain[i], velocity[i], _ = motion.at(places, times[i])
    if not np.all(exact):
        run = captured_break(parameters, mass, length, tension0, decay_s, times[~exact], cells, barrier_N)
        for i, row, speeds in zip(np.flatnonzero(~exact), run.strain, run.velocity_mps, strict=True):
            strain[i] = np.interp(places, run.s_m, row)
            velocity[i] = np.interp(places, np.append(0.0, run.s_m), np.append(0.0, speeds))
    law = checked_law(parameters, mass)
    pull = np.array([tension(law, barrier_N, eps) for eps in strain.ravel()]).reshape(strain.shape)
    arrays = (locked(array) for array in (times, places, strain, velocity, pull, exact))
    return BreakReference(*arrays, motion.shock, float(until))


def first_below(motion, strain):
    """First time [s] at which a strain of the FittedBreak is below `strain`; inf: never while it is valid.

    Looked for where characteristics cross, and at the fixed end.
    """
    net, low = motion.net, riemann(motion.law, strain)
    if motion.strain0 <= strain or strain > strain_of_tension(motion.law, 0.0, 0.0):
        raise ValueError(f"strain: below that of T = 0 is meant, given {strain}")
    when = net.T[(0.5 * (net.p[:, None] - net.q[None, :]) < low) & np.isfinite(net.T)]
    return float(np.min(when)) if len(when) else np.inf
