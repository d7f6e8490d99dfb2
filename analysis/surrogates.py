"""Chaos or a null hypothesis? Surrogate records, and the rank of a record among them.

Two nulls that chaos has to beat, both for a section (one row a forcing period) or any evenly sampled record:

IAAFT: "a stationary linear stochastic process, seen through a static, invertible, possibly nonlinear instrument".
    Surrogates have every value of the record, reordered, and its power spectrum. Several coordinates keep their phase
    differences, so that a linear process in many coordinates (position and velocity) is within the null.
Noisy periodic: "a periodic or quasi-periodic motion plus noise". The lines of the spectrum (`spectral_lines`) are kept
    as they are, amplitude, frequency and phase; what is left is replaced by an IAAFT surrogate of itself, so that the
    noise has its level, its distribution and its spectrum.
Why not others: IAAFT alone is beaten by any motion of many lines with bounded noise (a noisy period-8), since it
    randomises the phases of the lines. Shuffling whole cycles (Theiler 1995) is the special case of white residuals of
    a period-1 motion, beaten by anything with memory. The pseudo-periodic surrogates of Small, Yu & Harrison (2001)
    add noise of a chosen radius to a motion that has its own already: the record is then smoother than its surrogates
    whether it is chaotic or not, and the radius decides the outcome.

The statistic is the gain of prediction (`section_maps`). A rank test that can no longer be won is stopped.
"""

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike

from analysis.line_spectra import spectral_lines
from analysis.sampling import checked_columns, checked_count, checked_series, record
from analysis.section_maps import prediction_gain

LEAST_POINTS = 32
SHARE = 0.95
LEAST_SURROGATES = 19  # that can show this share
Seed = int | list[int]
# The order mostly stops changing by 50; with several columns it may go on over pairs of nearly equal values.
MOST_ROUNDS = 100
NULLS = "linear null", "noisy-periodic null"
# More points make a map no clearer, and surrogates of them take long.
NULL_POINTS = 1000
AT_ONCE = 4  # surrogates made together


@record
class NullRank:
    """Where a record stands among its surrogates.

    above            True where more than the asked share of the surrogates lies below the record; None: not known
    share_below      share of the surrogates with a smaller statistic (equal ones count half)
    advantage        statistic of the record less the median of the surrogates'; its unit
    statistic        of the record
    surrogates (s,)  of the surrogates
    """

    above: bool | None
    share_below: float
    advantage: float
    statistic: float
    surrogates: np.ndarray


def iaaft_surrogates(series: ArrayLike, count: int = 1, seed: Seed = 0) -> np.ndarray:
    """Surrogates of a linear stochastic process: the values of the record exactly, its power spectrum closely.

    Alternates between the record's Fourier amplitudes (with the surrogate's phases) and the record's values (in the
    surrogate's order) from a random order until the order no longer changes; the values have the last word.

    series (n,) or (n, d)   any unit; 32 samples at least. With several columns each keeps its own values and spectrum,
                            and the phase differences between columns as closely as these allow
    count, seed             how many, and the seed they follow from
    Returns an array (count, n) or (count, n, d). A transform takes the record as one period of a cycle: a record whose
    ends do not match (a trend, a slow motion cut anywhere) puts that jump into every surrogate. The spectrum
    comes out within a few per cent; within 10 to 30 % where a few large values carry it (heavy tails): take
    `normal_scores` of such a record first.
    Raises ValueError for values that are not finite or fewer than 32 samples.
    Source: T. Schreiber & A. Schmitz, Phys. Rev. Lett. 77 (1996) 635; several columns: Physica D 142 (2000) 346.
    """
    return _drawn(series, count, seed, lambda columns: 0.0)


def noisy_periodic_surrogates(series: ArrayLike, count: int = 1, seed: Seed = 0) -> np.ndarray:
    """Surrogates of a periodic or quasi-periodic motion in noise: the record's spectral lines plus a redrawn rest.

        surrogate_k = lines_k + IAAFT surrogate of (series - lines)_k

    series (n,) or (n, d)   as for iaaft_surrogates
    count, seed             how many, and the seed they follow from
    Returns an array (count, n) or (count, n, d). A clean periodic or quasi-periodic record comes back almost unchanged:
    it is its own null. A record without lines gives IAAFT surrogates.
    Raises ValueError for values that are not finite or fewer than 32 samples.
    Source: the null of J. Theiler (Phys. Lett. A 196 (1995) 335) and M. Small, D. Yu & R. G. Harrison (Phys. Rev. Lett.
    87 (2001) 188101), made by line removal; why: head of this file.
    """
    return _drawn(series, count, seed, lambda columns: spectral_lines(columns).fitted)


def normal_scores(series: ArrayLike) -> np.ndarray:
    """The record with each column's values replaced by those of a normal distribution in the same order.

        y_k = Phi^-1((rank_k - 1/2)/n)

    undoes any increasing, static distortion of a Gaussian process, so that "linear, seen through an instrument" becomes
    "linear and Gaussian". A map from one point to the next stays a map. Equal values get their mean rank.

    series (n,) or (n, d)   any unit
    Returns an array of the same shape, without unit.
    Raises ValueError for values that are not finite.
    Source: J. Theiler et al., Physica D 58 (1992) 77, the first step of amplitude-adjusted surrogates.
    """
    from scipy.special import ndtri
    from scipy.stats import rankdata

    x = checked_series(series, "series", dimensions=(1, 2))
    return ndtri((rankdata(x, axis=0) - 0.5) / max(len(x), 1))


