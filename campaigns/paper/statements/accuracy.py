"""Section 3: what the paper promises of the buoy on twice the points."""

import math

from campaigns.paper.measured import Results
from campaigns.statements import Claim, Measured, below, shown

FINER = "twice the elements"


def doubled_buoy(results: Results) -> Measured:
    """Rms change of r over its range, of every repeated run on twice the elements, early and over all of it."""
    checks = []
    for again in results.accuracy:
        row = results.buoy.get(float(again["label"])) if again["run"] == FINER and again["status"] == "ok" else None
        if row is None:
            continue
        span = row["radius_max_m"] - row["radius_min_m"]
        whole = f"{again['periods']:g} periods"
        for column, when in (("error_early_m", "the first ten periods"), ("error_m", whole)):
            checks.append((f"kA = {row['steepness']:g} over {when}", again[column] / span))
    checks = [check for check in checks if math.isfinite(check[1])]
    return Measured(checks, ", ".join(f"{shown(off, '.2%')} at {where}" for where, off in checks))


DOUBLED_BUOY = Claim(
    "3", "Doubling the points changes the results by less than 1 %: the buoy, course of r.",
    "Rms change of r over its range", doubled_buoy, below(0.01, "below 1 %"),
    "docs/how_far_to_trust_a_run.md: 641 nodes, three other codes",
)  # fmt: skip
