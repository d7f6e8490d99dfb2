"""From one output sample to the next: step control, guards, loop release, even output.

`march` advances one run. In each step `begin_trial` chooses the length, `engine.time.steps` solves the stages by
Newton's method, `refused` judges the trial, and `next_step` chooses the next length. Lanes (`engine.lanes.ticks`) call
the same functions.

Loop release (THEORY.md, section 9): where the turn in one element passes pi, `guard_turns` takes 2 pi out of its phi.
`hold_turn` keeps them in the curvature of that element and lets them go within RELEASE_STEPS steps of backward Euler,
each p.turn_step long, without error control and without rates from before. Let go at once they rang: the box has no
curvature for a jump of phi in one element but one that alternates along the whole line, and at 41 nodes a loop under
30 N left 1 kN of compression. In space all goes at once, within SMALL_STEPS of p.release_step. One element is let go
at a time; others wait. The number of releases is part of the result.

Output on an even time grid comes from inside the accepted steps. Runge-Kutta steps carry rates at both ends: cubic
Hermite interpolation of the conserved variables, order 4; the one-stage methods (order 2 and less, undamped rates) are
interpolated linearly. Positions are the sums of the interpolated q; strains are interpolated by themselves
(`simd.elementary.strain_within`), near their stages where the line carries no buoy. Columns of samples and profiles:
`engine.record`.
"""

import math

import numpy as np

from .. import record as col
from ..arrays import Step, Trial
from ..compiled import kernel
from ..dimensions import configuration, conserved, largest_turn, release_loop, size_of, work_arrays
from ..physics.ends import corner_after
from ..physics.shocks import deforming_element, renew_viscosity
from ..planar.columns import EPS, TURN  # EPS: in space the same column
from ..record import RELEASE_STEPS, SMALL_STEPS
from ..simd.elementary import copy_into
from .damping import add_damping, extremes, stage_tensions, top_tension
from .energy import add_powers, store_energies
from .folds import watch_turn
from .ringing import jumps_of_rates, near_stages, watch_ringing
from .status import OK, STEP_LIMIT, STEP_UNDERFLOW, TURN_UNRESOLVED
from .steps import least_strain, one_stage_step, runge_kutta_step, trial_error

SAFETY, SHRINK, GROW = 0.9, 0.2, 4.0
NO_SLIVER = 1.01  # a step is made a little longer rather than leave next to nothing of the way to a corner
MOST_ATTEMPTS = 20_000  # steps tried within one `window` of time: more is a run that stands still
MANY_FAILURES = 2_000  # of Newton: more, and at a sixth of all trials, is a run that its failures hold
CAUTIOUS_STEPS, CAUTIOUS_GROW = 5, 1.3  # after a failure of Newton's method


@kernel
def guard_turns(p, tables, state, Y):
    """Watch the turn of every element after a step; release loops. Returns (code, whether a loop was released)."""
    released = False
    for _ in range(Y.shape[0]):
        turn, element = largest_turn(p, Y)
        watch_turn(state, turn)
        if turn <= math.pi or state.turned != 0:
            return OK, released
        if p.loop_release == 0 or state.releases >= p.max_releases:
            return TURN_UNRESOLVED, released
        state.turned = release_loop(p, tables, Y, int(element))
        state.releases += 1
        released = True
    return TURN_UNRESOLVED, released


@kernel
def hold_turn(state, Q):
    """Put into Q what the trial keeps of a released turn: 2 pi, less from step to step, 0 in the last one."""
    if state.turned != 0:
        remaining = math.pi * (1.0 - math.cos(math.pi * (state.small_steps - 1) / RELEASE_STEPS))
        Q[abs(state.turned), TURN] = remaining if state.turned > 0 else -remaining


