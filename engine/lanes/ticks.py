"""The lane machine: several planar runs, each with a step, a stage and an end of its own, one Newton iteration a tick.

Every lane is always within the Newton solve of some stage. A tick is one iteration in all lanes at once; lanes whose
solve has ended are then moved on, to their next stage, step or trial, by the functions that move a single run on:
what is arithmetic on nodes in vectors under a mask, what is a decision one lane after another. Where both forms exist,
they are the same source (`engine.choose`), so a lane is bit for bit the run alone.

Rows of `numbers` (.., COUNT) carry what passes between vectors and decisions.
"""

import math

import numpy as np

from ..choose import smaller, some, where
from ..compiled import kernel
from ..elementary import copy_into
from ..guards import OK
from ..march import begin_trial, guard_turns, next_step, refused, step_done
from ..newton import GOING_ON, iterate, judge
from ..planar import node
from ..planar.state import configuration, greatest_turn, last_strain
from ..sampling import complete_sample, note_top, weights_within
from ..steps import (
    SMALL_STEP_NEWTON,
    embedded_error,
    first_guess,
    known_part,
    least_strain,
    plan_stage,
    stage_rates,
    trial_error,
)
from ..tension import tension
from .record import lane_record
from .vector import COUNT, as_lanes

LANE = np.dtype([(name, np.int64) for name in "active stage iteration code goal".split()] + [("best", np.float64)])
(
    TIME, RATE, STEP, SOUND, SIZE, LEAST, STAGE, SOLVED, FINISHED, ERROR, TURN, ACCEPTED, MOVED, RESTARTED, DUE,
    W0, W1, G0, G1, OUT_X, OUT_Z, OUT_U, OUT_W, OUT_TOP, OUT_LEAST,
) = range(25)  # fmt: skip
ROWS = 25


@kernel
def keep(mask, source, target):
    """target = source in the lanes of the mask, for arrays (n, m)."""
    for k in range(target.shape[0]):
        for i in range(target.shape[1]):
            target[k, i] = where(mask, source[k, i], target[k, i])


@kernel
def judge_solves(records, states, lanes, numbers):
    """Find the lanes whose Newton solve has ended; returns how many."""
    ended = 0
    for b in range(COUNT):
        lane, state = lanes[b], states[b]
        numbers[SOLVED, b] = numbers[FINISHED, b] = numbers[ACCEPTED, b] = 0.0
        numbers[MOVED, b] = numbers[RESTARTED, b] = 0.0
        if lane.active == 0:
            continue
        p = records[b]
        most = SMALL_STEP_NEWTON if state.small else p.max_newton
        size = numbers[SIZE, b]
        lane.code = judge(
            p, lane.iteration, most, p.newton_tolerance, numbers[SOUND, b] != 0.0, size, numbers[LEAST, b], lane.best
        )
        lane.iteration += 1
        lane.best = min(lane.best, size)
        if lane.code != GOING_ON:
            ended += 1
            numbers[MOVED, b] = 1.0
            numbers[STAGE, b] = float(lane.stage)
            if lane.code == OK:
                numbers[SOLVED, b] = 1.0
                numbers[FINISHED, b] = 1.0 if lane.stage == max(p.stages, 2) - 1 else 0.0
    return ended


@kernel
def judge_steps(records, tables, states, lanes, numbers, spent):
    """What the ended solves mean for the steps of their lanes: go on, accept, or try again."""
    for b in range(COUNT):
        if numbers[MOVED, b] == 0.0:
            continue
        p, state, lane = records[b], states[b], lanes[b]
        spent[b] += lane.iteration
        if numbers[SOLVED, b] != 0.0 and numbers[FINISHED, b] == 0.0:
            continue
        error = 0.0
        if lane.code == OK and state.small == 0 and p.adaptive:
            error = trial_error(p, tables[b], state.trial_dt, numbers[ERROR, b], numbers[LEAST, b])
        numbers[ERROR, b] = error
        numbers[RESTARTED, b] = 1.0
        if not refused(p, state, lane.code, spent[b], error):
            numbers[ACCEPTED, b] = 1.0
        spent[b] = 0


