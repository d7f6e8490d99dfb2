"""Every quantitative or qualitative statement of sections 3 to 5 and of the abstract, as claims.

The tables are statements.toml in `campaigns/paper` and `campaigns/breaking_line`; this package measures them. What
depends on the water depth, which the paper does not give, is judged at every depth of the dependence study, on runs
from rest; what depends on the steepness is judged on every motion of the sweep.
"""

import tomllib
from collections.abc import Callable
from dataclasses import replace
from functools import cache, partial
from pathlib import Path

from campaigns.breaking_line import judging as line
from campaigns.paper.statements import buoy
from campaigns.paper.statements.judging import depths, numbers
from campaigns.statements import Claim, Measured, read_claims

TABLE = Path(__file__).parents[1] / "statements.toml"
MEASURES = {"numbers": numbers, "depths": depths}
for _name, _measure in vars(buoy).items():
    if getattr(_measure, "__module__", "") == buoy.__name__:
        MEASURES[_name.replace("_", " ")] = _measure


@cache
def claims(quick: bool = False) -> tuple[Claim, ...]:
    """All claims, in the order of the paper. quick: those on the buoy are not judged, because short runs mislead."""
    of_buoy = buoy_claims()
    if quick:
        of_buoy = {name: replace(claim, measure=partial(_not_judged, claim.measure)) for name, claim in of_buoy.items()}
    named = line.claims() | of_buoy
    accuracy, sections, conclusions = [], [], []
    for claim in named.values():
        if claim.place == "3":
            accuracy.append(claim)
        elif claim.place != "5":
            sections.append(claim)
    repeated = tomllib.loads(TABLE.read_text(encoding="utf-8"))["conclusions"]
    for name, evidence in repeated:
        conclusions.append(replace(named[name], place="5", evidence=evidence))
    return (*accuracy, *sections, *conclusions)


def _not_judged(measure: Callable, results) -> Measured:
    reason = measure(results).told or "nothing is known"
    return Measured((), f"{reason}; not judged, because these runs are too few or too short")


@cache
def buoy_claims() -> dict[str, Claim]:
    """The claims on the buoy, by name."""
    return read_claims(TABLE, MEASURES)
