"""What one column says: section, spectrum, exponents, 0-1 test, dimension, surrogates, and a verdict with its evidence.

The motion is seen once a cycle, on a section:

    strobed   at equal phases of a given forcing period T: x(kT), x((k + 1/4) T), x((k + 1/2) T), x((k + 3/4) T)
    samples   every sample, where the file itself is a section (a period of one step, or fewer than six samples in a
              mean period, which leaves nothing between them: a map)
    maxima    successive maxima of the column, no period being given: the section dx/dt = 0 of Lorenz (1963), whose map
              from one maximum to the next is a function where the motion is deterministic; with the minimum before each

A maximum counts where it stands out by six standard deviations of the noise, and is placed by a cubic spline.

The verdict is that of `verdicts.regime` on this section. At maxima two things are asked beyond it:

- A torus has now more, now fewer maxima in a turn, so that it returns at even times, and not after so many maxima.
  Before "chaotic" stands, the height of the last maximum, seen at even times, has to be forgotten, too.
- A motion whose maxima are all alike need not repeat itself: they may come unevenly. A period seen at maxima also needs
  them to keep time (`_even_times`).

A record that is left open may be a period with noise, or in the steps of a logger: whether it repeats within OF_NOISE
times its noise is asked then, up to MOST_TOLERANCE, because a torus as thin as that looks like a period. Within such a
tolerance, or one of the command line, every point has to keep its place, too (`_places`): the steps of a slow torus,
however thick, are small.
"""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from analysis.correlation_sums import CorrelationDimension, correlation_dimension
from analysis.divergence import rosenstein_lyapunov
from analysis.embedding import (
    LEAST_SAMPLES_PER_PERIOD,
    EmbeddingChoice,
    choose_delay,
    choose_embedding,
    delay_vectors,
    noise_level,
)
from analysis.evidence import Evidence, memory_evidence, outlier_evidence
from analysis.exponents import Exponent, no_exponent
from analysis.looks import OPEN
from analysis.periods import CLEARLY_MORE, detect_period
from analysis.poincare import section_at_phases
from analysis.sampling import locked
from analysis.spectra import SpectralPeak, Spectrum, spectral_peaks, spectrum
from analysis.verdicts import LEAST_POINTS, Verdict, regime
from analysis.wolf_plateau import LEAST_PERIODS, wolf_lyapunov
from analysis.zero_one import ZeroOneTest, zero_one_test
from campaigns.time_series.record import Record

STROBED, SAMPLES, MAXIMA = "strobed", "samples", "maxima"
NOISE_MULTIPLE = 6.0
MOST_PERIOD = 16
# Samples at either end of a record in which a spline lacks neighbours; what it lacks falls by 0.27 a sample.
SPLINE_END = 20
# More samples make exponents no better than their other errors, and take long.
MOST_SAMPLES = 30_000
MOST_POINTS = 6_000
SURROGATES = 39
TOLERANCE = 1e-3
OF_NOISE, MOST_TOLERANCE = 8.0, 0.1
# Share of the time between maxima by which they may stray from even times in a motion that repeats itself.
EVEN_TIMES = 0.05
ROUNDING = 1e-9  # of the range of a record
# A line beside the forcing period: stretches of the record; turns by which the two part over it; share of these turns
# by which a stretch may stray from a steady parting.
STRETCHES, LEAST_PARTED, STEADY = 8, 1e-5, 0.1
ESTIMATES = {"wolf": wolf_lyapunov, "rosenstein": rosenstein_lyapunov}


@dataclass(frozen=True, eq=False)
class Seen:
    """A section of a record."""

    kind: str  # "strobed", "samples" or "maxima"
    points: np.ndarray  # (m, d), a row a cycle, unit of the series
    time: np.ndarray  # (m,) of each row's first coordinate, from the first sample [unit of time of the record]
    period: float  # forcing period, step, or mean time from maximum to maximum [same]
    noise: float  # standard deviation of the white noise on the record [unit of the series], `noise_level`
    mean_period: float  # of the power spectrum [samples]


@dataclass(frozen=True, eq=False)
class Study:
    """Everything that was found about a record."""

    record: Record
    seen: Seen
    spectrum: Spectrum  # eq. (31) over the later half of the record
    lines: tuple[SpectralPeak, ...]  # its highest peaks
    exponents: dict[str, Exponent]  # of "wolf" and "rosenstein" [nats per unit of time of the record]
    zero_one: ZeroOneTest  # of the section's first coordinate
    embedding: EmbeddingChoice | None  # of the delay vectors; None for a record of fewer than 20 mean periods
    dimension: CorrelationDimension | None  # of the delay vectors of `embedding`; None as there
    verdict: Verdict  # on the section
    line_period: float | None  # of the line beside a given forcing period, `line_beside` [unit of time of the record]
    tolerance: float  # share of `motion_range` within which the section had to repeat
    used: int  # samples looked at by exponents and dimension: the last of the record


