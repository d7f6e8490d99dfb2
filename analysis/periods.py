"""Period of a strobed motion: after how many forcing periods it repeats itself, within a stated tolerance.

For each candidate N the section is compared with itself N periods later,

    s_k = (x_{k+N} - x_k)/scale,     residual_N = max over the last part of the record of |s_k| (largest coordinate).

A small residual alone does not prove a period: a motion that creeps (a slow transient, or a torus seen at a close
return of its rotation number) has small steps that add up. So the steps are also compared with the next ones,

    multiplier_N = sum s_k . s_{k+N} / sum s_k . s_k,

which estimates the Floquet multiplier of the slowest decay: 0.9 creeps, -1/2 is noise about a fixed point (differences
of independent errors), 1 drifts without end. With the last step a and the multiplier m a geometric decay travels
a + a m + ... = a/(1 - m), and that, too, must fit in the tolerance. From few rounds m is rough: from 4 to 8 of them,
noise within the tolerance is taken for a drift about once in a hundred records, and the answer is None. Where fast
modes still ring, m is theirs, and a slow drift hides below them. So the last round of the record has to lie within
three tolerances of the mean orbit of the last part.

Noise just above the tolerance misses it at N and, by luck, meets it at 2 N or 13 N; and a slow mode of six forcing
periods, still dying out, repeats itself every six. So N counts only if every proper divisor misses clearly more than
the tolerance and than N: residual_d >= 3 max(residual_N, tolerance). And what d misses by may not be dying out: a
motion on its way to period d that jumps from side to side repeats after 2 d periods all the while. It dies out where it
shrinks over the last part, in the mean, by more than a twentieth of itself and by more than residual_N.
Related: the recurrence of states up to epsilon in ChaosTools.jl's and other packages' period counters, which take the
residual alone.
"""

import numpy as np
from numpy.typing import ArrayLike

from analysis.sampling import checked_columns, checked_count, checked_positive, record

LEAST_POINTS = 16
POINTS_PER_CANDIDATE = 4
CLEARLY_MORE = 3.0
FADES = 0.95  # the later half over the earlier one


@record
class PeriodEstimate:
    """What the strobed record says about its period; index N - 1 of each array belongs to candidate N.

    period                          smallest N that qualifies, or None
    reason                          one sentence: why this answer
    tolerance                       share of the scale
    scale (d,)                      what counts as 1 in each coordinate, in its unit
    residual (max_period,)          largest scaled change over N periods in the last part; NaN where not tested
    projected (max_period,)         the last steps with all later steps of a geometric decay added, scaled; inf where
                                    the steps do not shrink
    multiplier (max_period,)        estimated multiplier over N periods, see the head of this file
    trend_nats_per_period (max_period,)   ln(late residual/early residual) per forcing period over the last part:
                                    negative while a transient dies out, about 0 on an attractor
    points                          strobed points given
    orbit (period, d)               mean of each of the N points over the last part, in the order visited, the last one
                                    being where the record ends; None without a period
    """

    period: int | None
    reason: str
    tolerance: float
    scale: np.ndarray
    residual: np.ndarray
    projected: np.ndarray
    multiplier: np.ndarray
    trend_nats_per_period: np.ndarray
    points: int
    orbit: np.ndarray | None


