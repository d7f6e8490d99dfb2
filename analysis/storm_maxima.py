"""The most probable largest value in a storm of given length, with its interval, from records of the same sea.

Records are cut into blocks of equal length, and the maxima M of the blocks are fitted by the generalised extreme value
law (Coles, An Introduction to Statistical Modeling of Extreme Values, 2001, chapter 3):

    P(M < x) = exp(-(1 + xi (x - mu)/s)^(-1/xi)),     z = mu + s (n^xi - 1)/xi

A storm has n blocks, and z is the level that one block in n exceeds. It is the most probable maximum of the storm where
xi = 0 (Gumbel), and the maximum stays below it in 37 % of all storms by any law. The interval is that of the profile
likelihood of z. A prior of xi with a standard deviation of SPREAD keeps few maxima from a wild tail.

Blocks have to be independent and of one law. Blocks of neighbours that are alike are made longer. So are blocks whose
maxima do not follow the law, as those of a buoy that is in its large motion in some blocks and not in others: blocks
long enough hold both motions. If no length fits, the interval comes from the order of maxima of whole storms, which
needs no law; and without enough whole storms there is no answer but the reason.

scipy optimises; `pyextremes` was weighed: it bootstraps, refuses several records, and has no test of one law.
"""

import math
from collections.abc import Iterator, Sequence
from functools import cache

import numpy as np
from numpy.typing import ArrayLike

from analysis.extreme_values import block_maxima
from analysis.sampling import checked_columns, checked_positive, record_of_numbers

STORM_S = 3 * 3600.0
MOST_BLOCKS, LEAST_BLOCKS = 60, 12  # that are fitted
SPREAD = 0.15  # of the shape xi before any maximum is known: loads of waves have -0.2 to 0.2
WORST_FIT = 1.0  # statistic A^2 of Anderson and Darling that one fit in a hundred of the right law exceeds
IMPOSSIBLE = 1e10  # misfit of a law that has no place for a maximum
ALIKE = 2.0  # correlation of neighbouring blocks, in standard deviations of that of independent ones


@record_of_numbers
class StormMaximum:
    """The most probable largest value in a storm; NaN without an answer.

    value, low, high   the estimate and the ends of its interval, unit of the records
    method             "extreme value law", "order of storms" or ""
    shape              xi of the law; NaN without one
    blocks, block_s    how many maxima were fitted, and the length of a block [s]
    reason             one sentence: how it was found, or why there is none
    """

    value: float
    low: float
    high: float
    method: str
    shape: float
    blocks: int
    block_s: float
    reason: str

    @property
    def found(self) -> bool:
        """Whether there is an estimate."""
        return math.isfinite(self.value)


def storm_maximum(
    records: Sequence[ArrayLike],
    step_s: float,
    storm_s: float = STORM_S,
    confidence: float = 0.9,
    least_block_s: float = 0.0,
) -> StormMaximum:
    """The most probable maximum of a storm from records of independent seas of one state (head of this file).

    records (k,) of (n,)   samples, or largest values since the previous sample, in any unit; transients left out
    step_s                 sampling step [s]
    storm_s                length of the storm [s]
    confidence             of the interval
    least_block_s          length of the shortest block [s], for instance 20 waves
    Returns a StormMaximum. Its intervals cover the truth in 86 to 94 % of records of known law (docs/sea.md).
    Raises ValueError for values that are not finite, or numbers that are not above zero.
    """
    step_s, storm_s = checked_positive(step_s, "step_s"), checked_positive(storm_s, "storm_s")
    records = [checked_columns(series)[:, 0] for series in records]
    shortest = min(map(len, records), default=0)
    lacking = f"fewer than {LEAST_BLOCKS} blocks"
    for per_record in _block_counts(len(records)):
        samples = shortest // per_record
        if samples < 1 or samples * step_s < least_block_s:
            continue
        maxima = np.stack([block_maxima(series[: samples * per_record], samples) for series in records])
        lacking = "neighbouring blocks are alike"
        if not _alike(maxima):
            answer = _fitted(maxima.ravel(), samples * step_s, storm_s, confidence)
            if isinstance(answer, StormMaximum):
                return answer
            lacking = answer
    return _by_order(records, round(storm_s / step_s), step_s, confidence, lacking)


