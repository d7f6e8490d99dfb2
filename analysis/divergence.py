"""Exponents from the mean growth of many neighbours: Rosenstein et al. (1993) and Kantz (1994).

    Rosenstein   y(k) = < ln |X_{i+k} - X_{j(i)+k}| >_i                     one nearest neighbour j(i) of every point
    Kantz        y(k) = < ln ( mean over j in U_i of |x_{i+k} - x_{j+k}| ) >_i  all neighbours U_i within a radius

Both are the slope of y(k) against time in its scaling region (`scaling_regions`), which is part of the answer. They
need no replacement, and show by a curve that bends everywhere that there is no exponent to be had; in return they use
only neighbours as near as the record has, and average the logarithm over the whole attractor.
"""

import numpy as np
from numpy.typing import ArrayLike

from analysis.embedding_delay import delay_vectors
from analysis.embedding_dimension import choose_embedding
from analysis.exponents import Exponent, no_exponent
from analysis.neighbours import nearest_outside, noise_level
from analysis.sampling import checked_count, checked_positive, checked_series, locked
from analysis.scaling_regions import scaling_region

ROSENSTEIN = "Rosenstein, Collins & De Luca 1993"
KANTZ = "Kantz 1994"
CENTRES = 2000
LEAST_CENTRES = 100
BLOCKS = 8
KANTZ_NEIGHBOURS = 8


def rosenstein_lyapunov(
    series: ArrayLike,
    step_s: float,
    delay: int | None = None,
    dimension: int | None = None,
    theiler: int | None = None,
    horizon: int | None = None,
) -> Exponent:
    """Largest Lyapunov exponent from the mean logarithmic growth between nearest neighbours.

        y(k) = < ln |X_{i+k} - X_{j(i)+k}| >,    lambda = slope of y against k step_s in its scaling region

    series (n,)    any unit, evenly sampled
    step_s         sampling step [s], or 1 for a map
    delay, dimension    of the embedding; None: choose_embedding
    theiler        neighbours nearer in time are none [samples]; None: mean period or span of a delay vector
    horizon        largest k [samples]; None: eight mean periods, at most a quarter of the record
    Returns an Exponent [nats/time]. Its error joins the bend of the region with the scatter of eight blocks of centres.
    NaN with a reason where no straight part of the curve spans one nat: regular motion, noise, or too short a record.
    details: time_s and curve (k,), region (ScalingRegion), embedding, dimension, theiler, centres.
    Raises ValueError for values that are not finite.
    Source: Rosenstein, Collins & De Luca, Physica D 65, 117 (1993).
    """
    x, step_s = checked_series(series), checked_positive(step_s, "step_s")
    setting = _setting(x, delay, dimension, theiler, horizon)
    if isinstance(setting, str):
        return no_exponent(ROSENSTEIN, setting)
    embedding, m, theiler, horizon, points, rows = setting
    index, distance = nearest_outside(points[: len(points) - horizon], theiler, rows)
    # Zero: an exact repetition (periodic to the last digit), which has no logarithm.
    kept = (index[:, 0] >= 0) & (distance[:, 0] > 1e-12 * np.std(x))
    rows, index = rows[kept], index[kept, 0]
    growth = np.empty((horizon + 1, len(rows)))
    with np.errstate(divide="ignore"):
        for k in range(horizon + 1):
            growth[k] = np.log(np.linalg.norm(points[rows + k] - points[index + k], axis=1))
    return _slope_of(growth, step_s, embedding, ROSENSTEIN, {"dimension": m, "theiler": theiler})


