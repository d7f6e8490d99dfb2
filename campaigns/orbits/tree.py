"""All orbits that a campaign finds: those under its motions, their branches, and what begins at flips."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from string import ascii_lowercase

import numpy as np

from campaigns.explore.orbit_tasks import finer, followed, sharper, under
from campaigns.explore.tracing import Line, line_task, work
from campaigns.machinery.plan import Plan
from campaigns.machinery.tasks import Task
from engine.views import LONGEST_PERIOD

FOLDER = "branches"
SHARP = 1e-3  # of the range of the key: an event that is known worse is found again at a tenth of the tolerance
NEAR_M, ON_CHORD = 0.01, 0.1  # of an orbit to a known branch: m of what is seen, and shares of a chord


@dataclass(eq=False)
class Found:
    """A branch with its name; motions: the letters of those that lie on it."""

    name: str
    result: dict
    points: list[np.ndarray]
    motions: list[str] = field(default_factory=list)

    @property
    def orbits(self) -> list[dict]:
        return self.result["orbits"]


class Tree:
    """The orbits of a line of scenes (`tracing.Line`). plan: where results are kept, and where work is done."""

    def __init__(self, plan: Plan, line: Line, most: int, branches: int):
        self.plan, self.line, self.most, self.room = plan, line, most, branches
        (plan.how.out / FOLDER).mkdir(exist_ok=True)
        self.branches: list[Found] = []
        self.chosen: list[dict] = []  # orbits with errors and history
        self.failed: list[dict] = []
        self.computed = self.there = 0

    def work(self, said: str, tasks: Sequence[Task]) -> list[tuple[dict, list[np.ndarray]]]:
        """Results of tasks, in their order. Raises CampaignStopped."""
        results, there = work(self.plan, self.plan.how.out / FOLDER, said, tasks)
        self.there, self.computed = self.there + there, self.computed + len(tasks) - there
        return results

    def grow(self, starts: Sequence[tuple[str, float, int, object]]) -> None:
        """Follow the orbits under runs (motion, value, period, FinalState), and what begins on their branches."""
        asked = [line_task(under, self.line, start[1:]) for start in starts]
        left = []
        for (motion, value, period, _), (result, points) in zip(
            starts, self.work("orbits under motions", asked), strict=True
        ):
            if result["reason"] or result["period"] > LONGEST_PERIOD:
                reason = result["reason"] or f"its orbit has period {result['period']}"
                self.failed.append({"motion": motion, "value": value, "period": period, "reason": reason})
                continue
            self.chosen.append({**result, "motion": motion})
            left.append((motion, value, result["seen"], points[0], None))
        while left and len(self.branches) < self.room:
            left = [one for one in left if not self._known(one)]
            now, left = left[: self.plan.how.jobs], left[self.plan.how.jobs :]
            asked = [line_task(followed, self.line, (value, points, self.most)) for _, value, _, points, _ in now]
            for (motion, value, seen, _, begins), (result, points) in zip(
                now, self.work("branches", asked), strict=True
            ):
                if result.get("reason"):
                    told = {"motion": motion, "value": value, "period": len(seen), "reason": result["reason"]}
                    self.failed.append(told | {"begins": begins})
                    continue
                if self._known((motion, value, seen, None, begins)):  # found meanwhile from another orbit
                    continue
                branch = Found(self._name(len(seen)), result, points, [motion] if motion else [])
                self.branches.append(branch)
                if begins is not None:
                    begins["leads_to"] = branch.name
                left += [
                    ("", event["doubled_value"], event["doubled_seen"], points[event["doubled"]], event)
                    for event in result["events"] if "doubled" in event and 2 * event["period"] <= LONGEST_PERIOD
                ]  # fmt: skip
        for motion, value, seen, _, begins in left:
            if not self._known((motion, value, seen, None, begins)):
                reason = f"not followed: {self.room} branches are (--branches)"
                self.failed.append({"motion": motion, "value": value, "period": len(seen), "reason": reason})
        self._meet()

    def _meet(self) -> None:
        """Lead flips to the branches that meet their orbit there; what failed to begin at these is no failure."""
        flips = [event for branch in self.branches for event in branch.result["events"] if event["kind"] == "flip"]
        for branch in self.branches:
            for end, at in (("begins", 0), ("ends", -1)):
                near = [event for event in flips if 2 * event["period"] == branch.orbits[at]["period"]]
                if "meets" in branch.result[end] and near:
                    nearest = min(near, key=lambda event, there=branch.orbits[at]["value"]: abs(event["value"] - there))
                    nearest.setdefault("leads_to", branch.name)
        self.failed = [one for one in self.failed if not (one.get("begins") or {}).get("leads_to")]

    def _known(self, start) -> bool:
        """Whether an orbit lies on a branch; its motion is then one of that branch."""
        motion, value, seen, _, begins = start
        for branch in self.branches:
            if any(_on(chord, value, np.array(seen), self.line.size) for chord in pairwise(branch.orbits)):
                branch.motions += [motion] if motion and motion not in branch.motions else []
                if begins is not None:
                    begins["leads_to"] = branch.name
                return True
        return False

    def _name(self, period: int) -> str:
        many = sum(branch.name.rstrip(ascii_lowercase) == str(period) for branch in self.branches)
        return f"{period}{ascii_lowercase[many % 26] if many else ''}"

    def across(self, values: Sequence[float]) -> None:
        """All orbits of the branches at that one of the values where there are most, with errors and histories.

        Those under a motion there are known.
        """
        value = max(values, key=lambda one: sum(self._crossings(one)))
        asked, of = [], []
        for branch in self.branches:
            for at, (one, other) in enumerate(pairwise(branch.orbits)):
                low, high = sorted((one["value"], other["value"]))
                if not low <= value < high or one["period"] != other["period"]:
                    continue
                share = (value - one["value"]) / (other["value"] - one["value"])
                guess = (1.0 - share) * branch.points[at] + share * branch.points[at + 1]
                asked.append(line_task(under, self.line, (value, one["period"], guess)))
                of.append(branch)
        known = [one for one in self.chosen if one["value"] == value]
        for branch, (result, _) in zip(of, self.work("all orbits of one value", asked), strict=True):
            if not result["reason"] and not any(_same(one["seen"], result["seen"]) for one in known):
                self.chosen.append({**result, "motion": "", "branch": branch.name})
        for one in self.chosen:
            if "branch" not in one:
                own = (
                    branch.name
                    for branch in self.branches
                    if one["motion"] in branch.motions and branch.orbits[0]["period"] == one["period"]
                )
                one["branch"] = next(own, "")

    def _crossings(self, value: float) -> Iterator[int]:
        for branch in self.branches:
            for one, other in pairwise(branch.orbits):
                low, high = sorted((one["value"], other["value"]))
                yield int(low <= value < high)

    def refine(self) -> None:
        """Every event once more: at a tenth of the tolerance where it is not known well, and on a finer grid."""
        near, rough = {}, SHARP * self.line.size
        sharp = replace(self.line, rtol=0.1 * self.line.rtol)
        for branch in self.branches:
            for event in branch.result["events"]:
                apart = [_apart(one, event, self.line.size) for one in branch.orbits]
                at = int(np.argmin(apart))
                near[id(event)] = event, branch.orbits[at]["value"], branch.points[at]
        unsure = [one for one in near.values() if one[0]["error"] is None or one[0]["error"] > rough]
        asked = [line_task(sharper, sharp, (event["kind"], event["value"], *of)) for event, *of in unsure]
        for (event, *_), (result, _) in zip(unsure, self.work("events at a tighter tolerance", asked), strict=True):
            if not result["reason"]:
                event |= {"value": result["value"], "error": result["error"], "sharp": True}
        asked = [
            line_task(finer, sharp if event.get("sharp") else self.line, (event["kind"], event["value"], *of))
            for event, *of in near.values()
        ]
        for (event, *_), (result, _) in zip(near.values(), self.work("events on a finer grid", asked), strict=True):
            event |= {"finer": result.get("value"), "doubt": result["reason"]}
            if event["finer"] is not None and event["error"] is not None:
                event["error"] = max(event["error"], abs(event["finer"] - event["value"]))


def _apart(orbit: dict, event: dict, size: float) -> float:
    """Distance of an orbit of a branch from an event on it, in what is seen; other periods are infinitely far."""
    if orbit["period"] != event["period"]:
        return np.inf
    way = np.linalg.norm(np.array(orbit["seen"]) - np.array(event["seen"]), axis=1).max()
    return float(np.hypot(way, (orbit["value"] - event["value"]) / size))


def _same(some, others) -> bool:
    """Whether two orbits are one, begun at any strobe."""
    some, others = np.array(some), np.array(others)
    if some.shape != others.shape:
        return False
    return any(np.abs(np.roll(some, k, axis=0) - others).max() < NEAR_M for k in range(len(some)))


def _on(chord, value: float, seen: np.ndarray, size: float) -> bool:
    """Whether an orbit at a value lies on the chord between two neighbours of a branch."""
    one, other = (np.array(end["seen"]) for end in chord)
    values = [end["value"] for end in chord]
    margin = 1e-9 * size
    if one.shape != seen.shape or not min(values) - margin <= value <= max(values) + margin:
        return False
    length = np.linalg.norm(other - one, axis=1).max()
    share = (value - values[0]) / (values[1] - values[0]) if values[1] != values[0] else 0.5
    on = one + np.clip(share, 0.0, 1.0) * (other - one)
    off = min(np.linalg.norm(np.roll(seen, k, axis=0) - on, axis=1).max() for k in range(len(seen)))
    return bool(off < NEAR_M + ON_CHORD * length)