def _block_counts(records: int) -> Iterator[int]:
    """Numbers of blocks of each record that are tried, falling, as long as so many records have enough blocks."""
    per_record = max(MOST_BLOCKS // max(records, 1), 1)
    while per_record >= 1 and records * per_record >= LEAST_BLOCKS:
        yield per_record
        per_record = min(per_record - 1, math.floor(per_record / 1.4))


def _alike(maxima) -> bool:
    """Whether the maxima (records, blocks) of neighbouring blocks are correlated in their ranks."""
    if maxima.shape[1] < 2:
        return False
    from scipy.stats import rankdata

    ranks = rankdata(maxima).reshape(maxima.shape)
    ranks = (ranks - ranks.mean()) / max(ranks.std(), 1e-300)
    pairs = ranks[:, 1:] * ranks[:, :-1]
    return pairs.mean() > ALIKE / math.sqrt(pairs.size)


def _fitted(maxima, block_s: float, storm_s: float, confidence: float) -> StormMaximum | str:
    """The estimate by the law, or why the law does not fit."""
    from scipy.optimize import brentq, minimize
    from scipy.stats import chi2

    centre, size = float(np.mean(maxima)), float(np.std(maxima))
    if size == 0.0:
        return "all maxima are equal"
    scaled, blocks = (maxima - centre) / size, storm_s / block_s

    def misfit(level: float, log_scale: float, shape: float) -> float:
        return _misfit(scaled, blocks, level, math.exp(log_scale), shape)

    first = np.array([-0.45 + 0.78 * math.log(blocks), math.log(0.78), 0.0])
    best = minimize(lambda p: misfit(*p), first, method="Nelder-Mead", options={"maxiter": 2000, "xatol": 1e-5})
    level, log_scale, shape = best.x
    reduced = _reduced(scaled, blocks, level, math.exp(log_scale), shape)
    fit = _anderson_darling(np.exp(-np.exp(-reduced)))
    if fit > WORST_FIT:
        return f"maxima of blocks of {block_s:.0f} s do not follow one law (A² = {fit:.2g}), as those of two motions"
    allowed = best.fun + 0.5 * chi2.ppf(confidence, 1)

    @cache
    def excess(candidate: float) -> float:
        """Of the profile likelihood over what the interval allows."""
        start = log_scale, shape
        if misfit(candidate, *start) >= IMPOSSIBLE:
            start = log_scale + math.log1p(abs(candidate - level)), 0.0
        inner = minimize(lambda p: misfit(candidate, *p), start, method="Nelder-Mead", options={"xatol": 1e-4})
        return inner.fun - allowed

    ends = []
    for way in (-1.0, 1.0):
        reach = 0.2
        while excess(level + way * reach) < 0.0 and reach < 100.0:
            reach *= 1.6
        ends.append(brentq(excess, level + way * reach, level, xtol=1e-3))
    low, high = (centre + size * end for end in ends)
    reason = f"{len(maxima)} blocks of {block_s:.0f} s, shape {shape:.2f}, A² = {fit:.2f}"
    return StormMaximum(centre + size * level, low, high, "extreme value law", shape, len(maxima), block_s, reason)


def _reduced(x, blocks: float, level: float, scale: float, shape: float):
    """y of P(M < x) = exp(-exp(-y)); NaN beyond the end of the law."""
    if abs(shape) < 1e-6:
        return (x - level) / scale + math.log(blocks)
    place = level - scale * (blocks**shape - 1.0) / shape
    inner = 1.0 + shape * (x - place) / scale
    return np.log(np.where(inner > 0.0, inner, np.nan)) / shape


def _misfit(x, blocks: float, level: float, scale: float, shape: float) -> float:
    """Minus the logarithm of likelihood and prior."""
    y = _reduced(x, blocks, level, scale, shape)
    if not np.isfinite(y).all() or abs(shape) > 1.0:
        return IMPOSSIBLE
    return float(len(x) * math.log(scale) + np.sum((1.0 + shape) * y + np.exp(-y))) + 0.5 * (shape / SPREAD) ** 2


def _anderson_darling(probabilities) -> float:
    """A^2 of probabilities that should be uniform (Anderson & Darling, JASA 49 (1954) 765)."""
    u = np.clip(np.sort(probabilities), 1e-12, 1.0 - 1e-12)
    count = len(u)
    weight = 2.0 * np.arange(1, count + 1) - 1.0
    return float(-count - np.sum(weight * (np.log(u) + np.log1p(-u[::-1]))) / count)


def _by_order(records, storm: int, step_s: float, confidence: float, lacking: str) -> StormMaximum:
    """The estimate from maxima of whole storms, with the interval of their quantile by the binomial law."""
    from scipy.stats import binom

    maxima = np.sort(np.concatenate([block_maxima(series, storm) for series in records] or [[]]))
    share, tail = math.exp(-1.0), 0.5 * (1.0 - confidence)
    count = len(maxima)
    low, high = int(binom.ppf(tail, count, share)) - 1, int(binom.ppf(1.0 - tail, count, share))
    if count == 0 or low < 0 or high >= count:
        reason = f"{lacking}, and {count} whole storms are too few to go by their order; longer records or more seas"
        return StormMaximum(math.nan, math.nan, math.nan, "", math.nan, count, storm * step_s, reason)
    reason = f"by the order of {count} storms, because {lacking}"
    value = float(np.quantile(maxima, share))
    return StormMaximum(value, maxima[low], maxima[high], "order of storms", math.nan, count, storm * step_s, reason)
