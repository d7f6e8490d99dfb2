"""What the paper says of the breaking line (section 4.1), one by one, with what the runs say to it.

Every verdict is computed from the table (`reports.parts.statements`): a dash where the runs asked for cannot decide.
Each function below takes the runs and gives one Statement; the report on the whole paper uses them too.
"""

from __future__ import annotations

import math
from itertools import pairwise

from ..parts.content import Column, Table
from ..parts.statements import Statement
from ..parts.wording import decimals, listed, number, percent
from .runs import FAST, SLOW, Line, find, of_kind, pairs

SAME_SPEED, SAME_FRONT, SAME_ENERGY = 0.003, 0.01, 0.01  # shares up to which numbers count as equal
BUCKLED_RAD, OVERSHOT_M = 0.2, 0.1
PAPER_FRONT_MPS, NEAR = 500.0, 0.1
AT_THE_END = 0.01


def statements_table(lines: tuple[Line, ...]) -> Table:
    """Statement, evidence, verdict."""
    titles = (("the paper", 3), ("the runs", 5), ("verdict", 2))
    heads = tuple(Column(title, align="left", share=share) for title, share in titles)
    asked = (
        speed, energy_speed, at_the_end, recoil, vertical, buckling, overshoot, front_speed, faster_fronts, slack_front,
        shock, tension, fast_part, resting_part, kinetic_spread, kinetic,
    )  # fmt: skip
    rows = [(one.claim, one.found, one.said) for one in (state(lines) for state in asked)]
    caption = "The paper's statements on the breaking line, and the verdict of these runs, from `table.csv`."
    return Table(heads, tuple(rows), caption, small=True)


def in_turn(lines, cases, column: str) -> list[tuple[str, float]]:
    """(name, number) of the cases that have one, in their order."""
    found = ((case, find(lines, case)) for case in cases)
    return [(line.name, line.value(column)) for _, line in found if line and math.isfinite(line.value(column))]


def each(numbers: list[tuple[str, float]], holds) -> tuple[tuple[str, bool], ...]:
    """A check for every case."""
    return tuple((f"case {name}", bool(holds(value))) for name, value in numbers)


def rises(numbers: list[tuple[str, float]], sign: float = 1.0) -> tuple[tuple[str, bool], ...]:
    """A check for every step from one case to the next: that the number rises (sign -1: falls)."""
    return tuple(
        (f"{before} to {after}", sign * after_value > sign * before_value)
        for (before, before_value), (after, after_value) in pairwise(numbers)
    )


def of_pairs(found: list[tuple[Line, Line]], column: str, holds) -> tuple[tuple[str, bool], ...]:
    """A check for every tension: holds(number of the fast break, number of the slow one)."""
    return tuple(
        (f"{fast.name} and {slow.name}", bool(holds(fast.value(column), slow.value(column)))) for fast, slow in found
    )


def compared(found: list[tuple[Line, Line]], column: str) -> str:
    """The numbers of both breaks of every tension."""
    said = ", ".join(
        f"{fast.name} {decimals(fast.value(column), 2)} and {slow.name} {decimals(slow.value(column), 2)}"
        for fast, slow in found
    )
    return said or "no pair of runs"


def told(numbers: list[tuple[str, float]], places: int) -> str:
    """The numbers by case."""
    return ", ".join(f"{name}: {decimals(value, places)}" for name, value in numbers) or "no run shows it"


def with_column(lines, column: str) -> list[tuple[Line, Line]]:
    """Fast and slow break of the same tension, where both have that number."""
    return [pair for pair in pairs(lines) if all(math.isfinite(line.value(column)) for line in pair)]


def speed(lines) -> Statement:
    return Statement(
        "The maximum speed does not depend on the fracture time.",
        f"End speeds in m/s: {compared(pairs(lines), 'end_speed_mps')}.",
        of_pairs(pairs(lines), "end_speed_mps", lambda fast, slow: abs(slow / fast - 1.0) < SAME_SPEED),
        f"equal to {percent(SAME_SPEED)}",
    )


def energy_speed(lines) -> Statement:
    fast, slow = (in_turn(lines, cases, "end_speed_mps") for cases in (FAST, SLOW))
    claim = "It is higher when the static tension is higher."
    found = f"End speeds in m/s: {told(fast + slow, 1)}."
    return Statement(claim, found, rises(fast) + rises(slow), "rises from case to case")


