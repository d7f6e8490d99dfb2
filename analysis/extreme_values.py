"""Least and greatest value of a series, of each block of it, and the share of time below a threshold (slack)."""

from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from analysis.sampling import ON_SAMPLE, checked_not_negative, checked_positive, checked_series, record_of_numbers

RESOLVED = 25  # samples from crossing to crossing, on average: with fewer a crossing is anywhere between its samples


@record_of_numbers
class SlackFraction:
    """Share of the time with tension at or below a threshold.

    fraction       slack_s/record_s, 0 ... 1
    slack_s        time at or below the threshold [s]
    record_s       time looked at, transient left out [s]
    """

    fraction: float
    slack_s: float
    record_s: float


@record_of_numbers
class Extremes:
    """Least and greatest sample and when each is first reached; times from the first sample of the record [s]."""

    minimum: float
    minimum_time_s: float
    maximum: float
    maximum_time_s: float


def slack_fraction(
    tension_N: ArrayLike, step_s: float, threshold_N: float = 0.0, transient_s: float = 0.0
) -> SlackFraction:
    """Share of the time after a transient in which the tension is at or below a threshold.

        fraction = 1/t_r * measure{ t : T(t) <= threshold },   T linear between samples

    Crossings are interpolated, so the error is O(step^2) while the tension is smooth. Of a record with fewer than
    RESOLVED samples a crossing it is the share of its samples: there the line snaps within a step, and a chord from a
    slack sample to a snap would end the slack half a step too early, at every crossing.

    tension_N (n,)   samples from t = 0 [N]
    step_s           sampling step [s]
    threshold_N      0 is slack; a small positive value asks for "nearly slack" [N]
    transient_s      time left out at the start; need not be a multiple of the step [s]
    Returns a SlackFraction.
    Raises ValueError for values that are not finite, or a record that does not outlast the transient by some time.
    """
    x = checked_series(tension_N, "tension_N") - float(threshold_N)
    if np.isnan(threshold_N):
        raise ValueError("threshold_N: a number is needed, given NaN")
    first, time_s = _after(x, step_s, transient_s)
    if time_s[first] - transient_s > ON_SAMPLE * step_s:  # the record begins at the transient itself
        first -= 1
        x[first], time_s[first] = np.interp(transient_s / step_s, np.arange(len(x)), x), transient_s
    time_s, x = time_s[first:], x[first:]
    if len(x) < 2:
        raise ValueError("slack fraction: two samples at least are needed after the transient, given 1")
    left, right = x[:-1], x[1:]
    below = ((left <= 0.0) & (right <= 0.0)).astype(float)
    crossing = (left <= 0.0) != (right <= 0.0)
    below[crossing] = 0.5
    if len(x) >= RESOLVED * np.count_nonzero(crossing):
        depth = np.abs(np.minimum(left, right)[crossing])
        below[crossing] = depth / (depth + np.maximum(left, right)[crossing])
    slack_s, record_s = np.sum(below * np.diff(time_s)), time_s[-1] - time_s[0]
    return SlackFraction(min(slack_s / record_s, 1.0), slack_s, record_s)


def extremes(series: ArrayLike, step_s: float, transient_s: float = 0.0) -> Extremes:
    """The least and the greatest sample at or after the transient, each with its first time.

    Samples only: a peak shorter than the step is missed. Where a record keeps the extremes between its samples as
    series of their own (low, high), ask for the minimum of the one and the maximum of the other.

    series (n,)    samples from t = 0, any unit
    step_s         sampling step [s]
    transient_s    time left out at the start [s]
    Returns an Extremes.
    Raises ValueError for values that are not finite, or a record that ends within the transient.
    """
    x = checked_series(series)
    first, time_s = _after(x, step_s, transient_s)
    low, high = first + np.argmin(x[first:]), first + np.argmax(x[first:])
    return Extremes(x[low], time_s[low], x[high], time_s[high])


def block_maxima(series: ArrayLike, samples: int) -> np.ndarray:
    """The greatest sample of each whole block of a record: draws from one distribution, if blocks outlast the memory.

        M_j = max{ x_i : j samples <= i < (j + 1) samples }

    Two records of one chaotic motion agree in the distribution of M, and not in their histories (Gumbel, Statistics of
    Extremes, 1958).

    series (n,)    samples, any unit; the transient left out
    samples        samples in a block, 1 or more
    Returns (n // samples,); what is left at the end counts for nothing.
    Raises ValueError for values that are not finite, or a block of less than a sample.
    """
    x = checked_series(series)
    if samples < 1:
        raise ValueError(f"samples: 1 or more are needed in a block, given {samples}")
    return x[: len(x) // samples * samples].reshape(-1, samples).max(axis=1)


def peaks(series: ArrayLike, level: float | None = None) -> np.ndarray:
    """Indices of the greatest sample between two up-crossings of a level: the peaks of a record, one a wave.

    series (n,)    samples, any unit; what comes before the first up-crossing and after the last one has no peak
    level          by default the mean
    Returns (p,) indices. Raises ValueError for values that are not finite.
    """
    x = checked_series(series)
    above = x > (np.mean(x) if level is None else level)
    crossings = np.flatnonzero(~above[:-1] & above[1:]) + 1
    return np.array([begin + int(np.argmax(x[begin:end])) for begin, end in pairwise(crossings)], dtype=int)


def _after(x, step_s, transient_s):
    """The first sample at or after the transient, and the times of all."""
    step_s = checked_positive(step_s, "step_s")
    transient_s = checked_not_negative(transient_s, "transient_s")
    given_s = max(len(x) - 1, 0) * step_s
    if len(x) == 0 or given_s < transient_s - ON_SAMPLE * step_s:
        wanted = f"a record longer than the transient of {transient_s:g} s is needed"
        raise ValueError(f"{wanted}, given {given_s:g} s ({len(x)} samples)")
    return int(np.ceil(transient_s / step_s - ON_SAMPLE)), step_s * np.arange(len(x))
