"""Measures of section 4.2.1, the buoy at rest and in small waves, and of section 3, the buoy on twice the points."""

import math

from campaigns.paper.measured import Results
from campaigns.paper.measures import EARLY, SMALL, WINDOW
from campaigns.paper.statements import judging
from campaigns.paper.statements.judging import LONG, NOT_IN_DOUBT, each, everywhere, exponent, passed, value_of
from campaigns.statements import Measured, shown

EARLIEST = f"the first {EARLY[1]} periods"
FINER = "twice the elements"
PRINTED_DIGIT = 0.05  # the paper's estimates are printed to one digit
RESONANT = 0.1  # relative distance of a ratio of natural frequencies from 1, 2 or 3
NEGLIGIBLE = 0.01  # share of the variance below which a coupling is negligible


def always_taut(results: Results) -> Measured:
    """Least top tension [N], of the whole long run and of the short ones after their transients."""
    short = [(where, value_of(row, "tension_top_min_N")) for where, row in everywhere(results, SMALL)]
    return each([(f"kA = {SMALL:g}, {LONG}", results.number("long_tension_min_N")), *short], ".4g")


def regular(results: Results) -> Measured:
    """The regime of the long run, and of the short ones."""
    rows, long = everywhere(results, SMALL), results.buoy.get(SMALL)
    first = [(LONG, long)] if long else []
    checks = judging.regimes([*first, *rows], lambda regime: regime.startswith("period-"))
    found = f"{LONG} {long['regime'] or 'no verdict'}, σ = {exponent(long)} bits per period; " if long else ""
    return Measured(checks, f"{found}shorter runs {judging.by_regime(rows)}" if long or rows else "")


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
    for when, coarse in ((EARLIEST, 0.0), ("the window of fig. 12", 0.5 * bin_radps)):
        for name, side, estimate in (("r", "radial", "radial"), ("θ", "angular", "pendulum")):
            own = results.number(f"estimate_{estimate}_radps")
            late = own + results.number(f"{side}_bins") * bin_radps
            seen = late if coarse else results.number(f"early_{side}_radps")
            if not math.isfinite(seen):
                return Measured()
            checks.append((f"{name} in {when}", abs(seen / own - 1.0) < max(PRINTED_DIGIT, coarse / own)))
            words.append(f"{name} in {when} {shown(seen, '.3f')} ({shown(seen / own - 1.0, '.2%')} off)")
    said = f"bins of that window are {shown(bin_radps, '.3f')}; the wave's frequency less the pendulum's"
    return Measured(
        passed(*checks), f"{', '.join(words)}; {said}, {shown(wave - early, '.2f')}, lies beside the radial one"
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
    """Rms change of r over its range, of every repeated run on twice the elements, early and over all of it."""
    checks = []
    for again in results.accuracy:
        row = results.buoy.get(float(again["label"])) if again["run"] == FINER and again["status"] == "ok" else None
        if row is not None:
            columns = {"error_early_m": "the first ten periods", "error_m": f"{again['periods']:g} periods"}
            span = row["radius_max_m"] - row["radius_min_m"]
            kA = f"kA = {row['steepness']:g}"
            checks += [(f"{kA} over {when}", again[column] / span) for column, when in columns.items()]
    return each(checks, ".2%")
