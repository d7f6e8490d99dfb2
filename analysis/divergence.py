"""The exponent from the mean growth of many neighbours (Rosenstein et al. 1993).

    y(k) = < ln |X_{i+k} - X_{j(i)+k}| >_i        j(i): the nearest neighbour of point i

The exponent is the slope of y(k) against time in its scaling region, which is part of the answer. The method replaces
no neighbours, and a curve that bends everywhere shows that there is no exponent to be had. In return it uses only
neighbours as near as the record has, and averages the logarithm over the whole attractor.

Growth between neighbours starts with a transient (the vector turns towards the fastest direction), is exponential while
distances are small, and ends at the size of the attractor. Only the middle is a Lyapunov exponent, and a curve without
a straight middle has none to give, however well a line may be put through it.

The slope is too small, because noise lifts the begin of the curve and the size of the attractor bends its end. So

    error^2 = (scatter of the slopes of the four quarters of the region)^2 + (scatter of eight blocks of pairs)^2
              + (slope over the nearer half of the pairs - slope over the farther half)^2

The value is not corrected: it stays what Rosenstein's method gives. In flows with 1 % of noise it can be too small by
three errors.
"""

from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from analysis.embedding import choose_embedding, delay_vectors
from analysis.exponents import Exponent, no_exponent
from analysis.neighbours import nearest_outside
from analysis.sampling import checked_positive, checked_series, locked, record_of_numbers, standard_error

ROSENSTEIN = "Rosenstein, Collins & De Luca 1993"
LEAST_SAMPLES = 200
CENTRES = 2000
LEAST_CENTRES = 100
BLOCKS = 8
LEAST_SPAN_NATS = 1.0
LEAST_POINTS = 5
PIECES = 4
MOST_CURVATURE = 0.25


@record_of_numbers
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


