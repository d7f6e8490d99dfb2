"""The motions of one scene, and the motion in which each start of a grid ends."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from campaigns.basins.grid import StartGrid
from campaigns.explore.motions import MOTION, Motion, Motions, Search, settled_in
from campaigns.explore.rows import STEEPNESS
from campaigns.explore.stages import judge, name, propose, run_from_rest
from campaigns.explore.starts import JOINED, KICKS, OUTCOME, Ending, Request, Start
from campaigns.machinery.folder import claimed, run_of
from campaigns.machinery.plan import Job, Plan
from campaigns.machinery.runner import run
from tables import MESSAGE, PERIODS_RUN, RUN_KEY, STATUS, Column, names

SAMPLE = 24  # starts of the grid that are run at a time until they find no new motion
PEAK = Column("tension_top_max_N", "N", "T_max", "largest tension at the top of the line in its motion", 0)
COLUMNS = (*KICKS, MOTION, OUTCOME, STATUS, PERIODS_RUN, PEAK, RUN_KEY, MESSAGE)


class Exploration:
    """The motions of a scene, found in turn by the start from rest, a massless tether, and starts of the grid."""

    def __init__(self, plan: Plan, job: Job, grid: StartGrid, search: Search):
        self.plan, self.job, self.grid, self.search, self.scene = plan, job, grid, search, job.scene
        self.places = Motions(plan, (STEEPNESS,), lambda place: {}, folder="motions")
        self.starts = self.places.starts
        self.endings: dict[int, Ending] = {}  # of the starts of the grid, by number
        self.computed = 0  # starts of the grid that were not there before

    @property
    def motions(self) -> list[Motion]:
        """As found; the first is that from rest."""
        return self.places.at[0]

    def find(self) -> None:
        """Find the motions, and where the starts of the grid end. Raises as `runner.run`."""
        places, search = self.places, self.search
        propose(places, run_from_rest(places, [self.job]), search)
        waiting, points = list(self.grid.spread(search.seed)), self.grid.points()
        while waiting:
            count = len(self.motions)
            self._run("starts spread over the grid", waiting[:SAMPLE], points, fine=True)
            waiting = waiting[SAMPLE:]
            if len(self.motions) == count:
                break
            judge(places, search)  # what they found is known better, and the next starts join it
        self._run("all other starts of the grid", waiting, points)
        places.kicks = len(points)
        judge(places, search)
        name(places)

    def _run(self, title: str, numbers: Sequence[int], points: Sequence, fine: bool = False) -> None:
        """Run starts of the grid. fine: with as many samples as judged runs have."""
        computed_before, starts = self.starts.computed, []
        for number in numbers:
            start = self.grid.start(*points[number])
            if fine:
                start = self.places.fine(0, start)
            starts.append((0, start))
        for motion in self.places.run_starts(title, starts, coarse_first=not fine):
            if motion is not None:
                motion.kicks += 1
        self.computed += self.starts.computed - computed_before
        latest = self.starts.endings[len(self.starts.endings) - len(numbers) :]
        self.endings |= dict(zip(numbers, latest, strict=True))

    def request(self, start: Start, scene=None, **options) -> Request:
        """A start of the scene, or of another one with the same motions. options: fields of `Request`."""
        name = self.places.name_of(0)
        return Request(name, scene or self.scene, start, settled_in(self.motions), **options)

    def motion_of(self, ending: Ending) -> Motion | None:
        """The motion in which a start has ended that `find` did not run; None for one that it has not found."""
        number = None
        if ending.row.get("outcome") == JOINED:
            number = ending.joins
        elif ending.settled is not None:
            number = ending.same_as(settled_in(self.motions))
        if number is not None:
            ending.motion = self.motions[number]
        return ending.motion

    def runs_within(self, folder: str, title: str, jobs: list[Job]) -> list:
        """Do runs in a folder beside that of the starts; their Trajectories, None for one that ended early."""
        running = replace(self.plan.how, out=self.plan.how.out / folder)
        with claimed(running.out):
            timing, summary = run(replace(self.plan, how=running, title=title), jobs)
        self.places.times.update(timing)
        rows, trajectories = summary.by_key, []
        for job in jobs:
            row = rows.get(job.key)
            trajectories.append(row and run_of(running.out, row))
        return trajectories

    def rows(self) -> Iterator[dict[str, object]]:
        """The rows of COLUMNS."""
        shown = names(COLUMNS)
        for number in range(len(self.endings)):
            ending = self.endings[number]
            row = {name: entry for name, entry in ending.row.items() if name in shown}
            row |= {"motion": None, PEAK.name: None}
            motion = ending.motion
            if motion is not None:
                row |= {"motion": motion.branch.letter, PEAK.name: self.places.row_of(motion).get(PEAK.name)}
            yield row
