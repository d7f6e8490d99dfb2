"""What campaigns say at their end, in sentences: what of it several campaigns share.

A study's `answer(order, rows)` gives at most eight sentences, made of nothing but the rows of its tables; the command
prints them and keeps them as answer.txt, where its report finds them.
"""

import csv
import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from campaigns.statements import FAILS, HOLDS, HOLDS_IF, OPEN, listed
from campaigns.statements import FILE as STATEMENTS
from engine.views import carries_tangents, in_regular_waves

Row = Mapping[str, object]
PERIODIC, QUASI, CHAOTIC = "period-", "quasi-periodic", "chaotic"
OPEN_WORDS = {"undecided": "tests disagree", "transient": "still changing"}
_VERDICTS = {HOLDS: "hold", HOLDS_IF: "hold under a condition", FAILS: "do not hold", OPEN: "are not decided"}


def known(row: Row, name: str) -> float:
    """A number of a row; nan where it is unknown."""
    entry = row.get(name)
    return math.nan if entry is None or entry == "" else float(entry)


def greatest(rows: Sequence[Row], name: str) -> Row | None:
    """The row in which a column is greatest; None where no row knows it."""
    found = [row for row in rows if math.isfinite(known(row, name))]
    return max(found, key=lambda row: known(row, name), default=None)


def spans(chosen: Sequence[bool], values: Sequence[float]) -> str:
    """The chosen of the values in words, neighbours joined.

    >>> spans([True, True, True, False, True], [0.01, 0.02, 0.03, 0.04, 0.05]), spans([False], [0.1])
    ('0.01 to 0.03 and 0.05', 'none')
    """
    groups: list[list[float]] = []
    for before, wanted, value in zip([False, *chosen], chosen, values, strict=False):
        if wanted:
            groups = groups if before else [*groups, []]
            groups[-1].append(value)
    return listed(f"{one[0]:.4g} to {one[-1]:.4g}" if len(one) > 1 else f"{one[0]:.4g}" for one in groups)


def of_kicks(row: Row) -> str:
    """ "7 of 8": how many kicks end in the motion of a row; empty where none were drawn."""
    kicks = known(row, "kicks")
    return f"{kicks * known(row, 'share'):.0f} of {kicks:.0f}" if math.isfinite(kicks) else ""


def between(row: Row) -> str:
    """ "0.53 to 0.98": the interval of a share."""
    return f"{known(row, 'share_low'):.2f} to {known(row, 'share_high'):.2f}"


def kilonewton(force_N: float) -> str:
    """ "9.45 kN"."""
    return f"{force_N / 1e3:.3g} kN"


def verdicts(folder: Path, quoted: int) -> Iterator[str]:
    """How many of the paper's statements hold, by statements.csv; then the first `quoted` that do not, a line each."""
    try:
        with open(folder / STATEMENTS, encoding="utf-8", newline="") as file:
            judged = list(csv.DictReader(file))
    except FileNotFoundError:  # as where no run ended
        return
    counts = {said: sum(row["verdict"] == word for row in judged) for word, said in _VERDICTS.items()}
    said = listed(f"{words} {many}" for words, many in counts.items() if many)
    yield f"Of {len(judged)} statements of the paper {said}."
    failing = [row for row in judged if row["verdict"] == FAILS]
    yield from (f"Does not hold: {row['statement']}" for row in failing[:quoted])
    if more := [row["number"] for row in failing[quoted:]]:
        yield f"{'Further ones' if quoted else 'Those'} that do not: no. {listed(more)} of {STATEMENTS}."


def regimes(rows: Sequence[Row], symbol: str, values: Sequence[float], scene) -> tuple[list[str], list[str]]:
    """Where the motion is regular, and of which kind; then chaos with its exponents, and what is not decided.

    rows: of `buoy_sweep.rows`, sorted by `values`, called symbol; scene: of one of them. Without verdicts: whether
    motions repeat, and what a verdict needs.
    """
    said = [str(row.get("regime") or "") for row in rows]
    if not any(said):
        found = [known(row, "strobed_period") for row in rows]
        if not any(map(math.isfinite, found)):
            return [f"No run is judged, because {_lacking(scene)}."], []
        most, place = max(filter(math.isfinite, found)), spans([*map(math.isfinite, found)], values)
        return [f"No run is judged. Repeats after 1 to {most:g} wave periods: {symbol} = {place}."], []

    def at(*words: str) -> str:
        return spans([one in words for one in said], values)

    value, error = "lyapunov_tangent_bits_per_period", "lyapunov_tangent_error"
    found = set(filter(None, said))
    periodic = sorted((word for word in found if word.startswith(PERIODIC)), key=lambda word: (len(word), word))
    regular, rest = [], []
    if calm := [*periodic, *({QUASI} & found)]:
        where, lowest = at(*calm), f"{values[0]:.4g} to "
        one_range = where.startswith(lowest) and " and " not in where
        preposition, lowest = ("up to", lowest) if one_range else ("at", "")
        kinds = [f"period {listed(word.removeprefix(PERIODIC) for word in periodic)}"] if periodic else []
        kinds += [f"quasi-periodic{f' at {at(QUASI)}' if periodic else ''}"] if QUASI in found else []
        regular.append(f"Regular {preposition} {symbol} = {where.removeprefix(lowest)}: {', '.join(kinds)}.")
    for word in sorted(found - {*calm, *OPEN_WORDS}):
        growth = _growth([row for row, one in zip(rows, said, strict=True) if one == word]) if word == CHAOTIC else ""
        rest.append(f"{word.capitalize()} at {symbol} = {at(word)}{growth}.")
    beside = [known(row, "strobed_period") > 0 and known(row, value) > 2.0 * known(row, error) for row in rows]
    if any(beside):
        rest.append(f"Perturbations grow though the buoy repeats at {symbol} = {spans(beside, values)}.")
    if more := "; ".join(f"{words} at {symbol} = {at(word)}" for word, words in OPEN_WORDS.items() if word in found):
        rest.append(f"Not decided: {more}.")
    return regular, rest


def _lacking(scene) -> str:
    """What a verdict needs that runs of this scene, none of which repeats, do not have."""
    if not in_regular_waves(scene):
        return "verdicts exist only for a buoy in regular waves"
    if scene.motion.dimensions == 2 and not carries_tangents(scene):
        return "verdicts in a plane need bending stiffness and an implicit integrator"
    return "none repeats at t = k T within so few --periods"


def _growth(rows: Sequence[Row]) -> str:
    """The exponents of rows, from tangent dynamics where they carry some, else by Wolf's method."""
    for how in ("tangent", "wolf"):
        columns = f"lyapunov_{how}_bits_per_period", f"lyapunov_{how}_error"
        if found := [row for row in rows if math.isfinite(known(row, columns[0]))]:
            values, errors = ([known(row, name) for row in found] for name in columns)
            span = f"{min(values):.2f} to {max(values):.2f}" if len(found) > 1 else f"{values[0]:.2f}"
            most = "up to " if len(found) > 1 else ""
            return f": neighbours part by {span} bits a wave (standard error {most}{max(errors):.2f})"
    return ""
