"""Verdicts follow from the results: each statement holds in the paper's world, none does in the contrary one.

Two synthetic worlds: in `world` everything is as the paper says, in `world(so=False)` nothing is.
"""

import csv
import io
import math
import tomllib
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from campaigns.breaking_line.lines import CASES, over_case_4
from campaigns.paper import measured
from campaigns.paper.measured import Results
from campaigns.paper.statements import buoy_claims, claims
from campaigns.paper.statements.judging import settled
from campaigns.statements import Claim, Measured, Statement, as_csv, judge
from engine import load_scene
from tables import FAILS, HOLDS, HOLDS_IF, NOT_JUDGED, STATEMENT_COLUMNS, TANGENT_ERROR, TANGENT_EXPONENT
from tests.campaigns.fake_engine import sines

DEPTHS = (21.0, 22.5)
SMALL, LARGE = 0.016, 0.13
WORLDS = tomllib.loads(Path(__file__).with_name("worlds.toml").read_text(encoding="utf-8"))


def entries(table, shape, *place):
    """A row: of every quantity of a table the value at this place."""
    row = {}
    for name, values in table.items():
        row[name] = np.broadcast_to(values, shape)[place].item()
    return row


def line(case: str, kind: str, so: bool) -> dict:
    """A row of the breaking line; so: as the paper says."""
    row = entries(WORLDS["lines"]["told" if so else "contrary"], (2, 4), int(case.endswith("p")), int(case[0]) - 1)
    off = 2.0 if kind == "doubled" and not so else 1.0
    return row | {"case": case, "kind": kind, "status": "ok", "recoil_m": off * row["recoil_m"]}


def buoy(steepness: float, so: bool = True, **changed) -> dict:
    """A row of the buoy."""
    row = entries(WORLDS["buoy"], (2, 2), int(not so), int(steepness > 0.1))
    return row | {"steepness": steepness, "status": "ok"} | changed


def deep(steepness: float, depth_m: float, so: bool = True, **changed) -> dict:
    """A row of the dependence study."""
    treated = {"above_still_water": "extrapolate", "submergence": "full", "bending_stiffness_Nm2": 0.4}
    return {**buoy(steepness, so), "depth_m": depth_m, **treated, **changed}


def pushed(steepness: float, so: bool = True, direction: str = "lateral") -> dict:
    """A row out of the plane."""
    row = entries(WORLDS["pushed"], (2, 2), int(not so), int(steepness > 0.1))
    if direction == "along":
        row["rope_lateral_max_m"] = 0.0 if so else 0.1
    row |= {"steepness": steepness, "status": "ok", "dimensions": 3.0, "depth_m": 21.0}
    return row | {"seed_direction": direction, "profiles": 0.0}


def world(so: bool = True, **changed) -> Results:
    """All results; so: as the paper says, else the contrary of all. changed: fields of Results."""
    finer = {"periods": 100.0, "radius_min_m": 19.0, "radius_max_m": 21.0}
    finer["error_early_m"] = finer["error_m"] = 1e-3 if so else 0.5
    slack_fractions = {0.05: 0.0, 0.13: 0.1, 0.14: 0.1} if so else {0.05: 0.1, 0.14: 0.0}
    regime = "chaotic" if so else "period-1"
    usual = {
        "lines": over_case_4([line(case, kind, so) for kind in ("case", "doubled") for case in CASES]),
        "buoy": {kA: buoy(kA, so) for kA in (SMALL, LARGE)},
        "doubled": tuple(finer | {"waves.steepness": kA} for kA in (SMALL, LARGE)),
        "sweep": tuple(
            buoy(kA, so, slack_fraction=fraction, regime=regime) for kA, fraction in slack_fractions.items()
        ),
        "dependence": tuple(deep(kA, H, so) for kA in (LARGE, SMALL) for H in DEPTHS),
        "plane": (pushed(SMALL, so), pushed(LARGE, so), pushed(LARGE, so, "along")),
        "numbers": {name: numbers[not so] for name, numbers in WORLDS["numbers"].items()},
    }
    return Results(**(usual | changed))


ONCE = {claim.text: claim for claim in claims()}.values()
MISPRINT = "The wave takes 0.55 to 0.91 s to run along the whole line."  # as printed, or a tenth of it: never both
CHAOTIC = buoy_claims()["chaotic"]


@pytest.mark.parametrize("claim", ONCE, ids=lambda claim: claim.text)
def test_what_the_paper_says_holds_in_its_own_world_and_not_in_the_contrary_one(claim):
    assert judge(claim, world()).verdict == (HOLDS_IF if claim.text == MISPRINT else HOLDS)
    assert judge(claim, world(so=False)).verdict == FAILS


def test_every_motion_of_a_wave_is_judged_and_a_long_run_stands_for_the_one_from_rest():
    """The motion from rest is chaotic over the long run only; B at the same wave is not; C begins above."""
    motions = {"A": (0.05, 0.13), "B": (0.13,), "C": (0.14,)}
    kinds = {"A": ("period-1", "rest"), "B": ("period-3", "kick"), "C": ("chaotic", "carried up")}
    rows = [
        buoy(kA, regime=kinds[motion][0], found_by=kinds[motion][1], motion=motion, slack_fraction=float(kA > 0.1))
        for motion, steepnesses in motions.items()
        for kA in steepnesses
    ]
    results = world(sweep=tuple(rows))
    result = judge(buoy_claims()["Wherever the line goes slack and snaps, the motion is chaotic."], results)
    assert result.verdict == HOLDS_IF and result.condition == "kA = 0.13 (A) and 0.14 (C); not kA = 0.13 (B)"
    assert judge(buoy_claims()["threshold"], results).verdict == HOLDS
    taut = world(sweep=(*rows, buoy(0.14, found_by="kick", motion="D", slack_fraction=0.0)))
    assert judge(buoy_claims()["threshold"], taut).condition == "there is a threshold; not slack at all larger waves"


