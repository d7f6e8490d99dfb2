"""The regime of a forced motion, in one word, with the evidence for it.

    period-N          the strobed orbit repeats after N forcing periods within tolerance (`detect_period`); the decay
                      of its steps gives the multiplier of the slowest mode
    transient         otherwise: spread or mean of the section change steadily, or neighbours close in: still on its way
    chaotic           otherwise, of 200 periods or more: the exponent of the section's map is above 0 by three errors,
                      and by one in each half; K of the 0-1 test > 0.9; the motion forgets where it was (`memory`); the
                      gain of nonlinear over linear prediction is above 95 % of IAAFT and of noisy-periodic surrogates,
                      and 0.2 nats above their median; and neighbours on the section part. Where the section has bands
                      that are visited in turn, these are tests of the motion within them, and 0.5 nats are asked. An
                      exponent that is given takes the place of the map's where it is that of the tangent dynamics, and
                      else stands beside it: two errors are asked
    quasi-periodic    otherwise: neighbours on the section stay neighbours, a spectral line is incommensurate with the
                      forcing, the motion does not forget, no exponent that is given is positive, and that of
                      the section's map is not below -1, which is that of noise about points
    undecided         otherwise; and wherever an exponent of the tangent dynamics, or the verdict on the same motion at
                      a tighter tolerance, contradicts the word

Noise has a larger apparent exponent than chaos of the same spectrum, so no exponent is ranked among surrogates: what a
deterministic motion has and both nulls lack is a next point that is a nonlinear function of the present one. What
chaos has and no torus, however strange, is that it forgets. What it has and no cycle driven by noise is a map whose
derivative grows. Samples far outside the rest (a -9999) leave no verdict at all.
Error rates: benchmarks/record_rates.py, docs/time_series.md.
"""

import numpy as np
from numpy.typing import ArrayLike

from analysis.evidence import (
    Evidence,
    exponent_evidence,
    exponents_evidence,
    outlier_evidence,
    period_evidence,
    tighter_evidence,
    wandering_evidence,
)
from analysis.exponents import BITS_PER_PERIOD, Exponent
from analysis.memory import bands_in_turn
from analysis.periods import detect_period
from analysis.poincare import poincare_section, section_at_phases
from analysis.sampling import checked_columns, checked_count, checked_series, record

LEAST_POINTS = 40
LEAST_CHAOTIC = 200
# Above it, an exponent is not that of a torus [bits per period].
ABOUT_ZERO = 0.02
FLAT = -1.0  # bits a round of the bands: below it, the map has no slope: noise about points, not along a curve


@record
class Verdict:
    """The regime of a motion and why.

    regime      "period-N" (N a number), "quasi-periodic", "chaotic", "transient" or "undecided"
    reason      one sentence
    evidence    tuple of Evidence, in the order in which the tests were made
    period      N, or None
    points      strobed points judged
    seed        of the random angles and surrogates: the same input and seed give the same verdict
    transient   forcing periods before those that were judged
    """

    regime: str
    reason: str
    evidence: tuple[Evidence, ...]
    period: int | None
    points: int
    seed: int
    transient: int = 0

    def __str__(self) -> str:
        return f"{self.regime}: {self.reason}"

    def named(self, name: str) -> Evidence:
        """The Evidence of that name; ValueError where there is none."""
        for item in self.evidence:
            if item.name == name:
                return item
        raise ValueError(f"no evidence {name!r}; there is {', '.join(item.name for item in self.evidence)}")


