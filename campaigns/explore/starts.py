"""Starts of one scene: where a run begins, and how it goes on until it has settled or has reached a known motion.

A start is kicked (`buoy_velocity_mps`, `buoy_displacement_m`), or takes up a state of another run. Its run is looked at
after LOOKS wave periods. It ends when its last states lie on a known motion (`analysis.joins`), when it has settled on
one of its own (`analysis.settled`), or after the last look, unsettled. These runs are samples of OFTEN a wave period,
because a motion is told by its strobes and by the extremes of its periods; what is reported is measured by other runs.
"""

import contextlib
import hashlib
import math
from bisect import bisect_left
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np

from analysis import Settled, joins, settled
from campaigns.explore.multipliers import orbit_ahead
from campaigns.judge import UNFOLLOWED, periods_of
from campaigns.machinery import (
    Job,
    Jobs,
    Plan,
    Store,
    Summary,
    claimed,
    filled,
    made_by,
    orbits_in,
    run,
    run_of,
    until_settled,
)
from engine.scene import scene_from_toml
from engine.views import strobed_states
from tables import (
    JOINED,
    LOOPS,
    MESSAGE,
    PERIODS_RUN,
    RUN_KEY,
    SETTLED,
    STATUS,
    UNSETTLED,
    WALL_S,
    Column,
    Columns,
    Row,
    counted,
    of_words,
    write_table,
)

LOOKS = (16, 20, 24, 30, 36, 44, 54, 66, 80, 96, 112, 128, 144, 160)
OFTEN, MOST_OFTEN = 10, 720  # samples a wave period; at most, where it is strobed between these
KICK_MPS2 = 1.2  # speed of a kick over the wave period: 6 m/s in the waves of the paper
KICK, DISPLACEMENT, PHASE = "start.buoy_velocity_mps", "start.buoy_displacement_m", "waves.phase_rad"
SOURCES = "analysis", "engine", "campaigns/explore"
FOUND_BY = of_words("found_by", "rest, massless (model), kick, or carried from a neighbour", "found by")
KICKS = (
    Column("kick_x_mps", "m/s", "kick x", "velocity of the buoy along x at the start", 2),
    Column("kick_z_mps", "m/s", "kick z", "upward velocity of the buoy at the start", 2),
    Column("displacement_x_m", "m", "moved x", "place of the buoy at the start, from that of its rest, along x", 2),
    Column("displacement_z_m", "m", "moved z", "place of the buoy at the start, from that of its rest, upwards", 2),
    Column("phase_rad", "rad", "phase", "phase of the wave at the start", 3),
)
OUTCOME = of_words("outcome", f"{SETTLED} by itself, {JOINED} a known motion, or {UNSETTLED}")
JOINS = Column("joins", "", "joins", "number of the known motion that it has joined, from 0 on", 0)
OF_A_START = (*KICKS, OUTCOME, JOINS, STATUS, PERIODS_RUN, LOOPS, WALL_S, RUN_KEY, MESSAGE)


@dataclass(frozen=True, eq=False)
class Start:
    """Where a run begins: at rest with the buoy kicked (m/s), displaced (m), in a wave of this phase (rad); or in a
    state of another run. found_by: what it is called in tables. often: least samples of its run in a wave period.
    """

    found_by: str
    kick: tuple[float, float] = (0.0, 0.0)
    displacement: tuple[float, float] = (0.0, 0.0)
    phase: float | None = None
    state: object = None
    often: int = OFTEN

    def scene(self, scene):
        """The scene that begins so."""
        changes = dict(UNFOLLOWED)
        phase = scene.waves.phase_rad
        if self.phase is not None:
            phase = changes[PHASE] = self.phase
        parts = Fraction(strobed_at(phase)).limit_denominator(MOST_OFTEN).denominator  # strobes are samples
        changes["output.step_s"] = scene.waves.period_s / (parts * math.ceil(self.often / parts))
        for key, (x, z) in ((KICK, self.kick), (DISPLACEMENT, self.displacement)):
            changes[key] = [x, 0.0, z]
        return scene_from_toml(scene.to_toml(), changes)

    def labels(self) -> Row:
        """The columns of KICKS; those of a state are empty."""
        labels = {"found_by": self.found_by}
        if self.state is None:
            labels |= filled(KICKS[:4], (*self.kick, *self.displacement))
            if self.phase is not None:
                labels["phase_rad"] = self.phase
        return labels


