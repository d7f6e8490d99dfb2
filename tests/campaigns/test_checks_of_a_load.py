"""What an answer says was checked of a load follows from the row and from the scene; so does why nothing is judged."""

import tomllib
from pathlib import Path

import pytest

from analysis.looks import BLURRED, OF_STEPS
from campaigns.explore.answer import sentences
from campaigns.explore.load import load, use_of
from engine import load_scene
from engine.trajectory.excursions import BED
from tables import OPEN, OTHER_MOTION, PEAK

SEA = {"waves.jonswap.significant_height_m": 1.0}
LOAD = tomllib.loads(Path(__file__).with_name("answers.toml").read_text(encoding="utf-8"))["load"]
PULLS, KNOWN, IN_SCENE = LOAD["row"], LOAD["known"], LOAD["in_scene"]


def checked(row, scene, searched=False) -> tuple[str, str]:
    """The two lists of the sentence."""
    words_of_use = use_of(row, scene, searched)
    passed, _, missing = words_of_use.partition("; not checked: ")
    assert passed.startswith("Checked: ") and missing
    return passed, missing


def test_of_a_bare_row_nothing_was_checked_and_of_the_best_one_the_sea_is_left():
    scene = load_scene("tethered_buoy")
    assert checked(PULLS, scene)[0] == "Checked: none"
    best = PULLS | {name: entry for known in KNOWN.values() for name, entry in known.items()}
    bedded = load_scene("tethered_buoy", IN_SCENE["sea bed"])
    assert (
        checked(best, bedded, searched=True)[1]
        == "an irregular sea and what the scene is given (stiffness, drag, masses)."
    )


@pytest.mark.parametrize("regime", OPEN)
def test_a_motion_without_a_verdict_is_not_settled(regime):
    assert "a settled motion" in checked(PULLS | {"regime": regime}, load_scene("tethered_buoy"))[1]


def test_a_load_names_its_share_of_a_known_breaking_load_only():
    row = PULLS | {"utilisation": 0.0173}
    assert "1.7 % of the breaking load" in load([row], {"steepness": "kA"}, load_scene("tethered_buoy"))
    assert "breaking load" not in load([PULLS], {"steepness": "kA"}, load_scene("tethered_buoy"))


@pytest.mark.parametrize(
    ("fault", "kind"),
    [
        ({"max_buoy_emergence": 0.5}, "Largest of the runs that stay in the water"),
        ({"loop_releases": 1}, "Largest without these faults"),
    ],
)
def test_the_largest_tension_without_a_fault_says_which_fault_it_is_without(fault, kind):
    rows = [PULLS | {PEAK: 2000.0, "dimensions": 2} | fault, PULLS | {"steepness": 0.05}]
    assert f"{kind}: 1 kN" in load(rows, {"steepness": "kA"}, load_scene("tethered_buoy"))


@pytest.mark.parametrize(("share", "words"), [(0.95, "95 % of"), (1.67, "167 % of")])
def test_a_line_that_breaks_is_not_for_design(share, words):
    text = load([PULLS | {"utilisation": share}], {"steepness": "kA"}, load_scene("tethered_buoy"))
    assert words in text and ("Not for design: the line breaks" in text) == (share > 1.0)


@pytest.mark.parametrize(("most_N", "words"), [(1040.0, "load,"), (2500.0, "load (2.5 kN, 0 m from the anchor),")])
def test_a_share_of_the_breaking_load_says_where_the_line_is_pulled_if_not_at_its_top(most_N, words):
    """The peak is 1000 N at the top."""
    row = PULLS | {"utilisation": most_N / 1e4, "tension_line_max_N": most_N, "tension_line_max_s_m": 0.0}
    text = load([row], {"steepness": "kA"}, load_scene("tethered_buoy"))
    assert f"% of the breaking {words}" in text and text.count("from the anchor") <= 1


@pytest.mark.parametrize(
    ("more", "told"),
    [({}, True), ({"tension_top_start_N": 1200.0}, False), ({"found_by": "kick"}, False)],
    ids=["from rest", "little more", "kicked"],
)
def test_a_start_up_that_pulls_far_more_than_all_motions_is_told(more, told):
    """The peak is 1000 N; a kick pulls as hard as it is."""
    rows = [PULLS, PULLS | {"steepness": 0.05, "tension_top_start_N": 3000.0} | more]
    text = load(rows, {"steepness": "kA"}, load_scene("tethered_buoy"))
    assert ("pulls up to 3 kN, kA = 0.05" in text) == told


@pytest.mark.parametrize(
    ("start_N", "peak_N", "told"), [(1200.0, 1000.0, True), (1080.0, 1000.0, False), (1800.0, 1200.0, True)]
)
def test_a_start_up_tells_its_share_of_the_breaking_load_which_it_may_exceed_alone(start_N, peak_N, told):
    """The line breaks at 1100 N: a start-up above that is told though it is little above the peak."""
    scene = load_scene("tethered_buoy", {"tether.breaking_load_N": 1100.0})
    row = PULLS | {PEAK: peak_N, "tension_top_start_N": start_N, "utilisation": peak_N / 1100.0}
    words = f"pulls up to {start_N / 1e3:g} kN, {100.0 * start_N / 1100.0:.0f} % of the breaking load, kA = 0.1"
    assert (words in load([row], {"steepness": "kA"}, scene)) == told


