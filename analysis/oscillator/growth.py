"""Both Lyapunov exponents of eq. (33) with errors one may believe, and the Kaplan-Yorke dimension of its section."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from analysis.exponents import NATS_PER_TIME, Exponent, no_exponent
from analysis.oscillator.basin_grids import PAPER_BOX, snap_basins
from analysis.oscillator.equation import SnapOscillator
from analysis.oscillator.motions import checked_starts
from analysis.oscillator.pieces import tables
from analysis.oscillator.strobing import growth_of_starts
from analysis.sampling import checked_count

METHOD = "tangent map of eq. (33), QR every period (Benettin et al. 1980)"
_WATCHED = 1024  # periods after the averages in which a start may show that it was on a periodic orbit


@dataclass(frozen=True, eq=False)
class SnapExponents:
    """Both exponents of one attractor, averaged over independent starts.

    first, second        Exponent, nats per unit of time; error = standard deviation over starts / sqrt(starts); with
                         one start, over its blocks / sqrt(blocks)
    block_error          the same error from blocks of time alone: it should agree with first.error
    dimension            Kaplan-Yorke (Lyapunov) dimension of the section, and its error (`section_dimension`)
    dimension_error
    of_start (n, 2)      exponents of each start on the attractor
    of_block (n, b, 2)   and of each block of each start
    periods_of_start     forcing periods of each start's average
    starts, elsewhere    starts that count, and starts left out because they settled on a periodic orbit
    slack_fraction       share of the time without tension
    convergence (b, 3)   running mean of first over the blocks: time, mean over starts, standard error of that mean
    """

    first: Exponent
    second: Exponent
    block_error: float
    dimension: float
    dimension_error: float
    of_start: np.ndarray
    of_block: np.ndarray
    periods_of_start: int
    starts: int
    elsewhere: int
    slack_fraction: float
    convergence: np.ndarray


def section_dimension(first: float, second: float) -> float:
    """Kaplan-Yorke dimension of the section of a flow with these two exponents, D = 1 + first/|second|.

    The section is two-dimensional, so first > 0 > second gives 1 < D < 2 where their sum is negative; first <= 0 is an
    attracting set of points: D = 0; NaN where the sum is not negative (no attractor) or an exponent is NaN.
    Source: Kaplan & Yorke 1979.
    """
    if not first + second < 0.0:
        return np.nan
    return 1.0 + first / abs(second) if first > 0.0 else 0.0


def snap_exponents(
    oscillator: SnapOscillator,
    starts: ArrayLike | None = None,
    count: int = 64,
    transient_periods: int = 500,
    periods: int = 2000,
    blocks: int = 20,
    keep_periodic: bool = False,
    seed: int = 0,
) -> SnapExponents:
    """Both exponents of eq. (33) from the exact tangent map, averaged over independent starts.

    lambda_i = mean of ln R_ii over the periods / T;   error = s.d. over starts/sqrt(n)

    Independent starts make the error honest: nothing is assumed about correlation in time. The error falls as n^-1/2.
    A start that is on a periodic attractor by then (`snap_basins` over 1024 further periods, periods up to 32) belongs
    to another attractor, and is counted in `elsewhere`; `keep_periodic` averages over all starts instead.

    starts              (n, 2) states (g, g') at time 0; None: `count` of them, uniformly random in the box
                        g in [-60, 20], g' in [-25, 25], from `seed`
    transient_periods   forcing periods before the averages
    periods             of every start's average; a multiple of `blocks`
    Returns SnapExponents. Where every start settled on a periodic orbit, all are kept: the exponents are those of the
    periodic motions. NaN with a reason where an orbit could not be computed. lambda_2 loses digits where a period
    contracts areas by e^{-mu T} < 1e-8 (mu T > 18): the two tangent vectors then become parallel within a period.
    ValueError for counts that are no whole numbers, or periods that blocks do not divide.
    Source: Benettin, Galgani, Giorgilli & Strelcyn 1980; the equation, Tjavaras et al. 1998, eq. (33).
    """
    periods, blocks = checked_count(periods, "periods"), checked_count(blocks, "blocks", 2)
    if periods % blocks:
        raise ValueError(f"periods: a multiple of blocks = {blocks} is needed, given {periods}")
    transient = checked_count(transient_periods, "transient_periods", 0)
    starts = random_starts(count, seed) if starts is None else checked_starts(starts)
    table = tables(oscillator)
    sums, _, end, slack = growth_of_starts(starts, transient, blocks, periods // blocks, 0, table)
    rates = sums / (periods // blocks * oscillator.period)
    if not np.isfinite(rates).all():
        return _nothing(rates, periods)
    on = snap_basins(oscillator, end, _WATCHED).settled < 0
    if keep_periodic or not on.any():
        on[:] = True
    return _averaged(oscillator, rates[on], slack[on], periods, int((~on).sum()))


def random_starts(count: int, seed: int, box: tuple[float, float, float, float] = PAPER_BOX) -> np.ndarray:
    """(count, 2) states, uniform in the box (g low, g high, g' low, g' high)."""
    generator = np.random.default_rng(seed)
    low, high = np.array(box[0::2]), np.array(box[1::2])
    return low + (high - low) * generator.random((checked_count(count, "count"), 2))


def standard_error(values: ArrayLike) -> np.ndarray:
    """Standard error of the mean over the first axis; NaN for fewer than two values."""
    values = np.asarray(values)
    if len(values) < 2:
        return np.full(values.shape[1:], np.nan)
    return values.std(axis=0, ddof=1) / np.sqrt(len(values))


def _averaged(oscillator, rates, slack, periods, elsewhere):
    starts, blocks = rates.shape[:2]
    of_start = rates.mean(axis=1)
    first, second = of_start.mean(axis=0)
    by_blocks = np.sqrt((standard_error(rates.swapaxes(0, 1)) ** 2).mean(axis=0) / starts)
    error = standard_error(of_start) if starts > 1 else by_blocks
    dimension = section_dimension(first, second)
    mu = oscillator.damping
    share = mu / second**2 if first > 0.0 else 0.0  # dD/d first, with second = -mu - first
    reason = f"mean over {starts} starts of {periods} periods"
    running = np.cumsum(rates[:, :, 0], axis=1) / np.arange(1, blocks + 1)
    time = np.arange(1, blocks + 1) * (periods // blocks * oscillator.period)
    convergence = np.column_stack([time, running.mean(axis=0), standard_error(running)])
    both = (Exponent(*found, NATS_PER_TIME, METHOD, reason) for found in ((first, error[0]), (second, error[1])))
    uncertain = float(share * error[0]) if np.isfinite(dimension) else np.nan
    measures = (float(by_blocks[0]), dimension, uncertain, of_start, rates)
    return SnapExponents(*both, *measures, periods, starts, elsewhere, float(slack.mean()), convergence)


def _nothing(rates, periods):
    nothing = no_exponent(METHOD, "an orbit could not be computed: more than 4096 pieces in one period")
    nan, convergence = np.nan, np.full((rates.shape[1], 3), np.nan)
    return SnapExponents(nothing, nothing, nan, nan, nan, rates.mean(axis=1), rates, periods, 0, 0, nan, convergence)
