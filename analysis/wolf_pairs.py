"""Wolf's method with one setting: the growth of one short vector between two pieces of the same record.

A point of the record, the fiducial, moves on. A neighbour of it in delay space moves along with it for a fixed time e;
the vector between them then has grown from L to L', which is booked as ln(L'/L). Before it leaves the neighbourhood
where growth is linear it is replaced by a shorter one that points the same way, and so on to the end of the record:

    lambda = 1/(K e) sum_k ln( L'_k / L_k )                                                                    (Wolf)

Wolf, Swift, Swinney & Vastano, Physica D 16, 285 (1985), section 5 and the program with fixed evolution time. As there:
a replacement lies between a noise floor and a greatest length; among those the length and the angle to the old vector
decide; where none is within the angle, the length (up to five times) and then the angle are given way, and at last the
old pair is retained. Ours, and why:
- Length and angle add up: score = angle/0.3 rad + L/longest, and the old pair competes with angle 0. The program takes
  the least angle at every step whatever the length, its text the shortest vector. Fresh vectors at every step bias
  regular motions: the shortest neighbour is short partly because the delay map happens to be compressed there.
- The greatest length is a twentieth of the diameter, 2 x rms radius (Wolf: not more than a tenth), but at least twice
  the floor. The floor is twice the rms distance that noise alone puts between two delay vectors, 2 sigma (2m)^(1/2):
  a shorter vector would be mostly noise. Noise that pushes the greatest length beyond a fifth is refused.
- The fiducial's path is known beforehand: every neighbour it will need comes from ONE kd-tree query. Below the floor
  there may be thousands of useless neighbours; the tree then holds a random part of the record, so that the nearest
  32 reach past the floor.
"""

import numpy as np
from numpy.typing import ArrayLike

from analysis.compiled import kernel
from analysis.embedding import delay_vectors
from analysis.sampling import (
    checked_count,
    checked_not_negative,
    checked_positive,
    checked_series,
    record,
    standard_error,
)

ANGLE = 0.3
WIDENINGS = 5
LONGEST_SHARE = 0.05
FLOOR_SIGMAS = 2.0
MOST_SHARE = 0.2
ROUNDING_SHARE = 1e-10
NEIGHBOURS = 32
LEAST_STEPS = 20
BLOCKS = 16


@record
class WolfRun:
    """One fiducial trajectory from end to end of the record.

    value, error          exponent and its standard error from blocks [nats/time]; NaN where too little was followed
    reason                one sentence
    delay, dimension, evolution, theiler    L, m, e and Theiler window [samples]
    floor, longest        bounds of a replacement vector [unit of the series]
    size                  rms distance of the delay vectors from their mean [unit of the series]
    growth (k,)           ln(L'/L) of each evolution [nats]; NaN where no neighbour was found
    end_length (k,)       L' [unit of the series]
    time_s (k,)           end of each evolution, from the start of the record [s]
    convergence (k,)      exponent from everything up to that time [nats/time]: fig. 14 of the paper
    noise_bias            what noise adds to or takes from the exponent, by the lengths before and after [nats/time]
    """

    value: float
    error: float
    reason: str
    delay: int
    dimension: int
    evolution: int
    theiler: int
    floor: float
    longest: float
    size: float
    growth: np.ndarray
    end_length: np.ndarray
    time_s: np.ndarray
    convergence: np.ndarray
    noise_bias: float


