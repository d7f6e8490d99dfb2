"""Numbers of section 4.2 that no table has: of its two motions (figures 9 to 18), and closed forms of the scene.

near zero     the top tension is below NEAR_ZERO of the static one, as in fig. 13
a peak        from the end of one interval near zero to the start of the next, if it passes the static tension
turned        r' > 0 where the peak begins and r' < 0 where it ends: the line has stopped the buoy and sent it back
"""

import math
from collections.abc import Iterable

import numpy as np

from analysis import Spectrum, correlation_dimension, peaks_near, spectral_lines, spectrum
from analysis.correlation_sums import LEAST_POINTS
from analysis.snaps import NEAR_ZERO
from campaigns.explore.rows import lasts
from engine import Scene
from engine.natural_frequencies import Modes
from engine.run.rest import static_tension_N
from engine.trajectory import Profiles, Trajectory
from engine.views import strobed_radius

WINDOW = (40, 20)  # tau_0/T_i and n of eq. (31) in the paper
SETTLED = 20  # last wave periods of a record
EARLY, LATE = (0, 20), (40, 60)  # wave periods between which a free oscillation is compared
NEAR_BINS = 2  # of eq. (31): a line that is on no bin leaks into its neighbours
LINES_POINTS = 32, 2000  # strobed points whose lines are looked for: the fewest that allow it, the most
TURN_RAD = 1e-3  # per element, below which a rope counts as straight


def in_window(trajectory: Trajectory) -> bool:
    """Whether a record is as long as the window of eq. (31) wants."""
    scene = trajectory.scene
    return lasts(trajectory.columns, scene.sample_step_s(), sum(WINDOW) * scene.waves.period_s)


def calm_measures(trajectory: Trajectory, modes: Modes | None) -> dict[str, float]:
    """Of the run at the small wave; nothing of a record shorter than WINDOW or without natural frequencies.

    Shares are of the variance of eq. (31) in the paper's window, bin 0 left out.

    rest_m, excursion_m       r(0) and the largest |r - r(0)|
    long_tension_min_N        least top tension of the whole record
    early_radial_radps, early_angular_radps   frequency of the free oscillations of r and theta in EARLY
    radial_bins, angular_bins how many bins the peaks nearest the natural frequencies are away, in the paper's window
    radial_share, angular_share   of r and theta that lies at their natural and the wave's frequency
    radial_coupled, angular_coupled   of r at the pendulum's frequency and twice it, of theta at the radial one
    radial_kept, angular_kept free oscillation in LATE by that in EARLY
    radial_mean, angular_mean mean place over SETTLED off that of rest, over half the range there
    tension_alike             correlation of r and the top tension up to the end of that window
    """
    if modes is None or not in_window(trajectory):
        return {}
    columns, step_s, period_s = trajectory.columns, trajectory.scene.sample_step_s(), trajectory.scene.waves.period_s
    r, wave = columns["radius_m"], 2.0 * np.pi / period_s
    seen = round(sum(WINDOW) * period_s / step_s)
    measures = {
        "rest_m": r[0],
        "excursion_m": np.abs(r - r[0]).max(),
        "long_tension_min_N": columns["tension_top_low_N"].min(),
        "tension_alike": np.corrcoef(r[:seen], columns["tension_top_N"][:seen])[0, 1],
    }
    radial, pendulum = modes.radial_radps, modes.pendulum_radps
    for side, series, own_radps, others_radps in (
        ("radial", r, radial, (pendulum, 2.0 * pendulum)),
        ("angular", columns["angle_rad"], pendulum, (radial,)),
    ):
        lines, late = spectrum(series, step_s, period_s, *WINDOW), series[-round(SETTLED * period_s / step_s) :]
        nearest = peaks_near(lines, (own_radps,))[0]
        early, early_size = free(series, step_s, period_s, own_radps, EARLY)
        # At the frequency that it has early, where it is large: later the wave's frequency less the pendulum's, which
        # lies beside the radial one, may be larger.
        late_size = free(series, step_s, period_s, early, LATE, 0.0)[1]
        measures |= {
            f"early_{side}_radps": early,
            f"{side}_bins": math.nan if nearest is None else nearest.bins_away,
            f"{side}_share": share_near(lines, (own_radps, wave)),
            f"{side}_coupled": share_near(lines, others_radps),
            f"{side}_kept": late_size / early_size,
            f"{side}_mean": (np.mean(late) - series[0]) / (0.5 * np.ptp(late)),
        }
    return {name: float(value) for name, value in measures.items()}


def violent_measures(trajectory: Trajectory, transient_periods: int) -> dict[str, float]:
    """Of the run at the large wave; nothing of a record shorter than WINDOW.

    unexplained       share of the variance of the strobed r, r' that no steady line explains (0 for a torus)
    correlation_dimension, correlation_dimension_error   correlation dimension of the section r, r'
    """
    if not in_window(trajectory):
        return {}
    section, measures = strobed_radius(trajectory, transient_periods), {}
    fewest, largest = LINES_POINTS
    if len(section) >= fewest:
        measures["unexplained"] = float(np.mean(spectral_lines(section[:largest]).unexplained))
    if len(section) >= LEAST_POINTS:
        dimension = correlation_dimension(section)
        measures |= {"correlation_dimension": dimension.value, "correlation_dimension_error": dimension.error}
    return measures


