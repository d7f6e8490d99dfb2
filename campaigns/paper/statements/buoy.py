"""Measures of section 4.2, and of section 3 the buoy on twice the points.

First the buoy at rest and in small waves (4.2.1), then in large waves (4.2.2): how the line snaps, whether the motion
is chaotic; then eq. (33) with figure 19b, and the motion across the plane of the waves with figure 20.
"""

import math
from itertools import groupby

from campaigns.answers import greatest
from campaigns.explore.motions import from_rest
from campaigns.paper.measured import STRANGE, Results, matching
from campaigns.paper.measures import EARLY, WINDOW
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
)
from campaigns.statements import Measured, shown, told
from tables import BODIES, LARGE, SMALL, WOLF_ERROR, WOLF_EXPONENT, Row, listed, number_of

EARLIEST = f"the first {EARLY[1]} periods"
PRINTED_DIGIT = 0.05  # the paper's estimates are printed to one digit
RESONANT = 0.1  # relative distance of a ratio of natural frequencies from 1, 2 or 3
NEGLIGIBLE = 0.01  # share of the variance below which a coupling is negligible


def always_taut(results: Results) -> Measured:
    """Least top tension [N], of the whole long run and of the short ones after their transients."""
    short = [(place, number_of(row, "tension_top_min_N")) for place, row in everywhere(results, SMALL)]
    return each([(f"kA = {SMALL:g}, {LONG}", results.number("long_tension_min_N")), *short], ".4g")


def regular(results: Results) -> Measured:
    """The regime of the long run, and of the short ones."""
    rows, long = everywhere(results, SMALL), results.buoy.get(SMALL)
    if not long and not rows:
        return Measured()
    words, places = f"shorter runs {judging.by_regime(rows)}", rows
    if long:
        places = [(LONG, long), *rows]
        words = f"{LONG} {long['regime'] or 'no verdict'}, σ = {exponent(long)} bits per period; {words}"
    return Measured(judging.regimes(places, lambda regime: regime.startswith("period-")), words)


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
            seen = results.number(f"early_{side}_radps")
            if coarse:
                seen = estimated + results.number(f"{side}_bins") * bin_radps
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
    row = results.buoy.get(SMALL, {})
    wolf, error = number_of(row, WOLF_EXPONENT), number_of(row, WOLF_ERROR)
    if math.isnan(wolf):
        return Measured()
    words = f"Wolf's method on r(t) {shown(wolf, '.3f')} ± {shown(error, '.3f')}; tangent dynamics {exponent(row)}"
    tangent = not judging.positive(row)
    return Measured(passed(("Wolf's method", abs(wolf) <= NOT_IN_DOUBT * error), ("tangent dynamics", tangent)), words)


def doubled_buoy(results: Results) -> Measured:
    """Rms change of r over its range, on twice the elements, early and over all of the record."""
    checks = []
    for row in results.doubled:
        span = row["radius_max_m"] - row["radius_min_m"]
        kA = f"kA = {row['waves.steepness']:g}"
        checks.append((f"{kA} over the first ten periods", row["error_early_m"] / span))
        checks.append((f"{kA} over {row['periods']:g} periods", row["error_m"] / span))
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
    slack = [row["steepness"] for row in rows if is_slack(row)]
    taut = [row["steepness"] for row in rows if not is_slack(row)]
    first = min(slack, default=math.inf)
    checks = passed(
        ("there is a threshold", good(rows)[0]["steepness"] < first < math.inf),
        ("slack at all larger waves", first < math.inf and max(taut, default=0.0) < first),
    )
    return Measured(checks, f"{spans([*map(is_slack, rows)], rows)} of {spans([True] * len(rows), rows)}")


