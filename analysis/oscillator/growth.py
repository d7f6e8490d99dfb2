"""Both Lyapunov exponents of eq. (33) with errors one may believe, at its parameters and over one of them."""

from dataclasses import astuple, replace

import numpy as np
from numpy.typing import ArrayLike

from analysis.exponents import NATS_PER_TIME, Exponent
from analysis.oscillator.attractors import PAPER_BOX, settled_periods
from analysis.oscillator.equation import SnapOscillator
from analysis.oscillator.motions import checked_starts
from analysis.oscillator.strobing import growth_over_values
from analysis.sampling import checked_count, checked_series, record, standard_error

METHOD = "tangent map of eq. (33), QR every period (Benettin et al. 1980)"
PARAMETERS = ("damping", "frequency", "force", "lift")
_WATCHED = 640  # periods after the averages in which a start may show that it was on a periodic orbit


@record
class SnapExponents:
    """Both exponents of one attractor, averaged over independent starts.

    first, second        Exponent, nats per unit of time; error = standard deviation over starts / sqrt(starts); with
                         one start, over its blocks / sqrt(blocks)
    block_error          the same error from blocks of time alone: it should agree with first.error
    dimension            Kaplan-Yorke (Lyapunov) dimension of the section, and its error (`section_dimension`)
    dimension_error
    of_start (n, 2)      exponents of each start on the attractor
    of_block (n, b, 2)   and of each block of each start
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
    seed: int = 0,
) -> SnapExponents:
    """Both exponents of eq. (33) from the exact tangent map, averaged over independent starts.

    lambda_i = mean of ln R_ii over the periods / T;   error = s.d. over starts/sqrt(n)

    Independent starts make the error honest: nothing is assumed about correlation in time. The error falls as n^-1/2.
    A start that is on a periodic attractor by then (`settled_periods` after 640 further periods) belongs to another
    attractor, and is counted in `elsewhere`.

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
    starts = random_starts(count, seed) if starts is None else checked_starts(starts)
    ((rates,), _, (end,), (slack,)) = _grown([oscillator], starts, transient_periods, periods, blocks, 0)
    reason = ""
    if not np.isfinite(rates).all():
        reason = "an orbit could not be computed: more than 4096 pieces in one period"
    on = np.ones(len(rates), dtype=bool)
    if not reason:
        wandering = settled_periods(oscillator, end, _WATCHED)[0] == 0
        if wandering.any():
            on = wandering
    return _averaged(oscillator, rates[on], slack[on], periods, int((~on).sum()), reason)


def _grown(oscillators, starts, transient_periods, periods, blocks, points):
    """Rates of growth of every block (p, n, blocks, 2), sections (p, n, points, 2), ends (p, n, 2) and slack shares
    (p, n) of starts (n, 2) of every oscillator."""
    periods, blocks = checked_count(periods, "periods"), checked_count(blocks, "blocks", 2)
    if periods % blocks or points > periods:
        raise ValueError(f"periods: a multiple of blocks = {blocks}, at least points = {points}, given {periods}")
    transient, length = checked_count(transient_periods, "transient_periods", 0), periods // blocks
    parameters = np.array([astuple(oscillator) for oscillator in oscillators], dtype=float)
    sums, section, end, slack = growth_over_values(parameters, starts, transient, blocks, length, points)
    spans = length * np.array([oscillator.period for oscillator in oscillators])
    return sums / spans[:, None, None, None], section, end, slack


def random_starts(count: int, seed: int) -> np.ndarray:
    """(count, 2) states, uniform in PAPER_BOX."""
    generator = np.random.default_rng(seed)
    low, high = np.array(PAPER_BOX[0::2]), np.array(PAPER_BOX[1::2])
    return low + (high - low) * generator.random((checked_count(count, "count"), 2))


def _averaged(oscillator, rates, slack, periods, elsewhere, reason):
    starts, blocks = rates.shape[:2]
    of_start = rates.mean(axis=1)
    first, second = of_start.mean(axis=0)
    by_blocks = np.sqrt((standard_error(rates.swapaxes(0, 1)) ** 2).mean(axis=0) / starts)
    error = standard_error(of_start) if starts > 1 else by_blocks
    dimension = section_dimension(first, second)
    mu = oscillator.damping
    share = mu / second**2 if first > 0.0 else 0.0  # dD/d first, with second = -mu - first
    reason = reason or f"mean over {starts} starts of {periods} periods"
    running = np.cumsum(rates[:, :, 0], axis=1) / np.arange(1, blocks + 1)
    time = np.arange(1, blocks + 1) * (periods // blocks * oscillator.period)
    convergence = np.column_stack([time, running.mean(axis=0), standard_error(running)])
    exponents = []
    for value, its_error in zip((first, second), error, strict=True):
        exponents.append(Exponent(value, its_error, NATS_PER_TIME, METHOD, reason))
    uncertain = float(share * error[0]) if np.isfinite(dimension) else np.nan
    measures = (float(by_blocks[0]), dimension, uncertain, of_start, rates)
    return SnapExponents(*exponents, *measures, starts, elsewhere, float(slack.mean()), convergence)


@record
class SnapDiagram:
    """An orbit diagram with exponents; p values, n starts each.

    over              the parameter: "force", "frequency", "damping", "lift"
    values (p,)
    section (p, n, m, 2)   strobed g and g' after the transient, by start: coexisting attractors stay apart
    exponents (p, n, 2)    lambda_1, lambda_2 of every start, nats per unit of time
    errors (p, n)          standard error of lambda_1, from blocks of time
    slack_fraction (p, n)  share of the time without tension
    """

    over: str
    values: np.ndarray
    section: np.ndarray
    exponents: np.ndarray
    errors: np.ndarray
    slack_fraction: np.ndarray


def snap_diagram(
    oscillator: SnapOscillator,
    over: str,
    values: ArrayLike,
    starts: ArrayLike | None = None,
    count: int = 4,
    transient_periods: int = 500,
    periods: int = 1000,
    points: int = 200,
    blocks: int = 10,
    seed: int = 0,
) -> SnapDiagram:
    """Orbit diagram of eq. (33): strobed states and both exponents at each value of one parameter.

    over, values        "force", "frequency", "damping" or "lift", and its values (p,)
    starts              (n, 2) states from which every value is begun; None: `count` random ones from `seed`, in
                        PAPER_BOX. Several, because attractors coexist; the same at every value, so that no
                        value depends on the one before it.
    transient_periods   forcing periods left out;  periods  of the averages, a multiple of `blocks`
    points              strobed states kept, at most `periods`
    Returns SnapDiagram. NaN where an orbit could not be computed.
    ValueError for a name that is no parameter, for values that the oscillator does not allow, and for odd counts.
    Source: Tjavaras et al. 1998, eq. (33); exponents as in `snap_exponents`.
    """
    if over not in PARAMETERS:
        raise ValueError(f"over: one of {', '.join(PARAMETERS)} is needed, given {over!r}")
    values = checked_series(values, "values")
    oscillators = [replace(oscillator, **{over: float(value)}) for value in values]
    starts = random_starts(count, seed) if starts is None else checked_starts(starts)
    points = checked_count(points, "points")
    rates, section, _, slack = _grown(oscillators, starts, transient_periods, periods, blocks, points)
    errors = standard_error(np.moveaxis(rates[..., 0], 2, 0))
    return SnapDiagram(over, values, section, rates.mean(axis=2), errors, slack)