def rosenstein_lyapunov(series: ArrayLike, step_s: float) -> Exponent:
    """Largest Lyapunov exponent from the mean logarithmic growth between nearest neighbours.

        y(k) = < ln |X_{i+k} - X_{j(i)+k}| >,    lambda = slope of y against k step_s in its scaling region

    series (n,)    any unit, evenly sampled
    step_s         sampling step [s], or 1 for a map
    The embedding is that of choose_embedding. Neighbours nearer in time than a mean period or the span of a delay
    vector do not count. k goes up to eight mean periods, at most a quarter of the record.
    Returns an Exponent [nats/time]; error: head of this file. NaN with a reason where no straight part of the curve
    spans one nat: regular motion, noise, or too short a record.
    details: time_s and curve (k,), region (ScalingRegion), embedding, dimension, theiler, centres, block_error,
    length_change.
    Raises ValueError for values that are not finite.
    Source: Rosenstein, Collins & De Luca, Physica D 65, 117 (1993).
    """
    x, step_s = checked_series(series), checked_positive(step_s, "step_s")
    if len(x) < LEAST_SAMPLES or np.ptp(x) == 0.0:
        return no_exponent(ROSENSTEIN, f"{LEAST_SAMPLES} samples of a series that moves are needed, given {len(x)}")
    embedding = choose_embedding(x)
    lag, m, period = embedding.lag, embedding.dimension, embedding.mean_period
    theiler, horizon = max(round(period), (m - 1) * lag), min(max(round(8 * period), 12), len(x) // 4)
    usable = len(x) - (m - 1) * lag - horizon
    if usable < LEAST_CENTRES + 2 * theiler:
        span = f"delay vectors of {(m - 1) * lag} samples and a horizon of {horizon}"
        return no_exponent(ROSENSTEIN, f"too short: {len(x)} samples for {span}")
    centres = np.arange(usable)
    if usable > CENTRES:
        centres = np.sort(np.random.default_rng(0).choice(usable, CENTRES, replace=False))
    # Zero: an exact repetition (periodic to the last digit), which has no logarithm.
    separations = _separations(delay_vectors(x, lag, m), centres, theiler, horizon, least=1e-12 * np.std(x))
    details = {"embedding": embedding, "dimension": m, "theiler": theiler}
    with np.errstate(divide="ignore"):
        return _slope_of(np.log(separations), step_s, period, details)


def _separations(points, centres, theiler, horizon, least):
    """Distances (horizon + 1, pairs) of the centres and their nearest neighbours, 0 ... horizon samples later; of those
    that are further apart than `least` at first."""
    neighbours, distance = nearest_outside(points[: len(points) - horizon], theiler, centres)
    usable = (neighbours[:, 0] >= 0) & (distance[:, 0] > least)
    centres, neighbours = centres[usable], neighbours[usable, 0]
    separations = np.empty((horizon + 1, len(centres)))
    for later in range(horizon + 1):
        separations[later] = np.linalg.norm(points[centres + later] - points[neighbours + later], axis=1)
    return separations


def _slope_of(growth, step_s, period, details):
    """The Exponent of ln(distance) (k, centres): mean curve, its scaling region, errors from bend and blocks."""
    # One pair that meets exactly would make the mean minus infinity.
    growth = growth[:, np.all(np.isfinite(growth), axis=0)]
    if growth.shape[1] < LEAST_CENTRES:
        return no_exponent(ROSENSTEIN, f"only {growth.shape[1]} points have neighbours; {LEAST_CENTRES} are needed")
    time_s, curve = step_s * np.arange(len(growth)), growth.mean(axis=1)
    # Distances along one coordinate swing twice in a mean period.
    cycle = round(period / 2) if period >= 6.0 else 1
    region = scaling_region(time_s, curve, cycle=cycle)
    details |= {"time_s": locked(time_s), "curve": locked(curve), "region": region, "centres": growth.shape[1]}
    if not np.isfinite(region.slope):
        return no_exponent(ROSENSTEIN, region.reason, details=details)
    part = slice(region.begin, region.end + 1)

    def slope(pairs):
        return np.polyfit(time_s[part], pairs[part].mean(axis=1), 1)[0]

    block_error = float(standard_error([slope(block) for block in np.array_split(growth, BLOCKS, axis=1)]))
    near, length_change = growth[0] <= np.median(growth[0]), 0.0
    if not near.all():
        length_change = float(slope(growth[:, near]) - slope(growth[:, ~near]))
    details |= {"block_error": block_error, "length_change": length_change}
    error = float(np.linalg.norm([region.error, block_error, length_change]))
    return Exponent(region.slope, error, "nats/time", ROSENSTEIN, region.reason, details)


def scaling_region(t: np.ndarray, y: np.ndarray, cycle: int = 1) -> ScalingRegion:
    """The longest part of a curve that rises by at least one nat and is straight.

    Straight: the slope of each quarter differs by at most 25 % from that of the whole (halves would not do: those of an
    S are alike). Among straight parts the one with the largest rise is taken. A swing of the curve with the motion is
    first averaged away over one `cycle`.

    t, y (k,)    the curve, evenly spaced in time
    cycle        points per swing that the curve carries (samples per mean period), 1 for a map; begin and end are then
                 those of the averaged curve, half a cycle inside what it used
    Returns a ScalingRegion, with NaN and the reason where no part qualifies.
    """
    cut = 0
    if len(y) > 2 * cycle:
        cut = cycle // 2
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
                if span >= LEAST_SPAN_NATS and (best is None or span > best[0]):
                    best = span, slope, np.std(pieces), begin, end - 1
    if best is None:
        why = "no straight rising part"
        if straight:
            why = f"no straight part spans {LEAST_SPAN_NATS:g} nat"
        return ScalingRegion(np.nan, np.nan, -1, -1, np.nan, f"{why}; the curve rises by {np.ptp(y):.2g} nats in all")
    span, slope, error, begin, end = best
    reason = f"straight from {t[begin]:.4g} to {t[end]:.4g}, rising by {span:.2g} nats"
    return ScalingRegion(slope, error, begin + cut, end + cut, span, reason)


def _line(t, y):
    """Slopes of the least-squares line and of those through its quarters, which share their ends."""
    ends = np.linspace(0, len(t) - 1, PIECES + 1).astype(int)
    pieces = [(y[b] - y[a]) / (t[b] - t[a]) for a, b in pairwise(ends)]
    centred = t - t.mean()
    return np.dot(centred, y) / np.dot(centred, centred), np.array(pieces)
