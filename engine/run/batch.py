"""Runs that advance together: which share a batch, the arrays of up to COUNT lanes, how a run is put into one and taken
out; a lane whose run has ended gets the next run that waits."""

import time
from collections import namedtuple

import numpy as np

from ..lanes.follow import Followers, lane_work
from ..lanes.ticks import (
    ENDED,
    GOING,
    LANE,
    MOVED,
    PARTS,
    RATE,
    RESTARTED,
    ROWS,
    STEP,
    WAITING,
    Arrays,
    Trails,
    advance,
)
from ..parameters import record_of
from ..parameters.cover import goes_in_lanes
from ..perturbations.exponents import STEPS
from ..planar import columns as col
from ..planar.state import conserved
from ..record import SAMPLE_WIDTH, STATE
from ..simd.vector import COUNT, REAL, WHOLE, fields_of, lane_zeros
from . import Run

LEAST = COUNT // 4 + 1  # runs of a kind for which a batch pays, because it costs the same however few are in it
TICKS = 20_000  # between two looks at the clock and at Ctrl-C: a tenth of a second
# of the whole numbers these decide nothing within the vectors
OWN = ("at_rest", "max_newton", "max_releases", "loop_release", "end_at")


def kind_of(scene):
    """What scenes must have in common to share a batch: all whole numbers that kernels branch on or count to. None
    for a scene that goes alone.
    """
    if not goes_in_lanes(scene):
        return None
    tables = []
    record = record_of(scene, tables)[0]
    carried = scene.output.tangent_vectors, scene.output.lateral_growth
    common = fields_of(record, (name for name in WHOLE if name not in OWN))
    return (record.dtype.names[0], *map(int, common), *(table.size for table in tables), *carried)