def study(record: Record, period: float | None = None, tolerance: float | None = None) -> Study:
    """The Study of a Record; period: of the forcing, in the record's unit of time, or None (`section`).

    tolerance: share of `motion_range` within which a motion repeats; None: `least_tolerance`, and where that decides
    nothing `noise_tolerance`. The same record gives the same study.
    """
    x, step = record.values, record.step
    view = seen(x, step, period)
    last = x[-MOST_SAMPLES:]
    cycles = len(last) / view.mean_period
    if cycles < LEAST_PERIODS:
        # Neighbours apart in time by a mean period would have to be sought through the whole record, for nothing.
        reason = f"{LEAST_PERIODS} mean periods are needed, given {cycles:.3g}"
        exponents, embedding, dimension = dict.fromkeys(ESTIMATES, no_exponent("none", reason)), None, None
    else:
        exponents = {name: estimate(last, step) for name, estimate in ESTIMATES.items()}
        embedding = choose_embedding(last)
        vectors = delay_vectors(last, embedding.lag, embedding.dimension)[-MOST_POINTS:]
        dimension = correlation_dimension(vectors, max(1, round(embedding.mean_period)))
    power = _spectrum(x, step, view, period)
    verdict, tolerance = judged(x, view, tolerance)
    irregular = zero_one_test(view.points[-MOST_POINTS:, 0])
    return Study(
        record=record,
        seen=view,
        spectrum=power,
        lines=spectral_peaks(power)[:5],
        exponents=exponents,
        zero_one=irregular,
        embedding=embedding,
        dimension=dimension,
        verdict=verdict,
        line_period=line_beside(x, step, period) if view.kind == STROBED else None,
        tolerance=tolerance,
        used=len(last),
    )


def line_beside(x: np.ndarray, step: float, period: float) -> float | None:
    """Period of the line of a record (n,) that lies beside the period given, where the two part steadily; else None.
    None, too, for a record that is too short for a verdict.

    The mean of x exp(-2 pi i t/T) over each of eight stretches, under Hann's window, turns from stretch to stretch.
    """
    cycles = int((len(x) - 1) * step / period) // STRETCHES
    if cycles * STRETCHES < LEAST_POINTS:
        return None
    samples = cycles * period / step
    ends = np.rint(samples * np.arange(STRETCHES + 1)).astype(int)
    turning = (x - x.mean()) * np.exp(-2j * np.pi * step / period * np.arange(len(x)))
    means = np.array([np.average(turning[a:b], weights=np.hanning(b - a)) for a, b in pairwise(ends)])
    phase, stretch = np.unwrap(np.angle(means)) / (2.0 * np.pi), np.arange(STRETCHES)
    line = np.polyfit(stretch, phase, 1)
    parted = STRETCHES * abs(line[0])
    strays = np.abs(phase - np.polyval(line, stretch)).max()
    size = np.abs(means)
    if parted < LEAST_PARTED or strays > STEADY * parted or size.min() < 0.5 * size.max():
        return None
    return float(period / (1.0 + line[0] / cycles))


