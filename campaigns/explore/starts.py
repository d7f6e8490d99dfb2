"""Starts of one scene: where a run begins, and how it goes on until it has settled or has reached a known motion.

A start is kicked (`buoy_velocity_mps`, `buoy_displacement_m`), or takes up a state of another run. Its run is looked at
after LOOKS wave periods. It ends when its last states lie on a known motion (`analysis.joins`), when it has settled on
one of its own (`analysis.settled`), or after the last look, unsettled. These runs are samples of OFTEN a wave period,
because a motion is told by its strobes and by the extremes of its periods; what is reported is measured by other runs.
"""

import hashlib
import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from typing import NamedTuple

import numpy as np

from campaigns.columns import LOOPS, MESSAGE, PERIODS_RUN, RUN_KEY, STATUS, WALL_S, Column, counted
from campaigns.explore.approach import orbit_ahead
from campaigns.judge import LATERAL, TANGENTS
from campaigns.machinery.folder import claimed, made_by, run_of, write_table
from campaigns.machinery.plan import Further, Job, Plan, Summary
from campaigns.machinery.runner import run
from engine.scene import scene_from_toml
from engine.views import state_of

LOOKS = (16, 20, 24, 30, 36, 44, 54, 66, 80, 96, 112, 128, 144, 160)
OFTEN, MOST_OFTEN = 10, 720  # samples a wave period; at most, where it is strobed between these
KICK, DISPLACEMENT, PHASE = "start.buoy_velocity_mps", "start.buoy_displacement_m", "waves.phase_rad"
SOURCES = "analysis", "engine", "campaigns/explore"
FOUND_BY = Column("found_by", symbol="found by", meaning="rest, massless (model), kick, or carried from a neighbour")
SETTLED, JOINED, UNSETTLED = "settled", "joined", "unsettled"
KICKS = (
    Column("kick_x_mps", "m/s", "kick x", "velocity of the buoy along the waves at the start", 2),
    Column("kick_z_mps", "m/s", "kick z", "upward velocity of the buoy at the start", 2),
    Column(
        "displacement_x_m", "m", "moved x", "place of the buoy at the start, from that of its rest, along the waves", 2
    ),
    Column("displacement_z_m", "m", "moved z", "place of the buoy at the start, from that of its rest, upwards", 2),
    Column("phase_rad", "rad", "phase", "phase of the wave at the start", 3),
)
OUTCOME = Column("outcome", symbol="outcome", meaning=f"{SETTLED} by itself, {JOINED} a known motion, or {UNSETTLED}")
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
        share = strobed_at(scene.waves.phase_rad if self.phase is None else self.phase)
        parts = Fraction(share).limit_denominator(MOST_OFTEN).denominator  # strobes are samples
        step_s = scene.waves.period_s / (parts * math.ceil(self.often / parts))
        changes: dict[str, object] = {TANGENTS: 0, LATERAL: False, "output.step_s": step_s}
        for key, (x, z) in ((KICK, self.kick), (DISPLACEMENT, self.displacement)):
            changes[key] = [x, 0.0, z] if self.state is None else [0.0, 0.0, 0.0]
        changes |= {} if self.phase is None else {PHASE: self.phase}
        return scene_from_toml(scene.to_toml(), changes)

    def labels(self) -> dict[str, object]:
        """The columns of KICKS; those of a state are empty."""
        if self.state is not None:
            return {"found_by": self.found_by}
        (kick, moved), phase = (self.kick, self.displacement), {} if self.phase is None else {"phase_rad": self.phase}
        return {
            "found_by": self.found_by,
            **dict(zip((one.name for one in KICKS), (*kick, *moved), strict=False)),
        } | phase


DISPLACED = Start("massless", displacement=(1.0, 0.0))  # what the starts on motions of a massless tether are like


