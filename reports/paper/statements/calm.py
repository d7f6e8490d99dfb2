"""Section 4.2.1: the buoy in small waves, in their plane."""

from __future__ import annotations

import math

from ...parts.statements import Statement
from ...parts.wording import decimals, number, percent
from ..results import SMALL, Results
from .rows import NOT_IN_DOUBT, NOTHING, OPEN, at, by_regime, exponent, good, positive, value

PRINTED_EXTENSION, PRINTED_RADIAL, PRINTED_PENDULUM = 0.04, 1.0, 0.2  # l0, rad/s, rad/s
PRINTED_DIGIT = 0.05  # they are printed to one digit
DOMINANT = 0.9  # share of the variance at a few frequencies above which they dominate
NEGLIGIBLE = 0.01  # share of the variance below which a coupling is negligible
DECAYED = 0.5  # what is left after 40 periods, below which a transient decays
RESONANT = 0.1  # relative distance of a ratio of natural frequencies from 1, 2 or 3
REGULAR = "period-1"


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


def always_taut(results: Results) -> Statement:
    rows, claim = good(results.over_depth(SMALL)), "In small waves the line stays in tension at all times."
    least = results.calm.tension_min_N if results.calm else math.nan
    checks = [(f"kA = {number(SMALL)}, the long run", least > 0.0)] if math.isfinite(least) else []
    checks += [(at(row), value(row, "tension_top_min_N") > 0.0) for row in rows]
    words = ", ".join(f"{number(value(row, 'tension_top_min_N'), 4)} at {at(row)}" for row in rows)
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
    rows = good(results.over_depth(SMALL))
    words = by_regime([(at(row), row) for row in rows])
    long = results.buoy.get(SMALL)
    found = f"The long run: {long['regime'] or 'no verdict'}, σ = {exponent(long)} bits per period. " if long else ""
    checks = [("the long run", long["regime"] == REGULAR)] if long and long["regime"] not in OPEN else []
    checks += [(at(row), row["regime"] == REGULAR) for row in rows if row["regime"] not in OPEN]
    claim = "In small waves the motion of the buoy is periodic and regular."
    return Statement(claim, f"{found}Shorter runs: {words}.", tuple(checks), f"regime period-1; {NOTHING}")


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
    off = calm.radial_radps / modes.radial_radps - 1.0, calm.angular_radps / modes.pendulum_radps - 1.0
    found = (
        f"Over the first 20 periods r has {decimals(calm.radial_radps, 3)} rad/s ({percent(off[0])} off), θ "
        f"{decimals(calm.angular_radps, 3)} rad/s ({percent(off[1])}). In the window of fig. 12 the peaks are "
        f"{decimals(calm.radial_bins, 2)} and {decimals(calm.angular_bins, 2)} bins off; the wave's frequency less the "
        f"pendulum's, {decimals(modes.wave_radps - calm.angular_radps, 2)} rad/s, lies beside the radial one."
    )
    checks = tuple((name, abs(x) < PRINTED_DIGIT) for name, x in zip(("r", "θ"), off, strict=True))
    return Statement(claim, found, checks, f"within {percent(PRINTED_DIGIT)}")


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
    ("4.2", rest, "closed form: (ρ V − M) g = f(ε)"),
    ("4.2.1", estimates, "closed form"),
    ("4.2, 4.2.1, fig. 9", always_taut, f"{AGAIN}; {CODES}"),
    ("4.2.1, fig. 10", small_excursion, CODES),
    ("4.2, 4.2.1", regular, f"tangent dynamics and Wolf's method; {DEPTHS}"),
    ("4.2.1, fig. 9", decays, f"quadratic drag, eq. (30); {CODES}"),
    ("4.2.1, figs. 10, 11", slower, CODES),
    ("4.2.1", uncoupled, "spectra by eq. (31)"),
    ("4.2.1, fig. 12", two_modes, "spectra by eq. (31)"),
    ("4.2.1, fig. 12", on_estimates, "closed form; shooting and engine agree to 1e-7 (docs/findings.md)"),
    ("4.2.2, fig. 14", exponent_to_zero, "two methods: time series and tangent dynamics"),
)
