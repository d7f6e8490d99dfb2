"""The state between two motions: its own motion, which a run leaves to one side or the other (edge tracking).

Two states lie on either side of the border between two basins. They are bisected until they are near each other, run
side by side until they part, and bisected again: J. D. Skufca, J. A. Yorke and B. Eckhardt, Phys. Rev. Lett. 96, 174101
(2006). Both runs are near the border all the way, and what they settle on there is the edge state.
"""

import math
from itertools import pairwise

import numpy as np

from campaigns.basins.exploration import Exploration
from campaigns.explore.motions import Motion, write_part
from campaigns.explore.rows import EXTREMES
from campaigns.explore.starts import Start, run_within, section_of
from campaigns.judge import job_from
from campaigns.machinery import filled, run_of
from engine.views import LONGEST_PERIOD
from tables import MESSAGE, RUN_KEY, STATUS, Column, Row, of_words, write_table

SHARES = 16  # states between two, bisected side by side
NEAR, APART = 2e-5, 2e-3  # distances, in the size of the motion, to which two states are brought and at which they part
MOST, ROUNDS = 60, 40  # wave periods that an edge state is followed; rounds of states between
TOGETHER = 4  # wave periods that two runs stay together at least
BEYOND = 3.0  # of the way between two states: how far beyond them the border is looked for
SAMPLES = 40  # of a wave period: extremes of r within 0.3 % of its swing
LONGEST = 480  # wave periods after which a state has fallen to neither side
FOLDER, TOP = "edge", "tension_top_high_N"
_EXTREMES = EXTREMES[0], EXTREMES[1], EXTREMES[5]  # of the radius, and of the largest tension
COLUMNS = (
    of_words("motion", "motion to which a run falls on one side", "on one side"),
    of_words("other", "motion to which it falls on the other side", "on the other"),
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

    def __init__(self, exploration: Exploration, first: Motion, second: Motion):
        self.exploration, self.sides = exploration, (first, second)
        self.scale = np.maximum(first.settled.scale, second.settled.scale)
        self.states = [first.state.at_zero(), second.state.at_zero()]
        self.runs = [None, None]
        self.known = True  # that they are on either side: each begins anew, by small steps, where it has gone on to
        self.rounds = 0

    def narrow(self) -> np.ndarray | None:
        """Bring the two states near each other; returns how far apart their runs are from wave to wave.

        None where rounds have run out, or the border has been lost.
        """
        beyond = 0.0
        if not self.known:
            beyond = BEYOND
        while self.rounds < ROUNDS and beyond <= BEYOND**3:
            self.rounds += 1
            border = self._border(beyond)
            if border is None:
                beyond *= BEYOND
                continue
            for _, side, state, row in border:
                self.states[side] = state
                if row is not None:
                    self.runs[side] = run_of(self.exploration.starts.folder, row)
            self.known, beyond = True, 0.0
            if None in self.runs:
                continue
            distances = self._distances()
            if distances[0] <= NEAR and distances[: TOGETHER + 1].max() <= APART:
                return distances
        return None

    def _border(self, beyond: float) -> tuple | None:
        """Two neighbours of SHARES states, on the line through the two and `beyond` them, on either side of the border.

        Each is (share of the way, side, state, row of its run). Of several borders that nearest to the middle; None:
        none is there.
        """
        from engine.run.going_on import between

        shares, starts = [], []
        for number in range(1, SHARES + 1):
            shares.append((1.0 + 2.0 * beyond) * number / (SHARES + 1) - beyond)
            starts.append(_start(between(*self.states, shares[-1])))
        endings = self.exploration.run("states between two motions", starts, most=LONGEST, settles=False)
        decided = []
        for share, start, ending in zip(shares, starts, endings, strict=True):
            if ending.motion in self.sides:
                decided.append((share, self.sides.index(ending.motion), start.state, ending.row))
        if self.known:
            decided = [(0.0, 0, self.states[0], None), *decided, (1.0, 1, self.states[1], None)]
        borders = [pair for pair in pairwise(decided) if pair[0][1] != pair[1][1]]
        return min(borders, key=lambda pair: abs(pair[0][0] + pair[1][0] - 1.0), default=None)

    def _distances(self) -> np.ndarray:
        first, second = map(_strobed, self.runs)
        count = min(len(first), len(second))
        return np.abs((first[:count] - second[:count]) / self.scale).max(axis=1)

    def go_on(self, periods: int) -> tuple:
        """Let both run on for so many wave periods, and begin there: the one on the first side, and its key; None for a
        run that ended early.
        """
        # with the output step of the runs that told them apart: with another one a state would begin a moment later
        scene = _start(self.states[0]).scene(self.exploration.scene)
        jobs = [job_from({}, scene, periods, state) for state in self.states]
        plan = self.exploration.plan
        folder = plan.out / FOLDER
        summary = run_within(plan, folder, jobs, title="along the edge")
        self.exploration.times.update(summary.times)
        runs = [run_of(folder, summary.by_key[job.key]) for job in jobs]
        if None in runs:
            return None, ""
        self.states = [run.final_state.at_zero() for run in runs]
        self.runs, self.known = [None, None], False
        return runs[0], jobs[0].key


def _strobed(trajectory) -> np.ndarray:
    """The strobed states of a run, the first of `section_of`."""
    return section_of(trajectory)[0]


def _start(state) -> Start:
    return Start("edge", state=state, often=SAMPLES)


def edge_state(exploration: Exploration, first: Motion, second: Motion) -> Row:
    """The row of COLUMNS on the edge state between two motions; writes edge/table.csv and edge/orbit.csv.

    Raises as `runner.run`.
    """
    edge = Edge(exploration, first, second)
    runs, distances_so_far, doublings = [], [], 0.0
    row = {"motion": first.branch.letter, "other": second.branch.letter, "status": "lost"}
    while len(distances_so_far) < MOST:
        distances = edge.narrow()
        if distances is None:
            break
        parted = np.append(distances > APART, True)  # behind the last at the latest
        periods = int(np.argmax(parted)) - 1
        trajectory, row["run_key"] = edge.go_on(periods)
        if trajectory is None:
            break
        runs.append(trajectory)
        distances_so_far += map(float, distances[:periods])
        doublings += math.log2(distances[periods] / distances[0])
    else:
        row["status"] = "ok"
    row["periods"] = len(distances_so_far)
    strobed = []
    if runs:
        row["growth_bits_per_period"] = doublings / len(distances_so_far)
        for trajectory in runs:
            strobed += [*_strobed(trajectory)[:-1]]
        row |= _later_extremes(runs) | {"strobed_period": _repeats(np.array(strobed) / edge.scale)}
    folder = write_part(exploration.plan, FOLDER, COLUMNS, [row])
    orbit = []
    for period, state in enumerate(strobed):
        orbit.append(filled(ORBIT, (period, *state, distances_so_far[period])))
    write_table(folder / "orbit.csv", ORBIT, orbit)
    return row


def _later_extremes(runs: list) -> dict[str, float]:
    """Extremes over the later half of what was followed."""
    radius = np.concatenate([run.columns["radius_m"] for run in runs])
    tension = np.concatenate([run.columns[TOP] for run in runs])
    half = len(radius) // 2
    extremes = radius[half:].min(), radius[half:].max(), tension[half:].max()
    return filled(_EXTREMES, map(float, extremes))


def _repeats(states: np.ndarray) -> int | None:
    """Wave periods after which states (n, 4) repeat in the median, as near as the two runs are; None: they do not."""
    later = states[len(states) // 2 :]
    for period in range(1, min(LONGEST_PERIOD, len(later) // 3) + 1):
        if np.median(np.abs(later[period:] - later[:-period]).max(axis=1)) <= 2.0 * APART:
            return period
    return None
