"""Motions in an irregular sea: is the start forgotten, how many responses are there, how long does each motion last?

A sea has no period and no section. Its exponent is the mean growth of an infinitesimal perturbation of the motion in
that sea, per peak period. If it is negative, all starts nearby come together, and the motion is a function of the sea
alone (a pullback attractor). How many such functions there are is the echo index (A. Ceni, P. Ashwin & L. Livi, Cogn.
Comput. 12 (2020) 330). If it is positive, starts stay apart for ever.

    responses   groups of starts: two are one group while their states are nearer to each other than a distance
    together    from the moment on at which all starts are one group for HOLD times in a row, to the next parting
    forecast    the motion of a regular wave as high as the envelope of the sea, which jumps only where it ends
"""

import math
from collections.abc import Sequence
from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike

from analysis.exponents import BITS_PER_PERIOD, Exponent, no_exponent
from analysis.sampling import (
    checked_count,
    checked_positive,
    checked_series,
    record,
    record_of_numbers,
    standard_error,
)
from analysis.tangent_growth import LEAST_PERIODS, METHOD, tangent_lyapunov, turned

BLOCKS = 6  # of a record, whose scatter bounds the error of its mean
HOLD = 10  # times in a row: states that only pass each other are not together


def sea_lyapunov(growths_nats: Sequence[ArrayLike], transient_periods: int = 0) -> Exponent:
    """The largest exponent of the motion in seas of one state, in bits per peak period.

    growths_nats (k,) of (m,)   of each sea, growth in each peak period [nats]; NaN before the perturbation is carried
    transient_periods           at the start of each that do not count; at least 10 more are left out (`turned`)
    Returns the mean over seas. The error of one sea is that of its slow fluctuations (`tangent_lyapunov`) or that of
    the scatter of its BLOCKS, whichever is larger, because groups of waves are slow; of three seas or more their
    scatter counts too. Deviations in such errors have a standard deviation of 1.0 to 1.2 where growth is remembered for
    ten periods and a sea has 400. NaN with the reason where no sea has 32 periods.
    """
    values, errors = [], []
    for growth_nats in growths_nats:
        growth = turned(np.asarray(growth_nats, dtype=float), transient_periods)
        if len(growth) < LEAST_PERIODS:
            continue
        (exponent,) = tangent_lyapunov(growth)
        values.append(exponent.value)
        errors.append(max(exponent.error, _error_of_blocks(growth / math.log(2.0))))
    if not values:
        return no_exponent(METHOD, f"too short: a sea of {LEAST_PERIODS} periods is needed", BITS_PER_PERIOD)
    value, error = mean_of_seas(values, errors)
    return Exponent(value, error, BITS_PER_PERIOD, METHOD, f"mean of {len(values)} seas", {"seas": values})


def mean_of_seas(values: Sequence[float], errors: Sequence[float]) -> tuple[float, float]:
    """Mean of a quantity over several seas, and its standard error: by the errors of the seas, or of three seas or more
    by their scatter if that is larger.
    """
    error = math.hypot(*errors) / len(values)
    if len(values) > 2:
        error = max(error, float(standard_error(values)))
    return float(np.mean(values)), error


def _error_of_blocks(values) -> float:
    length = len(values) // BLOCKS
    return float(standard_error(values[: BLOCKS * length].reshape(BLOCKS, length).mean(axis=1)))


