"""Measures of section 4.2, and of section 3 the buoy on twice the points.

First the buoy at rest and in small waves (4.2.1), then in large waves (4.2.2): how the line snaps, whether the motion
is chaotic; then eq. (33) with figure 19b, and the motion across the plane of the waves with figure 20.
"""

import math

from campaigns.machinery.folder import Row
from campaigns.motions.along import from_rest
from campaigns.paper.measured import STRANGE, Results
from campaigns.paper.measures import EARLY, LARGE, SMALL, WINDOW
from campaigns.paper.statements import judging
from campaigns.paper.statements.judging import (
    LONG,
    NOT_IN_DOUBT,
    UNDECIDED,
    at,
    each,
    everywhere,
    exponent,
    passed,
    value_of,
)
from campaigns.statements import Measured, listed, shown, told

EARLIEST = f"the first {EARLY[1]} periods"
PRINTED_DIGIT = 0.05  # the paper's estimates are printed to one digit
RESONANT = 0.1  # relative distance of a ratio of natural frequencies from 1, 2 or 3
NEGLIGIBLE = 0.01  # share of the variance below which a coupling is negligible
BODIES = ("buoy", "rope")


def always_taut(results: Results) -> Measured:
    """Least top tension [N], of the whole long run and of the short ones after their transients."""
    short = [(place, value_of(row, "tension_top_min_N")) for place, row in everywhere(results, SMALL)]
    return each([(f"kA = {SMALL:g}, {LONG}", results.number("long_tension_min_N")), *short], ".4g")


def regular(results: Results) -> Measured:
    """The regime of the long run, and of the short ones."""
    rows, long = everywhere(results, SMALL), results.buoy.get(SMALL)
    first = [(LONG, long)] if long else []
    checks = judging.regimes([*first, *rows], lambda regime: regime.startswith("period-"))
    sentence = f"{LONG} {long['regime'] or 'no verdict'}, σ = {exponent(long)} bits per period; " if long else ""
    return Measured(checks, f"{sentence}shorter runs {judging.by_regime(rows)}" if long or rows else "")


def uncoupled(results: Results) -> Measured:
    """Ratio of the natural frequencies, and shares of the variance that lie at the frequency of the other motion."""
    ratio = results.number("estimate_radial_radps") / results.number("estimate_pendulum_radps")
    into_r, into_theta = results.number("radial_coupled"), results.number("angular_coupled")
    if not all(map(math.isfinite, (ratio, into_r, into_theta))):
        return Measured()
    off = min(abs(ratio / order - 1.0) for order in (1, 2, 3))
    words = f"frequency of r over that of θ {shown(ratio, '.2f')}; of the variance of r {shown(into_r, '.4%')} lies at "
    words += f"the pendulum's frequency and its double, of that of θ {shown(into_theta, '.2%')} at the radial one"
    checks = passed(
        ("resonance 1:1, 2:1, 3:1", off > RESONANT),
        ("coupling into r", into_r < NEGLIGIBLE),
        ("coupling into θ", into_theta < NEGLIGIBLE),
    )
    return Measured(checks, words)


def on_estimates(results: Results) -> Measured:
    """Frequencies seen early and in the window of fig. 12, against the estimates; its spectrum tells none closer than
    a bin apart."""
    wave = results.number("estimate_wave_radps")
    bin_radps, early = wave / WINDOW[1], results.number("early_angular_radps")
    checks, words = [], []
    for window, coarse in ((EARLIEST, 0.0), ("the window of fig. 12", 0.5 * bin_radps)):
        for name, side, estimate in (("r", "radial", "radial"), ("θ", "angular", "pendulum")):
            estimated = results.number(f"estimate_{estimate}_radps")
            late = estimated + results.number(f"{side}_bins") * bin_radps
            seen = late if coarse else results.number(f"early_{side}_radps")
            if not math.isfinite(seen):
                return Measured()
            checks.append((f"{name} in {window}", abs(seen / estimated - 1.0) < max(PRINTED_DIGIT, coarse / estimated)))
            words.append(f"{name} in {window} {shown(seen, '.3f')} ({shown(seen / estimated - 1.0, '.2%')} off)")
    sentence = f"bins of that window are {shown(bin_radps, '.3f')}; the wave's frequency less the pendulum's"
    return Measured(
        passed(*checks), f"{', '.join(words)}; {sentence}, {shown(wave - early, '.2f')}, lies beside the radial one"
    )


