"""Measures of the breaking line's statements: from the rows of `lines.read_lines` to numbers that a rule can judge.

A measure takes results with `lines`. `by_case`, `case_to_case`, `by_pair` and `all_cases` make measures; "pairs" are
the fast and the slow break of one tension, "case to case" is in rising tension.
"""

import math
from collections.abc import Callable, Iterable
from functools import cache, partial
from itertools import pairwise
from pathlib import Path
from statistics import fmean
from typing import TYPE_CHECKING

from campaigns.breaking_line.lines import CASES, FAST, SLOW, Line, find, named, of_kind, pairs
from campaigns.statements import Check, Claim, Measured, formula, read_claims, shown, told

if TYPE_CHECKING:
    from campaigns.paper.measured import Results

Measure = Callable[["Results"], Measured]
GROUPS = {"all": CASES, "fast": FAST, "slow": SLOW}
PRINTED_CROSSING_S = (0.55, 0.91)
DELAYED = 0.5  # of the difference of the fracture times: by so much a slow break delays the way of the end


def values(lines: Iterable[Line], cases: Iterable[str], of: str) -> list[Check]:
    """(name, number) of the cases that have one, in their order; of: a formula over the columns."""
    number = formula(of)
    lines_of_cases = (find(lines, case) for case in cases)
    numbers = [(named(line["case"]), number(line)) for line in lines_of_cases if line is not None]
    return [(name, value) for name, value in numbers if math.isfinite(value)]


def by_case(of: str, form: str, cases: str = "all", only: tuple[str, ...] = (), judge: str = "") -> Measure:
    """A check for every case, or those in `only`; judge: what the rule judges, where it is not the number told."""

    def measure(results: "Results") -> Measured:
        deciding = values(results.lines, only or GROUPS[cases], judge or of)
        checks = [(f"case {name}", value) for name, value in deciding]
        return Measured(checks, told(values(results.lines, GROUPS[cases], of), form))

    return measure


def case_to_case(of: str, form: str, cases: str = "all") -> Measure:
    """A check for every step from one case to the next: by how much the number rises."""

    def measure(results: "Results") -> Measured:
        groups = (FAST, SLOW) if cases == "all" else (GROUPS[cases],)
        series = [values(results.lines, group, of) for group in groups]
        checks = [
            (f"{a} to {b}", later - earlier) for numbers in series for (a, earlier), (b, later) in pairwise(numbers)
        ]
        return Measured(checks, told([numbers for group in series for numbers in group], form))

    return measure


def by_pair(compare: Callable[[float, float], float], of: str, form: str) -> Measure:
    """A check for every tension: compare(number of the fast break, number of the slow one)."""

    def measure(results: "Results") -> Measured:
        checks, words = [], []
        for pair in pairs(results.lines):
            numbers = [formula(of)(line) for line in pair]
            if all(map(math.isfinite, numbers)):
                names = [named(line["case"]) for line in pair]
                checks.append((" and ".join(names), compare(*numbers)))
                words.append(told(zip(names, numbers, strict=True), form))
        return Measured(checks, "; ".join(words))

    return measure


def all_cases(judge: Callable[[list[float]], float], of: str, form: str) -> Measure:
    """One check of all fast cases together; judge(their numbers, in rising order)."""

    def measure(results: "Results") -> Measured:
        numbers = values(results.lines, FAST, of)
        checks = [("all cases", judge(sorted(value for _, value in numbers)))] if len(numbers) > 1 else []
        return Measured(checks, told(numbers, form) if checks else "")

    return measure


def crossing(results: "Results") -> Measured:
    """The exact times of arrival, as printed and a tenth of them."""
    times = values(results.lines, FAST, "arrival_theory_s")
    if not times:
        return Measured()
    seen = min(seconds for _, seconds in times), max(seconds for _, seconds in times)

    def off(scale: float) -> float:
        return max(abs(scale * a / b - 1.0) for a, b in zip(seen, PRINTED_CROSSING_S, strict=True))

    checks = [("as printed", off(1.0)), ("a tenth of it is meant (0.055 to 0.091 s)", off(10.0))]
    return Measured(checks, told(times, ".4f"))


