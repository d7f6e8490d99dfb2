"""The motions of many places (`campaigns.explore.grid`): what is known of each, and how more of them are found.

The stages that find them are in `campaigns.explore.stages`. A motion at one place that, carried to a neighbour, becomes
a motion there which becomes it in turn, is one branch with that, and has one letter.
"""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain
from pathlib import Path
from typing import NamedTuple

from analysis import grouped, share_of
from campaigns.explore.coarse import coarse_endings
from campaigns.explore.starts import FOUND_BY, Ending, Request, Start, Starts, run_within
from campaigns.judge import samples_of
from campaigns.machinery import Jobs, Plan, Summary, orbits_in, run_of
from campaigns.study import Order
from tables import REGIMES, SHEET, Column, Columns, Row, of_words, write_table

MOTION = of_words("motion", "letter of the motion, the same along a branch over the values")
MOTIONS = (
    MOTION,
    Column("share", "", "share", "share of the kicks at this value that end in the motion", 2),
    Column("share_low", "", "share ≥", "lower end of its 95 % interval (Wilson) for independent kicks", 2, REGIMES),
    Column("share_high", "", "share ≤", "upper end of its 95 % interval (Wilson) for independent kicks", 2, REGIMES),
    Column("kicks", "", "kicks", "kicks at this value, of which the share is", 0, SHEET),
    FOUND_BY,
    Column(
        "confirmed",
        "",
        "confirmed",
        "whether its branch stays at a tenth of the tolerance and on a finer grid",
        None,
        SHEET,
    ),
)
UP, DOWN = 1, -1
FROM_REST, CARRIED, KICKED = "rest", {UP: "carried up", DOWN: "carried down"}, "kick"


def from_rest(row) -> bool:
    """Whether a row of a table is that of a run as its scene begins."""
    return row.get("found_by") in (None, "", FROM_REST)


class Search(NamedTuple):
    """How motions are looked for.

    order: of which the judged runs are.
    kicks: at each place, besides the run from rest.
    speed_mps: of a kick along x and z, at most; None: by the waves (`kick_speed_mps`).
    seed: of the kicks.
    most: wave periods of a judged run, as of `campaigns.judge.judged_job`.
    """

    order: Order
    kicks: int
    speed_mps: float | None
    seed: int
    most: int | None = None


@dataclass(eq=False)
class Motion:
    """A motion at one place.

    place: its number.
    settled: what it has settled to (`analysis.Settled`).
    state: its last state.
    found_by: the start that found it.
    kicks: how many ended in it.
    becomes: by neighbour the motion that it becomes there; None: none that settled.
    branch: the first motion of its branch, which has the letter of all.
    confirmed: of a branch, at the value of its largest tension.
    """

    place: int
    settled: object
    state: object
    found_by: str
    kicks: int = 0
    becomes: dict[int, "Motion | None"] = field(default_factory=dict, repr=False)
    branch: "Motion | None" = field(default=None, repr=False)
    letter: str = ""
    confirmed: str = ""

    @property
    def tension_N(self) -> float:
        """Its largest tension while it settled."""
        return float(self.settled.measures[:, 2].max())

    @property
    def order(self) -> tuple[int, str]:
        """Its place among the motions of its place, by letter."""
        return len(self.branch.letter), self.branch.letter


def settled_in(motions: Sequence[Motion]) -> tuple:
    """What each of these motions has settled to."""
    return tuple(motion.settled for motion in motions)


def in_a_row(count: int) -> Callable:
    """The neighbours of a place of a sweep over one key: the next value up, and the next one down."""

    def neighbours(place):
        return {place + step: found_by for step, found_by in CARRIED.items() if 0 <= place + step < count}

    return neighbours