def judged(results):
    return [judge(claim, results) for claim in claims()]


def test_without_results_nothing_is_decided():
    assert {statement.verdict for statement in judged(Results())} == {NOT_JUDGED}


def test_a_quick_look_judges_nothing_of_the_buoy_and_says_why():
    judged_quickly = [
        judge(quick, world()) for quick, claim in zip(claims(True), claims(), strict=True) if quick != claim
    ]
    assert len(judged_quickly) > 30 and all(
        statement.verdict == NOT_JUDGED and "not judged, because" in statement.found for statement in judged_quickly
    )


def claim_of(*checks):
    return Claim("", "", "", lambda results: Measured(checks, "told"), lambda value: value > 0.0, "", "")


@pytest.mark.parametrize(
    ("checks", "verdict"),
    [
        ((("a", 1.0), ("b", 2.0)), HOLDS),
        ((("a", 1.0), ("b", -2.0)), HOLDS_IF),
        ((("a", -1.0), ("b", -2.0)), FAILS),
        ((("a", 1.0), ("b", math.nan)), HOLDS),
        ((("b", math.nan),), NOT_JUDGED),
        ((), NOT_JUDGED),
    ],
)
def test_a_verdict_is_that_of_all_checks_and_no_number_decides_nothing(checks, verdict):
    assert judge(claim_of(*checks), None).verdict == verdict


def test_between_both_the_places_are_named_and_grouped_around_their_numbers():
    checks = (("H = 21 m", True), ("H = 22 m", True), ("elsewhere", False))
    assert Statement(claim_of(), checks, "").condition == "H = 21 and 22 m; not elsewhere"
    further = (*checks, ("H = 23 m, dry", True))
    assert Statement(claim_of(), further, "").condition == "H = 21 and 22 m, and H = 23 m, dry; not elsewhere"


def test_a_buoyancy_that_is_not_the_shipped_one_is_a_place_of_its_own():
    dry = world(
        dependence=(deep(0.13, 21.0), deep(0.13, 21.0, regime="period-1", submergence="spherical-cap")), buoy={}
    )
    assert judge(CHAOTIC, dry).condition == "H = 21 m; not H = 21 m with spherical-cap"


def test_an_exponent_that_could_be_either_decides_nothing_unless_the_regime_does():
    open_one = deep(0.13, 22.5, regime="undecided", lyapunov_tangent_bits_per_period=0.015)
    result = judge(buoy_claims()["positive exponent"], world(dependence=(deep(0.13, 21.0), open_one)))
    assert dict(result.checks) == {"H = 21 m": True}


def test_at_the_shipped_depth_the_long_run_counts():
    short = (deep(0.13, 21.0, regime="undecided"), deep(0.13, 22.5, regime="period-2"))
    nothing = judge(CHAOTIC, world(dependence=short, buoy={}))
    assert dict(nothing.checks) == {"H = 22.5 m": False}
    result = judge(CHAOTIC, world(dependence=short, buoy={LARGE: buoy(LARGE)}))
    assert dict(result.checks) == {"H = 21 m": True, "H = 22.5 m": False}


def test_a_regime_that_is_open_decides_nothing():
    open_ones = tuple(deep(0.016, H, regime=regime) for H, regime in ((21.0, "transient"), (22.5, "")))
    assert judge(buoy_claims()["regular"], world(dependence=open_ones, buoy={})).verdict == NOT_JUDGED


def test_the_file_has_every_statement_with_number_and_evidence():
    rows = list(csv.DictReader(io.StringIO(as_csv(judged(world())).decode())))
    assert len(rows) == len(claims()) == 81 and tuple(rows[0]) == STATEMENT_COLUMNS
    assert [int(row["number"]) for row in rows] == list(range(1, len(rows) + 1))
    assert all(row["place"] and row["evidence"] and row["threshold"] and row["found"] for row in rows)


def test_the_change_on_a_finer_grid_is_of_the_whole_record_and_early_of_its_first_periods(monkeypatch):
    coarse, fine = (sines(load_scene("tethered_buoy"), 20) for _ in range(2))
    late = fine.columns["time_s"] > measured.EARLY * fine.scene.waves.period_s + 1e-9
    fine.columns["radius_m"] += np.where(late, 0.3, 0.1)
    runs = dict(zip(measured.NODES, (coarse, fine), strict=True))
    rows = [{"waves.steepness": 0.1, "tether.nodes": nodes} for nodes in runs]
    monkeypatch.setattr(measured, "run_of", lambda folder, row: runs[row["tether.nodes"]])
    part = SimpleNamespace(folder=None, rows=rows)
    (row,) = measured._doubled(SimpleNamespace(part=lambda name: part), {})["doubled"]
    whole_m = math.sqrt(0.01 + late.mean() * 0.08)
    assert (row["error_early_m"], row["error_m"]) == pytest.approx((0.1, whole_m), rel=1e-9)


@pytest.mark.parametrize(("bits", "error", "says"), [(-0.1, 0.01, True), (-0.02, 0.05, False), (0.1, 0.01, True)])
def test_an_exponent_says_its_sign_beyond_doubt_or_nothing(bits, error, says):
    assert settled({TANGENT_EXPONENT: bits, TANGENT_ERROR: error, "regime": "undecided"}) is says
