"""Answers of basins, orbits and seas say the numbers of their tables, each with its error, and every caveat."""

import math

import pytest

from campaigns import sea
from campaigns.basins.answer import sentences as of_basins
from campaigns.orbits.answer import sentences as of_orbits
from campaigns.sea.answer import sentences as of_sea
from engine import load_scene
from tables import Column

CALM = {"motion": "A", "status": "ok", "found_by": "rest", "tension_top_max_N": 4000.0, "confirmed": "on 81 nodes"}
WORST = CALM | {"motion": "B", "found_by": "grid", "tension_top_max_N": 9000.0}
SHOCK = {"motion": "B", "status": "ok", "size": 2.0, "kick_x_mps": 1.0, "kick_z_mps": 1.0, "nodes": 41}


def basins(worst):
    scene = load_scene("tethered_buoy", {"water.depth_m": 22.5})
    starts = [{"motion": letter, "status": "ok"} for letter in "AAB"]
    starts += [{"motion": "", "status": "ok", "outcome": "unsettled"}, {"motion": "", "status": "newton-failed"}]
    motions = [motion | {"regime": "period-1", "steepness": 0.13} for motion in (CALM, worst)]
    parts = {"motions": motions, "shock": [SHOCK, SHOCK | {"nodes": 81}], "edge": []}
    return "\n".join(of_basins(starts, ["vx", "vz"], scene, parts))


@pytest.mark.parametrize("confirmed", ["NOT on 81 nodes", "not settled on 81 nodes"])
def test_basins_name_the_dangerous_motion_what_leads_to_it_and_what_is_not_sure(confirmed):
    answer = basins(WORST | {"confirmed": confirmed})
    for words in (
        "kA = 0.13 and H = 22.5 m: A from rest (period-1, 4 kN) and B (period-1, 9 kN).",
        "Of 5 starts 2 end in A and 1 end in B; 1 had not settled, and 1 failed.",
        "B is the dangerous one: it pulls 2.2 times as hard as A.",
        "2 m/s along the waves, 45 degrees upwards is the smallest that leads to B",
        f"It depends on how it is computed: B is found {confirmed}.",
    ):
        assert words in answer
    assert "Each motion stays at a tenth of the tolerance" in basins(WORST)
    assert "A pulls hardest: no start of the grid leads to more" in basins(WORST | {"tension_top_max_N": 3000.0})


def test_orbits_are_told_with_errors_and_those_known_badly_apart():
    def of_branch(**entries):
        return {"branch": "1", "kA": 0.12, "period": 1} | entries

    orbits = [of_branch(kA=kA, unstable=int(kA > 0.115)) for kA in (0.1, 0.11, 0.12)]
    flip = of_branch(kind="flip", kA=0.115, error=1e-5, finer="")
    fold = of_branch(kind="fold", kA=0.13, error=1e-3, finer=0.13)
    leading = {"multiplier_1_imag": 0.0, "multiplier_1_error": 0.02}
    stable = of_branch(unstable=0, tension_top_max_N=3e3, multiplier_1_real=0.5, **leading)
    unstable = of_branch(unstable=1, tension_top_max_N=5e3, multiplier_1_real=-1.5, **leading)
    sound = of_branch(motion="A", status="ok", closed=0)
    failed = of_branch(branch="2", motion="", status="no-orbit", period=2, message="a loop is released")
    parts = {"branches": [sound, failed], "events": [flip, fold], "orbits": [stable, unstable]}
    assert list(of_orbits(orbits, Column("kA", "", "kA", "", 4), parts)) == [
        "3 orbits on 1 branches, 2 of them stable, 1 not.",
        "Period 1 (motion A): stable at kA = 0.1 to 0.115; flip at 0.115 ± 1e-05 on this grid alone and fold at "
        "0.13 ± 0.001.",
        "At kA = 0.12 stable: period 1 (3 kN, μ = 0.5 ± 0.02); unstable, and between: period 1 (5 kN, μ = -1.5 ± "
        "0.02).",
        "Known to no better than 0.0002: fold at 0.13 ± 0.001.",
        "Without a branch: period 2 (a loop is released).",
    ]


SEA = {
    "status": "ok", "seas": 8.0, "apart_seas": 1.0, "sign": "−", "together_periods": 104.0, "partings_per_hour": 0.5,
    "lyapunov_tangent_bits_per_period": -0.1, "lyapunov_tangent_error": 0.01, "growing_share": 0.25,
    "large_share": 0.2, "large_mean_periods": 7.0, "forecast_share": 0.1, "forecast_mean_periods": 5.0,
    "snaps_per_hour": 41.0, "snaps_per_hour_error": 3.0, "storm_maximum_N": 12e3, "storm_low_N": 11e3,
    "storm_high_N": 14e3, "regular_N": 6e3, "regular_high_N": 8e3, "equivalent_load_N": 1.5e3, "utilisation": 0.4,
    "finer_bits_per_period": -0.05, "finer_error": 0.01, "noise": 0.03,
    "significant_height_m": 2.5, "load_scatter": 0.12,
}  # fmt: skip


OPTIONS = sea.Options(starts=4, slope=5.0, window=10, distance=0.05, no_regular=False, most_hours=12.0)


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


def test_a_sea_is_told_with_intervals_and_what_a_finer_run_and_the_steps_leave_open():
    answer = "\n".join(of_sea([SEA], OPTIONS))
    assert answer.startswith("LOAD     most probable three-hour maximum 12 kN (90 % interval 11 to 14)")
    for words in (
        "forgets how it began after about 100 periods; in 1 of 8 seas its starts were still apart",
        "part the starts again 0.5 times an hour",
        "-0.100 ± 0.010 bits a peak period; it grows in 25 % of the windows of 10 periods",
        "large motion 20 % of the time, for 7 periods on average; a slow envelope would give 10 % and 5 periods",
        "in a sea of H_s = 2.5 m, 2.0 times that of the regular design wave of H_s and 1.5 times that of 1.86 H_s",
        "41 an hour (± 3)",
        "1.5 kN a peak period does the damage of the sea (S-N slope 5)",
        "DNV-OS-E301, consequence class 1, the line is used to 40 %",
        "finer runs does NOT agree: -0.050 ± 0.010",
        "differ by 12 % in their largest tension",
        "still 0.03 of the motion apart, by the steps of the solver",
    ):
        assert words in answer
    sure = "\n".join(of_sea([SEA | {"finer_bits_per_period": -0.09, "noise": 0.001, "load_scatter": 0.04}], OPTIONS))
    assert "finer runs agrees" in sure and "differ by" not in sure and "by the steps" not in sure
