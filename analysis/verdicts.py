"""The regime of a forced motion, in one word, with the evidence for it.

    period-N          the strobed orbit repeats after N forcing periods within tolerance (`detect_period`); the decay
                      of its steps gives the multiplier of the slowest mode
    transient         otherwise: spread or mean of the section change steadily, or neighbours close in: still on its way
    chaotic           otherwise: lambda - 2 error > 0; K of the 0-1 test > 0.9 (in each band, where the section has
                      bands visited in turn); the gain of nonlinear over linear prediction above 95 % of IAAFT and of
                      noisy-periodic surrogates, and 0.3 nats above their median; the 0-1 test and both ranks again in
                      each half of the record; and neighbours on the section part
    quasi-periodic    otherwise: neighbours on the section stay neighbours, a spectral line is incommensurate with the
                      forcing, and the exponent is about 0
    undecided         otherwise; and wherever an exponent of the tangent dynamics, or the verdict on the same motion at
                      a tighter tolerance, contradicts the word

The exponent is that of the tangent dynamics where one is given, else that of the series (Wolf). It does not enter the
ranks: noise has a larger apparent exponent than chaos of the same spectrum, so that "larger than that of surrogates"
would select noise. What a deterministic motion has and both nulls lack is a next point that is a nonlinear function of
the present one; hence the prediction gain.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from analysis.evidence import Evidence, exponent_evidence, period_evidence, tighter_evidence, wandering_evidence
from analysis.exponents import BITS_PER_PERIOD, Exponent
from analysis.periods import detect_period
from analysis.poincare import poincare_section, section_at_phases
from analysis.sampling import checked_columns, checked_count, checked_series
from analysis.wolf_plateau import wolf_lyapunov

LEAST_POINTS = 40
# A record of 300 periods does not show less [bits per period].
ABOUT_ZERO = 0.02


@dataclass(frozen=True, eq=False)
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
    wolf_exponent            the same, of the time series. Where neither is given, Wolf's method on the first coordinate
                             (of a section alone: as a map, 500 points)
    tighter                  Verdict, or its word, on the same motion computed to a ten times tighter tolerance; where
                             it is not given, nobody looked, and that alone does not speak against chaos
    scale, tolerance, max_period   as in detect_period; scale defaults to the range of the later half of `series`
    surrogates               of each null, 19 or more
    seed                     of random angles and surrogates
    Returns a Verdict. Chaos needs 200 forcing periods (each half 100, for the 0-1 test), any verdict 40; weak chaos
    needs many more (7000 at 0.07 bits per period on two folded curves), and is undecided until then. What it cannot
    tell apart: chaos of an exponent below 4/m nats per period and a torus; a motion bent by noise that drives it
    (dynamical noise on a strongly nonlinear cycle) and chaos, where the exponent says positive for both.
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
    estimate = detect_period(section, max_period, tolerance, scale)
    if estimate.period is None and wolf is None and (tangent is None or not tangent.found):
        wolf = _estimated(section, series, step_s, period_s, transient_periods)
    evidence = [*period_evidence(estimate), exponent_evidence(tangent, wolf)]
    if estimate.period is not None:
        word, reason = f"period-{estimate.period}", estimate.reason
    else:
        more = wandering_evidence(section, max_period, surrogates, seed)
        word, reason = _without_period(evidence[-1], *more)
        evidence += more
    evidence.append(tighter_evidence(tighter, word))
    word, reason = _contradicted(word, reason, evidence[-1], tangent)
    period = estimate.period if word.startswith("period-") else None
    return Verdict(word, reason, tuple(evidence), period, points, seed)


def _without_period(exponent, drift, growth, line, irregular, *nulls):
    """Word and reason for a motion that does not repeat, from its `wandering_evidence`."""
    if drift.passed:
        return "transient", drift.sentence
    needed = [exponent, irregular, *nulls]
    if all(item.passed for item in needed) and growth.value > growth.threshold:
        return "chaotic", "exponent, 0-1 test, both nulls and both halves of the record agree"
    about_zero = exponent.passed is None or abs(exponent.value) < 2.0 * exponent.error + ABOUT_ZERO
    if growth.passed and line.passed and not irregular.passed and about_zero:
        reason = "neighbours on the section stay neighbours, and a line is incommensurate with the forcing"
        return "quasi-periodic", reason
    failed = [item.name for item in needed if item.passed is False]
    missing = [item.name for item in needed if item.passed is None]
    lacking = failed or missing or ["neighbours that part"]
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


def _estimated(section, series, step_s, period_s, transient_periods):
    """Wolf's exponent of the first coordinate: of the record where there is one, else of the section as a map."""
    if series is None:
        return wolf_lyapunov(section[:, 0], 1.0).in_bits_per_period(1.0)
    x = np.asarray(series, dtype=float)
    x = x if x.ndim == 1 else x[:, 0]
    return wolf_lyapunov(x[round(transient_periods * period_s / step_s) :], step_s).in_bits_per_period(period_s)


def _in_bits(given, period_s, name):
    """An Exponent in bits per period, or None."""
    if given is None:
        return None
    if not isinstance(given, Exponent):
        return Exponent(*given, BITS_PER_PERIOD, "given", "no value" if np.isnan(given[0]) else "")
    if given.unit != BITS_PER_PERIOD and period_s is None:
        raise ValueError(f"{name}: in {given.unit}, so period_s is needed")
    return given.in_bits_per_period(period_s)
