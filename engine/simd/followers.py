"""The perturbations of the runs in the lanes: their arrays, into lanes and out of them (`engine.simd.follow`)."""

import numpy as np

from ..arrays import Work
from ..perturbations.lateral import COEFFICIENTS
from ..perturbations.lateral import WIDTH as LATERAL_WIDTH
from ..perturbations.tangent import Carried, Water
from ..planar import columns as col
from .follow import LENGTH, RATE, Across, Turn, follow
from .vector import COUNT, lane_zeros


def lane_work(n, width):
    """Work arrays of a Newton solve in all lanes; width: of E."""
    return Work(*(lane_zeros(n, each) for each in (2, 4, col.NODE_WIDTH, width, 6, 4)))


class Followers:
    """Perturbations of up to COUNT runs that carry the same number of them."""

    def __init__(self, run, periods):
        n, s = int(run.record["nodes"]), max(int(run.record["stages"]), 2)
        k = self.count = run.trail.count
        self.sideways = run.trail.sideways
        self.periods = np.ones(COUNT)
        self.nats, self.lateral_nats = np.zeros((COUNT, periods + 1, k)), np.zeros((COUNT, periods + 1))
        turn = LENGTH + k + 1, s, 3, (n, 6), (n, 4), (n, 4)
        self.turn = Turn(*(lane_zeros(*np.atleast_1d(shape)) for shape in turn))
        self.turn.numbers[RATE] = 1.0
        C, K, F, Cs = (lane_zeros(k, n, 4) for _ in range(4))
        self.carried = Carried(C, K, F, lane_zeros(k, s, n, 4), lane_zeros(n, 4), Cs)
        weights, C, K, C_new, C_tilde, K_new = (lane_zeros(n, 2) for _ in range(6))
        work = lane_zeros(n, COEFFICIENTS), lane_zeros(n, LATERAL_WIDTH)
        self.across = Across(weights, C, K, lane_zeros(s, n, 2), C_new, C_tilde, K_new, *work)
        water = Water(*(lane_zeros(n, width) for width in (8, 2, 2, 4, 4)))
        self.room = lane_work(n, col.WITH_INVERSE), water

    def load(self, b, run):
        """Put the perturbations of a run, and the state it starts from, into a lane."""
        trail = run.trail
        self.periods[b] = trail.period_s
        self.nats[b] = self.lateral_nats[b] = 0.0
        self.turn.Y[..., b], self.turn.K[..., b] = run.motion.Y, run.motion.K
        if self.count:
            for part, given in zip(self.carried[:3], (trail.vectors, trail.rates, trail.waters), strict=True):
                part[..., b] = given
        if self.sideways:
            for part, given in zip(self.across[:3], (trail.weights, trail.lateral, trail.lateral_rates), strict=True):
                part[..., b] = given

    def unload(self, b, run):
        """What has grown, back to the run."""
        periods = len(run.trail.nats)
        run.trail.nats[:], run.trail.lateral_nats[:] = self.nats[b, :periods], self.lateral_nats[b, :periods]

    def follow(self, records, tables, trail, trails, counts, arrays):
        """Through the trails (COUNT, l, ...), of which `trails` steps each are to be followed; arrays: Arrays."""
        follow(
            records, tables, trail, trails, self.periods, self.nats, self.lateral_nats, int(self.sideways),
            (counts, arrays.values, arrays.tables), self.turn, (self.carried, self.across), self.room,
        )  # fmt: skip
