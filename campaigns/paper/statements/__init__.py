"""Every quantitative or qualitative statement of sections 3 to 5 and of the abstract, as claims.

The tables are statements.toml in `campaigns/paper` and `campaigns/breaking_line`; this package measures them. What
depends on the water depth, which the paper does not give, is judged at every depth of the dependence study.
"""

import tomllib
from dataclasses import replace
from functools import cache
from pathlib import Path

from campaigns.breaking_line import judging as line
from campaigns.paper.statements import large_waves, plane, small_waves
from campaigns.paper.statements.judging import depths, numbers
from campaigns.statements import Claim, read_claims

TABLE = Path(__file__).parents[1] / "statements.toml"
OWN = {
    small_waves: ("always taut", "regular", "uncoupled", "on estimates", "exponent to zero", "doubled buoy"),
    large_waves: (
        "threshold", "chaos beyond", "snapping", "buckles", "impulsive", "positive exponent", "chaotic",
        "never repeats", "no dominant mode",
    ),
    plane: ("strange", "planar", "small decays", "large grows", "comparable", "spatial"),
}  # fmt: skip
MEASURES = {"numbers": numbers, "depths": depths} | {
    name: getattr(module, name.replace(" ", "_")) for module, names in OWN.items() for name in names
}


@cache
def claims() -> tuple[Claim, ...]:
    """All claims, in the order of the paper."""
    named = line.claims() | buoy_claims()
    accuracy = (claim for claim in named.values() if claim.place == "3")
    sections = (claim for claim in named.values() if claim.place not in ("3", "5"))
    said_again = tomllib.loads(TABLE.read_text(encoding="utf-8"))["conclusions"]
    conclusions = (replace(named[name], place="5", evidence=evidence) for name, evidence in said_again)
    return (*accuracy, *sections, *conclusions)


@cache
def buoy_claims() -> dict[str, Claim]:
    """The claims on the buoy, by name."""
    return read_claims(TABLE, MEASURES)
