"""Perturbations carried through the trails of all lanes at once: one stage of every lane a turn; and their arrays, into
lanes and out of them.

The steps of a lane's trail are its own; a lane whose trail is at its end waits for the others. The arithmetic is that
of `engine.perturbations.tangent` and `engine.perturbations.lateral`, in vectors; the logarithms are taken lane by lane.
"""

from collections import namedtuple

import numpy as np

from .. import record as col
from ..arrays import Work
from ..compiled import kernel
from ..dimensions import shape
from ..perturbations.lateral import COEFFICIENTS, lateral_stage, normalise
from ..perturbations.lateral import WIDTH as LATERAL_WIDTH
from ..perturbations.tangent import Base, Water, linearise, orthonormalise, period_of, tangent_stage, water_moves
from ..physics import sea_series
from ..physics.water import water as flow
from ..planar import columns as planar_col
from ..planar.extras import node_width
from ..simd.elementary import keep
from ..simd.select import some, where
from ..simd.vector import COUNT, as_lanes, expect, lane_record, lane_zeros, transposed
from ..time.steps import known_part, plan_stage, stage_rate
from .ticks import PARTS, keep_stage, row_of_stage

# What a turn of all lanes works on, COUNT the last axis: numbers (LENGTH + k + 1,); a (s,), w (3,): as in `plan_stage`;
# Y (n, 6), K (n, 4): the stage and its rates; K_new (n, 4), known (n, 3): of a perturbation, as in `tangent_stage`
Turn = namedtuple("Turn", "numbers a w Y K K_new known")
# Perturbations of every lane, COUNT the last axis: C, K (k, n, 4), conserved variables and rates; Ks (k, s, n, 4) of
# the stages of a step; C_tilde, C_new (n, 4) of one stage
Carried = namedtuple("Carried", "C K Ks C_tilde C_new")
# The lateral perturbation of every lane, COUNT the last axis: weights, C, K (n, 2), rates Ks (s, n, 2) of the stages of
# a step; work: C_new, C_tilde, K_new (n, 2), H and E (`engine.perturbations.lateral`)
Across = namedtuple("Across", "weights C K Ks C_new C_tilde K_new H E")
TIME, RATE, STAGE, BEGUN, BUSY, ENDED, LENGTH = range(7)  # rows of numbers; lengths of all vectors from LENGTH on


