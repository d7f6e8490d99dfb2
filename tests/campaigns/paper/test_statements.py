"""Verdicts follow from the results: each statement holds in the paper's world, none does in the contrary one."""

import csv
import io
import math

import pytest

from campaigns.paper.measured import Results
from campaigns.paper.statements import buoy_claims, claims
from campaigns.statements import COLUMNS, FAILS, HOLDS, HOLDS_IF, OPEN, Claim, Measured, Statement, as_csv, judge
from tests.campaigns.paper.world import LARGE, buoy, deep, world

ONCE = {claim.text: claim for claim in claims()}.values()
MISPRINT = "The wave takes 0.55 to 0.91 s to run along the whole line."  # as printed, or a tenth of it: never both
CHAOTIC = buoy_claims()["chaotic"]


@pytest.mark.parametrize("claim", ONCE, ids=lambda claim: claim.text)
def test_what_the_paper_says_holds_in_its_own_world_and_not_in_the_contrary_one(claim):
    assert judge(claim, world()).verdict == (HOLDS_IF if claim.text == MISPRINT else HOLDS)
    assert judge(claim, world(so=False)).verdict == FAILS


def judged(results):
    return [judge(claim, results) for claim in claims()]


def test_without_results_nothing_is_decided():
    assert {one.verdict for one in judged(Results())} == {OPEN}


def claim_of(*checks):
    return Claim("", "", "", lambda results: Measured(checks, "told"), lambda value: value > 0.0, "", "")


@pytest.mark.parametrize(
    ("checks", "verdict"),
    [
        ((("a", 1.0), ("b", 2.0)), HOLDS),
        ((("a", 1.0), ("b", -2.0)), HOLDS_IF),
        ((("a", -1.0), ("b", -2.0)), FAILS),
        ((("a", 1.0), ("b", math.nan)), HOLDS),
        ((("b", math.nan),), OPEN),
        ((), OPEN),
    ],
)
def test_a_verdict_is_that_of_all_checks_and_no_number_decides_nothing(checks, verdict):
    assert judge(claim_of(*checks), None).verdict == verdict


def test_between_both_the_places_are_named_and_grouped_around_their_numbers():
    checks = (("H = 21 m", True), ("H = 22 m", True), ("elsewhere", False))
    assert Statement(claim_of(), checks, "").condition == "H = 21 and 22 m; not elsewhere"
    more = (*checks, ("H = 23 m, dry", True))
    assert Statement(claim_of(), more, "").condition == "H = 21 and 22 m, and H = 23 m, dry; not elsewhere"


def test_a_buoyancy_that_is_not_the_shipped_one_is_a_place_of_its_own():
    dry = world(
        dependence=(deep(0.13, 21.0), deep(0.13, 21.0, regime="period-1", submergence="spherical-cap")), buoy={}
    )
    assert judge(CHAOTIC, dry).condition == "H = 21 m; not H = 21 m with spherical-cap"


def test_an_exponent_that_could_be_either_decides_nothing_unless_the_regime_does():
    open_one = deep(0.13, 22.5, regime="undecided", lyapunov_tangent_bits_per_period=0.01)
    found = judge(buoy_claims()["positive exponent"], world(dependence=(deep(0.13, 21.0), open_one)))
    assert dict(found.checks) == {"H = 21 m": True}


def test_at_the_shipped_depth_the_long_run_counts():
    short = (deep(0.13, 21.0, regime="undecided"), deep(0.13, 22.5, regime="period-2"))
    nothing = judge(CHAOTIC, world(dependence=short, buoy={}))
    assert dict(nothing.checks) == {"H = 22.5 m": False}
    found = judge(CHAOTIC, world(dependence=short, buoy={LARGE: buoy(LARGE)}))
    assert dict(found.checks) == {"H = 21 m": True, "H = 22.5 m": False}


def test_a_regime_that_is_open_decides_nothing():
    open_ones = tuple(deep(0.016, H, regime=regime) for H, regime in ((21.0, "transient"), (22.5, "")))
    assert judge(buoy_claims()["regular"], world(dependence=open_ones, buoy={})).verdict == OPEN


def test_the_file_has_every_statement_with_number_and_evidence():
    rows = list(csv.DictReader(io.StringIO(as_csv(judged(world())).decode())))
    assert len(rows) == len(claims()) == 81 and tuple(rows[0]) == COLUMNS
    assert [int(row["number"]) for row in rows] == list(range(1, len(rows) + 1))
    assert all(row["place"] and row["evidence"] and row["threshold"] and row["found"] for row in rows)
