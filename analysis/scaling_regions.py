"""The straight part of a curve of ln(distance) against time: found by a rule, stated, or refused.

Growth between neighbours starts with a transient (the vector turns towards the fastest direction), is exponential while
distances are small, and ends at the size of the attractor. Only the middle is a Lyapunov exponent, and a curve without
a straight middle has none to give, however well a line may be put through it.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from analysis.sampling import checked_series

LEAST_SPAN_NATS = 1.0
LEAST_POINTS = 5
PIECES = 4
MOST_CURVATURE = 0.25


@dataclass(frozen=True)
class ScalingRegion:
    """A straight part of y(t).

    slope        of the least-squares line; NaN where there is no region
    error        standard deviation of the slopes of its four quarters: what the line's curvature leaves open
    begin, end   first and last index of the region, inclusive; -1 where there is none
    span         rise of the line over the region [nats]
    reason       one sentence
    """

    slope: float
    error: float
    begin: int
    end: int
    span: float
    reason: str


def scaling_region(
    time: ArrayLike, curve: ArrayLike, least_span: float = LEAST_SPAN_NATS, cycle: int = 1
) -> ScalingRegion:
    """The longest part of a curve that rises by at least one nat and is straight.

    Straight: the slope of each quarter differs by at most 25 % from that of the whole (halves would not do: those of an
    S are alike). Among straight parts the one with the largest rise is taken. A swing of the curve with the motion is
    first averaged away over one `cycle`.

    time, curve (k,)    the curve, evenly spaced in time; NaN not allowed
    least_span          least rise [nats]
    cycle               points per swing that the curve carries (samples per mean period), 1 for a map; begin and end
                        are then those of the averaged curve, half a cycle inside what it used
    Returns a ScalingRegion, with NaN and the reason where no part qualifies.
    Raises ValueError for values that are not finite or arrays of different length.
    """
    t, y = checked_series(time, "time"), checked_series(curve, "curve")
    if len(t) != len(y):
        raise ValueError(f"time and curve: equal lengths are needed, given {len(t)} and {len(y)}")
    cut = cycle // 2 if len(y) > 2 * cycle else 0
    if len(y) > 2 * cycle:
        width = 2 * cut + 1
        t, y = t[cut : len(t) - cut], np.convolve(y, np.full(width, 1.0 / width), mode="valid")
    # About forty ends are enough to find the region to a few per cent of its length.
    stride = max(1, len(t) // 120)
    best, straight = None, False
    for begin in range(0, len(t) - LEAST_POINTS + 1, stride):
        for end in range(begin + LEAST_POINTS, len(t) + 1, stride):
            slope, pieces = _line(t[begin:end], y[begin:end])
            span = slope * (t[end - 1] - t[begin])
            if slope > 0.0 and np.max(np.abs(pieces - slope)) <= MOST_CURVATURE * slope:
                straight = True
                if span >= least_span and (best is None or span > best[0]):
                    best = span, slope, float(np.std(pieces)), begin, end - 1
    if best is None:
        why = f"no straight part spans {least_span:g} nat" if straight else "no straight rising part"
        return ScalingRegion(np.nan, np.nan, -1, -1, np.nan, f"{why}; the curve rises by {np.ptp(y):.2g} nats in all")
    span, slope, error, begin, end = best
    reason = f"straight from {t[begin]:.4g} to {t[end]:.4g}, rising by {span:.2g} nats"
    return ScalingRegion(float(slope), error, begin + cut, end + cut, float(span), reason)


def _line(t, y):
    """Slopes of the least-squares line and of those through its quarters, which share their ends."""
    ends = np.linspace(0, len(t) - 1, PIECES + 1).astype(int)
    pieces = [(y[b] - y[a]) / (t[b] - t[a]) for a, b in pairwise(ends)]
    centred = t - t.mean()
    return np.dot(centred, y) / np.dot(centred, centred), np.array(pieces)
