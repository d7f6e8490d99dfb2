"""Perturbations carried through the trails of all lanes at once: one stage of every lane a turn.

The steps of a lane's trail are its own; a lane whose trail is at its end waits for the others. The arithmetic is that
of `engine.perturbations.tangent` and `engine.perturbations.lateral`, in vectors; the logarithms are taken lane by lane.
"""

import numpy as np

from ..compiled import kernel
from ..perturbations.lateral import known_lateral, lateral_stage, normalise
from ..perturbations.tangent import carry_stage, linearise, orthonormalise, period_of, water_moves
from ..planar import node
from ..time.steps import plan_stage
from .elementary import copy_into
from .record import lane_record
from .ticks import keep
from .vector import COUNT, as_lanes

TIME, RATE, STAGE, BEGUN, BUSY, ENDED, LENGTH = range(7)  # rows of numbers; lengths of all vectors from LENGTH on


@kernel
def plan_turn(records, tables, trail, trails, step, stage, numbers, a, w, Y, K):
    """The next stage of every lane that has steps left, as numbers; returns how many have.

    trails (COUNT,): steps in the trail of a lane; step, stage (COUNT,): where it is; Y, K (n, ., COUNT): taken out.
    """
    trail_T, trail_Y, trail_K = trail
    busy = 0
    for b in range(COUNT):
        numbers[BUSY, b] = numbers[BEGUN, b] = numbers[ENDED, b] = 0.0
        if step[b] >= trails[b]:
            continue
        busy += 1
        numbers[BUSY, b] = 1.0
        p, row = records[b], trail_T[b, step[b]]
        last, euler = max(p.stages, 2) - 1, row[2] > 0.0
        if stage[b] == 0:
            stage[b] = last if euler else 1
            numbers[BEGUN, b] = 1.0
        numbers[ENDED, b] = 1.0 if stage[b] == last else 0.0
        rate, after = plan_stage(p, tables[b], stage[b], euler, row[1], 0.0, a[:, b], w[:, b])
        numbers[RATE, b], numbers[TIME, b], numbers[STAGE, b] = rate, row[0] + after, float(stage[b])
        copy_into(Y[:, :, b], trail_Y[b, step[b], stage[b]])
        copy_into(K[:, :, b], trail_K[b, step[b], stage[b]])
    return busy


@kernel
def end_turn(trail_T, step, stage, numbers, periods, vectors, sideways, nats, lateral_nats):
    """Move every lane on; the growth of a step that has ended goes to its period. periods (COUNT,): their length, s."""
    for b in range(COUNT):
        if numbers[BUSY, b] == 0.0:
            continue
        if numbers[ENDED, b] == 0.0:
            stage[b] += 1
            continue
        at = period_of(trail_T[b, step[b], 0] + trail_T[b, step[b], 1], periods[b], nats.shape[1])
        for v in range(vectors):
            nats[b, at, v] += np.log(numbers[LENGTH + v, b])
        if sideways:
            lateral_nats[b, at] += np.log(numbers[LENGTH + vectors, b])
        stage[b] = 0
        step[b] += 1


@kernel
def follow(records, tables, trail, trails, periods, nats, lateral_nats, sideways, counts, arrays, work, lateral):
    """Carry the perturbations of all lanes through their trails (arrays: `engine.simd.machine.Followers`)."""
    values, in_lanes, numbers, a_all, w_all, Y_all, K_all, vectors, rates, waters, dKs, dCs = arrays
    p = lane_record(counts, as_lanes(values))
    grid, rows, a, Y, K = as_lanes(in_lanes), as_lanes(numbers), as_lanes(a_all), as_lanes(Y_all), as_lanes(K_all)
    vectors, rates, waters, dKs, dCs = (
        as_lanes(vectors),
        as_lanes(rates),
        as_lanes(waters),
        as_lanes(dKs),
        as_lanes(dCs),
    )
    X, F, Q, E, D = as_lanes(work[0]), as_lanes(work[1]), as_lanes(work[2]), as_lanes(work[3]), as_lanes(work[4])
    C_tilde, dC_tilde, dK_new = as_lanes(work[5]), as_lanes(work[6]), as_lanes(work[7])
    J, gamma = as_lanes(work[8]), as_lanes(work[9])
    room = D, as_lanes(work[10]), as_lanes(work[11]), as_lanes(work[12])
    weights, across, across_rates, dK, dC = (
        as_lanes(lateral[0]), as_lanes(lateral[1]), as_lanes(lateral[2]), as_lanes(lateral[3]), as_lanes(lateral[4]),
    )  # fmt: skip
    known, fresh, H, E_across = as_lanes(lateral[5]), as_lanes(lateral[6]), as_lanes(lateral[7]), as_lanes(lateral[8])
    count, s = vectors.shape[0], a.shape[0]
    moving_water = water_moves(p)
    step, stage = np.zeros(COUNT, np.int64), np.zeros(COUNT, np.int64)
    while plan_turn(records, tables, trail, trails, step, stage, numbers, a_all, w_all, Y_all, K_all) > 0:
        t, rate = rows[TIME], rows[RATE]
        begun, ended, busy = rows[BEGUN] != 0.0, rows[ENDED] != 0.0, rows[BUSY] != 0.0
        if count > 0:
            linearise(p, grid, t, rate, moving_water, Y, K, X, F, C_tilde, Q, E, J, room)
        else:
            node.shape(p, grid, Y, Q, X)
            node.water(p, grid, t, 1.0, X, F)
        for v in range(count):
            keep(begun, rates[v], dKs[v, 0])
            carry_stage(
                p, grid, t, rate, a, s - 1, busy, moving_water, X, Y, K, v, vectors, dKs, waters, dC_tilde, dCs,
                Q, J, F, E, D, gamma,
            )  # fmt: skip
            for k in range(Y.shape[0]):
                for m in range(4):
                    dK_new[k, m] = rate * (dCs[v, k, m] - dC_tilde[k, m])
            for j in range(1, s):
                keep(busy & (rows[STAGE] == float(j)), dK_new, dKs[v, j])
            keep(ended, dCs[v], vectors[v])
            keep(ended, dK_new, rates[v])
        orthonormalise(p.per_speed * p.per_speed, ended, vectors, rates, rows[LENGTH : LENGTH + count])
        if sideways:
            keep(begun, across_rates, dK[0])
            known_lateral(a, s - 1, across, dK, known)
            lateral_stage(p, grid, t, rate, X, Y, K, Q, F, known, H, E_across, dC)
            for k in range(Y.shape[0]):
                for m in range(2):
                    fresh[k, m] = rate * (dC[k, m] - known[k, m])
            for j in range(1, s):
                keep(busy & (rows[STAGE] == float(j)), fresh, dK[j])
            keep(ended, dC, across)
            keep(ended, fresh, across_rates)
            rows[LENGTH + count] = normalise(weights, ended, across, across_rates)
        end_turn(trail[0], step, stage, numbers, periods, count, sideways, nats, lateral_nats)
