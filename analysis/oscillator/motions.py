"""Motions of eq. (33): the strobed states, and the motion between them with its switching times."""

import numpy as np
from numpy.typing import ArrayLike

from analysis.compiled import kernel
from analysis.oscillator.crossings import state_at
from analysis.oscillator.equation import SnapOscillator
from analysis.oscillator.pieces import Piece, tables
from analysis.oscillator.strobing import MOST_PIECES, next_state, strobed_orbits
from analysis.sampling import checked_count, checked_series, record


def checked_starts(starts: ArrayLike) -> np.ndarray:
    """Finite states (n, 2), from these or from a single pair; ValueError otherwise."""
    return np.atleast_2d(checked_series(starts, "starts", (1, 2)))


def strobed_states(oscillator: SnapOscillator, start: ArrayLike, points: int, transient_periods: int = 0) -> np.ndarray:
    """The stroboscopic section of one orbit of eq. (33), the paper's figure 19(b): states once a forcing period.

    start               (g, g') at time 0, where the forcing has the phase `oscillator.phase`
    points              number of states
    transient_periods   periods before the first of them
    Returns (points, 2): g and g' at times (transient + n) T. With transient_periods = 0 the first row is the start.
    Event-exact: each state follows from the one before to rounding (`analysis.oscillator.crossings`). On a chaotic
    orbit that rounding grows e-fold every 16 units of time, so single states mean nothing after some 90 periods.
    NaN from the first state on that could not be computed (more than 4096 pieces in a period).
    Source: Tjavaras et al. 1998, eq. (33).
    """
    state = checked_series(start, "start")
    if state.shape != (2,):
        raise ValueError(f"start: a pair (g, g') is needed, given shape {state.shape}")
    points, transient = checked_count(points, "points"), checked_count(transient_periods, "transient_periods", 0)
    return strobed_orbits(state[None], transient, points, tables(oscillator))[0]


def strobed_states_within(
    oscillator: SnapOscillator,
    start: ArrayLike,
    boxes: ArrayLike,
    points: int,
    most_periods: int,
    transient_periods: int = 0,
) -> tuple[tuple[np.ndarray, ...], int]:
    """Strobed states of one orbit of eq. (33) that fall into given boxes of the section: zooms with points to spare.

    start, transient_periods   as in `strobed_states`
    boxes          (b, 4): g low, g high, g' low, g' high of each
    points         the orbit ends when every box has this many;  most_periods  or after so many forcing periods
    Returns a tuple of b arrays (m, 2) with m <= points, and the number of periods looked at: a box that the attractor
    seldom visits comes back with few points, or with none. ValueError for boxes of another shape.
    """
    boxes = checked_series(boxes, "boxes", (2,))
    if boxes.shape[1] != 4:
        raise ValueError(f"boxes: an array (b, 4) is needed, given shape {boxes.shape}")
    points, longest = checked_count(points, "points"), checked_count(most_periods, "most_periods")
    x, v = strobed_states(oscillator, start, 1, transient_periods)[0]
    states, counts, seen = _within(x, v, boxes, points, longest, tables(oscillator))
    return tuple(states[i, : counts[i]].copy() for i in range(len(boxes))), int(seen)


@record
class SnapMotion:
    """A motion of eq. (33) between strobes; time in units of 1/omega_r.

    time, displacement, velocity   (m,) evenly sampled
    switches                       (s,) times of all crossings of g = 0
    slack_fraction                 share of the whole time spent at g < 0, from the switching times
    """

    time: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray
    switches: np.ndarray
    slack_fraction: float


def snap_motion(
    oscillator: SnapOscillator,
    start: ArrayLike,
    periods: int,
    samples_per_period: int = 64,
) -> SnapMotion:
    """The motion of eq. (33) evaluated from its closed form, with the switching times between taut and slack.

    start                (g, g') at time 0
    periods              length of the record in forcing periods
    samples_per_period   samples are not steps: their number changes neither states nor switching times
    Returns SnapMotion with periods*samples_per_period + 1 samples. ValueError for a start that is not finite; NaN from
    the first period on that could not be computed.
    """
    periods, samples = checked_count(periods, "periods"), checked_count(samples_per_period, "samples_per_period")
    x, v = strobed_states(oscillator, start, 1)[0]
    motion, switches, slack = _sampled(x, v, periods, samples, oscillator.period, tables(oscillator))
    time = np.arange(periods * samples + 1) * (oscillator.period / samples)
    return SnapMotion(time, motion[:, 0], motion[:, 1], switches, slack / (periods * oscillator.period))


@kernel
def _sampled(x, v, periods, samples, period, table):
    log = np.empty((MOST_PIECES, 5))
    motion = np.empty((periods * samples + 1, 2))
    switches = np.empty(64)
    crossings, slack_time = 0, 0.0
    span = period / len(table.steady)
    for n in range(periods):
        motion[n * samples] = x, v
        x, v, pieces, slack = next_state(x, v, table, log)
        slack_time += slack
        for piece in range(pieces):
            if log[piece, 1] > 0.0:
                if crossings == len(switches):
                    switches = np.append(switches, np.empty(crossings))
                switches[crossings] = n * period + log[piece, 0] * span + log[piece, 1]
                crossings += 1
        piece = 0
        for j in range(1, samples):
            time = j * period / samples
            while piece + 1 < pieces and log[piece + 1, 0] * span + log[piece + 1, 1] <= time:
                piece += 1
            window, a = int(log[piece, 0]), int(log[piece, 2])
            steady = table.steady[window, a]
            shown = Piece(a, log[piece, 3], log[piece, 4], table.theta[window], table.constants, steady[0], steady[1])
            motion[n * samples + j] = state_at(shown, time - window * span)
        if pieces == 0:
            motion[n * samples + 1 :] = np.nan
    motion[periods * samples] = x, v
    return motion, switches[:crossings].copy(), slack_time


@kernel
def _within(x, v, boxes, points, longest, table):
    log = np.empty((MOST_PIECES, 5))
    states, counts = np.empty((len(boxes), points, 2)), np.zeros(len(boxes), np.int64)
    for n in range(longest):
        for i in range(len(boxes)):
            if counts[i] < points and boxes[i, 0] <= x <= boxes[i, 1] and boxes[i, 2] <= v <= boxes[i, 3]:
                states[i, counts[i]] = x, v
                counts[i] += 1
        if counts.min() == points:
            return states, counts, n + 1
        x, v, _, _ = next_state(x, v, table, log)
    return states, counts, longest
