"""Words that stand in tables, and numbers and lists as a reader wants them: campaigns write them, reports read them."""

import math
import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from itertools import groupby
from operator import itemgetter

# Regimes, as `analysis` names them. "period-" begins that of a periodic motion.
PERIODIC, QUASI, CHAOTIC, TRANSIENT, UNDECIDED = "period-", "quasi-periodic", "chaotic", "transient", "undecided"
OPEN = (UNDECIDED, TRANSIENT)  # regimes that decide nothing

# Statements of the paper: the table of them, its columns, and what a verdict on some of them is in a sentence.
STATEMENTS = "statements.csv"
STATEMENT_COLUMNS = ("number", "place", "statement", "verdict", "condition", "found", "threshold", "evidence")
HOLDS, HOLDS_IF, FAILS, NOT_JUDGED = "holds", "holds if", "does not hold", "–"
VERDICTS = {
    HOLDS: "hold",
    HOLDS_IF: "hold under a condition",
    FAILS: "do not hold",
    NOT_JUDGED: "not decided",
}

SETTLED, JOINED, UNSETTLED = OUTCOMES = "settled", "joined", "unsettled"  # of a start
COMPUTED, SCREENED, FAILED = "computed", "screened", "failed"  # where the regime of a cell of a map comes from
CAPPED = "wetted cap"  # role of a companion
WHOLE_BRANCH = "reaches", "comes back", "meets"  # first words of the end of a branch that was followed to its end
# in a row's message: with smaller elements and steps
OTHER_MOTION, OTHER_GROWTH = "becomes another motion", "perturbations grow otherwise"
PEAK, PEAK_ERROR = "tension_top_max_N", "tension_top_max_error_N"
TANGENT_EXPONENT, TANGENT_ERROR = "lyapunov_tangent_bits_per_period", "lyapunov_tangent_error"
WOLF_EXPONENT, WOLF_ERROR = "lyapunov_wolf_bits_per_period", "lyapunov_wolf_error"
BUOY_HEIGHT, EMERGED = "max_buoy_height_above_water_m", "max_buoy_emergence"
COARSE = 0.05  # of the largest tension: an error above it is told in words
SMALL, LARGE = PAPER_STEEPNESS = 0.016, 0.13  # kA of sections 4.2.1 and 4.2.2 of the paper
BODIES = {"buoy": "y_m", "rope": "offplane_m"}  # what leaves the plane of the waves -> column of a trajectory
ANSWER, PROVENANCE = "answer.txt", "provenance.json"
EMPTY = "–"  # in print, where a table has no entry


def typed(value: float | None, digits: int = 4) -> str:
    """A value with `digits` significant digits, as one would type it: without an exponent where it can be read so.

    >>> typed(20.391234), typed(-12000.0), typed(2.5e-9), typed(float("nan"))
    ('20.39', '-12000', '2.5e-9', '–')
    """
    if value is None or not math.isfinite(value):
        return EMPTY
    if value == int(value) and abs(value) < 1e7:
        return str(int(value))
    text = f"{value:.{digits}g}"
    if "e" in text and 1e-4 <= abs(value) < 1e7:
        text = f"{value:.0f}"
    return text.replace("e-0", "e-").replace("e+0", "e").replace("e+", "e")


def number(value: float | None, digits: int = 4) -> str:
    """As `typed`, with the minus sign of print.

    >>> number(-1611.0)
    '−1611'
    """
    return _minus(typed(value, digits))


def verdict_counts(statements: Iterable[Mapping[str, object]]) -> str:
    """How many statements of the paper have each verdict: "3 hold, 1 not decided"; "none" of none."""
    counts = Counter(map(itemgetter("verdict"), statements))
    parts = [f"{counts[verdict]} {words}" for verdict, words in VERDICTS.items() if counts[verdict]]
    return ", ".join(parts) or "none"


def decimals(value: float | None, places: int) -> str:
    """A value with a fixed number of decimals, so that a column lines up; a dash for none."""
    if value is None or not math.isfinite(value):
        return EMPTY
    text = f"{value:.{places}f}"
    if float(text) == 0:
        return text.removeprefix("-")
    return _minus(text)


def percent(share: float) -> str:
    """ "12.5 %" of a share of 0.125."""
    return f"{number(100 * share, 3)} %"


def _minus(text: str) -> str:
    """The sign as print wants it: a hyphen at the end of a line would leave its number behind."""
    if text.startswith("-"):
        return "−" + text[1:]
    return text


def printed(sentence: str) -> str:
    """A sentence written for a terminal, with the signs of print.

    >>> printed("growth -0.06 nats, 0.02 +- 0.01, a 0-1 test, 4 -> 9 kN")
    'growth −0.06 nats, 0.02 ± 0.01, a 0-1 test, 4 → 9 kN'
    """
    return re.sub(r"(?<![\w.)])-(?=[\d.])", "−", sentence.replace(" +- ", " ± ").replace(" -> ", " → "))


def count(how_many: int, singular: str, plural: str = "") -> str:
    """ "1 run", "3 runs"."""
    if how_many == 1:
        return f"{how_many} {singular}"
    return f"{how_many} {plural or singular + 's'}"


def listed(words: Iterable[str]) -> str:
    """ "a", "a and b", "a, b and c"; "none" of nothing."""
    words = list(words)
    if not words:
        return "none"
    if len(words) == 1:
        return words[0]
    return f"{', '.join(words[:-1])} and {words[-1]}"


def ranges(values: Sequence[float], chosen: Sequence[bool], least: int = 3) -> str:
    """The chosen of the values in words; `least` neighbours in the full list, or more, are joined into "a to b".

    >>> ranges([0.01, 0.02, 0.03, 0.05], [True, True, True, False])
    '0.01 to 0.03'
    """
    parts = []
    for wanted, group in groupby(zip(values, chosen, strict=True), key=itemgetter(1)):
        numbers = [number(value) for value, _ in group]
        if wanted and len(numbers) >= least:
            parts.append(f"{numbers[0]} to {numbers[-1]}")
        elif wanted:
            parts += numbers
    return listed(parts)


# A character of Unicode's private area: no text from outside carries it, so no text from outside becomes a subscript.
DOWN, UP = "\ue000", "\ue001"


def sub(text: str) -> str:
    """The text as a subscript, which a report prints so: "T" + sub("i")."""
    return f"{DOWN}{text}{UP}"
