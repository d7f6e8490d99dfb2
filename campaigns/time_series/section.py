"""How a motion known by one column is seen once a cycle: the section on which it is judged.

    strobed   at equal phases of a given forcing period T: x(kT), x((k + 1/4) T), x((k + 1/2) T), x((k + 3/4) T)
    samples   every sample, where the file itself is a section (a period of one step, or fewer than six samples in a
              mean period, which leaves nothing between them: a map)
    maxima    successive maxima of the column, no period being given: the section dx/dt = 0 of Lorenz (1963), whose map
              from one maximum to the next is a function where the motion is deterministic

A maximum counts where it stands out by six standard deviations of the noise, and is placed by a cubic spline.
"""

from dataclasses import dataclass

import numpy as np

from analysis.embedding import LEAST_SAMPLES_PER_PERIOD, choose_delay, noise_level
from analysis.poincare import section_at_phases
from analysis.sampling import locked

STROBED, SAMPLES, MAXIMA = "strobed", "samples", "maxima"
NOISE_MULTIPLE = 6.0


@dataclass(frozen=True, eq=False)
class Seen:
    """A section of a record.

    kind            "strobed", "samples" or "maxima"
    points (m, d)   a row a cycle, unit of the series
    time (m,)       of each row's first coordinate, from the first sample [unit of time of the record]
    period          forcing period, step, or mean time from maximum to maximum [same]
    noise           standard deviation of the white noise on the record [unit of the series], `noise_level`
    mean_period     of the power spectrum [samples]
    """

    kind: str
    points: np.ndarray
    time: np.ndarray
    period: float
    noise: float
    mean_period: float


def seen(series: np.ndarray, step: float, period: float | None = None) -> Seen:
    """The Seen of a series (n,); period: of the forcing, in the unit of step, or None.

    ValueError for a record too short for a single neighbourhood (about 90 samples).
    """
    chosen = choose_delay(series)
    noise = noise_level(series, chosen.delay)
    if period is not None and abs(period - step) > 1e-6 * step:
        found = section_at_phases(series, step, period)
        return Seen(STROBED, found.points, found.time_s, period, noise, chosen.mean_period)
    if period is not None or chosen.mean_period < LEAST_SAMPLES_PER_PERIOD:
        time = step * np.arange(len(series))
        return Seen(SAMPLES, locked(series[:, None]), locked(time), step, noise, chosen.mean_period)
    place, height = successive_maxima(series, NOISE_MULTIPLE * noise)
    between = float(np.mean(np.diff(place))) if len(place) > 1 else chosen.mean_period
    return Seen(MAXIMA, locked(height[:, None]), locked(step * place), step * between, noise, chosen.mean_period)


def successive_maxima(series: np.ndarray, prominence: float) -> tuple[np.ndarray, np.ndarray]:
    """Places [samples] and heights of the maxima that stand out by `prominence`, on a cubic spline.

    Newton's method on the derivative from the parabola through the three samples; error O(step^4). The first and the
    last two samples are left out: the spline has no neighbours there.
    Source of the section: E. N. Lorenz, J. Atmos. Sci. 20 (1963) 130, fig. 4.
    """
    from scipy.interpolate import CubicSpline
    from scipy.signal import find_peaks

    least = max(prominence, 1e-6 * np.ptp(series))
    top = find_peaks(series, prominence=least)[0]
    top = top[(top >= 2) & (top < len(series) - 2)]
    spline = CubicSpline(np.arange(len(series)), series)
    below, here, above = series[top - 1], series[top], series[top + 1]
    bend = below - 2.0 * here + above
    place = top + np.where(bend < 0.0, 0.5 * (below - above) / np.where(bend < 0.0, bend, -1.0), 0.0)
    for _ in range(4):
        slope, bend = spline(place, 1), spline(place, 2)
        shift = np.where(bend < 0.0, -slope / np.where(bend < 0.0, bend, -1.0), 0.0)
        place = np.clip(place + np.clip(shift, -0.25, 0.25), top - 1.0, top + 1.0)
    return place, spline(place)
