"""The answer of a sweep names regimes, jumps, chaos and the load that may be used, and is short whatever was run."""

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


def test_the_answer_of_a_sweep_names_regimes_jumps_chaos_and_the_load_that_may_be_used():
    chaos = {"lyapunov_tangent_bits_per_period": 0.09, "lyapunov_tangent_error": 0.01, "loop_releases": 3}
    after = {"radius_min_m": 17.0, "slack_fraction": 0.6}
    rows = [
        *(row(0.01 * number, peak=3000.0 + number) for number in range(1, 6)),
        row(0.06, "period-2", 9000.0, **after),
        row(0.07, "chaotic", 9100.0, **after, **chaos),
        row(0.08, "undecided", 9050.0, **after),
        {"steepness": 0.09, "status": "newton-failed", "regime": None, "tension_top_max_N": None},
    ]
    scene = load_scene("tethered_buoy")
    times = 9100.0 / natural_frequencies(scene).static_tension_N
    regular = [
        "Regular up to kA = 0.06: period 1 and 2.",
        "Between kA = 0.05 and 0.06 the motion jumps to one 4 times as large: peak tension 3 -> 9 kN, "
        "swing of r 1.00 -> 4.00 m, time with less than 5 % of the static tension 0 -> 60 %.",
        "Chaotic at kA = 0.07: neighbours part by 0.09 bits a wave (standard error 0.01).",
        "Not decided: tests disagree at kA = 0.08.",
    ]
    largest = f"Largest tension 9.1 kN at kA = 0.07 ({times:.1f} times static)"

    def answer(rows, companions=()):
        return [line.partition(" Checked")[0] for line in sentences(rows, "steepness", "kA", scene, companions)]

    assert answer(rows[::-1]) == [
        *regular,
        f"{largest}.",
        "It is no load to design for, because loops were released (motion.dimensions).",
        "Largest tension without that: 9.05 kN at kA = 0.08.",
    ]
    for one in rows[5:8]:
        one["max_buoy_height_above_water_m"] = 1.1 * scene.buoy.diameter_m
    length = {"periods": 90, "transient_periods": 45, "max_buoy_height_above_water_m": 9.0}
    capped = {0.07: 4000.0, 0.08: 5000.0}
    companions = [row(kA, "", peak, role="wetted cap", **length) for kA, peak in capped.items()]
    assert answer(rows, companions) == [
        *regular,
        f"{largest}; with the wetted cap 4 kN.",
        "It is no load to design for, because the sphere flies above still water with all its buoyancy "
        "(buoy.submergence) and loops were released (motion.dimensions).",
        "With the wetted cap the largest tension is 5 kN at kA = 0.08.",
    ]


@pytest.mark.parametrize("count", [0, 1, 2, 40])
def test_an_answer_is_short_whatever_was_run(count):
    words = ["period-1", "period-12", "quasi-periodic", "chaotic", "transient", "undecided", ""]
    rng = np.random.default_rng(count)
    rows = [
        row(0.01 * n, rng.choice(words), float(10 ** rng.uniform(3.0, 5.0)), loop_releases=n % 2) for n in range(count)
    ]
    said = sentences(rows, "steepness", "kA", load_scene("tethered_buoy"))
    assert 1 <= len(said) <= MOST_LINES and all(len(line) < 400 and "nan" not in line for line in said)
