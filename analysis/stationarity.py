"""Is a strobed record still on its way? Spread and mean of consecutive blocks, and whether they march with time.

A decay c e^{-a k} about any motion makes ln(spread) of equal blocks a straight line in time, and a slow trend does the
same to their means; on an attractor both scatter. Two signs count as a drift over eight blocks:
    march     |correlation with time| > 0.97 (once in 10^4 for independent blocks) and a total change that matters:
              10 % in spread, or a tenth of the standard deviation in a mean
    collapse  the first block spreads (or, by its mean, lies) three times wider than any block of the later half: a
              transient that has died out in noise, or on a motion much smaller than itself
"""

import numpy as np
from numpy.typing import ArrayLike

from analysis.sampling import checked_columns, in_deviations, record_of_numbers

BLOCKS = 8
LEAST_POINTS = 40
MARCH = 0.97
LEAST_CHANGE = 0.1
COLLAPSE = 3.0
FAR = 5.0  # ranges of the rest


@record_of_numbers
class Drift:
    """What the blocks of a record say about its being stationary.

    drifting         True where the record marches or collapses; None where it is too short to say
    spread_change    ln(spread of the last block/of the first) along the fitted line [nats]
    reason           one sentence
    """

    drifting: bool | None
    spread_change: float
    reason: str


def record_drift(section: ArrayLike) -> Drift:
    """Whether a strobed record is stationary, by the spread and the mean of eight consecutive blocks (head of file).

    section (m,) or (m, d)   one row a forcing period, 40 at least
    Returns a Drift; `drifting` is None for a shorter record, and False for one that does not move.
    A motion whose own slowest cycle is longer than the record cannot be told from a drift and is called one.
    Raises ValueError for values that are not finite.
    Source: block means as in the reverse-arrangements test of J. S. Bendat & A. G. Piersol, Random Data, section 4.5.
    """
    x = checked_columns(section, "section")
    if len(x) < LEAST_POINTS:
        reason = f"too short: {LEAST_POINTS} strobed points are needed, given {len(x)}"
        return Drift(None, np.nan, reason)
    z = in_deviations(x, centred=True)
    if z.shape[1] == 0:
        return Drift(False, 0.0, "no motion: the section is one point to the last digits")
    blocks = np.array_split(z, BLOCKS)
    mean = np.array([block.mean(axis=0) for block in blocks])
    spread = np.sqrt([np.mean(block.var(axis=0)) for block in blocks])
    # Rounding of a coordinate is the least spread there is: a decay ends there.
    logarithm = np.log(np.maximum(spread, 1e-14))
    spread_change, spread_march = _line(logarithm)
    changes = [_line(mean[:, j]) for j in range(mean.shape[1])]
    marching = [pair for pair in changes if abs(pair[1]) > MARCH] or changes
    mean_change, mean_march = max(marching, key=lambda pair: abs(pair[0]))
    settled = mean[BLOCKS // 2 :].mean(axis=0)
    width = np.sqrt(np.mean((mean - settled) ** 2, axis=1) + spread**2)
    collapse = width[0] / max(width[BLOCKS // 2 :].max(), 1e-14)
    signs = []
    if abs(spread_march) > MARCH and abs(spread_change) > LEAST_CHANGE:
        signs.append(f"the spread of the section changes steadily, by a factor {np.exp(spread_change):.2g} in all")
    if abs(mean_march) > MARCH and abs(mean_change) > LEAST_CHANGE:
        signs.append(f"its mean moves steadily, by {abs(mean_change):.2g} standard deviations")
    if collapse > COLLAPSE:
        signs.append(f"its first eighth is {collapse:.2g} times wider than any of the later half")
    reason = "; ".join(signs) if signs else "spread and mean of eight blocks show no steady change"
    return Drift(bool(signs), spread_change, reason)


def outlying(series: ArrayLike) -> np.ndarray:
    """Rows of samples far outside the rest, as a -9999 in place of a missing value.

    At most one sample in a hundred of a column on either side, apart from all others by more than five times the range
    that these have.

    series (n,) or (n, d)   any unit
    Returns the rows (k,), in order; empty where there are none. Raises ValueError for values that are not finite.
    """
    x = checked_columns(series)
    far = np.zeros(len(x), dtype=bool)
    largest = max(1, len(x) // 100)
    for column in x.T:
        order = np.argsort(column, kind="stable")
        value, low, high = column[order], 0, len(x)
        for j in range(1, largest + 1):
            if value[j] - value[j - 1] > FAR * (value[-largest - 1] - value[j]):
                low = j
            if value[-j] - value[-j - 1] > FAR * (value[-j - 1] - value[largest]):
                high = len(x) - j
        far[order[:low]] = far[order[high:]] = True
    return np.flatnonzero(far)


def _line(values):
    """Change along the least-squares line over the blocks, first to last, and the correlation with time."""
    if np.std(values) <= 1e-12 * max(1.0, np.abs(values).max()):
        return 0.0, 0.0
    time = np.arange(len(values))
    return np.polyfit(time, values, 1)[0] * time[-1], np.corrcoef(time, values)[0, 1]