@kernel
def sample_lanes(p, tables, records, states, lanes, numbers, C, K, C_new, K_new, row, samples):
    """Store the samples that lie within the accepted steps (`engine.sampling.sample`)."""
    n = C.shape[0]
    rows = as_lanes(numbers)
    while True:
        due = 0
        for b in range(COUNT):
            numbers[DUE, b] = 0.0
            state = states[b]
            t = state.samples * records[b].output_step
            if numbers[ACCEPTED, b] != 0.0 and state.samples < lanes[b].goal and t <= state.t + state.trial_dt:
                share = (t - state.t) / state.trial_dt
                w = weights_within(state.small == 0, share, state.trial_dt)
                numbers[W0, b], numbers[W1, b], numbers[G0, b], numbers[G1, b] = w
                numbers[DUE, b] = 1.0
                due += 1
        if due == 0:
            break
        U, _, W, _ = configuration(p, tables, (rows[W0], rows[W1], rows[G0], rows[G1]), C, K, C_new, K_new, row)
        least = row[0, 4]
        for k in range(1, n):
            least = smaller(least, row[k, 4])
        rows[OUT_X], rows[OUT_Z], rows[OUT_U], rows[OUT_W] = row[n - 1, 0], row[n - 1, 2], U, W
        rows[OUT_TOP], rows[OUT_LEAST] = row[n - 1, 4], least
        for b in range(COUNT):
            if numbers[DUE, b] != 0.0:
                state = states[b]
                out = samples[b, state.samples]
                out[1], out[3], out[4], out[6] = (
                    numbers[OUT_X, b], numbers[OUT_Z, b], numbers[OUT_U, b], numbers[OUT_W, b],
                )  # fmt: skip
                t = state.samples * records[b].output_step
                complete_sample(state, out, t, numbers[OUT_TOP, b], numbers[OUT_LEAST, b])
    rows[OUT_TOP] = tension(last_strain(p, C_new), p, tables)[0]
    for b in range(COUNT):
        if numbers[ACCEPTED, b] != 0.0:
            note_top(states[b], numbers[OUT_TOP, b])


@kernel
def end_steps(records, tables, states, numbers, Y_now, one):
    """After the accepted states have been taken over: time, guards, and the length of the next step.

    Y_now (n, 6, COUNT): the states, as numbers; one (n, 6): work.
    """
    for b in range(COUNT):
        if numbers[ACCEPTED, b] == 0.0:
            continue
        p, state = records[b], states[b]
        step_done(p, state)
        state.min_strain = min(state.min_strain, numbers[LEAST, b])
        state.max_turn = max(state.max_turn, numbers[TURN, b])
        code, released = OK, False
        if numbers[TURN, b] > math.pi:
            copy_into(one, Y_now[:, :, b])
            code, released = guard_turns(p, tables[b], state, one)
            copy_into(Y_now[:, :, b], one)
        next_step(p, state, code, released, numbers[ERROR, b])


@kernel
def plan_lanes(records, tables, states, lanes, numbers, a, w):
    """Choose the next solve of every lane that has moved; returns how many runs have ended instead."""
    ended = 0
    for b in range(COUNT):
        if numbers[MOVED, b] == 0.0:
            continue
        p, state, lane = records[b], states[b], lanes[b]
        if numbers[RESTARTED, b] != 0.0:
            if state.status == OK and state.samples < lane.goal:
                begin_trial(p, tables[b], state)
            if state.status != OK or state.samples >= lane.goal:
                lane.active = 0
                numbers[MOVED, b] = 0.0
                ended += 1
                continue
            lane.stage = max(p.stages, 2) - 1 if state.small else 1
        else:
            lane.stage += 1
        lane.iteration, lane.best = 0, np.inf
        rate, after = plan_stage(
            p, tables[b], lane.stage, state.small != 0, state.trial_dt, state.dt_before, a[:, b], w[:, b]
        )
        numbers[RATE, b], numbers[TIME, b], numbers[STEP, b] = rate, state.t + after, state.trial_dt
    return ended


