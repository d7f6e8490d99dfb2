"""Section 4.2.2: the buoy in large waves, in their plane.

What depends on the water depth, which the paper does not give, is judged at every depth of the dependence study.
"""

from __future__ import annotations

import math

from ...parts.statements import Statement
from ...parts.wording import count, decimals, number, percent, ranges
from ..results import LARGE, Results
from .calm import DEPTHS
from .rows import NOT_IN_DOUBT, NOTHING, OPEN, at, by_regime, elsewhere, exponent, good, positive, settled, value
from .snapping import STATEMENTS as SNAPPING

ONE_LINE = 0.25  # share of the variance on one bin above which a spectrum has a dominant mode
CONTINUOUS = 0.05  # share of the variance that no line explains, above which a spectrum is continuous


def threshold(results: Results) -> Statement:
    rows = sorted(good(results.sweep), key=lambda row: row["steepness"])
    claim = "Beyond a threshold of the wave amplitude the line goes slack for part of the cycle and then snaps."
    if not rows:
        return Statement(claim, "No sweep shows it.", ())
    slack = [value(row, "slack_fraction") > 0.0 for row in rows]
    steepness = [row["steepness"] for row in rows]
    found = f"Slack at kA = {ranges(steepness, slack)} of {number(steepness[0])} to {number(steepness[-1])}."
    first = slack.index(True) if any(slack) else len(rows)
    checks = (
        ("there is a threshold", 0 < first < len(rows)),
        ("slack at all larger waves", any(slack) and all(slack[first:])),
    )
    return Statement(claim, found, checks, "taut below one steepness, slack from it on")


def chaos_beyond(results: Results) -> Statement:
    long = {row["steepness"]: row for row in good(results.buoy.values())}
    rows = {row["steepness"]: row for row in good(results.sweep)} | long
    values = sorted(rows)
    slack = [value(rows[kA], "slack_fraction") > 0.0 for kA in values]
    claim = "Wherever the line goes slack and snaps, the motion is chaotic."
    kinds = [rows[kA]["regime"] for kA in values]
    chaos = [loose and kind == "chaotic" for loose, kind in zip(slack, kinds, strict=True)]
    order = [loose and kind not in ("chaotic", *OPEN) for loose, kind in zip(slack, kinds, strict=True)]
    left = [loose and kind in OPEN for loose, kind in zip(slack, kinds, strict=True)]
    found = (
        f"With a slack line chaotic: kA = {ranges(values, chaos)}; periodic or quasi-periodic: kA = "
        f"{ranges(values, order)}; undecided or a transient: kA = {ranges(values, left)}."
    )
    checks = [(f"kA = {ranges(values, some)}", holds) for some, holds in ((chaos, True), (order, False)) if any(some)]
    return Statement(claim, found, tuple(checks), f"regime chaotic; {NOTHING}")


def positive_exponent(results: Results) -> Statement:
    rows = [row for row in good(results.over_depth(LARGE)) if exponent(row) != "none"]
    long = results.buoy.get(LARGE)
    short = [row for row in rows if settled(row) and (row["depth_m"] != results.depth() or long is None)]
    checks = [(at(row), positive(row)) for row in short]
    words = [f"{exponent(row)} at {at(row)}" for row in rows]
    others = [(where, row) for where, row in elsewhere(results, LARGE) if exponent(row) != "none"]
    words += [f"{exponent(row)} at {where}" for where, row in others]
    found = ""
    if long is not None and exponent(long) != "none":
        where = f"H = {number(results.depth())} m"
        checks = sorted([*checks, (where, positive(long))], key=lambda check: check[0])
        found = f"The long run at {where}: σ = {exponent(long)} bits per period. "
    return Statement(
        "In large waves the largest Lyapunov exponent is positive.",
        f"{found}Shorter runs: {', '.join(words) or 'none'}.",
        (*checks, *((where, positive(row)) for where, row in others if settled(row))),
        f"{number(NOT_IN_DOUBT)} standard errors above zero; where it is not, and the regime is open too, nothing",
    )


