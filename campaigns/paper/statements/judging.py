"""Measures of the statements on the buoy: from `Results` to numbers that a rule can judge.

`numbers` is of single numbers (`Results.numbers`), `depths` of the rows of the dependence study.
"""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence

from campaigns.paper.measured import Results
from campaigns.statements import Check, Measured, formula, grouped, shown
from tables import LARGE, OPEN, TANGENT_ERROR, TANGENT_EXPONENT, Row, number_of

Place = tuple[str, Row]  # where a run was, in words, and its row
UNDECIDED = ("", *OPEN)  # regimes that decide nothing
NOT_IN_DOUBT = 2.0  # standard errors
LONG = "the long run"


def numbers(
    results: Results,
    of: dict[str, str],
    form: str,
    judge: str = "",
    printed: Mapping[str, float | str] | None = None,
) -> Measured:
    """A check for every place, of a formula over the results' numbers.

    judge: the formula that the rule judges; printed: what the paper prints (told in brackets), the rule then judges the
    relative distance from it.
    """
    checks, words = [], []
    for place, text in of.items():
        value, expected = formula(text)(results.numbers), 1.0
        if printed:
            expected = formula(str(printed[place]))(results.numbers)
        if not (math.isfinite(value) and math.isfinite(expected)):
            continue
        judged, sentence = value, f"{place}: {shown(value, form)}"
        if judge:
            judged = formula(judge)(results.numbers)
        elif printed:
            judged = value / expected - 1.0
        if printed:
            sentence += f" ({expected:g})"
        checks.append((place, judged))
        words.append(sentence)
    return Measured(checks, ", ".join(words))


def depths(results: Results, of: str, form: str, also: Sequence[str] = (), judge: str = "") -> Measured:
    """A check for every depth, at the large wave, of a formula over the row and the results' numbers.

    also: formulas that are told besides; judge: the formula that the rule judges.
    """
    checks, words = [], []
    for row in results.over_depth(LARGE):
        numbers_of_row = results.numbers | row
        value = formula(of)(numbers_of_row)
        if not math.isfinite(value):
            continue
        values_in_words = [shown(value, form)]
        for text in also:
            values_in_words.append(shown(formula(text)(numbers_of_row), form))
        words.append(f"{' and '.join(values_in_words)} at {at(row)}")
        judged = formula(judge or of)(numbers_of_row)
        checks.append((at(row), judged))
    return Measured(checks, ", ".join(words))


def each(checks: Iterable[Check], form: str) -> Measured:
    """A check of every number that there is, with its place."""
    known, words = [], []
    for place, value in checks:
        if math.isfinite(value):
            known.append((place, value))
            words.append(f"{shown(value, form)} at {place}")
    return Measured(known, ", ".join(words))


def passed(*checks: tuple[str, bool]) -> list[Check]:
    """Checks that the measure has decided itself, for the rule `met`."""
    return [(place, float(holds)) for place, holds in checks]


def exponent(row: Row | None) -> str:
    """The exponent of the tangent dynamics with its error, in words."""
    value = number_of(row or {}, TANGENT_EXPONENT)
    if math.isnan(value):
        return "none"
    return f"{shown(value, '.3f')} ± {shown(number_of(row, TANGENT_ERROR), '.3f')}"


def positive(row: Row) -> bool:
    """Whether that exponent is above zero beyond doubt."""
    return number_of(row, TANGENT_EXPONENT) - NOT_IN_DOUBT * number_of(row, TANGENT_ERROR) > 0.0


def settled(row: Row) -> bool:
    """Whether the run says if its exponent is positive: by the exponent itself, or by a regime that excludes it."""
    below = number_of(row, TANGENT_EXPONENT) + NOT_IN_DOUBT * number_of(row, TANGENT_ERROR) < 0.0
    return positive(row) or below or row["regime"] not in UNDECIDED


def at(row: Row) -> str:
    """The depth of a row, in words."""
    return f"H = {row['depth_m']:g} m"


def everywhere(results: Results, steepness: float) -> list[Place]:
    """The short runs of a wave by depth: as shipped, then with a buoy that loses buoyancy out of the water."""
    places = [(at(row), row) for row in results.over_depth(steepness)]
    submergences = dict.fromkeys(row["submergence"] for row in results.dependence)
    for under in list(submergences)[1:]:
        for row in results.over_depth(steepness, submergence=under):
            places.append((f"{at(row)} with {under}", row))
    return places


def regimes(rows: Iterable[Place], is_so: Callable) -> list[Check]:
    """A check of every row that has a verdict: whether its regime is so."""
    checks = []
    for place, row in rows:
        if row["regime"] not in UNDECIDED:
            checks.append((place, is_so(row["regime"])))
    return passed(*checks)


def by_regime(rows: Iterable[Place]) -> str:
    """Regimes of the runs, each with the places that have it."""
    places = {}  # by regime
    for place, row in rows:
        places.setdefault(row["regime"] or "no verdict", []).append(place)
    return "; ".join(f"{regime} at {grouped(places_of)}" for regime, places_of in places.items()) or "none"
