"""Law: along a parameter every motion is found, has one letter on its branch, and its range ends where theory says."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from analysis.motions import Settled, share_of
from campaigns.explore import ends, stages, tracing
from campaigns.explore.motions import Motion, in_a_row
from campaigns.explore.proposals import kicks
from tables import Column
from tests.campaigns.explore.toy import Job, Scene, ToyMotions, explored

FOLD = 2.0 / (3.0 * math.sqrt(3.0))
VALUES = [round(-0.6 + 0.1 * step, 1) for step in range(13)]
KEY = Column("p", "", "p", "the parameter", 1)


def search(monkeypatch, folder, values):
    """The motions of a sweep whose kicks reach both sides."""
    motions = ToyMotions(folder, [KEY], in_a_row(len(values)))
    return explored(monkeypatch, motions, [Job({"p": p}, Scene(p)) for p in values], kicks=4)


@pytest.fixture
def swept(monkeypatch, tmp_path):
    return search(monkeypatch, tmp_path, VALUES)


def test_of_two_motions_of_the_first_place_that_from_rest_is_a(monkeypatch, tmp_path):
    motions = search(monkeypatch, tmp_path, [-0.1, 0.0, 0.1])
    assert [[motion.branch.letter for motion in of_place] for of_place in motions.at] == [["A", "B"]] * 3
    assert all(motion.found_by == "rest" for motion, _ in motions.at)


def test_both_branches_are_found_wherever_they_are_and_keep_their_letter(swept):
    for p, motions in zip(VALUES, swept.at, strict=True):
        states = sorted((float(candidate.settled.points[0, 0]), candidate.branch.letter) for candidate in motions)
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
    swept = [share_of(count, 8) for count in counts]
    assert np.mean([candidate.low <= 0.73 <= candidate.high for candidate in swept]) == pytest.approx(0.95, abs=0.04)


def test_shares_count_every_kick(swept):
    for motions in swept.at:
        assert sum(swept.labels(candidate)["share"] for candidate in motions) == pytest.approx(1.0)
        assert {swept.labels(candidate)["kicks"] for candidate in motions} == {4}


@pytest.mark.parametrize(("off", "exact"), [(0.0, True), (0.3, False)])
def test_ranges_end_at_the_folds_and_by_orbits_that_end_there(swept, monkeypatch, off, exact):
    """off: how far beyond the fold the orbit is lost that stands for those of a cable."""

    def lost(plan, folder, title, tasks):
        return [
            ({"reason": "", "value": ahead * (FOLD + off), "error": 1e-4, "kind": "fold"}, []) for ahead in tasks
        ], 0

    monkeypatch.setattr(tracing, "work", lost)
    monkeypatch.setattr(tracing, "line_task", lambda do, line, arguments: arguments[1])
    rows = {(row["motion"], row["end"]): row for row in ends.find_ends(swept, Scene)}
    assert set(rows) == {("A", "upper"), ("B", "lower")}
    width = (VALUES[-1] - VALUES[0]) / ends.SHARPNESS
    for (_, end), row in rows.items():
        fold = FOLD if end == "upper" else -FOLD
        low, high = sorted((row["p_with"], row["p_without"]))
        assert low <= fold <= high and high - low <= width
        assert row["leads_to"] == {"A": "B", "B": "A"}[row["motion"]]
        assert (row.get("p_end"), row.get("kind")) == ((fold, "fold") if exact else (None, None))


def test_ranges_end_by_bisection_alone_where_that_is_enough(swept, monkeypatch):
    monkeypatch.setattr(tracing, "work", None)
    upper, lower = ends.find_ends(swept, Scene, exact=False)
    assert upper["p_with"] <= FOLD <= upper["p_without"] and lower["p_without"] <= -FOLD <= lower["p_with"]
    assert "p_end" not in upper and "p_end" not in lower


@pytest.mark.parametrize(
    ("shift", "words"),
    [
        (0.0, "at a tenth of the tolerance and on 81 nodes"),
        (0.2, "NOT with a tenth of the tolerance, where it becomes B"),
    ],
)
def test_a_branch_is_confirmed_where_its_tension_is_largest(swept, monkeypatch, shift, words):
    """shift: of p by a change of the method; A is lost beyond its fold."""
    monkeypatch.setattr(Scene, "tether", SimpleNamespace(nodes=41), raising=False)
    monkeypatch.setattr(ends, "finer", lambda scene, **change: Scene(scene.p + shift))
    ends.confirm(swept)
    confirmed = {branch[0].branch.letter: branch[0].branch.confirmed for branch in swept.branches()}
    assert confirmed["A"].startswith(words) and confirmed["A"].endswith(", checked at 0.3")
    assert confirmed["B"] == "at a tenth of the tolerance and on 81 nodes, checked at 0.6"


def test_what_is_found_again_is_one_motion(swept):
    """A longer run shows that two motions of a value are one: one of them stays, with the kicks of both."""
    middle = swept.at[VALUES.index(0.0)]
    kicks = sum(candidate.kicks for candidate in middle)
    stages.merge(swept, {middle[1]: middle[0].settled})
    (merged,) = swept.at[VALUES.index(0.0)]
    assert merged.kicks == kicks
    assert all(
        candidate.motion is None or candidate.motion in swept.at[candidate.motion.place]
        for candidate in swept.starts.endings
    )


def motion_at(place: int, x: float, period: int = 1) -> Motion:
    """A motion of that period whose state is x at every strobe."""
    points = np.full((period, 1), x)
    measures = np.full((period, 3), x)
    return Motion(place, Settled(period, points, measures, np.array([2.0]), ""), None, "rest")


def test_a_motion_is_matched_with_the_nearest_of_its_period_within_the_distance():
    motion, near, nearer = motion_at(0, 1.0), motion_at(1, 1.1), motion_at(1, 0.95)
    doubled, far = motion_at(1, 1.0, period=2), motion_at(1, 3.0)
    assert stages.nearest_match(motion, [doubled, near, nearer, far], 0.5) is nearer
    assert stages.nearest_match(motion, [doubled, far], 0.5) is None
    assert stages.nearest_match(motion, [near], 0.0) is None


@pytest.mark.parametrize(("backs", "letters"), [(1, ["A", "A"]), (2, ["A", "B", "C"])])
def test_an_unsettled_motion_becomes_the_one_that_becomes_it_if_there_is_but_one(tmp_path, backs, letters):
    motions = ToyMotions(tmp_path, [KEY], in_a_row(2))
    motions.jobs = [Job({"p": p}, Scene(p)) for p in (0.0, 0.1)]
    first = motion_at(0, 1.0)
    first.becomes[1] = None
    seconds = [motion_at(1, 5.0 + number) for number in range(backs)]
    for second in seconds:
        second.becomes[0] = first
    motions.at = [[first], seconds]
    stages.name(motions)
    assert [motion.branch.letter for motion in (first, *seconds)] == letters
