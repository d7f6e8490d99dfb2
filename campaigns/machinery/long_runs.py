"""Runs that last as long as they need: the loop of such a run, and the functions that decide on its next part.

    run = LongRun(job)
    while (part := run.next_part()) is not None:
        run.take(simulate(part.scene, periods=part.periods, start=part.start))
        run.row = the row that is made of run.trajectory and run.checks

`LongRun` has the trajectory of a run so far, and its row. The function `Job.going` decides on the next part from this
row. There are three such functions: `until_judged` ends a run when its regime is known, `until_settled` ends a start
when it has settled, and `once` does a single part from a given state. A worker does many such runs side by side
(`campaigns.machinery.worker`): a run goes on when its part has ended, while the other runs are under way.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import engine.scene
from engine.scene.finer import finer
from engine.views import carried, carries_tangents
from tables import UNSETTLED

LEAST_CHECK, SURE = 90, 2.5  # wave periods at the tighter tolerance; errors by which chaos is then expected to show
TANGENTS = "output.tangent_vectors"
EARLY = 60  # wave periods of the first part of a run that lasts until it is judged


class Part(NamedTuple):
    """The next part of a run: scene, wave periods, and the Trajectory or state in which it begins (None: rest).

    check: this part is a check of chaos, at a tighter tolerance. It goes into `checks` and does not lengthen the run.
    duration_s: its length where it is not given in wave periods.
    """

    scene: object
    periods: float
    start: object = None
    check: bool = False
    duration_s: float | None = None


@dataclass(eq=False)
class LongRun:
    """A run and how far it has come.

    row: of the trajectory so far; None before the first part.
    checks: Trajectories of the checks at a tighter tolerance, by the wave periods after which they began.
    part: the part that is under way.
    """

    job: object
    trajectory: object = None
    row: Mapping | None = None
    checks: dict[int, object] = field(default_factory=dict)
    part: Part | None = None

    def next_part(self) -> Part | None:
        """The next part of the run; None when the run is finished. A job without `going` is one part."""
        job = self.job
        if job.going is not None:
            self.part = job.going(job.scene, self.trajectory, self.row, self.checks)
        elif self.row is None:
            self.part = Part(job.scene, job.periods, duration_s=job.duration_s)
        else:
            self.part = None
        return self.part

    def take(self, result) -> None:
        """Add the Trajectory of the part that was under way."""
        if self.part.check:
            periods = round(self.row["periods"])
            earlier = self.checks.get(periods)
            self.checks[periods] = result if earlier is None else earlier.followed_by(result)
        elif self.trajectory is None:
            self.trajectory = result
        else:
            self.trajectory = self.trajectory.followed_by(result)


def once(scene, trajectory, row, checks, periods: float, start) -> Part | None:
    """One part from a state."""
    if row is None:
        return Part(scene, periods, start)
    return None


def until_settled(scene, trajectory, row, checks, start, ends: Sequence[float]) -> Part | None:
    """From look to look, at `ends` (wave periods), until the start has settled or has joined a known motion."""
    if row is None:
        return Part(scene, ends[0], start)
    periods = row.get("periods")
    if row["status"] != "ok" or row.get("outcome") != UNSETTLED or periods is None:
        return None
    for end in ends:
        if end > periods + 1e-6:
            return Part(scene, end - periods, trajectory)
    return None


def until_judged(
    scene, trajectory, row, checks, budget: int, looks: bool, start=None, most: int | None = None, least: float = 0.0
) -> Part | None:
    """Until the regime of the run is known.

    looks: whether the run is judged after 60, 90, 135, ... wave periods, up to `budget`; if not, it is one part of
    `budget` periods. After 60 only an orbit can decide on which the run lies (`campaigns.explore.multipliers`). If a
    later look finds no period, and no period that the motion approaches, the run carries perturbations from then on. A
    run that looks chaotic goes on at a tenth of the tolerance until chaos shows there too, but not for longer than the
    run was judged; the first part of this check is as long as chaos needs to show by SURE errors. A run ends early too
    if the errors of its steps blur the motion (`analysis.looks.BLURRED`), because a longer run would show the same.
    start: the state of another run in which this run begins; None: the start of the scene. most: wave periods after
    which the run has no further look, though `budget` allows it. least: wave periods that chaos has to last, because
    transients of this length are known (`campaigns.explore.stages`).
    """
    from analysis.looks import longer_decides
    from analysis.looks import looks as looks_until

    ends = []
    if looks:
        ends = [EARLY, *looks_until(budget)]
    if row is None:
        first_end, *_ = *ends, budget
        return Part(scene, first_end, start)
    periods = row.get("periods")
    if row["status"] != "ok" or row.get("regime") is None or periods is None:
        return None
    # whole periods: samples need not add up to them to the last digit, and a check of nothing would go on for ever
    next_end = next((end for end in ends if end > round(periods)), None)
    may_go_on = next_end is not None and (most is None or next_end <= most)
    chaotic = row["regime"] == "chaotic"
    if chaotic and periods < least and may_go_on:
        return Part(carrying(scene), next_end - periods, trajectory)
    check = _check(scene, trajectory, row, checks.get(round(periods)))
    if check is not None:
        return check
    if not longer_decides(row["regime"], str(row.get("regime_reason"))) or not may_go_on:
        return None
    wanted = _unclear(row) or (trajectory is not None and carried(trajectory))
    if wanted and carries_tangents(scene):
        scene = carrying(scene)
    return Part(scene, next_end - periods, trajectory)


def _check(scene, trajectory, row, check) -> Part | None:
    """The check of a run that looks chaotic, or its next part while chaos does not show; None: none is needed."""
    judged = round(row["periods"]) - (row.get("transient_periods") or 0)
    tighter = row.get("regime_tighter")
    if row["regime"] == "chaotic" and tighter is None:
        value, error = row["lyapunov_tangent_bits_per_period"], row["lyapunov_tangent_error"]
        enough = max(math.ceil(judged * (SURE * error / value) ** 2), LEAST_CHECK)
        return Part(finer(carrying(scene), steps=10), min(enough, judged), trajectory, check=True)
    if check is None or check.status != "ok" or tighter == "chaotic":
        return None
    ran = len(check.tangent.growth_nats)
    if ran >= judged:
        return None
    return Part(check.scene, min(math.ceil(0.5 * ran), judged - ran), check, check=True)


def _unclear(row) -> bool:
    """Whether perturbations have to say what an open run is: it does not repeat, or no orbit lies under it."""
    from analysis.evidence import read_evidence
    from analysis.looks import CLOSE, next_look

    if row["regime"] != "undecided" or row["periods"] < next_look():
        return False
    tests = {name for name, *_ in read_evidence(row.get("evidence") or "")}
    return row.get("strobed_period") is None or (CLOSE in tests and row["periods"] > next_look())


def carrying(scene):
    """The scene with a perturbation in its plane. One across it is for those who ask (`output.lateral_growth`): it
    costs a seventh more, and large motions release loops, which leaves no rate across the plane.
    """
    return engine.scene.scene_from_toml(scene.to_toml(), {TANGENTS: 1})