def chaotic(results: Results) -> Statement:
    rows, long = good(results.over_depth(LARGE)), results.buoy.get(LARGE)
    checks = [(at(row), row["regime"] == "chaotic") for row in rows if row["regime"] not in OPEN]
    others = elsewhere(results, LARGE)
    words = by_regime([(at(row), row) for row in rows] + others)
    found = ""
    if long is not None and long["regime"] not in OPEN:
        where = f"H = {number(results.depth())} m"
        checks = [check for check in checks if check[0] != where]
        checks = sorted([*checks, (where, long["regime"] == "chaotic")], key=lambda check: check[0])
        found = f"The long run at {where}: {long['regime']}"
        tighter = long.get("regime_tighter") or ""
        found += f" (at a tenth of the tolerance: {tighter}). " if tighter else ". "
    claim = "In large waves the motion of the buoy is chaotic."
    checks += [(where, row["regime"] == "chaotic") for where, row in others if row["regime"] not in OPEN]
    return Statement(claim, f"{found}Shorter runs: {words}.", tuple(checks), f"regime chaotic; {NOTHING}")


def never_repeats(results: Results) -> Statement:
    rows = good(results.over_depth(LARGE))
    checks = tuple((at(row), math.isnan(value(row, "strobed_period"))) for row in rows)
    words = ", ".join(f"{number(value(row, 'strobed_period'))} at {at(row)}" for row in rows)
    claim = "In large waves both motions are non-periodic and irregular."
    return Statement(claim, f"Wave periods after which it repeats: {words or 'none'}.", checks, "no period up to 16")


def continuous(results: Results) -> Statement:
    found, claim = results.violent, "In large waves the spectra are continuous over a wide range of frequencies."
    if found is None or math.isnan(found.unexplained):
        return Statement(claim, "No run shows it.", ())
    words = f"{percent(found.unexplained)} of the variance of the strobed r, r′ is on no spectral line."
    return Statement(claim, words, (("the long run", found.unexplained > CONTINUOUS),), f"above {percent(CONTINUOUS)}")


def no_dominant_mode(results: Results) -> Statement:
    claim = "In large waves the spectra show no dominant modes."
    rows = [(at(row), row) for row in good(results.over_depth(LARGE))] + elsewhere(results, LARGE)
    long = results.buoy.get(LARGE)
    rows = [(where, row) for where, row in rows if where != f"H = {number(results.depth())} m" or long is None]
    rows += [("the long run", long)] if long is not None else []
    lines = [(where, value(row, "radial_line"), value(row, "angular_line"), row) for where, row in rows]
    lines = [one for one in lines if math.isfinite(one[1])]
    if not lines:
        return Statement(claim, "No run shows it.", ())
    where, _, _, row = lines[-1]
    sides = [
        f"{name} {percent(value(row, f'{side}_line'))} at {number(value(row, f'{side}_at'), 3)} of the waves' frequency"
        for name, side in (("r", "radial"), ("θ", "angular"))
    ]
    least = min(lines, key=lambda one: min(one[1:3]))
    words = (
        f"Largest share of the variance on one bin of eq. (31), {where}: {', '.join(sides)}. The least of "
        f"{count(len(lines), 'run')} at other depths and with both buoyancies: {percent(min(least[1:3]))} ({least[0]})."
    )
    checks = tuple((where, max(r, theta) < ONE_LINE) for where, r, theta, _ in lines)
    return Statement(claim, words, checks, f"below {percent(ONE_LINE)} in r and θ")


def region(results: Results) -> Statement:
    found = results.violent
    claim = "The points of the section r, r′ fill a region, without a clear fractal structure."
    if found is None or math.isnan(found.dimension):
        return Statement(claim, "No run is long enough.", ())
    size = f"{decimals(found.dimension, 2)} ± {decimals(found.dimension_error, 2)}"
    words = f"Correlation dimension of the section: {size}."
    fills = found.dimension + NOT_IN_DOUBT * found.dimension_error > 2.0
    return Statement(claim, words, (("the long run", fills),), "dimension 2 within two errors")


SWEEP = "part `sweep`: one run a steepness"
STATEMENTS = (
    ("4.2", threshold, SWEEP),
    ("4.2", chaos_beyond, SWEEP),
    *SNAPPING,
    ("4.2.2, fig. 14", positive_exponent, f"tangent dynamics; finite separation agrees (docs/findings.md); {DEPTHS}"),
    ("4.2, 4.2.2", chaotic, f"0-1 test, two surrogates, halves, tighter tolerance; {DEPTHS}"),
    ("4.2.2, figs. 15, 16", never_repeats, f"strobed motion; {DEPTHS}"),
    ("4.2.2, figs. 17, 18", continuous, "lines fitted to the strobed record (CLEAN)"),
    ("4.2.2, figs. 17, 18", no_dominant_mode, f"spectra by eq. (31); {DEPTHS}, both buoyancies"),
    ("4.2.2, fig. 19a", region, "correlation dimension of the section of the long run"),
)
