"""Statements put to the test: what is claimed, what is measured, and the rule that decides.

A `Claim` is a record, read from a table (`read_claims`). `judge` measures it in the results and applies its rule at
each place where it looked: the claim "holds" where every check passes, it "does not hold" where none does, and it
"holds if" between, with the places; a dash where nothing was looked at. A verdict is always computed and cannot be
written. `statements.csv` has one row a claim.
"""

import math
import re
import tomllib
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from campaigns.machinery import write_new
from tables import FAILS, HOLDS, HOLDS_IF, NOT_JUDGED, STATEMENT_COLUMNS, STATEMENTS, csv_of, listed

NOT_SHOWN = "No run shows it."
Check = tuple[str, float]  # where it was looked, and the number that the rule judges there


@dataclass(frozen=True)
class Measured:
    """What the results say to a claim."""

    checks: Sequence[Check] = ()  # (where, number) for every place that decides; nan decides nothing
    told: str = ""  # the numbers as the reader sees them


@dataclass(frozen=True)
class Claim:
    """A statement of the paper, as data."""

    place: str  # section and figure of the paper
    text: str  # what the paper says, in our words, in a sentence
    quantity: str  # what is measured, with its unit
    measure: Callable[[object], Measured]  # of the results
    holds: Callable[[float], bool]  # what decides a check: a test of the measured number
    threshold: str  # the same in words
    evidence: str  # what else supports the number: refinement, other method, code, closed form


@dataclass(frozen=True)
class Statement:
    """A claim with its verdict. checks: (where, whether it holds there)."""

    claim: Claim
    checks: tuple[tuple[str, bool], ...]
    found: str

    @property
    def verdict(self) -> str:
        """HOLDS, HOLDS_IF, FAILS or NOT_JUDGED."""
        passed = {holds for _, holds in self.checks}
        if not passed:
            return NOT_JUDGED
        if passed == {True}:
            return HOLDS
        return HOLDS_IF if passed == {True, False} else FAILS

    @property
    def condition(self) -> str:
        """Of "holds if": where it holds, and where not; else nothing."""
        if self.verdict != HOLDS_IF:
            return ""
        places = {True: [], False: []}
        for where, holds in self.checks:
            places[holds].append(where)
        return f"{grouped(places[True])}; not {grouped(places[False])}"


def judge(claim: Claim, results: object) -> Statement:
    """Measure a claim in the results and apply its rule."""
    measured = claim.measure(results)
    checks = [(where, bool(claim.holds(value))) for where, value in measured.checks if math.isfinite(value)]
    found = NOT_SHOWN
    if measured.told:
        found = f"{claim.quantity}: {measured.told}."
    return Statement(claim, tuple(checks), found)


def write_statements(folder: Path, claims: Iterable[Claim], results: object) -> None:
    """Judge the claims and write statements.csv; a file that says the same already stays as it is. Raises OSError."""
    statements = [judge(claim, results) for claim in claims]
    write_new(folder / STATEMENTS, as_csv(statements))


def as_csv(statements: Sequence[Statement]) -> bytes:
    """statements.csv: one row a statement, numbered from 1."""
    rows = []
    for number, statement in enumerate(statements, 1):
        claim = statement.claim
        verdict = statement.verdict, statement.condition, statement.found
        rows.append([number, claim.place, claim.text, *verdict, claim.threshold, claim.evidence])
    return csv_of(STATEMENT_COLUMNS, rows)


def read_claims(path: Path, measures: Mapping[str, Callable]) -> dict[str, Claim]:
    """The claims of a .toml file by name, in its order; a claim without a name has its text for one.

    measures: what `by` may be: a function of the results, and of the entries that are not fields of a Claim.
    """
    with open(path, "rb") as file:
        table = tomllib.load(file)
    claims = {}
    for entry in table["claim"]:
        name, measure = entry.pop("name", entry["text"]), measures[entry.pop("by")]
        fields = {field: entry.pop(field) for field in ("place", "text", "quantity", "threshold")}
        holds, evidence = _test(entry.pop("rule")), entry.pop("evidence").format(**table["words"])
        if entry:
            measure = partial(measure, **entry)
        claims[name] = Claim(**fields, measure=measure, holds=holds, evidence=evidence)
    return claims


def _test(rule: str) -> Callable:
    """A rule in words, "within 0.1", as a test of a number; "met": the measure has decided itself, 1 or 0."""
    if rule == "met":
        rule = "at least 1"
    kind, _, limits = rule.rpartition(" ")
    limit = float(limits)
    tests = {
        "below": lambda value: value < limit,
        "above": lambda value: value > limit,
        "within": lambda value: abs(value) < limit,
        "at least": lambda value: value >= limit,
        "at most": lambda value: value <= limit,
        "between 0 and": lambda value: 0.0 < value < limit,
    }
    return tests[kind]


def formula(text: str) -> Callable:
    """A formula over the numbers of a row, "a / b - 1"; nan where the row lacks one."""

    def of(row):
        import pandas

        try:
            return float(pandas.eval(text, local_dict=dict(row), engine="python"))
        except pandas.errors.UndefinedVariableError:
            return math.nan

    return of


def shown(value: float, form: str) -> str:
    """A number by a format specification, with the signs of print; a dash for none.

    >>> shown(-0.1234, ".1%"), shown(0.5, ".2f"), shown(float("nan"), ".2f"), shown(-0.0001, ".2f")
    ('−12.3 %', '0.50', '–', '0.00')
    """
    if not math.isfinite(value):
        return NOT_JUDGED
    text = format(value, form)
    if not re.search("[1-9]", text):
        text = text.removeprefix("-")
    return text.replace("-", "−").replace("%", " %")


def told(numbers: Iterable[Check], form: str) -> str:
    """Numbers with their names: "1: 43.2, 2: 111.2"."""
    return ", ".join(f"{name}: {shown(value, form)}" for name, value in numbers)


def grouped(places: list[str]) -> str:
    """The places in a list; what some share around one number is said once.

    >>> grouped(["H = 21 m", "H = 22 m", "H = 22 m with a cap"]), grouped(["r", "theta"])
    ('H = 21 and 22 m, and H = 22 m with a cap', 'r and theta')
    """
    groups = {}  # numbers by the words before and after them
    for place in places:
        before, number, after = place, "", ""
        part = re.fullmatch(r"(\D*)(\d\S*)(.*)", place)
        if part:
            before, number, after = part.groups()
        groups.setdefault((before, after), []).append(number)
    names = [f"{before}{listed(numbers)}{after}" for (before, after), numbers in groups.items()]
    if len(names) == 2 and " and " in "; ".join(names):
        return ", and ".join(names)
    return listed(names)
