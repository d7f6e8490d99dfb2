"""Numbers of the two motions of section 4.2 that their tables do not have: what the paper says of figures 9 to 18."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..buoy_sweep.figures import PAPER_WINDOW as WINDOW

SETTLED = 20  # last wave periods of a record
EARLY, LATE = (0, 20), (40, 60)  # wave periods between which a free oscillation is compared
NEAR_BINS = 2  # of eq. (31): a line that is on no bin leaks into its neighbours
LINES_POINTS = 32, 2000  # strobed points whose lines are looked for: the fewest that allow it, the most
TURN_RAD = 1e-3  # per element, below which a rope counts as straight


@dataclass(frozen=True)
class Calm:
    """Of the run at the small wave. Shares are of the variance of eq. (31) in the paper's window, bin 0 left out.

    excursion_m        largest |r - r(0)|;  tension_min_N: least top tension of the whole record
    radial_radps, angular_radps   frequency of the free oscillations of r and theta in EARLY
    radial_bins, angular_bins   how many bins the peaks nearest the natural frequencies are away, in the paper's window
    radial_share, angular_share   of r and theta that lies at their natural and the wave's frequency
    radial_coupled, angular_coupled   of r at the pendulum's frequency and twice it, of theta at the radial one
    radial_kept, angular_kept   free oscillation in LATE by that in EARLY
    radial_mean, angular_mean   mean place over SETTLED off that of rest, over half the range there
    tension_alike     correlation of r and the top tension up to the end of that window
    """

    rest_m: float
    excursion_m: float
    tension_min_N: float
    radial_radps: float
    angular_radps: float
    radial_bins: float
    angular_bins: float
    radial_share: float
    angular_share: float
    radial_coupled: float
    angular_coupled: float
    radial_kept: float
    angular_kept: float
    radial_mean: float
    angular_mean: float
    tension_alike: float


@dataclass(frozen=True)
class Violent:
    """Of the run at the large wave.

    unexplained       share of the variance of the strobed r, r' that no steady line explains (0 for a torus)
    dimension, dimension_error   correlation dimension of the section r, r'
    """

    unexplained: float
    dimension: float
    dimension_error: float


def calm_measures(trajectory, modes) -> Calm | None:
    """Calm, None for a record shorter than the window of eq. (31) or without natural frequencies."""
    columns, scene = trajectory.columns, trajectory.scene
    step_s, period_s = scene.sample_step_s(), scene.waves.period_s
    if modes is None or (len(columns["time_s"]) - 1) * step_s < sum(WINDOW) * period_s - 1e-9:
        return None
    r, theta = columns["radius_m"], columns["angle_rad"]
    wave = 2.0 * np.pi / period_s
    seen = round(sum(WINDOW) * period_s / step_s)
    radial, pendulum = modes.radial_radps, modes.pendulum_radps
    shares = {
        "radial_share": share_near(r, step_s, period_s, (radial, wave)),
        "angular_share": share_near(theta, step_s, period_s, (pendulum, wave)),
        "radial_coupled": share_near(r, step_s, period_s, (pendulum, 2.0 * pendulum)),
        "angular_coupled": share_near(theta, step_s, period_s, (radial,)),
    }
    return Calm(
        rest_m=float(r[0]),
        excursion_m=float(np.abs(r - r[0]).max()),
        tension_min_N=float(columns["tension_top_low_N"].min()),
        radial_radps=free(r, step_s, period_s, radial, EARLY)[0],
        angular_radps=free(theta, step_s, period_s, pendulum, EARLY)[0],
        radial_bins=_bins_away(r, step_s, period_s, radial),
        angular_bins=_bins_away(theta, step_s, period_s, pendulum),
        **shares,
        radial_kept=kept(r, step_s, period_s, radial),
        angular_kept=kept(theta, step_s, period_s, pendulum),
        radial_mean=_off_rest(r, step_s, period_s),
        angular_mean=_off_rest(theta, step_s, period_s),
        tension_alike=float(np.corrcoef(r[:seen], columns["tension_top_N"][:seen])[0, 1]),
    )


def violent_measures(trajectory, transient_periods: int) -> Violent | None:
    """Violent, None for a record shorter than the window of eq. (31)."""
    from analysis import correlation_dimension, poincare_section, spectral_lines
    from analysis.correlation_sums import LEAST_POINTS

    columns, scene = trajectory.columns, trajectory.scene
    step_s, period_s = scene.sample_step_s(), scene.waves.period_s
    if (len(columns["time_s"]) - 1) * step_s < sum(WINDOW) * period_s - 1e-9:
        return None
    series = {name: columns[name] for name in ("radius_m", "radius_rate_mps")}
    section = poincare_section(series, step_s, period_s, transient_periods=transient_periods).points
    fewest, most = LINES_POINTS
    lines = spectral_lines(section[:most]) if len(section) >= fewest else None
    dimension = correlation_dimension(section) if len(section) >= LEAST_POINTS else None
    return Violent(
        float(np.mean(lines.unexplained)) if lines is not None else float("nan"),
        dimension.value if dimension is not None else float("nan"),
        dimension.error if dimension is not None else float("nan"),
    )


def share_near(series, step_s: float, period_s: float, frequencies) -> float:
    """Share of the variance in eq. (31)'s window within NEAR_BINS of any of the frequencies [rad/s]."""
    from analysis import spectrum

    found = spectrum(series, step_s, period_s, *WINDOW)
    power = found.amplitude[1:] ** 2
    omega = found.angular_frequency_radps[1:]
    near = np.zeros(len(omega), dtype=bool)
    for frequency in frequencies:
        near |= np.abs(omega - frequency) <= NEAR_BINS * found.bin_radps
    return float(power[near].sum() / power.sum())