def chaos_beyond(results: Results) -> Measured:
    """The regimes of all motions whose line goes slack; of those from rest the long runs where there are both."""
    long = {row["steepness"]: row for row in good(results.buoy.values())}
    swept = []
    for row in good(results.sweep):
        if from_rest(row):
            row = row | long.pop(row["steepness"], {})
        swept.append(row)
    rows = by_motion([*swept, *long.values()])
    if not rows:
        return Measured()
    kinds = {
        "chaotic": "chaotic".__eq__,
        "periodic or quasi-periodic": lambda regime: regime not in ("chaotic", *UNDECIDED),
        "undecided or a transient": lambda regime: regime in UNDECIDED,
    }
    words, checks = [], []
    for kind, is_so in kinds.items():
        steepnesses = spans([is_slack(row) and is_so(row["regime"]) for row in rows], rows)
        words.append(f"{kind} {steepnesses}")
        decides = kind != "undecided or a transient"
        if decides and steepnesses != listed([]):
            checks.append((f"kA = {steepnesses}", kind == "chaotic"))
    return Measured(passed(*checks), "; ".join(words))


def is_slack(row: Row) -> bool:
    """Whether the line goes slack at all."""
    return number_of(row, "slack_fraction") > 0.0


def spans(chosen: list[bool], rows: list[Row]) -> str:
    """The steepnesses of the chosen rows in words, neighbours of one motion joined into "a to b (motion)"."""
    runs = groupby(zip(chosen, rows, strict=True), key=lambda pair: (pair[0], pair[1].get("motion") or ""))
    words = []
    for (wanted, motion), members in runs:
        if wanted:
            words.append(_span(motion, [row["steepness"] for _, row in members]))
    return listed(words)


def _span(motion: str, steepnesses: list[float]) -> str:
    """ "0.016", "0.016 to 0.13 (B)"."""
    words = f"{steepnesses[0]:.4g}"
    if len(steepnesses) > 1:
        words += f" to {steepnesses[-1]:.4g}"
    if motion:
        words += f" ({motion})"
    return words


def positive_exponent(results: Results) -> Measured:
    """The exponent of the long run, and of the short ones; at the shipped depth the long run decides."""
    long, depth = results.buoy.get(LARGE), f"H = {results.depth():g} m"
    deciding, exponents = {}, []
    for place, row in everywhere(results, LARGE):
        if exponent(row) == "none":
            continue
        exponents.append(f"{exponent(row)} at {place}")
        if judging.settled(row):
            deciding[place] = row
    if not exponents and not long:
        return Measured()
    sentence = f"shorter runs from rest {', '.join(exponents) or 'none'}"
    if exponent(long) != "none":
        deciding[depth] = long
        sentence = f"{LONG} at {depth} {exponent(long)}; {sentence}"
    checks = [(place, judging.positive(deciding[place])) for place in sorted(deciding)]
    return Measured(passed(*checks), sentence)


def chaotic(results: Results) -> Measured:
    """The regime of the long run, and of the short ones; at the shipped depth the long run decides."""
    long, depth = results.buoy.get(LARGE), f"H = {results.depth():g} m"
    short = everywhere(results, LARGE)
    if not short and not long:
        return Measured()
    sentence, deciding = f"shorter runs from rest {judging.by_regime(short)}", dict(short)
    if long is not None and long["regime"] not in UNDECIDED:
        deciding[depth] = long
        regime, tighter = long["regime"], long.get("regime_tighter")
        if tighter:
            regime += f" (at a tenth of the tolerance: {tighter})"
        sentence = f"{LONG} at {depth} {regime}; {sentence}"
    return Measured(judging.regimes(sorted(deciding.items()), "chaotic".__eq__), sentence)


def never_repeats(results: Results) -> Measured:
    """The strobed period of the short runs; none where the motion does not repeat."""
    periods, checks = [], []
    for row in results.over_depth(LARGE):
        period = number_of(row, "strobed_period")
        periods.append((at(row), period))
        checks.append((at(row), math.isnan(period)))
    return Measured(passed(*checks), told(periods, "g"))


