"""Answers of basins, orbits and seas say the numbers of their tables, each with its error, and every caveat."""

import math
import tomllib
from dataclasses import replace
from pathlib import Path

import pytest

from campaigns import sea
from campaigns.answers import in_newtons
from campaigns.basins.answer import sentences as of_basins
from campaigns.orbits.answer import sentences as of_orbits
from campaigns.regime_map.answer import _use as largest_usable
from campaigns.sea.answer import sentences as of_sea
from campaigns.sweep.seas import sentences as of_sweep_in_a_sea
from engine import load_scene
from tables import PEAK, Column

ANSWERS = tomllib.loads(Path(__file__).with_name("answers.toml").read_text(encoding="utf-8"))
SEA = ANSWERS["sea"]["row"]


def basins(**changes):
    """The answer of basins; changes: of the motion that pulls hardest."""
    tables, scene = ANSWERS["basins"], load_scene("tethered_buoy", {"water.depth_m": 22.5})
    calm, worst = tables["motions"]
    parts = {"motions": [calm, worst | changes], "shock": tables["shock"], "edge": []}
    return "\n".join(of_basins(tables["starts"], ["vx", "vz"], scene, parts))


@pytest.mark.parametrize("confirmed", ["NOT on 81 nodes", "not settled on 81 nodes"])
def test_basins_name_the_dangerous_motion_what_leads_to_it_and_what_is_not_sure(confirmed):
    answer = basins(confirmed=confirmed)
    assert all(words in answer for words in ANSWERS["basins"]["words"])
    assert f"It depends on how it is computed: B is found {confirmed}." in answer
    assert "Each motion stays at a tenth of the tolerance" in basins()
    assert "A pulls hardest: no start of the grid leads to more" in basins(tension_top_max_N=3000.0)
    assert "one grid" in basins(regime="chaotic") and "one grid" not in answer


def test_orbits_are_told_with_errors_and_those_known_badly_apart():
    tables = ANSWERS["orbits"]
    assert list(of_orbits(tables["rows"], Column("kA", "", "kA", "", 4), tables["parts"])) == tables["lines"]


def test_orbits_stop_being_stable_at_the_event_beside_them_not_at_one_of_others_at_that_value():
    """A flip at 0.0614 kA and 1.8 kN; behind it the branch folds back at 0.0546, where it pulls with 2.9 kN."""
    rows, events = [], []
    for kA, kN, unstable in ((0.04, 1.6, 0), (0.055, 1.7, 0), (0.064, 1.8, 1), (0.056, 2.8, 1), (0.0547, 2.9, 0)):
        rows.append({"branch": "1", "kA": kA, "unstable": unstable, PEAK: 1e3 * kN})
    for kind, kA, kN in (("flip", 0.0614, 1.79), ("fold", 0.0546, 2.86)):
        events.append({"branch": "1", "kind": kind, "kA": kA, "error": 1e-5, "finer": kA, PEAK: 1e3 * kN})
    branch = {"branch": "1", "status": "ok", "motion": "", "closed": 0, "begins": "", "ends": ""}
    parts = {"branches": [branch], "events": events, "orbits": []}
    _, sentence, *_ = of_orbits(rows, Column("kA", "", "kA", "", 4), parts)
    assert "stable at kA = 0.04 to 0.0614 and 0.0546 to 0.0547" in sentence


OPTIONS = sea.Options(starts=4, slope=5.0, window=10, distance=0.05, no_regular=False, most_hours=12.0)


def test_nothing_is_said_of_an_interval_that_there_is_not():
    """Without a three-hour maximum; nor of one motion each, where the motions of a wave pull about alike."""
    cell = SEA | {"storm_maximum_N": math.nan, "storm_reason": "few blocks", "load_scatter": 0.2, "largest_N": 9.1e3}
    words = "\n".join(of_sea([cell | {"large_share": math.nan}], OPTIONS))
    assert "9.1 kN" in words and "few blocks" in words
    assert "differ by 20 %" in words and "interval" not in words and "one motion each" not in words


def test_a_share_of_almost_all_is_in_plain_digits():
    for share in (0.996, 1.0):
        words = "\n".join(of_sea([SEA | {"large_share": share, "forecast_share": share}], OPTIONS))
        assert words.count("100 %") == 2


def test_no_more_seas_are_advised_where_no_seed_draws_others():
    options = replace(OPTIONS, one_sea=True, most_hours=0.0)
    cell = SEA | {"sign": "open"}
    for cells in ([cell], [cell, cell]):
        words = "\n".join(of_sea(cells, options))
        assert "not decided" in words and "--seeds" not in words and "--most-hours" not in words


