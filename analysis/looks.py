"""The regime of a simulated motion, from its strobed orbit and its tangent dynamics, look by look.

A simulation can be carried on until its motion is told. So it is looked at after 90, 135, 205, 310, 465, 585, ...
periods (`next_look`), each time without its first third, the transient:

    period-N          the strobed orbit repeats (`detect_period`), and its perturbations do not grow in the later half;
                      where none are carried, the steps towards the orbit shrink
    chaotic           lambda > 3.5 errors; in the later half > 2 of its errors; and in all a growth of 10 bits, because
                      on a torus, too, perturbations grow, as the logarithm of time
    quasi-periodic    |lambda| + 2 errors < 0.06 bits per period, neighbours on the section stay neighbours, and a
                      spectral line is incommensurate with the forcing
    transient         at the end of the record: spread, mean or the steps towards a period still march, or perturbations
                      shrink and no period is met
    undecided         otherwise

A word counts when two looks in a row find it, because a motion on its way passes by others: near an unstable period-2
for 60 periods, or through a chaotic transient for 350. From 465 periods on one look is enough: for a torus by three
errors instead of two, and for chaos if perturbations go on growing, by two errors, where the run goes on at a tighter
tolerance. A longer chaotic transient is called chaotic: the verdict is one over the periods that it names.
Error rates of the whole procedure: docs/verdicts.md. Tests for records of unknown origin (`verdicts.regime`) are not
needed here: what moves is known, and its perturbations are carried along.
"""

import math
from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import ArrayLike

from analysis.evidence import Evidence, drift_evidence, incommensurate_evidence, period_evidence
from analysis.exponents import Exponent
from analysis.neighbours import neighbour_growth
from analysis.periods import PeriodEstimate, detect_period
from analysis.sampling import checked_columns, checked_count, checked_series
from analysis.tangent_growth import LEAST_PERIODS, tangent_lyapunov
from analysis.verdicts import Verdict

OPEN = ("transient", "undecided")  # words that wait for the next look
FIRST_LOOK = 90
POSITIVE, LATER = 3.5, 2.0  # errors by which an exponent is positive: of the look, and of its later half
LEAST_BITS = 10.0  # growth over a look
LONG = 465  # periods from which one look can be enough
CLEAR = 3.0  # errors, where it is enough for a torus
COMES_NEARER = 0.7  # what is left of the steps towards a period in the later half of the last part
ABOUT_ZERO = 0.06  # bits per period
STAYS, NEAR = 0.35, 0.35  # nats by which neighbours may part; what they are apart at most, in sizes of the section
ALIGNED = 10  # periods that perturbations need to turn to the fastest growth
CLEARLY = 3.0  # tolerances from its orbit within which a periodic motion has settled


def next_look(periods: int = 0) -> int:
    """After how many periods a motion is looked at next that was looked at after `periods`; 0: for the first time."""
    return max(FIRST_LOOK, 5 * math.ceil((0.3 if periods < LONG else 0.25) * periods))


