"""Irregular waves: a sum of linear waves, each with its own period, amplitude, phase and direction.

In space a regular wave is a sea of one; in a plane it has a kernel of its own, which several runs at once can share.

    U = sum_i U_i,   psi_i = k_i (x cos a_i + y sin a_i) - omega_i t + phase_i,   omega_i^2 = g k_i tanh k_i H

Every term is that of `physics.waves`; linear waves add. Above the still water level `zero` and `extrapolate` act on
each term alike, and Wheeler's stretching goes by the elevation of the whole sea, z -> z H/(H + eta), with
eta = sum A_i cos psi_i.

Layout in `tables`, one row a component: k, omega, A, phase, cos a, sin a, A omega/(1 - exp(-2 k H)).

A sea of given height and period is drawn from the JONSWAP spectrum:

    S(f) = c f^-5 exp(-5/4 (f/f_p)^-4) gamma^g,    g = exp(-(f/f_p - 1)^2/(2 sigma^2))

with sigma = 0.07 below f_p and 0.09 above. gamma = 1 is the spectrum of Pierson and Moskowitz. c is chosen so that the
components together carry H_s^2/16, the variance of a sea of significant height H_s. The band from f_p/2 to 3 f_p,
which holds 98.5 % of the energy at gamma = 1 and more above, is cut into parts of equal width; in each lies one
component, at a random place (even frequencies would repeat the sea after 1/df) and with a random phase. Its amplitude
carries the energy of its part: it is not random, so that every seed has the same H_s.

Source: K. Hasselmann et al., Deutsche Hydrographische Zeitschrift A8, no. 12 (1973); W. J. Pierson & L. Moskowitz,
J. Geophys. Res. 69 (1964) 5181.
"""

import math

import numpy as np

from ..compiled import kernel
from ..record import WHEELER, ZERO
from ..scene.models import Scene
from ..simd.elementary import sincos, small_exponentials, small_sincos, smooth_start
from .waves import SMALL, TINY, wave_number

K, OMEGA, AMPLITUDE, PHASE, COSINE, SINE, SPEED = range(7)  # columns of the table, one row a component
ROW = 7
LOWEST, HIGHEST = 0.5, 3.0  # of the peak frequency
_POINTS = 200  # over which the energy of one part is summed


