"""Section 4.2.1: the buoy at rest and in small waves, in their plane."""

import math

from campaigns.paper.measured import Results
from campaigns.paper.measures import EARLY, SETTLED, SMALL, WINDOW
from campaigns.paper.statements.judging import (
    LONG,
    NOT_IN_DOUBT,
    NOTHING,
    at_places,
    by_regime,
    everywhere,
    exponent,
    looks,
    near,
    of,
    passed,
    positive,
    regimes,
    value_of,
)  # fmt: skip
from campaigns.statements import Claim, Measured, Rule, above, below, met, shown, within

PRINTED_DIGIT = 0.05  # the paper's estimates are printed to one digit
RESONANT = 0.1  # relative distance of a ratio of natural frequencies from 1, 2 or 3
NEGLIGIBLE = 0.01  # share of the variance below which a coupling is negligible


def always_taut(results: Results) -> Measured:
    """Least top tension [N], of the whole long run and of the short ones after their transients."""
    checks = [(f"kA = {SMALL:g}, {LONG}", results.number("long_tension_min_N"))]
    checks += [(where, value_of(row, "tension_top_min_N")) for where, row in everywhere(results, SMALL)]
    known = [(where, least) for where, least in checks if math.isfinite(least)]
    return Measured(known, ", ".join(f"{shown(least, '.4g')} at {where}" for where, least in known))


def regular(results: Results) -> Measured:
    """The regime of the long run, and of the short ones."""
    rows, long = everywhere(results, SMALL), results.buoy.get(SMALL)
    checks = regimes([(LONG, long)] if long else [], _is_periodic) + regimes(rows, _is_periodic)
    found = f"{LONG} {long['regime'] or 'no verdict'}, σ = {exponent(long)} bits per period; " if long else ""
    return Measured(checks, f"{found}shorter runs {by_regime(rows)}" if long or rows else "")


def _is_periodic(regime: str) -> bool:
    return regime.startswith("period-")


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
    bin_radps = results.number("estimate_wave_radps") / WINDOW[1]
    checks, words = [], []
    for name, side, estimate in (("r", "radial", "radial"), ("θ", "angular", "pendulum")):
        own = results.number(f"estimate_{estimate}_radps")
        early, late = results.number(f"early_{side}_radps"), own + results.number(f"{side}_bins") * bin_radps
        if not all(map(math.isfinite, (own, early, late))):
            return Measured()
        for when, seen, coarse in ((EARLIEST, early, 0.0), ("the window of fig. 12", late, 0.5 * bin_radps)):
            checks.append((f"{name} in {when}", abs(seen / own - 1.0) < max(PRINTED_DIGIT, coarse / own)))
            words.append(f"{name} in {when} {shown(seen, '.3f')} ({shown(seen / own - 1.0, '.2%')} off)")
    order = [0, 2, 1, 3]  # by time, then by motion
    beside = results.number("estimate_wave_radps") - results.number("early_angular_radps")
    said = ", ".join(words[k] for k in order)
    said += f"; bins of that window are {shown(bin_radps, '.3f')}; the wave's frequency less the pendulum's, "
    return Measured(passed(*(checks[k] for k in order)), f"{said}{shown(beside, '.2f')}, lies beside the radial one")


def exponent_to_zero(results: Results) -> Measured:
    """The exponent of the long run by two methods."""
    row = results.buoy.get(SMALL)
    wolf, error = value_of(row, "lyapunov_wolf_bits_per_period"), value_of(row, "lyapunov_wolf_error")
    if math.isnan(wolf):
        return Measured()
    words = f"Wolf's method on r(t) {shown(wolf, '.3f')} ± {shown(error, '.3f')}; tangent dynamics {exponent(row)}"
    checks = passed(("Wolf's method", abs(wolf) <= NOT_IN_DOUBT * error), ("tangent dynamics", not positive(row)))
    return Measured(checks, words)


def _stretch(results: Results) -> float:
    return results.number("rest_m") / results.number("length_m") - 1.0


def _excursion(results: Results) -> float:
    return results.number("excursion_m") / (results.number("rest_m") - results.number("length_m"))