def at_the_end(lines) -> Statement:
    found = [line for line in of_kind(lines, "case") if math.isfinite(line.value("speed_largest_mps"))]
    numbers = [(line.name, line.value("speed_largest_mps") / line.value("end_speed_most_mps") - 1.0) for line in found]
    said = ", ".join(f"{name}: {decimals(100 * excess, 2)} %" for name, excess in numbers)
    return Statement(
        "The velocity of the end point is the maximum along the line.",
        f"Largest speed of any node at any time over the largest of the settled end, less one: {said or 'none'}.",
        each(numbers, lambda excess: excess < AT_THE_END),
        f"exceeded by less than {percent(AT_THE_END)}",
    )


def recoil(lines) -> Statement:
    fast, slow = (in_turn(lines, cases, "recoil_120ms_m") for cases in (FAST, SLOW))
    claim = "Lines that break at higher tension snap back farther."
    found = f"Way of the end in the first 120 ms, m: {told(fast + slow, 1)}."
    return Statement(claim, found, rises(fast) + rises(slow), "rises from case to case")


def vertical(lines) -> Statement:
    beyond = [in_turn(lines, cases, "vertical_beyond_m") for cases in (FAST, SLOW)]
    folded = [in_turn(lines, cases, "vertical_m") for cases in (FAST, SLOW)]
    found = (
        f"Largest rise or fall in m, beyond the quarter at the fixed end: {told(beyond[0] + beyond[1], 3)}; with the "
        f"folds there: {told(folded[0] + folded[1], 3)}."
    )
    checks = []
    for where, both in (("the folds at the fixed end are left out", beyond), ("they count", folded)):
        falls = [holds for one in both for _, holds in rises(one, -1.0)]
        checks += [(where, all(falls))] if falls else []
    claim = "The vertical motion decreases as the static tension increases."
    return Statement(claim, found, tuple(checks), "falls from case to case")


def buckling(lines) -> Statement:
    numbers = in_turn(lines, (*FAST, *SLOW), "steepest_tilt_rad")
    return Statement(
        "The line buckles at the fixed end, for all static tensions and both fracture times.",
        f"Steepest element by the end of the figure, rad: {told(numbers, 2)}.",
        each(numbers, lambda value: value > BUCKLED_RAD),
        f"an element steeper than {number(BUCKLED_RAD)} rad",
    )


def overshoot(lines) -> Statement:
    numbers = in_turn(lines, (*FAST, *SLOW), "x_min_m")
    return Statement(
        "In the high-tension case parts of the line overshoot and move to the left of the fixed end.",
        f"Leftmost point, m: {told(numbers, 3)}.",
        each([(name, value) for name, value in numbers if name == "4"], lambda value: value < -OVERSHOT_M),
        f"{number(OVERSHOT_M)} m to the left in case 4",
    )


def front_speed(lines) -> Statement:
    numbers = in_turn(lines, FAST, "front_speed_theory_mps")
    shocked = find(lines, "4")
    found = f"√(T′/m) at the static tension, m/s: {told(numbers, 0)}."
    if shocked is not None and math.isfinite(shocked.value("shock_speed_mps")):
        found += f" In case 4 the shock, at {decimals(shocked.value('shock_speed_mps'), 0)} m/s, overtakes the front."
    return Statement(
        "At high tension the front runs at about 500 m/s.",
        found,
        each([one for one in numbers if one[0] == "4"], lambda value: abs(value / PAPER_FRONT_MPS - 1.0) < NEAR),
        f"within {percent(NEAR)} of {number(PAPER_FRONT_MPS)} m/s in case 4",
    )


def faster_fronts(lines) -> Statement:
    numbers = in_turn(lines, FAST, "front_speed_theory_mps")
    values = dict(numbers)
    among = [(name, values[name]) for name in ("2", "3") if name in values and "4" in values]
    return Statement(
        "In cases 2 and 3 the front is faster than in case 4.",
        f"√(T′/m) at the static tension, m/s: {told(numbers, 0)}.",
        each(among, lambda value: value > values["4"]),
        "faster than in case 4",
    )


