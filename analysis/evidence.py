"""The tests behind a verdict (`verdicts.regime`), each a line of evidence: name, value, threshold, passed, sentence."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from analysis.line_spectra import spectral_lines
from analysis.memory import bands_in_turn, long_memory, widest_band, within_bands
from analysis.neighbours import neighbour_growth
from analysis.sampling import record_of_numbers
from analysis.section_maps import section_lyapunov
from analysis.stationarity import outlying, record_drift
from analysis.surrogates import NULLS, SHARE, null_ranks
from analysis.zero_one import zero_one_test

if TYPE_CHECKING:
    from analysis.exponents import Exponent
    from analysis.periods import PeriodEstimate
    from analysis.verdicts import Verdict

IRREGULAR = 0.9
LEAST_ADVANTAGE = 0.2
# The same in bands: noise that drives a cycle through a curved map reaches 0.35, chaos in 1 % of noise 0.7.
LEAST_IN_BANDS = 0.5
STAYS, NEAR = 0.35, 0.35  # nats by which neighbours may part; what they are apart at most, in sizes of the section
# A line nearer than this to j/N, in turns over the record, is one with period N as far as the record goes.
LEAST_TURN = 0.25
# What a line must carry: the weaker ones ride on noise.
LEAST_POWER = 0.01
# The memory of chaos: what its scatter in m points, and what slow decay leaves.
SCATTERED, FORGOTTEN = 7.0, 0.25


@record_of_numbers
class Evidence:
    """One test of a motion.

    name        which test
    value       what it found; NaN where it gave no answer
    threshold   what the value was compared with; NaN where there is nothing to compare
    passed      True, False, or None where the test was not made or does not apply
    sentence    what it means
    error       standard error of the value, NaN where unknown
    """

    name: str
    value: float
    threshold: float
    passed: bool | None
    sentence: str
    error: float = float("nan")


def evidence_text(verdict: Verdict) -> str:
    """The tests behind a Verdict as one line: "name: value/threshold/met; ...", a dash for what is not known."""
    words = {True: "yes", False: "no", None: "–"}
    tests = []
    for item in verdict.evidence:
        tests.append(f"{item.name}: {_short(item.value)}/{_short(item.threshold)}/{words[item.passed]}")
    return "; ".join(tests)


def _short(number: float) -> str:
    if not np.isfinite(number):
        return "–"
    return f"{number:.3g}"


def read_evidence(text: str) -> list[tuple[str, str, str, str]]:
    """(name, value, threshold, met) of each test in a line of `evidence_text`; other text is left out."""
    tests = []
    for part in text.split("; "):
        name, _, rest = part.rpartition(": ")
        cells = rest.split("/")
        if name and len(cells) == 3:
            tests.append((name, *cells))
    return tests


def wandering_evidence(
    section: np.ndarray, exponents: list[Evidence], max_period: int, surrogates: int, seed: int
) -> list[Evidence]:
    """Of a motion that does not repeat: drift, neighbours, incommensurate line, 0-1 test, memory; and the nulls, where
    these and the exponents do not speak against chaos already."""
    growth = growth_evidence(section)
    drift, line = drift_evidence(section, growth), incommensurate_evidence(section, max_period)
    irregular, memory = irregular_evidence(section, seed), memory_evidence(section)
    items = [drift, growth, line, irregular, memory]
    if not drift.passed and all(item.passed for item in (*exponents, irregular, memory)):
        band, bands = widest_band(section)
        least = LEAST_ADVANTAGE if bands == 1 else LEAST_IN_BANDS
        return items + null_evidence(band, surrogates, seed, least)
    reason = "not asked: the motion is not chaotic by the tests before"
    for null in NULLS:
        items.append(Evidence(null, np.nan, np.nan, None, reason))
        items.append(Evidence(f"{null}, margin", np.nan, np.nan, None, reason))
    return items


def period_evidence(estimate: PeriodEstimate) -> list[Evidence]:
    """Whether the strobed orbit repeats, by what it misses, and the multiplier of the slowest decay towards it."""
    if estimate.period is None:
        return [Evidence("period", np.nan, estimate.tolerance, False, estimate.reason)]
    n = estimate.period
    period = Evidence("period", estimate.residual[n - 1], estimate.tolerance, True, estimate.reason)
    if estimate.residual[n - 1] == 0.0:
        sentence = "the orbit repeats to the last digit: nothing is left whose decay could be seen"
        return [period, Evidence("contraction", np.nan, 1.0, None, sentence)]
    multiplier = estimate.multiplier[n - 1]
    sentence = f"factor from one step over {n} period(s) to the next; independent errors have -1/2"
    return [period, Evidence("contraction", multiplier, 1.0, abs(multiplier) < 1.0, sentence)]


def outlier_evidence(series: np.ndarray, time: np.ndarray | None = None) -> list[Evidence]:
    """Samples far outside the rest, where there are any: no verdict can be given then.

    time (n,)   of a section, whose rows are not those of the record; None: the series is the record
    """
    far = outlying(series)
    if len(far) == 0:
        return []
    outside, first = "samples", f"in row {far[0] + 1} ({np.ravel(series[far[0]])[0]:.6g})"
    if time is not None:
        outside, first = "points of the section", f"{time[far[0]]:.6g} after the first sample"
    lie = f"{len(far)} of {len(series)} {outside} lie far outside the rest"
    sentence = f"{lie}, the first {first}: cut or repair the record there"
    return [Evidence("outliers", float(len(far)), 0.0, False, sentence)]


def exponent_evidence(tangent: Exponent | None, wolf: Exponent | None) -> Evidence:
    """lambda - 2 error > 0, of the tangent dynamics where there is one, else of the time series."""
    source, exponent = "time series", wolf
    if tangent is not None and tangent.found:
        source, exponent = "tangent dynamics", tangent
    if exponent is None:
        return Evidence("exponent", np.nan, 0.0, None, "not asked: the orbit repeats, and no exponent was given")
    if not exponent.found:
        return Evidence("exponent", np.nan, 0.0, None, f"no exponent: {exponent.reason}")
    passed = exponent.value - 2.0 * exponent.error > 0.0
    sentence = f"bits per period, of the {source}, with an error of {exponent.error:.2g}; two errors are asked for"
    return Evidence("exponent", exponent.value, 0.0, passed, sentence, exponent.error)


def growth_evidence(section: np.ndarray, least: float = 0.0) -> Evidence:
    """Neighbours stay neighbours: the section is that of a torus (or of a period seen through noise).

    least: distance, in sizes of the section, below which distances are one, because integration differs by as much.
    """
    neighbours = neighbour_growth(section)
    growth = neighbours.growth
    if not np.isfinite(growth):
        return Evidence("neighbours", growth, STAYS, None, neighbours.reason)
    if least > 0.0:
        distance = np.log(np.maximum(neighbours.distance, least))
        growth = distance[(len(distance) - 1) // 2 :].mean() - distance[1:4].mean()
    passed = abs(growth) < STAYS and neighbours.late < NEAR
    return Evidence("neighbours", growth, STAYS, passed, f"{neighbours.reason} (growth {growth:.2f} nats)")


def drift_evidence(section: np.ndarray, growth: Evidence) -> Evidence:
    """Still on its way: spread or mean march with time, or neighbours close in."""
    drift = record_drift(section)
    closing = growth.value < -STAYS
    reason = drift.reason
    if closing and not drift.drifting:
        reason = "neighbours on the section close in on each other"
    return Evidence("drift", drift.spread_change, np.nan, drift.drifting or closing, reason)


def incommensurate_evidence(section: np.ndarray, max_period: int) -> Evidence:
    """The strongest line that is not a subharmonic of the forcing up to max_period."""
    spectrum = spectral_lines(section)
    variance = np.var(section, axis=0)
    moving = variance > 0.0
    power = 0.5 * spectrum.amplitude[:, moving] ** 2 / variance[moving]
    power[spectrum.frequency == 0.5] *= 2.0  # a line of amplitude a is +a or -a there: a^2, not a^2/2
    share = power.max(axis=1, initial=0.0)
    subharmonics = np.arange(1, max_period + 1)
    places = spectrum.frequency[:, None]
    # Distance of each line from the nearest j/N, N <= max_period, in turns over the record.
    turns = np.abs(places - np.round(places * subharmonics) / subharmonics).min(axis=1, initial=1.0) * len(section)
    standing = np.flatnonzero(share > LEAST_POWER)
    if len(standing) == 0:
        return Evidence("incommensurate line", np.nan, LEAST_TURN, False, "no line stands out of the spectrum")
    free = standing[turns[standing] > LEAST_TURN]
    if len(free):
        best = free[np.argmax(share[free])]
    else:
        best = standing[np.argmax(turns[standing])]
    line = f"a line at {spectrum.frequency[best]:.5f} cycles a period with {min(share[best], 1.0):.0%} of a coordinate"
    sentence = f"turns over the record between {line} and the nearest subharmonic"
    return Evidence("incommensurate line", turns[best], LEAST_TURN, len(free) > 0, sentence)


def irregular_evidence(section: np.ndarray, seed: int) -> Evidence:
    """K > 0.9: the median over the coordinates of the 0-1 test, each less its mean in each band visited in turn.

    With the means, the jump from band to band hides the spreading of the walk.
    """
    bands = bands_in_turn(section)
    tests = []
    for j, column in enumerate(within_bands(section, bands).T):
        tests.append(zero_one_test(column, seed=[seed, j]))
    values = np.array([test.value for test in tests])
    answered = np.isfinite(values)
    if 2 * answered.sum() < len(values) or not answered.any():
        return Evidence("0-1 test", np.nan, IRREGULAR, None, tests[int(np.argmin(answered))].reason)
    value = np.median(values[answered])
    sentence = "median over the coordinates"
    if bands > 1:
        sentence += f", in the {bands} bands visited in turn"
    return Evidence("0-1 test", value, IRREGULAR, value > IRREGULAR, sentence)


def memory_evidence(section: np.ndarray, name: str = "memory") -> Evidence:
    """The motion forgets where it was: what tori and strange nonchaotic attractors do not."""
    bands = bands_in_turn(section)
    value, threshold = long_memory(section), max(FORGOTTEN, SCATTERED / np.sqrt(len(section) / bands))
    sentence = "largest correlation with the motion an eighth to half of the record later; chaos has to forget"
    passed = None
    if np.isfinite(value):
        passed = value < threshold
    return Evidence(name, value, threshold, passed, sentence)


def exponents_evidence(
    section: np.ndarray, tangent: Exponent | None, wolf: Exponent | None
) -> tuple[list[Evidence], list[Evidence]]:
    """All that have to be positive: those given, and, without one of the tangent dynamics, that of the map fitted to
    the section, to its widest band where there are several (by three errors, and by one in each half).

    Noise that drives a cycle through points of unlike slopes passes for chaos in a map of all of them, not in one band.
    """
    from_caller, name = [], "exponent"
    if tangent is not None or wolf is not None:
        from_caller, name = [exponent_evidence(tangent, wolf)], "exponent of the section"
    if tangent is not None and tangent.found:
        return from_caller, []
    band, bands = widest_band(section)
    estimates = []
    for estimate in section_lyapunov(band):
        estimates.append(replace(estimate, value=estimate.value / bands, error=estimate.error / bands))
    full, first_half, second_half = estimates
    if not all(estimate.found for estimate in estimates):
        return from_caller, [Evidence(name, full.value, 0.0, None, f"no exponent: {full.reason}")]
    in_halves = first_half.value > first_half.error and second_half.value > second_half.error
    passed = full.value > 3.0 * full.error and in_halves
    map_of = "the section's map" if bands == 1 else f"the map of one of the {bands} bands"
    halves = f"{first_half.value:.3f} ± {first_half.error:.3f} and {second_half.value:.3f} ± {second_half.error:.3f}"
    sentence = f"bits per period, by the derivative of {map_of}; ± {full.error:.3f}; in the halves {halves}"
    return from_caller, [Evidence(name, full.value, 3.0 * full.error, passed, sentence, full.error)]


def null_evidence(section: np.ndarray, surrogates: int, seed: int | list[int], least: float) -> list[Evidence]:
    """Rank and margin of the prediction gain among the surrogates of one null, then of the other."""
    items = []
    for name, rank in zip(NULLS, null_ranks(section, surrogates, seed), strict=True):
        passed, rank_sentence = None, "too short, or nothing moves: no prediction gain"
        margin_sentence = rank_sentence
        if rank.above is not None:
            drawn = f"{len(rank.surrogates)} surrogates"
            if len(rank.surrogates) < surrogates:
                drawn += f" (of {surrogates}: the rest could not change it)"
            rank_sentence = f"share of {drawn} below the record's prediction gain of {rank.statistic:.2f} nats"
            margin_sentence = "nats between the prediction gain and the surrogates' median"
            passed = rank.advantage > least
        items.append(Evidence(name, rank.share_below, SHARE, rank.above, rank_sentence))
        items.append(Evidence(f"{name}, margin", rank.advantage, least, passed, margin_sentence))
    return items


def tighter_evidence(tighter: Verdict | str | None, word: str) -> Evidence:
    """Whether the verdict survives a tighter tolerance, where someone looked."""
    if tighter is None:
        return Evidence("tighter tolerance", np.nan, np.nan, None, "no spot check at a tighter tolerance was given")
    tighter_word = tighter if isinstance(tighter, str) else tighter.regime
    sentence = f"the verdict at a tighter tolerance is {tighter_word}"
    return Evidence("tighter tolerance", np.nan, np.nan, tighter_word == word, sentence)