def detect_period(
    strobed: ArrayLike, max_period: int = 16, tolerance: float = 1e-3, scale: ArrayLike | None = None
) -> PeriodEstimate:
    """The smallest period N <= max_period of a strobed motion within a tolerance, or None with the reason.

    N qualifies when, over the last part of the record (its last half, at least 3 N points),
        |x_{k+N} - x_k| <= tolerance * scale in every coordinate,
    the drift yet to come stays within the same bound, the record ends on the mean orbit, and no divisor of N does
    nearly as well (head of this file).
    Only N with 4 N points or more are tested, and none with fewer than 16 points in all.

    strobed (m,) or (m, d)   states once per forcing period, transient left out as far as known; an angle that turns
                             round and round must come as its cosine and sine
    max_period               largest N looked for
    tolerance                share of the scale; two branches nearer than this are one, up to three times this None
    scale                    number or (d,): the size of the motion in each coordinate, in its unit. Best is the range
                             of the motion WITHIN the forcing period (of r(t), not of strobed r). Default: the range of
                             the strobed points given - which a settled period-1 motion does not have: then its noise
                             is taken for motion and the answer is None
    Returns a PeriodEstimate. It says None - never a guess - for chaos, for a torus, for noise at the size of the
    tolerance, while a transient is still moving by more than it, and for a record that is too short. A torus or a
    chaotic band thinner than the tolerance is a period at that tolerance: confirm by a smaller one. Intermittent chaos
    can look periodic for as long as the last part of a record.
    Raises ValueError for values that are not finite, or a scale or tolerance that is not positive.
    Source: definition of a period-N motion of the stroboscopic map; close returns: Dirichlet's theorem.
    """
    x = checked_columns(strobed, "strobed")
    max_period = checked_count(max_period, "max_period")
    tolerance = checked_positive(tolerance, "tolerance")
    scale, rounding = _scale(x, scale)
    measures = np.full((4, max_period), np.nan)
    points = len(x)
    testable = min(max_period, points // POINTS_PER_CANDIDATE) if points >= LEAST_POINTS else 0
    for candidate in range(1, testable + 1):
        measures[:, candidate - 1] = _measure(x / scale, candidate, rounding / scale)
    residual, projected, _, trend = measures
    repeats = []
    for n in range(1, testable + 1):
        small = max(residual[n - 1], projected[n - 1]) <= tolerance
        if small and _end_off_orbit(x / scale, n) <= CLEARLY_MORE * tolerance:
            repeats.append(n)
    rivals = {n: _rivals(n, x / scale, residual, tolerance) for n in repeats}
    period = next((n for n in repeats if not rivals[n]), None)
    reason = _reason(period, rivals, points, testable, max_period, tolerance, residual, trend)
    orbit = None if period is None else _orbit(x, period)
    return PeriodEstimate(period, reason, tolerance, scale, *measures, points, orbit)


def _scale(x, given):
    """What counts as 1 per coordinate, and the size below which a difference is rounding of the coordinate itself."""
    largest = np.max(np.abs(x), axis=0, initial=0.0)
    rounding = 64 * np.finfo(float).eps * largest
    if given is None:
        span = np.ptp(x, axis=0) if len(x) else np.zeros(x.shape[1])
        # A coordinate that moves by its last digits only, or not at all, has no range to be measured by.
        scale = np.maximum(span, 1e-9 * largest)
        return np.where(scale > 0.0, scale, 1.0), rounding
    scale = np.asarray(given, dtype=float)
    if scale.shape not in ((), (1,), (x.shape[1],)) or not np.all(np.isfinite(scale) & (scale > 0.0)):
        raise ValueError(f"scale: one finite number > 0, or {x.shape[1]} of them, is needed, given {given!r}")
    return np.broadcast_to(scale, (x.shape[1],)).copy(), rounding


def _tail(points, candidate):
    """Length of the last part: half of the record, and at least three rounds, so that steps have next steps."""
    return max(-(-points // 2), 3 * candidate)


def _measure(x, n, rounding):
    """Residual, projected residual, multiplier and trend of one candidate, x being scaled."""
    tail = x[-_tail(len(x), n) :]
    step = tail[n:] - tail[:-n]
    step[np.abs(step) <= rounding] = 0.0
    size = np.max(np.abs(step), axis=1)
    square = np.sum(step[:-n] ** 2)
    multiplier = np.sum(step[:-n] * step[n:]) / square if square > 0.0 else 0.0
    last = size[-n:].max()
    projected = 0.0
    if multiplier < 1.0:
        projected = last / (1.0 - multiplier)
    elif last > 0.0:
        projected = np.inf
    early, late = size[: len(size) // 2].max(), size[-(len(size) // 2) :].max()
    trend = 0.0
    if early != late:
        with np.errstate(divide="ignore"):  # a half that stands still gives -inf or inf
            trend = (np.log(late) - np.log(early)) / (len(size) - len(size) // 2)
    return size.max(), projected, multiplier, trend


def _rivals(n, x, residual, tolerance):
    """{proper divisor of n: why n cannot be told from it}: it does nearly as well, or soon will. x: scaled."""
    rivals = {}
    for d in (d for d in range(1, n) if n % d == 0):
        tail = x[-_tail(len(x), d) :]
        step = tail[d:] - tail[:-d]
        rounds = max(len(step) // (2 * n), 1) * n  # steps of one kind come round after n
        early, late = (np.sqrt(np.mean(part**2)) for part in (step[:rounds], step[-rounds:]))
        if residual[d - 1] < CLEARLY_MORE * max(residual[n - 1], tolerance):
            rivals[d] = "noise at the size of the tolerance"
        elif late < FADES * early and early - late > residual[n - 1]:
            rivals[d] = "what tells them apart is dying out"
    return rivals


def _orbit(x, n):
    """Mean of every n-th point over the last part, in the order visited."""
    tail = x[-_tail(len(x), n) :]
    tail = tail[len(tail) % n :]
    return tail.reshape(-1, n, x.shape[1]).mean(axis=0)


def _end_off_orbit(x, n):
    """Largest distance of the last round and the point before it from the mean orbit of the last part; x: scaled."""
    orbit = _orbit(x, n)
    return np.max(np.abs(x[-n - 1 :] - np.vstack([orbit[-1:], orbit])))


def _reason(period, rivals, points, testable, max_period, tolerance, residual, trend):
    """One sentence on why the answer is what it is."""
    if period is not None:
        residual_here = residual[period - 1]
        return f"repeats after {period} forcing period(s) within {tolerance:g} of the scale ({residual_here:.2g})"
    if testable == 0:
        return f"too short: {LEAST_POINTS} strobed points are needed at least, given {points}"
    for repeats, closest in rivals.items():
        rival, why = next(iter(closest.items()))
        return (
            f"N = {repeats} is within the tolerance ({residual[repeats - 1]:.2g}) but cannot be told from "
            f"N = {rival} ({residual[rival - 1]:.2g}): {why}"
        )
    best = int(np.argmin(residual[:testable]))
    looked = f"no period up to {testable}"
    if testable < max_period:
        looked += f" (up to {max_period} needs {POINTS_PER_CANDIDATE * max_period} points, given {points})"
    if residual[best] <= tolerance:
        return f"{looked}: steps over {best + 1} periods are within the tolerance but add up to more, a drift"
    nearest = f"{looked}: the nearest, N = {best + 1}, misses by {residual[best]:.2g} of the scale"
    if -np.inf < trend[best] * (points // 4) < -np.log(2.0):  # the later half of the last part moves half as much
        periods_left = np.log(residual[best] / tolerance) / -trend[best]
        nearest += f", shrinking: a transient at this rate needs about {periods_left:.0f} more forcing periods"
    return nearest
