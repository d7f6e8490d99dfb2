"""Measures of the breaking line's statements: from the rows of `lines.read_lines` to numbers that a rule can judge.

A measure takes results with `lines`. Those of a claim that gives `by_case`, `case_to_case`, `by_pair` or `all_cases` a
formula take that too; "pairs" are the fast and the slow break of one tension, "case to case" is in rising tension.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from functools import cache, partial
from itertools import pairwise
from operator import itemgetter
from pathlib import Path
from statistics import fmean
from typing import NamedTuple

from campaigns.breaking_line.lines import CASES, FAST, SLOW, Line, ended, named, pairs
from campaigns.statements import Check, Claim, Measured, formula, read_claims, shown, told
from tables import number_of


class Results(NamedTuple):
    """What these statements are judged by; those of the whole paper have more."""

    lines: Sequence[Line]


GROUPS = {"all": CASES, "fast": FAST, "slow": SLOW}
PRINTED_CROSSING_S = (0.55, 0.91)
DELAYED = 0.5  # of the difference of the fracture times: by so much a slow break delays the way of the end


def values(lines: Sequence[Line], cases: Iterable[str], of: str) -> list[Check]:
    """(name, number) of the cases that have one, in their order; of: a formula over the columns."""
    number, lines_of_cases, checks = formula(of), ended(lines), []
    for case in cases:
        value = number(lines_of_cases.get(case, {}))
        if math.isfinite(value):
            checks.append((named(case), value))
    return checks


def by_case(
    results: Results, of: str, form: str, cases: str = "all", only: tuple[str, ...] = (), judge: str = ""
) -> Measured:
    """A check for every case, or those in `only`; judge: what the rule judges, where it is not the number told."""
    deciding = values(results.lines, only or GROUPS[cases], judge or of)
    checks = [(f"case {name}", value) for name, value in deciding]
    return Measured(checks, told(values(results.lines, GROUPS[cases], of), form))


def case_to_case(results: Results, of: str, form: str, cases: str = "all") -> Measured:
    """A check for every step from one case to the next: by how much the number rises."""
    groups = (FAST, SLOW) if cases == "all" else (GROUPS[cases],)
    checks, every_number = [], []
    for group in groups:
        numbers = values(results.lines, group, of)
        every_number += numbers
        for (first, earlier), (second, later) in pairwise(numbers):
            checks.append((f"{first} to {second}", later - earlier))
    return Measured(checks, told(every_number, form))


def by_pair(results: Results, of: str, form: str, compare: Callable) -> Measured:
    """A check for every tension: compare(number of the fast break, number of the slow one)."""
    checks, words = [], []
    for pair in pairs(results.lines):
        numbers = [formula(of)(line) for line in pair]
        if all(map(math.isfinite, numbers)):
            names = [named(line["case"]) for line in pair]
            checks.append((" and ".join(names), compare(*numbers)))
            words.append(told(zip(names, numbers, strict=True), form))
    return Measured(checks, "; ".join(words))


def all_cases(results: Results, of: str, form: str, judge: Callable) -> Measured:
    """One check of all fast cases together; judge(their numbers, in rising order)."""
    numbers = values(results.lines, FAST, of)
    if len(numbers) < 2:
        return Measured([])
    in_order = sorted(map(itemgetter(1), numbers))
    return Measured([("all cases", judge(in_order))], told(numbers, form))


def crossing(results: Results) -> Measured:
    """The exact times of arrival, as printed and a tenth of them."""
    times = values(results.lines, FAST, "arrival_theory_s")
    if not times:
        return Measured()
    seconds = [time_s for _, time_s in times]
    earliest, latest = PRINTED_CROSSING_S

    def off(scale):
        return max(abs(scale * min(seconds) / earliest - 1.0), abs(scale * max(seconds) / latest - 1.0))

    checks = [("as printed", off(1.0)), ("a tenth of it is meant (0.055 to 0.091 s)", off(10.0))]
    return Measured(checks, told(times, ".4f"))


def vertical(results: Results) -> Measured:
    """By how much the largest rise or fall falls from case to case, without and with the folds."""
    checks, words = [], []
    places = {"the folds at the fixed end are left out": "vertical_beyond_m", "they count": "vertical_m"}
    for place, name in places.items():
        rises = case_to_case(results, name, ".3f")
        if rises.checks:
            checks.append((place, -max(map(itemgetter(1), rises.checks))))
        words.append(rises.told)
    if not any(words):
        return Measured(checks)
    return Measured(checks, f"beyond the quarter there {words[0]}; with the folds {words[1]}")


def same_motion(results: Results) -> Measured:
    """Way of the end of slow and fast breaks, as seen and with the delay of the slow break taken off."""
    seen, shifted, words = [], [], []
    for fast, slow in pairs(results.lines):
        late = DELAYED * (slow["breaking_time_s"] - fast["breaking_time_s"]) * fast["end_speed_mps"]
        fast_way, slow_way = fast["recoil_120ms_m"], slow["recoil_120ms_m"]
        if not (math.isfinite(fast_way) and math.isfinite(slow_way)):
            continue
        difference = abs(slow_way / fast_way - 1.0)
        seen.append(difference)
        shifted.append(min(difference, abs((slow_way + late) / fast_way - 1.0)))
        ways = told([(named(fast["case"]), fast_way), (named(slow["case"]), slow_way)], ".2f")
        words.append(f"{ways} + {shown(late, '.2f')}")
    if not seen:
        return Measured([])
    checks = [("the delay of the break is taken off", max(shifted)), ("as seen", max(seen))]
    return Measured(checks, "; ".join(words))


def dominant(results: Results) -> Measured:
    """Change of the end speed over the fracture times over that over the tensions."""
    speeds = [speed for _, speed in values(results.lines, FAST, "end_speed_mps")]
    differences = [abs(slow["end_speed_mps"] - fast["end_speed_mps"]) for fast, slow in pairs(results.lines)]
    if len(speeds) < 2 or not differences:
        return Measured()
    by_tension, by_time = max(speeds) - min(speeds), max(differences)
    words = f"over the tensions {shown(by_tension, '.1f')}, over the fracture times at most {shown(by_time, '.2f')}"
    return Measured([("all pairs", by_time / by_tension)], words)


def doubled(results: Results) -> Measured:
    """The largest relative change that twice the elements bring, by case."""
    finer, largest = ended(results.lines, "doubled"), []
    for case, line in ended(results.lines).items():
        changes = []
        if case not in finer:
            continue
        for name in ("end_speed_mps", "recoil_m", "kinetic_largest_J"):
            change = abs(finer[case][name] / line[name] - 1.0)
            if math.isfinite(change):
                changes.append(change)
        if changes:
            largest.append((named(case), max(changes)))
    checks = [(f"case {name}", change) for name, change in largest]
    return Measured(checks, told(largest, ".3%"))


def shock_incomplete(results: Results) -> Measured:
    """Whether no shock exists before the fixed end in cases 2 and 3."""
    births, checks = [], []
    for case in ("2", "3"):
        line = ended(results.lines).get(case, {})
        if math.isnan(number_of(line, "front_speed_theory_mps")):
            continue
        name, birth_m = f"case {named(case)}", line["shock_birth_theory_m"]
        births.append((name, birth_m))
        checks.append((name, float(math.isnan(birth_m))))
    return Measured(checks, told(births, ".1f"))


def dissipates(results: Results) -> Measured:
    """Whether more of the line takes up the kinetic energy of a slow break: by its spread, and by the part at rest."""
    spread, resting = LARGER(results, "kinetic_spread", ".2f"), SMALLER(results, "resting_share", ".2f")
    ways = {"judged by the spread of the energy": spread, "judged by the part at rest": resting}
    checks = []
    for name, measured in ways.items():
        if measured.checks:
            checks.append((name, min(map(itemgetter(1), measured.checks))))
    if not checks:
        return Measured(checks)
    return Measured(checks, f"{spread.told}; at rest {resting.told}")


def _spread_of_ratios(ratios: list[float]) -> float:
    """The largest relative distance of the ratios from their mean."""
    mean = fmean(ratios)
    return max(abs(ratio / mean - 1.0) for ratio in ratios)


def _least_gap(speeds: list[float]) -> float:
    """The least relative distance of two neighbours of the speeds."""
    return min(faster / slower - 1.0 for slower, faster in pairwise(speeds))


SMALLER = partial(by_pair, compare=lambda fast, slow: fast - slow)
LARGER = partial(by_pair, compare=lambda fast, slow: slow - fast)
MEASURES = {
    "cases": by_case,
    "case to case": case_to_case,
    "smaller in slow": SMALLER,
    "larger in slow": LARGER,
    "changed in slow": partial(by_pair, compare=lambda fast, slow: slow / fast - 1.0),
    "one ratio": partial(all_cases, judge=_spread_of_ratios),
    "least gap": partial(all_cases, judge=_least_gap),
    "crossing": crossing,
    "vertical": vertical,
    "same motion": same_motion,
    "dominant": dominant,
    "doubled": doubled,
    "shock incomplete": shock_incomplete,
    "dissipates": dissipates,
}


@cache
def claims() -> dict[str, Claim]:
    """The claims of statements.toml by name."""
    return read_claims(Path(__file__).with_name("statements.toml"), MEASURES)
