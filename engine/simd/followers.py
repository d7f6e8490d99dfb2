"""The perturbations of the runs in the lanes: their arrays, into lanes and out of them (`engine.simd.follow`)."""

import numpy as np

from ..perturbations.lateral import COEFFICIENTS
from ..perturbations.lateral import WIDTH as LATERAL_WIDTH
from ..planar import elimination as sweep
from ..planar import node
from .follow import LENGTH, RATE, follow
from .vector import COUNT, lane_zeros


class Followers:
    """Perturbations of up to COUNT runs that carry the same number of them."""

    def __init__(self, run, periods):
        n, s = int(run.record["nodes"]), max(int(run.record["stages"]), 2)
        k = self.count = run.trail.count
        self.sideways = run.trail.sideways
        self.periods = np.ones(COUNT)
        self.nats, self.lateral_nats = np.zeros((COUNT, periods + 1, k)), np.zeros((COUNT, periods + 1))
        self.vectors, self.rates, self.waters = (lane_zeros(k, n, 4) for _ in range(3))
        self.numbers, self.Y, self.K = lane_zeros(LENGTH + k + 1), lane_zeros(n, 6), lane_zeros(n, 4)
        self.numbers[RATE] = 1.0
        self.own = (
            self.numbers, lane_zeros(s), lane_zeros(3), self.Y, self.K, self.vectors, self.rates, self.waters,
            lane_zeros(k, s, n, 4), lane_zeros(k, n, 4),
        )  # fmt: skip
        widths = 2, 4, node.WIDTH, sweep.WITH_INVERSE, 6, 4, 4, 4, 8, 2, 2, 4, 4
        self.work = tuple(lane_zeros(n, width) for width in widths)
        self.weights, self.across, self.across_rates = lane_zeros(n, 2), lane_zeros(n, 2), lane_zeros(n, 2)
        self.lateral = (
            self.weights, self.across, self.across_rates, lane_zeros(s, n, 2), lane_zeros(n, 2), lane_zeros(n, 2),
            lane_zeros(n, 2), lane_zeros(n, COEFFICIENTS), lane_zeros(n, LATERAL_WIDTH),
        )  # fmt: skip

    def load(self, b, run):
        """Put the perturbations of a run, and the state it starts from, into a lane."""
        trail = run.trail
        self.periods[b] = trail.period_s
        self.nats[b] = self.lateral_nats[b] = 0.0
        self.Y[..., b], self.K[..., b] = run.Y, run.K
        if self.count:
            self.vectors[..., b], self.rates[..., b], self.waters[..., b] = trail.vectors, trail.rates, trail.waters
        if self.sideways:
            self.weights[..., b], self.across[..., b] = trail.weights, trail.lateral
            self.across_rates[..., b] = trail.lateral_rates

    def unload(self, b, run):
        """What has grown, back to the run."""
        periods = len(run.trail.nats)
        run.trail.nats[:], run.trail.lateral_nats[:] = self.nats[b, :periods], self.lateral_nats[b, :periods]

    def follow(self, records, tables, trail, trails, counts, values, in_lanes):
        """Through the trails (COUNT, l, ...), of which `trails` steps each are to be followed."""
        follow(
            records, tables, trail, trails, self.periods, self.nats, self.lateral_nats, int(self.sideways), counts,
            (values, in_lanes, *self.own), self.work, self.lateral,
        )  # fmt: skip
