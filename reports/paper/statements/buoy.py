"""Section 4.2: the buoy in waves, small (4.2.1) and large (4.2.2), in the plane of the waves.

What depends on the water depth, which the paper does not give, is judged at every depth of the dependence study.
"""

from __future__ import annotations

import math

from ...parts.statements import Statement
from ...parts.wording import decimals, number, percent, ranges
from ..results import LARGE, SMALL, Results

PRINTED_EXTENSION, PRINTED_RADIAL, PRINTED_PENDULUM = 0.04, 1.0, 0.2  # l0, rad/s, rad/s
PRINTED_DIGIT = 0.05  # they are printed to one digit
DOMINANT = 0.9  # share of the variance at a few frequencies above which they dominate
NEGLIGIBLE = 0.01  # share of the variance below which a coupling is negligible
ONE_LINE = 0.25  # share of the variance on one bin above which a spectrum has a dominant mode
CONTINUOUS = 0.05  # share of the variance that no line explains, above which a spectrum is continuous
SLACK, PEAK = 0.01, 2.0  # share of the time; maximum over the static tension
DECAYED = 0.5  # what is left after 40 periods, below which a transient decays
RESONANT = 0.1  # relative distance of a ratio of natural frequencies from 1, 2 or 3
HIGH_MODE = 4  # half waves
NOT_IN_DOUBT = 2.0  # standard errors
REGULAR = "period-1"
OPEN = ("", "undecided", "transient")  # regimes that decide nothing


def _value(row: dict | None, column: str) -> float:
    entry = None if row is None else row.get(column)
    return math.nan if entry is None or entry == "" else float(entry)


def _exponent(row: dict | None) -> str:
    found, error = (_value(row, f"lyapunov_tangent_{name}") for name in ("bits_per_period", "error"))
    return "none" if math.isnan(found) else f"{decimals(found, 3)} ± {decimals(error, 3)}"


def _positive(row: dict) -> bool:
    found, error = (_value(row, f"lyapunov_tangent_{name}") for name in ("bits_per_period", "error"))
    return found - NOT_IN_DOUBT * error > 0.0


def _at(row: dict) -> str:
    return f"H = {number(row['depth_m'])} m"


def _elsewhere(results: Results, steepness: float) -> list[tuple[str, dict]]:
    """(where, row) of the runs whose buoy loses buoyancy out of the water, by depth: not as shipped, yet likelier."""
    if not results.dependence:
        return []
    usual = results.usual()["submergence"]
    others = dict.fromkeys(row["submergence"] for row in results.dependence if row["submergence"] != usual)
    found = [(under, row) for under in others for row in _good(results.over_depth(steepness, submergence=under))]
    return [(f"{_at(row)} with `{under}`", row) for under, row in found]


def _good(rows) -> list[dict]:
    return [row for row in rows if row["status"] == "ok"]


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
    rows, claim = _good(results.over_depth(SMALL)), "In small waves the line stays in tension at all times."
    least = results.calm.tension_min_N if results.calm else math.nan
    checks = [(f"kA = {number(SMALL)}, the long run", least > 0.0)] if math.isfinite(least) else []
    checks += [(_at(row), _value(row, "tension_top_min_N") > 0.0) for row in rows]
    words = ", ".join(f"{number(_value(row, 'tension_top_min_N'), 4)} at {_at(row)}" for row in rows)
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
    rows = _good(results.over_depth(SMALL))
    words = ", ".join(f"{row['regime'] or 'no verdict'} at {_at(row)}" for row in rows)
    long = results.buoy.get(SMALL)
    found = f"The long run: {long['regime'] or 'no verdict'}, σ = {_exponent(long)} bits/T. " if long else ""
    checks = [("the long run", long["regime"] == REGULAR)] if long and long["regime"] not in OPEN else []
    checks += [(_at(row), row["regime"] == REGULAR) for row in rows if row["regime"] not in OPEN]
    claim = "In small waves the motion of the buoy is periodic and regular."
    return Statement(claim, f"{found}Other depths: {words or 'none'}.", tuple(checks), "regime period-1; where it is undecided or a transient, nothing")


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