def exponent_to_zero(results: Results) -> Measured:
    """The exponent of the long run by two methods."""
    row = results.buoy.get(SMALL)
    wolf, error = value_of(row, "lyapunov_wolf_bits_per_period"), value_of(row, "lyapunov_wolf_error")
    if math.isnan(wolf):
        return Measured()
    words = f"Wolf's method on r(t) {shown(wolf, '.3f')} ± {shown(error, '.3f')}; tangent dynamics {exponent(row)}"
    tangent = not judging.positive(row)
    return Measured(passed(("Wolf's method", abs(wolf) <= NOT_IN_DOUBT * error), ("tangent dynamics", tangent)), words)


def doubled_buoy(results: Results) -> Measured:
    """Rms change of r over its range, on twice the elements, early and over all of the record."""
    checks = []
    for row in results.doubled:
        whens = {"error_early_m": "the first ten periods", "error_m": f"{row['periods']:g} periods"}
        span = row["radius_max_m"] - row["radius_min_m"]
        kA = f"kA = {row['waves.steepness']:g}"
        checks += [(f"{kA} over {when}", row[column] / span) for column, when in whens.items()]
    return each(checks, ".2%")


def good(rows) -> list[Row]:
    """The rows of runs that ended as asked, by steepness."""
    return sorted((row for row in rows if row["status"] == "ok"), key=lambda row: row["steepness"])


def by_motion(rows) -> list[Row]:
    """The good rows of a sweep, those of a motion together."""
    return sorted(good(rows), key=lambda row: row.get("motion") or "")


def threshold(results: Results) -> Measured:
    """From which wave steepness on the line goes slack, in every motion of the sweep."""
    rows = by_motion(results.sweep)
    if not rows:
        return Measured()
    first = min((row["steepness"] for row in rows if is_slack(row)), default=math.inf)
    taut_beyond = [row for row in rows if row["steepness"] >= first and not is_slack(row)]
    checks = passed(
        ("there is a threshold", good(rows)[0]["steepness"] < first < math.inf),
        ("slack at all larger waves", first < math.inf and not taut_beyond),
    )
    return Measured(checks, f"{spans([*map(is_slack, rows)], rows)} of {spans([True] * len(rows), rows)}")


def chaos_beyond(results: Results) -> Measured:
    """The regimes of all motions whose line goes slack; of those from rest the long runs where there are both."""
    long = {row["steepness"]: row for row in good(results.buoy.values())}
    swept = [row | (long.pop(row["steepness"], {}) if from_rest(row) else {}) for row in good(results.sweep)]
    rows = by_motion([*swept, *long.values()])
    kinds = {
        "chaotic": "chaotic".__eq__,
        "periodic or quasi-periodic": lambda regime: regime not in ("chaotic", *UNDECIDED),
        "undecided or a transient": lambda regime: regime in UNDECIDED,
    }
    words = {
        kind: spans([is_slack(row) and is_so(row["regime"]) for row in rows], rows) for kind, is_so in kinds.items()
    }
    checks = [(f"kA = {words[kind]}", kind == "chaotic") for kind in [*kinds][:2] if words[kind] != listed([])]
    return Measured(passed(*checks), "; ".join(f"{kind} {word}" for kind, word in words.items()) if rows else "")


def is_slack(row: Row) -> bool:
    """Whether the line goes slack at all."""
    return value_of(row, "slack_fraction") > 0.0


