"""Numbers as a reader wants them, and lists as a sentence needs them."""

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from itertools import groupby
from operator import itemgetter

from .content import sub

EMPTY = "–"


def of_kicks(row: Mapping[str, object]) -> str:
    """ "7 of 8": how many kicks end in the motion of a row; its share where their number is not known."""
    share, kicks = row.get("share", math.nan), row.get("kicks", math.nan)
    if math.isfinite(share * kicks):
        return f"{share * kicks:.0f} of {kicks:.0f}"
    return number(share, 2)


def number(value: float | None, digits: int = 4) -> str:
    """A value with `digits` significant digits, without an exponent where it can be read without one; a dash for none.

    >>> number(20.391234), number(1611.0), number(2.5e-9), number(float("nan"))
    ('20.39', '1611', '2.5e-9', '–')
    """
    if value is None or not math.isfinite(value):
        return EMPTY
    if value == int(value) and abs(value) < 1e7:
        return _minus(str(int(value)))
    text = f"{value:.{digits}g}"
    if "e" in text and 1e-4 <= abs(value) < 1e7:
        text = f"{value:.0f}"
    return _minus(text.replace("e-0", "e-").replace("e+0", "e").replace("e+", "e"))


def decimals(value: float | None, places: int) -> str:
    """A value with a fixed number of decimals, so that a column lines up; a dash for none."""
    if value is None or not math.isfinite(value):
        return EMPTY
    text = f"{value:.{places}f}"
    return text.removeprefix("-") if float(text) == 0 else _minus(text)


def percent(share: float) -> str:
    """ "12.5 %" of a share of 0.125."""
    return f"{number(100 * share, 3)} %"


def _minus(text: str) -> str:
    """The sign as print wants it: a hyphen at the end of a line would leave its number behind."""
    return "−" + text[1:] if text.startswith("-") else text


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
    """ "a", "a and b", "a, b and c"."""
    words = list(words)
    if not words:
        return "none"
    if len(words) == 1:
        return words[0]
    return f"{', '.join(words[:-1])} and {words[-1]}"


def ranges(values: Sequence[float], chosen: Sequence[bool]) -> str:
    """The chosen of the values in words, neighbours in the full list joined into "a to b".

    >>> ranges([0.01, 0.02, 0.03, 0.05], [True, True, True, False])
    '0.01 to 0.03'
    """
    parts = []
    for wanted, group in groupby(zip(values, chosen, strict=True), key=itemgetter(1)):
        numbers = [number(value) for value, _ in group]
        if wanted and len(numbers) > 2:
            parts.append(f"{numbers[0]} to {numbers[-1]}")
        elif wanted:
            parts += numbers
    return listed(parts)


L_0 = "l" + sub("0")  # unstretched length
OMEGA_I, OMEGA_R, OMEGA_THETA = ("ω" + sub(letter) for letter in ("i", "r", "θ"))  # wave, radial and pendulum frequency
RHO_W = "ρ" + sub("w")  # density of the water
TAU_0 = "τ" + sub("0")  # start of the spectral window
T_I = "T" + sub("i")  # wave period
T_S = "T" + sub("s")  # static tension
