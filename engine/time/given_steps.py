"""March over steps that are given: the map of a state over a span of time, smooth in the state and in the parameters.

Steps that adapt themselves to a state make its image jump where their number changes. Taken over from one pass and kept
they do not, and the map repeats to the last bit.
"""

import math

import numpy as np

from ..arrays import Step, Trial
from ..compiled import kernel
from ..dimensions import largest_turn, size_of, work_arrays
from ..record import BEGIN, CONTROLLED, KIND, STEP
from ..simd.elementary import copy_into
from .status import OK, TURN_UNRESOLVED
from .steps import runge_kutta_step
from .time_loop import sample


@kernel
def march_over(p, tables, state, steps, motion, output, trail):
    """Take the steps (l, 2), begin and length (s), of a Runge-Kutta method from `motion` on, which is changed in place.

    There is no error control and no release of loops. The first l rows of the trail are filled, and the samples of the
    Output with what lies within. Returns (code, steps taken): a code of Newton's method, or TURN_UNRESOLVED where the
    turn in one element passes pi.
    """
    Y, Y_before, C, K = motion
    unknowns, size = size_of(p)
    work = work_arrays(p, p.nodes)
    trial = Trial(np.empty((p.stages, p.nodes, unknowns)), np.empty((p.stages, p.nodes, size)), np.empty_like(C))
    dt_before = 0.0
    for at in range(steps.shape[0]):
        step = Step(steps[at, 0], steps[at, 1], dt_before, False)
        code = runge_kutta_step(p, tables, step, motion, trial, work)[0]
        if code != OK:
            return code, at
        state.t = step.t
        begin, end = (C, K), (trial.C, trial.K[p.stages - 1])
        sample(p, tables, state, step.dt, True, begin, end, trial.Y, output.samples, output.profiles)
        trail.T[at, BEGIN], trail.T[at, STEP], trail.T[at, KIND] = step.t, step.dt, CONTROLLED
        for i in range(p.stages):
            copy_into(trail.Y[at, i], trial.Y[i])
            copy_into(trail.K[at, i], trial.K[i])
        copy_into(Y_before, Y)
        copy_into(Y, trial.Y[p.stages - 1])
        copy_into(K, trial.K[p.stages - 1])
        copy_into(C, trial.C)
        dt_before = step.dt
        state.max_turn = max(state.max_turn, largest_turn(p, Y)[0])
        if state.max_turn > math.pi:
            return TURN_UNRESOLVED, at
    return OK, steps.shape[0]
