"""The answer of a sweep has the numbers of the rows of its tables, and is short whatever was run."""

import numpy as np
import pytest

from campaigns.explore.answer import sentences
from campaigns.machinery.session import MOST_LINES
from engine import load_scene
from engine.natural_frequencies import natural_frequencies


def row(steepness, regime="period-1", peak=3000.0, **known):
    usual = {"radius_min_m": 20.0, "radius_max_m": 21.0, "slack_fraction": 0.0, "max_buoy_height_above_water_m": 0.5}
    named = {"steepness": steepness, "dimensions": 2, "status": "ok", "regime": regime, "tension_top_max_N": peak}
    return named | usual | known


def answer(rows, companions=(), ends=(), scene="tethered_buoy") -> dict[str, str]:
    """The lines by the word that each begins with."""
    lines = sentences(rows, "steepness", "kA", load_scene(scene), companions, ends)
    return dict(line.split(maxsplit=1) for line in lines)


AFTER = {"radius_min_m": 17.0, "slack_fraction": 0.6, "loop_releases": 3, "lyapunov_tangent_error": 0.01}
FROM_REST = [
    *(row(0.01 * number, peak=3000.0 + number) for number in range(1, 6)),
    row(0.06, "period-2", 9000.0, **AFTER | {"loop_releases": 0}),
    row(0.065, "chaotic", 9050.0, lyapunov_tangent_bits_per_period=0.05, **AFTER),
    row(0.07, "chaotic", 9100.0, lyapunov_tangent_bits_per_period=0.2, **AFTER),
    row(0.08, "undecided", 9050.0, **AFTER | {"loop_releases": 0}),
    {"steepness": 0.09, "status": "newton-failed", "regime": None, "tension_top_max_N": None},
]


def test_lines_come_in_the_order_of_their_use_with_the_numbers_of_the_rows():
    lines = answer(FROM_REST[::-1])
    assert list(lines) == ["LOAD", "JUMP", "MOTIONS", "STARTS", "CHAOS", "OPEN"]
    times = 9100.0 / natural_frequencies(load_scene("tethered_buoy")).static_tension_N
    assert f"9.1 kN, {times:.1f} times static" in lines["LOAD"] and "9.05 kN, kA = 0.08" in lines["LOAD"]
    assert "between 0.05 and 0.06 (3 -> 9 kN)" in lines["JUMP"] and "1.00 to 4.00 m" in lines["JUMP"]
    assert "period 1 to 0.05, period 2 at 0.06, chaotic at 0.065 to 0.07, undecided at 0.08" in lines["MOTIONS"]
    assert "0.05 to 0.2 bits a wave (± 0.01)" in lines["CHAOS"] and "doubles in 5 to 20 waves" in lines["CHAOS"]
    assert "0.09 (newton-failed" in lines["OPEN"] and "kA = 0.08 the tests" in lines["OPEN"]


def test_of_a_buoy_that_flies_the_load_is_told_with_the_wetted_cap_and_without_flight():
    flying = [kept | {"max_buoy_height_above_water_m": 9.0} for kept in FROM_REST[5:9]]
    capped = [row(kA, "", peak, role="wetted cap") for kA, peak in {0.07: 4000.0, 0.08: 5000.0}.items()]
    load = answer(FROM_REST[:5] + flying, capped)["LOAD"]
    assert "Not for design: the buoy leaves the water" in load and "With the wetted cap at most 5 kN" in load
    assert "stay in the water: 3 kN" in load


def coexisting(kicks):
    """Motion A from rest up to kA = 0.03, B from 0.03 on; at 0.03 some of 8 kicks end in B."""
    share = {"kicks": 8, "share_low": 0.1, "share_high": 0.6}
    rows = [row(0.01 * number, motion="A", found_by="rest", share=0.75, **share) for number in range(1, 4)]
    rows.append(row(0.03, "period-2", 8000.0, motion="B", found_by="kick", share=kicks / 8, **share))
    rows.append(row(0.04, "period-2", 9000.0, motion="B", found_by="rest", share=1.0, **share))
    return rows


def test_motions_become_others_as_the_table_of_ends_says():
    upper = {"motion": "A", "end": "upper", "steepness_with": 0.04, "steepness_without": 0.042, "leads_to": "B"}
    lower = {"motion": "B", "end": "lower", "steepness_with": 0.025, "steepness_without": 0.024, "leads_to": "A"}
    ends = [upper | {"kind": "", "steepness_end": None}, lower | {"kind": "fold", "steepness_end": 0.0246}]
    jump = answer(coexisting(2), ends=ends)["JUMP"]
    assert jump.startswith("Rising kA: A becomes B above 0.041 (3 -> 9 kN, by bisection).")
    assert "Falling kA: B becomes A below 0.0246 (8 -> 3 kN, fold)." in jump


@pytest.mark.parametrize("kicks", [0, 2, 4])
def test_kicks_are_counted_with_an_interval(kicks):
    assert f"{kicks} of 8 kicks (95 % interval 10 to 60 %) end in motion B" in answer(coexisting(kicks))["STARTS"]


def test_a_rest_that_leaves_a_motion_which_goes_on_is_told_as_early():
    rows = [row(0.02, motion="A"), row(0.03, motion="A"), row(0.04, motion="A", found_by="kick")]
    rows += [row(0.04, "chaotic", 9000.0, motion="B"), row(0.05, "chaotic", 9100.0, motion="B")]
    end = {"motion": "B", "end": "lower", "steepness_with": 0.035, "steepness_without": 0.033, "leads_to": "A"}
    ends = [end | {"kind": "", "steepness_end": None}]
    assert "From rest already: A becomes B between 0.03 and 0.04" in answer(rows, ends=ends)["JUMP"]


def test_snaps_are_told_motion_by_motion_and_left_out_where_none_are_counted():
    known = {"snap_peak_median_N": 4000.0, "snap_peak_95_N": 4500.0, "snap_speed_max_mps": 1.5, "snap_rise_s": 0.4}
    rows = [
        row(0.01, snaps_per_wave=0.0, motion="A"),
        row(0.02, snaps_per_wave=1.0, motion="A", snap_peak_max_N=5000.0, **known),
        row(0.03, snaps_per_wave=0.5, motion="A", snap_peak_max_N=6000.0, **known | {"snap_speed_max_mps": 3.0}),
    ]
    line = answer(rows)["SNAPS"]
    assert "0.5 to 1 a wave from kA = 0.02 on" in line
    peaks = "At kA = 0.03 median 4 kN, 95 % below 4.5 kN, largest 6 kN, within 0.4 s of becoming taut."
    assert f"{peaks} Snap speed up to 3 m/s, at kA = 0.03." in line
    assert answer(rows[:1])["SNAPS"].startswith("none")
    assert "SNAPS" not in answer([row(0.01), row(0.02)])


@pytest.mark.parametrize("count", [0, 1, 2, 40])
def test_an_answer_is_short_whatever_was_run(count):
    words = ["period-1", "period-12", "quasi-periodic", "chaotic", "transient", "undecided", ""]
    rng = np.random.default_rng(count)
    rows = [
        row(0.01 * n, rng.choice(words), float(10 ** rng.uniform(3.0, 5.0)), loop_releases=n % 2) for n in range(count)
    ]
    lines = sentences(rows, "steepness", "kA", load_scene("tethered_buoy"))
    assert 1 <= len(lines) <= MOST_LINES and all(len(line) < 700 and "nan" not in line for line in lines)