def regime(
    series: ArrayLike | None = None,
    step_s: float | None = None,
    period_s: float | None = None,
    *,
    strobed: ArrayLike | None = None,
    transient_periods: int = 0,
    tangent_exponent: Exponent | tuple[float, float] | None = None,
    wolf_exponent: Exponent | tuple[float, float] | None = None,
    tighter: Verdict | str | None = None,
    scale: ArrayLike | None = None,
    tolerance: float = 1e-3,
    max_period: int = 16,
    surrogates: int = 39,
    seed: int = 0,
) -> Verdict:
    """The regime of a periodically forced motion with the evidence for it (rules at the head of this file).

    series (n,) or (n, d)    samples from t = 0, any unit: one coordinate, or all there are. A single coordinate is seen
                             at four phases of the period, which makes up for those that are missing
    step_s, period_s         sampling step and forcing period [s]; with `series` both are needed
    strobed (m,) or (m, d)   instead of `series`: the section itself, one row a forcing period
    transient_periods        periods left out at the start
    tangent_exponent         Exponent, or (value, error) in bits per forcing period, of the tangent dynamics
    wolf_exponent            the same, of the time series, as by Wolf's method
    tighter                  Verdict, or its word, on the same motion computed to a ten times tighter tolerance; where
                             it is not given, nobody looked, and that alone does not speak against chaos
    scale, tolerance, max_period   as in detect_period; scale defaults to the range of the later half of `series`
    surrogates               of each null, 19 or more
    seed                     of random angles and surrogates
    Returns a Verdict. Chaos needs 200 forcing periods, any verdict 40; weak chaos needs many more, and is undecided
    until then. What it cannot tell apart: chaos of an exponent below 4/m nats per period and a torus; noise that makes
    a motion part neighbours and chaos. Chaos under a quasi-periodic forcing does not forget it, and stays undecided.
    Raises ValueError for values that are not finite, neither or both of series and strobed, or a missing step.
    Source: evidence by evidence in the functions named above.
    """
    surrogates = checked_count(surrogates, "surrogates", least=19)
    section, scale = _section(series, step_s, period_s, strobed, transient_periods, scale)
    tangent = _in_bits(tangent_exponent, period_s, "tangent_exponent")
    wolf = _in_bits(wolf_exponent, period_s, "wolf_exponent")
    points = len(section)
    if points < LEAST_POINTS:
        reason = f"too short: {LEAST_POINTS} strobed points are needed, given {points}"
        return Verdict("undecided", reason, (), None, points, seed)
    judged = strobed if series is None else series
    evidence = outlier_evidence(checked_columns(judged))
    if evidence:
        return Verdict("undecided", evidence[0].sentence, tuple(evidence), None, points, seed)
    estimate = detect_period(section, max_period, tolerance, scale)
    evidence = period_evidence(estimate)
    if estimate.period is not None:
        word, reason = f"period-{estimate.period}", estimate.reason
        evidence.append(exponent_evidence(tangent, wolf))
    else:
        from_caller, of_section = exponents_evidence(section, tangent, wolf)
        wandering = wandering_evidence(section, from_caller + of_section, max_period, surrogates, seed)
        word, reason = _without_period(section, from_caller, of_section, *wandering)
        evidence += from_caller + of_section + wandering
    evidence.append(tighter_evidence(tighter, word))
    word, reason = _contradicted(word, reason, evidence[-1], tangent)
    period = estimate.period if word.startswith("period-") else None
    return Verdict(word, reason, tuple(evidence), period, points, seed)


def _without_period(section, from_caller, of_section, drift, growth, line, irregular, memory, *nulls):
    """Word and reason for a motion that does not repeat, from its exponents (the caller's; of its section) and its
    `wandering_evidence`."""
    if drift.passed:
        return "transient", drift.sentence
    needed = [*from_caller, *of_section, irregular, memory, *nulls]
    failed = [item.name for item in needed if item.passed is False]
    lacking = failed or [item.name for item in needed if item.passed is None]
    if not growth.value > growth.threshold:
        lacking.append("neighbours that part")
    if len(section) < LEAST_CHAOTIC:
        lacking.append(f"{LEAST_CHAOTIC} points")
    if not lacking:
        return "chaotic", "exponent, 0-1 test, memory and both nulls agree"
    # The map fitted to a wrinkled torus is too rough for an exponent of 0, but not for that of noise about points.
    part = any(exponent.value - 2.0 * exponent.error > ABOUT_ZERO for exponent in from_caller)
    flat = any(bands_in_turn(section) * exponent.value < FLAT for exponent in of_section)
    if growth.passed and line.passed and not (irregular.passed or memory.passed or part or flat):
        reason = "neighbours on the section stay neighbours, and a line is incommensurate with the forcing"
        return "quasi-periodic", reason
    return "undecided", "no period, no torus; chaos lacks: " + ", ".join(lacking)


def _contradicted(word, reason, tighter, tangent):
    """The word, or undecided where a better source says otherwise."""
    if tighter.passed is False:
        return "undecided", f"{word} at this tolerance, but {tighter.sentence}"
    positive = tangent is not None and tangent.found and tangent.value - 2.0 * tangent.error > 0.0
    if positive and word.startswith("period-"):
        return "undecided", f"looks {word}, but the exponent of the tangent dynamics is positive"
    return word, reason


def _section(series, step_s, period_s, strobed, transient_periods, scale):
    """The section (m, d) and the scale for detect_period."""
    if (series is None) == (strobed is None):
        raise ValueError("either series or strobed is needed, not both and not neither")
    first = checked_count(transient_periods, "transient_periods", least=0)
    if strobed is not None:
        return checked_columns(strobed, "strobed")[first:], scale
    if step_s is None or period_s is None:
        raise ValueError("step_s and period_s are needed with a series")
    x = checked_series(series, dimensions=(1, 2))
    looked = section_at_phases if x.ndim == 1 else poincare_section
    section = looked(x, step_s, period_s, transient_periods=first).points
    if scale is None:
        span = np.ptp(x[len(x) // 2 :], axis=0)
        least = 1e-9 * np.abs(x).max(axis=0)
        span = np.maximum(span, np.where(least > 0.0, least, 1.0))
        scale = np.resize(span, section.shape[1])
    return section, scale


def _in_bits(exponent, period_s, name):
    """An Exponent in bits per period, or None."""
    if exponent is None:
        return None
    if not isinstance(exponent, Exponent):
        reason = "no value" if np.isnan(exponent[0]) else ""
        return Exponent(*exponent, BITS_PER_PERIOD, "given", reason)
    if exponent.unit != BITS_PER_PERIOD and period_s is None:
        raise ValueError(f"{name}: in {exponent.unit}, so period_s is needed")
    return exponent.in_bits_per_period(period_s)
