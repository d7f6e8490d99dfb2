"""Section 4.2.1: the buoy in small waves, in their plane."""

from __future__ import annotations

import math

from ...parts.statements import Statement
from ...parts.wording import decimals, number, percent
from ..measures import EARLY, SETTLED, WINDOW
from ..results import SMALL, Results
from .rows import NOT_IN_DOUBT, NOTHING, OPEN, at, by_regime, elsewhere, exponent, good, positive, value

PRINTED_EXTENSION, PRINTED_RADIAL, PRINTED_PENDULUM = 0.04, 1.0, 0.2  # l0, rad/s, rad/s
PRINTED_DIGIT = 0.05  # they are printed to one digit
PRINTED_AMPLITUDE_M, PRINTED_WAVE = 0.1, 1.26  # m, rad/s
MORISON = 0.2  # diameter over wave length up to which Morison's equation is used
AROUND = 0.1  # of half the range, within which a motion is about a place
ALIKE = 0.9  # correlation from which two histories show the same trends
DOMINANT = 0.9  # share of the variance at a few frequencies above which they dominate
NEGLIGIBLE = 0.01  # share of the variance below which a coupling is negligible
DECAYED = 0.5  # what is left after 40 periods, below which a transient decays
RESONANT = 0.1  # relative distance of a ratio of natural frequencies from 1, 2 or 3
REGULAR = "period-"


def rest(results: Results) -> Statement:
    claim = "At rest the buoyancy stretches the line by about 0.04 of its length."
    if results.calm is None:
        return Statement(claim, "No run shows it.", ())
    share = results.calm.rest_m / results.rest_length_m - 1.0
    check = ("rest", abs(share / PRINTED_EXTENSION - 1.0) < PRINTED_DIGIT)
    return Statement(claim, f"{number(share, 5)} of it.", (check,), f"0.04 to {percent(PRINTED_DIGIT)}")


def estimates(results: Results) -> Statement:
    modes, claim = results.modes, "The natural frequencies are about 1.0 rad/s along r and 0.2 rad/s along θ."
    if modes is None:
        return Statement(claim, "No run shows it.", ())
    found = f"{decimals(modes.radial_radps, 4)} and {decimals(modes.pendulum_radps, 4)} rad/s by the paper's formulas."
    near = (abs(modes.radial_radps / PRINTED_RADIAL - 1.0), abs(modes.pendulum_radps / PRINTED_PENDULUM - 1.0))
    checks = tuple((name, off < PRINTED_DIGIT) for name, off in zip(("r", "θ"), near, strict=True))
    return Statement(claim, found, checks, f"to {percent(PRINTED_DIGIT)}")


def waves(results: Results) -> Statement:
    claim = "Waves of 0.1 m amplitude and 5 s period have the slope 0.016 and the frequency 1.26 rad/s."
    if results.scales is None or results.modes is None:
        return Statement(claim, "No run shows it.", ())
    amplitude, omega = results.scales.small_amplitude_m, results.modes.wave_radps
    found = f"Of that slope: {decimals(amplitude, 4)} m at the depth of the scene, {decimals(omega, 4)} rad/s."
    near = amplitude / PRINTED_AMPLITUDE_M, omega / PRINTED_WAVE
    checks = tuple((name, abs(x - 1.0) < PRINTED_DIGIT) for name, x in zip(("A", "ω"), near, strict=True))
    return Statement(claim, found, checks, f"to {percent(PRINTED_DIGIT)}")


def long_waves(results: Results) -> Statement:
    claim = "The waves are long compared to the buoy, so that Morison's equation gives the loads."
    if results.scales is None:
        return Statement(claim, "No run shows it.", ())
    share = results.scales.diameter_m / results.scales.wave_length_m
    found = f"Diameter over wave length: {decimals(share, 3)}. Waves that the buoy radiates are left out."
    return Statement(claim, found, (("the buoy", share < MORISON),), f"below {number(MORISON)}")


def about_rest(results: Results) -> Statement:
    calm, claim = results.calm, "In small waves the buoy oscillates about its position at rest."
    if calm is None:
        return Statement(claim, "No run shows it.", ())
    means = ("r", calm.radial_mean), ("θ", calm.angular_mean)
    told = " and ".join(f"{name} {percent(mean)}" for name, mean in means)
    found = f"Mean of the last {SETTLED} periods off it, over half the range: {told}."
    return Statement(claim, found, tuple((n, abs(x) < AROUND) for n, x in means), f"within {percent(AROUND)}")


