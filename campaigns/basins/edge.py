"""The state between two motions: its own motion, which a run leaves to one side or the other (edge tracking).

Two states lie on either side of the border between two basins. They are bisected until they are near each other, run
side by side until they part, and bisected again: J. D. Skufca, J. A. Yorke and B. Eckhardt, Phys. Rev. Lett. 96, 174101
(2006). Both runs are near the border all the way, and what they settle on there is the edge state.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from campaigns.basins.found import Found
from campaigns.columns import MESSAGE, RUN_KEY, STATUS, Column
from campaigns.judge import job_from
from campaigns.machinery.folder import claimed, run_of, write_table
from campaigns.machinery.runner import run
from campaigns.motions.along import Motion
from campaigns.motions.starts import OFTEN, Start, section_of, start_row

SHARES = 16  # states between two, bisected side by side
NEAR, APART = 1e-6, 2e-3  # distances, in the size of the motion, to which two states are brought and at which they part
MOST, ROUNDS = 60, 24  # wave periods that an edge state is followed; rounds of states between
FOLDER = "edge"
_EXTREMES = (
    Column("radius_min_m", "m", "r_min", "smallest distance from the anchor, over the later half", 2),
    Column("radius_max_m", "m", "r_max", "largest distance from the anchor, over the later half", 2),
    Column("tension_top_max_N", "N", "T_max", "largest tension at the top of the line, over the later half", 0),
)
COLUMNS = (
    Column("motion", symbol="on one side", meaning="motion to which a run falls on one side"),
    Column("other", symbol="on the other", meaning="motion to which it falls on the other side"),
    Column("periods", "", "periods", "wave periods over which it was followed", 0),
    Column("strobed_period", "", "N", "wave periods after which it repeats; empty where none is found", 0),
    Column("growth_bits_per_period", "bits/period", "growth", "rate at which runs leave it", 2),
    *_EXTREMES,
    STATUS,
    RUN_KEY,
    MESSAGE,
)
ORBIT = (
    Column("period", "", "t/T", "wave periods since it has been followed", 0),
    Column("radius_m", "m", "r", "strobed distance from the anchor", 4),
    Column("radius_rate_mps", "m/s", "dr/dt", "strobed radial speed", 4),
    Column("apart", "", "apart", "distance of the two runs there, in the size of the motion", 6),
)


class Edge:
    """The two states on either side of the border between two motions."""

    def __init__(self, found: Found, one: Motion, other: Motion):
        self.found, self.sides = found, (one, other)
        self.low, self.high = one.state.at_zero(), other.state.at_zero()
        self.rounds = 0

    def narrow(self) -> tuple[object, object] | None:
        """Bring the two states near each other; their runs, to the motions on both sides. None where rounds ran out, or
        no states between lead to them.
        """
        from engine.going_on import between

        starts = self.found.along.starts
        while self.rounds < ROUNDS:
            self.rounds += 1
            states = [between(self.low, self.high, k / (SHARES + 1)) for k in range(1, SHARES + 1)]
            asked = [self.found.asked(Start("edge", state=state)) for state in states]
            ended = starts.run("states between two motions", asked)
            led = [self.found.led(one) for one in ended]
            last = max((k for k, motion in enumerate(led) if motion is self.sides[0]), default=None)
            if last is None:
                self.high = states[0]
                continue
            after = next((k for k in range(last + 1, SHARES) if led[k] is self.sides[1]), None)
            self.low = states[last]
            if after is None:
                continue
            self.high = states[after]
            runs = [run_of(starts.plan.how.out, ended[k].row) for k in (last, after)]
            if None not in runs and self.apart(*runs)[0] <= NEAR:
                return tuple(runs)
        return None

    def apart(self, one, other) -> np.ndarray:
        """Distance of two runs at the beginning of each wave period, in the size of the larger motion."""
        scale = np.max([side.settled.scale for side in self.sides], axis=0)
        first, second = (section_of(trajectory)[0] for trajectory in (one, other))
        count = min(len(first), len(second))
        return np.abs((first[:count] - second[:count]) / scale).max(axis=1)