def vertical(results: "Results") -> Measured:
    """By how much the largest rise or fall falls from case to case, without and with the folds."""
    checks, words = [], []
    places = {"the folds at the fixed end are left out": "vertical_beyond_m", "they count": "vertical_m"}
    for place, name in places.items():
        series = [values(results.lines, cases, name) for cases in (FAST, SLOW)]
        falls = [earlier - later for numbers in series for (_, earlier), (_, later) in pairwise(numbers)]
        checks += [(place, min(falls))] if falls else []
        words.append(told(series[0] + series[1], ".3f"))
    return Measured(checks, f"beyond the quarter there {words[0]}; with the folds {words[1]}" if any(words) else "")


def same_motion(results: "Results") -> Measured:
    """Way of the end of slow and fast breaks, as seen and with the delay of the slow break taken off."""
    seen, shifted, words = [], [], []
    for fast, slow in pairs(results.lines):
        late = DELAYED * (slow["breaking_time_s"] - fast["breaking_time_s"]) * fast["end_speed_mps"]
        way = [line["recoil_120ms_m"] for line in (fast, slow)]
        if all(map(math.isfinite, way)):
            seen.append(abs(way[1] / way[0] - 1.0))
            shifted.append(min(seen[-1], abs((way[1] + late) / way[0] - 1.0)))
            ways = told(zip((named(line["case"]) for line in (fast, slow)), way, strict=True), ".2f")
            words.append(f"{ways} + {shown(late, '.2f')}")
    checks = [("the delay of the break is taken off", max(shifted)), ("as seen", max(seen))] if seen else []
    return Measured(checks, "; ".join(words))


def dominant(results: "Results") -> Measured:
    """Change of the end speed over the fracture times over that over the tensions."""
    speeds = [speed for _, speed in values(results.lines, FAST, "end_speed_mps")]
    differences = [abs(slow["end_speed_mps"] - fast["end_speed_mps"]) for fast, slow in pairs(results.lines)]
    if len(speeds) < 2 or not differences:
        return Measured()
    by_tension, by_time = max(speeds) - min(speeds), max(differences)
    words = f"over the tensions {shown(by_tension, '.1f')}, over the fracture times at most {shown(by_time, '.2f')}"
    return Measured([("all pairs", by_time / by_tension)], words)


def doubled(results: "Results") -> Measured:
    """The largest relative change that twice the elements bring, by case."""
    verdicts = []
    for line in of_kind(results.lines, "case"):
        fine = find(results.lines, line["case"], "doubled")
        measured = ("end_speed_mps", "recoil_m", "kinetic_largest_J") if fine else ()
        off = [abs(fine[name] / line[name] - 1.0) for name in measured]
        off = [error for error in off if math.isfinite(error)]
        verdicts += [(named(line["case"]), max(off))] if off else []
    return Measured([(f"case {name}", off) for name, off in verdicts], told(verdicts, ".3%"))


def shock_incomplete(results: "Results") -> Measured:
    """Whether no shock exists before the fixed end in cases 2 and 3."""
    known = [find(results.lines, case) for case in ("2", "3")]
    known = [line for line in known if line is not None and math.isfinite(line["front_speed_theory_mps"])]
    births = [(f"case {named(line['case'])}", line["shock_birth_theory_m"]) for line in known]
    return Measured([(name, float(math.isnan(birth))) for name, birth in births], told(births, ".1f"))


def dissipates(results: "Results") -> Measured:
    """Whether more of the line takes up the kinetic energy of a slow break: by its spread, and by the part at rest."""
    spread, resting = SPREAD(results), RESTING(results)
    ways = {"judged by the spread of the energy": spread, "judged by the part at rest": resting}
    checks = [(name, min(value for _, value in verdict.checks)) for name, verdict in ways.items() if verdict.checks]
    return Measured(checks, f"{spread.told}; at rest {resting.told}" if checks else "")


SMALLER = partial(by_pair, lambda fast, slow: fast - slow)
LARGER = partial(by_pair, lambda fast, slow: slow - fast)
CHANGED = partial(by_pair, lambda fast, slow: slow / fast - 1.0)
SPREAD, RESTING = LARGER("kinetic_spread", ".2f"), SMALLER("resting_share", ".2f")
MEASURES = {
    "cases": by_case,
    "case to case": case_to_case,
    "smaller in slow": SMALLER,
    "larger in slow": LARGER,
    "changed in slow": CHANGED,
    # largest relative distance of the ratios from their mean; least relative distance of two of the speeds
    "one ratio": partial(all_cases, lambda ratios: max(abs(one / fmean(ratios) - 1.0) for one in ratios)),
    "least gap": partial(all_cases, lambda speeds: min(b / a - 1.0 for a, b in pairwise(speeds))),
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
