"""`campaigns.orbits`: the tree of orbits of a map with known folds and flips, and what is refused."""

from dataclasses import dataclass

import numpy as np
import pytest

from analysis.orbits import NoImage, OrbitMap
from campaigns.explore.tracing import followed, sharper
from campaigns.machinery.cli import Running
from campaigns.machinery.plan import Plan
from campaigns.orbits.tables import tables
from campaigns.orbits.tree import SHARP, Branch, Tree
from tables import Column
from tests.analysis.systems import henon_plane
from tests.campaigns.conftest import rows_of

B = 0.3
FOLD, FLIP, SECOND = -((1 - B) ** 2) / 4, 3 * (1 - B) ** 2 / 4, (1 - B) ** 2 + (1 + B) ** 2 / 4  # of Henon's map
KEY = Column("a", "", "a", "parameter of Henon's map", 5)
NAMES = "time_s", "radius_m", "radius_rate_mps", "angle_rad", "tension_top_N", "tension_min_N"


def henon(z, a):
    return henon_plane(z, (a, B))


class Seen:
    """Henon's map as a PeriodMap tells of itself."""

    seen = np.eye(2)

    def history(self, points, _value):
        rows = np.array(points)
        columns = dict.fromkeys((*NAMES, "tension_top_low_N", "tension_top_high_N"), rows[:, 1])
        return columns | {"time_s": np.arange(float(len(rows))), "radius_m": rows[:, 0]}


@dataclass(frozen=True)
class HenonLine:
    low: float = -0.15
    high: float = 0.95
    size: float = 1.0
    rtol: float = 1e-3
    step: object = henon

    @property
    def maps(self):
        return Seen(), OrbitMap(self.step, parameter_size=self.size)

    def digest(self):
        return f"henon {self.rtol}"


def fixed(a, way):
    x = (-(1 - B) + way * ((1 - B) ** 2 + 4 * a) ** 0.5) / 2
    return np.array([[x, B * x]])


def grown(out, branches=8, starts=None, line=None):
    """The tree of these starts with its tables."""
    plan = Plan(Running(out, 2, "threading"), None, None, ())
    tree = Tree(plan, line or HenonLine(), 60, branches)
    tree.grow(starts or [("A", 0.2, 1, fixed(0.2, 1)), ("B", 0.2, 1, fixed(0.2, -1))])
    tree.across([0.2])
    tables(tree, KEY)
    return tree


def test_both_sides_of_a_fold_are_one_branch_and_each_flip_begins_another(tmp_path):
    first = grown(tmp_path)
    rows, events = rows_of(tmp_path, "branches/table.csv"), rows_of(tmp_path, "events/table.csv")
    assert [(row["branch"], row["motion"]) for row in rows] == [("1", "A B"), ("2", ""), ("4", "")]
    for branch, kind, value, leads in (("1", "fold", FOLD, ""), ("1", "flip", FLIP, "2"), ("2", "flip", SECOND, "4")):
        (event,) = (candidate for candidate in events if (candidate["branch"], candidate["kind"]) == (branch, kind))
        assert abs(float(event["a"]) - value) <= float(event["error"]) < 1e-2 and event["leads_to"] == leads
    assert all(float(row["multiplier_1_error"]) < 1e-6 for row in rows_of(tmp_path)), "every multiplier has an error"
    assert {row["unstable"] for row in rows_of(tmp_path, "orbits/table.csv")} == {"0", "1"}
    for row in rows_of(tmp_path):
        if row["branch"] == "1":  # multipliers of a fixed point: mu^2 + 2 x mu - b = 0
            way = 1 if float(row["radius_max_m"]) > -(1 - B) / 2 else -1
            moduli = np.abs(np.roots([1.0, 2.0 * fixed(float(row["a"]), way)[0, 0], -B]))
            assert np.min(np.abs(moduli - 1.0)) < 1e-6 or int(row["unstable"]) == np.count_nonzero(moduli > 1.0)
    second = grown(tmp_path)
    assert first.computed > 0 and second.computed == 0 and second.there == first.computed + first.there


def bubble(z, a):
    """x -> -(1 + e) x + x^3 with e = 0.9 - 9 a^2: flips at a = +-sqrt(0.1), between which +-sqrt(e) has period 2."""
    x, y = z
    slope = -(1.9 - 9.0 * a * a)
    return np.array([slope * x + x**3, B * y]), lambda vectors: np.diag([slope + 3.0 * x * x, B]) @ vectors


def test_a_branch_between_two_flips_is_followed_once_and_both_lead_to_it(tmp_path, monkeypatch):
    """Also where its last orbits are so far from the flips that those which begin there lie on no chord of it."""

    def met(line, value, points, most):
        result, points_of = followed(line, value, points, most)
        if len(points) == 2:
            kept = [place for place, orbit in enumerate(result["orbits"]) if abs(orbit["seen"][0, 0]) > 0.1]
            points_of, orbits = ([part[place] for place in kept] for part in (points_of, result["orbits"]))
            result |= dict.fromkeys(("begins", "ends"), "meets the orbit of period 1") | {"orbits": orbits}
        return result, points_of

    monkeypatch.setattr("campaigns.orbits.tree.followed", met)
    grown(tmp_path, starts=[("A", 0.45, 1, np.zeros((1, 2)))], line=HenonLine(low=-0.5, high=0.5, step=bubble))
    assert [row["branch"] for row in rows_of(tmp_path, "branches/table.csv")] == ["1", "2"]
    flips = rows_of(tmp_path, "events/table.csv")
    assert [(flip["kind"], flip["leads_to"]) for flip in flips] == [("flip", "2")] * 2
    assert sorted(float(flip["a"]) for flip in flips) == pytest.approx([-(0.1**0.5), 0.1**0.5], abs=1e-2)


