"""Sizes, speeds, rates and relative differences of the out-of-plane report, as its sentences and tables put them."""

from __future__ import annotations

import math

from ..parts.wording import EMPTY, decimals, number, percent
from .runs import Run


def metres(size: float) -> str:
    """A lateral distance with a unit that needs no exponent: nm, µm, mm, m."""
    for unit, scale in (("m", 1.0), ("mm", 1e3), ("µm", 1e6), ("nm", 1e9)):
        if size * scale >= (0.1 if unit == "m" else 1.0):
            return f"{number(size * scale, 2)}\u00a0{unit}"
    return f"{number(size, 2)}\u00a0m"


def speed(push: float) -> str:
    """A push with its unit: 1e-5 m/s."""
    return f"{number(push)}\u00a0m/s"


def plus_minus(found: float, error: float) -> str:
    """A value with its error, to the first digit of the error or, after a 1, to the second; it stays on one line."""
    places = 4
    if error > 0:
        first = math.floor(math.log10(error))
        places = max(2, min(6, (1 if error < 2 * 10**first else 0) - first))
    return f"{decimals(found, places)}\u00a0±\u00a0{decimals(error, places)}"


def with_error(run: Run, body: str) -> str:
    """ "−0.0398 ± 0.0008" bits per period, or a dash."""
    if not run.known(f"{body}_rate_bits_per_period"):
        return EMPTY
    return plus_minus(run[f"{body}_rate_bits_per_period"], run[f"{body}_rate_error"])


def share(size: float) -> str:
    """A relative difference: a power of ten below a tenth of a per cent, per cent above."""
    return number(size, 1) if size < 1e-3 else percent(size)


def spread(values: list[float]) -> float:
    """(largest - smallest)/mean."""
    return (max(values) - min(values)) / (sum(values) / len(values))
