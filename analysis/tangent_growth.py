"""The largest Lyapunov exponents from the growth of infinitesimal perturbations, forcing period by forcing period.

A simulation that carries its tangent dynamics (Benettin et al. 1980; Shimada & Nagashima 1979) reports, for each
period, the logarithms by which k orthonormal perturbations grew. Their means are the k largest exponents,

    sigma_i = (1/m) sum_p growth_i(p)/ln 2      [bits per forcing period, eq. (32)].

Growth in neighbouring periods is correlated (a period-2 motion grows and shrinks in turn, a loop event lasts several
periods), so the error is that of means over blocks: the largest standard error found with 8 to 16 equal blocks. More
and shorter blocks cut through what alternates and make its error larger than it is.
"""

import numpy as np
from numpy.typing import ArrayLike

from analysis.exponents import BITS_PER_PERIOD, Exponent, no_exponent
from analysis.sampling import checked_columns, checked_count, checked_series

METHOD = "tangent dynamics, Benettin et al. 1980"
BLOCKS = (8, 10, 12, 16)
LEAST_PERIODS = 32


def tangent_lyapunov(
    growth_nats: ArrayLike, transient_periods: int = 0, left_out: ArrayLike | None = None
) -> tuple[Exponent, ...]:
    """The exponents of a tangent map, one `Exponent` a perturbation, in bits per forcing period.

    growth_nats (m,) or (m, k)   logarithm of the growth in each forcing period, nats; fastest first
    transient_periods            periods at the start that do not count (the perturbations also need some to turn)
    left_out (m,)                true for periods to leave out, as those with a loop release, whose jump is not a
                                 derivative; None: all count
    Returns a tuple of Exponent; NaN with the reason where fewer than 32 periods count. Raises ValueError for values
    that are not finite or lengths that do not fit.
    """
    growth = checked_columns(growth_nats, "growth_nats")
    start = checked_count(transient_periods, "transient_periods", least=0)
    counted = np.ones(len(growth), dtype=bool) if left_out is None else ~np.asarray(left_out, dtype=bool)
    if counted.shape != (len(growth),):
        raise ValueError(f"left_out: {len(growth)} values are needed, given {counted.shape}")
    kept = growth[start:][counted[start:]] / np.log(2.0)
    periods = len(kept)
    if periods < LEAST_PERIODS:
        reason = f"too short: {LEAST_PERIODS} periods of growth are needed, given {periods}"
        return tuple(no_exponent(METHOD, reason, BITS_PER_PERIOD) for _ in range(growth.shape[1]))
    errors = np.max([_block_error(kept, blocks) for blocks in BLOCKS if periods >= 2 * blocks], axis=0)
    reason = f"mean growth over {periods} forcing periods, error from blocks"
    return tuple(
        Exponent(float(value), float(error), BITS_PER_PERIOD, METHOD, reason, {"periods": periods})
        for value, error in zip(kept.mean(axis=0), errors, strict=True)
    )


def transverse_lyapunov(
    growth_nats: ArrayLike, transient_periods: int = 0, released: ArrayLike | None = None
) -> Exponent:
    """The exponent across the plane of a planar motion, in bits per forcing period (Pikovsky & Grassberger 1991).

    A motion confined to an invariant plane stays there against an infinitesimal push out of it where this exponent is
    negative, and leaves it where it is positive.

    growth_nats (m,)      logarithm of the growth across the plane in each forcing period, nats
    transient_periods     periods at the start that do not count
    released (m,)         true for periods in which a loop was released. In a loop that a plane cannot open the tether
                          buckles sideways at a rate without a limit in the mesh: where one was released within the
                          periods that count there is no exponent, and leaving those periods out would not give one.
    Returns an Exponent; NaN with the reason where loops were released or fewer than 32 periods count.
    """
    growth = checked_series(growth_nats, "growth_nats")
    events = np.zeros(len(growth), dtype=bool) if released is None else np.asarray(released, dtype=bool)
    if events.shape != growth.shape:
        raise ValueError(f"released: {len(growth)} values are needed, given {events.shape}")
    (found,) = tangent_lyapunov(growth, transient_periods)
    if count := int(events[transient_periods:].sum()):
        return no_exponent(METHOD, f"loops were released in {count} of the periods that count", BITS_PER_PERIOD)
    return found


def _block_error(values, blocks):
    """Standard error of the mean of values (m, k) from the scatter of the means of equal blocks."""
    length = len(values) // blocks
    means = values[len(values) - blocks * length :].reshape(blocks, length, -1).mean(axis=1)
    return means.std(axis=0, ddof=1) / np.sqrt(blocks)
