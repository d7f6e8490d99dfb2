"""Irregular waves: a sum of linear waves, each with its own period, amplitude, phase and direction.

A sea of one wave is a regular wave (`engine.physics.waves`).

    U = sum_i U_i,   psi_i = k_i (x cos a_i + y sin a_i) - omega_i t + phase_i,   omega_i^2 = g k_i tanh k_i H

Every term is that of `physics.waves`; linear waves add. Above the still water level `zero` and `extrapolate` act on
each term alike, and Wheeler's stretching goes by the elevation of the whole sea, z -> z H/(H + eta), with
eta = sum A_i cos psi_i.

Kernels sum it: `engine.physics.sea_sum` in space, `engine.physics.sea_series` in a plane.

Layout in `tables`: groups of COUNT waves, the longest first, and in a group one row of COUNT numbers each of k, omega,
phase, cos a, sin a, A omega/(1 - exp(-2 k H)) and A; what is left over of the last group has no amplitude. In a plane a
wave along -x is written as one along x whose omega, phase and velocity have the other sign.

A sea of given height and period is drawn from the JONSWAP spectrum:

    S(f) = c f^-5 exp(-5/4 (f/f_p)^-4) gamma^g,    g = exp(-(f/f_p - 1)^2/(2 sigma^2))

with sigma = 0.07 below f_p and 0.09 above. gamma = 1 is the spectrum of Pierson and Moskowitz. c is chosen so that the
components together carry H_s^2/16, the variance of a sea of significant height H_s. The band from f_p/2 to 3 f_p,
which holds 98.5 % of the energy at gamma = 1 and more above, is cut into parts of equal width; in each lies one
component, at a random place (even frequencies would repeat the sea after 1/df) and with a random phase. Its amplitude
carries the energy of its part: it is not random, so that every seed has the same H_s.

A sea of given significant steepness k H_s/2 and relative width w has a Gaussian spectrum about f_p, standard deviation
w f_p: with w it goes from a regular wave of the same energy, A = H_s/8^(1/2), to a broad sea.

Source: K. Hasselmann et al., Deutsche Hydrographische Zeitschrift A8, no. 12 (1973); W. J. Pierson & L. Moskowitz,
J. Geophys. Res. 69 (1964) 5181.
"""

import math
from functools import lru_cache

import numpy as np

from ..scene.models import Scene
from ..scene.values import MOST_COMPONENTS
from ..simd.vector import COUNT
from .waves import wave_number

K, OMEGA, PHASE, COSINE, SINE, SPEED, AMPLITUDE = range(7)  # rows of a group in `tables`
ROW = 7
LOWEST, HIGHEST = 0.5, 3.0  # of the peak frequency
REACH = 4.0  # of a Gaussian spectrum, in its widths
# Mean times after which groups of a sea nearly recur, that a run lasts at most. So few waves make the highest crest of
# three hours 1 % lower than very many do (docs/sea.md).
RECURRENCES = 20
_POINTS = 200  # over which the energy of one part is summed


