"""Measures of the breaking line's statements: from the rows of `lines.read_lines` to numbers that a rule can judge.

A measure takes results with `lines`. `by_case`, `case_to_case`, `by_pair` and `all_cases` make measures; "pairs" are
the fast and the slow break of one tension, "case to case" is in rising tension.
"""

import math
from collections.abc import Callable, Iterable
from itertools import pairwise

from campaigns.breaking_line.lines import CASES, FAST, SLOW, Line, find, named, of_kind, pairs
from campaigns.statements import Check, Measured, shown, told

Measure = Callable[[object], Measured]
Number = Callable[[Line], float]
PRINTED_CROSSING_S = (0.55, 0.91)
DELAYED = 0.5  # of the difference of the fracture times: by so much a slow break delays the way of the end


def column(name: str, scale: float = 1.0) -> Number:
    """A column of the table."""
    return lambda line: scale * line[name]


def ratio(name: str, other: str) -> Number:
    """One column over another."""
    return lambda line: line[name] / line[other]


def values(lines: Iterable[Line], cases: Iterable[str], number: Number) -> list[Check]:
    """(name, number) of the cases that have one, in their order."""
    found = (find(lines, case) for case in cases)
    numbers = [(named(line["case"]), float(number(line))) for line in found if line is not None]
    return [(name, value) for name, value in numbers if math.isfinite(value)]


def by_case(number: Number, form: str, cases=CASES, only=None, judge: Number | None = None):
    """A check for every case, or those in `only`; judge: what the rule judges, where it is not the number told."""

    def measure(results) -> Measured:
        judged = values(results.lines, only or cases, judge or number)
        return Measured(
            [(f"case {name}", value) for name, value in judged], told(values(results.lines, cases, number), form)
        )

    return measure


def case_to_case(number: Number, form: str, *groups):
    """A check for every step from one case to the next: by how much the number rises."""

    def measure(results) -> Measured:
        found = [values(results.lines, cases, number) for cases in groups]
        checks = [(f"{a} to {b}", after - before) for one in found for (a, before), (b, after) in pairwise(one)]
        return Measured(checks, told([one for group in found for one in group], form))

    return measure


def by_pair(number: Number, form: str, compare: Callable[[float, float], float]):
    """A check for every tension: compare(number of the fast break, number of the slow one)."""

    def measure(results) -> Measured:
        checks, words = [], []
        for both in pairs(results.lines):
            numbers = [float(number(line)) for line in both]
            if all(map(math.isfinite, numbers)):
                names = [named(line["case"]) for line in both]
                checks.append((" and ".join(names), compare(*numbers)))
                words.append(told(zip(names, numbers, strict=True), form))
        return Measured(checks, "; ".join(words))

    return measure


def all_cases(number: Number, form: str, judge: Callable[[list[float]], float]):
    """One check of all fast cases together."""

    def measure(results) -> Measured:
        found = values(results.lines, FAST, number)
        checks = [("all cases", judge([value for _, value in found]))] if len(found) > 1 else []
        return Measured(checks, told(found, form) if checks else "")

    return measure


def smaller(fast: float, slow: float) -> float:
    """By how much the number of the slow break is the smaller one."""
    return fast - slow


def later(fast: float, slow: float) -> float:
    """By how much the number of the slow break is the larger one."""
    return slow - fast


def changed(fast: float, slow: float) -> float:
    """Relative change from the fast to the slow break."""
    return slow / fast - 1.0


def off_one_ratio(ratios: list[float]) -> float:
    middle = sum(ratios) / len(ratios)
    return max(abs(one / middle - 1.0) for one in ratios)


def least_gap(speeds: list[float]) -> float:
    return min(b / a - 1.0 for a, b in pairwise(sorted(speeds)))


def crossing(results) -> Measured:
    times = values(results.lines, FAST, column("arrival_theory_s"))
    if not times:
        return Measured()
    seen = min(seconds for _, seconds in times), max(seconds for _, seconds in times)

    def off(scale: float) -> float:
        return max(abs(scale * a / b - 1.0) for a, b in zip(seen, PRINTED_CROSSING_S, strict=True))

    checks = [("as printed", off(1.0)), ("a tenth of it is meant (0.055 to 0.091 s)", off(10.0))]
    return Measured(checks, told(times, ".4f"))


def vertical(results) -> Measured:
    checks, words = [], []
    for where, name in (
        ("the folds at the fixed end are left out", "vertical_beyond_m"),
        ("they count", "vertical_m"),
    ):
        found = [values(results.lines, cases, column(name)) for cases in (FAST, SLOW)]
        falls = [before - after for one in found for (_, before), (_, after) in pairwise(one)]
        checks += [(where, min(falls))] if falls else []
        words.append(told(found[0] + found[1], ".3f"))
    return Measured(checks, f"beyond the quarter there {words[0]}; with the folds {words[1]}" if any(words) else "")


def same_motion(results) -> Measured:
    seen, shifted, words = [], [], []
    for fast, slow in pairs(results.lines):
        late = DELAYED * (slow["breaking_time_s"] - fast["breaking_time_s"]) * fast["end_speed_mps"]
        way = [line["recoil_120ms_m"] for line in (fast, slow)]
        if all(map(math.isfinite, way)):
            seen.append(abs(way[1] / way[0] - 1.0))
            shifted.append(min(seen[-1], abs((way[1] + late) / way[0] - 1.0)))
            both = (shown(one, ".2f") for one in (*way, late))
            words.append("{}: {}, {}: {} + {}".format(named(fast["case"]), next(both), named(slow["case"]), *both))
    checks = [("the delay of the break is taken off", max(shifted)), ("as seen", max(seen))] if seen else []
    return Measured(checks, "; ".join(words))


def dominant(results) -> Measured:
    speeds = [speed for _, speed in values(results.lines, FAST, column("end_speed_mps"))]
    both = [abs(slow["end_speed_mps"] - fast["end_speed_mps"]) for fast, slow in pairs(results.lines)]
    if len(speeds) < 2 or not both:
        return Measured()
    by_tension, by_time = max(speeds) - min(speeds), max(both)
    words = f"over the tensions {shown(by_tension, '.1f')}, over the fracture times at most {shown(by_time, '.2f')}"
    return Measured([("all pairs", by_time / by_tension)], words)


def doubled(results) -> Measured:
    """The largest relative change that twice the elements bring, by case."""
    found = []
    for line in of_kind(results.lines, "case"):
        fine = find(results.lines, line["case"], "doubled")
        off = [
            abs(fine[name] / line[name] - 1.0) for name in ("end_speed_mps", "recoil_m", "kinetic_largest_J") if fine
        ]
        off = [one for one in off if math.isfinite(one)]
        found += [(named(line["case"]), max(off))] if off else []
    return Measured([(f"case {name}", off) for name, off in found], told(found, ".3%"))


def shock_incomplete(results) -> Measured:
    known = [find(results.lines, case) for case in ("2", "3")]
    known = [line for line in known if line is not None and math.isfinite(line["front_speed_theory_mps"])]
    births = [(f"case {named(line['case'])}", line["shock_birth_theory_m"]) for line in known]
    return Measured([(name, float(math.isnan(birth))) for name, birth in births], told(births, ".1f"))
