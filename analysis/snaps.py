"""Snaps of a line: when it goes slack, when it becomes taut again, and how hard it then pulls.

The one definition of the whole programme, for regular waves, irregular seas and measured records:

    mean tension   the running mean of the tension over `ringing_s`: the tension without waves along the line
    slack          from the moment at which the mean tension falls to `slack_share` of the static tension or below it,
                   until it last passes this share before it reaches the static tension again
    pull           what follows, until the mean tension falls halfway from the static tension to the slack one
    snap           a pull that ends a slack interval, if its largest tension is `snap_share` of the static one or more

Why two levels: a line that bears less than the static tension does not hold its body, which therefore moves on until
the line is taut. A twitch between the two levels ends no slack interval, and a weak pull counts for nothing. Noise that
crosses the static tension again while the pull begins does not end it either: its largest tension is still to come.

Why a running mean: after a snap, axial waves run along the line, and the tension at one end can fall to zero and return
many times. A wave comes back to where it was after the time that it needs to the other end and back, 2 l/c. All axial
modes of a line between two heavy ends have this period or a whole fraction of it, and their mean over it is zero. A
body that is heavier than 0.4 of the line stays on it for longer than that, pi sqrt(m/k) > 2 l/c, so its pulls remain.
"""

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from analysis.sampling import checked_not_negative, checked_positive, checked_series, record

if TYPE_CHECKING:
    import pandas

NEAR_ZERO = 0.05  # of the static tension: what the paper calls near zero; below it the line is slack
UNITS = {
    "onset_s": "s",
    "duration_s": "s",
    "taut_s": "s",
    "taut_speed_mps": "m s-1",
    "peak_N": "N",
    "peak_s": "s",
    "rise_s": "s",
    "peak_over_static": "1",
    "peak_over_impact": "1",
}


@record
class Snaps:
    """Snaps in the order of time: arrays (n,), and the thresholds by which they were found.

    onset_s           when the slack interval began; NaN if it began before the record [s]
    duration_s        length of the slack interval; NaN as onset_s [s]
    taut_s            when the line became taut: the snap begins [s]
    counted_s         when the mean tension reaches the static one (or the share of it that makes a snap): from then on
                      the snap is one, so that counts of neighbouring stretches of time add up [s]
    taut_speed_mps    rate of the distance between the ends of the line at that moment; NaN if not given [m/s]
    peak_N            largest tension of the pull, ringing included [N]
    peak_s            its time [s]
    rise_s            from taut_s to peak_s [s]
    peak_over_static  peak_N over the static tension
    peak_over_impact  peak_N over v sqrt(k m), the force of a body that meets a spring; NaN if not known
    static_N, slack_N, snap_N   static tension and the thresholds of slack and of a snap [N]
    ringing_s         length of the running mean [s]
    watched_s         length of the record in which snaps were counted [s]
    """

    onset_s: np.ndarray
    duration_s: np.ndarray
    taut_s: np.ndarray
    counted_s: np.ndarray
    taut_speed_mps: np.ndarray
    peak_N: np.ndarray
    peak_s: np.ndarray
    rise_s: np.ndarray
    peak_over_static: np.ndarray
    peak_over_impact: np.ndarray
    static_N: float
    slack_N: float
    snap_N: float
    ringing_s: float
    watched_s: float

    def __len__(self) -> int:
        return len(self.taut_s)

    def __str__(self) -> str:
        return (
            f"{len(self)} snaps in {self.watched_s:.6g} s; slack: {self.slack_N:.4g} N or less, "
            f"a snap: {self.snap_N:.4g} N or more, ringing averaged over {self.ringing_s:.3g} s"
        )

    def table(self) -> "pandas.DataFrame":
        """A row a snap, a column each of `UNITS`; `attrs` has the units and the thresholds."""
        import pandas

        table = pandas.DataFrame({name: getattr(self, name) for name in UNITS})
        table.attrs["units"] = dict(UNITS)
        table.attrs |= {name: getattr(self, name) for name in ("static_N", "slack_N", "snap_N", "ringing_s")}
        return table