def components(
    significant_height_m: float, peak_period_s: float, gamma: float, count: int, seed: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Periods (s), amplitudes (m) and phases (rad), each (count,), of a sea; the same arguments give the same numbers.

    sum A^2/2 = H_s^2/16 to rounding.
    """
    rng = np.random.default_rng(seed)
    edges = np.linspace(LOWEST, HIGHEST, count + 1)
    ratio = edges[:-1] + (edges[1:] - edges[:-1]) * rng.random(count)
    inner = edges[:-1, None] + np.diff(edges)[:, None] * np.linspace(0.0, 1.0, _POINTS + 1)
    energy = np.trapezoid(_shape(inner, gamma), inner, axis=1)
    amplitude = np.sqrt(2.0 * energy / energy.sum() * significant_height_m**2 / 16.0)
    return peak_period_s / ratio, amplitude, 2.0 * np.pi * rng.random(count)


def _shape(ratio, gamma):
    """The spectrum without its scale, at f/f_p."""
    width = np.where(ratio > 1.0, 0.09, 0.07)
    peak = np.exp(-((ratio - 1.0) ** 2) / (2.0 * width**2))
    return ratio**-5.0 * np.exp(-1.25 * ratio**-4.0) * gamma**peak


def components_of(scene: Scene) -> tuple[np.ndarray, ...]:
    """The waves of a scene, one or many: periods (s), amplitudes (m), phases and directions (rad), each (n,)."""
    waves = scene.waves
    if not waves.irregular:
        k = wave_number(waves.period_s, scene.water.depth_m, scene.gravity_mps2)
        amplitude = waves.amplitude_m if waves.steepness is None else waves.steepness / k
        return tuple(
            np.array([component]) for component in (waves.period_s, amplitude, waves.phase_rad, waves.direction_rad)
        )
    if waves.jonswap is not None:
        sea = waves.jonswap
        drawn = components(sea.significant_height_m, waves.period_s, sea.peak_enhancement, sea.components, sea.seed)
        return (*drawn, np.full(sea.components, waves.direction_rad))
    listed = [(wave.period_s, wave.amplitude_m, wave.phase_rad, wave.direction_rad) for wave in waves.components]
    return tuple(np.array(listed).T)


def direction_of(angle: float) -> tuple[float, float]:
    """Cosine and sine, exact along the axes: 1e-16 across the waves would be a seed of motion out of their plane."""
    return round(math.cos(angle), 15), round(math.sin(angle), 15)


def table_of(scene: Scene) -> np.ndarray:
    """The rows of the sea (head of this file)."""
    depth, rows = scene.water.depth_m, []
    for period, amplitude, phase, angle in zip(*components_of(scene), strict=True):
        k, omega = wave_number(period, depth, scene.gravity_mps2), 2.0 * math.pi / period
        speed = amplitude * omega / (1.0 - math.exp(-2.0 * k * depth))
        rows.append((k, omega, amplitude, phase, *direction_of(angle), speed))
    return np.array(rows)


def elevation_m(
    scene: Scene, time_s: float | np.ndarray, x_m: float | np.ndarray = 0.0, y_m: float | np.ndarray = 0.0
) -> np.ndarray:
    """Height of the surface above the still water level (m), in waves of any kind.

    time_s, x_m, y_m    numbers or arrays that NumPy can broadcast against each other
    """
    t, x, y = (np.asarray(values, float) for values in (time_s, x_m, y_m))
    eta = np.zeros(np.broadcast_shapes(t.shape, x.shape, y.shape))
    for k, omega, amplitude, phase, cosine, sine, _ in table_of(scene):
        eta += amplitude * np.cos(k * (x * cosine + y * sine) - omega * t + phase)
    ramp = scene.waves.ramp_s
    return eta * (np.where(t < ramp, np.sin(0.5 * math.pi * t / ramp) ** 2, 1.0) if ramp > 0.0 else 1.0)


@kernel
def sea_field(p, tables, t, X, F):
    """Water velocity and local acceleration at the nodes, added into F, in a plane and in space.

    X : (n, 2) x, z or (n, 3) x, y, z (m);  F : (n, 4) or (n, 6), velocity (m/s), then its local rate (m/s2)
    """
    n, size = X.shape
    gain, gain_rate = smooth_start(t, p.ramp)
    Z = np.empty(n)
    for j in range(n):
        Z[j] = max(X[j, size - 1], 0.0)
    if p.above == WHEELER:
        for j in range(n):
            eta = 0.0
            for i in range(p.sea_n):
                row = tables[p.sea_at + ROW * i : p.sea_at + ROW * (i + 1)]
                place = row[COSINE] * X[j, 0] + (row[SINE] * X[j, 1] if size == 3 else 0.0)
                eta += row[AMPLITUDE] * sincos(row[K] * place - row[OMEGA] * t + row[PHASE])[1]
            # A trough of the whole sea below the bed has no meaning; rules of the scene keep the usual ones above it.
            Z[j] = Z[j] * p.depth / max(p.depth + gain * eta, 1e-3 * p.depth)
    for i in range(p.sea_n):
        row = tables[p.sea_at + ROW * i : p.sea_at + ROW * (i + 1)]
        _add_wave(row, p.depth, p.above, gain, gain_rate, t, X, Z, F)


@kernel
def _add_wave(row, depth, above, gain, gain_rate, t, X, Z, F):
    """One component, by the recurrences of `engine.physics.waves.wave_field`."""
    n, size = X.shape
    k, om, phase, cosine, sine = row[K], row[OMEGA], row[PHASE], row[COSINE], row[SINE]
    u0, u1 = row[SPEED] * gain, row[SPEED] * gain_rate
    up, down, s, c = 0.0, 0.0, 0.0, 1.0
    x_below = z_below = 0.0
    for j in range(n):
        x = cosine * X[j, 0] + (sine * X[j, 1] if size == 3 else 0.0)
        z = Z[j]
        dz, dx = k * (z - z_below), k * (x - x_below)
        x_below, z_below = x, z
        if j > 0 and abs(dz) < SMALL and abs(dx) < SMALL and up > TINY:
            e1, e2 = small_exponentials(dz)
            ds, dc = small_sincos(dx)
            up, down, s, c = up * e1, down * e2, s * dc + c * ds, c * dc - s * ds
        else:
            s, c = sincos(k * x - om * t + phase)
            up, down = math.exp(k * (z - depth)), math.exp(-k * (z + depth))
        cosh_part, sinh_part = up + down, up - down
        if above == ZERO and X[j, size - 1] > depth:
            cosh_part = sinh_part = 0.0
        uc, us, wc, ws = cosh_part * c, cosh_part * s, sinh_part * c, sinh_part * s
        u, u_t = u0 * uc, u0 * om * us + u1 * uc
        F[j, 0] += cosine * u
        F[j, size] += cosine * u_t
        if size == 3:
            F[j, 1] += sine * u
            F[j, 4] += sine * u_t
        F[j, size - 1] += u0 * ws
        F[j, 2 * size - 1] += u1 * ws - u0 * om * wc
