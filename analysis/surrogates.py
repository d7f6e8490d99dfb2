"""Chaos or a null hypothesis? Surrogate records, and the statistic in which chaos beats them: the gain of prediction.

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

The gain of prediction says how much better a nonlinear predictor knows the next point of a section than a linear one.
On a section of a deterministic motion the next point is a function of the present one. Two predictors of it, each
tested on points that it was not fitted to:

    linear    one affine map for all points, least squares; each point left out of its own fit in turn
    local     one affine map per point, least squares over its nearest neighbours, Theiler's window left out

    gain = ln(rms error of the linear)/(rms error of the local)          [nats]

A linear stochastic process has no use for neighbourhoods and pays for fewer data: its gain is below 0, whatever its
spectrum. A chaotic map folds, so that its gain is of the order of the nats of precision that the record resolves. The
gain is also high for periodic and quasi-periodic motions with or without noise: what it says about chaos is said by its
rank among the surrogates that keep the lines.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from analysis.line_spectra import spectral_lines
from analysis.neighbours import nearest_outside
from analysis.sampling import checked_columns, checked_count, checked_series, in_deviations, locked, states_of

LEAST_POINTS = 32
SHARE = 0.95
Seed = int | list[int]
# The order mostly stops changing by 50; with several columns it may go on over pairs of nearly equal values.
MOST_ROUNDS = 100
LEAST_PER_COORDINATE = 8
NEIGHBOURS_PER_COEFFICIENT = 2
NULLS = "linear null", "noisy-periodic null"
# More points make a map no clearer, and surrogates of them take long.
NULL_POINTS = 1000
# Directions in which neighbours lie this much closer than in their widest are not resolved by so few of them.
_RIDGE = 1e-3


@dataclass(frozen=True, eq=False)
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


@dataclass(frozen=True)
class PredictionGain:
    """Errors of two predictors of the next point, and their ratio.

    gain           ln(linear_error/local_error) [nats]; NaN where the test does not apply
    linear_error   rms over points and coordinates, each coordinate in units of its standard deviation
    local_error    the same for the local maps
    reason         one sentence
    """

    gain: float
    linear_error: float
    local_error: float
    reason: str


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


def rank_among(statistic: float, surrogates: ArrayLike, share: float = SHARE) -> NullRank:
    """Is the statistic of a record above the given share of its surrogates'? One-sided rank test.

    statistic         of the record; larger speaks against the null
    surrogates (s,)   the same statistic of surrogates; enough of them that 1/(s + 1) <= 1 - share: 19 for 95 %
    share             of the surrogates that have to lie below, in (0, 1)
    Returns a NullRank. Under the null the record is one more draw, so that `above` has probability 1 - share at most.
    Raises ValueError for values that are not finite, too few surrogates or a share outside (0, 1).
    Source: J. Theiler et al., Physica D 58 (1992) 77; ranks: Schreiber & Schmitz (2000), sec. 2.
    """
    drawn = checked_series(surrogates, "surrogates")
    value = float(checked_series([statistic], "statistic")[0])
    if not 0.0 < share < 1.0:
        raise ValueError(f"share: a number in (0, 1) is needed, given {share!r}")
    if (len(drawn) + 1) * (1.0 - share) < 1.0 - 1e-9:
        needed = int(np.ceil(1.0 / (1.0 - share) - 1e-9)) - 1
        raise ValueError(f"surrogates: {needed} at least are needed for a share of {share:g}, given {len(drawn)}")
    below = (np.sum(drawn < value) + 0.5 * np.sum(drawn == value)) / len(drawn)
    # Of s + 1 equally likely places the record must hold one of the best (1 - share)(s + 1); a tie counts against it.
    above = bool(np.sum(drawn >= value) + 1 <= (1.0 - share) * (len(drawn) + 1) + 1e-9)
    return NullRank(above, float(below), value - float(np.median(drawn)), value, locked(drawn))


def null_ranks(section: np.ndarray, surrogates: int, seed: Seed) -> list[NullRank]:
    """NullRank of the prediction gain for each of NULLS, NaN where a gain cannot be had; of the last 1000 points.

    The linear null is asked of the coordinates' normal scores: it allows any monotone instrument, and iterating towards
    a spectrum and a skew distribution at once reaches neither well enough (exp of a linear process, sampled often, beat
    its own surrogates in one case of ten). Normal scores undo the instrument first. For the other null that would not
    do: its noise is added to the motion as it is.
    """
    section = section[-NULL_POINTS:]
    ranks = []
    asked = (normal_scores(section), iaaft_surrogates), (section, noisy_periodic_surrogates)
    for i, (points, make) in enumerate(asked):
        gain, drawn = prediction_gain(points).gain, [np.nan]
        if np.isfinite(gain):
            drawn = [prediction_gain(one).gain for one in make(points, surrogates, [*np.atleast_1d(seed), 100 + i])]
        none = NullRank(None, np.nan, np.nan, np.nan, np.empty(0))
        ranks.append(rank_among(gain, drawn) if np.all(np.isfinite(drawn)) else none)
    return ranks


def _drawn(series, count, seed, kept):
    """Surrogates of what is left of a record beside the part `kept` (a function of its columns), with this part."""
    columns, count = checked_columns(series), checked_count(count, "count")
    if len(columns) < LEAST_POINTS:
        raise ValueError(f"series: {LEAST_POINTS} samples at least are needed for surrogates, given {len(columns)}")
    part = kept(columns)
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


def prediction_gain(section: ArrayLike, delays: int | None = None, theiler: int = 1) -> PredictionGain:
    """Gain of local-linear over linear one-step prediction on a section (formula at the head of this file).

    section (m,) or (m, d)   one row a forcing period
    delays                   rows taken together as one state, (x_k, x_{k-1}, ...); default: as few as make a state of 3
                             or more numbers
    theiler                  points within this many periods of the one predicted are no neighbours of it
    Returns a PredictionGain: NaN, with the reason, where nothing moves or the record is short: it
    takes eight states per number in a state, and the window.
    Raises ValueError for values that are not finite.
    Source: E. N. Lorenz (analogues), J. Atmos. Sci. 26 (1969) 636; J. D. Farmer & J. J. Sidorowich, Phys. Rev. Lett. 59
    (1987) 845; gain over linear prediction as a test: M. Casdagli, J. R. Stat. Soc. B 54 (1992) 303.
    """
    x, theiler = checked_columns(section, "section"), checked_count(theiler, "theiler", least=0)
    z = in_deviations(x, centred=True)
    if z.shape[1] == 0:
        return PredictionGain(np.nan, np.nan, np.nan, "no motion: the section is one point to the last digits")
    state = states_of(z, x.shape[1], delays)[:-1]
    target = z[len(z) - len(state) :]
    needed = LEAST_PER_COORDINATE * (state.shape[1] + 1) + 2 * theiler
    if len(state) < needed:
        wanted = f"{needed + state.shape[1] // z.shape[1]} points are needed for a state of {state.shape[1]} numbers"
        return PredictionGain(np.nan, np.nan, np.nan, f"too short: {wanted}, given {len(x)}")
    linear, local = _linear_error(state, target), _local_error(state, target, theiler)
    # Errors at rounding cannot be compared: a clean period-N motion is predicted to the last digit by both.
    gain = float(np.log(max(linear, 1e-9) / max(local, 1e-9)))
    reason = f"errors {linear:.3g} linear and {local:.3g} local, of a standard deviation: a gain of {gain:.2f} nats"
    return PredictionGain(gain, linear, local, reason)


def _linear_error(state, target):
    """Leave-one-out rms error of the affine least-squares map: residual/(1 - leverage)."""
    design = np.hstack([np.ones((len(state), 1)), state])
    u, s, _ = np.linalg.svd(design, full_matrices=False)
    u = u[:, s > 1e-9 * s[0]]
    residual = target - u @ (u.T @ target)
    leverage = np.minimum(np.sum(u**2, axis=1, keepdims=True), 1.0 - 1e-6)
    return float(np.sqrt(np.mean((residual / (1.0 - leverage)) ** 2)))


def _local_error(state, target, theiler):
    """rms error of the affine maps fitted to the nearest neighbours of each state, itself not among them."""
    points, size = state.shape
    wanted = min(NEIGHBOURS_PER_COEFFICIENT * (size + 1), points - 2 * theiler - 1)
    near, _ = nearest_outside(state, theiler, count=wanted)
    away = state[near] - state[:, None, :]
    centre, mean = away.mean(axis=1, keepdims=True), target[near].mean(axis=1, keepdims=True)
    spread = away - centre
    square = np.einsum("pki,pkj->pij", spread, spread)
    trace = np.trace(square, axis1=1, axis2=2)[:, None, None]
    square = square + (_RIDGE * trace / size + 1e-24) * np.eye(size)
    slope = np.linalg.solve(square, np.einsum("pki,pkj->pij", spread, target[near] - mean))
    predicted = mean[:, 0] - np.einsum("pi,pij->pj", centre[:, 0], slope)
    return float(np.sqrt(np.mean((predicted - target) ** 2)))
