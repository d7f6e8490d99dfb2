"""Delay vectors, their delay and their dimension, and the white noise that they carry.

X_i = (x_i, x_{i+L}, ..., x_{i+(m-1)L}),     i = 0 ... n - 1 - (m-1)L      L in samples, m the dimension (Takens 1981)

The delay, by average mutual information (Fraser & Swinney 1986); p_ab: share of pairs (x_i, x_{i+L}) in cell (a, b):

    I(L) = sum_ab p_ab(L) ln[ p_ab(L)/(p_a p_b) ]     nats

The dimension, by false nearest neighbours (Kennel et al. 1992) and Cao's averages (1997). A neighbour in m dimensions
is false when one coordinate more drives it away: it was near only in projection. With R_m the distance of a point to
its nearest neighbour in m dimensions and z the distance in coordinate m + 1,

    false if   z > 15 R_m   or   sqrt(R_m^2 + z^2) > 2 s              s: standard deviation of the series   (Kennel)

    E(m) = mean max(R_m, z)/R_m,   E1(m) = E(m+1)/E(m),   R in the largest-coordinate norm                         (Cao)
    E2(m) = mean z at m + 1 / mean z at m:   1 for every m when the future does not depend on the past (noise)
"""

from math import comb

import numpy as np
from numpy.typing import ArrayLike

from analysis.neighbours import nearest_outside
from analysis.sampling import checked_count, checked_series, record

LEAST_SAMPLES_PER_PERIOD = 6.0
PERIODS_SEARCHED = 3.0
FALSE_RATIO = 15.0
FALSE_SIZE = 2.0
FALSE_SHARE = 0.01
FALSE_AT_MOST = 0.2
CAO_LEVEL = 0.9
MOST_DIMENSIONS = 8
# Points asked about where a statistic over the attractor is enough; drawn with a fixed seed, so that the same record
# gives the same answer.
CENTRES = 2000
NOISE_CENTRES = 400
NOISE_REACH = 3
LEAST_LEVELS = 16  # different values of a record in steps
OFF_A_STEP = 0.01  # share of a step by which a value may miss a multiple of it: rounding of numbers


@record
class DelayChoice:
    """A delay and the curve from which it was read.

    delay                    [samples]
    reason                   one sentence: first minimum, or what was taken for want of one
    information (k + 1,)     I(L) at L = 0 ... k [nats]; I(0) is the entropy of the cells
    cells                    cells per axis, equally filled
    mean_period              mean period of the series [samples]
    """

    delay: int
    reason: str
    information: np.ndarray
    cells: int
    mean_period: float


