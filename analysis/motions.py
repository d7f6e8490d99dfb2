"""Motions of a forced system: when one has settled, whether two are the same, whether a start has joined a known one.

A motion is what remains of a run when its transient has died out. It is kept as rows: the strobed state at the start of
a period, and measures of that period (its least radius, its largest tension). Two rows are as far apart as their
coordinates differ at most, a state in `scale`, a measure as a share of its largest size.

    settled   a period: `detect_period` on the later half. Otherwise the last two thirds are cut in two windows, and
              each is the other's equal: rows of the one lie on the rows of the other, and do not march
    joined    the last rows lie on the known motion: on its orbit in the right order, or in its cloud as close as the
              cloud's own rows are to each other; or its distance from the orbit decays towards nothing
    distance  of two clouds A and B: the mean distance of a row of A from the nearest row of B, less the distance of
              neighbours in B, and the other way round: the larger, but of two motions without a period the smaller
    shares    of the starts, with Wilson's interval

How often each is wrong, and after how many periods it answers: docs/motions.md#which-motion-a-start-ends-in.
"""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from analysis.periods import PeriodEstimate, detect_period
from analysis.sampling import checked_columns, checked_count, checked_positive, record, record_of_numbers
from analysis.stationarity import record_drift

LEAST_WINDOW = 30  # periods of each of two windows of a motion without a period
LIKE = 1.5  # distance across two windows, in distances of neighbours within
COMES_NEARER = 0.7  # what is left, in the later half, of the steps towards a period or of the distance from an orbit
CLOSE = 20.0  # tolerances within which steps towards a period count
LAST = 8  # rows that have to lie in a cloud, or beyond one period near an orbit
ENDED = 1e-3  # a step from round to round below which it has none
THERE = 0.02  # distance from an orbit at which a run need not come nearer
DECAY, FADES = 12, 0.1  # periods of a window of a decay, and the least share of the distance that it loses in one
AS_CLOSE = 2.0  # mean distance of the last rows from a cloud, in distances of its neighbours
OF_CLOUD = 0.3  # the same, in tolerances
APART = 0.1  # distance from which two settled motions are two


@record
class Settled:
    """A motion that has settled.

    period          of a periodic motion, in forcing periods; None for one that repeats in distribution only
    points (m, d)   strobed states: the orbit in its order (m = period), or those of the window it was judged by
    measures (m, e) of the periods that begin there
    scale (d,)      what counts as 1 in each coordinate of a state
    reason          one sentence: why it counts as settled
    """

    period: int | None
    points: np.ndarray
    measures: np.ndarray
    scale: np.ndarray
    reason: str


@record_of_numbers
class Share:
    """The share of starts that end in one motion, and the ends of its confidence interval."""

    share: float
    low: float
    high: float


