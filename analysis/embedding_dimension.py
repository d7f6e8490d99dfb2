"""The embedding dimension: false nearest neighbours (Kennel et al. 1992) and Cao's averages (1997).

A neighbour in m dimensions is false when one coordinate more drives it away: it was near only in projection.
With R_m the distance of a point to its nearest neighbour in m dimensions and z the distance in coordinate m + 1,

    false if   z > 15 R_m   or   sqrt(R_m^2 + z^2) > 2 s              s: standard deviation of the series   (Kennel)

    E(m) = mean max(R_m, z)/R_m,   E1(m) = E(m+1)/E(m),   R in the largest-coordinate norm                         (Cao)
    E2(m) = mean z at m + 1 / mean z at m:   1 for every m when the future does not depend on the past (noise)
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from analysis.embedding_delay import DelayChoice, choose_delay, delay_vectors
from analysis.neighbours import nearest_outside
from analysis.sampling import checked_count, checked_series, locked

FALSE_RATIO = 15.0
FALSE_SIZE = 2.0
FALSE_SHARE = 0.01
FALSE_AT_MOST = 0.2
CAO_LEVEL = 0.9
CENTRES = 2000


@dataclass(frozen=True, eq=False)
class EmbeddingChoice:
    """Delay and dimension of an embedding with the curves from which they were read; index m - 1 belongs to m.

    dimension                the choice: by false neighbours, else by Cao
    by_false_neighbours      first m whose share of false neighbours is within 0.01 of the least; None where even that
                             is more than 0.2: what is then folded is noise
    by_cao                   first m with E1 of at least 0.9; None if there is none
    reason                   one sentence
    lag                      delay used [samples]
    mean_period              mean period of the series [samples]
    delay                    DelayChoice: what mutual information says, whether it was used or not
    theiler                  Theiler window used [samples]
    false_share (k,)         share of false neighbours, m = 1 ... k
    e1, e2 (k - 1,)          Cao's ratios, m = 1 ... k - 1
    """

    dimension: int
    by_false_neighbours: int | None
    by_cao: int | None
    reason: str
    lag: int
    mean_period: float
    delay: DelayChoice
    theiler: int
    false_share: np.ndarray
    e1: np.ndarray
    e2: np.ndarray


def false_neighbours(
    series: ArrayLike, delay: int, max_dimension: int = 8, theiler: int = 0, centres: int = CENTRES
) -> np.ndarray:
    """Share of false nearest neighbours in m = 1 ... max_dimension dimensions.

    series (n,)     any unit
    delay           [samples]
    theiler         Theiler window [samples]
    centres         points asked about, drawn with a fixed seed
    Returns an array (max_dimension,). Noise makes false neighbours in every dimension: their share then levels off
    above zero, and rises again. NaN where no point has a neighbour outside the window.
    Raises ValueError for values that are not finite or a series too short.
    Source: Kennel, Brown & Abarbanel, Physical Review A 45, 3403 (1992), both criteria, with their 15 and 2.
    """
    x, size = checked_series(series), np.std(series)
    share = np.full(checked_count(max_dimension, "max_dimension"), np.nan)
    for m in range(1, max_dimension + 1):
        radius, more = _next_coordinate(x, delay, m, theiler, centres, np.inf)
        if len(radius):
            false = (more > FALSE_RATIO * radius) | (np.hypot(radius, more) > FALSE_SIZE * size)
            share[m - 1] = np.mean(false)
    return share


def cao_averages(
    series: ArrayLike, delay: int, max_dimension: int = 8, theiler: int = 0, centres: int = CENTRES
) -> tuple[np.ndarray, np.ndarray]:
    """Cao's E1 and E2 for m = 1 ... max_dimension - 1.

    E1 rises to 1 and stays where the embedding is large enough; E2 differs from 1 at some m for a deterministic series
    and is about 1 at all m for noise. No threshold on distances is needed.
    Arguments as in false_neighbours. Returns (e1, e2), arrays (max_dimension - 1,).
    Source: Cao, Physica D 110, 43 (1997).
    """
    x = checked_series(series)
    count = checked_count(max_dimension, "max_dimension", least=2)
    growth, change = np.full(count, np.nan), np.full(count, np.nan)
    for m in range(1, count + 1):
        radius, more = _next_coordinate(x, delay, m, theiler, centres, 2.0)
        if np.any(radius > 0.0):
            growth[m - 1] = np.mean((np.maximum(radius, more) / np.where(radius > 0.0, radius, 1.0))[radius > 0.0])
            change[m - 1] = np.mean(more)
    with np.errstate(divide="ignore", invalid="ignore"):
        return growth[1:] / growth[:-1], change[1:] / change[:-1]


def choose_embedding(
    series: ArrayLike, delay: int | None = None, max_dimension: int = 8, theiler: int | None = None
) -> EmbeddingChoice:
    """Delay and embedding dimension of a series, with every curve that led to them.

    series (n,)       any unit
    delay             [samples]; None: choose_delay
    max_dimension     largest m looked at; it is the answer, and `reason` says so, where neither rule speaks
    theiler           [samples]; None: one mean period
    Returns an EmbeddingChoice. The dimension is the smallest that unfolds the motion; it is not the dimension of the
    attractor, and twice that of the attractor plus one may be needed (Sauer, Yorke & Casdagli 1991).
    Raises ValueError for values that are not finite or a series too short.
    Source: Kennel et al. (1992) and Cao (1997), as in false_neighbours and cao_averages.
    """
    x = checked_series(series)
    chosen = choose_delay(x)
    lag = chosen.delay if delay is None else checked_count(delay, "delay")
    theiler = round(chosen.mean_period) if theiler is None else int(theiler)
    share = false_neighbours(x, lag, max_dimension, theiler)
    e1, e2 = cao_averages(x, lag, max_dimension, theiler)
    kennel = _first(share <= np.nanmin(share) + FALSE_SHARE) if np.nanmin(share) <= FALSE_AT_MOST else None
    cao = _first(e1 >= CAO_LEVEL)
    words = f"false neighbours: {kennel or 'none'}, Cao: {cao or 'none'} of dimensions up to {max_dimension}"
    chosen_m = kennel or cao or max_dimension
    reason = words if kennel or cao else f"{words}: noise, or a motion of higher dimension"
    curves = locked(share), locked(e1), locked(e2)
    return EmbeddingChoice(chosen_m, kennel, cao, reason, lag, chosen.mean_period, chosen, theiler, *curves)


def _first(holds):
    """Dimension of the first True, or None."""
    return int(np.argmax(holds)) + 1 if np.any(holds) else None


def _next_coordinate(x, delay, m, theiler, centres, norm):
    """For sampled points: distance to the nearest neighbour in m dimensions, and apart in coordinate m + 1."""
    points = delay_vectors(x, delay, m + 1)
    following, points = points[:, m], np.ascontiguousarray(points[:, :m])
    rows = np.random.default_rng(0).choice(len(points), min(centres, len(points)), replace=False)
    index, distance = nearest_outside(points, theiler, rows)
    index, distance = index[:, 0], distance[:, 0]
    fine = index >= 0
    if norm != np.inf:  # Cao's norm is the largest coordinate difference of that neighbour
        distance = np.max(np.abs(points[rows] - points[index]), axis=1)
    return distance[fine], np.abs(following[rows] - following[index])[fine]
