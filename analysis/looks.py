"""The regime of a simulated motion, from its strobed orbit and its tangent dynamics, look by look.

A simulation can be carried on until its motion is told. So it is looked at after 90, 135, 205, 310, 465, 585, ...
periods (`next_look`), each time without its first third, the transient:

    period-N          the strobed orbit repeats (`detect_period`), and its perturbations grow by less than 0.1 bits per
                      period, two errors included; if they shrink by less than 4 bits in all, it has to repeat to a
                      fifth of the tolerance, because a slow torus may repeat too; where none are carried, the steps
                      towards the orbit shrink
    chaotic           lambda > 3.5 errors; in the later half > 2 of its errors; and in all a growth of 10 bits, because
                      on a torus, too, perturbations grow, as the logarithm of time
    quasi-periodic    |lambda| + 2 errors < 0.06 bits per period; a lambda above 0 by 2 errors leaves 4 bits in all;
                      neighbours on the section stay neighbours, and a spectral line is incommensurate with the
                      forcing
    transient         at the end of the record: spread, mean or the steps towards a period still march, or perturbations
                      shrink and no period is met
    undecided         otherwise. Where perturbations shrink by 52 bits and no period is met, nothing is left of the
                      start, and the errors of steps and grid move the state (`BLURRED`)

The verdict on a record is that of its last look, which is at its end. A word counts when this look and the one before
find it, because a motion on its way passes by others: near an unstable period-2 for 60 periods, or through a chaotic
transient for 900. From 465 periods on one look is enough: for a period if perturbations shrink by 4 bits; for a torus
by three errors instead of two; and for chaos if perturbations go on growing, by two errors, where the run goes on at a
tighter tolerance. A period is also looked for in the last half, quarter, ... of what a look sees. It takes two looks
there, because beside a window orbits repeat for long, again and again. Chaos that ends after the record is called
chaotic: the verdict names its periods.
Error rates of the whole procedure: docs/motions.md. Tests for records of unknown origin (`verdicts.regime`) are not
needed here: what moves is known, and its perturbations are carried along.
"""

import math
from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from analysis.evidence import (
    Evidence,
    drift_evidence,
    growth_evidence,
    incommensurate_evidence,
    period_evidence,
)
from analysis.exponents import Exponent
from analysis.periods import PeriodEstimate, detect_period
from analysis.sampling import checked_columns, checked_count
from analysis.tangent_growth import LEAST_PERIODS, tangent_lyapunov, turned
from analysis.verdicts import Verdict

OPEN = ("transient", "undecided")  # words that wait for the next look
FIRST_LOOK = 90
POSITIVE, LATER = 3.5, 2.0  # errors by which an exponent is positive: of the look, and of its later half
LEAST_BITS = 10.0  # growth over a look
LONG = 465  # periods from which one look can be enough
SHORTEST = 150  # periods of the shortest part at the end of a record that is looked at by itself
SEEN = 0.1  # bits per period: growth, a doubling in ten periods, that a period's test has to be able to see
CLOSELY = 0.2  # tolerances by which a period is missed at most where no perturbations tell
NO_GROWTH, CLOSE = "no growth", "close"  # the tests of a period
SHEAR = 4.0  # bits: the shear of a torus gives log2(3) = 1.6 from a third of a record to its end
FORGOTTEN = 52.0  # bits: the precision of a number
# words of a reason, by which others know why a regime is open
BLURRED = "errors of steps and grid blur it"
OF_STEPS = "chaotic at this tolerance only"
OUTLASTS = "the run repeats for longer than so unstable an orbit allows"
CLEAR = 3.0  # errors, where it is enough for a torus
COMES_NEARER = 0.7  # what is left of the steps towards a period in the later half of the last part
ABOUT_ZERO = 0.06  # bits per period
CLEARLY = 3.0  # tolerances from its orbit within which a periodic motion has settled


def next_look(periods: int = 0) -> int:
    """After how many periods a motion is looked at next that was looked at after `periods`; 0: for the first time."""
    return max(FIRST_LOOK, 5 * math.ceil((0.3 if periods < LONG else 0.25) * periods))


def longer_decides(regime: str, reason: str) -> bool:
    """Whether a longer run may find another word: the regime is open, and not because of the errors of steps."""
    return regime in OPEN and BLURRED not in reason and OUTLASTS not in reason


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
    checked_count(max_period, "max_period")
    if periods < FIRST_LOOK:
        reason = f"too short: {next_look(FIRST_LOOK)} periods are needed for two looks, given {periods}"
        return Verdict("undecided", reason, (), None, len(x), 0, 0)
    last = _look(x, growth, periods, scale, tolerance, max_period)
    word, reason, evidence, period = last.word, last.reason, last.evidence, last.estimate.period
    *earlier, _ = looks(periods)  # the last one is at the end of the record
    twice = False
    if earlier:
        earlier_look = _look(x, growth, earlier[-1], scale, tolerance, max_period)
        twice = word == earlier_look.word or (period is not None and period == earlier_look.estimate.period)
    if word not in OPEN and not twice and not _alone(last, tighter is not None):
        word, reason = "undecided", f"{word} at the last look only: {reason}"
    if word == "chaotic" and tighter:
        latest = max(tighter)
        check = _tighter(tighter[latest])
        if latest == last.end or (check.passed and twice):  # chaos that goes on stays confirmed
            evidence.append(check)
            if not check.passed:
                word, reason = "undecided", f"chaotic at this tolerance, but {check.sentence}"
                if check.value < -check.threshold:
                    reason = f"{OF_STEPS}: {check.sentence}"
    reason += f", over periods {last.start} to {last.end}"
    start = last.start
    if not word.startswith("period"):
        return Verdict(word, reason, tuple(evidence), None, len(x) - start, 0, start)
    start = _settled(x, last.estimate)
    return Verdict(word, reason + _on_the_way(growth[:start]), tuple(evidence), period, len(x) - start, 0, start)