def motion_range(x: np.ndarray) -> float:
    """Range of the later half of a record (n,), because a large start would make any small motion after it a period."""
    return max(np.ptp(x[len(x) // 2 :]), 1e-9 * np.abs(x).max())


def least_tolerance(view: Seen) -> float:
    """0.001, or the error of the spline at a maximum or between samples: h^4/384 for a sine."""
    if view.kind == SAMPLES:
        return TOLERANCE
    return max(TOLERANCE, (2.0 * np.pi / view.mean_period) ** 4 / 384.0)


def _spectrum(x, step, view, period):
    """Eq. (31) over the later half: in whole forcing periods, or, where none is known, as one period."""
    whole = int((1.0 + 1e-9) * (len(x) - 1) * step / view.period)
    if period is not None and view.kind != SAMPLES and whole >= 2:
        return spectrum(x, step, view.period, start_periods=whole - whole // 2, periods=whole // 2)
    half = len(x) // 2
    return spectrum(x[-half - 1 :], step, half * step, start_periods=0, periods=1)


def noise_tolerance(x: np.ndarray, view: Seen) -> float | None:
    """OF_NOISE times the noise on a record (n,), as a share of its range; None where that is too little or too much."""
    tolerance = OF_NOISE * view.noise / motion_range(x)
    if view.kind != SAMPLES and least_tolerance(view) < tolerance <= MOST_TOLERANCE:
        return tolerance
    return None


def judged(x: np.ndarray, view: Seen, tolerance: float | None = None) -> tuple[Verdict, float]:
    """The Verdict on a record (n,) by its section, and the tolerance at which it stands; tolerance: as in `study`."""
    if tolerance is not None:
        return _judged(x, view, tolerance), tolerance
    least, of_noise = least_tolerance(view), noise_tolerance(x, view)
    verdict = _judged(x, view, least)
    if verdict.regime in OPEN and of_noise is not None:
        repeats = detect_period(view.points[-MOST_POINTS:], tolerance=of_noise, scale=motion_range(x))
        if repeats.period is not None:
            within_noise = _judged(x, view, of_noise)
            if within_noise.period is not None:
                return within_noise, of_noise
    return verdict, least


def _judged(x: np.ndarray, view: Seen, tolerance: float) -> Verdict:
    """The Verdict at one tolerance."""
    section, time = view.points[-MOST_POINTS:], view.time[-MOST_POINTS:]
    outliers = outlier_evidence(x)
    if not outliers and len(section) >= LEAST_POINTS:
        outliers = outlier_evidence(section, time)
    if outliers:
        return Verdict("undecided", outliers[0].sentence, tuple(outliers), None, len(view.points), seed=0)
    verdict = regime(strobed=section, scale=motion_range(x), tolerance=tolerance, surrogates=SURROGATES)
    if verdict.period is None:
        if len(section) >= LEAST_POINTS:
            verdict = _stands(verdict, section, motion_range(x), tolerance)
    elif tolerance > least_tolerance(view):
        verdict = _places(verdict, section, motion_range(x), tolerance)
    if view.kind != MAXIMA:
        return verdict
    if verdict.period is not None:
        return _even_times(verdict, view, tolerance)
    if verdict.regime != "chaotic":
        return verdict
    return _with(verdict, memory_evidence(_at_even_times(view), "memory, in time"), "chaotic by its section, but ")


def _at_even_times(view):
    """Height of the last maximum (m, 1), seen once a mean time between maxima, halfway where these come evenly."""
    time, height = view.time[-MOST_POINTS:], view.points[-MOST_POINTS:]
    looks = np.arange(time[0] + 0.5 * view.period, time[-1], view.period)
    return height[np.searchsorted(time, looks, side="right") - 1]


def _with(verdict, test, but):
    """The verdict with one more test: "undecided", with the reason, where it failed."""
    verdict = replace(verdict, evidence=(*verdict.evidence, test))
    if test.passed is not False:
        return verdict
    return replace(verdict, regime="undecided", period=None, reason=but + test.sentence)


def _stands(verdict, section, scale, tolerance):
    """The verdict, or period-N where every Nth point of the whole record keeps its place.

    A forcing period that is wrong in its eighth digit gives small equal steps. `detect_period` calls them a drift, but
    over the record they add up to less than the tolerance.
    """
    for count in range(1, min(MOST_PERIOD, len(section) // 4) + 1):
        if _way(section, count) > tolerance * scale:
            continue
        divisors = [divisor for divisor in range(1, count) if count % divisor == 0]
        if any(_way(section, divisor) < CLEARLY_MORE * tolerance * scale for divisor in divisors):
            return verdict
        way = _way(section, count) / scale
        sentence = (
            f"repeats after {count} period(s) within {tolerance:g} of the range over the whole record ({way:.2g})"
        )
        evidence = (*verdict.evidence, Evidence("places", way, tolerance, True, sentence))
        return replace(verdict, regime=f"period-{count}", period=count, reason=sentence, evidence=evidence)
    return verdict


def _way(section, count):
    """Largest range of a coordinate of a section (m, d) over every `count`th point."""
    return float(max(np.ptp(section[first::count], axis=0).max() for first in range(count)))


def _places(verdict, section, scale, tolerance):
    """The verdict period-N, with whether every Nth point of the later half keeps its place: "undecided" where it does
    not. The steps of a slow torus are small and add up; noise on them hides that.
    """
    way = _way(section[-max(len(section) // 2, 3 * verdict.period) :], verdict.period) / scale
    sentence = f"points that are alike wander by {way:.2g} of the range in the later half"
    return _with(verdict, Evidence("places", way, tolerance, way <= tolerance, sentence), "no period: ")


def _even_times(verdict, view, tolerance):
    """The verdict period-N, with whether every Nth maximum keeps to even times: "undecided" where it does not.

    A sine stays within `tolerance` of its range from its maximum for sqrt(tolerance)/pi of a period on either side.
    """
    time, between = view.time[-MOST_POINTS:], view.period
    deviation = 0.0
    for first in range(verdict.period):
        times = time[first :: verdict.period]
        count = np.arange(len(times))
        even = np.polyval(np.polyfit(count, times, 1), count)
        deviation = max(deviation, float(np.abs(times - even).max()) / between)
    allowed = max(EVEN_TIMES, 1.5 * np.sqrt(tolerance) / np.pi)
    sentence = f"maxima that are alike stray from even times by {deviation:.2g} of the time between maxima"
    return _with(verdict, Evidence("even times", deviation, allowed, deviation <= allowed, sentence), "no period: ")


def seen(series: np.ndarray, step: float, period: float | None = None) -> Seen:
    """The Seen of a series (n,); period: of the forcing, in the unit of step, or None.

    ValueError for a record too short for a single neighbourhood (about 90 samples).
    """
    chosen = choose_delay(series)
    noise = noise_level(series, chosen.delay)
    if period is not None and abs(period - step) > 1e-6 * step:
        section = section_at_phases(series, step, period)
        inner = np.ones(len(section.points), dtype=bool)
        if section.interpolated:
            first, last = SPLINE_END * step, (len(series) - 1 - SPLINE_END) * step
            inner = (section.time_s >= first) & (section.time_s + period <= last)
        points, time = section.points[inner], section.time_s[inner]
        # A phase at which the motion crosses the same value each time shows rounding errors, which drift.
        moves = np.ptp(points, axis=0) > ROUNDING * np.ptp(series)
        if moves.any():
            points = points[:, moves]
        return Seen(STROBED, locked(points), locked(time), period, noise, chosen.mean_period)
    if period is not None or chosen.mean_period < LEAST_SAMPLES_PER_PERIOD:
        time = step * np.arange(len(series))
        return Seen(SAMPLES, locked(series[:, None]), locked(time), step, noise, chosen.mean_period)
    place, points = maxima_and_minima(series, NOISE_MULTIPLE * noise)
    between = chosen.mean_period
    if len(place) > 1:
        between = float(np.mean(np.diff(place)))
    return Seen(MAXIMA, locked(points), locked(step * place), step * between, noise, chosen.mean_period)


def maxima_and_minima(series: np.ndarray, prominence: float) -> tuple[np.ndarray, np.ndarray]:
    """Places [samples] (m,) of `successive_maxima`, and (m, 2) their heights with the minimum before each."""
    place, height = successive_maxima(series, prominence)
    minima, depth = successive_maxima(-series, prominence)
    last = np.searchsorted(minima, place) - 1
    known = last >= 0
    return place[known], np.column_stack([height[known], -depth[last[known]]])


def successive_maxima(series: np.ndarray, prominence: float) -> tuple[np.ndarray, np.ndarray]:
    """Places [samples] and heights of the maxima that stand out by `prominence`, on a cubic spline.

    Newton's method on the derivative from the parabola through the three samples; error O(step^4). SPLINE_END samples
    at either end are left out.
    Source of the section: E. N. Lorenz, J. Atmos. Sci. 20 (1963) 130, fig. 4.
    """
    from scipy.interpolate import CubicSpline
    from scipy.signal import find_peaks

    least = max(prominence, 1e-6 * np.ptp(series))
    top = find_peaks(series, prominence=least)[0]
    top = top[(top >= SPLINE_END) & (top < len(series) - SPLINE_END)]
    spline = CubicSpline(np.arange(len(series)), series)
    below, middle, above = series[top - 1], series[top], series[top + 1]
    bend = below - 2.0 * middle + above
    place = top + np.where(bend < 0.0, 0.5 * (below - above) / np.where(bend < 0.0, bend, -1.0), 0.0)
    for _ in range(4):
        slope, bend = spline(place, 1), spline(place, 2)
        shift = np.where(bend < 0.0, -slope / np.where(bend < 0.0, bend, -1.0), 0.0)
        place = np.clip(place + np.clip(shift, -0.25, 0.25), top - 1.0, top + 1.0)
    return place, spline(place)