def motion_regime(
    strobed: ArrayLike,
    growth_nats: ArrayLike | None = None,
    *,
    scale: ArrayLike | None = None,
    tolerance: float = 1e-3,
    max_period: int = 16,
    tighter: Mapping[int, Exponent] | None = None,
) -> Verdict:
    """The regime of a simulated, periodically forced motion, with the evidence for it (rules at the head of this file).

    strobed (m + 1,) or (m + 1, d)   states once a forcing period, from the start of the run on
    growth_nats (m,)                 logarithm of the growth of a perturbation in each period, nats; NaN in periods in
                                     which none was carried; None: in none
    scale, tolerance, max_period     as in `detect_period`
    tighter                          exponents of runs that went on from the end of a look at a tighter tolerance, by
                                     the periods of that look. None: nobody looks, and chaos, too, takes two looks. A
                                     chaotic look at the end of the record is `chaotic` without such an exponent, for
                                     those who then go on; an earlier one without it does not count
    Returns a Verdict; its `transient` are the periods before those that the word is about. A record that is not long
    enough for two looks (135 periods) is undecided.
    Raises ValueError for states that are not finite, or lengths that do not fit.
    Source: tangent dynamics, Benettin et al. 1980; growth on tori, head of `analysis.neighbours`.
    """
    x = checked_columns(strobed, "strobed")
    periods = len(x) - 1
    growth = np.full(periods, np.nan) if growth_nats is None else np.asarray(growth_nats, dtype=float)
    if growth.shape != (periods,):
        raise ValueError(f"growth_nats: {periods} values are needed for {periods + 1} states, given {growth.shape}")
    checked_series(growth[np.isfinite(growth)], "growth_nats")
    checked_count(max_period, "max_period")
    before, word, reason, evidence, start = "", "undecided", "", [], 0
    for end in looks(periods):
        start = end // 3
        word, reason, evidence, estimate = _look(x, growth, start, end, scale, tolerance, max_period)
        goes_on = word == "chaotic" and tighter is not None
        counts = word == before or (end >= LONG and (goes_on or _clear(word, evidence)))
        if counts and goes_on and end in tighter:
            evidence.append(_tighter(tighter[end]))
            if not evidence[-1].passed:
                word, reason = "undecided", f"chaotic at this tolerance, but {evidence[-1].sentence}"
        elif goes_on and end < periods:
            counts = False
        if counts and word not in OPEN:
            break
        before = word
    else:
        if not evidence:
            reason = f"too short: {next_look(FIRST_LOOK)} periods are needed for two looks, given {periods}"
        elif word not in OPEN:
            word, reason = "undecided", f"{word} at the last look only, over periods {start} to {end}: {reason}"
        return Verdict(word, reason, tuple(evidence), None, len(x) - start, 0, start)
    reason += f", over periods {start} to {end}"
    if estimate.period is not None:
        start = _settled(x[: end + 1], estimate)
        reason += _on_the_way(growth[:start])
    return Verdict(word, reason, tuple(evidence), estimate.period, end + 1 - start, 0, start)


def looks(periods: int) -> Iterator[int]:
    """The looks at a record of so many periods; the last at its end where that is half-way to the next or further."""
    end = next_look()
    while end <= periods:
        yield end
        end, last = next_look(end), end
        if end > periods >= 0.5 * (last + end):
            yield periods


