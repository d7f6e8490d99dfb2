"""The motions of every value of a sweep over one key, or of every cell of a map over several.

1. The run from rest of each value is a motion. 2. Starts on the motions of a massless tether, at each value, find
others, islands among them. 3. Every motion is carried to all neighbours: their scenes take its state up. 4. Kicks at
each value, drawn independently and uniformly: the share of them that ends in a motion estimates the size of its basin.
What they find is carried on too.
Two motions at neighbouring values are one branch where each, carried to the other, becomes the other.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from string import ascii_uppercase

from campaigns.explore.proposals import kicks, proposals
from campaigns.explore.starts import FOUND_BY, Asked, Ended, Start, Starts, as_it_is, settled_of
from campaigns.machinery.folder import run_of
from campaigns.machinery.plan import Job, Plan
from campaigns.machinery.store import orbits_in
from tables import REGIMES, SHEET, Column

MOTION = Column("motion", symbol="motion", meaning="letter of the motion, the same along a branch over the values")
MOTIONS = (
    MOTION,
    Column("share", "", "share", "share of the kicks at this value that end in the motion", 2),
    Column(
        "share_low", "", "share ≥", "lower end of its 95 % interval (Wilson), for kicks drawn independently", 2, REGIMES
    ),
    Column(
        "share_high",
        "",
        "share ≤",
        "upper end of its 95 % interval (Wilson), for kicks drawn independently",
        2,
        REGIMES,
    ),
    Column("kicks", "", "kicks", "kicks at this value, of which the share is", 0, SHEET),
    FOUND_BY,
    Column(
        "confirmed",
        symbol="confirmed",
        meaning="whether its branch stays at a tenth of the tolerance and on a finer grid",
        page=SHEET,
    ),
)
UP, DOWN = 1, -1
FROM_REST, CARRIED, KICKED = "rest", {UP: "carried up", DOWN: "carried down"}, "kick"


def from_rest(row: Mapping) -> bool:
    """Whether a row of a table is that of a run as its scene begins."""
    return row.get("found_by") in (None, "", FROM_REST)


@dataclass(eq=False)
class Motion:
    """A motion at one place: number of the place, what it has settled to, its last state, the start that found it.

    kicks: how many ended in it. led: the motion that it becomes at a place beside it; None: none that settled.
    branch: the first motion of its branch. confirmed: of a branch, at the value of its largest tension.
    """

    at: int
    settled: object
    state: object
    found_by: str
    kicks: int = 0
    led: dict[int, "Motion | None"] = field(default_factory=dict, repr=False)
    branch: "Motion | None" = field(default=None, repr=False)
    letter: str = ""
    confirmed: str = ""

    @property
    def tension_N(self) -> float:
        """Its largest tension while it settled."""
        return float(self.settled.measures[:, 2].max())


class Lattice:
    """The motions of many scenes, by number of the place: a place has others beside it, whose scenes differ little.

    keys: columns that name a place. like: a motion leads without a run to one beside it of its period that is nearer
    than this (`analysis.distance`).
    """

    like = 0.0

    def __init__(self, plan: Plan, keys: tuple[Column, ...]):
        self.plan, self.keys = plan, keys
        self.starts = Starts(plan, (*keys, MOTION))
        self.kicked = 0
        self.names: list[dict] = []
        self.scenes: list = []
        self.motions: list[list[Motion]] = []

    def beside(self, at: int) -> dict[int, str]:
        """The places beside one, and what a start there is called that takes up a motion of this one."""
        raise NotImplementedError

    def add(self, jobs: Sequence[Job], rows: Sequence[dict]) -> range:
        """Add the places of runs from rest; rows: of those that have ended. Returns their numbers."""
        orbits = orbits_in(self.plan.how.out)
        before, by_key = len(self.scenes), {row["run_key"]: row for row in rows}
        for at, job in enumerate(jobs, before):
            self.names.append({key.name: job.labels[key.name] for key in self.keys})
            self.scenes.append(job.scene)
            self.motions.append([])
            run = run_of(self.plan.how.out, by_key[job.key]) if job.key in by_key else None
            if run is not None:
                settled = settled_of(run, orbits) or as_it_is(run)
                self.motions[at].append(Motion(at, settled, run.final_state, FROM_REST))
        return range(before, len(self.scenes))

    def find(self, kick_count: int, speed_mps: float, seed: int, places: range | None = None) -> None:
        """Find the motions of places, of all by default, as told at the head of this file. Raises as `runner.run`."""
        places = range(len(self.scenes)) if places is None else places
        proposed = zip(places, proposals(self.plan, [self.scenes[at] for at in places], speed_mps, seed), strict=True)
        self.round(
            "starts on motions of a massless tether",
            [(at, self.fine(at, one)) for at, some in proposed for one in some],
        )
        self.carry()
        self.kicked = kick_count
        if kick_count:
            asked = [(at, Start(KICKED, kick)) for at in places for kick in kicks(kick_count, speed_mps, seed, at)]
            ended = self.round("kicks", asked)
            for motion in filter(None, ended):
                motion.kicks += 1
            # few samples are enough to tell a motion, not to take up its state without a shift in the wave
            new = {
                motion: one for one, motion in zip(asked, ended, strict=True) if motion and motion.found_by == KICKED
            }
            for motion, again in zip(new, self.again(list(new.values())), strict=True):
                motion.state = again.state or motion.state
            self.carry()

    def fine(self, at: int, start: Start) -> Start:
        """The start with as many samples as a run of its place, which then takes up its last state to the moment."""
        scene = self.scenes[at]
        return replace(start, often=round(scene.waves.period_s / scene.sample_step_s()))

    def again(self, asked: Sequence[tuple[int, Start]]) -> list[Ended]:
        """Starts that have settled once more, with more samples."""
        fine = (Asked(self.names[at], self.scenes[at], self.fine(at, start)) for at, start in asked)
        return self.starts.run("kicks that found a motion", list(fine), told=False)

    def carry(self) -> None:
        """Carry every motion to the places beside it where it has not been, and what is found there further."""
        while True:
            asked = []
            for motion in (one for some in self.motions for one in some if one.state is not None):
                for there, how in self.beside(motion.at).items():
                    if there not in motion.led and (same := self._alike(motion, there)) is not None:
                        motion.led[there] = same
                    elif there not in motion.led:
                        asked.append((motion, there, Start(how, state=motion.state.at_zero())))
            if not asked:
                return
            starts = [(there, self.fine(there, start)) for _, there, start in asked]
            ended = self.round("motions carried to the next value", starts)
            for (motion, there, _), led in zip(asked, ended, strict=True):
                motion.led[there] = led

    def _alike(self, motion: Motion, there: int) -> Motion | None:
        """The nearest motion of the same period at a place that is nearer than `like`."""
        if not self.like:
            return None
        from analysis import distance

        same = (one for one in self.motions[there] if one.settled.period == motion.settled.period)
        near = {one: distance(motion.settled, one.settled) for one in same}
        return min((one for one in near if near[one] < self.like), key=near.get, default=None)

    def round(self, said: str, asked: Sequence[tuple[int, Start]]) -> list[Motion | None]:
        """Run starts at values by number; returns the motion in which each ended, None where it did not settle."""
        known = [tuple(motion.settled for motion in some) for some in self.motions]
        before = [list(some) for some in self.motions]
        found = self.starts.run(
            said,
            [Asked(self.names[at], self.scenes[at], start, known[at]) for at, start in asked],
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

    def beside_rest(self, jobs: Sequence[Job]) -> Iterator[tuple[Motion, Job]]:
        """The motions to which no run from rest leads, each with that of its place. jobs: runs from rest, by place."""
        for job, some in zip(jobs, self.motions, strict=True):
            yield from ((motion, job) for motion in some if motion.found_by != FROM_REST)

    def judged(self, jobs: Mapping[Motion, Job], rows: Sequence[dict]) -> None:
        """Take motions as their judged runs have them (`merge`); rows: of those that have ended."""
        ended = {row["run_key"]: row for row in rows}
        runs = {motion: run_of(self.plan.how.out, ended[job.key]) for motion, job in jobs.items() if job.key in ended}
        orbits = orbits_in(self.plan.how.out)
        ended_runs = {motion: run for motion, run in runs.items() if run is not None}
        self.merge({motion: settled_of(run, orbits) or as_it_is(run) for motion, run in ended_runs.items()})

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
            motion.led = {there: None if led is None else became[led] for there, led in motion.led.items()}
        for one in self.starts.ended:
            one.motion = became.get(one.motion)

    def name(self) -> None:
        """Give every branch its letter: A to the one that begins at the first place, from rest where two do."""
        from analysis import matched

        order = [one for some in self.motions for one in sorted(some, key=lambda one: one.found_by != FROM_REST)]
        members: dict[Motion, dict[int, Motion]] = {one: {one.at: one} for one in order}  # of a branch, by place
        for at, some in enumerate(self.motions):
            for there in sorted(place for place in self.beside(at) if place > at):
                more = self.motions[there]
                _guess(some, more, at, there)
                _guess(more, some, there, at)
                alone = (
                    [one for one in some if one.led.get(there) is None],
                    [one for one in more if not one.led.get(at)],
                )
                for one, which in zip(alone[0], matched(*([m.settled for m in side] for side in alone)), strict=True):
                    if which is not None:  # carried, these two did not settle: the nearest one continues it
                        one.led[there], alone[1][which].led[at] = alone[1][which], one
                for one in some:
                    other = one.led.get(there)
                    if other is None or other.led.get(at) is not one or members[one] is members[other]:
                        continue
                    if members[one].keys().isdisjoint(members[other]):  # round a cusp a motion meets another one
                        members[one].update(members[other])
                        members.update(dict.fromkeys(members[other].values(), members[one]))
        first: dict[int, Motion] = {}
        for motion in order:
            branch = first.setdefault(id(members[motion]), motion)
            if branch is motion:
                round_, letter = divmod(len(first) - 1, len(ascii_uppercase))
                branch.letter = ascii_uppercase[letter] + (str(round_ + 1) if round_ else "")
            motion.branch = branch

    def branches(self) -> Iterator[list[Motion]]:
        """The motions of each branch, by value."""
        found: dict[Motion, list[Motion]] = {}
        for motion in (one for some in self.motions for one in some):
            found.setdefault(motion.branch, []).append(motion)
        yield from found.values()

    def labels(self, motion: Motion) -> dict[str, object]:
        """The columns MOTIONS of a motion."""
        found: dict[str, object] = {"motion": motion.branch.letter, "found_by": motion.found_by}
        if self.kicked:
            from analysis import share_of

            share = share_of(motion.kicks, self.kicked)
            found |= {"share": share.share, "share_low": share.low, "share_high": share.high, "kicks": self.kicked}
        return found | {"confirmed": motion.branch.confirmed or None}


class Along(Lattice):
    """The motions of a sweep, by number of the value: a value has the next one up and the next one down beside it.

    key: column of its values; jobs: its runs from rest, by value; scene_at(value): the scene of any value; rows: of the
    runs that have ended.
    """

    def __init__(self, plan: Plan, key: Column, jobs: Sequence[Job], scene_at: Callable, rows: Sequence[dict]):
        super().__init__(plan, (key,))
        self.key, self.scene_at = key, scene_at
        self.values = [job.labels[key.name] for job in jobs]
        self.add(jobs, rows)

    def beside(self, at: int) -> dict[int, str]:
        """`Lattice.beside`."""
        return {at + step: how for step, how in CARRIED.items() if 0 <= at + step < len(self.values)}


def _guess(some: Sequence[Motion], others: Sequence[Motion], at: int, there: int) -> None:
    """Lead a motion that did not settle at the next place to the one there that leads to it, if there is but one."""
    for motion in some:
        back = [other for other in others if other.led.get(at) is motion]
        if motion.led.get(there) is None and len(back) == 1:
            motion.led[there] = back[0]
