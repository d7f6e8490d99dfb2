"""Does a small motion grow or decay exponentially, does it come in bursts, or neither?

    |y|(t) ~ a e^{lambda t} g(t),   g bounded and recurring:   ln of the envelope is a straight line of slope lambda

The envelope is the largest |y| in each of a run of equal spans, taken at the time at which it occurs: a swing through
zero then leaves no dent, as long as a span holds half a swing. Growth that is over before there are enough such spans
is looked for once more in spans of one period, dents and all. A line can be put through any curve, so a rate is given
only where the curve has a straight part that

  1. rises or falls by at least `least_span` nats over at least LEAST_POINTS spans;
  2. is straight: each quarter has the slope of the whole to 25 %, or to two of its own standard errors, and the
     scatter about the line is at most a tenth of what the line spans;
  3. separates before from after: earlier spans lie on one side of its middle level, later ones on the other. A record
     that falls straight for a while between two bursts comes back, and is no decay.

Where there is none, bursts are looked for: maxima of the envelope of one period that stand `least_span` nats above the
dips on both of their sides (prominence), as far as they reach LEAST_SHARE of the largest of them.

What it cannot tell: luck. Where ln|y| is a random walk, three in ten records of 250 periods have such a part.
"""

from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from analysis.exponents import NATS_PER_TIME, Exponent, no_exponent
from analysis.sampling import checked_positive, checked_series, record, standard_error

METHOD = "straight part of the logarithm of the envelope"
LEAST_SPAN_NATS = 3.0
WINDOW_PERIODS = 4  # in a span of the envelope that is fitted: half a swing of y has to fit in
LEAST_POINTS = 9  # three to a quarter, which share their ends
QUARTERS = 4
MOST_CURVATURE = 0.25
MOST_SCATTER = 0.1
LEAST_SHARE = 0.01
_ENDS = 64  # candidates for each end of the straight part: enough to find it to two per cent of the record


@record
class Growth:
    """What a record of magnitudes does.

    kind            "growth", "decay", "bursts" or "neither"
    reason          one sentence: the window of the fit, the number of bursts, or what is lacking
    rate            Exponent in nats per unit of time with one standard error; NaN unless kind is growth or decay
    begin, end      first and last time of the fit; NaN where there is none
    span_nats       what the line spans between them, negative for a decay; NaN where there is none
    burst_time, burst_size (b,)     of the bursts, in order; empty unless kind is "bursts"
    """

    kind: str
    reason: str
    rate: Exponent
    begin: float
    end: float
    span_nats: float
    burst_time: np.ndarray
    burst_size: np.ndarray


def growth_or_bursts(magnitude: ArrayLike, step: float, period: float, least_span: float = LEAST_SPAN_NATS) -> Growth:
    """Growth, decay, bursts or neither of a record of magnitudes (rules at the head of this file).

    magnitude (n,)     |y| or y from t = 0, evenly sampled, any unit
    step, period       sampling step and forcing period, in one unit of time
    least_span         nats below which neither a rate nor a burst is spoken of
    Returns a Growth. Raises ValueError for values that are not finite, or a period below two steps.
    """
    y = np.abs(checked_series(magnitude, "magnitude"))
    step, period = checked_positive(step, "step"), checked_positive(period, "period")
    least_span = checked_positive(least_span, "least_span")
    if period < 2.0 * step:
        raise ValueError(f"period: at least two steps are needed, given {period!r} with steps of {step!r}")
    if not envelope_of(y, step, WINDOW_PERIODS * period)[1].any():
        reason = "every value is zero" if len(y) else "there are no values"
        return _without_rate("neither", reason)
    lacking = []
    for span in (WINDOW_PERIODS * period, period):
        time, size = envelope_of(y, step, span)
        bursts = _straight_part(time, size, least_span)
        if isinstance(bursts, Growth):
            return bursts
        lacking.append(bursts)
    bursts = _bursts(size, least_span)
    if not len(bursts):
        return _without_rate("neither", f"{lacking[0]}; no burst of {least_span:g} nats")
    reason = f"{lacking[0]}; {len(bursts)} burst{'s' if len(bursts) > 1 else ''} of at least {least_span:g} nats"
    return _without_rate("bursts", reason, time[bursts], size[bursts])


def envelope_of(magnitude: ArrayLike, step: float, span: float) -> tuple[np.ndarray, np.ndarray]:
    """Largest value in each complete span of a record, and when: (time (m,), size (m,)).

    magnitude (n,) from t = 0; step, span in one unit of time. The first span begins with the second sample, so that
    spans of one period hold each phase once.
    """
    y = np.asarray(magnitude, dtype=float)
    edges = np.rint(np.arange(0, int((len(y) - 1) * step / span * (1 + 1e-12)) + 1) * span / step).astype(int)
    last = [first + 1 + int(np.argmax(y[first + 1 : end + 1])) for first, end in pairwise(edges)]
    index = np.array(last, dtype=int)
    return index * step, y[index]