def _look(x, growth, start, end, scale, tolerance, max_period):
    """Word, reason, evidence and PeriodEstimate of periods `start` to `end`."""
    section = x[start : end + 1]
    estimate = detect_period(section, max_period, tolerance, scale)
    evidence = period_evidence(estimate)
    carried = np.flatnonzero(np.isfinite(growth))
    first = max(start, carried[0] + ALIGNED) if len(carried) else end
    known = growth[first:end]
    (whole,) = tangent_lyapunov(known)
    (later,) = tangent_lyapunov(known[len(known) // 2 :])
    shrinks = evidence[-1].passed is not False
    if later.found:
        rising = bool(later.value > LATER * later.error)
        shrinks = not rising
        what = (
            "bits per period in the later half, which have to be positive by two errors for chaos, and not for a period"
        )
        evidence.append(Evidence("later half", later.value, LATER * later.error, rising, what, later.error))
    if estimate.period is not None and shrinks:
        return f"period-{estimate.period}", estimate.reason, evidence, estimate
    if not later.found:
        what = "no period, and" if estimate.period is None else "a period that perturbations do not confirm, and"
        few = f"{what} perturbations over {len(known)} periods only: {2 * LEAST_PERIODS} are needed"
        return ("transient" if _comes_nearer(estimate) else "undecided"), few, evidence, estimate
    bits = whole.value * len(known)
    evidence += [
        Evidence(
            "exponent", whole.value, POSITIVE * whole.error, bool(whole.value > POSITIVE * whole.error),
            f"bits per period, of the tangent dynamics over {len(known)} periods", whole.error,
        ),
        Evidence("growth", bits, LEAST_BITS, bool(bits > LEAST_BITS), "bits by which a perturbation grew in all"),
    ]  # fmt: skip
    said = f"{whole.value:.3f} ± {whole.error:.3f} bits per period"
    if all(item.passed for item in evidence[-3:]):
        return "chaotic", f"perturbations grow by {said}, and so they do in the later half", evidence, estimate
    bound = abs(whole.value) + 2.0 * whole.error
    sentence = "|exponent| and two errors, bits per period"
    evidence.append(Evidence("about zero", bound, ABOUT_ZERO, bool(bound < ABOUT_ZERO), sentence))
    neighbours = _neighbours(section, tolerance)
    drift = drift_evidence(section, neighbours)
    evidence += [neighbours, drift]
    if drift.passed:
        return "transient", drift.sentence, evidence, estimate
    if whole.value + LATER * whole.error < 0.0:
        return "transient", f"perturbations shrink ({said}), but no period is met yet", evidence, estimate
    if bound < ABOUT_ZERO and neighbours.passed:
        evidence.append(incommensurate_evidence(section, max_period))
        if evidence[-1].passed:
            reason = f"neighbours stay neighbours, a line is incommensurate, and perturbations grow by {said}"
            return "quasi-periodic", reason, evidence, estimate
    lacking = [item.name for item in evidence if item.passed is False]
    return "undecided", f"no period; {said}; not met: {', '.join(lacking)}", evidence, estimate


def _clear(word, evidence):
    """A torus whose exponent is below its bound with more than two errors."""
    exponent = next((item for item in evidence if item.name == "exponent"), None)
    return word == "quasi-periodic" and abs(exponent.value) + CLEAR * exponent.error < ABOUT_ZERO


def _comes_nearer(estimate: PeriodEstimate):
    """Whether the steps of the nearest period, or of a divisor, shrink: it will be told without perturbations."""
    if estimate.period is not None or not np.isfinite(estimate.residual).any():
        return False
    nearest = int(np.nanargmin(estimate.residual)) + 1
    trends = [estimate.trend_nats_per_period[d - 1] for d in range(1, nearest + 1) if nearest % d == 0]
    return math.exp(min(trends) * (estimate.points // 4)) < COMES_NEARER


def _neighbours(section, tolerance):
    """Neighbours stay neighbours, where distances below the tolerance are one: integration differs by as much."""
    found = neighbour_growth(section)
    if not np.isfinite(found.growth):
        return Evidence("neighbours", found.growth, STAYS, None, found.reason)
    distance = np.log(np.maximum(found.distance, tolerance))
    growth = float(distance[(len(distance) - 1) // 2 :].mean() - distance[1:4].mean())
    passed = bool(abs(growth) < STAYS and found.late < NEAR)
    return Evidence("neighbours", growth, STAYS, passed, f"nats; {found.reason}")


def _settled(x, estimate: PeriodEstimate):
    """The period from which on a periodic motion is on its orbit."""
    orbit = estimate.orbit[(np.arange(len(x)) - len(x)) % estimate.period]
    away = np.abs(x - orbit) / estimate.scale > CLEARLY * estimate.tolerance
    off = np.flatnonzero(away.any(axis=1))
    return int(off[-1]) + 1 if len(off) else 0


def _on_the_way(growth):
    """What a periodic motion went through before, where that was chaos."""
    (found,) = tangent_lyapunov(growth[np.isfinite(growth)])
    chaos = found.found and found.value > POSITIVE * found.error
    return f", after a chaotic transient of {len(growth)} periods" if chaos else ""


def _tighter(exponent):
    if not exponent.found:
        return Evidence(
            "tighter tolerance", np.nan, 0.0, False, f"no exponent at a tighter tolerance: {exponent.reason}"
        )
    passed = bool(exponent.value > LATER * exponent.error)
    grows = "grow too" if passed else "do not grow for certain"
    sentence = (
        f"at a tighter tolerance perturbations {grows}: {exponent.value:.3f} ± {exponent.error:.3f} bits per period"
    )
    return Evidence("tighter tolerance", exponent.value, LATER * exponent.error, passed, sentence, exponent.error)
