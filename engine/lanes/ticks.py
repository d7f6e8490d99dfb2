"""The lane machine: several planar runs, each with a step, a stage and an end of its own, one Newton iteration a tick.

Every lane is always within the Newton solve of some stage. A tick is one iteration in all lanes at once. Lanes whose
solve has ended are then moved on by the functions that move a single run on. Arithmetic on nodes is done in vectors
under a mask, decisions are taken one lane after another. Both have one source (`engine.simd.select`), and so a lane is
bit for bit the run alone. No law of physics is here: to add or change one, leave this folder closed.

Rows of `numbers` (ROWS, COUNT) carry what passes between vectors and decisions: time (s), rate (1/s), step (s) of the
stage; is the last update sound, its size, the least strain; number of the stage; error and largest turn of the step;
and 1.0 or 0.0: stage SOLVED, step FINISHED by it, ACCEPTED, lane MOVED on to a solve that begins a trial (RESTARTED).
"""

import math
from collections import namedtuple

import numpy as np

from .. import record as col
from ..arrays import Stage
from ..compiled import kernel
from ..dimensions import shape
from ..physics.bed import with_landings
from ..physics.sea_series import forget
from ..physics.tension.kernels import tension
from ..planar.columns import EPS, VX, VZ
from ..planar.state import largest_turn
from ..simd.elementary import copy_into, keep
from ..simd.select import larger, smaller, some, where
from ..simd.vector import COUNT, as_lanes, expect, lane_record, transposed
from ..time import steps
from ..time.folds import watch_turn
from ..time.newton import GOING_ON, iterate, judge
from ..time.ringing import jumps_of_rates, watch_ringing
from ..time.status import OK
from ..time.time_loop import begin_trial, guard_turns, hold_turn, next_step, refused, sample, step_done

ENDED, GOING, WAITING = range(3)  # lane.active: with no run or one at its end; going; its trail is full
LANE = np.dtype([(name, np.int64) for name in "active stage iteration code goal".split()] + [("best", np.float64)])
(
    TIME, RATE, STEP, SOUND, SIZE, LEAST, TOP, TOP_LOW, TOP_HIGH, STAGE, SOLVED, FINISHED, ERROR, STRAIN_JUMP,
    SPEED_JUMP, TURN, ACCEPTED, MOVED, RESTARTED,
) = range(19)  # fmt: skip
ROWS = 19
# Arrays of all lanes, whose last axis is COUNT; s stages, n nodes. values: fields of the records; tables; numbers
# (ROWS,); a (s,), w (3,): as in `plan_stage`; Y, now, before (n, 6): iterate, accepted state, the one before; C (n, 4),
# Ks (s, n, 4): conserved variables, rates of the state and the stages; history (3, n, 6): states for the first guess;
# C_new, K_new (n, 4): of the stage that was solved
Arrays = namedtuple("Arrays", "values tables numbers a w Y now before C Ks history C_new K_new")
# Accepted steps of all lanes. T (COUNT, l, 3): as in `engine.arrays.Trail`; rows (COUNT l (s - 1), n PARTS, COUNT): Y
# and rates of velocity of each node at a stage (`row_of_stage`), eight numbers: perturbations ask neither for rates of
# q nor for stage 0, the last one of the step before; block (n, 8, COUNT): work
Trails = namedtuple("Trails", "T rows block")
PARTS = 8 // COUNT  # vectors that hold the eight numbers of a node


@kernel
def keep_stage(chosen, stage, K_new, Ks):
    """The rates K_new (n, m) of a stage into Ks (s, n, m), in the lanes where `chosen` is not 0; stage: its number."""
    for j in range(1, Ks.shape[0]):
        keep((chosen != 0.0) & (stage == float(j)), K_new, Ks[j])


@kernel
def clear(numbers, b):
    """Nothing has happened in lane b."""
    numbers[SOLVED, b] = numbers[FINISHED, b] = numbers[ACCEPTED, b] = 0.0
    numbers[MOVED, b] = numbers[RESTARTED, b] = 0.0