def same_trends(results: Results) -> Statement:
    calm, claim = results.calm, "In small waves the motion along r shows the trends of the tension."
    if calm is None:
        return Statement(claim, "No run shows it.", ())
    found = f"Correlation of the two over {number(sum(WINDOW))} periods: {decimals(calm.tension_alike, 5)}."
    return Statement(claim, found, (("the long run", calm.tension_alike > ALIKE),), f"above {number(ALIKE)}")


def always_taut(results: Results) -> Statement:
    rows = [(at(row), row) for row in good(results.over_depth(SMALL))] + elsewhere(results, SMALL)
    claim = "In small waves the line stays in tension at all times."
    least = results.calm.tension_min_N if results.calm else math.nan
    checks = [(f"kA = {number(SMALL)}, the long run", least > 0.0)] if math.isfinite(least) else []
    checks += [(where, value(row, "tension_top_min_N") > 0.0) for where, row in rows]
    words = ", ".join(f"{number(value(row, 'tension_top_min_N'), 4)} at {where}" for where, row in rows)
    found = f"Least top tension, N: {number(least, 4)} over the whole long run; after the transient {words or 'none'}."
    return Statement(claim, found, tuple(checks), "least tension above zero")


def small_excursion(results: Results) -> Statement:
    claim = "In small waves the motion along r is smaller than the static stretch."
    if results.calm is None:
        return Statement(claim, "No run shows it.", ())
    static = results.calm.rest_m - results.rest_length_m
    found = f"At most {decimals(results.calm.excursion_m, 3)} m, of {decimals(static, 3)} m."
    return Statement(claim, found, (("the long run", results.calm.excursion_m < static),), "smaller than it")


def regular(results: Results) -> Statement:
    rows = [(at(row), row) for row in good(results.over_depth(SMALL))] + elsewhere(results, SMALL)
    words = by_regime(rows)
    long = results.buoy.get(SMALL)
    found = f"The long run: {long['regime'] or 'no verdict'}, σ = {exponent(long)} bits per period. " if long else ""
    checks = [("the long run", long["regime"].startswith(REGULAR))] if long and long["regime"] not in OPEN else []
    checks += [(where, row["regime"].startswith(REGULAR)) for where, row in rows if row["regime"] not in OPEN]
    claim = "In small waves the motion of the buoy is periodic and regular."
    return Statement(claim, f"{found}Shorter runs: {words}.", tuple(checks), f"regime period-N; {NOTHING}")


def decays(results: Results) -> Statement:
    calm, claim = results.calm, "The transient along r decays slowly, by the viscous drag."
    if calm is None:
        return Statement(claim, "No run shows it.", ())
    found = f"{percent(calm.radial_kept)} of its amplitude is left after 40 wave periods."
    checks = (("the long run", 0.0 < calm.radial_kept < DECAYED),)
    return Statement(claim, found, checks, f"less than {percent(DECAYED)} left, and not none")


def slower(results: Results) -> Statement:
    calm, claim = results.calm, "The transient along θ vanishes more slowly than that along r."
    if calm is None:
        return Statement(claim, "No run shows it.", ())
    found = f"Left after 40 wave periods: θ {percent(calm.angular_kept)}, r {percent(calm.radial_kept)}."
    return Statement(claim, found, (("the long run", calm.angular_kept > calm.radial_kept),), "more is left")


def uncoupled(results: Results) -> Statement:
    calm, modes = results.calm, results.modes
    claim = "There are no internal resonances, and the coupling of r and θ is nearly negligible."
    if calm is None or modes is None:
        return Statement(claim, "No run shows it.", ())
    ratio = modes.radial_radps / modes.pendulum_radps
    off = min(abs(ratio / order - 1.0) for order in (1, 2, 3))
    found = (
        f"ω of r over ω of θ: {decimals(ratio, 2)}; of the variance of r, {percent(calm.radial_coupled)} lies at the "
        f"pendulum's frequency and its double, of that of θ {percent(calm.angular_coupled)} at the radial one."
    )
    checks = (
        ("resonance 1:1, 2:1, 3:1", off > RESONANT),
        ("coupling into r", calm.radial_coupled < NEGLIGIBLE),
        ("coupling into θ", calm.angular_coupled < NEGLIGIBLE),
    )
    return Statement(claim, found, checks, f"ratio {percent(RESONANT)} off 1, 2, 3; shares below {percent(NEGLIGIBLE)}")


def two_modes(results: Results) -> Statement:
    calm, claim = results.calm, "In small waves natural and forced oscillation dominate the spectra of both motions."
    if calm is None:
        return Statement(claim, "No run shows it.", ())
    found = f"Their share of the variance, eq. (31): r {percent(calm.radial_share)}, θ {percent(calm.angular_share)}."
    checks = (("r", calm.radial_share > DOMINANT), ("θ", calm.angular_share > DOMINANT))
    return Statement(claim, found, checks, f"more than {percent(DOMINANT)}")