def settled(
    strobed: ArrayLike, measures: ArrayLike, *, scale: ArrayLike, tolerance: float = 0.01, max_period: int = 16
) -> Settled | None:
    """The motion that a run has settled on, or None: not yet.

    strobed (n + 1, d)   states once a period, from the start of the run on; an angle that turns round and round must
                         come as its cosine and sine
    measures (n, e)      of each period
    scale (d,)           size of the motion within the period, in each coordinate
    tolerance            share of the scale within which an orbit repeats; branches nearer than this are one
    max_period           largest period looked for
    Returns a Settled: with a period from 30 periods on, without one from 90 on. A run
    that passes by an unstable orbit, or through long transient chaos, looks settled while it lasts; no test of the
    states so far can tell (rates: docs/motions.md#which-motion-a-start-ends-in).
    Raises ValueError for values that are not finite or lengths that do not fit.
    """
    x, e, scale = _checked(strobed, measures, scale)
    late = x[len(x) // 2 :]
    estimate = detect_period(late, max_period, tolerance, scale)
    if estimate.period is not None:
        period = estimate.period
        rounds = max(len(late) // 2 // period, 1)
        mean = e[-rounds * period :].reshape(rounds, period, -1).mean(axis=0)
        # The orbit ends with the last state, the measures with the period before it.
        return Settled(period, np.roll(estimate.orbit, 1, axis=0), mean, scale, estimate.reason)
    window = (len(e) - len(e) // 3) // 2
    if window < LEAST_WINDOW or _comes_nearer(late, estimate):
        return None
    rows = _rows(x[:-1], e, scale, _size(e))
    first, second = rows[-2 * window : -window], rows[-window:]
    within = max(_spacing(first), _spacing(second))
    across = max(_nearest(first, second).mean(), _nearest(second, first).mean())
    if across > LIKE * within or record_drift(rows[-2 * window :]).drifting:
        return None
    distances = f"lie {across:.2g} of the scale apart, neighbours within them {within:.2g}"
    reason = f"no period up to {max_period}; two windows of {window} periods {distances}"
    return Settled(None, x[-2 * window - 1 : -1], e[-2 * window :], scale, reason)


def joins(strobed: ArrayLike, measures: ArrayLike, known: Sequence[Settled], *, tolerance: float = 0.2) -> int | None:
    """Which known motion a run has reached or will reach, or None: none yet.

    The last `period + 8` rows lie within the tolerance of an orbit, in its order, and the later half of them 0.7 times
    as far as the earlier one, or nearer; or all of them within 0.02; or the last of three windows of a dozen periods
    lies within the tolerance, and the distance decays from one to the next towards nothing. In a cloud, the last 8 rows
    are in the mean nearer than twice its neighbours are, or than 0.3 of the tolerance.

    strobed (n + 1, d), measures (n, e)   of the run so far, as in `settled`; only the last rows count
    known                                 settled motions of the same system
    Returns the index of the motion that is nearest of those reached. It costs 0.1 ms a motion: ask after every period.
    Raises ValueError for values that are not finite, or lengths that do not fit.
    """
    if len(strobed) != len(measures) + 1:
        raise ValueError(f"measures: {len(strobed) - 1} rows are needed, given {len(measures)}")
    count = 1
    for motion in known:
        count = max(count, (motion.period or 1) + LAST, 3 * _window(motion))
    x, e = checked_columns(strobed[-count - 1 :], "strobed"), checked_columns(measures[-count:], "measures")
    reached = {}
    for index, motion in enumerate(known):
        distance_from = _from_orbit if motion.period else _from_cloud
        mean_distance = distance_from(x, e, motion, tolerance)
        if mean_distance is not None:
            reached[index] = mean_distance
    return min(reached, key=reached.get, default=None)


def remains(strobed: ArrayLike, measures: ArrayLike, motion: Settled, *, threshold: float = APART) -> bool:
    """Whether a run that began on a motion is on it still, although its system has been changed a little.

    It has joined the motion (`joins`). Or the orbit has moved with the system: the last `period + 8` rows lie within
    the threshold of the old one, and their steps from round to round have ended or die out.

    strobed (n + 1, d), measures (n, e)   of the run, as in `settled`
    Raises as `joins`.
    """
    if joins(strobed, measures, [motion]) is not None:
        return True
    if not motion.period:
        return False
    count = motion.period + LAST
    x, e = checked_columns(strobed[-count - 1 :], "strobed"), checked_columns(measures[-count:], "measures")
    if len(e) < count or _off_orbit(x, e, motion, count, count).max() > threshold:
        return False
    rows = _rows(x[:-1], e, motion.scale, _size(motion.measures))
    steps = rows[motion.period :] - rows[: -motion.period]
    early, late = _rms(steps[: LAST // 2]), _rms(steps[-(LAST // 2) :])
    return bool(late <= max(COMES_NEARER * early, ENDED))


def distance(a: Settled, b: Settled) -> float:
    """How far two settled motions are apart, in their larger scale (head of this file): 0 for one and the same.

    Two records of one motion of the buoy are 0.05 apart at most, its motions 0.3 or more (docs/motions.md).
    """
    scale = np.maximum(a.scale, b.scale)
    size = np.maximum(_size(a.measures), _size(b.measures))
    rows_a, rows_b = _rows(a.points, a.measures, scale, size), _rows(b.points, b.measures, scale, size)
    distances = []
    for rows, targets, motion in ((rows_a, rows_b, b), (rows_b, rows_a, a)):
        distances.append(float(_nearest(rows, targets).mean()))
        if not motion.period:
            distances[-1] -= _spacing(targets)
    if a.period or b.period:
        return max(0.0, *distances)
    # A record of chaos may have stayed in one part of its cloud: then it lies on the other, and not the other on it.
    return max(0.0, min(distances))


def grouped(motions: Sequence[Settled], *, threshold: float = APART) -> np.ndarray:
    """Which settled runs are one motion: labels (n,), 0 for that of the first, then in the order of appearance.

    threshold   mean `distance` below which two groups are joined (average linkage)
    """
    if len(motions) < 2:
        return np.zeros(len(motions), dtype=int)
    from scipy.cluster.hierarchy import fcluster, linkage

    pairs = [distance(a, b) for i, a in enumerate(motions) for b in motions[i + 1 :]]
    label = fcluster(linkage(pairs, "average"), threshold, "distance")
    order = list(dict.fromkeys(label))
    return np.array([order.index(group) for group in label])


def matched(earlier: Sequence[Settled], later: Sequence[Settled], *, threshold: float = 0.3) -> list[int | None]:
    """Which motion at the next value of a parameter continues which: the pairs of least total `distance`.

    threshold   distance beyond which a motion has ended or begun instead
    Returns for each of `earlier` the index in `later`, or None.
    """
    from scipy.optimize import linear_sum_assignment

    cost = np.empty((len(earlier), len(later)))
    for i, a in enumerate(earlier):
        for j, b in enumerate(later):
            cost[i, j] = min(distance(a, b), 2.0 * threshold)
    partners: list[int | None] = [None] * len(earlier)
    for i, j in zip(*linear_sum_assignment(cost), strict=True):
        if cost[i, j] < threshold:
            partners[i] = int(j)
    return partners


def share_of(count: int, of: int, confidence: float = 0.95) -> Share:
    """Share `count`/`of` of starts drawn at random, with Wilson's interval (E. B. Wilson, JASA 22 (1927) 209)."""
    from scipy.stats import binomtest

    count, of = checked_count(count, "count", least=0), checked_count(of, "of")
    interval = binomtest(count, of).proportion_ci(confidence, method="wilson")
    return Share(count / of, interval.low, interval.high)


def _checked(strobed, measures, scale):
    x, e = checked_columns(strobed, "strobed"), checked_columns(measures, "measures")
    if len(x) != len(e) + 1:
        raise ValueError(f"measures: {len(x) - 1} rows are needed for {len(x)} states, given {len(e)}")
    scale = np.broadcast_to(np.array(scale, dtype=float), x.shape[1])
    for entry in scale:
        checked_positive(entry, "scale")
    return x, e, scale


def _size(measures):
    size = np.abs(measures).max(axis=0, initial=0.0)
    return np.where(size > 0.0, size, 1.0)


def _rows(points, measures, scale, size):
    return np.hstack([points / scale, measures / size])


def _nearest(rows, targets):
    """Distance of each row from the nearest of the others."""
    from scipy.spatial import cKDTree

    return cKDTree(targets).query(rows, p=np.inf)[0]


def _spacing(rows):
    """Mean distance of a row from its nearest neighbour."""
    from scipy.spatial import cKDTree

    return float(cKDTree(rows).query(rows, k=2, p=np.inf)[0][:, 1].mean())


def _from_orbit(x, e, motion, tolerance):
    """Mean distance of the last rows from the orbit, in its order; None where they are off it or do not come nearer."""
    count = motion.period + LAST
    if len(e) < count:
        return None
    distances = _off_orbit(x, e, motion, count, count)
    early, late = _rms(distances[: count // 2]), _rms(distances[-(count // 2) :])
    comes = distances.max() <= tolerance and late <= COMES_NEARER * early
    if comes or distances.max() <= THERE or _decays(x, e, motion, tolerance):
        return float(distances.mean())
    return None


def _off_orbit(x, e, motion, count, judged):
    """Distances (count,) of the last rows from the orbit, in that order of its points in which the last `judged` of
    them lie nearest."""
    size, orbit = _in_rows(motion)
    rows = _rows(x[-count - 1 : -1], e[-count:], motion.scale, size)
    nearest = None
    for shift in range(motion.period):
        distances = np.abs(rows - orbit[(np.arange(count) + shift) % motion.period]).max(axis=1)
        if nearest is None or distances[-judged:].max() < nearest[-judged:].max():
            nearest = distances
    return nearest


def _rms(values):
    return np.sqrt(np.mean(values**2))


def _window(motion):
    """Periods of a window of a decay: whole rounds of the orbit."""
    period = motion.period or 1
    return period * -(-DECAY // period)


def _decays(x, e, motion, tolerance):
    """Whether the distance from an orbit dies out over three windows, by Aitken's limit of a geometric decay."""
    window = _window(motion)
    if len(e) < 3 * window:
        return False
    windows = _off_orbit(x, e, motion, 3 * window, window).reshape(3, window)
    first, second, third = map(_rms, windows)
    earlier_loss, later_loss = first - second, second - third
    if windows[2].max() > tolerance or later_loss < FADES * third:
        return False
    return bool(earlier_loss <= later_loss or third - later_loss**2 / (earlier_loss - later_loss) <= THERE)


def _from_cloud(x, e, motion, tolerance):
    """Mean distance of the last rows from a cloud; None where they are off it."""
    if len(e) < LAST:
        return None
    size, tree, spacing = _as_cloud(motion)
    rows = _rows(x[-LAST - 1 : -1], e[-LAST:], motion.scale, size)
    mean_distance = float(tree.query(rows, p=np.inf)[0].mean())
    if mean_distance > max(AS_CLOSE * spacing, OF_CLOUD * tolerance):
        return None
    return mean_distance


@lru_cache(maxsize=512)
def _in_rows(motion):
    """Size of the measures of a motion, and its rows."""
    size = _size(motion.measures)
    return size, _rows(motion.points, motion.measures, motion.scale, size)


@lru_cache(maxsize=512)
def _as_cloud(motion):
    """Size of the measures of a motion, its rows as a tree, and the distance of neighbours."""
    from scipy.spatial import cKDTree

    size, rows = _in_rows(motion)
    return size, cKDTree(rows), _spacing(rows)


def _comes_nearer(x, estimate: PeriodEstimate):
    """Whether the steps of the nearest period are small and shrink, in the mean and at most: it is on its way there."""
    if not np.isfinite(estimate.residual).any():
        return False
    nearest = int(np.nanargmin(estimate.residual)) + 1
    step = (x[nearest:] - x[:-nearest]) / estimate.scale
    early, late = _rms(step[: len(step) // 2]), _rms(step[-(len(step) // 2) :])
    projected = np.exp(estimate.trend_nats_per_period[nearest - 1] * (estimate.points // 4))
    near = estimate.residual[nearest - 1] < CLOSE * estimate.tolerance
    return bool(near and late < COMES_NEARER * early and projected < COMES_NEARER)