def strobed_at(phase_rad: float) -> float:
    """Share of the wave period after which a wave of this phase (of k x - omega t + phase) is first at phase 0."""
    return phase_rad / (2.0 * math.pi) % 1.0


def start_job(labels: dict, scene, start: Start, known: Sequence, most: int = LOOKS[-1], settles: bool = True) -> Job:
    """The run of a start of a scene, with the motions (`analysis.Settled`) that are known of it. settles: `Asked`."""
    # it ends at the phase at which its scene begins, so that the scene can take up its last state
    after = 0.0 if start.phase is None else strobed_at(start.phase - scene.waves.phase_rad)
    ends = tuple(end + after for end in (*(end for end in LOOKS if end < most), most))
    digest = hashlib.sha256(b"" if start.state is None else start.state.digest().encode())
    for motion in known:
        for part in (motion.points, motion.measures, motion.scale):
            digest.update(np.ascontiguousarray(part).tobytes())
    return Job(
        labels | start.labels(),
        start.scene(scene),
        ends[-1],
        describe=partial(start_row, known=tuple(known), settles=settles),
        going=partial(_until_settled, start=start.state, ends=ends),
        made=f"start {digest.hexdigest()}{'' if settles else ' joins'}",
    )


def _until_settled(scene, trajectory, row, checks, start, ends):
    """What the run of a start does next (`campaigns.machinery.plan.Further`)."""
    if row is None:
        return Further(scene, ends[0], start)
    done = row.get("periods")
    ahead = next((end for end in ends if done is not None and end > done + 1e-6), None)
    if row["status"] != "ok" or row.get("outcome") != UNSETTLED or ahead is None:
        return None
    return Further(scene, ahead - done, trajectory)


def start_row(trajectory, checks=None, known: Sequence = (), settles: bool = True) -> dict[str, object]:
    """The columns of OF_A_START that the run of a start fills."""
    from analysis import joins, settled

    row = counted(trajectory, (LOOPS, WALL_S))
    if len(trajectory.columns["time_s"]):
        step_s, period_s = trajectory.scene.sample_step_s(), trajectory.scene.waves.period_s
        row["periods"] = (len(trajectory.columns["time_s"]) - 1) * step_s / period_s
    if trajectory.status != "ok":
        return row
    strobed, measures, scale = section_of(trajectory)
    if (which := joins(strobed, measures, known)) is not None:
        return row | {"outcome": JOINED, "joins": which}
    own = settled(strobed, measures, scale=scale) if settles else None
    return row | {"outcome": UNSETTLED if own is None else SETTLED}


