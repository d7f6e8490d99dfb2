"""What the paper says of the breaking line (section 4.1), one by one, with what the runs say to it.

Every verdict is computed from the table: "yes", "no", "in part", or a dash where the runs asked for cannot decide.
"""

from __future__ import annotations

import math
from itertools import pairwise

from ..parts.content import Column, Table
from ..parts.wording import EMPTY, decimals, listed, number, percent
from .runs import FAST, SLOW, Line, find, of_kind, pairs

YES, NO, PART = "yes", "no", "in part"
SAME_SPEED, SAME_FRONT, SAME_ENERGY = 0.003, 0.01, 0.01  # shares up to which numbers count as equal
BUCKLED_RAD, OVERSHOT_M = 0.2, 0.1


def statements_table(lines: tuple[Line, ...]) -> Table:
    """Statement, evidence, verdict."""
    heads = (Column("the paper", align="left"), Column("the runs", align="left"), Column("holds", align="left"))
    rows = [_speed(lines), _energy_speed(lines), _at_the_end(lines), _recoil(lines), _vertical(lines), _buckling(lines)]
    rows += [_overshoot(lines), _fronts(lines), _slack_front(lines), _shock(lines), _tension(lines)]
    rows += [_kinetic_spread(lines), _kinetic(lines)]
    caption = "The paper's statements on the breaking line, and the verdict of these runs, from `table.csv`."
    return Table(heads, tuple(rows), caption, small=True)


def _in_turn(lines, cases, column: str) -> list[tuple[str, float]]:
    found = ((case, find(lines, case)) for case in cases)
    return [(line.name, line.value(column)) for _, line in found if line and math.isfinite(line.value(column))]


def _verdict(checks: list[bool]) -> str:
    return EMPTY if not checks else YES if all(checks) else PART if any(checks) else NO


def _compared(found: list[tuple[Line, Line]], column: str) -> str:
    said = ", ".join(
        f"{fast.name} {decimals(fast.value(column), 2)} and {slow.name} {decimals(slow.value(column), 2)}"
        for fast, slow in found
    )
    return said or "no pair of runs"


def _said(numbers: list[tuple[str, float]], places: int) -> str:
    return ", ".join(f"{name}: {decimals(value, places)}" for name, value in numbers) or "no run shows it"


def _speed(lines) -> tuple[str, str, str]:
    found = pairs(lines)
    claim = "The maximum speed does not depend on the fracture time."
    off = [slow.value("end_speed_mps") / fast.value("end_speed_mps") - 1.0 for fast, slow in found]
    evidence = f"End speeds in m/s: {_compared(found, 'end_speed_mps')}."
    return claim, evidence, _verdict([abs(share) < SAME_SPEED for share in off])


def _rises(numbers: list[tuple[str, float]], sign: float = 1.0) -> list[bool]:
    values = [sign * value for _, value in numbers]
    return [after > before for before, after in pairwise(values)]


def _energy_speed(lines) -> tuple[str, str, str]:
    numbers = [_in_turn(lines, cases, "end_speed_mps") for cases in (FAST, SLOW)]
    claim = "It is higher when the static tension is higher."
    evidence = f"End speeds in m/s: {_said(numbers[0] + numbers[1], 1)}."
    return claim, evidence, _verdict(_rises(numbers[0]) + _rises(numbers[1]))


def _at_the_end(lines) -> tuple[str, str, str]:
    found = [line for line in of_kind(lines, "case") if math.isfinite(line.value("speed_largest_mps"))]
    numbers = [(line.name, line.value("speed_largest_mps") / line.value("end_speed_most_mps") - 1.0) for line in found]
    said = ", ".join(f"{name}: {decimals(100 * excess, 2)} %" for name, excess in numbers)
    claim = "The velocity of the end point is the maximum along the line."
    evidence = f"Largest speed of any node at any time over the largest of the settled end, less one: {said or 'none'}."
    return claim, evidence, _verdict([excess < 0.01 for _, excess in numbers])


def _recoil(lines) -> tuple[str, str, str]:
    numbers = [_in_turn(lines, cases, "recoil_120ms_m") for cases in (FAST, SLOW)]
    claim = "Lines that break at higher tension snap back farther."
    evidence = f"Way of the end in the first 120 ms, m: {_said(numbers[0] + numbers[1], 1)}."
    return claim, evidence, _verdict(_rises(numbers[0]) + _rises(numbers[1]))


def _vertical(lines) -> tuple[str, str, str]:
    numbers = [_in_turn(lines, cases, "vertical_beyond_m") for cases in (FAST, SLOW)]
    folded = [_in_turn(lines, cases, "vertical_m") for cases in (FAST, SLOW)]
    claim = "The vertical motion decreases as the static tension increases."
    evidence = (
        f"Largest rise or fall in m, beyond the quarter at the fixed end: {_said(numbers[0] + numbers[1], 3)}; with "
        f"the folds there: {_said(folded[0] + folded[1], 3)}."
    )
    checks = [_rises(one, -1.0) for one in (*numbers, *folded)]
    return claim, evidence, _verdict([check for one in checks for check in one])


def _buckling(lines) -> tuple[str, str, str]:
    numbers = _in_turn(lines, (*FAST, *SLOW), "steepest_tilt_rad")
    claim = "The line buckles at the fixed end, for all static tensions and both fracture times."
    evidence = f"Steepest element by the end of the figure, rad: {_said(numbers, 2)}."
    return claim, evidence, _verdict([value > BUCKLED_RAD for _, value in numbers])


