"""Section 4.1: when the waves of the breaking line arrive, and what runs with what."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from ...breaking_line import statements as own
from ...breaking_line.runs import FAST, SLOW, Line, find, of_kind
from ...parts.statements import Statement
from ...parts.wording import number, percent
from ..results import Results

PRINTED_SHARES = {"1": 0.10, "2": 0.40, "3": 0.70}  # of the strength, which case 4 has
SAME_SHARE = 0.005  # they are printed in whole per cent
APART = 0.01  # of the speed, above which two fronts are different
FRONT = 0.02  # of the static tension lost, of the end speed gained: where a front is taken to be
TOGETHER = 0.02  # of the line, up to which two fronts are together


def shares_of_strength(results: Results) -> Statement:
    strongest = find(results.lines, "4")
    forces = own.in_turn(results.lines, FAST[:3], "force_N") if strongest is not None else []
    shares = [(name, force / strongest.value("force_N")) for name, force in forces]
    return Statement(
        "The tensions of cases 1, 2 and 3 are 10, 40 and 70 % of the breaking strength, which is that of case 4.",
        f"Over that of case 4, %: {own.told([(name, 100 * share) for name, share in shares], 1)}.",
        tuple((f"case {name}", abs(share - PRINTED_SHARES[name]) < SAME_SHARE) for name, share in shares),
        f"within {percent(SAME_SHARE)}",
    )


def covered(results: Results) -> Statement:
    lines = [line for line in of_kind(results.lines, "case") if math.isfinite(line.value("arrival_theory_s"))]
    times = [(line.name, line.value("end_time_s") / line.value("arrival_theory_s")) for line in lines]
    return Statement(
        "The times that the figures cover suit the wave: it runs along the whole line within them.",
        f"Time covered over that of the first arrival at the fixed end: {own.told(times, 2)}.",
        own.each(times, lambda ratio: ratio > 1.0),
        "more than once the time of arrival (by the printed times it would not arrive)",
    )


def differs(results: Results) -> Statement:
    numbers = own.in_turn(results.lines, FAST, "front_speed_theory_mps")
    claim = "The speed of the front depends on the static tension: it is another in every case."
    if len(numbers) < 2:
        return Statement(claim, "No run shows it.", ())
    found = f"√(T′/m) at the static tension, m/s: {own.told(numbers, 0)}; it is no rising function of it."
    if all(holds for _, holds in own.rises(numbers)):
        found = f"√(T′/m) at the static tension, m/s: {own.told(numbers, 0)}."
    ordered = sorted(speed for _, speed in numbers)
    apart = all(b / a - 1.0 > APART for a, b in pairwise(ordered))
    return Statement(claim, found, (("all cases", apart),), f"more than {percent(APART)} apart")


def together(results: Results) -> Statement:
    lines = [find(results.lines, case) for case in FAST]
    apart = [(line.name, _apart(line)) for line in lines if line is not None]
    numbers = [(name, share) for name, share in apart if math.isfinite(share)]
    return Statement(
        "The front of the velocity runs with that of the tension.",
        f"Distance of the two, half way, over the length of the line, %: "
        f"{own.told([(name, 100 * share) for name, share in numbers], 2)}.",
        own.each(numbers, lambda share: share < TOGETHER),
        f"within {percent(TOGETHER)} of the line, each where {percent(FRONT)} is lost or gained",
    )


def _apart(line: Line) -> float:
    """Distance of the foremost nodes without FRONT of the tension, and with FRONT of the end speed, over the length."""
    profiles = None if line.trajectory is None else line.trajectory.profiles
    if profiles is None or not math.isfinite(line.value("arrival_theory_s")):
        return math.nan
    row = int(np.argmin(np.abs(profiles.time_s - 0.5 * line.value("arrival_theory_s"))))
    loose = profiles.tension_N[row] < (1.0 - FRONT) * line.value("force_N")
    moving = profiles.speed_mps[row] > FRONT * line.value("end_speed_mps")
    if not (loose.any() and moving.any()):
        return math.nan
    fronts = (profiles.s_m[int(np.argmax(of))] for of in (loose, moving))
    return float(abs(next(fronts) - next(fronts)) / profiles.s_m[-1])


def in_time(results: Results) -> Statement:
    lines = [find(results.lines, case) for case in SLOW]
    known = [line for line in lines if line is not None and math.isfinite(line.value("arrival_theory_s"))]
    shares = [(line.name, line.value("breaking_time_s") / line.value("arrival_theory_s")) for line in known]
    return Statement(
        "In slow breaks the wave has time to reach the fixed end before the tension at the broken end is zero.",
        f"Fracture time of {number(1e3 * known[0].value('breaking_time_s'))} ms over that of the first arrival: "
        f"{own.told(shares, 2)}."
        if known
        else "No run shows it.",
        own.each(shares, lambda share: share >= 1.0),
        "the arrival comes first",
    )
