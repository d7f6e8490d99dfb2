"""The state between two motions: its own motion, which a run leaves to one side or the other (edge tracking).

Two states lie on either side of the border between two basins. They are bisected until they are near each other, run
side by side until they part, and bisected again: J. D. Skufca, J. A. Yorke and B. Eckhardt, Phys. Rev. Lett. 96, 174101
(2006). Both runs are near the border all the way, and what they settle on there is the edge state.
"""

import math
from itertools import pairwise

import numpy as np

from campaigns.basins.found import Found
from campaigns.explore.along import Motion
from campaigns.explore.rows import EXTREMES
from campaigns.explore.starts import Start, section_of
from campaigns.judge import job_from
from campaigns.machinery.folder import run_of
from engine.views import LONGEST_PERIOD
from tables import MESSAGE, RUN_KEY, STATUS, Column, write_table

SHARES = 16  # states between two, bisected side by side
NEAR, APART = 2e-5, 2e-3  # distances, in the size of the motion, to which two states are brought and at which they part
MOST, ROUNDS = 60, 40  # wave periods that an edge state is followed; rounds of states between
TOGETHER = 4  # wave periods that two runs stay together at least
BEYOND = 3.0  # of the way between two states: how far beyond them the border is looked for
SAMPLES = 40  # of a wave period: extremes of r within 0.3 % of its swing
LONGEST = 480  # wave periods after which a state has fallen to neither side
FOLDER, TOP = "edge", "tension_top_high_N"
_EXTREMES = tuple(one for one in EXTREMES if one.name in ("radius_min_m", "radius_max_m", "tension_top_max_N"))
COLUMNS = (
    Column("motion", symbol="on one side", meaning="motion to which a run falls on one side"),
    Column("other", symbol="on the other", meaning="motion to which it falls on the other side"),
    Column("periods", "", "periods", "wave periods over which it was followed; extremes are of the later half", 0),
    Column("strobed_period", "", "N", "wave periods after which it repeats; empty where none is found", 0),
    Column("growth_bits_per_period", "bits/period", "growth", "rate at which runs leave it", 2),
    *_EXTREMES,
    STATUS,
    RUN_KEY,
    MESSAGE,
)
ORBIT = (
    Column("period", "", "t/T", "wave periods since it has been followed", 0),
    Column("x_m", "m", "x", "strobed place along the waves", 4),
    Column("z_m", "m", "z", "strobed height above the anchor", 4),
    Column("radial_mps", "m/s", "dr/dt", "strobed radial speed", 4),
    Column("lateral_mps", "m/s", "r dθ/dt", "strobed speed across the radius", 4),
    Column("apart", "", "apart", "distance of the two runs there, in the size of the motion", 6),
)


