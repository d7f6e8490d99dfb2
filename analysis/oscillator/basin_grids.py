"""Coexisting attractors of eq. (33): on which one does each start end, and what share of the starts has each?"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from analysis.compiled import kernel
from analysis.oscillator.equation import SnapOscillator
from analysis.oscillator.motions import checked_starts
from analysis.oscillator.newton_orbits import periodic_orbit
from analysis.oscillator.pieces import tables
from analysis.oscillator.strobing import MOST_PIECES, next_state, strobed_orbit
from analysis.sampling import checked_count

PAPER_BOX = (-60.0, 20.0, -25.0, 25.0)  # g low, g high, g' low, g' high: the attractors and their surroundings
_LOOK_EVERY = 64
_NEARLY = 1e-3


@dataclass(frozen=True, eq=False)
class SnapBasins:
    """Where a set of starts ends.

    label (n,)          index into `orbits`; `len(orbits)` for starts that did not
                        settle on a periodic orbit within the time given (a chaotic attractor, or a long transient)
    settled (n,)        periods after which the orbit was seen to repeat; -1 for the others
    orbits              tuple of (period, 2) arrays: the strobed points of each periodic attractor found, in order,
                        the one with the most starts first
    shares              (len(orbits) + 1,) share of the starts on each, the aperiodic last
    errors              binomial standard errors of the shares, as if the starts had been drawn at random
    periods             forcing periods given to every start
    """

    label: np.ndarray
    settled: np.ndarray
    orbits: tuple[np.ndarray, ...]
    shares: np.ndarray
    errors: np.ndarray
    periods: int


def start_grid(columns: int, rows: int, box: tuple[float, float, float, float] = PAPER_BOX) -> np.ndarray:
    """Starts at the cell centres of a grid over a box in the (g, g') plane, for basins drawn as an image.

    columns, rows   cells along g and g';  box  (g low, g high, g' low, g' high), by default PAPER_BOX
    Returns (rows*columns, 2), g varying fastest.
    """
    columns, rows = checked_count(columns, "columns"), checked_count(rows, "rows")
    g = box[0] + (box[1] - box[0]) * (np.arange(columns) + 0.5) / columns
    v = box[2] + (box[3] - box[2]) * (np.arange(rows) + 0.5) / rows
    return np.stack(np.meshgrid(g, v), axis=-1).reshape(-1, 2)


def snap_basins(
    oscillator: SnapOscillator, starts: ArrayLike, periods: int = 3000, longest_period: int = 32
) -> SnapBasins:
    """Basins of eq. (33): the periodic attractors that starts end on, each verified by Newton's method.

    An orbit that repeats itself to 1e-3 after p periods is a candidate only: attraction may be slow (the period-8 orbit
    of the paper's parameters has a multiplier of -0.965), and a chaotic orbit returns that close by chance. It has
    settled when Newton's method, begun there, finds a stable orbit of that period, and the start's own orbit is nearer
    to it 64 p periods later than it was; otherwise it goes on with the periods it has left.

    starts           (n, 2) states at time 0 (`start_grid`, or random)
    periods          forcing periods given to each; a start that has not settled by then is called aperiodic, which for
                     a slowly attracting orbit only means "not yet": look at `settled`
    longest_period   looked for
    Returns SnapBasins. ValueError for starts that are not finite. A start whose orbit cannot be computed is aperiodic.
    Source: basins by recurrence, after Datseris & Wagemakers 2022, with Newton's method in place of cells.
    """
    starts = checked_starts(starts)
    periods, longest = checked_count(periods, "periods"), checked_count(longest_period, "longest_period")
    table = tables(oscillator)
    label, settled, done = np.full(len(starts), -1), np.full(len(starts), -1), np.zeros(len(starts), np.int64)
    orbits: list[np.ndarray] = []
    state, waiting = starts.copy(), np.arange(len(starts))
    while len(waiting):
        ends, period, spent = _until_repeated(state[waiting], periods - done[waiting], longest, table)
        state[waiting], done[waiting] = ends, done[waiting] + spent
        waiting = waiting[period > 0]
        for i, p in zip(waiting, period[period > 0], strict=True):
            if (orbit := _attracted(oscillator, state[i], int(p), table)) is not None:
                label[i], settled[i] = _index(orbits, orbit), done[i]
        waiting = waiting[(label[waiting] < 0) & (done[waiting] < periods)]
    return _counted(label, settled, orbits, periods)


def _attracted(oscillator, state, period, table):
    """Points of the stable orbit on which a state that nearly repeats will end; None where there is none."""
    orbit = periodic_orbit(oscillator, period, state)
    if orbit is None or not orbit.stable:
        return None
    before, after = strobed_orbit(state[0], state[1], 0, 64 * period + 1, table)[[0, -1]]
    return orbit.points if _distance(after, orbit.points) <= max(_distance(before, orbit.points), 1e-9) else None


def _index(orbits, orbit):
    for index, other in enumerate(orbits):
        if len(other) == len(orbit) and _distance(orbit[0], other) < 1e-6:
            return index
    orbits.append(orbit)
    return len(orbits) - 1


def _distance(state, orbit):
    return np.abs(state - orbit).max(axis=1).min()


def _counted(label, settled, orbits, periods):
    counts = np.bincount(label[label >= 0], minlength=len(orbits))
    order = np.argsort(-counts, kind="stable")
    rank = np.append(np.argsort(order, kind="stable"), len(orbits))  # the last one serves the label -1
    label = rank[label]
    shares = np.bincount(label, minlength=len(orbits) + 1) / len(label)
    errors = np.sqrt(shares * (1.0 - shares) / len(label))
    return SnapBasins(label, settled, tuple(orbits[i] for i in order), shares, errors, periods)


@kernel
def _until_repeated(starts, periods, longest, table):
    """Every start until it repeats itself (period > 0), or for its `periods`: state, period or 0, periods spent."""
    log = np.empty((MOST_PIECES, 5))
    count = len(starts)
    ends, found, spent = np.empty((count, 2)), np.zeros(count, np.int64), np.zeros(count, np.int64)
    recent = np.empty((2 * longest, 2))
    for i in range(count):
        x, v = starts[i]
        for n in range(periods[i]):
            x, v, _, _ = next_state(x, v, table, log)
            recent[n % (2 * longest), 0], recent[n % (2 * longest), 1] = x, v
            spent[i] = n + 1
            if (n + 1) % _LOOK_EVERY == 0 and n + 1 >= 2 * longest:
                found[i] = _repeats(recent, n, longest)
                if found[i] > 0:
                    break
        ends[i, 0], ends[i, 1] = x, v
    return ends, found, spent


@kernel
def _repeats(recent, n, longest):
    size = len(recent)
    for p in range(1, longest + 1):
        same = True
        for j in range(p):
            for c in range(2):
                # "not <=": a state that is NaN repeats nothing
                if not abs(recent[(n - j) % size, c] - recent[(n - j - p) % size, c]) <= _NEARLY:
                    same = False
        if same:
            return p
    return 0