def no_dominant_mode(results: Results) -> Measured:
    """Largest share of the variance on one bin of eq. (31), of r and theta."""
    rows, long = dict(everywhere(results, LARGE)), results.buoy.get(LARGE)
    if long is not None:
        rows.pop(f"H = {results.depth():g} m", None)
        rows[LONG] = long
    checks, least, least_place = [], math.inf, ""
    for place, row in rows.items():
        r, theta = number_of(row, "radial_line"), number_of(row, "angular_line")
        if not math.isfinite(r):
            continue
        checks.append((place, max(r, theta)))
        if (min(r, theta), place) < (least, least_place):
            least, least_place = min(r, theta), place
    if not checks:
        return Measured()
    place, _ = checks[-1]
    words = f"{_line_in_words('r', 'radial', rows[place])}, {_line_in_words('θ', 'angular', rows[place])} ({place}); "
    words += f"least of {len(checks)} runs {shown(least, '.1%')} ({least_place})"
    return Measured(checks, words)


def _line_in_words(name: str, side: str, row: Row) -> str:
    """The largest share of the variance of r or theta on one bin, and where the bin is."""
    share, frequency = number_of(row, f"{side}_line"), number_of(row, f"{side}_at")
    return f"{name} {shown(share, '.1%')} at {shown(frequency, '.3g')} of the waves' frequency"


def strange(results: Results) -> Measured:
    """Largest exponent and Kaplan-Yorke dimension of the attractor of eq. (33)."""
    numbers = [results.number(name) for name in STRANGE]
    if not all(map(math.isfinite, numbers)):
        return Measured()
    growth, growth_error, dimension, error = numbers
    distance = min(abs(dimension - 1), abs(dimension - 2))
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
    return matching(results.plane, {"status": "ok", "steepness": steepness, "dimensions": 3})


def grows(row: Row) -> bool:
    """Whether the motion of buoy or rope across the plane grows exponentially."""
    return "growth" in (row["buoy_motion"], row["rope_motion"])


def planar(results: Results) -> Measured:
    """Largest lateral distance of any node of runs that were pushed along the waves."""
    farthest = greatest(matching(results.plane, {"status": "ok", "seed_direction": "along"}), "rope_lateral_max_m")
    if farthest is None:
        return Measured()
    distance_m = farthest["rope_lateral_max_m"]
    return Measured([("push along the waves", distance_m)], f"{shown(distance_m, '.3g')} m")


def small_decays(results: Results) -> Measured:
    """How many runs of the small wave grow, of those in three dimensions that ended as asked."""
    small = min((row["steepness"] for row in results.plane), default=LARGE)
    rows = _spatial(results, small)
    if small == results.plane_large or not rows:
        return Measured([])
    growing = sum(map(grows, rows))
    decaying = matching(rows, {"buoy_motion": "decay", "rope_motion": "decay"})
    words = f"{growing} of {len(rows)} runs grow, {len(decaying)} decay exponentially"
    return Measured([("all pushes, depths, stiffnesses, grids", growing)], words)


def large_grows(results: Results) -> Measured:
    """At which depths a run of the large wave grows."""
    rows = pushed(results)
    if not rows:
        return Measured([])
    checks = {}
    for row in rows:
        checks[at(row)] = checks.get(at(row), False) or grows(row)
    bursting = matching(rows, {"rope_motion": "bursts"})
    words = f"{sum(map(grows, rows))} of {len(rows)} runs grow exponentially; in {len(bursting)} the rope bursts"
    return Measured(passed(*checks.items()), words)


def comparable(results: Results) -> Measured:
    """Largest lateral distance of buoy and rope over half the range of the buoy in the plane."""
    checks, words = [], []
    for body in BODIES:
        column = f"{body}_share_of_inplane"
        largest = greatest(pushed(results), column)
        if largest is None:
            return Measured()
        distance_m = shown(largest[f"{body}_lateral_max_m"], ".2g")
        words.append(f"{body} {shown(largest[column], '.3%')} ({distance_m} m)")
        if body == "buoy":
            checks.append((body, largest[column]))
    return Measured(checks, ", ".join(words))


def spatial(results: Results) -> Measured:
    """Largest lateral distance of the rope, m, at every depth."""
    largest = {}
    for row in pushed(results):
        distance_m = row["rope_lateral_max_m"]
        if math.isfinite(distance_m):
            largest[at(row)] = max(distance_m, largest.get(at(row), distance_m))
    return each(largest.items(), ".2g")