class Edge:
    """The two states on either side of the border between two motions, and their runs, which tell that they are."""

    def __init__(self, found: Found, one: Motion, other: Motion):
        self.found, self.sides = found, (one, other)
        self.states = [one.state.at_zero(), other.state.at_zero()]
        self.runs: list = [None, None]
        self.known = True  # that they are on either side: each begins anew, by small steps, where it has gone on to
        self.rounds = 0

    def narrow(self) -> np.ndarray | None:
        """Bring the two states near each other; returns how far apart their runs are from wave to wave.

        None where rounds have run out, or the border has been lost.
        """
        from engine.run.going_on import between

        starts, beyond = self.found.along.starts, 0.0 if self.known else BEYOND
        while self.rounds < ROUNDS and beyond <= BEYOND**3:
            self.rounds += 1
            shares = [(1.0 + 2.0 * beyond) * (k + 1) / (SHARES + 1) - beyond for k in range(SHARES)]
            states = [between(*self.states, share) for share in shares]
            asked = [self.found.asked(self._start(one), most=LONGEST, settles=False) for one in states]
            ended = starts.run("states between two motions", asked)
            told = [
                (share, self.sides.index(motion), state, one.row)
                for share, state, one in zip(shares, states, ended, strict=True)
                if (motion := self.found.led(one)) in self.sides
            ]
            if self.known:
                told = [(0.0, 0, self.states[0], None), *told, (1.0, 1, self.states[1], None)]
            pairs = [pair for pair in pairwise(told) if pair[0][1] != pair[1][1]]
            if not pairs:
                beyond *= BEYOND
                continue
            for _, side, state, row in min(pairs, key=lambda pair: abs(pair[0][0] + pair[1][0] - 1.0)):
                self.states[side] = state
                self.runs[side] = self.runs[side] if row is None else run_of(starts.plan.how.out, row)
            self.known, beyond = True, 0.0
            apart = self._apart() if None not in self.runs else np.ones(1)
            if apart[0] <= NEAR and apart[: TOGETHER + 1].max() <= APART:
                return apart
        return None

    def _start(self, state) -> Start:
        return Start("edge", state=state, often=SAMPLES)

    def _apart(self) -> np.ndarray:
        scale = np.max([side.settled.scale for side in self.sides], axis=0)
        first, second = (section_of(trajectory)[0] for trajectory in self.runs)
        count = min(len(first), len(second))
        return np.abs((first[:count] - second[:count]) / scale).max(axis=1)

    def go_on(self, periods: int) -> tuple:
        """Let both run on for so many wave periods, and begin there: the one on the first side, and its key; None for a
        run that ended early.
        """
        # of as many samples as the runs that told them apart: a state that goes over to others begins a moment later
        scene = self._start(self.states[0]).scene(self.found.scene)
        jobs = [job_from({}, scene, periods, state) for state in self.states]
        _, runs = self.found.within(FOLDER, "along the edge", jobs)
        if None in runs:
            return None, ""
        self.states, self.runs = [one.final_state.at_zero() for one in runs], [None, None]
        self.known = False
        return runs[0], jobs[0].key


def edge_state(found: Found, one: Motion, other: Motion) -> dict[str, object]:
    """The row of COLUMNS on the edge state between two motions; writes edge/table.csv and edge/orbit.csv.

    Raises as `runner.run`.
    """
    edge, runs, apart, doublings = Edge(found, one, other), [], [], 0.0
    row: dict[str, object] = {"motion": one.branch.letter, "other": other.branch.letter}
    while len(apart) < MOST and (now := edge.narrow()) is not None:
        periods = int(np.argmax(now > APART)) - 1 if (now > APART).any() else len(now) - 1
        trajectory, row["run_key"] = edge.go_on(periods)
        if trajectory is None:
            break
        runs.append(trajectory)
        apart += [*map(float, now[:periods])]
        doublings += math.log2(now[periods] / now[0])
    row |= {"periods": len(apart), "status": "ok" if len(apart) >= MOST else "lost"}
    strobed: list[np.ndarray] = []
    if runs:
        row["growth_bits_per_period"] = doublings / len(apart)
        scale = np.max([side.settled.scale for side in (one, other)], axis=0)
        strobed = [state for trajectory in runs for state in section_of(trajectory)[0][:-1]]
        row |= _later(runs) | {"strobed_period": _repeats(np.array(strobed) / scale)}
    (folder := found.plan.how.out / FOLDER).mkdir(exist_ok=True)
    write_table(folder / "table.csv", COLUMNS, [row])
    names = [column.name for column in ORBIT[1:-1]]
    told = ({"period": k, **dict(zip(names, state, strict=True)), "apart": apart[k]} for k, state in enumerate(strobed))
    write_table(folder / "orbit.csv", ORBIT, [*told])
    return row


def _later(runs: list) -> dict[str, float]:
    """Extremes over the later half of what was followed."""
    radius, tension = (np.concatenate([one.columns[name] for one in runs]) for name in ("radius_m", TOP))
    half = len(radius) // 2
    found = radius[half:].min(), radius[half:].max(), tension[half:].max()
    return dict(zip((column.name for column in _EXTREMES), map(float, found), strict=True))


def _repeats(states: np.ndarray) -> int | None:
    """Wave periods after which states (n, 4) repeat in the median, as near as the two runs are; None: after no few."""
    later = states[len(states) // 2 :]
    for period in range(1, min(LONGEST_PERIOD, len(later) // 3) + 1):
        if np.median(np.abs(later[period:] - later[:-period]).max(axis=1)) <= 2.0 * APART:
            return period
    return None