def detect_snaps(
    tension_N: ArrayLike,
    step_s: float,
    static_N: float,
    ringing_s: float = 0.0,
    *,
    high_N: ArrayLike | None = None,
    rate_mps: ArrayLike | None = None,
    impact_Nspm: float | None = None,
    slack_share: float = NEAR_ZERO,
    snap_share: float = 1.0,
    transient_s: float = 0.0,
) -> Snaps:
    """The snaps of a record, as the head of this module defines them.

    Times of slack and taut are where the mean tension, linear between samples, crosses `slack_share` of `static_N`:
    their error is O(step^2) while the tension is smooth.

    tension_N (n,)   samples from t = 0 [N]
    step_s           sampling step; ringing is averaged out only if it is sampled, twice in a period or more [s]
    static_N         static tension of the line; of a measured record of a buoy its mean is near it [N]
    ringing_s        longest period of ringing: 2 l/c, length over axial wave speed; 0: no ringing [s]
    high_N (n,)      largest tension since the previous sample, where known: peaks are taken from it [N]
    rate_mps (n,)    rate of the distance between the ends of the line, where known [m/s]
    impact_Nspm      sqrt(k m) of line and body, where known [N s/m]
    slack_share      share of the static tension, 0 <= share < snap_share
    snap_share       share of the static tension that a snap reaches. Less than 1: a pull then begins at this share, so
                     that every retensioning counts if it is just above slack_share
    transient_s      snaps that count before it are left out [s]
    Returns Snaps; a slack interval that the record does not see end is none.
    Raises ValueError for values that are not finite, arrays of other lengths, and thresholds without meaning.
    """
    tension = checked_series(tension_N, "tension_N")
    high = tension if high_N is None else _beside(tension, high_N, "high_N")
    rate = np.full(len(tension), np.nan) if rate_mps is None else _beside(tension, rate_mps, "rate_mps")
    impact_Nspm = np.nan if impact_Nspm is None else checked_positive(impact_Nspm, "impact_Nspm")
    step_s = checked_positive(step_s, "step_s")
    static_N = checked_positive(static_N, "static_N")
    ringing_s = checked_not_negative(ringing_s, "ringing_s")
    transient_s = checked_not_negative(transient_s, "transient_s")
    slack_share = checked_not_negative(slack_share, "slack_share")
    if not slack_share < snap_share < np.inf:
        raise ValueError(
            f"snap_share: a finite number above slack_share {slack_share:g} is needed, given {snap_share!r}"
        )
    slack_N, pull_N, snap_N = slack_share * static_N, min(1.0, snap_share) * static_N, snap_share * static_N

    mean = running_mean(tension, step_s, ringing_s)
    rows = []
    for first, last, pulled, left in _pulls(mean, slack_N, pull_N):
        taut_s = step_s * _crossing(mean, last, slack_N)
        peak = last + 1 + int(np.argmax(high[last + 1 : left + 1]))
        counted_s = step_s * _crossing(mean, pulled - 1, pull_N)
        if high[peak] < snap_N or counted_s < transient_s:
            continue
        onset_s = step_s * _crossing(mean, first - 1, slack_N) if first > 0 else np.nan
        peak_s = max(step_s * peak, taut_s)
        rows.append((onset_s, taut_s, counted_s, high[peak], peak_s))
    onset_s, taut_s, counted_s, peak_N, peak_s = np.array(rows, dtype=float).reshape(-1, 5).T
    speed_mps = np.interp(taut_s / step_s, np.arange(len(rate)), rate)
    impact_N = np.where(speed_mps > 0.0, speed_mps, np.nan) * impact_Nspm
    return Snaps(
        onset_s=onset_s,
        duration_s=taut_s - onset_s,
        taut_s=taut_s,
        counted_s=counted_s,
        taut_speed_mps=speed_mps,
        peak_N=peak_N,
        peak_s=peak_s,
        rise_s=peak_s - taut_s,
        peak_over_static=peak_N / static_N,
        peak_over_impact=peak_N / impact_N,
        static_N=static_N,
        slack_N=slack_N,
        snap_N=snap_N,
        ringing_s=ringing_s,
        watched_s=max(step_s * (len(tension) - 1) - transient_s, 0.0),
    )


def running_mean(series: ArrayLike, step_s: float, length_s: float) -> np.ndarray:
    """Mean of a series (n,) over `length_s` about each sample, the series linear between samples.

    A window that reaches beyond the record ends with it. 0 gives the series itself.
    """
    x = checked_series(series)
    if length_s == 0.0 or len(x) < 2:
        return x
    half, place = 0.5 * length_s / step_s, np.arange(len(x), dtype=float)
    integral = np.append(0.0, np.cumsum(0.5 * (x[:-1] + x[1:])))

    def integral_to(ends):
        whole = np.minimum(ends.astype(int), len(x) - 2)
        part = ends - whole
        return integral[whole] + x[whole] * part + 0.5 * (x[whole + 1] - x[whole]) * part**2

    begins, ends = np.maximum(place - half, 0.0), np.minimum(place + half, len(x) - 1.0)
    return (integral_to(ends) - integral_to(begins)) / (ends - begins)


def _pulls(mean, slack_N, pull_N):
    """Of each pull that ends a slack interval four samples: the first and the last at or below the slack threshold,
    the first at the pull's, and the first below the middle of the two thresholds, or the last of the record.
    """
    pulls = mean >= pull_N
    decided = np.flatnonzero((mean <= slack_N) | pulls)
    below = np.append(np.flatnonzero(mean < 0.5 * (slack_N + pull_N)), len(mean) - 1)
    begins = np.flatnonzero(np.diff(pulls[decided], prepend=~pulls[decided][:1]))
    for slack_run, pull_run in pairwise(begins):
        if not pulls[decided[pull_run]]:
            continue
        first, last, pulled = decided[slack_run], decided[pull_run - 1], decided[pull_run]
        yield int(first), int(last), int(pulled), int(below[np.searchsorted(below, pulled)])


def _crossing(series, sample, level):
    """Where the series, linear after a sample, crosses a level before the next one [samples]."""
    here, after = series[sample] - level, series[sample + 1] - level
    return sample + here / (here - after) if here != after else float(sample)


def _beside(tension, series, name):
    """The series, of as many samples as the tension."""
    values = checked_series(series, name)
    if len(values) != len(tension):
        raise ValueError(f"{name}: as many samples as tension_N ({len(tension)}) are needed, given {len(values)}")
    return values