def _overshoot(lines) -> tuple[str, str, str]:
    numbers = _in_turn(lines, (*FAST, *SLOW), "x_min_m")
    claim = "In the high-tension case parts of the line overshoot and move to the left of the fixed end."
    fastest = [value < -OVERSHOT_M for name, value in numbers if name == "4"]
    return claim, f"Leftmost point, m: {_said(numbers, 3)}.", _verdict(fastest)


def _fronts(lines) -> tuple[str, str, str]:
    numbers = _in_turn(lines, FAST, "front_speed_theory_mps")
    arrivals = _in_turn(lines, FAST, "arrival_theory_s")
    shock = find(lines, "4")
    claim = "At high tension the front runs at about 500 m/s; in cases 2 and 3 it is faster than in case 4."
    evidence = (
        f"√(T′/m) at the static tension, m/s: {_said(numbers, 0)}; it crosses the line in "
        f"{', '.join(f'{number(1e3 * seconds, 3)} ms' for _, seconds in arrivals)}."
    )
    if shock is not None and math.isfinite(shock.value("shock_speed_mps")):
        evidence += f" In case 4 the shock, at {decimals(shock.value('shock_speed_mps'), 0)} m/s, overtakes the front."
    values = dict(numbers)
    checks = [abs(values["4"] / 500.0 - 1.0) < 0.1] if "4" in values else []
    checks += [values[name] > values["4"] for name in ("2", "3") if name in values and "4" in values]
    return claim, evidence, _verdict(checks)


def _slack_front(lines) -> tuple[str, str, str]:
    numbers = _in_turn(lines, (*FAST, *SLOW), "slack_front_speed_mps")
    exact = _in_turn(lines, (*FAST, *SLOW), "slack_front_speed_theory_mps")
    claim = "The front at the highest velocity runs at the same speed in all cases, the wave speed at zero tension."
    if not exact:
        return claim, "No run shows it.", EMPTY
    evidence = f"m/s: {_said(numbers, 1)}; exact {decimals(exact[0][1], 1)}."
    return claim, evidence, _verdict([abs(value / exact[0][1] - 1.0) < SAME_FRONT for _, value in numbers])


def _shock(lines) -> tuple[str, str, str]:
    claim = "In cases 2 and 3 a shock begins to form, which does not form completely before the fixed end."
    judged = [line for line in of_kind(lines, "case") if math.isfinite(line.value("front_speed_theory_mps"))]
    if not judged:
        return claim, "No run shows it.", EMPTY
    born = [line for line in judged if math.isfinite(line.value("shock_birth_theory_m"))]
    none = [line.name for line in judged if line not in born]
    words = []
    for line in born:
        straight = find(lines, line.case, "straight")
        seen = f", {decimals(straight.value('shock_birth_m'), 1)} m in the straight run" if straight else ""
        words.append(f"case {line.name} {decimals(line.value('shock_birth_theory_m'), 1)} m{seen}")
    born_at = "; ".join(words) or "none"
    evidence = f"Exact births, distances from the broken end: {born_at}. None in cases {listed(none)}."
    checks = [find(lines, case) in born for case in ("2", "3") if find(lines, case) in judged]
    return claim, evidence, _verdict(checks)


def _tension(lines) -> tuple[str, str, str]:
    found = [(fast, slow) for fast, slow in pairs(lines) if math.isfinite(slow.value("tension_spread"))]
    claim = "In slow breaks the tension is more uniform along the line."
    said = _compared(found, "tension_spread")
    evidence = f"Standard deviation of T over its mean when half the strain energy is left: {said}."
    return (
        claim,
        evidence,
        _verdict([slow.value("tension_spread") < fast.value("tension_spread") for fast, slow in found]),
    )


def _kinetic_spread(lines) -> tuple[str, str, str]:
    claim = (
        "In slow breaks a smaller part moves at the maximum speed and less of the line rests: the kinetic energy is "
        "more uniformly distributed."
    )
    found = [(fast, slow) for fast, slow in pairs(lines) if math.isfinite(slow.value("kinetic_spread"))]
    evidence = (
        "When half the strain energy is left, share of the line faster than 0.9 of the settled end speed: "
        f"{_compared(found, 'fast_share')}; slower than 0.1: {_compared(found, 'resting_share')}; share that would "
        f"hold the kinetic energy at one speed: {_compared(found, 'kinetic_spread')}."
    )
    falls = ("fast_share", "resting_share")
    checks = [slow.value(column) < fast.value(column) for fast, slow in found for column in falls]
    checks += [slow.value("kinetic_spread") > fast.value("kinetic_spread") for fast, slow in found]
    return claim, evidence, _verdict(checks)


def _kinetic(lines) -> tuple[str, str, str]:
    compared = [(fast, slow) for fast, slow in pairs(lines) if math.isfinite(slow.value("kinetic_largest_J"))]
    said = ", ".join(
        f"{run.name} {percent(run.share('kinetic_largest_J'))} ({percent(-run.share('end_work_J'))} taken out)"
        for pair in compared
        for run in pair
    )
    claim = "The total kinetic energy depends only on the static tension, not on the fracture time."
    evidence = (
        "Largest kinetic energy over the stored energy, and the work that the decaying force takes out: "
        f"{said or 'no pair of runs'}."
    )
    ratios = [slow.value("kinetic_largest_J") / fast.value("kinetic_largest_J") for fast, slow in compared]
    return claim, evidence, _verdict([abs(ratio - 1.0) < SAME_ENERGY for ratio in ratios])