class Machine:
    """COUNT lanes for runs of one kind."""

    def __init__(self, run):
        n, s = int(run.record["nodes"]), max(int(run.record["stages"]), 2)
        self.runs = [None] * COUNT
        self.records, self.states = np.zeros(COUNT, run.record.dtype), np.zeros(COUNT, STATE)
        self.lanes, self.spent = np.zeros(COUNT, LANE), np.zeros(COUNT, np.int64)
        self.tables = np.zeros((COUNT, run.tables.size))
        self.samples = np.zeros((COUNT, len(run.output.samples), SAMPLE_WIDTH))
        self.counts = np.array(fields_of(run.record, WHOLE))
        self.arrays = Arrays(
            values=lane_zeros(len(REAL)), tables=lane_zeros(run.tables.size), numbers=lane_zeros(ROWS),
            a=lane_zeros(s), w=lane_zeros(3), Y=lane_zeros(n, 6), now=lane_zeros(n, 6), before=lane_zeros(n, 6),
            C=lane_zeros(n, 4), Ks=lane_zeros(s, n, 4), history=lane_zeros(3, n, 6),
            C_new=lane_zeros(n, 4), K_new=lane_zeros(n, 4),
        )  # fmt: skip
        self.work = lane_work(run.record, col.BOX_WIDTH)
        room = STEPS if run.trail.followed else 0
        self.followers = Followers(run) if run.trail.followed else None
        rows = lane_zeros(COUNT * room * (s - 1), n * PARTS)
        self.trail = Trails(np.zeros((COUNT, room, 3)), rows, lane_zeros(n, 8))
        for b in range(COUNT):
            self._fill(b, run)

    def _fill(self, b, run):
        """Parameters and state of a run into a lane."""
        lane, motion = self.arrays, run.motion
        self.records[b], self.states[b] = run.record, run.state
        self.tables[b] = lane.tables[:, b] = run.tables
        lane.values[:, b] = fields_of(run.record, REAL)
        lane.Y[..., b], lane.now[..., b], lane.before[..., b] = motion.Y, motion.Y, motion.Y_before
        lane.C[..., b] = motion.C
        lane.Ks[..., b] = 0.0
        lane.Ks[0, ..., b] = motion.K
        lane.numbers[RATE, b] = lane.numbers[STEP, b] = 1.0
        self.work.Q[:, col.TURN, b] = 0.0
        self.work.sea[-1, :, b] = 0.0

    def load(self, b, run):
        """Put a run into a lane that is free."""
        if run.state["steps"] == 0:
            conserved(run.record, run.motion.Y, run.motion.C)
        self._fill(b, run)
        self.runs[b] = run
        rows = len(run.output.samples)
        if rows > self.samples.shape[1]:
            longer = np.zeros((COUNT, rows, SAMPLE_WIDTH))
            longer[:, : self.samples.shape[1]] = self.samples
            self.samples = longer
        self.samples[b, :rows] = run.output.samples
        if self.followers is not None:
            self.followers.load(b, run)
        self.spent[b] = 0
        self.lanes[b] = 0
        self.lanes[b]["goal"] = run.goal
        self._let_go(b)

    def _let_go(self, b):
        """The lane begins its next trial."""
        self.lanes[b]["active"] = GOING
        self.arrays.numbers[MOVED, b] = self.arrays.numbers[RESTARTED, b] = 1.0

    def unload(self, b):
        """Take the run of a lane out, wherever it is."""
        run, self.runs[b] = self.runs[b], None
        run.state = self.states[b].copy()
        lane = self.arrays
        for part, values in zip(run.motion, (lane.now, lane.before, lane.C, lane.Ks[0]), strict=True):
            part[:] = values[..., b]
        rows = len(run.output.samples)
        run.output.samples[:] = self.samples[b, :rows]
        if self.followers is not None:
            self.followers.unload(b, run)
        return run

    def release(self, b):
        """Take the run of a lane out that is under way, to go on alone: the trial that it is in begins again."""
        if self.arrays.numbers[RESTARTED, b] == 0.0:
            self.states[b]["attempts"] -= 1
        return self.unload(b)

    def compile(self):
        """Compile what `advance` needs, or load it compiled, outside the time of any run."""
        self.advance(0)
        if self.followers is not None:
            self._follow([])

    def advance(self, ticks=TICKS):
        """Make ticks until a run ends; returns the lanes whose runs have ended."""
        started = time.perf_counter()
        advance(
            ticks, self.records, self.tables, self.states, self.lanes, self.spent, self.samples, self.trail,
            self.counts, self.arrays, self.work,
        )  # fmt: skip
        taken = [b for b, run in enumerate(self.runs) if run is not None]
        ended = [b for b in taken if self.lanes[b]["active"] == ENDED]
        if self.followers is not None and (ended or (self.lanes["active"] == WAITING).any()):
            self._follow(taken)
        for b in taken:
            self.runs[b].wall_s += (time.perf_counter() - started) / len(taken)
        return ended

    def _follow(self, taken):
        """Carry the perturbations of all lanes through their trails, and empty these."""
        trails = np.zeros(COUNT, np.int64)
        for b in taken:
            trails[b] = self.states[b]["trail"]
            self.runs[b].trail.mark(self.trail.T[b, : trails[b]])
        self.followers.follow(self.records, self.tables, self.trail, trails, self.counts, self.arrays)
        for b in taken:  # the step that a lane is in the middle of begins the next trail
            if trails[b] < self.trail.T.shape[1]:
                steps = self.trail.rows.reshape(*self.trail.T.shape[:2], -1)[b]
                steps[0] = steps[trails[b]]
            if self.lanes[b]["active"] == WAITING:
                self._let_go(b)
        self.states["trail"] = 0


# A run that waits: its number, Scene, length (s) and FinalState to go on from, or None
Request = namedtuple("Request", "number scene duration_s start")


def run_through(waiting, progress):
    """Run Requests, all of one kind, side by side; yields (Request, Trajectory) as they end, in no order.

    waiting: deque, to which runs of the same kind may be added meanwhile. It is left with what too few would share.
    Runs that are left in the lanes when the others have ended go on alone, with the same bits.
    progress: callable(seconds simulated of the runs that have not ended), called now and then.
    """
    machine, requests = None, {}  # lane -> Request of the run in it
    while True:
        while waiting and len(requests) < COUNT and len(requests) + len(waiting) >= LEAST:
            request = waiting.popleft()
            run = Run(request.scene, request.duration_s, request.start)
            if run.done():  # no equilibrium to start from
                yield request, run.trajectory()
                continue
            if machine is None:
                machine = Machine(run)
                machine.compile()
            b = machine.runs.index(None)
            machine.load(b, run)
            requests[b] = request
        if len(requests) < LEAST:
            for b, request in requests.items():
                run = machine.release(b)
                run.finish(progress)
                yield request, run.trajectory()
            return
        for b in machine.advance():
            run = machine.unload(b)
            yield requests.pop(b), run.trajectory()
        simulated_s = 0.0
        for b, request in requests.items():
            simulated_s += float(machine.states[b]["samples"]) / machine.runs[b].goal * request.duration_s
        progress(simulated_s)
