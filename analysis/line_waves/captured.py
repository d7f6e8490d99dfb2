"""The motion of the breaking line on a fine grid of finite volumes, for what characteristics do not follow."""

from dataclasses import dataclass

import numpy as np

from analysis.line_waves.law import checked_law, strain_of_tension
from analysis.line_waves.volumes import COLLAPSED, advance, tension
from analysis.sampling import checked_count, checked_not_negative, checked_positive, checked_series, locked

COURANT = 0.9


@dataclass(frozen=True, eq=False)
class CapturedBreak:
    """Cell means of the breaking line at the times asked for.

    time_s (times,)          s_m (cells,)  middles of the cells, from the fixed end
    strain, velocity_mps, tension_N     (times, cells); tension of the mean strain, velocity along +s
    end_displacement_m, impulse_Ns, end_work_J     (times,) of the broken end since the start; impulse of both ends
    steps                    of the whole run
    """

    time_s: np.ndarray
    s_m: np.ndarray
    strain: np.ndarray
    velocity_mps: np.ndarray
    tension_N: np.ndarray
    end_displacement_m: np.ndarray
    impulse_Ns: np.ndarray
    end_work_J: np.ndarray
    steps: int


def captured_break(parameters, mass, length, tension0, decay_s, times_s, cells=4000, barrier_N=0.0):
    """The breaking line by MUSCL-Hancock finite volumes, to any time, with the compression barrier of the engine.

        eps_t = u_s,   m u_t = T_s,   u(0) = 0,   T(L) = tension0 cos^2(pi t/(2 decay_s)) until decay_s, then 0

    parameters    p1 ... p5 of eq. (20);  mass [kg/m];  length [m];  tension0 [N];  decay_s [s]
    times_s       (times,) increasing [s];  cells  of equal unstretched length
    barrier_N     P_b: the tension gains -P_b (1/(2 lambda) - 1)^2 below lambda = 1 + eps = 1/2; 0 none: the printed law
                  has next to no stiffness in compression, and strains pass -1 once the fixed end is met
    Returns a CapturedBreak. Length and momentum are conserved to rounding. ValueError for times that do not increase;
    RuntimeError when a strain stops being a number.
    Source and order: `volumes`.
    """
    law, force = checked_law(parameters, mass), checked_positive(tension0, "tension0")
    length, decay = checked_positive(length, "length"), checked_positive(decay_s, "decay_s")
    barrier, cells = checked_not_negative(barrier_N, "barrier_N"), checked_count(cells, "cells", 4)
    times = checked_series(times_s, "times_s")
    if len(times) == 0 or times[0] < 0.0 or np.any(np.diff(times) <= 0.0):
        raise ValueError("times_s: increasing times >= 0 are needed")
    eps = np.full(cells, strain_of_tension(law, force, 0.2))
    u, c, faces, totals = np.zeros(cells), np.empty(cells), np.empty((cells, 4)), np.zeros(4)
    strain, velocity = np.empty((len(times), cells)), np.empty((len(times), cells))
    ledger = np.empty((len(times), 3))
    now = 0.0
    for i, until in enumerate(times):
        code = advance(law, barrier, force, decay, length, COURANT, now, until, eps, u, c, faces, totals)
        if code == COLLAPSED:
            raise RuntimeError(f"the line collapses before {until} s: a barrier_N keeps strains above -1")
        now, strain[i], velocity[i], ledger[i] = until, eps, u, totals[:3]
    pull = np.array([tension(law, barrier, value) for value in strain.ravel()]).reshape(strain.shape)
    arrays = (times, (np.arange(cells) + 0.5) * length / cells, strain, velocity, pull, *ledger.T.copy())
    return CapturedBreak(*(locked(array) for array in arrays), int(totals[3]))