@pytest.mark.parametrize(
    ("entries", "words"),
    [
        ({"sign": "+"}, "never forgets"),
        ({"sign": "open"}, "--most-hours above 12 draws more seas"),
        ({"apart_seas": 8.0}, "more than one response"),
    ],
)
def test_a_sea_whose_start_is_not_forgotten_says_so(entries, words):
    (starts,) = (
        line for line in of_sea([SEA | {"together_periods": math.nan} | entries], OPTIONS) if line.startswith("STARTS")
    )
    assert words in starts


def test_no_load_of_a_sphere_that_comes_out_of_the_water_is_for_design():
    dry, wet = SEA | {"max_buoy_emergence": 0.06}, SEA | {"max_buoy_emergence": 0.05}
    loads = [next(of_sea([cell], OPTIONS)) for cell in (dry, wet, SEA)]
    assert ["Not for design: the buoy comes out" in load for load in loads] == [True, False, False]
    assert any("No load of 1 state is for design" in words for words in of_sea([dry, wet], OPTIONS))


def test_more_hours_are_advised_for_seas_that_are_open_not_for_runs_that_failed():
    cells = [SEA | {"sign": sign, "storm_maximum_N": 1e4} for sign in ("−", "+", "open", None)]
    words = next(of_sea([*cells, {"status": "newton-failed"}], OPTIONS))
    assert "1 make the buoy forget" in words and "1 are not decided" in words and "of 2 there is no exponent" in words
    assert "--most-hours" not in next(of_sea([*cells[:2], cells[-1]], OPTIONS))


def test_a_sea_is_told_with_intervals_and_what_a_finer_run_and_the_steps_leave_open():
    answer = "\n".join(of_sea([SEA], OPTIONS))
    assert answer.startswith("LOAD     most probable three-hour maximum 12 kN (90 % interval 11 kN to 14 kN)")
    assert all(words in answer for words in ANSWERS["sea"]["words"])
    sure = "\n".join(of_sea([SEA | {"finer_bits_per_period": -0.09, "noise": 0.001, "load_scatter": 0.04}], OPTIONS))
    assert "finer runs agrees" in sure and "differ by" not in sure and "by the steps" not in sure


def test_a_map_names_the_largest_tension_and_the_largest_that_may_be_used():
    """A line that releases loops in a plane may not."""
    keys = (Column("kA", "", "kA", "steepness"), Column("H", "m", "H", "depth"))
    motions = [
        {PEAK: 1000.0 * pull, "loop_releases": loops, "dimensions": 2, "kA": 0.01 * pull, "H": 21.0}
        for pull, loops in ((2.0, 0), (5.0, 3), (4.0, 0), (9.0, 1))
    ]
    (sentence,) = largest_usable(motions, keys, lambda row: None)
    assert sentence.startswith("Not for design: 1 loop released") and "4 kN, at kA = 0.04" in sentence


@pytest.mark.parametrize(("left_out", "told"), [(0.0, True), (10.0, False)])
def test_a_sweep_in_a_sea_that_leaves_nothing_out_doubts_its_first_moments(left_out, told):
    row = {"kA": 0.1, "status": "ok", PEAK: 9e3, "transient_periods": left_out, "significant_elevation_m": 1.0}
    row |= {"tension_mean_N": 5e3, "tension_std_N": 800.0}
    scene = load_scene("tethered_buoy", {"waves.jonswap.significant_height_m": 1.0})
    first, *_ = of_sweep_in_a_sea([row], {"kA": "kA"}, scene)
    assert first.startswith("SEA") and ("may pull hardest as they set in" in first) == told


def test_a_sweep_in_a_sea_names_where_the_tension_varies_least_and_most():
    rows = []
    for kA, mean_N, deviation_N in ((0.1, 5e3, 800.0), (0.2, 6e3, 300.0), (0.3, 5500.0, 500.0)):
        row = {"kA": kA, "status": "ok", PEAK: 9e3, "transient_periods": 10.0, "significant_elevation_m": 1.0}
        rows.append(row | {"tension_mean_N": mean_N, "tension_std_N": deviation_N})
    scene = load_scene("tethered_buoy", {"waves.jonswap.significant_height_m": 1.0})
    (tension,) = (line for line in of_sweep_in_a_sea(rows, {"kA": "kA"}, scene) if line.startswith("TENSION"))
    assert tension.endswith("mean 5 kN to 6 kN; standard deviation 0.3 kN at kA = 0.2 to 0.8 kN at kA = 0.1.")


@pytest.mark.parametrize(
    ("forces_N", "words"),
    [
        ((9450.0,), "9.45 kN"),
        ((4400.0, 9400.0), "4.4 -> 9.4 kN"),
        ((0.594,), "0.594 N"),
        ((3.0, 12.0), "0.003 -> 0.012 kN"),
    ],
)
def test_a_force_of_a_model_is_told_in_newtons(forces_N, words):
    assert in_newtons(*forces_N) == words