def share_near(lines: Spectrum, frequencies: Iterable[float]) -> float:
    """Share of the variance in a spectrum within NEAR_BINS of any of the frequencies [rad/s]."""
    power = lines.amplitude[1:] ** 2
    distance = np.abs(np.subtract.outer(tuple(frequencies), lines.angular_frequency_radps[1:]))
    return float(power[(distance <= NEAR_BINS * lines.bin_radps).any(axis=0)].sum() / power.sum())


def free(
    series: np.ndarray,
    step_s: float,
    period_s: float,
    frequency: float,
    periods: tuple[int, int],
    within: float = 0.1,
) -> tuple[float, float]:
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
    largest = int(np.argmax(sizes))
    return float(trial[largest]), float(2.0 * sizes[largest] / window.sum())


def buckling_waves(profiles: Profiles) -> float | None:
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


def snaps(trajectory: Trajectory, transient_periods: int) -> dict[str, float]:
    """How the line of a run snaps; a number that it does not have is left out, or nan.

    near_zero, compressed   shares of the time after the transient with almost no tension, and with less than none
    compressed_inwards      share of the latter during which r falls
    begun_inwards           share of the intervals near zero at whose start r falls
    turned                  share of the peaks of tension that turn the buoy
    peak_periods, apart_periods   median length of a peak at half its height, and time for each peak, wave periods
    radial_line ... angular_at    largest share of the variance of r and theta that lies on one bin of eq. (31), and
                                  that bin over the wave's; not of a record without its window
    """
    columns, scene = trajectory.columns, trajectory.scene
    step_s, period_s = scene.sample_step_s(), scene.waves.period_s
    begin = round(transient_periods * period_s / step_s)
    tension, rate = columns["tension_top_N"][begin:], columns["radius_rate_mps"][begin:]
    measures = {}
    if in_window(trajectory):
        for side, name in (("radial", "radius_m"), ("angular", "angle_rad")):
            power = spectrum(columns[name], step_s, period_s, *WINDOW).amplitude[1:] ** 2
            measures[f"{side}_line"] = float(power.max() / power.sum())
            measures[f"{side}_at"] = float(np.argmax(power) + 1) / WINDOW[1]
    if len(tension) < 2:
        return measures
    static = static_tension_N(scene, columns)
    near, less = tension < NEAR_ZERO * static, tension < 0.0
    measures |= {"near_zero": float(near.mean()), "compressed": float(less.mean())}
    begins, ends = (np.flatnonzero(now[1:] & ~now[:-1]) + 1 for now in (near, ~near))
    measures["compressed_inwards"] = _share(rate[less] < 0.0)
    measures["begun_inwards"] = _share(rate[begins] < 0.0)
    turned, lengths = [], []
    for first in ends:
        last = begins[np.searchsorted(begins, first)] if first < begins[-1:].max(initial=0) else 0
        peak = tension[first:last]
        if peak.max(initial=0.0) > static:
            turned.append(rate[first] > 0.0 > rate[last])
            lengths.append(np.count_nonzero(peak > 0.5 * peak.max()) * step_s / period_s)
    if turned:
        measures["turned"] = _share(np.array(turned))
        measures["peak_periods"] = float(np.median(lengths))
        measures["apart_periods"] = len(tension) * step_s / period_s / len(turned)
    return measures


def _share(chosen: np.ndarray) -> float:
    return float(chosen.mean()) if len(chosen) else math.nan


def scales(scene: Scene, modes: Modes, small: float, large: float) -> dict[str, float]:
    """Closed forms of a scene with a buoy and waves; modes: its natural frequencies; the two slopes kA of section 4.2.

    small_amplitude_m    amplitude A of the wave of the small slope kA, k from the dispersion relation at depth H
    diameter_over_wave   diameter of the buoy over the length of the waves
    frequency, lift, force   omega_i/omega_nr, (B - W)/F0, and amplitude of the wave force along r on the buoy at its
        place of rest over F0, at the large slope; F0 = (M + M_a) omega_nr^2 D: omega, B - W and F of eq. (33)
    """
    from engine.physics.waves import wave_number

    buoy, water, omega = scene.buoy, scene.water, modes.wave_radps
    k = wave_number(scene.waves.period_s, water.depth_m, scene.gravity_mps2)
    unit_N = (buoy.mass_kg + buoy.added_mass_kg) * modes.radial_radps**2 * buoy.diameter_m
    pushed_kg = water.density_kgpm3 * math.pi / 6.0 * buoy.diameter_m**3 + buoy.added_mass_kg
    rest_m = scene.tether.length_m * (1.0 + modes.static_strain)
    # largest vertical acceleration of the water at the buoy's place of rest, along r: A omega^2 sinh kz / sinh kH
    reach = (
        math.exp(k * (rest_m - water.depth_m)) * math.expm1(-2.0 * k * rest_m) / math.expm1(-2.0 * k * water.depth_m)
    )
    return {
        "small_amplitude_m": small / k,
        "diameter_over_wave": buoy.diameter_m * k / (2.0 * math.pi),
        "frequency": omega / modes.radial_radps,
        "lift": modes.static_tension_N / unit_N,
        "force": pushed_kg * large / k * omega**2 * reach / unit_N,
    }