def on_estimates(results: Results) -> Statement:
    calm, modes = results.calm, results.modes
    claim = "The natural frequencies seen in the spectra agree well with the estimates."
    if calm is None or modes is None:
        return Statement(claim, "No run shows it.", ())
    estimates, early = (modes.radial_radps, modes.pendulum_radps), (calm.radial_radps, calm.angular_radps)
    bin_radps = modes.wave_radps / WINDOW[1]
    late = [own + bins * bin_radps for own, bins in zip(estimates, (calm.radial_bins, calm.angular_bins), strict=True)]
    checks, words = [], []
    for when, seen, coarse in (
        (f"the first {EARLY[1]} periods", early, 0.0),
        ("the window of fig. 12", late, 0.5 * bin_radps),  # its spectrum tells no frequencies closer than a bin
    ):
        off = [frequency / own - 1.0 for frequency, own in zip(seen, estimates, strict=True)]
        allowed = [max(PRINTED_DIGIT, coarse / own) for own in estimates]
        checks += [(f"{name} in {when}", abs(x) < most) for name, x, most in zip(("r", "θ"), off, allowed, strict=True)]
        words.append(
            f"In {when} r has {decimals(seen[0], 3)} rad/s ({percent(off[0])} off), θ {decimals(seen[1], 3)} rad/s "
            f"({percent(off[1])})."
        )
    words.append(
        f"Bins of that window are {decimals(bin_radps, 3)} rad/s; the wave's frequency less the pendulum's, "
        f"{decimals(modes.wave_radps - calm.angular_radps, 2)} rad/s, lies beside the radial one."
    )
    threshold = f"within {percent(PRINTED_DIGIT)}, or half a bin of fig. 12"
    return Statement(claim, " ".join(words), tuple(checks), threshold)


def exponent_to_zero(results: Results) -> Statement:
    row = results.buoy.get(SMALL)
    claim = "In small waves the exponent tends to zero with time, as of a regular motion."
    wolf, error = value(row, "lyapunov_wolf_bits_per_period"), value(row, "lyapunov_wolf_error")
    if math.isnan(wolf):
        return Statement(claim, "No run shows it.", ())
    found = (
        f"Wolf's method on r(t): {decimals(wolf, 3)} ± {decimals(error, 3)} bits per period; by the tangent dynamics "
        f"{exponent(row)}"
    )
    below = value(row, "lyapunov_tangent_bits_per_period") + NOT_IN_DOUBT * value(row, "lyapunov_tangent_error") < 0.0
    found += ", below zero as of an attracting periodic motion." if below else "."
    checks = (("Wolf's method", abs(wolf) <= NOT_IN_DOUBT * error), ("tangent dynamics", not positive(row)))
    return Statement(claim, found, checks, "Wolf: zero within two errors; tangent: not above zero")


DEPTHS = "section on what the paper leaves out: depths"
AGAIN = "the same runs tighter and finer (report on the buoy, error against run time)"
CODES = "two published codes and an ODE agree to 1.4 mm at kA = 0.016 (docs/findings.md)"
STATEMENTS = (
    ("4.2", long_waves, "closed form: dispersion relation"),
    ("4.2", rest, "closed form: (ρ V − M) g = f(ε)"),
    ("4.2, 4.2.1", waves, "closed form: dispersion relation"),
    ("4.2.1", about_rest, CODES),
    ("4.2.1", estimates, "closed form"),
    ("4.2, 4.2.1, fig. 9", always_taut, f"{AGAIN}; {CODES}"),
    ("4.2.1, fig. 10", small_excursion, CODES),
    ("4.2, 4.2.1", regular, f"tangent dynamics and Wolf's method; {DEPTHS}"),
    ("4.2.1, fig. 9", decays, f"quadratic drag, eq. (30); {CODES}"),
    ("4.2.1, figs. 9, 10", same_trends, CODES),
    ("4.2.1, figs. 10, 11", slower, CODES),
    ("4.2.1", uncoupled, "spectra by eq. (31)"),
    ("4.2.1, fig. 12", two_modes, "spectra by eq. (31)"),
    ("4.2.1, fig. 12", on_estimates, "closed form; shooting and engine agree to 1e-7 (docs/findings.md)"),
    ("4.2.2, fig. 14", exponent_to_zero, "two methods: time series and tangent dynamics"),
)
