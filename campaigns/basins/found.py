"""The motions of one scene, and in which of them each start of a grid ends."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from campaigns.basins.grid import Grid
from campaigns.columns import MESSAGE, PERIODS_RUN, RUN_KEY, STATUS, Column
from campaigns.explore.along import FROM_REST, MOTION, Along, Motion
from campaigns.explore.proposals import proposals
from campaigns.explore.rows import STEEPNESS
from campaigns.explore.starts import JOINED, KICKS, OUTCOME, Asked, Ended, Start, as_it_is, settled_of
from campaigns.judge import judged_job
from campaigns.machinery.folder import claimed, run_of
from campaigns.machinery.plan import Job, Plan, Summary
from campaigns.machinery.runner import run
from campaigns.study import Order

SAMPLE = 24  # starts of the grid that are run at a time until they find no new motion
PEAK = Column("tension_top_max_N", "N", "T_max", "largest tension at the top of the line in its motion", 0)
COLUMNS = (*KICKS, MOTION, OUTCOME, STATUS, PERIODS_RUN, PEAK, RUN_KEY, MESSAGE)


class Found:
    """Motions of a scene, found in turn by the start from rest, a massless tether, and starts of the grid."""

    def __init__(self, plan: Plan, job: Job, grid: Grid):
        self.plan, self.job, self.grid, self.scene = plan, job, grid, job.scene
        self.along = Along(plan, STEEPNESS, [job], lambda value: None, ())
        self.ended: dict[int, Ended] = {}
        self.computed = 0  # starts of the grid that were not there before

    @property
    def motions(self) -> list[Motion]:
        """As found; the first is that from rest."""
        return self.along.motions[0]

    @property
    def known(self) -> tuple:
        """The motions as `analysis.Settled`."""
        return tuple(motion.settled for motion in self.motions)

    def asked(self, start: Start, scene=None, **more) -> Asked:
        """A start of the scene, or of another one with the same motions; more: fields of `Asked`."""
        return Asked(self.job.labels, scene or self.scene, start, self.known, **more)

    def find(self, order: Order, speed_mps: float, seed: int) -> None:
        """Find the motions, and where the starts of the grid end. Raises as `runner.run`."""
        self.judge(order)
        proposed = proposals(self.plan, [self.scene], speed_mps, seed)[0]
        self.along.round(
            "starts on motions of a massless tether", [(0, self.along.fine(0, start)) for start in proposed]
        )
        left, points = list(self.grid.spread(seed)), self.grid.points()
        while left:
            known = len(self.motions)
            self._round("starts spread over the grid", left[:SAMPLE], points, fine=True)
            left = left[SAMPLE:]
            if len(self.motions) == known:
                break
            self.judge(order)  # what they found is known better, and the next starts join it
        self._round("all other starts of the grid", left, points)
        self.along.kicked = len(points)
        self.judge(order)
        self.along.name()

    def _round(self, said: str, numbers: Sequence[int], points: Sequence, fine: bool = False) -> None:
        starts, before = self.along.starts, self.along.starts.computed
        asked = [self.grid.start(*points[number]) for number in numbers]
        for motion in self.along.round(said, [(0, self.along.fine(0, one) if fine else one) for one in asked]):
            if motion is not None:
                motion.kicks += 1
        self.computed += starts.computed - before
        self.ended |= dict(zip(numbers, starts.ended[len(starts.ended) - len(numbers) :], strict=True))

    def led(self, ended: Ended) -> Motion | None:
        """The motion in which a start has ended that `find` did not run; None for one that it has not found."""
        which = ended.joins if ended.row.get("outcome") == JOINED else None
        if which is None and ended.settled is not None:
            which = ended.same_as(self.known)
        ended.motion = None if which is None else self.motions[which]
        return ended.motion

    def judge(self, order: Order) -> Summary:
        """One judged run for each motion, from its state, in motions/; motions that these find to be one become one.

        Raises as `runner.run`.
        """
        motions = self.motions or [None]
        summary, runs = self.within("motions", "judged runs", [self._job(order, motion) for motion in motions])
        longer = {motion: one for motion, one in zip(motions, runs, strict=True) if one is not None}
        settled = {motion: settled_of(one) or as_it_is(one) for motion, one in longer.items()}
        if None in settled:
            self.motions.append(Motion(0, settled[None], longer[None].final_state, FROM_REST))
        else:
            self.along.merge(settled)
        return summary

    def within(self, folder: str, said: str, jobs: list[Job]) -> tuple[Summary, list]:
        """Do runs in a folder beside that of the starts; their Trajectories, None for one that ended early."""
        how = replace(self.plan.how, out=self.plan.how.out / folder)
        with claimed(how.out):
            timing, summary = run(replace(self.plan, how=how, title=said), jobs)
        self.along.starts.did(timing, summary)
        rows = {row["run_key"]: row for row in summary.rows}
        return summary, [run_of(how.out, rows[job.key]) if job.key in rows else None for job in jobs]

    def _job(self, order: Order, motion: Motion | None) -> Job:
        labels = {**self.job.labels, "dimensions": self.scene.motion.dimensions}
        labels |= self.along.labels(motion) if motion is not None and motion.branch is not None else {}
        fresh = motion is None or motion.found_by == FROM_REST
        return judged_job(order, labels, self.scene, None if fresh else motion.state.at_zero())

    def rows(self, motions: Sequence[dict]) -> Iterator[dict[str, object]]:
        """The rows of COLUMNS. motions: rows of the judged runs."""
        peaks = {row.get("motion"): row.get(PEAK.name) for row in motions}
        shown = {column.name for column in COLUMNS}
        for number in range(len(self.ended)):
            one = self.ended[number]
            letter = one.motion.branch.letter if one.motion is not None else None
            row = {name: entry for name, entry in one.row.items() if name in shown}
            yield {**row, "motion": letter, PEAK.name: peaks.get(letter)}