def _without_rate(kind, reason, time=(), size=()):
    bursts = np.array(time, dtype=float), np.array(size, dtype=float)
    return Growth(kind, reason, no_exponent(METHOD, reason), np.nan, np.nan, np.nan, *bursts)


def _straight_part(time, size, least_span):
    """Growth or decay by the straight part of ln(size) with the largest span, or the words for why there is none."""
    t, y = time[size > 0.0], np.log(size[size > 0.0])
    n = len(t)
    if n < LEAST_POINTS:
        return f"too short: {LEAST_POINTS} spans are needed, given {n}"
    stride = max(1, n // _ENDS)
    sums = _sums(t - t.mean(), y - y.mean())
    best, straight = None, False
    for begin in range(0, n - LEAST_POINTS + 1, stride):
        for end in range(n, begin + LEAST_POINTS - 1, -stride):
            slope, error = _slope(sums, begin, end)
            span = slope * (t[end - 1] - t[begin])
            if abs(span) < least_span or (best is not None and abs(span) <= abs(best[0])):
                continue
            scatter, quarters = _straightness(sums, begin, end, slope)
            if scatter is None or scatter > MOST_SCATTER * abs(span):
                continue
            straight = True
            if _separates(y, begin, end, slope):
                error = max(error, standard_error(quarters))
                best = span, slope, error, t[begin], t[end - 1]
    if best is not None:
        span, slope, error, begin, end = best
        reason, none = f"straight from {begin:.4g} to {end:.4g}, {span:+.2g} nats", np.empty(0)
        rate = Exponent(slope, error, NATS_PER_TIME, METHOD, reason)
        kind = "growth" if slope > 0 else "decay"
        return Growth(kind, reason, rate, begin, end, span, none, none)
    if straight:
        return "straight parts, but the record comes back to their level"
    return f"no straight part of {least_span:g} nats (the envelope spans {np.ptp(y):.2g} in all)"


def _sums(t, y):
    """Running sums of 1, t, y, t t, t y, y y: the line through any part then costs no pass over it."""
    columns = np.stack([np.ones_like(t), t, y, t * t, t * y, y * y])
    return np.concatenate([np.zeros((6, 1)), np.cumsum(columns, axis=1)], axis=1)


def _slope(sums, begin, end):
    """Least-squares slope of part [begin, end) and its standard error from the scatter about the line."""
    n, t, y, tt, ty, yy = sums[:, end] - sums[:, begin]
    across, ty_excess, up = tt - t * t / n, ty - t * y / n, yy - y * y / n
    slope = ty_excess / across
    return slope, np.sqrt(max(up - slope * ty_excess, 0.0) / max(n - 2.0, 1.0) / across)


def _straightness(sums, begin, end, slope):
    """Standard deviation about the line of part [begin, end) and slopes of its quarters; (None, None) where bent."""
    edges = begin + np.linspace(0, end - begin - 1, QUARTERS + 1).astype(int)
    quarters = []
    for first, last in pairwise(edges):
        slope_here, error = _slope(sums, first, last + 1)
        if slope_here * slope <= 0.0 or abs(slope_here - slope) > max(MOST_CURVATURE * abs(slope), 2.0 * error):
            return None, None
        quarters.append(slope_here)
    n, t, y, _, ty, yy = sums[:, end] - sums[:, begin]
    residual = max(yy - y * y / n - slope * (ty - t * y / n), 0.0)
    return np.sqrt(residual / n), quarters


def _separates(y, begin, end, slope):
    """Whether what comes before [begin, end) lies on one side of its middle level, what comes after on the other."""
    middle = 0.5 * (y[begin] + y[end - 1])
    earlier, later = y[:begin], y[end:]
    if slope < 0.0:
        earlier, later = later, earlier
    return np.all(earlier < middle) and np.all(later > middle)


def _bursts(size, least_span):
    """Indices of the bursts in an envelope (m,)."""
    from scipy.signal import find_peaks

    # A value of zero would have no logarithm; nothing smaller than a rounding error of the largest can be told from it.
    level = np.log(np.maximum(size, 1e-300))
    peaks, _ = find_peaks(level, prominence=least_span)
    return peaks[size[peaks] >= LEAST_SHARE * size[peaks].max()] if len(peaks) else peaks
