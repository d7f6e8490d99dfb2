"""Law: along a parameter every motion is found, has one letter on its branch, and its range ends where theory says."""

import math

import numpy as np
import pytest

from analysis.motions import share_of
from campaigns.explore import ends, stages
from campaigns.explore.motions import in_a_row
from campaigns.explore.proposals import kicks
from campaigns.explore.starts import Start
from tables import Column
from tests.campaigns.explore.toy import Job, Scene, ToyMotions, explored

FOLD = 2.0 / (3.0 * math.sqrt(3.0))
VALUES = [round(-0.6 + 0.1 * step, 1) for step in range(13)]
KEY = Column("p", "", "p", "the parameter", 1)


@pytest.fixture
def found(monkeypatch, tmp_path):
    """The motions of a sweep whose kicks reach both sides."""
    monkeypatch.setattr(ends, "by_orbits", lambda *arguments: {})  # no cable here
    motions = ToyMotions(tmp_path, [KEY], in_a_row(len(VALUES)))
    return explored(monkeypatch, motions, [Job({"p": p}, Scene(p)) for p in VALUES], kicks=4)


def test_both_branches_are_found_wherever_they_are_and_keep_their_letter(found):
    for p, motions in zip(VALUES, found.at, strict=True):
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
    for motions in found.at:
        assert sum(found.labels(one)["share"] for one in motions) == pytest.approx(1.0)
        assert {found.labels(one)["kicks"] for one in motions} == {4}


def test_ranges_end_at_the_folds(found):
    rows = {(row["motion"], row["end"]): row for row in ends.find_ends(found, Scene)}
    assert set(rows) == {("A", "upper"), ("B", "lower")}
    width = (VALUES[-1] - VALUES[0]) / ends.SHARPNESS
    for (_, end), row in rows.items():
        fold = FOLD if end == "upper" else -FOLD
        low, high = sorted((row["p_with"], row["p_without"]))
        assert low <= fold <= high and high - low <= width
        assert row["leads_to"] == {"A": "B", "B": "A"}[row["motion"]]


def test_what_is_found_again_is_one_motion(found):
    """A longer run shows that two motions of a value are one: one of them stays, with the kicks of both."""
    middle = found.at[VALUES.index(0.0)]
    kicks = sum(one.kicks for one in middle)
    stages.merge(found, {middle[1]: middle[0].settled})
    (left,) = found.at[VALUES.index(0.0)]
    assert left.kicks == kicks
    assert all(one.motion is None or one.motion in found.at[one.motion.place] for one in found.starts.endings)


def test_a_start_without_a_state_begins_as_it_says():
    assert Start("kick", (1.0, -2.0)).labels()["kick_z_mps"] == -2.0
