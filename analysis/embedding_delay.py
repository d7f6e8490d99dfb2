"""Delay vectors (Takens 1981) and the delay by average mutual information (Fraser & Swinney 1986).

X_i = (x_i, x_{i+L}, ..., x_{i+(m-1)L}),     i = 0 ... n - 1 - (m-1)L                 L in samples, m the dimension

I(L) = sum_ab p_ab(L) ln[ p_ab(L)/(p_a p_b) ]     nats; p_ab: share of pairs (x_i, x_{i+L}) in cell (a, b)
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from analysis.sampling import checked_count, checked_series, locked

LEAST_SAMPLES_PER_PERIOD = 6.0
PERIODS_SEARCHED = 3.0


@dataclass(frozen=True, eq=False)
class DelayChoice:
    """A delay and the curve from which it was read.

    delay                    [samples]
    reason                   one sentence: first minimum, or what was taken for want of one
    information (k + 1,)     I(L) at L = 0 ... k [nats]; I(0) is the entropy of the cells
    bias                     what independent samples would show on average, (cells - 1)^2/(2 pairs) [nats]
    cells                    cells per axis, equally filled
    mean_period              mean period of the series [samples]
    """

    delay: int
    reason: str
    information: np.ndarray
    bias: float
    cells: int
    mean_period: float


def delay_vectors(series: ArrayLike, delay: int, dimension: int) -> np.ndarray:
    """The delay vectors of a series, one a row.

    series (n,)    samples, any unit
    delay          L [samples]
    dimension      m
    Returns a float array (n - (m-1) L, m); row i begins with sample i.
    Raises ValueError for values that are not finite, or a series too short for a single vector.
    Source: Takens, Lecture Notes in Mathematics 898, 366 (1981).
    """
    x = checked_series(series)
    delay, dimension = checked_count(delay, "delay"), checked_count(dimension, "dimension")
    rows = len(x) - (dimension - 1) * delay
    if rows < 1:
        wanted = f"delay vectors of dimension {dimension} and delay {delay} need {(dimension - 1) * delay + 1} samples"
        raise ValueError(f"{wanted}, given {len(x)}")
    return np.stack([x[j * delay : j * delay + rows] for j in range(dimension)], axis=1)


def mean_period(series: ArrayLike) -> float:
    """Mean period of a series in samples: the reciprocal of the mean frequency of its power spectrum.

        f = sum_k f_k |X_k|^2 / sum_k |X_k|^2,   mean removed, Hann window

    Half the range for a constant series (nothing oscillates). Used by Rosenstein et al. (1993) for the Theiler window;
    here also as the unit of evolution times. A broad-band signal, or strong white noise, shortens it.
    Raises ValueError for values that are not finite.
    """
    x = checked_series(series)
    if len(x) < 4:
        return 0.5 * max(len(x), 1)
    power = np.abs(np.fft.rfft((x - x.mean()) * np.hanning(len(x)))) ** 2
    weighted = np.sum(np.fft.rfftfreq(len(x)) * power)
    return float(min(np.sum(power) / weighted, 0.5 * len(x))) if weighted > 0.0 else 0.5 * len(x)


def mutual_information(series: ArrayLike, max_delay: int, cells: int | None = None) -> tuple[np.ndarray, int]:
    """Average mutual information I(L) of a series with itself L samples later [nats], L = 0 ... max_delay.

    The cells hold equal shares of the samples, so I does not change under any monotone rescaling of the series.
    cells    per axis; None: (pairs/20)^(1/2), 4 ... 32, so that even full scatter leaves about 20 pairs a cell
    Returns (information (max_delay + 1,), cells).
    Raises ValueError for values that are not finite, or max_delay not below half the length.
    Source: Fraser & Swinney, Physical Review A 33, 1134 (1986), on a fixed partition.
    """
    x = checked_series(series)
    max_delay = checked_count(max_delay, "max_delay")
    if max_delay >= len(x) // 2:
        raise ValueError(f"max_delay: less than half of the {len(x)} samples is needed, given {max_delay}")
    if cells is None:
        cells = int(np.clip(np.sqrt(len(x) / 20.0), 4, 32))
    cells = checked_count(cells, "cells", least=2)
    # Equal values share a cell: ranks by value, not by order, or a constant stretch would be cut by chance.
    edges = np.quantile(x, np.arange(1, cells) / cells)
    label = np.searchsorted(edges, x, side="right")
    information = np.empty(max_delay + 1)
    for lag in range(max_delay + 1):
        joint = np.bincount(label[: len(x) - lag] * cells + label[lag:], minlength=cells * cells).astype(float)
        joint = joint.reshape(cells, cells) / (len(x) - lag)
        independent = joint.sum(axis=1, keepdims=True) * joint.sum(axis=0, keepdims=True)
        filled = joint > 0.0
        information[lag] = np.sum(joint[filled] * np.log(joint[filled] / independent[filled]))
    return information, cells


def choose_delay(series: ArrayLike, max_delay: int | None = None) -> DelayChoice:
    """Delay at the first minimum of the average mutual information.

    A minimum is a lag that no other within a tenth of a mean period undercuts, I being smoothed over (1/4, 1/2, 1/4):
    the scatter of I makes shorter dips by chance. (To ask for a depth as well loses the well-known shallow minimum of
    the Lorenz system.) The delay is never longer than a quarter of the mean period, the lag
    at which a sine and its delayed copy are independent: a motion that hops between two wells loses information for
    many swings, and vectors that span several of them are folded by the dynamics. A quarter is also taken where there
    is no minimum. A series with fewer than six samples per mean period (a map, a strobed record) has nothing between
    its samples: delay 1.

    series (n,)    samples, any unit
    max_delay      largest lag looked at [samples]; None: three mean periods
    Returns a DelayChoice; `reason` says which rule spoke, `information` is the curve to draw.
    Raises ValueError for values that are not finite or fewer than 50 samples.
    Source: Fraser & Swinney, Physical Review A 33, 1134 (1986).
    """
    x = checked_series(series)
    if len(x) < 50:
        raise ValueError(f"series: 50 samples at least are needed, given {len(x)}")
    period = mean_period(x)
    longest = len(x) // 2 - 1
    if max_delay is None:
        max_delay = int(min(max(np.ceil(PERIODS_SEARCHED * period), 10), longest))
    information, cells = mutual_information(x, max_delay)
    bias = (cells - 1) ** 2 / (2.0 * len(x))
    if period < LEAST_SAMPLES_PER_PERIOD:
        delay, reason = 1, f"delay 1: {period:.2g} samples per mean period leave nothing between the samples"
    else:
        quarter = max(1, round(period / 4))
        minimum = _first_minimum(information, max(1, round(period / 10)))
        delay = quarter if minimum is None else min(minimum, quarter)
        reason = f"first minimum of the mutual information, {information[delay]:.3g} nats"
        if delay != minimum:
            found = f"at {minimum}" if minimum else f"none up to {max_delay}"
            reason = f"a quarter of the mean period; first minimum of the mutual information: {found} samples"
    return DelayChoice(delay, reason, locked(information), bias, cells, period)


def _first_minimum(information, reach):
    """First lag that no other within `reach` on either side undercuts, or None; smoothed over three lags."""
    smooth = information.copy()
    smooth[1:-1] = 0.25 * information[:-2] + 0.5 * information[1:-1] + 0.25 * information[2:]
    for lag in range(1, len(smooth) - reach):
        if smooth[lag] <= smooth[max(lag - reach, 0) : lag + reach + 1].min() < smooth[lag + reach]:
            return lag
    return None