EARLIEST = f"the first {EARLY[1]} periods"
DEPTHS = "section on what the paper leaves out: depths"
AGAIN = "the same runs tighter and finer (report on the buoy, error against run time)"
CODES = "two published codes and an ODE agree to 1.4 mm at kA = 0.016 (docs/findings.md)"
AS_PRINTED = within(PRINTED_DIGIT, f"to {PRINTED_DIGIT:.0%} of the printed number")
ALWAYS_TAUT = Claim(
    "4.2, 4.2.1, fig. 9", "In small waves the line stays in tension at all times.",
    "Least top tension, N, of the short runs after the transient", always_taut,
    above(0.0, "least tension above zero"), f"{AGAIN}; {CODES}",
)  # fmt: skip
REGULAR = Claim(
    "4.2, 4.2.1", "In small waves the motion of the buoy is periodic and regular.", "Regime", regular,
    met(f"regime period-N; {NOTHING}"), f"tangent dynamics and Wolf's method; {DEPTHS}",
)  # fmt: skip
TWO_MODES = Claim(
    "4.2.1, fig. 12", "In small waves natural and forced oscillation dominate the spectra of both motions.",
    "Their share of the variance, eq. (31)", looks(".1%", r=of("radial_share"), θ=of("angular_share")),
    above(0.9, "more than 90 %"), "spectra by eq. (31)",
)  # fmt: skip
CLAIMS = (
    Claim(
        "4.2", "The waves are long compared to the buoy, so that Morison's equation gives the loads.",
        "Diameter over wave length (waves that the buoy radiates are left out)",
        at_places(".3f", {"the buoy": of("diameter_over_wave")}), below(0.2, "below 0.2"),
        "closed form: dispersion relation",
    ),
    Claim(
        "4.2", "At rest the buoyancy stretches the line by about 0.04 of its length.", "Stretch over length (printed)",
        near(".5f", rest=(_stretch, 0.04)), AS_PRINTED, "closed form: (ρ V − M) g = f(ε)",
    ),
    Claim(
        "4.2, 4.2.1", "Waves of 0.1 m amplitude and 5 s period have the slope 0.016 and the frequency 1.26 rad/s.",
        "Amplitude A of that slope at the depth of the scene, m, and frequency, rad/s (printed)",
        near(".4f", A=(of("small_amplitude_m"), 0.1), ω=(of("estimate_wave_radps"), 1.26)), AS_PRINTED,
        "closed form: dispersion relation",
    ),
    Claim(
        "4.2.1", "In small waves the buoy oscillates about its position at rest.",
        f"Mean of the last {SETTLED} periods off it, over half the range",
        looks(".2%", r=of("radial_mean"), θ=of("angular_mean")), within(0.1, "within 10 %"), CODES,
    ),
    Claim(
        "4.2.1", "The natural frequencies are about 1.0 rad/s along r and 0.2 rad/s along θ.",
        "By the paper's formulas, rad/s (printed)",
        near(".4f", r=(of("estimate_radial_radps"), 1.0), θ=(of("estimate_pendulum_radps"), 0.2)), AS_PRINTED,
        "closed form",
    ),
    ALWAYS_TAUT,
    Claim(
        "4.2.1, fig. 10", "In small waves the motion along r is smaller than the static stretch.",
        "Largest excursion along r over the static stretch", at_places(".3f", {LONG: _excursion}),
        below(1.0, "smaller than it"), CODES,
    ),
    REGULAR,
    Claim(
        "4.2.1, fig. 9", "The transient along r decays slowly, by the viscous drag.",
        "Share of its amplitude that is left after 40 wave periods", at_places(".1%", {LONG: of("radial_kept")}),
        Rule(lambda left: 0.0 < left < 0.5, "less than 50 % left, and not none"), f"quadratic drag, eq. (30); {CODES}",
    ),
    Claim(
        "4.2.1, figs. 9, 10", "In small waves the motion along r shows the trends of the tension.",
        f"Correlation of the two over {sum(WINDOW)} periods", at_places(".5f", {LONG: of("tension_alike")}),
        above(0.9, "above 0.9"), CODES,
    ),
    Claim(
        "4.2.1, figs. 10, 11", "The transient along θ vanishes more slowly than that along r.",
        "Left after 40 wave periods, θ over r", at_places(".2f", {LONG: of("angular_kept", over="radial_kept")}),
        above(1.0, "more is left"), CODES,
    ),
    Claim(
        "4.2.1", "There are no internal resonances, and the coupling of r and θ is nearly negligible.",
        "Frequencies and shares", uncoupled, met("ratio 10 % off 1, 2, 3; shares below 1 %"), "spectra by eq. (31)",
    ),
    TWO_MODES,
    Claim(
        "4.2.1, fig. 12", "The natural frequencies seen in the spectra agree well with the estimates.",
        "rad/s", on_estimates, met("within 5 %, or half a bin of fig. 12"),
        "closed form; shooting and engine agree to 1e-7 (docs/findings.md)",
    ),
    Claim(
        "4.2.2, fig. 14", "In small waves the exponent tends to zero with time, as of a regular motion.",
        "Bits per period", exponent_to_zero, met("Wolf: zero within two errors; tangent: not above zero"),
        "two methods: time series and tangent dynamics",
    ),
)  # fmt: skip
