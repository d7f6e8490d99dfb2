"""Rows of the buoy as the statements read them."""

from __future__ import annotations

import math

from ...parts.statements import grouped
from ...parts.wording import decimals, number
from ..results import Results

OPEN = ("", "undecided", "transient")  # regimes that decide nothing
NOTHING = "where it is undecided or a transient, nothing"
NOT_IN_DOUBT = 2.0  # standard errors


def value(row: dict | None, column: str) -> float:
    """A number of a row; nan where the row, or its entry, is not there."""
    entry = None if row is None else row.get(column)
    return math.nan if entry is None or entry == "" else float(entry)


def exponent(row: dict | None) -> str:
    """The exponent of the tangent dynamics with its error, in words."""
    found, error = (value(row, f"lyapunov_tangent_{name}") for name in ("bits_per_period", "error"))
    return "none" if math.isnan(found) else f"{decimals(found, 3)} ± {decimals(error, 3)}"


def by_regime(found: list[tuple[str, dict]]) -> str:
    """Regimes of (where, row), each with the places that have it."""
    places: dict[str, list[str]] = {}
    for where, row in found:
        places.setdefault(row["regime"] or "no verdict", []).append(where)
    return "; ".join(f"{regime} at {grouped(some)}" for regime, some in places.items()) or "none"


def positive(row: dict) -> bool:
    """Whether that exponent is above zero beyond doubt."""
    found, error = (value(row, f"lyapunov_tangent_{name}") for name in ("bits_per_period", "error"))
    return found - NOT_IN_DOUBT * error > 0.0


def settled(row: dict) -> bool:
    """Whether the run says if its exponent is positive: by the exponent itself, or by a regime that excludes it."""
    below = value(row, "lyapunov_tangent_bits_per_period") + NOT_IN_DOUBT * value(row, "lyapunov_tangent_error") < 0.0
    return positive(row) or below or row["regime"] not in OPEN


def at(row: dict) -> str:
    """The depth of a row, in words."""
    return f"H = {number(row['depth_m'])} m"


def elsewhere(results: Results, steepness: float) -> list[tuple[str, dict]]:
    """(where, row) of the runs whose buoy loses buoyancy out of the water, by depth: not as shipped, yet likelier."""
    if not results.dependence:
        return []
    usual = results.usual()["submergence"]
    others = dict.fromkeys(row["submergence"] for row in results.dependence if row["submergence"] != usual)
    found = [(under, row) for under in others for row in good(results.over_depth(steepness, submergence=under))]
    return [(f"{at(row)} with `{under}`", row) for under, row in found]


def good(rows) -> list[dict]:
    """The rows of runs that ended as asked."""
    return [row for row in rows if row["status"] == "ok"]