DISPLACED = Start("massless", displacement=(1.0, 0.0))  # what the starts on motions of a massless tether are like


def kick_speed_mps(given: float | None, scene) -> float:
    """The speed of --kick-speed, or without it that of kicks of which a model has those of its prototype."""
    return given or KICK_MPS2 * scene.waves.period_s


def strobed_at(phase_rad: float) -> float:
    """Share of the wave period after which a wave of this phase (of k x - omega t + phase) is first at phase 0."""
    return phase_rad / (2.0 * math.pi) % 1.0


class Request(NamedTuple):
    """A start to run.

    labels: columns that name it.
    scene: in which it begins.
    start: how it begins.
    known: the motions (`analysis.Settled`) that are known of the scene.
    most: wave periods that it may take.
    settles: whether it ends too when it has settled on another one: one that passes by an unstable orbit seems to have.
    """

    labels: dict
    scene: object
    start: Start
    known: Sequence = ()
    most: int = LOOKS[-1]
    settles: bool = True


def start_job(request: Request) -> Job:
    """The run of a start."""
    start, scene = request.start, request.scene
    # it ends at the phase at which its scene begins, so that the scene can take up its last state
    shift = 0.0
    if start.phase is not None:
        shift = strobed_at(start.phase - scene.waves.phase_rad)
    looks = [*LOOKS[: bisect_left(LOOKS, request.most)], request.most]
    ends = tuple(look + shift for look in looks)
    digest = hashlib.sha256()
    if start.state is not None:
        digest.update(start.state.digest().encode())
    for motion in request.known:
        for part in (motion.points, motion.measures, motion.scale):
            digest.update(np.ascontiguousarray(part).tobytes())
    made = f"start {digest.hexdigest()}"
    if not request.settles:
        made += " joins"
    return Job(
        request.labels | start.labels(),
        start.scene(scene),
        ends[-1],
        describe=partial(start_row, known=tuple(request.known), settles=request.settles),
        going=partial(until_settled, start=start.state, ends=ends),
        made=made,
    )


def start_row(trajectory, known: Sequence = (), settles: bool = True) -> Row:
    """The columns of OF_A_START that the run of a start fills."""
    row = counted(trajectory, (LOOPS, WALL_S))
    if len(trajectory.columns["time_s"]):
        row["periods"] = periods_of(trajectory.scene, trajectory.columns)
    if trajectory.status != "ok":
        return row
    strobed, measures, scale = section_of(trajectory)
    number = joins(strobed, measures, known)
    if number is not None:
        return row | {"outcome": JOINED, "joins": number}
    if settles and settled(strobed, measures, scale=scale) is not None:
        return row | {"outcome": SETTLED}
    return row | {"outcome": UNSETTLED}