@kernel
def begin_trial(p, tables, state):
    """Choose the step to try next: trial_dt; small, is it one of backward Euler?; cut, does it end at a corner?

    Ends the run where too many were tried within one window of time.
    """
    if state.t >= state.window_end:
        state.window_end = state.t + p.window
        state.attempts = 0
    state.attempts += 1
    if state.attempts > MOST_ATTEMPTS:
        state.status = STEP_LIMIT
        return
    state.small = state.small_steps > 0
    dt = state.dt
    state.corner = corner_after(p, tables, state.t) if p.adaptive else p.end_release
    # the step ends with a corner of a held end's motion
    state.cut = state.t < state.corner <= state.t + NO_SLIVER * dt
    state.trial_dt = state.corner - state.t if state.cut else dt


@kernel
def refused(p, state, code, used, error):
    """Book a trial that took `used` iterations; is it to be tried again with a shorter step (or the run at its end)?"""
    state.newton += used
    if code != OK:
        state.failures += 1
        _shorten(p, state, code, 0.5 if state.small else 0.25)
        state.dt_before = 0.0
        if state.failures > MANY_FAILURES and 5 * state.failures > state.steps:
            state.status = STEP_LIMIT
        return True
    if p.adaptive and not state.small and not error <= 1.0:
        state.rejected += 1
        _shorten(p, state, OK, max(SHRINK, SAFETY * error ** (-1.0 / p.order)) if np.isfinite(error) else SHRINK)
        return True
    state.steps += 1
    return False


@kernel
def _shorten(p, state, code, factor):
    """Shorten the step; name the end of the run where it would fall below the shortest allowed."""
    state.dt = state.trial_dt * factor
    state.cautious = CAUTIOUS_STEPS if code != OK else 0
    if state.dt < p.min_step:
        state.status = code if code != OK else STEP_UNDERFLOW


@kernel
def step_done(p, state):
    """The trial is accepted: move on in time."""
    state.t = state.corner if state.cut else state.t + state.trial_dt
    state.dt_before = state.trial_dt


@kernel
def next_step(p, state, code, released, error, longest):
    """The length of the next step, after an accepted one and what `guard_turns` found; fixed ones grow to `longest`."""
    if code != OK:
        state.status = code
    if released or (state.cut and state.corner == p.end_release):
        held = released and state.turned != 0
        state.small_steps = RELEASE_STEPS if held else SMALL_STEPS
        state.dt = p.turn_step if held else p.release_step
        state.dt_before = 0.0
    elif state.small:
        state.small_steps -= 1
        if state.small_steps == 0:
            state.turned = 0
            if p.adaptive == 0:
                state.dt = p.fixed_step
    elif p.adaptive:
        grow = GROW
        if state.cautious > 0:
            state.cautious -= 1
            grow = CAUTIOUS_GROW
        factor = min(grow, max(SHRINK, SAFETY * max(error, 1e-10) ** (-1.0 / p.order)))
        state.dt = min(p.max_step, state.trial_dt * factor)
    else:
        state.dt = min(longest, 2.0 * state.trial_dt)


@kernel
def weights_within(hermite, theta, dt):
    """Weights of C0, C1, K0, K1 at the share theta of a step, and theta."""
    if not hermite:
        return 1.0 - theta, theta, 0.0, 0.0, theta
    a = theta - 1.0
    first, last = (1.0 + 2.0 * theta) * a * a, theta * theta * (3.0 - 2.0 * theta)
    return first, last, dt * theta * a * a, dt * theta * theta * a, theta


@kernel
def line_at(p, tables, since, dt, hermite, begin, end, Ys, row):
    """The line `since` (s) after the begin of a step, as a profile: row (n, 6). Arguments as for `sample`.

    Returns the velocity (3) of the upper end, and the largest distance of a node from the plane.
    """
    (C0, K0), (C1, K1) = begin, end
    theta = since / dt
    weights, share = weights_within(hermite, theta, dt), theta if hermite else 0.5
    at_end = configuration(p, tables, weights, C0, K0, C1, K1, row)
    if hermite and Ys is not None:
        near_stages(p, tables, Ys, row)
    add_damping(p, weights, share, begin, end, row)
    return at_end


