"""The least and greatest value of a series, and the share of time that it spends at or below one (a slack tether)."""

import numpy as np
from numpy.typing import ArrayLike

from analysis.sampling import ON_SAMPLE, checked_not_negative, checked_positive, checked_series, record_length_s


def slack_fraction(tension_N: ArrayLike, step_s: float, threshold_N: float = 0.0, transient_s: float = 0.0) -> float:
    """Share of the time after a transient in which the tension is at or below a threshold.

        fraction = 1/t_r * measure{ t : T(t) <= threshold },   T linear between samples

    Crossings are interpolated, so the error is O(step^2) while the tension is smooth; it is not the share of samples.

    tension_N (n,)   samples from t = 0 [N]
    step_s           sampling step [s]
    threshold_N      0 is slack; a small positive value asks for "nearly slack" [N]
    transient_s      time left out at the start; need not be a multiple of the step [s]
    Returns the share, 0 ... 1.
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
    depth = np.abs(np.minimum(left, right)[crossing])
    below[crossing] = depth / (depth + np.maximum(left, right)[crossing])
    return min(float(np.sum(below * np.diff(time_s))) / float(time_s[-1] - time_s[0]), 1.0)


def extremes(series: ArrayLike, step_s: float, transient_s: float = 0.0) -> tuple[float, float]:
    """The least and the greatest sample at or after the transient.

    Samples only: a peak shorter than the step is missed. Where a record keeps the extremes between its samples as
    series of their own (low, high), ask for the minimum of the one and the maximum of the other.

    series (n,)    samples from t = 0, any unit
    step_s         sampling step [s]
    transient_s    time left out at the start [s]
    Returns (least, greatest), in the unit of the series.
    Raises ValueError for values that are not finite, or a record that ends within the transient.
    """
    x = checked_series(series)
    settled = x[_after(x, step_s, transient_s)[0] :]
    return float(settled.min()), float(settled.max())


def _after(x, step_s, transient_s):
    """The first sample at or after the transient, and the times of all."""
    step_s = checked_positive(step_s, "step_s")
    transient_s = checked_not_negative(transient_s, "transient_s")
    given_s = record_length_s(len(x), step_s)
    if len(x) == 0 or given_s < transient_s - ON_SAMPLE * step_s:
        wanted = f"a record longer than the transient of {transient_s:g} s is needed"
        raise ValueError(f"{wanted}, given {given_s:g} s ({len(x)} samples)")
    return int(np.ceil(transient_s / step_s - ON_SAMPLE)), step_s * np.arange(len(x))