def growth_contradicts(word: str, growth: tuple[float, float], finer: tuple[float, float]) -> bool:
    """Whether perturbations grow on a finer grid in a way that contradicts the word for a motion.

    growth, finer: exponent and its standard error in bits per period, on the grid of the word and on the finer one.
    "chaotic" is contradicted if the growth on the finer grid is not above zero by two errors, or is smaller than the
    other by two errors of the difference. A period is contradicted if it is above zero by one error. NaN contradicts
    nothing.
    """
    value, error = finer
    if word == "chaotic":
        smaller = growth[0] - value > LATER * math.hypot(growth[1], error)
        return smaller or value <= LATER * error
    return word.startswith("period") and value > error


def looks(periods: int) -> Iterator[int]:
    """The looks at a run of so many periods; the last at its end where that is half-way to the next or further."""
    end = next_look()
    while end <= periods:
        yield end
        end, last = next_look(end), end
        if end > periods >= 0.5 * (last + end):
            yield periods


class _Look(NamedTuple):
    """What is found in the periods `start` to `end` of a record."""

    word: str
    reason: str
    evidence: list[Evidence]
    estimate: PeriodEstimate
    start: int
    end: int


def _alone(look: _Look, goes_on: bool) -> bool:
    """Whether one look is enough: a period after the first third, chaos that goes on at a tighter tolerance, a torus
    that is clearly one.
    """
    if look.end < LONG:
        return False
    if look.word.startswith("period"):
        bits = look.evidence[-1].value * (look.end - look.start)  # a slow torus repeats too, and hardly shrinks
        return look.start == look.end // 3 and look.evidence[-1].name == NO_GROWTH and bits < -SHEAR
    if look.word == "quasi-periodic":
        (exponent,) = (item for item in look.evidence if item.name == "exponent")
        return abs(exponent.value) + CLEAR * exponent.error < ABOUT_ZERO
    return look.word == "chaotic" and goes_on


