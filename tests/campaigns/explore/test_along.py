"""Law: along a parameter every motion is found, has one letter on its branch, and its range ends where theory says.

The system is x' = p + x - x^3: two stable states for |p| < 2/(3 sqrt 3), one beyond. Starts are integrated here; the
rounds, the letters and the bisection are the campaign's.
"""

import math
from dataclasses import dataclass

import numpy as np
import pytest

from analysis.motions import Settled, joins, share_of
from campaigns.explore import along as module
from campaigns.explore import ends
from campaigns.explore.along import Along
from campaigns.explore.proposals import kicks
from campaigns.explore.starts import Ended, Start
from tables import Column

FOLD = 2.0 / (3.0 * math.sqrt(3.0))
VALUES = [round(-0.6 + 0.1 * step, 1) for step in range(13)]
KEY = Column("p", "", "p", "the parameter", 1)


def settled(p: float, x: float) -> Settled:
    for _ in range(4000):
        x += 0.05 * (p + x - x**3)
    return Settled(1, np.array([[x]]), np.array([[x, x, 2.0 + x]]), np.array([2.0]), "")


@dataclass
class State:
    x: float

    def at_zero(self):
        return self


class Scene:
    waves = type("Waves", (), {"period_s": 1.0})

    def __init__(self, p):
        self.p = p

    def sample_step_s(self):
        return 0.01


class FakeStarts:
    """As `campaigns.explore.starts.Starts`, of this system."""

    def __init__(self, plan, named):
        self.ended, self.count = [], 0

    def run(self, said, asked, told=True):
        found = []
        for one in asked:
            motion = settled(one.scene.p, one.start.kick[0] if one.start.state is None else one.start.state.x)
            own = np.repeat(motion.points, 12, axis=0), np.repeat(motion.measures, 11, axis=0)
            which = joins(*own, one.known)
            kept = {} if which is not None else {"settled": motion, "state": State(float(motion.points[0, 0]))}
            found.append(Ended({"status": "ok", "outcome": "" if which is None else "joined"}, which, **kept))
        self.count += len(asked)
        self.ended += found
        return found


class FakeJob:
    def __init__(self, p):
        self.labels, self.scene, self.key = {"p": p}, Scene(p), f"{p}"


@pytest.fixture
def found(monkeypatch, tmp_path):
    """The motions of a sweep whose runs from rest begin at x = -1, and whose kicks reach both sides."""
    monkeypatch.setattr(ends, "by_orbits", lambda along, asked: {})  # no cable here

    class Run:
        def __init__(self, p):
            self.settled = settled(p, -1.0)
            self.final_state = State(float(self.settled.points[0, 0]))

    monkeypatch.setattr(module, "Starts", FakeStarts)
    monkeypatch.setattr(module, "run_of", lambda folder, row: Run(row["p"]))
    monkeypatch.setattr(module, "settled_of", lambda run, orbits: run.settled)
    monkeypatch.setattr(module, "proposals", lambda plan, scenes, *how: [[] for _ in scenes])
    plan = type("Plan", (), {"how": type("How", (), {"out": tmp_path})})
    along = Along(plan, KEY, [FakeJob(p) for p in VALUES], Scene, [{"run_key": f"{p}", "p": p} for p in VALUES])
    along.find(4, 2.0, 1)
    along.name()
    return along


def test_both_branches_are_found_wherever_they_are_and_keep_their_letter(found):
    for p, motions in zip(VALUES, found.motions, strict=True):
        states = sorted((float(one.settled.points[0, 0]), one.branch.letter) for one in motions)
        assert [letter for _, letter in states] == (["A", "B"] if abs(p) < FOLD else ["A"] if p < 0 else ["B"])
        assert all((x < 0) == (letter == "A") for x, letter in states)


def test_kicks_are_independent_and_uniform_whatever_the_place():
    """A count has the variance of independent draws for every pattern of basins, stripes of any step among them."""
    count, seeds = 8, 400
    drawn = np.array([kicks(count, 6.0, seed, place) for seed in range(seeds // 4) for place in range(4)])
    assert np.abs(drawn).max() <= 6.0 and len(np.unique(drawn)) == drawn.size
    for step in (0.75, 1.5, 3.0, 4.0, 12.0):
        for axis in (0, 1):
            counts = np.sum(drawn[:, :, axis] % step < 0.5 * step, axis=1)
            assert counts.mean() == pytest.approx(4.0, abs=4.0 * np.sqrt(2.0 / seeds))
            assert counts.var() == pytest.approx(2.0, rel=4.0 * np.sqrt(2.0 / seeds))


def test_the_interval_of_a_share_holds_the_size_of_the_basin_in_95_of_100():
    counts = [sum(x > 0.27 * 12.0 - 6.0 for x, _ in kicks(8, 6.0, seed, 0)) for seed in range(400)]
    found = [share_of(count, 8) for count in counts]
    assert np.mean([one.low <= 0.73 <= one.high for one in found]) == pytest.approx(0.95, abs=0.04)


def test_shares_count_every_kick(found):
    for motions in found.motions:
        assert sum(found.labels(one)["share"] for one in motions) == pytest.approx(1.0)
        assert {found.labels(one)["kicks"] for one in motions} == {4}


def test_ranges_end_at_the_folds(found):
    rows = {(row["motion"], row["end"]): row for row in ends.bisect(found)}
    assert set(rows) == {("A", "upper"), ("B", "lower")}
    width = (VALUES[-1] - VALUES[0]) / ends.SHARPNESS
    for (_, end), row in rows.items():
        fold = FOLD if end == "upper" else -FOLD
        low, high = sorted((row["p_with"], row["p_without"]))
        assert low <= fold <= high and high - low <= width
        assert row["leads_to"] == {"A": "B", "B": "A"}[row["motion"]]


def test_what_is_found_again_is_one_motion(found):
    """A longer run shows that two motions of a value are one: one of them stays, with the kicks of both."""
    middle = found.motions[VALUES.index(0.0)]
    kicks = sum(one.kicks for one in middle)
    found.merge({middle[1]: middle[0].settled})
    (left,) = found.motions[VALUES.index(0.0)]
    assert left.kicks == kicks
    assert all(one.motion is None or one.motion in found.motions[one.motion.at] for one in found.starts.ended)


def test_a_start_without_a_state_begins_as_it_says():
    assert Start("kick", (1.0, -2.0)).labels()["kick_z_mps"] == -2.0