class Motions:
    """The motions of the places of a grid, by number of the place.

    plan: of the campaign.
    keys: columns that name a place.
    neighbours: the places beside a place, and what a start there is called that takes up a motion of this one.
    match_distance: a motion becomes, without a run, one at a neighbour of its period that is nearer than this
    (`analysis.distance`).
    folder: of the judged runs, within that of the campaign; "": that itself.
    """

    def __init__(
        self,
        plan: Plan,
        keys: Columns,
        neighbours: Callable,
        match_distance: float = 0.0,
        folder: str = "",
    ):
        self.plan, self.keys, self.neighbours, self.match_distance = plan, tuple(keys), neighbours, match_distance
        self.folder = plan.out / folder  # "" adds nothing
        self.orbits = orbits_in(self.folder)
        self.starts = Starts(plan, (*self.keys, MOTION))
        self.kicks = 0  # at each place
        self.jobs = []  # the runs from rest, by place
        self.at = []  # the motions, by place
        self.job_keys = {}  # of the judged runs, by motion
        self.rows = {}  # of judged runs, by key
        self.times = Counter()
        self.computed = set()  # keys of the judged runs that were computed, or went on

    def add(self, jobs: Jobs) -> range:
        """Add the places of these runs from rest; returns their numbers."""
        first = len(self.jobs)
        self.jobs += jobs
        self.at += [[] for _ in jobs]
        return range(first, len(self.jobs))

    def all_motions(self) -> Iterator[Motion]:
        """All motions, place by place."""
        return chain.from_iterable(self.at)

    def name_of(self, place: int) -> Row:
        """The columns that name a place."""
        labels = self.jobs[place].labels
        return {key.name: labels[key.name] for key in self.keys}

    def judged_runs(self, title: str, jobs: Jobs, ahead: Jobs = ()) -> None:
        """Do judged runs, and keep their rows. ahead: as of `runner.run`, which says what this raises."""
        if not jobs:
            return
        summary = run_within(self.plan, self.folder, jobs, ahead, title=title)
        self.times.update(summary.times)
        self.computed |= summary.made
        self.rows |= summary.by_key

    def judged_run(self, key: str):
        """The Trajectory of a judged run; None where it has not ended as asked."""
        row = self.rows.get(key)
        return row and run_of(self.folder, row)

    def fine(self, place: int, start: Start) -> Start:
        """The start with as many samples as a run of its place, which then takes up its last state to the moment."""
        scene = self.jobs[place].scene
        return replace(start, often=samples_of(scene, 1))

    def run_starts(
        self,
        title: str,
        starts: Sequence[tuple],
        beside: Callable | None = None,
    ) -> list[Motion | None]:
        """Run starts at places; returns the motion in which each ended, None where it did not settle.

        beside: the numbers of the starts beside a start. Where it is given, a coarse line is asked first
        (`campaigns.explore.coarse`). Starts beside one that ends in another motion then run on the line itself.
        """
        coarse = {}
        if beside is not None:
            coarse = coarse_endings(self, title, starts)
        endings = dict(coarse)
        waiting = [number for number in range(len(starts)) if number not in coarse]
        while True:
            requests = [self.request(*starts[number]) for number in waiting]
            for number, ending in zip(waiting, self.starts.run(title, requests, listed=False), strict=True):
                place, start = starts[number]
                ending.motion = self.known(place, ending)
                if ending.motion is None and ending.settled is not None:
                    ending.motion = Motion(place, ending.settled, ending.state, start.found_by)
                    self.at[place].append(ending.motion)
                endings[number] = ending
            waiting = []
            for number in coarse:
                if any(endings[other].motion is not endings[number].motion for other in beside(number)):
                    waiting.append(number)
            if not waiting:
                break
            for number in waiting:
                del coarse[number]
        in_order = [endings[number] for number in range(len(starts))]
        self.starts.endings += in_order
        return [ending.motion for ending in in_order]

    def request(self, place: int, start: Start, scene=None, **options) -> Request:
        """A start in the scene of a place, or in another one with the same motions. options: fields of `Request`."""
        scene = scene or self.jobs[place].scene
        return Request(self.name_of(place), scene, start, settled_in(self.at[place]), **options)

    def known(self, place: int, ending: Ending) -> Motion | None:
        """The known motion in which a start at a place has ended; None where it has not settled, or on another one."""
        motions = self.at[place]
        if ending.joins is not None:
            return motions[ending.joins]  # new motions stand behind those it may join
        if ending.settled is None:
            return None
        *labels, label = grouped([*settled_in(motions), ending.settled]).tolist()
        return motions[labels.index(label)] if label in labels else None

    def branches(self) -> list[list]:
        """The motions of each branch, by place."""
        members = {}  # by the first motion of a branch
        for motion in self.all_motions():
            members.setdefault(motion.branch, []).append(motion)
        return [*members.values()]

    def labels(self, motion: Motion) -> Row:
        """The columns MOTIONS of a motion."""
        labels = {"motion": motion.branch.letter, "found_by": motion.found_by}
        if self.kicks:
            share = share_of(motion.kicks, self.kicks)
            labels |= {"share": share.share, "share_low": share.low, "share_high": share.high, "kicks": self.kicks}
        return labels | {"confirmed": motion.branch.confirmed or None}

    def row_of(self, motion: Motion) -> dict:
        """The row of the judged run of a motion; {} where there is none yet."""
        return self.rows.get(self.job_keys.get(motion), {})

    def table(self) -> list[Row]:
        """A row for each motion, by place and letter; of a place whose run from rest has no motion, also that run's."""
        rows = []
        for job, motions in zip(self.jobs, self.at, strict=True):
            starts = {motion.found_by for motion in motions}
            if job.key in self.rows and FROM_REST not in starts:
                rows.append({**self.rows[job.key], **job.labels})
            for motion in sorted(motions, key=lambda motion: motion.order):
                rows.append({**self.row_of(motion), **job.labels, **self.labels(motion)})
        return rows

    def write(self) -> Summary:
        """Write table.csv, and that of the starts; returns the summary of the rows, with the times of all runs.

        Raises OSError.
        """
        rows = self.table()
        write_table(self.folder / "table.csv", self.plan.columns, rows)
        if self.starts.endings:
            self.starts.write()
        reused = sum(row.get("run_key") not in self.computed for row in rows)
        return Summary(rows, reused, len(rows) - reused, self.times + self.starts.times)


def subfolder(plan: Plan, name: str) -> Path:
    """A folder within that of a campaign. Raises OSError."""
    folder = plan.out / name
    folder.mkdir(exist_ok=True)
    return folder


def write_part(plan: Plan, name: str, columns: Columns, rows: Iterable[Row]) -> Path:
    """Write table.csv in a folder within that of a campaign; returns the folder. Raises OSError."""
    folder = subfolder(plan, name)
    write_table(folder / "table.csv", columns, rows)
    return folder
