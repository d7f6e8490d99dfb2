"""Measures of the statements on the buoy: from `Results` to numbers that a rule can judge.

`looks` and `near` are of single numbers (`Results.numbers`), `over_depth` of the rows of the dependence study.
"""

import math
from collections.abc import Callable, Iterable

from campaigns.paper.measured import Results
from campaigns.statements import Check, Measured, grouped, shown, told
from campaigns.tables import Row

Number = Callable[[Results], float]
Measure = Callable[[Results], Measured]
UNDECIDED = ("", "undecided", "transient")  # regimes that decide nothing
NOTHING = "where it is undecided or a transient, nothing"
NOT_IN_DOUBT = 2.0  # standard errors
EXPONENT, ERROR = "lyapunov_tangent_bits_per_period", "lyapunov_tangent_error"
LONG = "the long run"


def of(name: str, over: str = "") -> Number:
    """One of the results' numbers, or its ratio to another."""
    return lambda results: results.number(name) / (results.number(over) if over else 1.0)


def looks(form: str, judge: Number | None = None, **numbers: Number) -> Measure:
    """A check for every number, under its name; judge: what the rule judges, where it is not the number told."""
    return at_places(form, numbers, judge)


def at_places(form: str, numbers: dict[str, Number], judge: Number | None = None) -> Measure:
    """`looks` for names with blanks."""

    def measure(results: Results) -> Measured:
        known = {where: number(results) for where, number in numbers.items()}
        known = {where: value for where, value in known.items() if math.isfinite(value)}
        checks = [(where, judge(results) if judge else value) for where, value in known.items()]
        return Measured(checks, told(known.items(), form))

    return measure


def near(form: str, **numbers: tuple[Number, float | Number]) -> Measure:
    """A check for every number, under its name, of its relative distance from what is printed (told in brackets)."""

    def measure(results: Results) -> Measured:
        checks, words = [], []
        for where, (number, asked) in numbers.items():
            value, printed = number(results), asked(results) if callable(asked) else asked
            if math.isfinite(value) and math.isfinite(printed):
                checks.append((where, value / printed - 1.0))
                words.append(f"{where}: {shown(value, form)} ({printed:g})")
        return Measured(checks, ", ".join(words))

    return measure


def over_depth(steepness: float, form: str, *columns: str, judge: Callable[[Row], float] | None = None) -> Measure:
    """A check for every depth, of the first column or of `judge`; all columns are told."""

    def measure(results: Results) -> Measured:
        rows = [row for row in results.over_depth(steepness) if math.isfinite(value_of(row, columns[0]))]
        words = (" and ".join(shown(value_of(row, name), form) for name in columns) for row in rows)
        checks = [(at(row), judge(row) if judge else row[columns[0]]) for row in rows]
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
    return [(f"{at(row)} with `{under}`", row) for under, row in found]


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