def slack_front(lines) -> Statement:
    numbers = in_turn(lines, (*FAST, *SLOW), "slack_front_speed_mps")
    exact = in_turn(lines, (*FAST, *SLOW), "slack_front_speed_theory_mps")
    claim = "The front at the highest velocity runs at the same speed in all cases, the wave speed at zero tension."
    if not exact:
        return Statement(claim, "No run shows it.", ())
    found = f"m/s: {told(numbers, 1)}; exact {decimals(exact[0][1], 1)}."
    checks = each(numbers, lambda value: abs(value / exact[0][1] - 1.0) < SAME_FRONT)
    return Statement(claim, found, checks, f"within {percent(SAME_FRONT)} of √(T′(0)/m)")


def shock(lines) -> Statement:
    claim = "In cases 2 and 3 a shock begins to form."
    judged = [line for line in of_kind(lines, "case") if math.isfinite(line.value("front_speed_theory_mps"))]
    if not judged:
        return Statement(claim, "No run shows it.", ())
    born = [line for line in judged if math.isfinite(line.value("shock_birth_theory_m"))]
    none = [line.name for line in judged if line not in born]
    words = []
    for line in born:
        straight = find(lines, line.case, "straight")
        seen = f", {decimals(straight.value('shock_birth_m'), 1)} m in the straight run" if straight else ""
        words.append(f"case {line.name} {decimals(line.value('shock_birth_theory_m'), 1)} m{seen}")
    born_at = "; ".join(words) or "none"
    found = f"Exact births, distances from the broken end: {born_at}. None in cases {listed(none)}."
    checks = tuple((f"case {case}", find(lines, case) in born) for case in ("2", "3") if find(lines, case) in judged)
    return Statement(claim, found, checks, "the exact characteristics cross before the fixed end")


def tension(lines) -> Statement:
    found = with_column(lines, "tension_spread")
    return Statement(
        "In slow breaks the tension is more uniform along the line.",
        f"Standard deviation of T over its mean when half the strain energy is left: "
        f"{compared(found, 'tension_spread')}.",
        of_pairs(found, "tension_spread", lambda fast, slow: slow < fast),
        "smaller in the slow break",
    )


def fast_part(lines) -> Statement:
    found = with_column(lines, "fast_share")
    return Statement(
        "In slow breaks a smaller part of the line moves at the maximum speed.",
        "When half the strain energy is left, share of the line faster than 0.9 of the settled end speed: "
        f"{compared(found, 'fast_share')}.",
        of_pairs(found, "fast_share", lambda fast, slow: slow < fast),
        "smaller in the slow break",
    )


def resting_part(lines) -> Statement:
    found = with_column(lines, "resting_share")
    return Statement(
        "In fast breaks a part of the line is practically at rest; in slow breaks more of it moves.",
        "When half the strain energy is left, share of the line slower than 0.1 of the settled end speed: "
        f"{compared(found, 'resting_share')}.",
        of_pairs(found, "resting_share", lambda fast, slow: slow < fast),
        "smaller in the slow break",
    )


def kinetic_spread(lines) -> Statement:
    found = with_column(lines, "kinetic_spread")
    return Statement(
        "In slow breaks the kinetic energy is more uniformly distributed.",
        "When half the strain energy is left, share of the line that would hold the kinetic energy at one speed: "
        f"{compared(found, 'kinetic_spread')}.",
        of_pairs(found, "kinetic_spread", lambda fast, slow: slow > fast),
        "larger in the slow break",
    )


def kinetic(lines) -> Statement:
    found = with_column(lines, "kinetic_largest_J")
    said = ", ".join(
        f"{run.name} {percent(run.share('kinetic_largest_J'))} ({percent(-run.share('end_work_J'))} taken out)"
        for pair in found
        for run in pair
    )
    return Statement(
        "The total kinetic energy depends only on the static tension, not on the fracture time.",
        "Largest kinetic energy over the stored energy, and the work that the decaying force takes out: "
        f"{said or 'no pair of runs'}.",
        of_pairs(found, "kinetic_largest_J", lambda fast, slow: abs(slow / fast - 1.0) < SAME_ENERGY),
        f"equal to {percent(SAME_ENERGY)}",
    )
