"""All orbits that a campaign finds: those under its motions, their branches, and the branches that begin at flips."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import filterfalse, pairwise
from string import ascii_lowercase

import numpy as np

from campaigns.explore.tracing import STEPS, Line, Solved, finer, followed, line_task, sharper, under, work
from campaigns.machinery import Plan, Task
from engine.views import LONGEST_PERIOD

FOLDER = "branches"
SHARP = 1e-3  # of the range of the key: an event that is known worse is found again at a tenth of the tolerance
BESIDE = 0.02  # of the range of the key: an orbit so far from a fold is there on another grid, too
BEYOND = 2.0  # steps from the last orbit of a branch to the flip at which it meets another
NEAR, ON_CHORD = 0.01, 0.1  # of an orbit to a known branch: of what is seen, and shares of a chord


@dataclass(eq=False)
class Branch:
    """A branch with its name; motions: the letters of those that lie on it."""

    name: str
    result: dict
    points: list[np.ndarray]
    motions: list[str] = field(default_factory=list)

    @property
    def orbits(self) -> list[dict]:
        return self.result["orbits"]

    @property
    def events(self) -> list[dict]:
        return self.result["events"]

    def take(self, seed: "Seed") -> None:
        """Note that the orbit of a seed lies on the branch: its motion is one of it, and its flip leads to it."""
        if seed.motion and seed.motion not in self.motions:
            self.motions.append(seed.motion)
        seed.begins["leads_to"] = self.name


@dataclass(eq=False)
class Seed:
    """An orbit from which a branch is to be followed.

    motion: the letter of the motion on it, "" for that of a flip.
    value: of the key.
    period: in wave periods.
    seen: the orbit as it is compared with others, a row a strobe.
    points: its states.
    begins: the flip at which it begins; {} for that of a motion.
    """

    motion: str
    value: float
    period: int
    seen: Sequence = ()
    points: np.ndarray | None = None
    begins: dict = field(default_factory=dict)


class Tree:
    """The orbits of a line of scenes (`tracing.Line`).

    plan: where results are kept, and where work is done.
    most: orbits of a branch, each way.
    room: branches that are followed.
    """

    def __init__(self, plan: Plan, line: Line, most: int, room: int):
        self.plan, self.line, self.most, self.room = plan, line, most, room
        (plan.out / FOLDER).mkdir(exist_ok=True)
        self.branches = []
        self.chosen = []  # orbits with errors and history
        self.failed = []  # seeds of orbits without a branch, and why
        self.computed = self.there = 0

    def work(self, title: str, tasks: Sequence[Task]) -> list[Solved]:
        """Results of tasks, in their order. Raises CampaignStopped."""
        results, there = work(self.plan, self.plan.out / FOLDER, title, tasks)
        self.there, self.computed = self.there + there, self.computed + len(tasks) - there
        return results

    def grow(self, starts: Sequence[tuple]) -> None:
        """Follow the orbits under runs (motion, value, period, FinalState), and the branches that begin at flips."""
        seeds = self._seeds(starts)
        while seeds and len(self.branches) < self.room:
            following, seeds = self._next(list(filterfalse(self._is_known, seeds)))
            tasks = []
            for seed in following:
                tasks.append(line_task(followed, self.line, (seed.value, seed.points, self.most)))
            for seed, (result, points) in zip(following, self.work("branches", tasks), strict=True):
                if result.get("reason"):
                    self.failed.append((seed, result["reason"]))
                elif not self._is_known(seed):  # it may be found meanwhile from another orbit
                    seeds += self._add(seed, result, points)
        for seed in filterfalse(self._is_known, seeds):
            self.failed.append((seed, f"not followed: {self.room} branches are (--branches)"))
        self.failed = [failure for failure in self.failed if "leads_to" not in failure[0].begins]

    def beyond(self, starts: Sequence[tuple]) -> list[tuple]:
        """Runs (as of `grow`) at values that no stable orbits of their motion span, though it has a branch.

        One letter may stand for motions on several parts of a branch, or on several branches: the folds between them
        lie between the values of the search.
        """
        missed = []
        for start in starts:
            motion, value, period, _ = start
            branches = [branch for branch in self.branches if motion in branch.motions]
            branches = [branch for branch in branches if branch.orbits[0]["period"] == period]
            if branches and not any(_is_stable_at(branch, value) for branch in branches):
                missed.append(start)
        return missed

    def _next(self, seeds: Sequence[Seed]) -> tuple[list[Seed], list[Seed]]:
        """Seeds that are followed side by side, and the others.

        The first of each period, and as many as there are jobs: two seeds of one period may lie on one branch.
        """
        first_of_period = {}
        for seed in seeds:
            first_of_period.setdefault(seed.period, seed)
        first = [*first_of_period.values()]
        others = [seed for seed in seeds if seed not in first]
        most = min(max(self.plan.how.jobs, len(first)), self.room - len(self.branches))
        ordered = first + others
        return ordered[:most], ordered[most:]

    def _seeds(self, starts: Sequence[tuple]) -> list[Seed]:
        """The orbits under runs."""
        tasks = [line_task(under, self.line, start[1:]) for start in starts]
        seeds, results = [], self.work("orbits under motions", tasks)
        for (motion, value, period, _), (result, points) in zip(starts, results, strict=True):
            if result["reason"] or result["period"] > LONGEST_PERIOD:
                reason = result["reason"] or f"its orbit has period {result['period']}"
                self.failed.append((Seed(motion, value, period), reason))
                continue
            self.chosen.append({**result, "motion": motion})
            seeds.append(Seed(motion, value, result["period"], result["seen"], points[0]))
        return seeds

    def _add(self, seed: Seed, result: dict, points: list[np.ndarray]) -> list[Seed]:
        """Add the branch of a seed; returns the orbits of twice the period that begin at its flips."""
        branch = Branch(self._name(seed.period), result, points)
        self.branches.append(branch)
        branch.take(seed)
        seeds = []
        for event in branch.events:
            if "doubled" in event and 2 * event["period"] <= LONGEST_PERIOD:
                value, seen, doubled = event["doubled_value"], event["doubled_seen"], points[event["doubled"]]
                seeds.append(Seed("", value, len(seen), seen, doubled, event))
        self._meet()
        return seeds

    def _meet(self) -> None:
        """Lead flips to the branches that meet their orbit there."""
        for branch in self.branches:
            for end, orbits in (("begins", branch.orbits), ("ends", branch.orbits[::-1])):
                if "meets" in branch.result[end]:
                    step = STEPS["step"]
                    if len(orbits) > 1:
                        step = max(step, _apart(orbits[0], orbits[1], self.line.size))
                    flip = self._flip_near(orbits[0], step)
                    if flip is not None:
                        flip.setdefault("leads_to", branch.name)

    def _flip_near(self, orbit: dict, step: float) -> dict | None:
        """The flip that is nearest to an orbit of twice its period, and not much farther than a step."""
        nearest, least = None, BEYOND * step
        for branch in self.branches:
            for event in branch.events:
                if event["kind"] == "flip":
                    away = _apart(orbit, event, self.line.size, rounds=2)
                    if away < least:
                        nearest, least = event, away
        return nearest

    def _is_known(self, seed: Seed) -> bool:
        """Whether the orbit of a seed lies on a branch, which then takes its motion, or its flip leads to a branch."""
        if "leads_to" in seed.begins:
            return True
        seen = np.array(seed.seen)
        for branch in self.branches:
            for chord in pairwise(branch.orbits):
                if _on(chord, seed.value, seen, self.line.size):
                    branch.take(seed)
                    return True
        return False

    def _name(self, period: int) -> str:
        count = sum(branch.name.rstrip(ascii_lowercase) == str(period) for branch in self.branches)
        if not count:
            return str(period)
        return f"{period}{ascii_lowercase[count % 26]}"

    def across(self, values: Sequence[float]) -> None:
        """All orbits of the branches at that one of the values where there are most, with errors and histories.

        Those under a motion there are known.
        """
        counts = [sum(len(_crossings(branch, value)) for branch in self.branches) for value in values]
        value = values[int(np.argmax(counts))]
        tasks, branches = [], []
        for branch in self.branches:
            for place in _crossings(branch, value):
                ahead, behind = branch.orbits[place], branch.orbits[place + 1]
                if ahead["period"] != behind["period"]:
                    continue
                share = (value - ahead["value"]) / (behind["value"] - ahead["value"])
                guess = (1.0 - share) * branch.points[place] + share * branch.points[place + 1]
                tasks.append(line_task(under, self.line, (value, ahead["period"], guess)))
                branches.append(branch)
        known = [orbit for orbit in self.chosen if orbit["value"] == value]
        for branch, (result, _) in zip(branches, self.work("all orbits of one value", tasks), strict=True):
            if not result["reason"] and not any(_same(orbit["seen"], result["seen"]) for orbit in known):
                self.chosen.append({**result, "motion": "", "branch": branch.name})
        for orbit in self.chosen:
            orbit.setdefault("branch", self._branch_of(orbit))

    def _branch_of(self, orbit: dict) -> str:
        """The name of the branch of the orbit under a motion; "" where it has none."""
        for branch in self.branches:
            if orbit["motion"] in branch.motions and branch.orbits[0]["period"] == orbit["period"]:
                return branch.name
        return ""

    def refine(self) -> None:
        """Find every event again: at a tenth of the tolerance where it is not known well, and on a finer grid."""
        sharp_line, rough = replace(self.line, rtol=0.1 * self.line.rtol), SHARP * self.line.size
        near = []  # events, each with the value and the points of orbits near it
        for branch in self.branches:
            near += [(event, *self._near(branch, event)) for event in branch.events]
        unsure, tasks = [], []
        for event, *orbit in near:
            if event["error"] is None or event["error"] > rough:
                unsure.append(event)
                tasks.append(line_task(sharper, sharp_line, (event["kind"], event["value"], *orbit)))
        for event, (result, _) in zip(unsure, self.work("events at a tighter tolerance", tasks), strict=True):
            if not result["reason"]:
                event |= {"value": result["value"], "error": result["error"], "sharp": True}
        tasks = []
        for event, *orbit in near:
            line = self.line
            if event.get("sharp"):
                line = sharp_line
            tasks.append(line_task(finer, line, (event["kind"], event["value"], *orbit)))
        for (event, *_), (result, _) in zip(near, self.work("events on a finer grid", tasks), strict=True):
            event |= {"finer": result.get("value"), "doubt": result["reason"]}
            if event["finer"] is not None and event["error"] is not None:
                event["error"] = max(event["error"], abs(event["finer"] - event["value"]))

    def _near(self, branch: Branch, event: dict) -> list:
        """Value, points, value, points: of the orbit nearest to an event, and of the nearest BESIDE away in value."""
        size, near, beside = self.line.size, [], []
        for orbit, points in zip(branch.orbits, branch.points, strict=False):
            candidate = _apart(orbit, event, size), orbit["value"], points
            near.append(candidate)
            if abs(orbit["value"] - event["value"]) > BESIDE * size:
                beside.append(candidate)
        chosen = []
        for candidates in filter(None, (near, beside)):
            _, *orbit = min(candidates, key=lambda candidate: candidate[0])
            chosen += orbit
        return chosen


def _crossings(branch: Branch, value: float) -> list[int]:
    """The numbers of the orbits of a branch between which and the next one a value lies."""
    places = []
    for place, (orbit, following) in enumerate(pairwise(branch.orbits)):
        low, high = sorted((orbit["value"], following["value"]))
        if low <= value < high:
            places.append(place)
    return places


def _is_stable_at(branch: Branch, value: float) -> bool:
    """Whether stable orbits of a branch span a value."""
    for ahead, behind in pairwise(branch.orbits):
        low, high = sorted((ahead["value"], behind["value"]))
        if low <= value <= high and all(abs(complex(*orbit["multipliers"][0])) <= 1.0 for orbit in (ahead, behind)):
            return True
    return False


def _apart(orbit: dict, other: dict, size: float, rounds: int = 1) -> float:
    """Distance of an orbit from another one, or from an event, in what is seen and in the key.

    The other one is run through so many times; it may begin at any strobe. Other periods are infinitely far.
    """
    if orbit["period"] != rounds * other["period"]:
        return np.inf
    rows, seen = np.array(orbit["seen"]), np.tile(other["seen"], (rounds, 1))
    distance = min(np.linalg.norm(np.roll(seen, k, axis=0) - rows, axis=1).max() for k in range(len(rows)))
    return float(np.hypot(distance, (orbit["value"] - other["value"]) / size))


def _same(seen, candidate) -> bool:
    """Whether two orbits are one, begun at any strobe."""
    if np.shape(seen) != np.shape(candidate):
        return False
    return any(np.abs(np.roll(seen, k, axis=0) - candidate).max() < NEAR for k in range(len(seen)))


def _on(chord, value: float, seen: np.ndarray, size: float) -> bool:
    """Whether an orbit at a value lies on the chord between two neighbours of a branch."""
    first, last = chord
    begin, end = np.array(first["seen"]), np.array(last["seen"])
    low, high = sorted((first["value"], last["value"]))
    margin = 1e-9 * size
    if begin.shape != seen.shape or not low - margin <= value <= high + margin:
        return False
    length = np.linalg.norm(end - begin, axis=1).max()
    share = 0.5
    if low != high:
        share = (value - first["value"]) / (last["value"] - first["value"])
    on = begin + np.clip(share, 0.0, 1.0) * (end - begin)
    off = min(np.linalg.norm(np.roll(seen, k, axis=0) - on, axis=1).max() for k in range(len(seen)))
    return bool(off < NEAR + ON_CHORD * length)
