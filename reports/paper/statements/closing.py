"""Section 3's promise on accuracy, and the conclusions (section 5) where they say more than sections 4.1 and 4.2."""

from __future__ import annotations

import math

from ...breaking_line import statements as own
from ...breaking_line.runs import find, of_kind
from ...parts.statements import Statement
from ...parts.wording import number, percent
from ..results import Results
from . import calm, line, snapping, violent

PROMISED = 0.01  # section 3: deviation on twice the points
FINER = "twice the elements"


def doubled_line(results: Results) -> Statement:
    claim = "Doubling the points changes the results by less than 1 %: the breaking line."
    numbers = []
    for one in of_kind(results.lines, "case"):
        fine = find(results.lines, one.case, "doubled")
        for column in ("end_speed_mps", "recoil_m", "kinetic_largest_J") if fine is not None else ():
            off = abs(fine.value(column) / one.value(column) - 1.0)
            numbers += [(one.name, off)] if math.isfinite(off) else []
    worst = {name: max(off for other, off in numbers if other == name) for name, _ in numbers}
    said = own.told([(name, 100 * off) for name, off in worst.items()], 3)
    found = f"Largest change of end speed, recoil or kinetic energy, %: {said}."
    checks = own.each(list(worst.items()), lambda off: off < PROMISED)
    return Statement(claim, found, checks, f"below {percent(PROMISED)}")


def doubled_buoy(results: Results) -> Statement:
    claim = "Doubling the points changes the results by less than 1 %: the buoy, course of r."
    rows = {row["steepness"]: row for row in results.buoy.values()}
    checks, words = [], []
    for again in results.accuracy:
        row = rows.get(float(again["label"])) if again["run"] == FINER and again["status"] == "ok" else None
        if row is None:
            continue
        span = row["radius_max_m"] - row["radius_min_m"]
        whole = f"{number(again['periods'])} periods"
        for column, when in (("error_early_m", "the first ten periods"), ("error_m", whole)):
            off = float(again[column]) / span
            where = f"kA = {number(row['steepness'])} over {when}"
            checks.append((where, off < PROMISED))
            words.append(f"{number(100 * off, 2)} at {where}")
    found = f"Rms change of r over its range, %: {', '.join(words) or 'no run shows it'}."
    return Statement(claim, found, tuple(checks), f"below {percent(PROMISED)}")


def dissipates(results: Results) -> Statement:
    both = line.shared(own.kinetic_spread)(results), line.shared(own.resting_part)(results)
    return Statement(
        "A line that breaks slowly takes up the kinetic energy along a larger part of its length.",
        " ".join(one.found for one in both),
        tuple(
            (f"judged by {by}", all(holds for _, holds in one.checks))
            for one, by in zip(both, ("the spread of the energy", "the part at rest"), strict=True)
            if one.checks
        ),
        "larger spread, smaller part at rest",
    )


METHOD = (
    ("3", doubled_line, "part `breaking_line`: every case on doubled grids"),
    ("3", doubled_buoy, "docs/how_far_to_trust_a_run.md: 641 nodes, three other codes"),
)
CONCLUSIONS = (
    ("5", doubled_buoy, "as under 3"),
    ("5", line.shared(own.tension), "as under 4.1.3"),
    ("5", line.shared(own.speed), line.EXACT),
    ("5", dissipates, "as under 4.1.3; docs/breaking_line.md"),
    ("5", calm.always_taut, "as under 4.2.1"),
    ("5", calm.regular, "as under 4.2.1"),
    ("5", calm.two_modes, "as under 4.2.1"),
    ("5", violent.threshold, violent.SWEEP),
    ("5", snapping.snapping, "as under 4.2.2"),
    ("5", violent.chaotic, "as under 4.2.2"),
)
NOT_JUDGED = (
    ("4.1", "synthetic lines stretch up to thirty times more than steel; broken lines damage and injure", "literature"),
    ("4.1.2", "the acoustic wave drag of a supersonic front is small", "no air in the model"),
    ("4.1.3", "lines whose strands fail in turn are less destructive", "an observation; rows on 4.1.3 test its reason"),
    ("4.2", "large motions come of the extensible rope", "only the paper's rope was run"),
    ("4.2.2", "it resembles piecewise linear oscillators and a bouncing ball", "an analogy: eq. (33), fig. 19b"),
    ("4.2.2", "the section is four-dimensional, so that its projection hides its structure", "not a result of runs"),
    ("5", "Euler parameters avoid singularities, bending stiffness an ill-posed problem", "tests of the engine"),
    ("5", "the fracture time is a principal parameter", "rows on 4.1.3 say what hangs on it and what does not"),
    ("5", "chaotic buoys leave strong signatures on the surface", "the companion paper; waves are given here"),
)