def section_of(trajectory) -> tuple[np.ndarray, np.ndarray, list[float]]:
    """Strobed states (n + 1, 4) of a run, (n, 3) least and largest r (m) and largest tension (N) of each period, and
    what counts as 1 in the states. r is taken OFTEN times a period, so that runs of more samples compare. States are
    those at phase 0 of the wave, so that runs that begin at other phases compare too.
    """
    from analysis import poincare_section

    columns, waves, step_s = trajectory.columns, trajectory.scene.waves, trajectory.scene.sample_step_s()
    period_s, share = waves.period_s, strobed_at(waves.phase_rad)
    passed_s = np.arange(len(columns["time_s"])) * step_s
    periods = int(passed_s[-1] / period_s - share + 1e-6)
    coordinates, scale = state_of(columns, step_s, period_s, periods // 2)
    strobed = poincare_section(coordinates, step_s, period_s, share).points[: periods + 1]
    marks = (np.arange(periods * OFTEN) / OFTEN + share) * period_s
    radius = np.interp(marks, passed_s, columns["radius_m"]).reshape(periods, OFTEN)
    begin = np.searchsorted(passed_s, (np.arange(periods) + share) * period_s + 1e-6 * step_s)
    end = round((periods + share) * period_s / step_s) + 1
    tension = np.maximum.reduceat(columns["tension_top_high_N"][:end], begin)
    return strobed, np.column_stack([radius.min(axis=1), radius.max(axis=1), tension]), scale


def settled_of(trajectory):
    """The motion to which a run has settled, or comes nearer (`analysis.Settled`); None where it does neither."""
    from analysis import settled

    strobed, measures, scale = section_of(trajectory)
    motion = settled(strobed, measures, scale=scale)
    if motion is None and (ahead := orbit_ahead(trajectory)) and ahead[1].passed:
        return settled_of(ahead[0].run)
    return motion


def as_it_is(trajectory):
    """The later half of a run as a motion: one that has not settled when its run ends is one that others may reach."""
    from analysis import Settled

    strobed, measures, scale = section_of(trajectory)
    later = len(measures) // 2
    return Settled(
        None, strobed[later:-1], measures[later:], np.asarray(scale), "not settled: the later half of its run"
    )


class Asked(NamedTuple):
    """A start to run: columns that name it, scene, Start, the motions that are known, and its most wave periods.

    settles: whether it ends too when it has settled on another one: one that passes by an unstable orbit seems to have.
    """

    labels: dict
    scene: object
    start: Start
    known: Sequence = ()
    most: int = LOOKS[-1]
    settles: bool = True


@dataclass(eq=False)
class Ended:
    """How a start ended: its row; the known motion that it joined, or its own, with its last state.

    motion: what its motion is called later (anything with branch.letter).
    """

    row: dict
    joins: int | None = None
    settled: object = None
    state: object = None
    motion: object = None

    def same_as(self, known: Sequence) -> int | None:
        """Number of the motion among these `Settled` that is its own; None where none is."""
        from analysis import grouped

        if not known:
            return None
        *before, own = grouped([*known, self.settled])
        return next((number for number, label in enumerate(before) if label == own), None)


class Starts:
    """All starts of a campaign: runs in its folder starts/, with a table; named: columns that name a start."""

    def __init__(self, plan: Plan, named: tuple[Column, ...]):
        columns = (*named, FOUND_BY, *OF_A_START)
        how = replace(plan.how, out=plan.how.out / "starts")
        self.plan = replace(plan, how=how, columns=columns, describe=start_row, row_maker=made_by({}, *SOURCES))
        self.ended: list[Ended] = []
        self.times: Counter = Counter()
        self.computed = 0

    def did(self, timing: dict[str, float], summary: Summary) -> None:
        """Add runs to the times and to the runs that were not there before."""
        self.times.update(timing)
        self.computed += summary.computed

    def run(self, said: str, asked: Sequence[Asked], told: bool = True) -> list[Ended]:
        """Run starts that are not there yet, side by side; said: what they are called; told: whether in the table.

        Raises as `runner.run`.
        """
        jobs = [start_job(*one) for one in asked]
        if not jobs:
            return []
        with claimed(self.plan.how.out):
            timing, summary = run(replace(self.plan, title=said), jobs)
        self.did(timing, summary)
        rows = {row["run_key"]: row for row in summary.rows}
        found = [self._ended(job, rows.get(job.key)) for job in jobs]
        self.ended += found if told else []
        return found

    def _ended(self, job: Job, row: dict | None) -> Ended:
        row = {**job.labels, "status": "lost"} if row is None else {**row, **job.labels}
        if row.get("outcome") == JOINED:
            return Ended(row, round(row["joins"]))
        run = run_of(self.plan.how.out, row) if row.get("outcome") == SETTLED else None
        return Ended(row) if run is None else Ended(row, None, settled_of(run), run.final_state)

    def write(self) -> None:
        """Write the table of all starts, with the letters of their motions. Raises OSError."""
        rows = [{**one.row, "motion": one.motion.branch.letter if one.motion else None} for one in self.ended]
        for row in rows:
            row.pop("joins", None)
        columns = tuple(column for column in self.plan.columns if column is not JOINS)
        write_table(self.plan.how.out / "table.csv", columns, rows)