def kantz_lyapunov(
    series: ArrayLike,
    step_s: float,
    delay: int | None = None,
    dimension: int | None = None,
    theiler: int | None = None,
    horizon: int | None = None,
    radius: float | None = None,
) -> Exponent:
    """Largest Lyapunov exponent from the growth of whole neighbourhoods.

        y(k) = < ln( mean over j in U_i of |x_{i+k} - x_{j+k}| ) >,    U_i: |X_i - X_j| <= radius

    Averaging before the logarithm tames single bad neighbours, so that noise matters less than in Rosenstein's curve.

    series, step_s, delay, dimension, theiler, horizon    as in rosenstein_lyapunov
    radius         of the neighbourhoods [unit of the series]; None: the median distance of the eighth neighbour, at
                   least three standard deviations of the noise between two delay vectors
    Returns an Exponent [nats/time] with details as in rosenstein_lyapunov and radius. NaN with a reason where no
    straight part spans one nat, or fewer than 100 points have eight neighbours or more within the radius.
    Raises ValueError for values that are not finite.
    Source: Kantz, Physics Letters A 185, 77 (1994).
    """
    x, step_s = checked_series(series), checked_positive(step_s, "step_s")
    setting = _setting(x, delay, dimension, theiler, horizon)
    if isinstance(setting, str):
        return no_exponent(KANTZ, setting)
    embedding, m, theiler, horizon, points, rows = setting
    index, distance = nearest_outside(points[: len(points) - horizon], theiler, rows, count=4 * KANTZ_NEIGHBOURS)
    if radius is None:
        noise = noise_level(x, embedding.lag) * np.sqrt(2.0 * m)
        radius = max(np.median(distance[:, KANTZ_NEIGHBOURS - 1]), 3.0 * noise)
        if radius == 0.0:
            return no_exponent(KANTZ, "neighbours coincide: the series takes too few different values")
    near = (distance <= checked_positive(radius, "radius")) & (index >= 0)
    kept = np.sum(near, axis=1) >= KANTZ_NEIGHBOURS
    rows, index, near, last = rows[kept], index[kept], near[kept], len(x) - len(points)
    growth, sizes = np.empty((horizon + 1, len(rows))), np.sum(near, axis=1)
    with np.errstate(divide="ignore"):
        for k in range(horizon + 1):
            apart = np.abs(x[rows + last + k][:, None] - x[index + last + k])
            growth[k] = np.log(np.sum(np.where(near, apart, 0.0), axis=1) / sizes)
    details = {"dimension": m, "theiler": theiler, "radius": float(radius)}
    return _slope_of(growth, step_s, embedding, KANTZ, details)


def _setting(x, delay, dimension, theiler, horizon):
    """(embedding, dimension, theiler, horizon, delay vectors, centres), or the sentence that says why there is none.

    Centres are the points asked about, in the order of time: all, or 2000 drawn with a fixed seed.
    """
    if len(x) < 500 or np.ptp(x) == 0.0:
        return f"500 samples of a series that moves are needed, given {len(x)}"
    embedding = choose_embedding(x, delay)
    lag, period = embedding.lag, embedding.mean_period
    m = embedding.dimension if dimension is None else checked_count(dimension, "dimension")
    theiler = max(round(period), (m - 1) * lag) if theiler is None else int(theiler)
    horizon = min(max(round(8 * period), 12), len(x) // 4) if horizon is None else checked_count(horizon, "horizon")
    if len(x) - (m - 1) * lag - horizon < LEAST_CENTRES + 2 * theiler:
        return f"too short: {len(x)} samples for delay vectors of {(m - 1) * lag} samples and a horizon of {horizon}"
    points = delay_vectors(x, lag, m)
    usable = len(points) - horizon
    centres = np.arange(usable)
    if usable > CENTRES:
        centres = np.sort(np.random.default_rng(0).choice(usable, CENTRES, replace=False))
    return embedding, m, theiler, horizon, points, centres


def _slope_of(growth, step_s, embedding, method, details):
    """The Exponent of ln(distance) (k, centres): mean curve, its scaling region, errors from bend and blocks."""
    # One pair that meets exactly would make the mean minus infinity.
    growth = growth[:, np.all(np.isfinite(growth), axis=0)]
    if growth.shape[1] < LEAST_CENTRES:
        return no_exponent(method, f"only {growth.shape[1]} points have neighbours; {LEAST_CENTRES} are needed")
    time_s, curve = step_s * np.arange(len(growth)), growth.mean(axis=1)
    period = embedding.mean_period
    # Distances along one coordinate swing twice in a mean period.
    region = scaling_region(time_s, curve, cycle=round(period / 2) if period >= 6.0 else 1)
    details = details | {"time_s": locked(time_s), "curve": locked(curve), "region": region}
    details |= {"embedding": embedding, "centres": growth.shape[1]}
    if not np.isfinite(region.slope):
        return no_exponent(method, region.reason, details=details)
    part = slice(region.begin, region.end + 1)
    blocks = np.array_split(growth, BLOCKS, axis=1)
    slopes = [np.polyfit(time_s[part], block[part].mean(axis=1), 1)[0] for block in blocks]
    scatter = np.std(slopes, ddof=1) / np.sqrt(BLOCKS)
    return Exponent(region.slope, float(np.hypot(region.error, scatter)), "nats/time", method, region.reason, details)
