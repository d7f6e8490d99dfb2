"""The motions of every value of a sweep over one key.

1. The run from rest of each value is a motion. 2. Starts on the motions of a massless tether, at each value, find
others, islands among them. 3. Every motion is carried to both neighbours: their scenes take its state up. 4. Kicks at
each value: the share of them that ends in a motion is the size of its basin. What they find is carried on too.
Two motions at neighbouring values are one branch where each, carried to the other, becomes the other.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from string import ascii_uppercase

from campaigns.columns import Column
from campaigns.machinery.folder import run_of
from campaigns.machinery.plan import Job, Plan
from campaigns.motions.proposals import kicks, proposals
from campaigns.motions.starts import FOUND_BY, Asked, Ended, Start, Starts, as_it_is, settled_of

MOTION = Column("motion", symbol="motion", meaning="letter of the motion, the same along a branch over the values")
MOTIONS = (
    MOTION,
    Column("share", "", "share", "share of the kicks at this value that end in the motion", 2),
    Column("share_low", "", "share ≥", "lower end of the 95 % interval of the share (Wilson)", 2),
    Column("share_high", "", "share ≤", "upper end of the 95 % interval of the share (Wilson)", 2),
    FOUND_BY,
    Column(
        "confirmed",
        symbol="confirmed",
        meaning="whether its branch stays at a tenth of the tolerance and on a finer grid",
    ),
)
UP, DOWN = 1, -1
FROM_REST, CARRIED, KICKED = "rest", {UP: "carried up", DOWN: "carried down"}, "kick"


def from_rest(row: Mapping) -> bool:
    """Whether a row of a table is that of a run as its scene begins."""
    return row.get("found_by") in (None, "", FROM_REST)


@dataclass(eq=False)
class Motion:
    """A motion at one value: number of the value, what it has settled to, its last state, the start that found it.

    kicks: how many ended in it. led: the motion that it becomes at the next value up and down; None: none that settled.
    branch: the first motion of its branch. confirmed: of a branch, at the value of its largest tension.
    """

    at: int
    settled: object
    state: object
    found_by: str
    kicks: int = 0
    led: dict[int, "Motion | None"] = field(default_factory=dict)
    branch: "Motion | None" = None
    letter: str = ""
    confirmed: str = ""

    @property
    def tension_N(self) -> float:
        """Its largest tension while it settled."""
        return float(self.settled.measures[:, 2].max())


class Along:
    """The motions of a sweep, by number of the value.

    key: column of its values; jobs: its runs from rest, by value; scene_at(value): the scene of any value; rows: of the
    runs that have ended.
    """

    def __init__(self, plan: Plan, key: Column, jobs: Sequence[Job], scene_at: Callable, rows: Sequence[dict]):
        self.plan, self.key, self.scene_at = plan, key, scene_at
        self.values, self.scenes = [job.labels[key.name] for job in jobs], [job.scene for job in jobs]
        self.starts = Starts(plan, (key, MOTION))
        self.kicked = 0
        self.motions: list[list[Motion]] = [[] for _ in jobs]
        by_key = {row["run_key"]: row for row in rows}
        for at, job in enumerate(jobs):
            run = run_of(plan.how.out, by_key[job.key]) if job.key in by_key else None
            if run is not None:
                self.motions[at].append(Motion(at, settled_of(run) or as_it_is(run), run.final_state, FROM_REST))

    def find(self, kick_count: int, speed_mps: float, seed: int) -> None:
        """Find the motions of all values, as told at the head of this file. Raises as `runner.run`."""
        proposed = enumerate(proposals(self.plan, self.scenes, speed_mps, seed))
        self.round(
            "starts on motions of a massless tether",
            [(at, self.fine(at, one)) for at, some in proposed for one in some],
        )
        self.carry()
        if kick_count:
            points = kicks(kick_count * len(self.values), speed_mps, seed).reshape(len(self.values), kick_count, 2)
            asked = [(at, Start(KICKED, tuple(map(float, kick)))) for at, some in enumerate(points) for kick in some]
            ended = self.round("kicks", asked)
            for motion in filter(None, ended):
                motion.kicks += 1
            self.kicked = kick_count
            # few samples are enough to tell a motion, not to take up its state without a shift in the wave
            new = {
                motion: one for one, motion in zip(asked, ended, strict=True) if motion and motion.found_by == KICKED
            }
            for motion, again in zip(new, self.again(list(new.values())), strict=True):
                motion.state = again.state or motion.state
            self.carry()

    def fine(self, at: int, start: Start) -> Start:
        """The start with as many samples as a run of its value, which then takes up its last state to the moment."""
        scene = self.scenes[at]
        return replace(start, often=round(scene.waves.period_s / scene.sample_step_s()))

    def again(self, asked: Sequence[tuple[int, Start]]) -> list[Ended]:
        """Starts that have settled once more, with more samples."""
        fine = (Asked({self.key.name: self.values[at]}, self.scenes[at], self.fine(at, start)) for at, start in asked)
        return self.starts.run("kicks that found a motion", list(fine), told=False)

    def carry(self) -> None:
        """Carry every motion to its neighbours that has not been carried there, and what is found there further."""
        while True:
            asked = [
                (motion, step)
                for some in self.motions
                for motion in some
                for step in (UP, DOWN)
                if step not in motion.led and 0 <= motion.at + step < len(self.values) and motion.state is not None
            ]
            if not asked:
                return
            places = [one.at + step for one, step in asked]
            states = [Start(CARRIED[step], state=one.state.at_zero()) for one, step in asked]
            starts = [(at, self.fine(at, start)) for at, start in zip(places, states, strict=True)]
            for (motion, step), led in zip(asked, self.round("motions carried to the next value", starts), strict=True):
                motion.led[step] = led

    def round(self, said: str, asked: Sequence[tuple[int, Start]]) -> list[Motion | None]:
        """Run starts at values by number; returns the motion in which each ended, None where it did not settle."""
        known = [tuple(motion.settled for motion in some) for some in self.motions]
        before = [list(some) for some in self.motions]
        found = self.starts.run(
            said,
            [Asked({self.key.name: self.values[at]}, self.scenes[at], start, known[at]) for at, start in asked],
        )
        ended = []
        for (at, start), one in zip(asked, found, strict=True):
            motion = None
            if one.joins is not None:
                motion = before[at][one.joins]
            elif one.settled is not None:
                same = one.same_as([other.settled for other in self.motions[at]])
                if same is None:
                    self.motions[at].append(Motion(at, one.settled, one.state, start.found_by))
                motion = self.motions[at][-1 if same is None else same]
            one.motion = motion
            ended.append(motion)
        return ended

    def merge(self, judged: Mapping[Motion, object]) -> None:
        """Take motions of one value as one that longer runs have found to be one. judged: what these settled to."""
        from analysis import grouped

        became: dict[Motion, Motion] = {}
        for at, some in enumerate(self.motions):
            for motion in some:
                motion.settled = judged.get(motion, motion.settled)
            kept: dict[int, Motion] = {}
            for label, motion in zip(grouped([one.settled for one in some]), some, strict=True):
                became[motion] = kept.setdefault(int(label), motion)
                if became[motion] is not motion:
                    became[motion].kicks += motion.kicks
            self.motions[at] = list(kept.values())
        for motion in became:
            motion.led = {step: None if led is None else became[led] for step, led in motion.led.items()}
        for one in self.starts.ended:
            one.motion = became.get(one.motion)

    def name(self) -> None:
        """Give every branch its letter: A to the one that begins at the lowest value, from rest where two do."""
        from analysis import matched

        for some, more in pairwise(self.motions):
            _guess(some, more, UP)
            _guess(more, some, DOWN)
            alone = [one for one in some if one.led.get(UP) is None], [one for one in more if one.led.get(DOWN) is None]
            for one, which in zip(alone[0], matched(*([m.settled for m in side] for side in alone)), strict=True):
                if which is not None:  # carried, these two did not settle: the nearest one continues it
                    one.led[UP], alone[1][which].led[DOWN] = alone[1][which], one
        branches = []
        for some in self.motions:
            for motion in sorted(some, key=lambda one: one.found_by != FROM_REST):
                before = motion.led.get(DOWN)
                one_branch = before is not None and before.led.get(UP) is motion
                motion.branch = before.branch if one_branch else motion
                if not one_branch:
                    branches.append(motion)
        for number, first in enumerate(branches):
            round_, letter = divmod(number, len(ascii_uppercase))
            first.letter = ascii_uppercase[letter] + (str(round_ + 1) if round_ else "")

    def branches(self) -> Iterator[list[Motion]]:
        """The motions of each branch, by value."""
        for first in (one for some in self.motions for one in some if one.branch is one):
            yield [one for some in self.motions for one in some if one.branch is first]

    def labels(self, motion: Motion) -> dict[str, object]:
        """The columns MOTIONS of a motion."""
        found: dict[str, object] = {"motion": motion.branch.letter, "found_by": motion.found_by}
        if self.kicked:
            from analysis import share_of

            share = share_of(motion.kicks, self.kicked)
            found |= {"share": share.share, "share_low": share.low, "share_high": share.high}
        return found | {"confirmed": motion.branch.confirmed or None}


def _guess(some: Sequence[Motion], others: Sequence[Motion], step: int) -> None:
    """Lead a motion that did not settle at the next value to the one there that leads to it, if there is but one."""
    for motion in some:
        back = [other for other in others if other.led.get(-step) is motion]
        if motion.led.get(step) is None and len(back) == 1:
            motion.led[step] = back[0]
