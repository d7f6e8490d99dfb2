"""What campaigns say at their end, in sentences: what of it several campaigns share.

A study's `answer(order, rows)` gives at most eight sentences, made of nothing but the rows of its tables; the command
prints them and keeps them as answer.txt, where its report finds them.
"""

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from functools import partial
from operator import itemgetter
from pathlib import Path

from engine.views import carries_tangents, in_regular_waves
from tables import (
    CHAOTIC,
    FAILS,
    PERIODIC,
    QUASI,
    STATEMENTS,
    TANGENT_ERROR,
    TANGENT_EXPONENT,
    TRANSIENT,
    UNDECIDED,
    VERDICTS,
    Row,
    any_rows,
    listed,
    number_of,
    ranges,
)

OPEN_WORDS = {UNDECIDED: "tests disagree", TRANSIENT: "still changing"}


def greatest(rows: Sequence[Row], name: str) -> Row | None:
    """The row in which a column is greatest; None where no row knows it."""
    return max(known_rows(rows, name), key=partial(number_of, name=name), default=None)


def known_rows(rows: Sequence[Row], name: str) -> list[Row]:
    """The rows that know a number of a column."""
    return [row for row in rows if math.isfinite(number_of(row, name))]


def numbers_of(rows: Sequence[Row], name: str) -> list[float]:
    """The numbers of a column, nan where a row has none."""
    return [number_of(row, name) for row in rows]


def kilonewton(force_N: float) -> str:
    """ "9.45 kN"."""
    return f"{force_N / 1e3:.3g} kN"


def verdicts(folder: Path, quoted: int) -> Iterator[str]:
    """How many of the paper's statements hold, by statements.csv; then the first `quoted` that do not, a line each."""
    statements = any_rows(folder / STATEMENTS)
    if not statements:  # as where no run ended
        return
    counts = Counter(map(itemgetter("verdict"), statements))
    parts = [f"{words} {counts[verdict]}" for verdict, words in VERDICTS.items() if counts[verdict]]
    yield f"Of {len(statements)} statements of the paper {listed(parts)}."
    failing = [row for row in statements if row["verdict"] == FAILS]
    for row in failing[:quoted]:
        yield f"Does not hold: {row['statement']}"
    numbers = listed(map(itemgetter("number"), failing[quoted:]))
    if len(failing) > quoted:
        yield f"{('Those', 'Further ones')[quoted > 0]} that do not: no. {numbers} of {STATEMENTS}."


def regimes(rows: Sequence[Row], symbol: str, values: Sequence[float], scene) -> tuple[list[str], list[str]]:
    """Where the motion is regular, and of which kind; then chaos with its exponents, and what is not decided.

    rows: of `campaigns.explore.rows`, sorted by `values`, which are called symbol. scene: of one of them. Without
    verdicts the answer is whether motions repeat, and what a verdict needs.
    """
    words = [str(row.get("regime") or "") for row in rows]
    if not any(words):
        return [_unjudged(rows, symbol, values, scene)], []

    def at(*chosen: str) -> str:
        return ranges(values, [word in chosen for word in words], 2)

    different = set(filter(None, words))
    calm = [word for word in different if word.startswith(PERIODIC)]
    calm.sort(key=lambda word: (len(word), word))
    kinds = []
    if calm:
        kinds.append(f"period {listed(word.removeprefix(PERIODIC) for word in calm)}")
    if QUASI in different:
        kind = QUASI
        if calm:
            kind = f"{QUASI} at {at(QUASI)}"
        kinds.append(kind)
        calm.append(QUASI)
    regular, others = [], []
    if calm:
        where, lowest = at(*calm), f"{values[0]:.4g} to "
        if where.startswith(lowest) and " and " not in where:
            where = f"up to {symbol} = {where.removeprefix(lowest)}"
        else:
            where = f"at {symbol} = {where}"
        regular.append(f"Regular {where}: {', '.join(kinds)}.")
    for word in sorted(different - {*calm, *OPEN_WORDS}):
        growth = ""
        if word == CHAOTIC:
            growth = _growth([row for row in rows if row.get("regime") == word])
        others.append(f"{word.capitalize()} at {symbol} = {at(word)}{growth}.")
    growing = []
    for row in rows:
        grows = number_of(row, TANGENT_EXPONENT) > 2.0 * number_of(row, TANGENT_ERROR)
        growing.append(grows and number_of(row, "strobed_period") > 0)
    if any(growing):
        others.append(f"Perturbations grow though the buoy repeats at {symbol} = {ranges(values, growing, 2)}.")
    doubts = []
    for word, phrase in OPEN_WORDS.items():
        if word in different:
            doubts.append(f"{phrase} at {symbol} = {at(word)}")
    if doubts:
        others.append(f"Not decided: {'; '.join(doubts)}.")
    return regular, others


def _unjudged(rows: Sequence[Row], symbol: str, values: Sequence[float], scene) -> str:
    """Where motions repeat of runs that have no verdict; where none does, what a verdict needs."""
    periods = numbers_of(rows, "strobed_period")
    known = list(map(math.isfinite, periods))
    if any(known):
        longest = max(filter(math.isfinite, periods))
        place = ranges(values, known, 2)
        return f"No run is judged. Repeats after 1 to {longest:g} wave periods: {symbol} = {place}."
    reason = "none repeats at t = k T within so few --periods"
    if not in_regular_waves(scene):
        reason = "verdicts exist only for a buoy in regular waves"
    elif scene.motion.dimensions == 2 and not carries_tangents(scene):
        reason = "verdicts in a plane need bending stiffness and an implicit integrator"
    return f"No run is judged, because {reason}."


def _growth(rows: Sequence[Row]) -> str:
    """The exponents of rows, from tangent dynamics where they carry some, else by Wolf's method."""
    for method in ("tangent", "wolf"):
        name = f"lyapunov_{method}_bits_per_period"
        known = known_rows(rows, name)
        if not known:
            continue
        values = numbers_of(known, name)
        error = max(numbers_of(known, f"lyapunov_{method}_error"))
        span, most = f"{values[0]:.2f}", ""
        if len(known) > 1:
            span, most = f"{min(values):.2f} to {max(values):.2f}", "up to "
        return f": neighbours part by {span} bits a wave (standard error {most}{error:.2f})"
    return ""