def largest_line(series, step_s: float, period_s: float) -> tuple[float, float]:
    """Largest share of the variance in eq. (31)'s window that lies on one bin, and the bin over the wave's."""
    from analysis import spectrum

    found = spectrum(series, step_s, period_s, *WINDOW)
    power = found.amplitude[1:] ** 2
    most = int(np.argmax(power))
    return float(power[most] / power.sum()), (most + 1) / WINDOW[1]


def free(series, step_s: float, period_s: float, frequency: float, periods, within: float = 0.1):
    """(frequency, amplitude) of the oscillation near a frequency over these wave periods, under a Hann window.

    It is that of the largest amplitude no more than the share `within` off the frequency given: at finite size, and
    with the stretch and weight of the line, the oscillation is slightly off an estimate.
    """
    first, last = (round(end * period_s / step_s) for end in periods)
    x = np.asarray(series[first:last], dtype=float)
    window = np.hanning(len(x))
    x = (x - np.average(x, weights=window)) * window
    trial = frequency * np.linspace(1.0 - within, 1.0 + within, 81)
    sizes = np.abs(np.exp(1j * np.outer(trial, step_s * np.arange(len(x)))) @ x)
    most = int(np.argmax(sizes))
    return float(trial[most]), float(2.0 * sizes[most] / window.sum())


def kept(series, step_s: float, period_s: float, frequency: float) -> float:
    """Amplitude of the free oscillation near a frequency in LATE by that in EARLY.

    At the frequency that it has in EARLY, where it is large: later the wave's frequency less the pendulum's, which
    lies beside the radial one, may be larger.
    """
    own, before = free(series, step_s, period_s, frequency, EARLY)
    return free(series, step_s, period_s, own, LATE, 0.0)[1] / before


def _off_rest(series, step_s: float, period_s: float) -> float:
    late = series[-round(SETTLED * period_s / step_s) :]
    return float((np.mean(late) - series[0]) / (0.5 * np.ptp(late)))


def _bins_away(series, step_s: float, period_s: float, frequency: float) -> float:
    from analysis import peaks_near, spectrum

    found = peaks_near(spectrum(series, step_s, period_s, *WINDOW), (frequency,))[0]
    return float("nan") if found is None else float(found.bins_away)


def buckling_waves(profiles) -> float | None:
    """Half waves of the rope while it is slack over its whole length: median number of changes of the turn's side, +1.

    profiles: of a run of a buoy; None where the rope is never slack.
    """
    slack = (profiles.tension_N < 0.0).mean(axis=1) > 0.5
    counts = []
    for x, z in zip(profiles.x_m[slack], profiles.z_m[slack], strict=True):
        dx, dz = np.diff(x), np.diff(z)
        turn = np.arctan2(dx[:-1] * dz[1:] - dz[:-1] * dx[1:], dx[:-1] * dx[1:] + dz[:-1] * dz[1:])
        side = np.sign(turn[np.abs(turn) > TURN_RAD])
        counts.append(1 + int(np.count_nonzero(side[1:] != side[:-1])))
    return float(np.median(counts)) if counts else None