@kernel
def sample(p, tables, state, dt, hermite, begin, end, Ys, samples, profiles):
    """Store the samples and profiles that lie within the step from state.t to state.t + dt.

    begin, end: conserved variables and rates (n, conserved) at its begin and its end; Ys: its stages, or None; samples,
    profiles: of Output.
    """
    (C0, K0), (C1, K1) = begin, end
    n, until = C0.shape[0], state.t + dt
    row = np.empty((n, col.PROFILE_WIDTH))
    while state.samples < samples.shape[0] and (state.first + state.samples) * p.output_step <= until:
        t = (state.first + state.samples) * p.output_step
        out = samples[state.samples]
        out[col.AT_U], out[col.AT_V], out[col.AT_W], out[col.OFFPLANE] = line_at(
            p, tables, t - state.t, dt, hermite, begin, end, Ys, row
        )
        for i in range(3):
            out[col.AT_X + i] = row[n - 1, col.PLACE + i]
        tensions, most_at, k = row[:, col.TENSION], 0.0, 0
        (least, most), top = extremes(tensions), tensions[n - 1]
        while tensions[k] < most:
            most_at += tables[p.grid_at + k]
            k += 1
        out[col.TIME], out[col.TOP], out[col.LEAST] = t, top, least
        out[col.TOP_LOW], out[col.TOP_HIGH] = min(state.low, top), max(state.high, top)
        out[col.RELEASES], out[col.MISSED] = state.releases, max(state.ringing, 0.0)
        out[col.LOWEST], _ = extremes(row[:, col.PLACE + 2])
        out[col.FOOT], out[col.MOST], out[col.MOST_AT] = tensions[0], most, most_at
        out[col.FOOT_HIGH] = max(state.foot, tensions[0])
        state.ringing = min(state.ringing, 0.0)
        state.low, state.high, state.foot = top, top, tensions[0]
        state.samples += 1
    while state.profiles < profiles.shape[0] and (state.first_profile + state.profiles) * p.profile_step <= until:
        t = (state.first_profile + state.profiles) * p.profile_step
        line_at(p, tables, t - state.t, dt, hermite, begin, end, Ys, profiles[state.profiles])
        state.profiles += 1
    share = 1.0 if hermite else 0.5
    top, foot = top_tension(p, tables, share, C1, K0, K1), top_tension(p, tables, share, C1[:1], K0[:1], K1[:1])
    state.low, state.high, state.foot = min(state.low, top), max(state.high, top), max(state.foot, foot)


@kernel
def store_step(trail, at, step, kind, trial):
    """An accepted Step and its stages into row `at` of a Trail."""
    trail.T[at, col.BEGIN], trail.T[at, col.STEP], trail.T[at, col.KIND] = step.t, step.dt, kind
    for i in range(trial.Y.shape[0]):
        copy_into(trail.Y[at, i], trial.Y[i])
        copy_into(trail.K[at, i], trial.K[i])


@kernel
def accept(motion, trial):
    """The last stage of a Trial becomes the state."""
    last = trial.Y.shape[0] - 1
    copy_into(motion.Y_before, motion.Y)
    copy_into(motion.Y, trial.Y[last])
    copy_into(motion.K, trial.K[last])
    copy_into(motion.C, trial.C)