@kernel
def set_out(
    records, own_tables, states, lanes, numbers, a, w, history, now, before, C, Ks, C_tilde, Y, C_work, Y_work
):
    """First guess and known part of the next solve, in the lanes that have moved; returns how many runs have ended.

    history (3, n, 6): the last three of state before, state, stages so far. C_work, Y_work: work.
    """
    rows = as_lanes(numbers)
    restarted = rows[RESTARTED] != 0.0
    if some(restarted):
        keep(restarted, now, history[0])
        keep(restarted, before, history[1])
        keep(restarted, now, history[2])
    ended = plan_lanes(records, own_tables, states, lanes, numbers, a, w)
    moved = rows[MOVED] != 0.0
    known_part(as_lanes(a), C, Ks, C_work)
    keep(moved, C_work, C_tilde)
    first_guess(as_lanes(w), history[0], history[1], history[2], Y_work)
    keep(moved, Y_work, Y)
    return ended


@kernel
def advance(ticks, records, own_tables, states, lanes, spent, samples, counts, arrays, work):
    """Make ticks until one run ends, or `ticks` are made; returns how many were.

    records, states, lanes (COUNT,): RECORD, STATE, LANE; own_tables (COUNT, m): tables, as numbers; spent (COUNT,):
    iterations of the trial; samples (COUNT, m, 12). counts: whole numbers of the lane record; arrays, work: see
    `engine.lanes.machine`.
    """
    values, in_lanes, numbers, a, w, Y, Y_now, Y_before, C, Ks, history, C_tilde = arrays
    p = lane_record(counts, as_lanes(values))
    tables, rows = as_lanes(in_lanes), as_lanes(numbers)
    y, now, before = as_lanes(Y), as_lanes(Y_now), as_lanes(Y_before)
    c, k_all, old, c_tilde = as_lanes(C), as_lanes(Ks), as_lanes(history), as_lanes(C_tilde)
    X, F, Q, E, D = as_lanes(work[0]), as_lanes(work[1]), as_lanes(work[2]), as_lanes(work[3]), as_lanes(work[4])
    c_new, k_new, row = as_lanes(work[5]), as_lanes(work[6]), as_lanes(work[7])
    one = np.empty((Y.shape[0], Y.shape[1]))
    s = k_all.shape[0]
    made, ended = 0, set_out(records, own_tables, states, lanes, numbers, a, w, old, now, before, c, k_all, c_tilde, y, c_new, row)
    while made < ticks and ended == 0:
        made += 1
        sound, size, least = iterate(p, tables, rows[TIME], 1.0, rows[RATE], rows[RATE], y, c_tilde, X, F, Q, E, D)
        rows[SOUND], rows[SIZE], rows[LEAST] = where(sound, 1.0, 0.0), size, least
        if judge_solves(records, states, lanes, numbers) == 0:
            continue
        solved = rows[SOLVED] != 0.0
        node.shape(p, tables, y, Q, X)
        stage_rates(p, rows[RATE], y, Q, c_tilde, c_new, k_new)
        for j in range(1, s):
            here = solved & (rows[STAGE] == float(j))
            if some(here):
                keep(here, k_new, k_all[j])
        keep(solved, old[1], old[0])
        keep(solved, old[2], old[1])
        keep(solved, y, old[2])
        if some(rows[FINISHED] != 0.0):
            rows[ERROR] = embedded_error(p, tables, rows[STEP], k_all, Q, row)
            rows[LEAST], rows[TURN] = least_strain(y), greatest_turn(y)
        judge_steps(records, own_tables, states, lanes, numbers, spent)
        accepted = rows[ACCEPTED] != 0.0
        if some(accepted):
            sample_lanes(p, tables, records, states, lanes, numbers, c, k_all[0], c_new, k_new, row, samples)
            keep(accepted, now, before)
            keep(accepted, y, now)
            keep(accepted, c_new, c)
            keep(accepted, k_new, k_all[0])
            end_steps(records, own_tables, states, numbers, Y_now, one)
        ended = set_out(records, own_tables, states, lanes, numbers, a, w, old, now, before, c, k_all, c_tilde, y, c_new, row)
    return made
