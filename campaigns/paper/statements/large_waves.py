"""Measures of section 4.2.2, the buoy in large waves: how the line snaps, whether the motion is chaotic."""

import math

from campaigns.machinery.folder import Row
from campaigns.paper.measured import Results
from campaigns.paper.measures import LARGE
from campaigns.paper.statements import judging
from campaigns.paper.statements.judging import LONG, UNDECIDED, at, everywhere, exponent, passed, value_of
from campaigns.statements import Measured, listed, shown, told

NO_RUN = "none"  # as `listed` says it


def good(rows) -> list[Row]:
    """The rows of runs that ended as asked, by steepness."""
    return sorted((row for row in rows if row["status"] == "ok"), key=lambda row: row["steepness"])


def threshold(results: Results) -> Measured:
    """From which wave steepness on the line goes slack."""
    rows = good(results.sweep)
    slack = [is_slack(row) for row in rows]
    if not rows:
        return Measured()
    first = slack.index(True) if any(slack) else len(rows)
    checks = passed(
        ("there is a threshold", 0 < first < len(rows)),
        ("slack at all larger waves", any(slack) and all(slack[first:])),
    )
    return Measured(checks, f"{spans(slack, rows)} of {spans([True] * len(rows), rows)}")


def chaos_beyond(results: Results) -> Measured:
    """The regimes of all runs whose line goes slack; the long ones where there are both."""
    rows = good({row["steepness"]: row for row in (*good(results.sweep), *good(results.buoy.values()))}.values())
    kinds = {
        "chaotic": "chaotic".__eq__,
        "periodic or quasi-periodic": lambda regime: regime not in ("chaotic", *UNDECIDED),
        "undecided or a transient": lambda regime: regime in UNDECIDED,
    }
    words = {
        kind: spans([is_slack(row) and is_so(row["regime"]) for row in rows], rows) for kind, is_so in kinds.items()
    }
    checks = [(f"kA = {words[kind]}", kind == "chaotic") for kind in [*kinds][:2] if words[kind] != NO_RUN]
    return Measured(passed(*checks), "; ".join(f"{kind} {word}" for kind, word in words.items()) if rows else "")


def is_slack(row: Row) -> bool:
    """Whether the line goes slack at all."""
    return value_of(row, "slack_fraction") > 0.0


def spans(chosen: list[bool], rows: list[Row]) -> str:
    """The steepnesses of the chosen rows in words, neighbours joined into "a to b"."""
    groups: list[list[float]] = []
    for before, wanted, row in zip([False, *chosen], chosen, rows, strict=False):
        if wanted:
            groups = groups if before else [*groups, []]
            groups[-1].append(row["steepness"])
    return listed(f"{one[0]:.4g} to {one[-1]:.4g}" if len(one) > 1 else f"{one[0]:.4g}" for one in groups)


def positive_exponent(results: Results) -> Measured:
    """The exponent of the long run, and of the short ones; at the shipped depth the long run decides."""
    long, depth = results.buoy.get(LARGE), f"H = {results.depth():g} m"
    short = [(where, row) for where, row in everywhere(results, LARGE) if exponent(row) != "none"]
    deciding = {where: row for where, row in short if judging.settled(row)}
    found = f"shorter runs {', '.join(f'{exponent(row)} at {where}' for where, row in short) or 'none'}"
    if exponent(long) != "none":
        deciding[depth] = long
        found = f"{LONG} at {depth} {exponent(long)}; {found}"
    checks = passed(*((where, judging.positive(row)) for where, row in sorted(deciding.items())))
    return Measured(checks, found if short or long else "")


def chaotic(results: Results) -> Measured:
    """The regime of the long run, and of the short ones; at the shipped depth the long run decides."""
    long, depth = results.buoy.get(LARGE), f"H = {results.depth():g} m"
    short = everywhere(results, LARGE)
    found, deciding = f"shorter runs {judging.by_regime(short)}", dict(short)
    if long is not None and long["regime"] not in UNDECIDED:
        deciding[depth] = long
        tighter = f" (at a tenth of the tolerance: {again})" if (again := long.get("regime_tighter")) else ""
        found = f"{LONG} at {depth} {long['regime']}{tighter}; {found}"
    return Measured(judging.regimes(sorted(deciding.items()), "chaotic".__eq__), found if short or long else "")


def never_repeats(results: Results) -> Measured:
    """The strobed period of the short runs; none where the motion does not repeat."""
    rows = [(at(row), value_of(row, "strobed_period")) for row in results.over_depth(LARGE)]
    return Measured(passed(*((where, math.isnan(period)) for where, period in rows)), told(rows, "g"))


def no_dominant_mode(results: Results) -> Measured:
    """Largest share of the variance on one bin of eq. (31), of r and theta."""
    rows, long = everywhere(results, LARGE), results.buoy.get(LARGE)
    if long is not None:
        rows = [(where, row) for where, row in rows if where != f"H = {results.depth():g} m"] + [(LONG, long)]
    lines = [(where, value_of(row, "radial_line"), value_of(row, "angular_line"), row) for where, row in rows]
    lines = [one for one in lines if math.isfinite(one[1])]
    if not lines:
        return Measured()
    where, r, theta, row = lines[-1]
    words = ", ".join(
        f"{name} {shown(share, '.1%')} at {shown(value_of(row, f'{side}_at'), '.3g')} of the waves' frequency"
        for name, side, share in (("r", "radial", r), ("θ", "angular", theta))
    )
    least, other = min((min(one[1:3]), one[0]) for one in lines)
    words += f" ({where}); least of {len(lines)} runs {shown(least, '.1%')} ({other})"
    return Measured([(where, max(r, theta)) for where, r, theta, _ in lines], words)
