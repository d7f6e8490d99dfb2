"""The state between two motions: its own motion, which a run leaves to one side or the other (edge tracking).

Two states lie on either side of the border between two basins. They are bisected until they are near each other, run
side by side until they part, and bisected again: J. D. Skufca, J. A. Yorke and B. Eckhardt, Phys. Rev. Lett. 96, 174101
(2006). Both runs are near the border all the way, and what they settle on there is the edge state.
"""

import math
from dataclasses import replace

import numpy as np

from campaigns.basins.found import Found
from campaigns.columns import MESSAGE, RUN_KEY, STATUS, Column, counted
from campaigns.judge import job_from
from campaigns.machinery.folder import claimed, run_of, write_table
from campaigns.machinery.runner import run
from campaigns.motions.along import Motion
from campaigns.motions.starts import Start, section_of

SHARES = 16  # states between two, bisected side by side
NEAR, APART = 2e-5, 2e-3  # distances, in the size of the motion, to which two states are brought and at which they part
MOST, ROUNDS = 60, 40  # wave periods that an edge state is followed; rounds of states between
LONGEST = 480  # wave periods after which a state has fallen to neither side
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
OF_A_PART = (STATUS, RUN_KEY, MESSAGE)
ORBIT = (
    Column("period", "", "t/T", "wave periods since it has been followed", 0),
    Column("radius_m", "m", "r", "strobed distance from the anchor", 4),
    Column("radius_rate_mps", "m/s", "dr/dt", "strobed radial speed", 4),
    Column("apart", "", "apart", "distance of the two runs there, in the size of the motion", 6),
)


class Edge:
    """The two states on either side of the border between two motions, and their runs, which tell that they are."""

    def __init__(self, found: Found, one: Motion, other: Motion):
        self.found, self.sides = found, (one, other)
        self.states = [one.state.at_zero(), other.state.at_zero()]
        self.runs: list = [None, None]
        self.rounds = 0

    def narrow(self) -> np.ndarray | None:
        """Bring the two states near each other; returns how far apart their runs are from wave to wave.

        None where rounds have run out, or no state between them leads to either motion.
        """
        from engine.going_on import between

        starts = self.found.along.starts
        while self.rounds < ROUNDS:
            self.rounds += 1
            states = [between(*self.states, (k + 1) / (SHARES + 1)) for k in range(SHARES)]
            asked = [self.found.asked(Start("edge", state=state), most=LONGEST, settles=False) for state in states]
            ended = starts.run("states between two motions", asked)
            led = [self.found.led(one) for one in ended]
            last = max((k for k, motion in enumerate(led) if motion is self.sides[0]), default=-1)
            after = next((k for k in range(last + 1, SHARES) if led[k] is self.sides[1]), None)
            if last < 0 and after is None:
                return None
            for side, k in enumerate((last, after)):
                if k is not None and k >= 0:
                    self.states[side] = states[k]
                    self.runs[side] = run_of(starts.plan.how.out, ended[k].row)
            if None not in self.runs and (apart := self._apart())[0] <= NEAR:
                return apart
        return None

    def _apart(self) -> np.ndarray:
        scale = np.max([side.settled.scale for side in self.sides], axis=0)
        first, second = (section_of(trajectory)[0] for trajectory in self.runs)
        count = min(len(first), len(second))
        return np.abs((first[:count] - second[:count]) / scale).max(axis=1)

    def go_on(self, periods: int) -> list:
        """Let both run on for so many wave periods, and begin there; their trajectories, [] where one ended early."""
        plan, scene = self.found.plan, self.found.scene
        how = replace(plan.how, out=plan.how.out / FOLDER)
        jobs = [job_from({}, scene, periods, state) for state in self.states]
        with claimed(how.out):
            timing, summary = run(
                replace(plan, how=how, said="along the edge", describe=edge_row, columns=OF_A_PART, row_maker=""), jobs
            )
        self.found.along.starts.times.update(timing)
        rows = {row["run_key"]: row for row in summary.rows}
        runs = [run_of(how.out, rows[job.key]) for job in jobs]
        if None in runs:
            return []
        self.states, self.runs = [one.final_state.at_zero() for one in runs], [None, None]
        return runs


def edge_row(trajectory, checks=None) -> dict[str, object]:
    """The columns of OF_A_PART that a run along the edge fills."""
    return counted(trajectory, ())


def edge_state(found: Found, one: Motion, other: Motion) -> dict[str, object]:
    """The row of COLUMNS on the edge state between two motions; writes edge/table.csv and edge/orbit.csv.

    Raises as `runner.run`.
    """
    edge, parts, orbit, rates = Edge(found, one, other), [], [], []
    row: dict[str, object] = {"motion": one.branch.letter, "other": other.branch.letter}
    while sum(len(part[1]) for part in parts) < MOST and (apart := edge.narrow()) is not None:
        periods = int(np.argmax(apart > APART)) - 1 if (apart > APART).any() else len(apart) - 1
        if periods < 1:
            break
        rates.append((math.log2(apart[periods] / apart[0]), periods))
        if not (runs := edge.go_on(periods)):
            break
        strobed, measures, scale = section_of(runs[0])
        parts.append((strobed[:periods], measures[:periods], scale))
        columns, every = runs[0].columns, round(found.scene.waves.period_s / found.scene.sample_step_s())
        for k in range(periods):
            at = {"radius_m": columns["radius_m"][k * every], "radius_rate_mps": columns["radius_rate_mps"][k * every]}
            orbit.append({"period": len(orbit), **at, "apart": float(apart[k])})
    (folder := found.plan.how.out / FOLDER).mkdir(exist_ok=True)
    row |= _told(parts, rates) | {"status": "ok" if len(orbit) >= MOST else "lost"}
    write_table(folder / "table.csv", COLUMNS, [row])
    write_table(folder / "orbit.csv", ORBIT, orbit)
    return row


def _told(parts: list, rates: list) -> dict[str, object]:
    """What a row says of the states, measures and scales of the parts, and of (doublings, periods) of each."""
    if not parts:
        return {"periods": 0}
    from analysis import settled

    states, measures = (np.concatenate([part[k] for part in parts]) for k in (0, 1))
    later, scale = measures[len(measures) // 2 :], np.max([part[2] for part in parts], axis=0)
    orbit = settled(states, measures[:-1], scale=scale)
    growth = sum(doublings for doublings, _ in rates) / sum(periods for _, periods in rates)
    extremes = later[:, 0].min(), later[:, 1].max(), later[:, 2].max()
    row = dict(zip((column.name for column in _EXTREMES), map(float, extremes), strict=True))
    period = None if orbit is None else orbit.period
    return row | {"periods": len(measures), "strobed_period": period, "growth_bits_per_period": growth}