def section_of(trajectory) -> tuple[np.ndarray, np.ndarray, list]:
    """Strobed states (n + 1, 4) of a run, (n, 3) least and largest r (m) and largest tension (N) of each period, and
    what counts as 1 in the states. r is taken OFTEN times a period, so that runs of more samples compare. States are
    those at phase 0 of the wave, so that runs that begin at other phases compare too.
    """
    columns, waves, step_s = trajectory.columns, trajectory.scene.waves, trajectory.scene.sample_step_s()
    period_s, share = waves.period_s, strobed_at(waves.phase_rad)
    passed_s = np.arange(len(columns["time_s"])) * step_s
    periods = int(passed_s[-1] / period_s - share + 1e-6)
    strobed, scale = strobed_states(trajectory, periods // 2, share)
    marks = (np.arange(periods * OFTEN) / OFTEN + share) * period_s
    radius = np.interp(marks, passed_s, columns["radius_m"]).reshape(periods, OFTEN)
    begin = np.searchsorted(passed_s, (np.arange(periods) + share) * period_s + 1e-6 * step_s)
    end = round((periods + share) * period_s / step_s) + 1
    tension = np.maximum.reduceat(columns["tension_top_high_N"][:end], begin)
    return strobed[: periods + 1], np.column_stack([radius.min(axis=1), radius.max(axis=1), tension]), scale


def settled_of(trajectory, orbits: Store):
    """The motion to which a run has settled, or comes nearer (`analysis.Settled`); None where it does neither.

    orbits: of its campaign.
    """
    strobed, measures, scale = section_of(trajectory)
    motion = settled(strobed, measures, scale=scale)
    if motion is not None:
        return motion
    near = orbit_ahead(trajectory, orbits)
    if near is None or not near[1].passed:
        return None
    return settled_of(near[0].run, orbits)


def reached(trajectory, orbits: Store) -> Settled:
    """As `settled_of`; of a run that has not settled when it ends its later half, which others may reach."""
    motion = settled_of(trajectory, orbits)
    if motion is not None:
        return motion
    strobed, measures, scale = section_of(trajectory)
    later, reason = len(measures) // 2, "not settled: the later half of its run"
    return Settled(None, strobed[later:-1], measures[later:], np.asarray(scale), reason)


@dataclass(eq=False)
class Ending:
    """How a start ended.

    row: of the table of starts.
    joins: number of the known motion that it joined.
    settled, state: the motion (`analysis.Settled`) on which it settled itself, and its last state.
    motion: what its motion is called later (anything with branch.letter).
    """

    row: dict
    joins: int | None = None
    settled: object = None
    state: object = None
    motion: object = None


def run_within(plan: Plan, folder: Path, jobs: Jobs, ahead: Jobs = (), **changes) -> Summary:
    """Do runs in a folder of a campaign; changes: of its plan. Raises as `runner.run`."""
    claim = contextlib.nullcontext()
    if folder != plan.out:
        claim = claimed(folder)
    with claim:
        return run(plan.within(folder, **changes), list(jobs), ahead)


class Starts:
    """All starts of a campaign: runs in its folder starts/, with a table. keys: columns that name a start."""

    def __init__(self, plan: Plan, keys: Columns):
        self.folder, maker = plan.out / "starts", made_by(*SOURCES)
        columns = (*keys, FOUND_BY, *OF_A_START)
        self.plan = replace(plan, columns=columns, describe=start_row, judge=None, row_maker=maker, spare=[])
        self.endings = []  # `Ending` of every start
        self.times = Counter()
        self.computed = set()  # keys of the runs that were not there before

    def run(self, title: str, requests: Sequence[Request], listed: bool = True) -> list[Ending]:
        """Run starts that are not there yet, side by side. title: of the progress. listed: whether in the table.

        Raises as `runner.run`.
        """
        jobs = [start_job(request) for request in requests]
        if not jobs:
            return []
        summary = run_within(self.plan, self.folder, jobs, title=title)
        self.times.update(summary.times)
        self.computed |= summary.made
        rows = summary.by_key
        endings = [self._ending({**rows[job.key], **job.labels}) for job in jobs]
        if listed:
            self.endings += endings
        return endings

    def _ending(self, row: dict) -> Ending:
        ending = Ending(row)
        if row.get("outcome") == JOINED:
            ending.joins = round(row["joins"])
        elif row.get("outcome") == SETTLED:
            run = run_of(self.folder, row)
            if run is not None:
                ending.settled, ending.state = settled_of(run, orbits_in(self.folder)), run.final_state
        return ending

    def write(self) -> None:
        """Write the table of all starts, with the letters of their motions. Raises OSError."""
        rows = []
        for ending in self.endings:
            rows.append({**ending.row, "motion": ending.motion and ending.motion.branch.letter})
        columns = tuple(column for column in self.plan.columns if column is not JOINS)
        write_table(self.folder / "table.csv", columns, rows)
