"""The largest Lyapunov exponents from the growth of infinitesimal perturbations, forcing period by forcing period.

A simulation that carries its tangent dynamics (Benettin et al. 1980; Shimada & Nagashima 1979) reports, for each
period, the logarithms by which k orthonormal perturbations grew. Their means are the k largest exponents,

    sigma_i = (1/m) sum_p growth_i(p)/ln 2      [bits per forcing period, eq. (32)].

Growth in neighbouring periods is correlated, and most of its fluctuation is bounded: what a period gains the next ones
lose (a period-2 motion grows and shrinks in turn, a torus turns round). Blocks take that for diffusion, and their error
is two to three times too large. So the mean is tapered, with a cosine over a quarter of the record at each end, and

    error^2 = S(0) sum w^2,    S(0) ~ mean of S(j/m), j = 2 ... J + 1,    S(f) = |sum h_p g_p e^(-2 pi i f p)|^2/sum h^2

with the weights w (sum 1) of that taper, growth g less its mean and Hann's window h. J is 6 up to 500 periods, and
grows as sqrt(m) beyond, so that the band narrows while the error becomes sure. Six frequencies know S(0) to 30 %:
deviations from the truth, in such errors, have a standard deviation of 1.16 for white noise. A run knows only the
fluctuations that it has met: other starts may lie farther apart (docs/motions.md#the-error-of-an-exponent counts it).
"""

import numpy as np
from numpy.typing import ArrayLike

from analysis.exponents import BITS_PER_PERIOD, Exponent, no_exponent
from analysis.sampling import checked_columns, checked_count, checked_series

METHOD = "tangent dynamics, Benettin et al. 1980"
TAPER = 0.5  # share of the record under the two cosines
LOWEST = 2  # cycles over the record: the mean leaks into those below
FREQUENCIES, SHORT = 6, 500  # how many count in records of up to this many periods
LEAST_PERIODS = 32
ALIGNED = 10  # periods that perturbations need to turn to the fastest growth


def tangent_lyapunov(growth_nats: ArrayLike, transient_periods: int = 0) -> tuple[Exponent, ...]:
    """The exponents of a tangent map, one `Exponent` a perturbation, in bits per forcing period.

    growth_nats (m,) or (m, k)   logarithm of the growth in each forcing period, nats; fastest first
    transient_periods            periods at the start that do not count (the perturbations also need some to turn)
    Returns a tuple of Exponent; NaN with the reason where fewer than 32 periods count. Raises ValueError for values
    that are not finite.
    Source of the error: P. Heidelberger & P. D. Welch, Commun. ACM 24 (1981) 233, with windows in place of a fit.
    """
    growth = checked_columns(growth_nats, "growth_nats")
    start = checked_count(transient_periods, "transient_periods", least=0)
    bits = growth[start:] / np.log(2.0)
    periods = len(bits)
    if periods < LEAST_PERIODS:
        reason = f"too short: {LEAST_PERIODS} periods of growth are needed, given {periods}"
        return (no_exponent(METHOD, reason, BITS_PER_PERIOD),) * growth.shape[1]
    values, errors = _tapered_mean(bits)
    reason = f"tapered mean growth over {periods} forcing periods, error from this one run's slowest fluctuations"
    return tuple(
        Exponent(float(value), float(error), BITS_PER_PERIOD, METHOD, reason, {"periods": periods})
        for value, error in zip(values, errors, strict=True)
    )


def turned(growth_nats: np.ndarray, start: int) -> np.ndarray:
    """The growth (m,) from period `start` on of perturbations that had ALIGNED periods to turn. NaN: none carried."""
    carried = np.flatnonzero(np.isfinite(growth_nats))
    first = max(start, carried[0] + ALIGNED) if len(carried) else len(growth_nats)
    return growth_nats[first:]


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
    (exponent,) = tangent_lyapunov(growth, transient_periods)
    count = int(events[transient_periods:].sum())
    if count:
        return no_exponent(METHOD, f"loops were released in {count} of the periods that count", BITS_PER_PERIOD)
    return exponent


def _tapered_mean(values):
    """Tapered means of values (m, k), and their standard errors from the lowest frequencies (head of this file)."""
    # written out, because scipy.signal takes a second to import
    count = len(values)
    t = np.arange(1, count + 1) / (count + 1)
    weight = np.sin(np.pi * np.minimum(np.minimum(t, 1.0 - t) / TAPER, 0.5)) ** 2
    weight /= weight.sum()
    mean, window = weight @ values, np.sin(np.pi * t) ** 2
    frequencies = LOWEST + np.arange(round(FREQUENCIES * max(1.0, count / SHORT) ** 0.5))
    waves = np.exp(-2j * np.pi * np.outer(frequencies, np.arange(count)) / count)
    power = np.abs(waves @ ((values - mean) * window[:, None])) ** 2 / np.sum(window**2)
    return mean, np.sqrt(power.mean(axis=0) * np.sum(weight**2))