@pytest.mark.parametrize(
    ("name", "row", "changes"),
    [*((name, row, {}) for name, row in KNOWN.items()), *((name, {}, changes) for name, changes in IN_SCENE.items())],
)
def test_what_a_row_knows_or_a_scene_has_was_checked(name, row, changes):
    passed, missing = checked(PULLS | row, load_scene("tethered_buoy", changes))
    assert name in passed and name not in missing


def test_the_error_of_the_largest_tension_is_told_in_kN_and_per_cent():
    line, *_ = sentences([PULLS | KNOWN["grid and steps"]], "steepness", "kA", load_scene("tethered_buoy"))
    assert "1 kN (± 0.03 kN by grid and steps)" in line and "grid and steps (± 3 %)" in line


@pytest.mark.parametrize(("most_N", "told"), [(1040.0, False), (2500.0, True)])
def test_a_line_that_bears_more_below_its_top_is_told_where_and_at_which_value(most_N, told):
    """As a rope that floats: the anchor holds it down. The peak at the top is 1000 N."""
    rows = [PULLS, PULLS | {"steepness": 0.2, PEAK: 900.0, "tension_line_max_N": most_N, "tension_line_max_s_m": 0.0}]
    words = "Below its top the line bears up to 2.5 kN, 0 m from the anchor, kA = 0.2."
    assert (words in load(rows, {"steepness": "kA"}, load_scene("tethered_buoy"))) == told


def test_a_line_that_lay_below_the_bed_is_told_beside_the_bed_that_was_not_checked():
    row = PULLS | {"message": BED.format(most=0.72, first=30.7)}
    scene = load_scene("tethered_buoy")
    words = "the sea bed (the line lay below it: --set floor.stiffness_Npm3=1e5)"
    assert words in checked(row, scene)[1] and words not in checked(PULLS, scene)[1]


@pytest.mark.parametrize(("dimensions", "doubted"), [(2, True), (3, False)])
def test_loops_speak_against_a_tension_in_a_plane_alone(dimensions, doubted):
    words_of_use = use_of(PULLS | {"dimensions": dimensions, "loop_releases": 1}, load_scene("tethered_buoy"), True)
    assert ("1 loop released in a plane" in words_of_use) is doubted


def test_a_motion_that_becomes_another_one_is_not_for_design():
    words_of_use = use_of(PULLS | {"message": f"with more nodes it {OTHER_MOTION}"}, load_scene("tethered_buoy"), True)
    assert words_of_use == f"Not for design: with smaller elements and steps it {OTHER_MOTION}."


def test_chaos_of_one_tolerance_waits_for_a_tighter_one():
    chaos = PULLS | {"regime": "undecided", "regime_reason": f"{OF_STEPS}: perturbations shrink"}
    *_, line = sentences([chaos], "steepness", "kA", load_scene("tethered_buoy"))
    assert line.startswith("OPEN") and "solver.rtol" in line and "tests of the regime" not in line


def test_what_steps_blur_waits_for_a_tighter_tolerance_and_not_for_a_longer_run():
    blurred = PULLS | {"regime": "undecided", "regime_reason": f"no period is met: {BLURRED}"}
    *_, line = sentences([blurred], "steepness", "kA", load_scene("tethered_buoy"))
    assert line.startswith("OPEN") and "solver.rtol" in line and "--budget" not in line


def test_other_motions_were_looked_for_where_a_kick_ended_in_a_motion():
    scene = load_scene("tethered_buoy")
    single = sentences([PULLS], "steepness", "kA", scene)
    kicked = sentences([PULLS | {"share": 0.5}], "steepness", "kA", scene)
    lost = sentences([PULLS | {"share": 0.0}], "steepness", "kA", scene)
    assert "other motions" in single[0].partition("not checked")[2]
    assert "other motions" not in kicked[0].partition("not checked")[2]
    assert "other motions" in lost[0].partition("not checked")[2]


def test_a_random_sea_says_how_long_it_was():
    missing = checked(PULLS, load_scene("tethered_buoy", SEA))[1]
    assert "6 min" in missing and "irregular" not in missing


@pytest.mark.parametrize(
    ("scene", "changes", "why"),
    [
        ("tethered_buoy", {}, "--periods ended them"),
        ("tethered_buoy", SEA, "only for a buoy in regular waves"),
        ("tethered_buoy", {"tether.bending_stiffness_Nm2": 0.0}, "bending stiffness"),
    ],
)
def test_more_periods_are_asked_for_only_where_they_would_help(scene, changes, why):
    undecided = sentences([PULLS], "steepness", "kA", load_scene(scene, changes))[-1]
    assert undecided.startswith("OPEN") and why in undecided and ("--periods" in undecided) == ("--periods" in why)