def components(
    significant_height_m: float, peak_period_s: float, gamma: float, count: int, seed: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Periods (s), amplitudes (m) and phases (rad), each (count,), of a sea; the same arguments give the same numbers.

    sum A^2/2 = H_s^2/16 to rounding.
    """
    edges = np.linspace(LOWEST, HIGHEST, count + 1)
    inner = edges[:-1, None] + np.diff(edges)[:, None] * np.linspace(0.0, 1.0, _POINTS + 1)
    energy = np.trapezoid(_shape(inner, gamma), inner, axis=1)
    ratio, amplitude, phase = _drawn(edges, energy / energy.sum(), significant_height_m, seed)
    return peak_period_s / ratio, amplitude, phase


def gaussian(
    significant_height_m: float, peak_period_s: float, width: float, count: int, seed: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """As `components`, of the spectrum exp(-(f/f_p - 1)^2/(2 width^2)) within four widths; width 0: one regular wave.

    Each wave carries the energy of its part of the band, exactly. The regular wave has the phase 0.
    """
    if width == 0.0:
        amplitude = significant_height_m / math.sqrt(8.0)
        return np.array([peak_period_s]), np.array([amplitude]), np.zeros(1)
    edges = np.linspace(-REACH, REACH, count + 1)
    below = np.array([math.erf(edge / math.sqrt(2.0)) for edge in edges])
    place, amplitude, phase = _drawn(edges, np.diff(below) / (below[-1] - below[0]), significant_height_m, seed)
    return peak_period_s / (1.0 + width * place), amplitude, phase


def _drawn(edges, energy, significant_height_m, seed):
    """A place between every two edges, the amplitude (m) there and a phase (rad); energy: shares of the parts."""
    rng = np.random.default_rng(seed)
    place = edges[:-1] + np.diff(edges) * rng.random(len(energy))
    amplitude = np.sqrt(2.0 * energy * significant_height_m**2 / 16.0)
    return place, amplitude, 2.0 * np.pi * rng.random(len(energy))


def _shape(ratio, gamma):
    """The spectrum without its scale, at f/f_p."""
    width = np.where(ratio > 1.0, 0.09, 0.07)
    peak = np.exp(-((ratio - 1.0) ** 2) / (2.0 * width**2))
    return ratio**-5.0 * np.exp(-1.25 * ratio**-4.0) * gamma**peak


def _wave_number_in(scene, period_s):
    return wave_number(period_s, scene.water.depth_m, scene.gravity_mps2)


def steepness_of(scene: Scene) -> float:
    """Wave number times amplitude of the regular wave of a scene, whichever of the two it gives."""
    waves = scene.waves
    if waves.steepness is not None:
        return waves.steepness
    return _wave_number_in(scene, waves.period_s) * waves.amplitude_m


def components_of(scene: Scene) -> tuple[np.ndarray, ...]:
    """The waves of a scene, one or many: periods (s), amplitudes (m), phases and directions (rad), each (n,)."""
    waves = scene.waves
    if not waves.irregular:
        k = _wave_number_in(scene, waves.period_s)
        amplitude = waves.amplitude_m if waves.steepness is None else waves.steepness / k
        return tuple(
            np.array([component]) for component in (waves.period_s, amplitude, waves.phase_rad, waves.direction_rad)
        )
    if waves.jonswap is not None:
        sea = waves.jonswap
        drawn = components(sea.significant_height_m, waves.period_s, sea.peak_enhancement, sea.components, sea.seed)
        return (*drawn, np.full(sea.components, waves.direction_rad))
    if waves.significant_steepness is not None:
        height_m = 2.0 * waves.significant_steepness / _wave_number_in(scene, waves.period_s)
        drawn = gaussian(height_m, waves.period_s, waves.relative_width, waves.component_count, waves.seed)
        return (*drawn, np.full(len(drawn[0]), waves.direction_rad))
    if waves.record is not None:
        periods, amplitudes, phases = np.array([(w.period_s, w.amplitude_m, w.phase_rad) for w in waves.components]).T
        k = np.array([_wave_number_in(scene, period) for period in periods])
        return periods, amplitudes, phases - k * waves.record_x_m, np.zeros(len(periods))
    listed = [(wave.period_s, wave.amplitude_m, wave.phase_rad, wave.direction_rad) for wave in waves.components]
    return tuple(np.array(listed).T)


def enough_waves(scene: Scene, duration_s: float) -> dict[str, int]:
    """The change by which a sea has enough waves for a run of this length; {} where it has, or a key says how many.

    n waves in a band of B/T_p nearly recur after n T_p/B; a run lasts RECURRENCES of these times at most.
    """
    waves = scene.waves
    if waves.jonswap is not None:
        key, section, band = "waves.jonswap.components", waves.jonswap, HIGHEST - LOWEST
    elif waves.significant_steepness is not None:
        key, section, band = "waves.component_count", waves, 2.0 * REACH * waves.relative_width
    else:
        return {}
    name = key.rpartition(".")[2]
    needed = duration_s / waves.period_s * band / RECURRENCES
    if name in section.model_fields_set or needed <= getattr(section, name):
        return {}
    return {key: min(64 * math.ceil(needed / 64), MOST_COMPONENTS)}


def direction_of(angle: float) -> tuple[float, float]:
    """Cosine and sine, exact along the axes: 1e-16 across the waves would be a seed of motion out of their plane."""
    return round(math.cos(angle), 15), round(math.sin(angle), 15)


@lru_cache(maxsize=16)
def rows_of(scene: Scene) -> np.ndarray:
    """k, omega, phase, cos a, sin a, A omega/(1 - exp(-2 k H)) and A of every wave of a scene: (n, 7)."""
    depth, rows = scene.water.depth_m, []
    for period, amplitude, phase, angle in zip(*components_of(scene), strict=True):
        k, omega = _wave_number_in(scene, period), 2.0 * math.pi / period
        speed = amplitude * omega / (1.0 - math.exp(-2.0 * k * depth))
        rows.append((k, omega, phase, *direction_of(angle), speed, amplitude))
    waves = np.array(rows)
    waves.flags.writeable = False  # because it is kept
    return waves


def groups_of(scene: Scene) -> np.ndarray:
    """The waves of a sea as kernels read them (head of this file): (groups, ROW, COUNT)."""
    rows = rows_of(scene)
    rows = rows[np.argsort(rows[:, K], kind="stable")]
    if scene.motion.dimensions == 2:
        backwards = rows[:, COSINE] < 0.0
        rows[np.ix_(backwards, [OMEGA, PHASE, SPEED])] *= -1.0
        rows[:, COSINE] = 1.0
    missing = -len(rows) % COUNT
    if missing:
        without = np.repeat(rows[-1:], missing, axis=0)
        without[:, [SPEED, AMPLITUDE]] = 0.0
        rows = np.concatenate([rows, without])
    return rows.reshape(-1, COUNT, ROW).transpose(0, 2, 1).copy()


def shear_of(scene: Scene) -> float:
    """Root mean square (1/s) of the slope of the water's velocity at still water, of waves that are not all still."""
    rows = rows_of(scene)
    return max(math.sqrt(0.5 * np.sum((rows[:, K] * rows[:, OMEGA] * rows[:, AMPLITUDE]) ** 2)), 1e-12)


def elevation_m(
    scene: Scene, time_s: float | np.ndarray, x_m: float | np.ndarray = 0.0, y_m: float | np.ndarray = 0.0
) -> np.ndarray:
    """Height of the surface above the still water level (m), in waves of any kind.

    time_s, x_m, y_m    numbers or arrays that NumPy can broadcast against each other
    """
    t, x, y = (np.asarray(values, float) for values in (time_s, x_m, y_m))
    eta = np.zeros(np.broadcast_shapes(t.shape, x.shape, y.shape))
    for k, omega, phase, cosine, sine, _, amplitude in rows_of(scene):
        eta += amplitude * np.cos(k * (x * cosine + y * sine) - omega * t + phase)
    return eta * _share_of_ramp(scene, t)


def crest_share(scene: Scene, phase_rad: float) -> float:
    """Time to the next crest over the anchor, as a share of the period of a regular wave that begins at this phase."""
    k, _, _, cosine, sine, *_ = rows_of(scene)[0]
    x, y, _ = scene.anchor.position_m
    return (phase_rad + k * (x * cosine + y * sine)) / (2.0 * math.pi) % 1.0


def envelope_m(scene: Scene, time_s: np.ndarray) -> np.ndarray:
    """Amplitude (m) of the surface over the anchor: the modulus of the sum of A exp(i (k.x - omega t + phase)).

    The sum is over all waves. Source: S. O. Rice, Bell Syst. Tech. J. 23 (1944) 282.
    """
    total = np.zeros(time_s.shape, complex)
    x, y, _ = scene.anchor.position_m
    for k, omega, phase, cosine, sine, _, amplitude in rows_of(scene):
        total += amplitude * np.exp(1j * (k * (x * cosine + y * sine) - omega * time_s + phase))
    return np.abs(total) * _share_of_ramp(scene, time_s)


def _share_of_ramp(scene, t):
    """Share of their full height that waves have at times t (s)."""
    ramp = scene.waves.ramp_s
    if ramp == 0.0:
        return 1.0
    return np.where(t < ramp, np.sin(0.5 * math.pi * t / ramp) ** 2, 1.0)
