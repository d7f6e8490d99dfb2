"""Sizes, speeds and relative differences of the out-of-plane report, as its sentences put them."""

from __future__ import annotations

from ..parts.wording import number, percent


def metres(size: float) -> str:
    """A lateral distance with a unit that needs no exponent: nm, µm, mm, m."""
    for unit, scale in (("m", 1.0), ("mm", 1e3), ("µm", 1e6), ("nm", 1e9)):
        if size * scale >= (0.1 if unit == "m" else 1.0):
            return f"{number(size * scale, 2)}\u00a0{unit}"
    return f"{number(size, 2)}\u00a0m"


def speed(push: float) -> str:
    """A push with its unit: 1e-5 m/s."""
    return f"{number(push)}\u00a0m/s"


def share(size: float) -> str:
    """A relative difference: a power of ten below a tenth of a per cent, per cent above."""
    return number(size, 1) if size < 1e-3 else percent(size)


def spread(values: list[float]) -> float:
    """(largest - smallest)/mean."""
    return (max(values) - min(values)) / (sum(values) / len(values))