def threshold(results: Results) -> Statement:
    rows = sorted(_good(results.sweep), key=lambda row: row["steepness"])
    claim = "Beyond a threshold of the wave amplitude the line goes slack for part of the cycle and then snaps."
    if not rows:
        return Statement(claim, "No sweep shows it.", ())
    slack = [_value(row, "slack_fraction") > 0.0 for row in rows]
    steepness = [row["steepness"] for row in rows]
    found = f"Slack at kA = {ranges(steepness, slack)} of {number(steepness[0])} to {number(steepness[-1])}."
    first = slack.index(True) if any(slack) else len(rows)
    checks = (
        ("there is a threshold", 0 < first < len(rows)),
        ("slack at all larger waves", any(slack) and all(slack[first:])),
    )
    return Statement(claim, found, checks, "taut below one steepness, slack from it on")


def chaos_beyond(results: Results) -> Statement:
    rows = sorted(_good(results.sweep), key=lambda row: row["steepness"])
    slack = [row for row in rows if _value(row, "slack_fraction") > 0.0 and row["regime"] not in OPEN]
    claim = "Wherever the line goes slack and snaps, the motion is chaotic."
    regular = [row["regime"] != "chaotic" for row in slack]
    values = [row["steepness"] for row in slack]
    if not slack:
        return Statement(claim, "No sweep shows it.", ())
    found = f"With a slack line, yet periodic or quasi-periodic: kA = {ranges(values, regular)}."
    chaos = f"kA = {ranges(values, [not holds for holds in regular])}"
    order = f"kA = {ranges(values, regular)}"
    grouped = ((chaos, True),) * (not all(regular)) + ((order, False),) * any(regular)
    return Statement(claim, found, grouped, "regime chaotic; where it is undecided or a transient, nothing")


def snapping(results: Results) -> Statement:
    rows = _good(results.over_depth(LARGE))
    static = results.modes.static_tension_N if results.modes else math.nan
    claim = "In large waves intervals of almost no tension are followed by large peaks."
    if not rows or not math.isfinite(static):
        return Statement(claim, "No run shows it.", ())
    words, checks = [], []
    for row in rows:
        share, peak = _value(row, "slack_fraction"), _value(row, "tension_top_max_N") / static
        checks.append((_at(row), share > SLACK and peak > PEAK))
        words.append(f"{percent(share)} and {number(peak, 2)} at {_at(row)}")
    found = f"Time without tension, and largest over static tension: {', '.join(words)}."
    return Statement(claim, found, tuple(checks), f"{percent(SLACK)} of the time; {number(PEAK)} times the static one")


def buckles(results: Results) -> Statement:
    claim = "In large waves the slack line buckles into a mode of high order."
    if results.waves_of_buckle is None:
        return Statement(claim, "No run shows it.", ())
    found = f"Half waves along the slack line, median over the samples: {number(results.waves_of_buckle)}."
    return Statement(claim, found, (("H = 21 m", results.waves_of_buckle >= HIGH_MODE),), f"{HIGH_MODE} or more")


def positive_exponent(results: Results) -> Statement:
    rows = [row for row in _good(results.over_depth(LARGE)) if _exponent(row) != "none"]
    long = results.buoy.get(LARGE)
    checks = [(_at(row), _positive(row)) for row in rows if row["depth_m"] != results.depth() or long is None]
    words = [f"{_exponent(row)} at {_at(row)}" for row in rows]
    others = [(where, row) for where, row in _elsewhere(results, LARGE) if _exponent(row) != "none"]
    words += [f"{_exponent(row)} at {where}" for where, row in others]
    found = ""
    if long is not None and _exponent(long) != "none":
        where = f"H = {number(results.depth())} m"
        checks = sorted([*checks, (where, _positive(long))], key=lambda check: check[0])
        found = f"The long run at {where}: σ = {_exponent(long)} bits/T. "
    return Statement(
        "In large waves the largest Lyapunov exponent is positive.",
        f"{found}Shorter runs: {', '.join(words) or 'none'}.",
        (*checks, *((where, _positive(row)) for where, row in others)),
        f"{number(NOT_IN_DOUBT)} standard errors above zero",
    )


def chaotic(results: Results) -> Statement:
    rows, long = _good(results.over_depth(LARGE)), results.buoy.get(LARGE)
    checks = [(_at(row), row["regime"] == "chaotic") for row in rows if row["regime"] not in OPEN]
    others = _elsewhere(results, LARGE)
    told = [(_at(row), row) for row in rows] + others
    words = ", ".join(f"{row['regime'] or 'no verdict'} at {where}" for where, row in told)
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
    return Statement(claim, f"{found}Shorter runs: {words or 'none'}.", tuple(checks), "regime chaotic; where it is undecided or a transient, nothing")