def parted(z, a):
    """x -> x + 0.2 (a^2 - 0.1 - x^2): fixed points at |a| > sqrt(0.1) only, where two folds begin a branch each."""
    x, y = z
    return np.array([x + 0.2 * (a * a - 0.1 - x * x), B * y]), lambda vectors: np.diag([1.0 - 0.4 * x, B]) @ vectors


def test_a_motion_beyond_the_branch_of_its_letter_has_a_branch_of_its_own(tmp_path):
    """The search carries one letter across both folds; from the middle of its values one branch alone is followed."""
    middle, low, high = (("A", a, 1, np.array([[(a * a - 0.1) ** 0.5, 0.0]])) for a in (0.45, -0.45, 0.5))
    tree = grown(tmp_path, starts=[middle], line=HenonLine(low=-0.5, high=0.5, step=parted))
    assert len(tree.branches) == 1 and tree.beyond([low, high]) == [low]
    tree.grow(tree.beyond([low, high]))
    assert [branch.motions for branch in tree.branches] == [["A"], ["A"]] and tree.beyond([low, high]) == []


def test_a_branch_that_meets_no_flip_in_reach_leads_none(tmp_path):
    tree = Tree(Plan(Running(tmp_path, 1), None, None, ()), HenonLine(), 1, 1)
    seen = np.array([[1.0, 0.0], [1.1, 0.0]])
    near, far = ({"kind": "flip", "period": 1, "value": value, "seen": seen[:1]} for value in (0.45, 0.9))
    once = {"events": [far, near], "orbits": [{"period": 1, "value": 0.3, "seen": seen[:1]}], "begins": "", "ends": ""}
    orbits = [{"period": 2, "value": value, "seen": seen} for value in (0.5, 0.6)]
    twice = {"events": [], "orbits": orbits, "begins": "meets a flip", "ends": "meets a flip"}
    tree.branches = [Branch("1", once, []), Branch("2", twice, [])]
    tree._meet()
    assert near["leads_to"] == "2" and "leads_to" not in far


def test_an_event_is_known_as_well_as_steps_and_a_finer_grid_agree(tmp_path, monkeypatch):
    """The finer grid moves every event by 0.02, the tighter tolerance by 0.01, to an error of 1e-5."""
    tree = grown(tmp_path)
    moves = {"finer": 0.02, "sharper": 0.01}
    for name, by in moves.items():
        result = lambda line, kind, at, *orbit, by=by: ({"reason": "", "value": at + by, "error": 1e-5}, [])  # noqa: E731
        result.__name__ = name
        monkeypatch.setattr(f"campaigns.orbits.tree.{name}", result)
    events = [event for branch in tree.branches for event in branch.result["events"]]
    events[0]["error"] = None
    earlier = [dict(event) for event in events]
    tree.refine()
    for event, old in zip(events, earlier, strict=True):
        sharp = old["error"] is None or old["error"] > SHARP
        assert event["value"] == pytest.approx(old["value"] + 0.01 * sharp)
        assert event["finer"] == pytest.approx(event["value"] + 0.02)
        assert event["error"] == pytest.approx(max(0.02, old["error"] or 0.0))


def test_what_is_not_followed_or_not_found_is_a_row_with_its_reason(tmp_path):
    def broken(z, a):
        if z[0] > 5.0:
            raise NoImage("a loop is released in the period")
        return henon(z, a)

    line = HenonLine(step=broken)
    starts = [("A", 0.2, 1, fixed(0.2, 1)), ("C", 0.2, 1, np.array([[9.0, 0.0]]))]
    grown(tmp_path, branches=1, starts=starts, line=line)
    sound, lost, left = rows_of(tmp_path, "branches/table.csv")
    assert (sound["status"], lost["status"], left["status"]) == ("ok", "no-orbit", "no-orbit")
    assert lost["motion"] == "C" and "a loop is released" in lost["message"]
    assert left["period"] == "2" and "--branches" in left["message"]


def test_a_fold_is_found_again_from_another_orbit_where_the_nearest_one_is_gone():
    gone, there = FOLD - 0.01, FOLD + 0.1
    orbits = gone, fixed(FOLD, 1.0), there, fixed(there, 1.0)
    result, _ = sharper(HenonLine(low=-0.2), "fold", FOLD, *orbits)
    assert result["kind"] == "fold" and abs(result["value"] - FOLD) <= max(result["error"], 1e-6)
    with pytest.raises(ArithmeticError):
        sharper(HenonLine(low=-0.2), "fold", FOLD, *orbits[:2])