def spans(chosen: list[bool], rows: list[Row]) -> str:
    """The steepnesses of the chosen rows in words, neighbours of one motion joined into "a to b (motion)"."""
    groups: list[tuple[str, list[float]]] = []
    previous = None
    for wanted, row in zip(chosen, rows, strict=True):
        motion = row.get("motion") or ""
        if wanted:
            groups = groups if previous == motion else [*groups, (motion, [])]
            groups[-1][1].append(row["steepness"])
        previous = motion if wanted else None
    return listed(
        (f"{members[0]:.4g} to {members[-1]:.4g}" if len(members) > 1 else f"{members[0]:.4g}")
        + (f" ({motion})" if motion else "")
        for motion, members in groups
    )


def positive_exponent(results: Results) -> Measured:
    """The exponent of the long run, and of the short ones; at the shipped depth the long run decides."""
    long, depth = results.buoy.get(LARGE), f"H = {results.depth():g} m"
    short = [(place, row) for place, row in everywhere(results, LARGE) if exponent(row) != "none"]
    deciding = {place: row for place, row in short if judging.settled(row)}
    sentence = f"shorter runs from rest {', '.join(f'{exponent(row)} at {place}' for place, row in short) or 'none'}"
    if exponent(long) != "none":
        deciding[depth] = long
        sentence = f"{LONG} at {depth} {exponent(long)}; {sentence}"
    checks = passed(*((place, judging.positive(row)) for place, row in sorted(deciding.items())))
    return Measured(checks, sentence if short or long else "")


def chaotic(results: Results) -> Measured:
    """The regime of the long run, and of the short ones; at the shipped depth the long run decides."""
    long, depth = results.buoy.get(LARGE), f"H = {results.depth():g} m"
    short = everywhere(results, LARGE)
    sentence, deciding = f"shorter runs from rest {judging.by_regime(short)}", dict(short)
    if long is not None and long["regime"] not in UNDECIDED:
        deciding[depth] = long
        tighter = f" (at a tenth of the tolerance: {at_tighter})" if (at_tighter := long.get("regime_tighter")) else ""
        sentence = f"{LONG} at {depth} {long['regime']}{tighter}; {sentence}"
    return Measured(judging.regimes(sorted(deciding.items()), "chaotic".__eq__), sentence if short or long else "")


def never_repeats(results: Results) -> Measured:
    """The strobed period of the short runs; none where the motion does not repeat."""
    rows = [(at(row), value_of(row, "strobed_period")) for row in results.over_depth(LARGE)]
    return Measured(passed(*((place, math.isnan(period)) for place, period in rows)), told(rows, "g"))


def no_dominant_mode(results: Results) -> Measured:
    """Largest share of the variance on one bin of eq. (31), of r and theta."""
    rows, long = everywhere(results, LARGE), results.buoy.get(LARGE)
    if long is not None:
        rows = [(place, row) for place, row in rows if place != f"H = {results.depth():g} m"] + [(LONG, long)]
    lines = [(place, value_of(row, "radial_line"), value_of(row, "angular_line"), row) for place, row in rows]
    lines = [line for line in lines if math.isfinite(line[1])]
    if not lines:
        return Measured()
    place, r, theta, row = lines[-1]
    words = ", ".join(
        f"{name} {shown(share, '.1%')} at {shown(value_of(row, f'{side}_at'), '.3g')} of the waves' frequency"
        for name, side, share in (("r", "radial", r), ("θ", "angular", theta))
    )
    least, elsewhere = min((min(line[1:3]), line[0]) for line in lines)
    words += f" ({place}); least of {len(lines)} runs {shown(least, '.1%')} ({elsewhere})"
    return Measured([(place, max(r, theta)) for place, r, theta, _ in lines], words)