@kernel
def march(p, tables, state, motion, output, trail, until, one_stage, e_t, budget):
    """Advance one simulation until `until` samples are stored, the trail is full, or it ends.

    p, tables: parameters; state: STATE record (`engine.record`); motion: Motion, the state itself; both are changed in
    place. motion.C is kept from call to call: computed anew it would differ by rounding, and the calls would show.
    output: Output, columns of samples and profiles in `engine.record`; trail: Trail of accepted steps. An array without
    rows keeps nothing.

    None where the scene does not need them, so that their kernels are not compiled for it: one_stage, True for
    a one-stage method; e_t (n,), work of the shock viscosity; budget, the energies and sums of Output (columns in
    `engine.time.energy`), a row of which is stored at the first step past each output time.
    """
    Y, _, C, K = motion
    s = max(p.stages, 2)  # a one-stage method (p.stages = 0) fills the last of two
    unknowns, size = size_of(p)
    work = work_arrays(p, p.nodes)
    trial = Trial(np.empty((s, p.nodes, unknowns)), np.empty((s, p.nodes, size)), np.empty((p.nodes, size)))
    first = state.steps == 0
    if first:
        conserved(p, Y, C)
    if e_t is not None:  # a condition of its own: so Numba leaves the branch out where e_t is None
        if not first:
            renew_viscosity(p, tables, size // 2, C, K, e_t, work.Q)
    if budget is not None:
        if first:
            store_energies(p, tables, 0.0, C, budget[1], budget[0][0])
            state.energies = 1
    room = trail.T.shape[0]
    while state.status == OK and state.samples < until and (room == 0 or state.trail < room):
        # try a step, by the method of the scene or, where a small one is due, by backward Euler
        begin_trial(p, tables, state)
        if state.status != OK:
            break
        hold_turn(state, work.Q)
        small, code, used, error = state.small != 0, OK, 0, 0.0
        step = Step(state.t, state.trial_dt, state.dt_before, small)
        stiff = small or p.method == col.RUNGE_KUTTA  # "stiffly accurate": the last stage is the new state
        if stiff:
            code, used, error = runge_kutta_step(p, tables, step, motion, trial, work)
        if one_stage is not None:
            if not stiff:
                code, used = one_stage_step(p, tables, step, motion, trial, work)
        Y_new, K_new, jumps = trial.Y[s - 1], trial.K[s - 1], (0.0, 0.0)
        least, top = least_strain(Y_new), Y_new[p.nodes - 1, EPS]
        if code == OK and not small:
            jumps = jumps_of_rates(p, step.dt, (C, K), (trial.C, K_new))
            if p.adaptive:
                error = trial_error(p, tables, step.dt, error, least, top, jumps)
        if refused(p, state, code, used, error):
            continue
        # what lies within the accepted step goes into the output
        hermite = stiff and not small
        sample(p, tables, state, step.dt, hermite, (C, K), (trial.C, K_new), trial.Y, output.samples, output.profiles)
        if not small and state.ringing >= 0.0:
            if stiff:
                low, high = stage_tensions(p, tables, trial.Y, trial.K)
            else:
                low = high = top_tension(p, tables, 0.5, trial.C, K, K_new)
            watch_ringing(p, tables, state, top, low, high, jumps)
        if budget is not None:
            energies, sums = budget
            alphas = (1.0, 1.0, 1.0) if small else (p.alpha_m, p.alpha_f, p.gamma)
            add_powers(p, tables, step.dt, alphas, motion, trial.C, K_new, Y_new, work.Q, sums)
            if state.energies < energies.shape[0] and state.energies * p.output_step <= step.t + step.dt:
                store_energies(p, tables, step.t + step.dt, trial.C, sums, energies[state.energies])
                state.energies += 1
        if room > 0:
            kind = col.RESTART if small else col.CONTROLLED if stiff else col.EULER
            store_step(trail, state.trail, step, kind, trial)
            state.trail += 1
        accept(motion, trial)
        step_done(p, state)
        state.min_strain = min(state.min_strain, least)
        code, released = guard_turns(p, tables, state, Y)
        longest = p.fixed_step
        if e_t is not None:
            renew_viscosity(p, tables, size // 2, C, K, e_t, work.Q)
            if p.pace > 0.0:
                longest = p.pace * deforming_element(p, tables, e_t)
        next_step(p, state, code, released, error, longest)