def exponent_to_zero(results: Results) -> Statement:
    row = results.buoy.get(SMALL)
    claim = "In small waves the exponent tends to zero with time, as of a regular motion."
    wolf, error = _value(row, "lyapunov_wolf_bits_per_period"), _value(row, "lyapunov_wolf_error")
    if math.isnan(wolf):
        return Statement(claim, "No run shows it.", ())
    found = (
        f"Wolf's method on r(t): {decimals(wolf, 3)} ± {decimals(error, 3)} bits/T; by the tangent dynamics "
        f"{_exponent(row)}: an attracting periodic motion, whose exponent is below zero."
    )
    checks = (("Wolf's method", abs(wolf) <= NOT_IN_DOUBT * error), ("tangent dynamics", not _positive(row)))
    return Statement(claim, found, checks, "Wolf: zero within two errors; tangent: not above zero")


def never_repeats(results: Results) -> Statement:
    rows = _good(results.over_depth(LARGE))
    checks = tuple((_at(row), math.isnan(_value(row, "strobed_period"))) for row in rows)
    words = ", ".join(f"{number(_value(row, 'strobed_period'))} at {_at(row)}" for row in rows)
    claim = "In large waves both motions are non-periodic and irregular."
    return Statement(claim, f"Wave periods after which it repeats: {words or 'none'}.", checks, "no period up to 16")


def continuous(results: Results) -> Statement:
    found, claim = results.violent, "In large waves the spectra are continuous over a wide range of frequencies."
    if found is None or math.isnan(found.unexplained):
        return Statement(claim, "No run shows it.", ())
    words = f"{percent(found.unexplained)} of the variance of the strobed r, r′ is on no spectral line."
    return Statement(claim, words, (("the long run", found.unexplained > CONTINUOUS),), f"above {percent(CONTINUOUS)}")


def no_dominant_mode(results: Results) -> Statement:
    found, claim = results.violent, "In large waves the spectra show no dominant modes."
    if found is None:
        return Statement(claim, "No run shows it.", ())
    words = (
        f"Largest share of the variance on one bin of eq. (31): r {percent(found.radial_line)} at "
        f"{number(found.radial_at, 3)} of the waves' frequency, θ {percent(found.angular_line)} at "
        f"{number(found.angular_at, 3)}."
    )
    checks = (("r", found.radial_line < ONE_LINE), ("θ", found.angular_line < ONE_LINE))
    return Statement(claim, words, checks, f"below {percent(ONE_LINE)}")


def region(results: Results) -> Statement:
    found = results.violent
    claim = "The points of the section r, r′ fill a region, without a clear fractal structure."
    if found is None or math.isnan(found.dimension):
        return Statement(claim, "No run is long enough.", ())
    size = f"{decimals(found.dimension, 2)} ± {decimals(found.dimension_error, 2)}"
    words = f"Correlation dimension of the section: {size}."
    fills = found.dimension + NOT_IN_DOUBT * found.dimension_error > 2.0
    return Statement(claim, words, (("the long run", fills),), "dimension 2 within two errors")


SWEEP, DEPTHS = "part `sweep`: 49 steepnesses", "section on what the paper leaves out: depths"
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
    ("4.2", threshold, SWEEP),
    ("4.2", chaos_beyond, SWEEP),
    ("4.2.2, fig. 13", snapping, f"{DEPTHS}; {AGAIN}"),
    ("4.2.2", buckles, "shape of the rope, part `out_of_plane`"),
    ("4.2.2, fig. 14", positive_exponent, f"tangent dynamics; finite separation agrees (docs/findings.md); {DEPTHS}"),
    ("4.2, 4.2.2", chaotic, f"0-1 test, two surrogates, halves, tighter tolerance; {DEPTHS}"),
    ("4.2.2, fig. 14", exponent_to_zero, "two methods: time series and tangent dynamics"),
    ("4.2.2, figs. 15, 16", never_repeats, f"strobed motion; {DEPTHS}"),
    ("4.2.2, figs. 17, 18", continuous, "lines fitted to the strobed record (CLEAN)"),
    ("4.2.2, figs. 17, 18", no_dominant_mode, "spectra by eq. (31)"),
    ("4.2.2, fig. 19a", region, "correlation dimension of the section of the long run"),
)
