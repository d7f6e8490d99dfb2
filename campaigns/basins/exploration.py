"""The motions of one scene, and the motion in which each start of a grid ends."""

from collections.abc import Callable, Sequence

from campaigns.basins.grid import StartGrid
from campaigns.explore.grid import STEEPNESS
from campaigns.explore.motions import MOTION, Motion, Motions, Search
from campaigns.explore.stages import judge, name, propose, run_from_rest
from campaigns.explore.starts import KICKS, OUTCOME, Ending, Start
from campaigns.machinery import Job, Plan, Summary
from tables import MESSAGE, PERIODS_RUN, RUN_KEY, STATUS, Column, write_table

SAMPLE = 24  # starts of the grid that are run at a time until they find no new motion
PEAK = Column("tension_top_max_N", "N", "T_max", "largest tension at the top of the line in its motion", 0)
COLUMNS = (*KICKS, MOTION, OUTCOME, STATUS, PERIODS_RUN, PEAK, RUN_KEY, MESSAGE)


class Exploration(Motions):
    """The motions of a scene, found in turn by the start from rest, a massless tether, and starts of the grid."""

    def __init__(self, plan: Plan, grid: StartGrid):
        super().__init__(plan, (STEEPNESS,), lambda place: {}, folder="motions")
        self.grid = grid
        self.endings = {}  # of the starts of the grid, by number

    @property
    def motions(self) -> list[Motion]:
        """As found; the first is that from rest."""
        return self.at[0]

    @property
    def scene(self):
        """That of all starts."""
        return self.jobs[0].scene

    def find(self, job: Job, search: Search) -> None:
        """Find the motions, and where the starts of the grid end; job: the run from rest. Raises as `runner.run`."""
        propose(self, run_from_rest(self, [job]), search)
        waiting, points = list(self.grid.spread(search.seed)), self.grid.points()
        while waiting:
            count = len(self.motions)
            self._run("starts spread over the grid", waiting[:SAMPLE], points, fine=True)
            waiting = waiting[SAMPLE:]
            if len(self.motions) == count:
                break
            judge(self, search)  # what they found is known better, and the next starts join it
        self._run("all other starts of the grid", waiting, points)
        self.kicks = len(points)
        judge(self, search)
        name(self)

    def _run(self, title: str, numbers: Sequence[int], points: Sequence, fine: bool = False) -> None:
        """Run starts of the grid. fine: with as many samples as judged runs have."""
        starts, beside = [], None
        for number in numbers:
            start = self.grid.start(*points[number])
            if fine:
                start = self.fine(0, start)
            starts.append((0, start))
        if not fine:
            beside = self._beside(numbers)
        for motion in self.run_starts(title, starts, beside):
            if motion is not None:
                motion.kicks += 1
        latest = self.starts.endings[len(self.starts.endings) - len(numbers) :]
        self.endings |= dict(zip(numbers, latest, strict=True))

    def _beside(self, numbers: Sequence[int]) -> Callable:
        """For each of these starts of the grid, by its place in the list, the places of those beside it."""
        places = {number: place for place, number in enumerate(numbers)}

        def beside(place):
            return [places[number] for number in self.grid.beside(numbers[place]) if number in places]

        return beside

    def run(self, title: str, starts: Sequence[Start], scene=None, **options) -> list[Ending]:
        """Run starts that are not of the grid, with the known motions in which they end. Else as `Motions.request`."""
        endings = self.starts.run(title, [self.request(0, start, scene, **options) for start in starts])
        for ending in endings:
            ending.motion = self.known(0, ending)
        return endings

    def write(self) -> Summary:
        """Write table.csv of the starts of the grid, and the tables of the motions; returns the summary of the starts.

        Raises OSError.
        """
        times, rows = super().write().times, []
        for _, ending in sorted(self.endings.items()):
            row, motion = {**ending.row, "motion": None, PEAK.name: None}, ending.motion
            if motion is not None:
                row |= {"motion": motion.branch.letter, PEAK.name: self.row_of(motion).get(PEAK.name)}
            rows.append(row)
        write_table(self.plan.out / "table.csv", COLUMNS, rows)
        computed = sum(row.get("run_key") in self.starts.computed for row in rows)
        return Summary(rows, len(rows) - computed, computed, times)