def rank_among(statistic: float, surrogates: ArrayLike) -> NullRank:
    """Is the statistic of a record above SHARE of its surrogates'? One-sided rank test.

    statistic         of the record; larger speaks against the null
    surrogates (s,)   the same statistic of surrogates; enough of them that 1/(s + 1) <= 1 - share: 19 for 95 %
    Returns a NullRank. Under the null the record is one more draw, so that `above` has probability 1 - share at most.
    Raises ValueError for values that are not finite, or too few surrogates.
    Source: J. Theiler et al., Physica D 58 (1992) 77; ranks: Schreiber & Schmitz (2000), sec. 2.
    """
    drawn = checked_series(surrogates, "surrogates")
    value = float(checked_series([statistic], "statistic")[0])
    if len(drawn) < LEAST_SURROGATES:
        wanted = f"{LEAST_SURROGATES} at least are needed for a share of {SHARE:g}"
        raise ValueError(f"surrogates: {wanted}, given {len(drawn)}")
    below = (np.sum(drawn < value) + 0.5 * np.sum(drawn == value)) / len(drawn)
    above = np.sum(drawn >= value) <= _most_as_large(len(drawn))  # a tie counts against the record
    return NullRank(above, below, value - np.median(drawn), value, drawn)


def null_ranks(section: np.ndarray, surrogates: int, seed: Seed) -> list[NullRank]:
    """NullRank of the prediction gain for each of NULLS, NaN where a gain cannot be had; of the last 1000 points.

    The linear null is asked of the coordinates' normal scores: it allows any monotone instrument, and iterating towards
    a spectrum and a skew distribution at once reaches neither well enough (exp of a linear process, sampled often, beat
    its own surrogates in one case of ten). Normal scores undo the instrument first. For the other null that would not
    do: its noise is added to the motion as it is.
    """
    section = section[-NULL_POINTS:]
    ranks = []
    for i, points in enumerate((normal_scores(section), section)):
        gain = prediction_gain(points).gain
        fitted = spectral_lines(points).fitted if i and np.isfinite(gain) else 0.0
        rng = np.random.default_rng([*np.atleast_1d(seed), 100 + i])
        ranks.append(rank_until_lost(gain, _gains(points, fitted, rng), surrogates))
    return ranks


def _gains(points, fitted, rng):
    """Prediction gains of surrogates of what is left of a section beside the part `fitted`, one after another."""
    while True:
        for surrogate in fitted + _iaaft(points - fitted, AT_ONCE, rng):
            yield prediction_gain(surrogate).gain


def rank_until_lost(statistic: float, drawn: Iterator[float], surrogates: int) -> NullRank:
    """`rank_among` of a statistic among `surrogates` values of an iterator, which is asked for no more of them once so
    many are as large that the share cannot be reached; NaN where the statistic or one drawn is none."""
    allowed, values = _most_as_large(surrogates), []
    while np.isfinite(statistic) and len(values) < surrogates and np.sum(np.array(values) >= statistic) <= allowed:
        values.append(next(drawn))
        if not np.isfinite(values[-1]):
            break
    if not values or not np.isfinite(values[-1]):
        return NullRank(None, np.nan, np.nan, np.nan, np.empty(0))
    if len(values) == surrogates:
        return rank_among(statistic, values)
    below = np.mean(np.array(values) < statistic)
    return NullRank(False, below, statistic - np.median(values), statistic, np.array(values))


def _most_as_large(surrogates):
    """How many statistics of surrogates may be as large as the record's: of s + 1 equally likely places it must hold
    one of the best (1 - SHARE)(s + 1)."""
    return np.floor((1.0 - SHARE) * (surrogates + 1) + 1e-9) - 1.0


def _drawn(series, count, seed, fitted):
    """Surrogates of what is left of a record beside the part `fitted` (a function of its columns), with this part."""
    columns, count = checked_columns(series), checked_count(count, "count")
    if len(columns) < LEAST_POINTS:
        raise ValueError(f"series: {LEAST_POINTS} samples at least are needed for surrogates, given {len(columns)}")
    part = fitted(columns)
    surrogates = part + _iaaft(columns - part, count, np.random.default_rng(seed))
    return surrogates[:, :, 0] if np.ndim(series) == 1 else surrogates


def _iaaft(columns, count, rng):
    """(count, n, d) surrogates of (n, d) columns."""
    points, _ = columns.shape
    values = np.sort(columns, axis=0)
    transform = np.fft.rfft(columns, axis=0)
    amplitude, phase = np.abs(transform), np.exp(1j * np.angle(transform))
    start = np.array([rng.permutation(points) for _ in range(count)])
    surrogates = columns[start]  # one order for all columns: rows stay together
    order = np.full(surrogates.shape, -1)
    moving = np.arange(count)
    for _ in range(MOST_ROUNDS):
        current = np.fft.rfft(surrogates[moving], axis=1)
        # All columns turn by one angle a frequency, the one nearest to where they are: their differences stay.
        turn = np.sum(current * np.conj(phase) * amplitude, axis=2, keepdims=True)
        size = np.abs(turn)
        turn = np.where(size > 0.0, turn / np.where(size > 0.0, size, 1.0), 1.0)
        shaped = np.fft.irfft(amplitude * phase * turn, points, axis=1)
        new_order = np.argsort(shaped, axis=1, kind="stable")
        replaced = np.empty_like(shaped)
        np.put_along_axis(replaced, new_order, np.broadcast_to(values, shaped.shape), axis=1)
        surrogates[moving] = replaced
        changed = np.any(new_order != order[moving], axis=(1, 2))
        order[moving] = new_order
        moving = moving[changed]
        if len(moving) == 0:
            break
    return surrogates
