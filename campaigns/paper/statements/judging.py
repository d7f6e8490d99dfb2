"""Measures of the statements on the buoy: from `Results` to numbers that a rule can judge.

`numbers` and `near` are of single numbers (`Results.numbers`), `depths` of the rows of the dependence study.
"""

import math
from collections.abc import Callable, Iterable, Sequence

from campaigns.paper.measured import Results
from campaigns.paper.measures import LARGE
from campaigns.statements import Check, Measured, formula, grouped, shown, told
from campaigns.tables import Row

Measure = Callable[[Results], Measured]
UNDECIDED = ("", "undecided", "transient")  # regimes that decide nothing
NOT_IN_DOUBT = 2.0  # standard errors
EXPONENT, ERROR = "lyapunov_tangent_bits_per_period", "lyapunov_tangent_error"
LONG = "the long run"


def numbers(of: dict[str, str], form: str, judge: str = "") -> Measure:
    """A check for every place, of a formula over the results' numbers; judge: the formula that the rule judges."""

    def measure(results: Results) -> Measured:
        known = {where: formula(text)(results.numbers) for where, text in of.items()}
        known = {where: value for where, value in known.items() if math.isfinite(value)}
        checks = [(where, formula(judge)(results.numbers) if judge else value) for where, value in known.items()]
        return Measured(checks, told(known.items(), form))

    return measure


def near(of: dict[str, str], printed: dict[str, float | str], form: str) -> Measure:
    """A check for every place, of the relative distance of a formula from what is printed (told in brackets)."""

    def measure(results: Results) -> Measured:
        checks, words = [], []
        for where, text in of.items():
            value, asked = formula(text)(results.numbers), formula(str(printed[where]))(results.numbers)
            if math.isfinite(value) and math.isfinite(asked):
                checks.append((where, value / asked - 1.0))
                words.append(f"{where}: {shown(value, form)} ({asked:g})")
        return Measured(checks, ", ".join(words))

    return measure


def depths(of: str, form: str, also: Sequence[str] = ()) -> Measure:
    """A check of a column for every depth, at the large wave; `also`: columns that are told besides."""

    def measure(results: Results) -> Measured:
        rows = [row for row in results.over_depth(LARGE) if math.isfinite(value_of(row, of))]
        words = (" and ".join(shown(value_of(row, name), form) for name in (of, *also)) for row in rows)
        checks = [(at(row), row[of]) for row in rows]
        return Measured(checks, ", ".join(f"{word} at {at(row)}" for word, row in zip(words, rows, strict=True)))

    return measure


def passed(*checks: tuple[str, bool]) -> list[Check]:
    """Checks that the measure has decided itself, for the rule `met`."""
    return [(where, float(holds)) for where, holds in checks]


def value_of(row: Row | None, column: str) -> float:
    """A number of a row; nan where the row, or its entry, is not there."""
    return math.nan if row is None else float(row.get(column, math.nan))


def exponent(row: Row | None) -> str:
    """The exponent of the tangent dynamics with its error, in words."""
    value, error = value_of(row, EXPONENT), value_of(row, ERROR)
    return "none" if math.isnan(value) else f"{shown(value, '.3f')} ± {shown(error, '.3f')}"


def positive(row: Row) -> bool:
    """Whether that exponent is above zero beyond doubt."""
    return value_of(row, EXPONENT) - NOT_IN_DOUBT * value_of(row, ERROR) > 0.0


def settled(row: Row) -> bool:
    """Whether the run says if its exponent is positive: by the exponent itself, or by a regime that excludes it."""
    below = value_of(row, EXPONENT) + NOT_IN_DOUBT * value_of(row, ERROR) < 0.0
    return positive(row) or below or row["regime"] not in UNDECIDED


def at(row: Row) -> str:
    """The depth of a row, in words."""
    return f"H = {row['depth_m']:g} m"


def elsewhere(results: Results, steepness: float) -> list[tuple[str, Row]]:
    """(where, row) of the runs whose buoy loses buoyancy out of the water, by depth: not as shipped, yet likelier."""
    if not results.dependence:
        return []
    usual = results.usual()["submergence"]
    others = dict.fromkeys(row["submergence"] for row in results.dependence if row["submergence"] != usual)
    found = [(under, row) for under in others for row in results.over_depth(steepness, submergence=under)]
    return [(f"{at(row)} with {under}", row) for under, row in found]


def everywhere(results: Results, steepness: float) -> list[tuple[str, Row]]:
    """(where, row) of the short runs of a wave at every depth, with both buoyancies."""
    return [(at(row), row) for row in results.over_depth(steepness)] + elsewhere(results, steepness)


def regimes(rows: Iterable[tuple[str, Row]], is_so: Callable[[str], bool]) -> list[Check]:
    """A check of every row that has a verdict: whether its regime is so."""
    decided = ((where, row["regime"]) for where, row in rows if row["regime"] not in UNDECIDED)
    return passed(*((where, is_so(regime)) for where, regime in decided))


def by_regime(rows: Iterable[tuple[str, Row]]) -> str:
    """Regimes of (where, row), each with the places that have it."""
    places: dict[str, list[str]] = {}
    for where, row in rows:
        places.setdefault(row["regime"] or "no verdict", []).append(where)
    return "; ".join(f"{regime} at {grouped(some)}" for regime, some in places.items()) or "none"