@record
class EmbeddingChoice:
    """Delay and dimension of an embedding with the curves from which they were read; index m - 1 belongs to m.

    dimension                the choice: by false neighbours, else by Cao
    by_false_neighbours      first m whose share of false neighbours is within 0.01 of the least; None where even that
                             is more than 0.2: what is then folded is noise
    by_cao                   first m with E1 of at least 0.9; None if there is none
    reason                   one sentence: what each rule says
    lag                      delay used [samples]
    mean_period              mean period of the series [samples]
    delay                    DelayChoice: what mutual information says
    theiler                  Theiler window, one mean period [samples]
    false_share (k,)         share of false neighbours, m = 1 ... k
    e1, e2 (k - 1,)          Cao's ratios, m = 1 ... k - 1; e2 differs from 1 at some m for a deterministic series and
                             is about 1 at all m for noise
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


def delay_vectors(series: ArrayLike, delay: int, dimension: int) -> np.ndarray:
    """The delay vectors of a series, one a row.

    series (n,)    samples, any unit
    delay          L [samples]
    dimension      m
    Returns a float array (n - (m-1) L, m); row i begins with sample i.
    Raises ValueError for values that are not finite, or a series too short for a single vector.
    Source: Takens, Lecture Notes in Mathematics 898, 366 (1981).
    """
    x = checked_series(series)
    delay, dimension = checked_count(delay, "delay"), checked_count(dimension, "dimension")
    rows = len(x) - (dimension - 1) * delay
    if rows < 1:
        wanted = f"delay vectors of dimension {dimension} and delay {delay} need {(dimension - 1) * delay + 1} samples"
        raise ValueError(f"{wanted}, given {len(x)}")
    return np.stack([x[j * delay : j * delay + rows] for j in range(dimension)], axis=1)


def mean_period(series: ArrayLike) -> float:
    """Mean period of a series in samples: the reciprocal of the mean frequency of its power spectrum.

        f = sum_k f_k |X_k|^2 / sum_k |X_k|^2,   mean removed, Hann window

    Half the range for a constant series (nothing oscillates). Used by Rosenstein et al. (1993) for the Theiler window;
    here also as the unit of evolution times. A broad-band signal, or strong white noise, shortens it.
    Raises ValueError for values that are not finite.
    """
    x = checked_series(series)
    power = np.abs(np.fft.rfft((x - x.mean()) * np.hanning(len(x)))) ** 2
    weighted = np.sum(np.fft.rfftfreq(len(x)) * power)
    longest = 0.5 * len(x)
    if weighted <= 0.0:
        return longest
    return float(min(np.sum(power) / weighted, longest))


def mutual_information(series: ArrayLike, max_delay: int) -> tuple[np.ndarray, int]:
    """Average mutual information I(L) of a series with itself L samples later [nats], L = 0 ... max_delay.

    The cells hold equal shares of the samples, so I does not change under any monotone rescaling of the series. Per
    axis they are (pairs/20)^(1/2), 4 ... 32, so that even full scatter leaves about 20 pairs a cell.
    Returns (information (max_delay + 1,), cells).
    Raises ValueError for values that are not finite, or max_delay not below half the length.
    Source: Fraser & Swinney, Physical Review A 33, 1134 (1986), on a fixed partition.
    """
    x = checked_series(series)
    max_delay = checked_count(max_delay, "max_delay")
    if max_delay >= len(x) // 2:
        raise ValueError(f"max_delay: less than half of the {len(x)} samples is needed, given {max_delay}")
    cells = int(np.clip(np.sqrt(len(x) / 20.0), 4, 32))
    # Equal values share a cell: ranks by value, not by order, or a constant stretch would be cut by chance.
    edges = np.quantile(x, np.arange(1, cells) / cells)
    label = np.searchsorted(edges, x, side="right")
    information = np.empty(max_delay + 1)
    for lag in range(max_delay + 1):
        joint = np.bincount(label[: len(x) - lag] * cells + label[lag:], minlength=cells * cells).astype(float)
        joint = joint.reshape(cells, cells) / (len(x) - lag)
        independent = joint.sum(axis=1, keepdims=True) * joint.sum(axis=0, keepdims=True)
        filled = joint > 0.0
        information[lag] = np.sum(joint[filled] * np.log(joint[filled] / independent[filled]))
    return information, cells


def choose_delay(series: ArrayLike) -> DelayChoice:
    """Delay at the first minimum of the average mutual information.

    A minimum is a lag that no other within a tenth of a mean period undercuts, I being smoothed over (1/4, 1/2, 1/4):
    the scatter of I makes shorter dips by chance. (To ask for a depth as well loses the well-known shallow minimum of
    the Lorenz system.) The delay is never longer than a quarter of the mean period, the lag
    at which a sine and its delayed copy are independent: a motion that hops between two wells loses information for
    many swings, and vectors that span several of them are folded by the dynamics. A quarter is also taken where there
    is no minimum. A series with fewer than six samples per mean period (a map, a strobed record) has nothing between
    its samples: delay 1.

    series (n,)    samples, any unit
    Returns a DelayChoice; `reason` says which rule spoke, `information` is the curve to draw.
    Raises ValueError for values that are not finite or fewer than 50 samples.
    Source: Fraser & Swinney, Physical Review A 33, 1134 (1986).
    """
    x = checked_series(series)
    if len(x) < 50:
        raise ValueError(f"series: 50 samples at least are needed, given {len(x)}")
    period = mean_period(x)
    max_delay = int(min(max(np.ceil(PERIODS_SEARCHED * period), 10), len(x) // 2 - 1))
    information, cells = mutual_information(x, max_delay)
    if period < LEAST_SAMPLES_PER_PERIOD:
        delay, reason = 1, f"delay 1: {period:.2g} samples per mean period leave nothing between the samples"
    else:
        quarter = max(1, round(period / 4))
        minimum = _first_minimum(information, max(1, round(period / 10)))
        delay = quarter if minimum is None else min(minimum, quarter)
        reason = f"first minimum of the mutual information, {information[delay]:.3g} nats"
        if delay != minimum:
            minimum_text = f"none up to {max_delay}"
            if minimum:
                minimum_text = f"at {minimum}"
            reason = f"a quarter of the mean period; first minimum of the mutual information: {minimum_text} samples"
    return DelayChoice(delay, reason, information, cells, period)


def _first_minimum(information, reach):
    """First lag that no other within `reach` on either side undercuts, or None; smoothed over three lags."""
    smooth = information.copy()
    smooth[1:-1] = 0.25 * information[:-2] + 0.5 * information[1:-1] + 0.25 * information[2:]
    for lag in range(1, len(smooth) - reach):
        if smooth[lag] <= smooth[max(lag - reach, 0) : lag + reach + 1].min() < smooth[lag + reach]:
            return lag
    return None


def choose_embedding(series: ArrayLike) -> EmbeddingChoice:
    """Delay and embedding dimension of a series, with every curve that led to them.

    Noise makes false neighbours in every dimension: their share levels off above zero, and rises again. E1 rises to 1
    and stays where the embedding is large enough.

    series (n,)       any unit
    The delay is that of choose_delay. The largest m looked at is 8, or the last that the record has room for; 8 is the
    answer, and `reason` says so, where neither rule speaks.
    Returns an EmbeddingChoice. The dimension is the smallest that unfolds the motion; it is not the dimension of the
    attractor, and twice that of the attractor plus one may be needed (Sauer, Yorke & Casdagli 1991).
    Raises ValueError for values that are not finite or a series too short.
    Source: Kennel, Brown & Abarbanel, Physical Review A 45, 3403 (1992), both criteria, with their 15 and 2; Cao,
    Physica D 110, 43 (1997).
    """
    x = checked_series(series)
    chosen = choose_delay(x)
    lag, theiler = chosen.delay, round(chosen.mean_period)
    share, growth, change = np.full((3, MOST_DIMENSIONS), np.nan)
    longest = (len(x) - 1) // lag  # delays in the record
    for m in range(1, min(MOST_DIMENSIONS, longest) + 1):
        separation, radius, next_coordinate = _next_coordinate(x, lag, m, theiler)
        if len(separation):
            driven_away = next_coordinate > FALSE_RATIO * separation
            too_far = np.hypot(separation, next_coordinate) > FALSE_SIZE * np.std(x)
            share[m - 1] = np.mean(driven_away | too_far)
        separated = radius > 0.0
        if np.any(separated):
            growth[m - 1] = np.mean(np.maximum(radius, next_coordinate)[separated] / radius[separated])
            change[m - 1] = np.mean(next_coordinate)
    with np.errstate(divide="ignore", invalid="ignore"):
        e1, e2 = growth[1:] / growth[:-1], change[1:] / change[:-1]
    kennel = None
    if np.nanmin(share) <= FALSE_AT_MOST:
        kennel = _first(share <= np.nanmin(share) + FALSE_SHARE)
    cao = _first(e1 >= CAO_LEVEL)
    words = f"false neighbours: {kennel or 'none'}, Cao: {cao or 'none'} of dimensions up to {MOST_DIMENSIONS}"
    if not (kennel or cao):
        words += ": noise, or a motion of higher dimension"
    dimension = kennel or cao or MOST_DIMENSIONS
    return EmbeddingChoice(dimension, kennel, cao, words, lag, chosen.mean_period, chosen, theiler, share, e1, e2)


def _first(holds):
    """Dimension of the first True, or None."""
    return int(np.argmax(holds)) + 1 if np.any(holds) else None


def _next_coordinate(x, delay, m, theiler):
    """For sampled points: distance to the nearest neighbour in m dimensions, its largest coordinate difference (Cao's
    norm), and how far apart the two are in coordinate m + 1."""
    points = delay_vectors(x, delay, m + 1)
    following, points = points[:, m], np.ascontiguousarray(points[:, :m])
    rows = np.random.default_rng(0).choice(len(points), min(CENTRES, len(points)), replace=False)
    index, distance = nearest_outside(points, theiler, rows)
    index, distance = index[:, 0], distance[:, 0]
    fine = index >= 0
    rows, index = rows[fine], index[fine]
    largest = np.max(np.abs(points[rows] - points[index]), axis=1)
    return distance[fine], largest, np.abs(following[rows] - following[index])


def noise_level(series: ArrayLike, delay: int) -> float:
    """Standard deviation of the white noise on a series, from above: the smaller of two estimates.

        differences   median |D^k x| / (0.6745 sqrt(C(2k, k))), least over k = 1 ... 8: noise is what is left when a
                      signal sampled finely is differenced away
        local fit     median residual of x_i fitted linearly on three samples before and after it (delay apart) over its
                      nearest neighbours: noise is what neighbours do not agree on

    The first serves flows, the second maps. What the fit cannot follow (curvature, too few neighbours) counts as noise,
    so a clean map shows a small number, not 0. Slow or coloured noise looks like signal to both.

    A record in steps (a logger of 8 bits, a file with three decimals) carries the error of rounding, too, which is no
    white noise: the level is at least that of the steps, step/sqrt(12).

    series (n,)    any unit
    delay          [samples]; a short record (100 samples) takes one that leaves it enough neighbours
    Returns the level in the unit of the series.
    Raises ValueError for values that are not finite or a series too short for one neighbourhood.
    Source: the local fit is the residual of local linear noise reduction, Kantz & Schreiber, Nonlinear Time Series
    Analysis, section 10.3.
    """
    from scipy.spatial import cKDTree

    x = checked_series(series)
    level, difference = np.std(x), x
    for order in range(1, 9):
        difference = np.diff(difference)
        level = min(level, np.median(np.abs(difference)) / (0.6745 * np.sqrt(comb(2 * order, order))))
    reach = 2 * NOISE_REACH
    neighbours = 6 * (reach + 1)
    vectors = delay_vectors(x, max(1, min(delay, (len(x) - 2 * neighbours) // reach)), reach + 1)
    middle, neighbours_of_middle = vectors[:, NOISE_REACH], np.delete(vectors, NOISE_REACH, axis=1)
    if len(vectors) < 2 * neighbours:
        raise ValueError(f"noise level: {2 * neighbours} delay vectors at least are needed, given {len(vectors)}")
    rows = np.random.default_rng(1).choice(len(vectors), min(NOISE_CENTRES, len(vectors)), replace=False)
    _, near = cKDTree(neighbours_of_middle).query(neighbours_of_middle[rows], neighbours)
    residual = np.empty(len(rows))
    for k, (row, j) in enumerate(zip(rows, near, strict=True)):
        terms = np.column_stack([np.ones(neighbours), neighbours_of_middle[j] - neighbours_of_middle[row]])
        fit = terms @ np.linalg.lstsq(terms, middle[j], rcond=None)[0]
        residual[k] = np.sqrt(np.sum((middle[j] - fit) ** 2) / (neighbours - terms.shape[1]))
    return float(max(min(level, np.median(residual)), recorded_step(x) / np.sqrt(12.0)))


def recorded_step(series: np.ndarray) -> float:
    """The step in which a series (n,) was recorded: each value lies a whole number of such steps above the least one.

    0 where there is none, or where fewer than LEAST_LEVELS values differ: these may be the points of a short period.
    """
    levels = np.unique(series)
    if len(levels) < LEAST_LEVELS:
        return 0.0
    step = np.diff(levels).min()
    multiples = (levels - levels[0]) / step
    if np.abs(multiples - np.rint(multiples)).max() > OFF_A_STEP:
        return 0.0
    return float(step)
