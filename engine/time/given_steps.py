"""March over steps that are given: the map of a state over a span of time, smooth in the state and in the parameters.

Steps that adapt themselves to a state make its image jump where their number changes. Taken over from one pass and kept
they do not, and the map repeats to the last bit. A loop that the pass has released is released after the same step.
"""

import math

import numpy as np

from ..arrays import Step, Trial
from ..compiled import kernel
from ..dimensions import largest_turn, release_loop, size_of, work_arrays
from ..record import BEGIN, KIND, RELEASE_STEPS, RESTART, STEP
from .status import OK, TURN_UNRESOLVED
from .steps import runge_kutta_step
from .time_loop import accept, hold_turn, sample, store_step

BEFORE_RELEASE = 0.9 * math.pi  # turn of an element: from here on its stiffness grows without bound until its release


@kernel
def march_over(p, tables, state, steps, motion, output, trail):
    """Take the steps (l, 3), begin (s), length (s) and kind, from `motion` on, which is changed in place.

    There is no error control. Steps of the kind RESTART, RELEASE_STEPS of them, release the loop of the largest turn.
    The first l rows of the trail are filled, and the samples of the Output with what lies within. state.max_turn is the
    largest turn that no release has ended. Returns (code, steps taken): a code of Newton's method, or TURN_UNRESOLVED
    where a turn passes pi without a release, or is released below BEFORE_RELEASE.
    """
    Y, _, C, K = motion
    unknowns, size = size_of(p)
    work = work_arrays(p, p.nodes)
    trial = Trial(np.empty((p.stages, p.nodes, unknowns)), np.empty((p.stages, p.nodes, size)), np.empty_like(C))
    dt_before = 0.0
    for at in range(steps.shape[0]):
        small = steps[at, KIND] == RESTART
        if small and state.small_steps == 0:
            turn, element = largest_turn(p, Y)
            if turn < BEFORE_RELEASE:
                return TURN_UNRESOLVED, at
            state.turned, state.small_steps = release_loop(p, tables, Y, int(element)), RELEASE_STEPS
            state.releases += 1
            state.max_turn = dt_before = 0.0
        if state.max_turn > math.pi:
            return TURN_UNRESOLVED, at
        hold_turn(state, work.Q)
        step = Step(steps[at, BEGIN], steps[at, STEP], dt_before, small)
        code = runge_kutta_step(p, tables, step, motion, trial, work)[0]
        if code != OK:
            return code, at
        state.t = step.t
        begin, end = (C, K), (trial.C, trial.K[p.stages - 1])
        sample(p, tables, state, step.dt, not small, begin, end, trial.Y, output.samples, output.profiles)
        store_step(trail, at, step, steps[at, KIND], trial)
        accept(motion, trial)
        dt_before = step.dt
        if small:
            state.small_steps -= 1
        if state.small_steps == 0:
            state.turned = 0
            state.max_turn = max(state.max_turn, largest_turn(p, Y)[0])
    return TURN_UNRESOLVED if state.max_turn > math.pi else OK, steps.shape[0]