def wolf_run(
    series: ArrayLike,
    step_s: float,
    delay: int,
    dimension: int,
    evolution: int,
    theiler: int,
    noise: float = 0.0,
    lengths: float = 1.0,
) -> WolfRun:
    """Largest exponent of a series by Wolf's method with one setting.

    series (n,)    any unit
    step_s         sampling step [s], or 1 for a map
    delay, dimension    of the embedding [samples], m
    evolution      e, time between looks for a replacement [samples]
    theiler        neighbours nearer in time are none [samples]
    noise          standard deviation of the noise on the series [its unit]
    lengths        factor on floor and greatest length; 2 against 1 shows what finite lengths do to the value
    Returns a WolfRun [nats/time]. NaN with a reason when noise leaves no room between floor and greatest length, or
    fewer than 20 evolutions, or less than half of the record, could be followed.
    Raises ValueError for values that are not finite or a record too short for one vector.
    Source: Wolf et al., Physica D 16, 285 (1985).
    """
    x, step_s = checked_series(series), checked_positive(step_s, "step_s")
    evolution = checked_count(evolution, "evolution")
    points = np.ascontiguousarray(delay_vectors(x, delay, dimension))
    size = np.sqrt(np.mean(np.sum((points - points.mean(axis=0)) ** 2, axis=1)))
    noise = checked_not_negative(noise, "noise")
    noise_length = FLOOR_SIGMAS * noise * np.sqrt(2.0 * dimension)
    lengths = checked_positive(lengths, "lengths")
    floor = lengths * max(noise_length, ROUNDING_SHARE * size)
    longest = max(lengths * 2.0 * LONGEST_SHARE * size, 2.0 * floor)
    count = max((len(points) - 1) // evolution, 0)
    growth, end_length = np.full((2, count), np.nan)
    room = longest <= 2.0 * lengths * MOST_SHARE * size
    if size > 0.0 and room and count >= LEAST_STEPS:
        near, distance = _candidates(points, evolution, count, floor, longest)
        follow(points, near, distance, evolution, int(theiler), floor, longest, growth, end_length)
    value, error, reason = _mean_growth(growth, evolution * step_s, room, floor, size)
    followed = np.isfinite(growth)
    with np.errstate(invalid="ignore"):
        convergence = np.cumsum(np.where(followed, growth, 0.0)) / (np.cumsum(followed) * evolution * step_s)
    start_length = end_length / np.exp(growth)
    excess = noise**2 * dimension * (start_length**-2.0 - end_length**-2.0) / (evolution * step_s)
    bias = np.mean(excess[followed]) if np.any(followed) else np.nan
    time_s = (np.arange(count) + 1.0) * evolution * step_s
    settings = (int(delay), int(dimension), evolution, int(theiler), floor, longest, size)
    return WolfRun(value, error, reason, *settings, growth, end_length, time_s, convergence, bias)


def _candidates(points, evolution, count, floor, longest):
    """Neighbours of every point at which the fiducial will stop, nearest first: (index, distance), both (count, k)."""
    from scipy.spatial import cKDTree

    rng = np.random.default_rng(0)
    stops = np.arange(count) * evolution
    probe = rng.choice(stops, min(200, count), replace=False)
    remaining, k = np.arange(len(points)), min(NEIGHBOURS, len(points))
    while True:
        tree = cKDTree(points[remaining], balanced_tree=False, compact_nodes=False)
        reach = np.median(tree.query(points[probe], [k])[0])
        if reach >= min(2.0 * floor, 0.75 * longest) or len(remaining) < 4 * NEIGHBOURS:
            break
        remaining = np.sort(rng.choice(remaining, len(remaining) // 2, replace=False))
    distance, near = tree.query(points[stops], range(1, k + 1))
    return remaining[near], np.ascontiguousarray(distance)


def _mean_growth(growth, time, room, floor, size):
    """Exponent, its error from blocks and the reason, from the growth over evolutions of `time` each."""
    finite = growth[np.isfinite(growth)]
    if size == 0.0:
        return np.nan, np.nan, "the series is constant"
    if not room:
        return np.nan, np.nan, f"noise: vectors would have to be longer than {floor / size:.2g} of the rms radius"
    if len(finite) < LEAST_STEPS or len(finite) < 0.5 * len(growth):
        followed = f"{len(finite)} of {len(growth)} evolutions could be followed"
        return np.nan, np.nan, f"no neighbours: {followed}, {LEAST_STEPS} and half of all are needed"
    blocks = min(BLOCKS, len(finite) // 4)
    means = np.array([block.mean() for block in np.array_split(finite, blocks)]) / time
    return finite.mean() / time, standard_error(means), f"{len(finite)} of {len(growth)} evolutions followed"


@kernel
def follow(points, near, distance, evolution, theiler, floor, longest, growth, end_length):
    """Carry the vector along the fiducial; fills growth and end_length, but where no neighbour was found."""
    n, m = points.shape
    last = n - 1 - evolution
    direction, bounds = np.zeros(m), (last, theiler, floor, longest)
    j, length = -1, 0.0
    for k in range(growth.size):
        i = k * evolution
        if j > last:
            j = -1
        fit = j >= 0 and floor <= length <= longest
        worst = length / longest if fit else np.inf
        j, length = _replacement(points, i, j, length, direction, near[k], distance[k], bounds, worst, fit)
        if j < 0:
            direction[:] = 0.0
            continue
        i += evolution
        j += evolution
        square = 0.0
        for q in range(m):
            direction[q] = points[j, q] - points[i, q]
            square += direction[q] * direction[q]
        grown = np.sqrt(square)
        if grown == 0.0:
            j = -1
            continue
        growth[k] = np.log(grown / length)
        end_length[k] = grown
        length = grown
        for q in range(m):
            direction[q] /= grown


@kernel
def _replacement(points, i, j, length, direction, near, distance, bounds, worst, fit):
    """Index and length of the vector to go on with: the old (j, length) if it is fit and nothing scores better; else
    the best within the angle, giving way first in length, then in angle; else the old one, whatever its length."""
    angle = ANGLE
    while angle < np.pi:
        for wider in range(1, WIDENINGS + 1):
            best, shortest = _best(points, i, direction, near, distance, bounds, wider, angle, worst)
            if best >= 0:
                return best, shortest
            if fit:
                return j, length
        angle *= 2.0
    return j, length


@kernel
def _best(points, i, direction, near, distance, bounds, wider, angle, worst):
    """Neighbour of least score angle/ANGLE + length/longest below `worst`, within `angle` and `wider` times `longest`;
    -1 if none. bounds: last, theiler, floor, longest."""
    best, best_length = -1, 0.0
    last, theiler, floor, longest = bounds
    for c in range(near.size):
        d, candidate = distance[c], near[c]
        if d > wider * longest:
            break
        if d < floor or candidate > last or abs(candidate - i) <= theiler or d / longest >= worst:
            continue
        dot, none = 0.0, True
        for q in range(direction.size):
            dot += direction[q] * (points[candidate, q] - points[i, q])
            none = none and direction[q] == 0.0
        turn = 0.0 if none else np.arccos(min(1.0, abs(dot) / d))
        score = turn / ANGLE + d / longest
        if turn <= angle and score < worst:
            best, best_length, worst = candidate, d, score
    return best, best_length