def strange(results: Results) -> Measured:
    """Largest exponent and Kaplan-Yorke dimension of the attractor of eq. (33)."""
    growth, growth_error, dimension, error = (results.number(name) for name in STRANGE)
    if not all(map(math.isfinite, (growth, growth_error, dimension, error))):
        return Measured()
    distance = min(abs(dimension - n) for n in (1, 2))
    checks = passed(
        ("exponent positive", growth > NOT_IN_DOUBT * growth_error),
        ("dimension not whole", distance > NOT_IN_DOUBT * error),
    )
    words = f"λ1 = {shown(growth, '.4f')} ± {shown(growth_error, '.4f')} bits a period; "
    return Measured(checks, f"{words}dimension {shown(dimension, '.3f')} ± {shown(error, '.3f')}")


def pushed(results: Results) -> list[Row]:
    """Runs of the large wave in three dimensions that were pushed out of the plane and ended as asked, by depth."""
    rows = sorted(_spatial(results, results.plane_large), key=lambda row: row["depth_m"])
    return [row for row in rows if row["seed_direction"] != "along" and not row["profiles"]]


def _spatial(results: Results, steepness: float) -> list[Row]:
    wanted = {"status": "ok", "steepness": steepness, "dimensions": 3}
    return [row for row in results.plane if wanted.items() <= row.items()]


def grows(row: Row) -> bool:
    """Whether the motion of buoy or rope across the plane grows exponentially."""
    return any(row[f"{body}_motion"] == "growth" for body in BODIES)


def planar(results: Results) -> Measured:
    """Largest lateral distance of any node of runs that were pushed along the waves."""
    rows = [row for row in results.plane if row["status"] == "ok" and row["seed_direction"] == "along"]
    largest = [row["rope_lateral_max_m"] for row in rows if math.isfinite(row["rope_lateral_max_m"])]
    return (
        Measured([("push along the waves", max(largest))], f"{shown(max(largest), '.3g')} m") if largest else Measured()
    )


def small_decays(results: Results) -> Measured:
    """How many runs of the small wave grow, of those in three dimensions that ended as asked."""
    small = min((row["steepness"] for row in results.plane), default=LARGE)
    rows = [] if small == results.plane_large else _spatial(results, small)
    growing, decaying = sum(map(grows, rows)), sum(row["buoy_motion"] == row["rope_motion"] == "decay" for row in rows)
    words = f"{growing} of {len(rows)} runs grow, {decaying} decay exponentially" if rows else ""
    return Measured([("all pushes, depths, stiffnesses, grids", growing)] if rows else [], words)


def large_grows(results: Results) -> Measured:
    """At which depths a run of the large wave grows."""
    rows = pushed(results)
    checks = {place: any(grows(row) for row in rows if at(row) == place) for place in map(at, rows)}
    bursts = sum(row["rope_motion"] == "bursts" for row in rows)
    words = f"{sum(map(grows, rows))} of {len(rows)} runs grow exponentially; in {bursts} the rope bursts"
    return Measured(passed(*checks.items()), words if rows else "")


def comparable(results: Results) -> Measured:
    """Largest lateral distance of buoy and rope over half the range of the buoy in the plane."""
    largest = {}
    for body in BODIES:
        known = [row for row in pushed(results) if math.isfinite(row[f"{body}_share_of_inplane"])]
        if not known:
            return Measured()
        largest[body] = max(known, key=lambda row: row[f"{body}_share_of_inplane"])
    words = ", ".join(
        f"{body} {shown(row[f'{body}_share_of_inplane'], '.3%')} ({shown(row[f'{body}_lateral_max_m'], '.2g')} m)"
        for body, row in largest.items()
    )
    return Measured([("buoy", largest["buoy"]["buoy_share_of_inplane"])], words)


def spatial(results: Results) -> Measured:
    """Largest lateral distance of the rope, m, at every depth."""
    rows = [row for row in pushed(results) if math.isfinite(row["rope_lateral_max_m"])]
    largest = {place: max(row["rope_lateral_max_m"] for row in rows if at(row) == place) for place in map(at, rows)}
    return each(largest.items(), ".2g")