def _look(x, growth, end, scale, tolerance, max_period) -> _Look:
    """What the first `end` periods end in: a period where a later part repeats, else what they are after a third."""
    whole = look = _part(x, growth, end // 3, end, scale, tolerance, max_period)
    while not look.word.startswith("period"):
        start = (look.start + end) // 2
        if end - start < SHORTEST:
            return whole
        look = _part(x, growth, start, end, scale, tolerance, max_period)
    return look


def _part(x, growth, start, end, scale, tolerance, max_period) -> _Look:
    """What is found in periods `start` to `end`."""
    section = x[start : end + 1]
    estimate = detect_period(section, max_period, tolerance, scale)
    known = turned(growth[:end], start)
    (full,) = tangent_lyapunov(known)
    (later,) = tangent_lyapunov(known[len(known) // 2 :])
    evidence, repeats = period_evidence(estimate), ""

    def look(word: str, reason: str) -> _Look:
        return _Look(word, reason + repeats, evidence, estimate, start, end)

    rising = later.value > LATER * later.error
    if later.found:
        sentence = "bits per period in the later half, which have to be positive by two errors for chaos"
        evidence.append(Evidence("later half", later.value, LATER * later.error, rising, sentence, later.error))
    if estimate.period is not None:
        shrinks, without_growth = evidence[1].passed is not False, not np.isfinite(growth[:end]).any()
        evidence.append(_confirmation(estimate, full, later, len(known)))
        if (evidence[-1].passed or without_growth) and (later.found or shrinks):
            reason = estimate.reason
            if later.found:
                pace = f"grow by less than {SEEN:g} bits per period"
                if evidence[-1].value < 0.0:
                    pace = "shrink"
                reason += f"; perturbations {pace}"
            elif not evidence[-1].passed:
                reason += "; a slow torus may repeat as closely, so that only an orbit or perturbations decide"
            return look(f"period-{estimate.period}", reason)
        repeats = f"; yet the strobed state {estimate.reason}"
    if not later.found:
        too_few = f"perturbations over {len(known)} periods only: {2 * LEAST_PERIODS} are needed"
        regime = "transient" if _comes_nearer(estimate) else "undecided"
        return look(regime, too_few)
    exponent, bits = full.value, full.value * len(known)
    positive, grown = exponent > POSITIVE * full.error, bits > LEAST_BITS
    sentence = f"bits per period, of the tangent dynamics over {len(known)} periods"
    evidence += [
        Evidence("exponent", exponent, POSITIVE * full.error, positive, sentence, full.error),
        Evidence("growth", bits, LEAST_BITS, grown, "bits by which a perturbation grew in all"),
    ]
    rate = f"{exponent:.3f} ± {full.error:.3f} bits per period"
    if rising and positive and grown:
        return look("chaotic", f"perturbations grow by {rate}, and so they do in the later half")
    if repeats:
        return look("undecided", f"perturbations grow by {rate}: they may grow, or this may be a slow torus")
    bound = abs(exponent) + 2.0 * full.error
    about_zero = bound < ABOUT_ZERO and (bits < SHEAR or exponent < LATER * full.error)
    sentence = f"|exponent| and two errors, bits per period; if it is positive, less than {SHEAR:g} bits in all"
    evidence.append(Evidence("about zero", bound, ABOUT_ZERO, about_zero, sentence))
    neighbours = growth_evidence(section, tolerance)
    drift = drift_evidence(section, neighbours)
    evidence += [neighbours, drift]
    if drift.passed:
        return look("transient", drift.sentence)
    if exponent + LATER * full.error < 0.0:
        shrinking = f"perturbations shrink ({rate})"
        if bits < -FORGOTTEN:
            return look("undecided", f"{shrinking} until the start is forgotten, but no period is met: {BLURRED}")
        return look("transient", f"{shrinking}, but no period is met yet")
    if about_zero and neighbours.passed:
        evidence.append(incommensurate_evidence(section, max_period))
        if evidence[-1].passed:
            reason = f"neighbours stay neighbours, a line is incommensurate, and perturbations grow by {rate}"
            return look("quasi-periodic", reason)
    lacking = [item.name for item in evidence if item.passed is False]
    return look("undecided", f"no period; {rate}; not met: {', '.join(lacking)}")


def _confirmation(estimate: PeriodEstimate, full: Exponent, later: Exponent, periods: int) -> Evidence:
    """The test that a state which repeats should pass, because the rest of the system need not repeat with it.

    full, later: exponents of the part, of so many periods, and of its later half. Without them, and where perturbations
    hardly shrink, the state has to repeat more closely than within the tolerance: a buoy misses its period by more than
    a fifth of it where its rope is chaotic, and on a torus beside a resonance its small steps add up to more.
    """
    bound = CLOSELY * estimate.tolerance
    missed = max(estimate.residual[estimate.period - 1], estimate.projected[estimate.period - 1])
    if later.found:
        largest = min(full.value + LATER * full.error, later.value + LATER * later.error)
        rising = later.value > LATER * later.error
        sentence = "bits per period by which perturbations grow at most, two errors included"
        settled = missed <= bound or full.value * periods < -SHEAR
        return Evidence(NO_GROWTH, largest, SEEN, largest < SEEN and not rising and settled, sentence)
    sentence = "share of the scale by which the period is missed, drift to come included, where no perturbations tell"
    return Evidence(CLOSE, missed, bound, missed <= bound, sentence)


def _comes_nearer(estimate: PeriodEstimate):
    """Whether the steps of the nearest period, or of a divisor, shrink: it will be told without perturbations."""
    if estimate.period is not None or not np.isfinite(estimate.residual).any():
        return False
    nearest = int(np.nanargmin(estimate.residual)) + 1
    trends = [estimate.trend_nats_per_period[d - 1] for d in range(1, nearest + 1) if nearest % d == 0]
    return math.exp(min(trends) * (estimate.points // 4)) < COMES_NEARER


def _settled(x, estimate: PeriodEstimate):
    """The period from which on a periodic motion is on its orbit."""
    orbit = estimate.orbit[(np.arange(len(x)) - len(x)) % estimate.period]
    off_orbit = np.abs(x - orbit) / estimate.scale > CLEARLY * estimate.tolerance
    off = np.flatnonzero(off_orbit.any(axis=1))
    return int(off[-1]) + 1 if len(off) else 0


def _on_the_way(growth):
    """What a periodic motion went through before, where that was chaos."""
    (exponent,) = tangent_lyapunov(growth[np.isfinite(growth)])
    chaos = exponent.found and exponent.value > POSITIVE * exponent.error
    return f", after a chaotic transient of {len(growth)} periods" if chaos else ""


def _tighter(exponent):
    if not exponent.found:
        sentence = f"no exponent at a tighter tolerance: {exponent.reason}"
        return Evidence("tighter tolerance", np.nan, 0.0, False, sentence)
    passed = exponent.value > LATER * exponent.error
    grows = "grow too" if passed else "do not grow for certain"
    if exponent.value < -LATER * exponent.error:
        grows = "shrink"
    sentence = (
        f"at a tighter tolerance perturbations {grows}: {exponent.value:.3f} ± {exponent.error:.3f} bits per period"
    )
    return Evidence("tighter tolerance", exponent.value, LATER * exponent.error, passed, sentence, exponent.error)