@kernel
def judge_solves(records, states, lanes, numbers):
    """Find the lanes whose Newton solve has ended; returns how many."""
    ended = 0
    for b in range(COUNT):
        lane, state = lanes[b], states[b]
        clear(numbers, b)
        if lane.active != GOING:
            continue
        p = records[b]
        max_iterations = steps.SMALL_STEP_NEWTON if state.small else p.max_newton
        size = numbers[SIZE, b]
        lane.code = judge(
            p,
            lane.iteration,
            max_iterations,
            p.newton_tolerance,
            numbers[SOUND, b] != 0.0,
            size,
            numbers[LEAST, b],
            lane.best,
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
            seen = numbers[LEAST, b], numbers[TOP, b], (numbers[STRAIN_JUMP, b], numbers[SPEED_JUMP, b])
            error = steps.trial_error(p, tables[b], state.trial_dt, numbers[ERROR, b], *seen)
        numbers[ERROR, b] = error
        numbers[RESTARTED, b] = 1.0
        if not refused(p, state, lane.code, spent[b], error):
            numbers[ACCEPTED, b] = 1.0
        spent[b] = 0


@kernel
def sample_lanes(records, tables, states, lanes, arrays, ends, samples, profiles):
    """Store the samples that lie within the accepted steps. ends (4, n, 4): work; profiles (0, n, 6): none are kept."""
    for b in range(COUNT):
        if arrays.numbers[ACCEPTED, b] != 0.0:
            of_lanes = arrays.C, arrays.Ks[0], arrays.C_new, arrays.K_new
            for i in range(4):
                copy_into(ends[i], of_lanes[i][:, :, b])
            state = states[b]
            begin, end = (ends[0], ends[1]), (ends[2], ends[3])
            hermite = state.small == 0
            sample(records[b], tables[b], state, state.trial_dt, hermite, begin, end, None, samples[b], profiles)


@kernel
def row_of_stage(T, rows, b, step, stage):
    """Where the rows of Trails have a stage of a step of lane b."""
    return (b * T.shape[1] + step) * (rows.shape[0] // (COUNT * T.shape[1])) + stage - 1


@kernel
def record_stages(states, lanes, numbers, Y, K, T, rows, block):
    """Solved stages Y (n, 6) and rates K (n, 4) into the Trails of their lanes; kept or not, as the step will be.

    T, rows, block: the Trails, as_lanes but for T.
    """
    for k in range(Y.shape[0]):
        y, lane = Y[k], block[k]
        lane[0], lane[1], lane[2], lane[3], lane[4], lane[5], lane[6], lane[7] = transposed(
            (y[0], y[1], y[2], y[3], y[4], y[5], K[k, VX], K[k, VZ])
        )
    for b in range(COUNT):
        if numbers[SOLVED, b] != 0.0:
            into = rows[row_of_stage(T, rows, b, states[b].trail, lanes[b].stage)]
            for k in range(Y.shape[0]):
                for part in range(PARTS):
                    into[PARTS * k + part] = block[k, COUNT * part + b]
                expect(into, PARTS * (k + Y.shape[0]))  # of the next stage


@kernel
def record_steps(states, numbers, trail_T):
    """Accepted steps into the trails of their lanes."""
    for b in range(COUNT):
        if numbers[ACCEPTED, b] != 0.0:
            state = states[b]
            row = trail_T[b, state.trail]
            row[col.BEGIN], row[col.STEP] = state.t, state.trial_dt
            row[col.KIND] = col.RESTART if state.small else col.CONTROLLED
            state.trail += 1


@kernel
def end_steps(records, tables, states, numbers, Y, scratch):
    """Accepted steps: time, what was not resolved, guards, and the length of the next step.

    Y (n, 6, COUNT): the new states, as numbers; scratch (n, 6): work."""
    for b in range(COUNT):
        if numbers[ACCEPTED, b] == 0.0:
            continue
        p, state = records[b], states[b]
        if state.small == 0:
            jumps = numbers[STRAIN_JUMP, b], numbers[SPEED_JUMP, b]
            low = tension(numbers[TOP_LOW, b], p, tables[b])[0]
            high = tension(numbers[TOP_HIGH, b], p, tables[b])[0]
            watch_ringing(p, tables[b], state, numbers[TOP, b], low, high, jumps)
        step_done(p, state)
        state.min_strain = min(state.min_strain, numbers[LEAST, b])
        watch_turn(state, numbers[TURN, b])
        code, released = OK, False
        if numbers[TURN, b] > math.pi:
            copy_into(scratch, Y[:, :, b])
            code, released = guard_turns(p, tables[b], state, scratch)
            copy_into(Y[:, :, b], scratch)
        next_step(p, state, code, released, numbers[ERROR, b], p.fixed_step)


@kernel
def plan_lanes(records, tables, states, lanes, numbers, room, a, w, work):
    """Choose the next solve of every lane that has moved; returns whether to stop. work: Work of all lanes.

    A lane whose trail of `room` steps is full waits to be followed. That is done for all lanes at once, each step at
    the cost of one: so it is not due before two of three wait, because some make twice the steps of others.
    """
    stop = False
    for b in range(COUNT):
        if numbers[MOVED, b] == 0.0:
            continue
        p, state, lane = records[b], states[b], lanes[b]
        if numbers[RESTARTED, b] != 0.0:
            if state.status == OK and state.samples < lane.goal:
                if 0 < room == state.trail:
                    lane.active = WAITING
                    numbers[MOVED, b] = 0.0
                    continue
                begin_trial(p, tables[b], state)
                hold_turn(state, work.Q[:, :, b])
                forget(work.sea[:, :, b])
            if state.status != OK or state.samples >= lane.goal:
                lane.active = ENDED
                numbers[MOVED, b] = 0.0
                stop = True
                continue
            lane.stage = max(p.stages, 2) - 1 if state.small else 1
        else:
            lane.stage += 1
        lane.iteration, lane.best = 0, np.inf
        rate, delay = steps.plan_stage(
            p, tables[b], lane.stage, state.small != 0, state.trial_dt, state.dt_before, a[:, b], w[:, b]
        )
        numbers[RATE, b], numbers[TIME, b], numbers[STEP, b] = rate, state.t + delay, state.trial_dt
    going = waiting = 0
    for b in range(COUNT):
        going += lanes[b].active == GOING
        waiting += lanes[b].active == WAITING
    return stop or 0 < waiting >= 2 * going


@kernel
def move_states(rows, w, history, now, previous, Y):
    """States, after the decisions: what is kept of the past, and the first guess of the next solve into Y.

    history (3, n, 6): the last three of: the state before, the state, the stages so far.
    """
    solved, accepted = rows[SOLVED] != 0.0, rows[ACCEPTED] != 0.0
    restarted, moved = rows[RESTARTED] != 0.0, rows[MOVED] != 0.0
    weights = w[0], w[1], w[2]
    for k in range(Y.shape[0]):
        for i in range(6):
            y, state, last = Y[k, i], now[k, i], history[2, k, i]
            oldest, middle, latest = history[0, k, i], where(solved, last, history[1, k, i]), where(solved, y, last)
            oldest = where(solved, history[1, k, i], oldest)
            past = where(accepted, state, previous[k, i])
            state = where(accepted, y, state)
            oldest, latest = where(restarted, state, oldest), where(restarted, state, latest)
            middle = where(restarted, past, middle)
            now[k, i], previous[k, i] = state, past
            history[0, k, i], history[1, k, i], history[2, k, i] = oldest, middle, latest
            Y[k, i] = where(moved, steps.guess(weights, oldest, middle, latest), y)


@kernel
def advance(ticks, records, own_tables, states, lanes, spent, samples, trail, counts, arrays, work):
    """Make ticks until a run ends, trails are to be followed, or `ticks` are made; returns how many were.

    One turn of the loop has four parts. Every lane whose solve has ended plans its next one and takes a first guess.
    Newton's method iterates in all lanes until a solve ends. The lanes that ended get the rates of their stage and,
    where a step is finished, its error. Such a step is accepted, sampled and followed by the next, or tried again.

    records, states, lanes (COUNT,): RECORD, STATE, LANE; own_tables (COUNT, m): tables, as numbers; spent (COUNT,):
    iterations of the trial; samples (COUNT, m, 13); trail: Trails, of which l = 0 keeps nothing; counts: whole numbers
    of the lane record; arrays: Arrays; work: Work with COUNT as its last axis.
    """
    numbers = arrays.numbers
    lane = as_lanes(arrays)
    w, a, C_new, K_new = lane.w, lane.a, lane.C_new, lane.K_new
    Y, C, Ks, rows, tables = lane.Y, lane.C, lane.Ks, lane.numbers, lane.tables
    vectors, trail_rows, block = as_lanes(work), as_lanes(trail.rows), as_lanes(trail.block)
    p = lane_record(records, counts, lane.values)
    scratch, ends = np.empty(arrays.Y.shape[:2]), np.empty((4, *arrays.C.shape[:2]))
    profiles = np.empty((0, *scratch.shape))
    ticks_made, stop = 0, False
    while True:
        # every lane that has moved begins its next solve; C_new, which is free by then, takes in its C~
        stop = plan_lanes(records, own_tables, states, lanes, numbers, trail.T.shape[1], arrays.a, arrays.w, work)
        move_states(rows, w, lane.history, lane.now, lane.before, Y)
        keep(rows[ACCEPTED] != 0.0, C_new, C)
        keep(rows[ACCEPTED] != 0.0, K_new, Ks[0])
        steps.known_part(a, Ks.shape[0] - 1, C, Ks, C_new)
        keep(rows[MOVED] != 0.0, C_new, vectors.C_tilde)
        # Newton iterations in all lanes, until a solve has ended
        moving = False
        while not moving and not stop and ticks_made < ticks:
            ticks_made += 1
            sound, size, least = iterate(p, tables, Stage(rows[TIME], 1.0, rows[RATE], rows[RATE]), Y, vectors)
            rows[SOUND], rows[SIZE], rows[LEAST] = where(sound, 1.0, 0.0), size, least
            moving = judge_solves(records, states, lanes, numbers) > 0
        if not moving:
            break
        # rates of the solved stages, and of finished steps their errors
        shape(p, tables, Y, vectors.Q, vectors.X)
        steps.stage_rates(p, rows[RATE], Y, vectors.Q, vectors.C_tilde, C_new, K_new)
        keep_stage(rows[SOLVED], rows[STAGE], K_new, Ks)
        top, first = Y[Y.shape[0] - 1, EPS], rows[STAGE] == 1.0
        low, high = where(first, top, smaller(rows[TOP_LOW], top)), where(first, top, larger(rows[TOP_HIGH], top))
        rows[TOP_LOW] = where(rows[SOLVED] != 0.0, low, rows[TOP_LOW])
        rows[TOP_HIGH] = where(rows[SOLVED] != 0.0, high, rows[TOP_HIGH])
        if some(rows[FINISHED] != 0.0):
            error = steps.embedded_error(p, tables, rows[STEP], Ks, vectors.Q, a, vectors.D[0])
            rows[ERROR] = with_landings(p, tables, rows[STEP], Y, Ks, vectors.X, error)
            step_ends = (C, Ks[0]), (C_new, K_new)
            rows[STRAIN_JUMP], rows[SPEED_JUMP] = jumps_of_rates(p, rows[STEP], *step_ends)
            rows[LEAST], rows[TOP], rows[TURN] = steps.least_strain(Y), top, largest_turn(p, Y)[0]
        if trail.T.shape[1] > 0:
            record_stages(states, lanes, numbers, Y, K_new, trail.T, trail_rows, block)
        # accepted, or to be tried again
        judge_steps(records, own_tables, states, lanes, numbers, spent)
        if some(rows[ACCEPTED] != 0.0):
            sample_lanes(records, own_tables, states, lanes, arrays, ends, samples, profiles)
            if trail.T.shape[1] > 0:
                record_steps(states, numbers, trail.T)
            end_steps(records, own_tables, states, numbers, arrays.Y, scratch)
    for b in range(COUNT):
        clear(numbers, b)
    return ticks_made