@kernel
def _vector_of(rows, at, k, number):
    """One of the eight vectors that the lanes store of node k: the first part of each lane, then the second."""
    return rows[at[number % COUNT], PARTS * k + number // COUNT]


@kernel
def side_by_side(rows, at, Y, K):
    """The rows `at` (COUNT,) of the Trails (as_lanes), one of each lane, into Y (n, 6) and K (n, 4)."""
    for k in range(Y.shape[0]):
        y = Y[k]
        y[0], y[1], y[2], y[3], y[4], y[5], K[k, planar_col.VX], K[k, planar_col.VZ] = transposed(
            (
                _vector_of(rows, at, k, 0),
                _vector_of(rows, at, k, 1),
                _vector_of(rows, at, k, 2),
                _vector_of(rows, at, k, 3),
                _vector_of(rows, at, k, 4),
                _vector_of(rows, at, k, 5),
                _vector_of(rows, at, k, 6),
                _vector_of(rows, at, k, 7),
            )
        )
    for lane in range(COUNT):
        for k in range(Y.shape[0]):
            expect(rows[at[lane]], PARTS * (k + Y.shape[0]))  # of the next stage


@kernel
def plan_turn(records, tables, T, rows, trails, step, stage, at, turn):
    """The next stage of every lane that has steps left, into a Turn of numbers; returns the latest, 0 where none has.

    T, rows: of the Trails; trails (COUNT,): steps in the trail of a lane; step, stage, at (COUNT,): where it is, and
    the row there.
    """
    numbers, a, w = turn[:3]
    latest = 0
    for b in range(COUNT):
        numbers[BUSY, b] = numbers[BEGUN, b] = numbers[ENDED, b] = 0.0
        if step[b] >= trails[b]:
            continue
        numbers[BUSY, b] = 1.0
        p, row = records[b], T[b, step[b]]
        last, euler = max(p.stages, 2) - 1, row[col.KIND] > 0.0
        if stage[b] == 0:
            stage[b] = last if euler else 1
            numbers[BEGUN, b] = 1.0
        latest = max(latest, stage[b])
        at[b] = row_of_stage(T, rows, b, step[b], stage[b])
        numbers[ENDED, b] = 1.0 if stage[b] == last else 0.0
        rate, delay = plan_stage(p, tables[b], stage[b], euler, row[col.STEP], 0.0, a[:, b], w[:, b])
        numbers[RATE, b], numbers[TIME, b], numbers[STAGE, b] = rate, row[col.BEGIN] + delay, float(stage[b])
    return latest


@kernel
def end_stage(rows, C_new, K_new, C, K, Ks):
    """What a perturbation has become at a stage: into Ks (s, n, m) and, where the step ends, C and K (n, m)."""
    keep_stage(rows[BUSY], rows[STAGE], K_new, Ks)
    keep(rows[ENDED] != 0.0, C_new, C)
    keep(rows[ENDED] != 0.0, K_new, K)


@kernel
def end_turn(trail_T, step, stage, numbers, periods, vectors, sideways, nats, lateral_nats):
    """Move every lane on; the growth of a step that has ended goes to its period. periods (COUNT,): their length, s."""
    for b in range(COUNT):
        if numbers[BUSY, b] == 0.0:
            continue
        if numbers[ENDED, b] == 0.0:
            stage[b] += 1
            continue
        at = period_of(trail_T[b, step[b], col.BEGIN] + trail_T[b, step[b], col.STEP], periods[b], nats.shape[1])
        for v in range(vectors):
            nats[b, at, v] += np.log(numbers[LENGTH + v, b])
        if sideways:
            lateral_nats[b, at] += np.log(numbers[LENGTH + vectors, b])
        stage[b] = 0
        step[b] += 1


@kernel
def follow(records, tables, trail, trails, periods, nats, lateral_nats, sideways, p_lanes, turn_of, carried, room):
    """Carry the perturbations of all lanes through their trails.

    records (COUNT,): RECORD; tables (COUNT, m); trail: Trails; trails (COUNT,): steps in it; periods (COUNT,), s;
    nats (COUNT, periods, k), lateral_nats (COUNT, periods): growth, added to; sideways: 1 with a lateral perturbation;
    p_lanes: counts, values and tables of the lane record; turn_of: Turn; carried: Carried and Across; room: Work and
    Water; COUNT is the last axis of all their arrays.
    """
    counts, values, in_lanes = p_lanes
    p, grid = lane_record(records, counts, as_lanes(values)), as_lanes(in_lanes)
    turn, perturbed, across = as_lanes(turn_of), as_lanes(carried[0]), as_lanes(carried[1])
    work, water = as_lanes(room[0]), as_lanes(room[1])
    numbers, rows, Y, K_new = turn_of.numbers, turn.numbers, turn.Y, turn.K_new
    count = perturbed.C.shape[0]
    moving_water = water_moves(p)
    step, stage = np.zeros(COUNT, np.int64), np.zeros(COUNT, np.int64)
    trail_rows, at = as_lanes(trail.rows), np.zeros(COUNT, np.int64)
    while True:
        latest = plan_turn(records, tables, trail.T, trail_rows, trails, step, stage, at, turn_of)
        if latest == 0:
            break
        side_by_side(trail_rows, at, Y, turn.K)
        base = Base(rows[TIME], rows[RATE], moving_water, Y, turn.K)
        begun, ended = rows[BEGUN] != 0.0, rows[ENDED] != 0.0
        anchor = work.sea[Y.shape[0]]
        anchor[sea_series.TAKEN] = where(begun, 0.0, anchor[sea_series.TAKEN])  # as `forget` in a run alone
        if count > 0:
            linearise(p, grid, base, work, water)
        else:
            shape(p, grid, Y, work.Q, work.X)
            flow(p, grid, base.t, 1.0, work.X, work.F, work.sea)
        for v in range(count):
            keep(begun, perturbed.K[v], perturbed.Ks[v, 0])
            known_part(turn.a, latest, perturbed.C[v], perturbed.Ks[v], perturbed.C_tilde)
            tangent_stage(p, grid, base, perturbed.C_tilde, perturbed.C_new, K_new, work, water, turn.known)
            end_stage(rows, perturbed.C_new, K_new, perturbed.C[v], perturbed.K[v], perturbed.Ks[v])
        if some(ended):
            orthonormalise(p.per_speed * p.per_speed, ended, perturbed.C, perturbed.K, rows[LENGTH : LENGTH + count])
        if sideways:
            keep(begun, across.K, across.Ks[0])
            known_part(turn.a, latest, across.C, across.Ks, across.C_tilde)
            lateral_stage(p, grid, base, work, across.C_tilde, across.H, across.E, across.C_new)
            stage_rate(base.rate, across.C_new, across.C_tilde, across.K_new)
            end_stage(rows, across.C_new, across.K_new, across.C, across.K, across.Ks)
            if some(ended):
                rows[LENGTH + count] = normalise(across.weights, ended, across.C, across.K)
        end_turn(trail.T, step, stage, numbers, periods, count, sideways, nats, lateral_nats)


def lane_work(record, width):
    """Work arrays of a Newton solve in all lanes, for runs of this record; width: of E."""
    n = int(record["nodes"])
    arrays = (lane_zeros(n, columns) for columns in (2, 4, node_width(record), width, 6, 4))
    return Work(*arrays, lane_zeros(n + 1, sea_series.WIDTH))


class Followers:
    """Perturbations of up to COUNT runs that carry the same number of them."""

    def __init__(self, run):
        n, s = int(run.record["nodes"]), max(int(run.record["stages"]), 2)
        k = self.count = run.trail.count
        self.sideways = run.trail.sideways
        self.periods = np.ones(COUNT)
        self.nats, self.lateral_nats = np.zeros((COUNT, 1, k)), np.zeros((COUNT, 1))
        turn = LENGTH + k + 1, s, 3, (n, 6), (n, 4), (n, 4), (n, 3)
        self.turn = Turn(*(lane_zeros(*np.atleast_1d(size)) for size in turn))
        self.turn.numbers[RATE] = 1.0
        sizes = (k, n, 4), (k, n, 4), (k, s, n, 4), (n, 4), (n, 4)
        self.carried = Carried(*(lane_zeros(*size) for size in sizes))
        weights, C, K, C_new, C_tilde, K_new = (lane_zeros(n, 2) for _ in range(6))
        work = lane_zeros(n, COEFFICIENTS), lane_zeros(n, LATERAL_WIDTH)
        self.across = Across(weights, C, K, lane_zeros(s, n, 2), C_new, C_tilde, K_new, *work)
        water = Water(*(lane_zeros(n, width) for width in (8, 4)))
        self.room = lane_work(run.record, planar_col.WITH_INVERSE), water

    def load(self, b, run):
        """Put the perturbations of a run into a lane."""
        self.periods[b], periods = run.trail.period_s, len(run.trail.nats)
        if (missing := periods + 1 - self.nats.shape[1]) > 0:  # the last step of a run may reach into the next period
            self.nats = np.pad(self.nats, ((0, 0), (0, missing), (0, 0)))
            self.lateral_nats = np.pad(self.lateral_nats, ((0, 0), (0, missing)))
        self.nats[b] = self.lateral_nats[b] = 0.0
        self.nats[b, :periods], self.lateral_nats[b, :periods] = run.trail.nats, run.trail.lateral_nats
        for lanes in (self.carried, self.across):
            lanes.Ks[..., b] = 0.0  # a run that blew up leaves what is no number, and nothing times that is no number
        for part, stored in self._parts(run):
            part[..., b] = stored

    def _parts(self, run):
        """Pairs of arrays of the perturbations: of all lanes, and of a run."""
        for lanes, arguments in ((self.carried, run.trail.along), (self.across, run.trail.across)):
            yield from zip(lanes, arguments[:-1] if arguments else (), strict=False)

    def unload(self, b, run):
        """What has grown, and the perturbations, back to the run."""
        for part, taken in self._parts(run):
            taken[:] = part[..., b]
        periods = len(run.trail.nats)
        run.trail.nats[:], run.trail.lateral_nats[:] = self.nats[b, :periods], self.lateral_nats[b, :periods]

    def follow(self, records, tables, trail, trails, counts, arrays):
        """Through the Trails, of which `trails` steps each are to be followed; arrays: Arrays."""
        follow(
            records, tables, trail, trails, self.periods, self.nats, self.lateral_nats, int(self.sideways),
            (counts, arrays.values, arrays.tables), self.turn, (self.carried, self.across), self.room,
        )  # fmt: skip