def growing_share(growth_nats: ArrayLike, window: int) -> float:
    """Share of windows of so many periods in which a perturbation grows; NaN without a whole window.

    growth_nats (m,)   growth in each peak period [nats]
    """
    growth, window = checked_series(growth_nats, "growth_nats"), checked_count(window, "window")
    sums = growth[: len(growth) // window * window].reshape(-1, window).sum(axis=1)
    return float(np.mean(sums > 0.0)) if len(sums) else math.nan


@record
class Responses:
    """The responses of several starts to one sea.

    counts (n,)       how many there are at each time
    apart (n,)        largest distance of two starts, in the scale
    together_at       index of the time from which they are first together; NaN: never
    together_share    share of the time from then on; NaN: never
    together_mean     mean length of the times together, the last one up to the end of the record [samples]
    partings          how often they part
    noise             median of `apart` while together: what the steps of the solver leave
    """

    counts: np.ndarray
    apart: np.ndarray
    together_at: float
    together_share: float
    together_mean: float
    partings: int
    noise: float


def responses(states: ArrayLike, scale: ArrayLike, distance: float) -> Responses:
    """How many different responses several starts have in one sea, and when they come together.

    states (s, n, d)   of s starts at n times, for instance once a peak period
    scale (d,)         what counts as 1 in each coordinate
    distance           below which two states are one response, as a share of the scale
    Returns Responses. Raises ValueError for values that are not finite.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    x = checked_series(states, "states", dimensions=(3,)) / np.asarray(scale, dtype=float)
    starts, times, _ = x.shape
    checked_positive(distance, "distance")
    apart, first, second = np.zeros(times), [], []
    for one, other in combinations(range(starts), 2):
        between = np.abs(x[one] - x[other]).max(axis=1)
        apart = np.maximum(apart, between)
        near = np.flatnonzero(between < distance)
        first.append(near * starts + one)
        second.append(near * starts + other)
    rows, columns = np.concatenate([[], *first]).astype(int), np.concatenate([[], *second]).astype(int)
    pairs = coo_array((np.ones(len(rows)), (rows, columns)), shape=(times * starts, times * starts))
    _, labels = connected_components(pairs, directed=False)
    sorted_labels = np.sort(labels.reshape(times, starts), axis=1)
    counts = 1 + np.count_nonzero(np.diff(sorted_labels, axis=1), axis=1)

    spells = [(begin, end) for begin, end in spells_of(counts == 1) if end - begin >= HOLD]
    if not spells:
        return Responses(counts, apart, math.nan, math.nan, math.nan, 0, math.nan)
    begins, ends = np.array(spells).T
    lengths = ends - begins
    together = np.concatenate([np.arange(begin, end) for begin, end in spells])
    share = lengths.sum() / (times - begins[0])
    partings = int(np.count_nonzero(ends < times))
    noise = float(np.median(apart[together]))
    return Responses(counts, apart, float(begins[0]), share, float(lengths.mean()), partings, noise)


def spells_of(flags: ArrayLike) -> list[tuple[int, int]]:
    """First index and end (exclusive) of each run of true values."""
    padded = np.concatenate([[False], np.asarray(flags, dtype=bool), [False]]).astype(int)
    begins, ends = np.flatnonzero(np.diff(padded) > 0), np.flatnonzero(np.diff(padded) < 0)
    return list(zip(begins.tolist(), ends.tolist(), strict=True))


@record_of_numbers
class Residence:
    """How long a motion lasts: share of the time, mean length of a visit [samples], number of visits.

    A visit that begins or ends with the record counts with the length that is seen; NaN without a visit.
    """

    share: float
    mean: float
    visits: int


def residence(flags: Sequence[ArrayLike]) -> Residence:
    """The residence in a motion, from records (k,) of (n,) flags: true while the body is in it."""
    lengths = [end - begin for series in flags for begin, end in spells_of(series)]
    total = sum(map(len, flags))
    share = sum(lengths) / total if total else math.nan
    mean_length = float(np.mean(lengths)) if lengths else math.nan
    return Residence(share, mean_length, len(lengths))


def slow_forecast(amplitude: ArrayLike, ranges: ArrayLike, start: int) -> np.ndarray:
    """Which motion of regular waves a body would have if it followed a slow envelope: it jumps where its motion ends.

    amplitude (n,)   of the envelope
    ranges (k, 2)    least and largest amplitude at which each motion exists
    start            number of the first motion
    Returns the numbers (n,). Where a motion ends, the first of `ranges` that exists there follows; if none does, the
    motion stays.
    """
    a, limits = checked_series(amplitude, "amplitude"), np.asarray(ranges, dtype=float)
    exists = (limits[:, :1] <= a) & (a <= limits[:, 1:])
    current, motions = checked_count(start, "start", least=0), np.empty(len(a), dtype=int)
    for place in range(len(a)):
        if not exists[current, place] and exists[:, place].any():
            current = int(np.argmax(exists[:, place]))
        motions[place] = current
    return motions
