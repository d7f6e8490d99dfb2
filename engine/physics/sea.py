"""Irregular waves: a sum of linear waves, each with its own period, amplitude, phase and direction.

A sea of one wave is a regular wave (`engine.physics.waves`).

    U = sum_i U_i,   psi_i = k_i (x cos a_i + y sin a_i) - omega_i t + phase_i,   omega_i^2 = g k_i tanh k_i H

Every term is that of `physics.waves`; linear waves add. Above the still water level `zero` and `extrapolate` act on
each term alike, and Wheeler's stretching goes by the elevation of the whole sea, z -> z H/(H + eta), with
eta = sum A_i cos psi_i.

How it is summed. The waves lie side by side, COUNT in a vector. From node to node their exponentials and angles follow
by the recurrence of `engine.physics.waves`; for waves that are short beside an element its polynomials take a half, a
quarter ... of the step, and their results are squared as often. Waves for which this would lose digits are computed
anew at every node. A run in a lane takes the same sum as a run alone, so that both have the same bits.

The sum is the whole cost of a sea, and a stage needs it once. Newton's method takes it anew only where a node has moved
so far, `still` of the record, that the velocity of the water changes by three times the tolerance of the method. With
the water held it converges no slower, because its matrix holds the water as well; what it leaves over is as large as
what the tolerance leaves over (some 1e-4 m in a period of the shipped buoy).

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

import numpy as np

from ..compiled import kernel
from ..record import WHEELER, ZERO
from ..scene.models import Scene
from ..scene.values import MOST_COMPONENTS
from ..simd.access import eight_of, in_lane, lane_of, power_of_two, read_eight, total, write_eight
from ..simd.elementary import PIO2_A, PIO2_B, PIO2_C, TWO_OVER_PI, sincos, smooth_start
from ..simd.select import larger, smaller, where
from ..simd.vector import COUNT
from .waves import SMALL, wave_number

K, OMEGA, PHASE, COSINE, SINE, SPEED, AMPLITUDE = range(7)  # rows of a group in `tables`
ROW = 7
SUMS, PLACES = 0, 6  # columns of Work.sea: sums of the waves at the nodes, and the places they were taken at
SEA_WIDTH = 9
STEEP, DEEP = 2.0, 600.0  # k times an element, k times the depth: beyond, waves are computed anew at every node
LN2_A = float.fromhex("0x1.62e42fefa0000p-1")  # ln 2 in two parts; products of the first with whole numbers are exact
LN2_B = 1.6465949582897082e-12
STILL = 3.0  # change of the water's velocity, over the tolerance of Newton's method, that is left out
LOWEST, HIGHEST = 0.5, 3.0  # of the peak frequency
REACH = 4.0  # of a Gaussian spectrum, in its widths
RECURRENCES = 10  # mean times after which groups of a sea nearly recur, in a run
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


def gaussian(
    significant_height_m: float, peak_period_s: float, width: float, count: int, seed: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """As `components`, of the spectrum exp(-(f/f_p - 1)^2/(2 width^2)) within four widths; width 0: one regular wave.

    Each wave carries the energy of its part of the band, exactly. The regular wave has the phase 0.
    """
    if width == 0.0:
        amplitude = significant_height_m / math.sqrt(8.0)
        return np.array([peak_period_s]), np.array([amplitude]), np.zeros(1)
    rng = np.random.default_rng(seed)
    edges = np.linspace(-REACH, REACH, count + 1)
    place = edges[:-1] + np.diff(edges) * rng.random(count)
    below = np.array([math.erf(edge / math.sqrt(2.0)) for edge in edges])
    energy = np.diff(below) / (below[-1] - below[0])
    amplitude = np.sqrt(2.0 * energy * significant_height_m**2 / 16.0)
    return peak_period_s / (1.0 + width * place), amplitude, 2.0 * np.pi * rng.random(count)


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
    if waves.significant_steepness is not None:
        k = wave_number(waves.period_s, scene.water.depth_m, scene.gravity_mps2)
        height_m = 2.0 * waves.significant_steepness / k
        drawn = gaussian(height_m, waves.period_s, waves.relative_width, waves.component_count, waves.seed)
        return (*drawn, np.full(len(drawn[0]), waves.direction_rad))
    if waves.record is not None:
        periods, amplitudes, phases = np.array([(w.period_s, w.amplitude_m, w.phase_rad) for w in waves.components]).T
        k = np.array([wave_number(period, scene.water.depth_m, scene.gravity_mps2) for period in periods])
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


def rows_of(scene: Scene) -> np.ndarray:
    """k, omega, phase, cos a, sin a, A omega/(1 - exp(-2 k H)) and A of every wave of a scene: (n, 7)."""
    depth, rows = scene.water.depth_m, []
    for period, amplitude, phase, angle in zip(*components_of(scene), strict=True):
        k, omega = wave_number(period, depth, scene.gravity_mps2), 2.0 * math.pi / period
        speed = amplitude * omega / (1.0 - math.exp(-2.0 * k * depth))
        rows.append((k, omega, phase, *direction_of(angle), speed, amplitude))
    return np.array(rows)


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
    ramp = scene.waves.ramp_s
    return eta * (np.where(t < ramp, np.sin(0.5 * math.pi * t / ramp) ** 2, 1.0) if ramp > 0.0 else 1.0)


@kernel
def exponential(x):
    """exp(x) of a vector, to some units in the last place; below -708 as there."""
    x = larger(smaller(x, 709.0), -708.0)
    count = np.rint(x * (1.0 / 0.6931471805599453))
    root = exponentials(0.5 * ((x - count * LN2_A) - count * LN2_B))[0]
    return root * root * power_of_two(count)


@kernel
def exponentials(a):
    """exp(a) and exp(-a) as `small_exponentials`, without its divisions, which would take half of the time of a sum."""
    z = a * a
    even = 1.0 + z * (0.5 + z * (1.0 / 24 + z * (1.0 / 720 + z * (1.0 / 40320 + z * (1.0 / 3628800)))))
    odd = 1.0 + z * (1.0 / 6 + z * (1.0 / 120 + z * (1.0 / 5040 + z * (1.0 / 362880 + z * (1.0 / 39916800)))))
    return even + a * odd, even - a * odd


@kernel
def angles(a):
    """sin(a) and cos(a) as `small_sincos`, without divisions."""
    z = a * a
    s = 1.0 + z * (-1.0 / 6 + z * (1.0 / 120 + z * (-1.0 / 5040 + z * (1.0 / 362880 - z * (1.0 / 39916800)))))
    c = 1.0 + z * (-0.5 + z * (1.0 / 24 + z * (-1.0 / 720 + z * (1.0 / 40320 - z * (1.0 / 3628800)))))
    return a * s, c


@kernel
def phase_at(omega, phase, t):
    """phase - omega t less whole turns, with the digits that the product omega t does not have."""
    turned = omega * t
    missed = omega * t - turned
    turns = 4.0 * np.rint(0.25 * TWO_OVER_PI * turned)
    return phase - ((((turned - turns * PIO2_A) - turns * PIO2_B) - turns * PIO2_C) + missed)


@kernel
def surface_sums(tables, at, groups, t, x, y):
    """The full-grown surface of a sea at x, y (m): eta; its slopes by x, y; second derivatives by xx, xy, yy; eta_t,
    and the slopes of it by x, y."""
    eta = eta_x = eta_y = eta_xx = eta_xy = eta_yy = rate = rate_x = rate_y = 0.0 * eight_of(tables, at)
    for group in range(groups):
        row = at + ROW * COUNT * group
        k, omega = eight_of(tables, row + COUNT * K), eight_of(tables, row + COUNT * OMEGA)
        kx, ky = k * eight_of(tables, row + COUNT * COSINE), k * eight_of(tables, row + COUNT * SINE)
        high = eight_of(tables, row + COUNT * AMPLITUDE)
        s, c = sincos(kx * x + (ky * y + phase_at(omega, eight_of(tables, row + COUNT * PHASE), t)))
        up, along = high * c, high * s
        eta += up
        eta_x -= kx * along
        eta_y -= ky * along
        eta_xx -= kx * (kx * up)
        eta_xy -= kx * (ky * up)
        eta_yy -= ky * (ky * up)
        rising = omega * along
        rate += rising
        up_rate = omega * up
        rate_x += kx * up_rate
        rate_y += ky * up_rate
    return (
        total(eta), total(eta_x), total(eta_y), total(eta_xx), total(eta_xy), total(eta_yy),
        total(rate), total(rate_x), total(rate_y),
    )  # fmt: skip


@kernel
def heights(tables, at, groups, wheeler, depth, t, ramp, X, Z):
    """Heights (m) at which the field is taken for the places X (n, 2) or (n, 3), into Z (n,)."""
    last = X.shape[1] - 1
    gain = smooth_start(t, ramp)[0]
    for j in range(X.shape[0]):
        Z[j] = max(X[j, last], 0.0)
        if wheeler:
            y = X[j, 1] if last == 2 else 0.0
            eta = gain * surface_sums(tables, at, groups, t, X[j, 0], y)[0]
            # A trough of the whole sea below the bed has no meaning; rules of the scene keep the usual ones above it.
            Z[j] = Z[j] * depth / max(depth + eta, 1e-3 * depth)


@kernel
def longest_step(X, Z):
    """Longest way (m) from a node to the next, along x, y or z."""
    longest = 0.0
    for j in range(1, X.shape[0]):
        longest = max(longest, abs(Z[j] - Z[j - 1]))
        for axis in range(X.shape[1] - 1):
            longest = max(longest, abs(X[j, axis] - X[j - 1, axis]))
    return longest


@kernel
def field_sums(tables, at, groups, depth, t, X, Z, width, sums):
    """Sums over the waves, full-grown, at places X (n, 2) or (n, 3) with heights Z (n,), into sums (n, .).

    width: 4, U, W and their rates in a plane; 8, also -U_x, W_x and the slopes A_x, B_x of their rates; 6, U, V, W and
    their rates in space.
    """
    n = X.shape[0]
    step, slopes, space = longest_step(X, Z), width == 8, width == 6
    if space:
        step *= 1.4142135623730951
    room = np.zeros(n * width * COUNT)
    for group in range(groups):
        row = at + ROW * COUNT * group
        k, omega = eight_of(tables, row + COUNT * K), eight_of(tables, row + COUNT * OMEGA)
        cosine, sine = eight_of(tables, row + COUNT * COSINE), eight_of(tables, row + COUNT * SINE)
        speed = eight_of(tables, row + COUNT * SPEED)
        begun = phase_at(omega, eight_of(tables, row + COUNT * PHASE), t)
        shortest = tables[row + COUNT * K + COUNT - 1]
        anew = shortest * step > STEEP or shortest * depth > DEEP
        squarings, share = 0, 1.0
        while share * shortest * step > SMALL and not anew:
            squarings, share = squarings + 1, 0.5 * share
        k_step = share * k
        up, down, s, c = speed, speed, speed, speed
        for j in range(n - 1, -1, -1):
            if anew or j == n - 1:
                x = cosine * X[j, 0] + sine * X[j, 1] if space else cosine * X[j, 0]
                s, c = sincos(k * x + begun)
                up, down = speed * exponential(k * (Z[j] - depth)), speed * exponential(-(k * (Z[j] + depth)))
            else:
                dx = k_step * (X[j, 0] - X[j + 1, 0])
                if space:
                    dx = dx * cosine + (k_step * sine) * (X[j, 1] - X[j + 1, 1])
                e1, e2 = exponentials(k_step * (Z[j] - Z[j + 1]))
                ds, dc = angles(dx)
                for _ in range(squarings):
                    e1, e2, ds, dc = e1 * e1, e2 * e2, 2.0 * (ds * dc), 1.0 - 2.0 * ds * ds
                up, down, s, c = up * e1, down * e2, s * dc + c * ds, c * dc - s * ds
            cosh_part, sinh_part = up + down, up - down
            uc, us, ws, wc = cosh_part * c, cosh_part * s, sinh_part * s, sinh_part * c
            place = j * width * COUNT
            if space:
                _add(room, place, cosine, uc)
                _add(room, place + COUNT, sine, uc)
                _add(room, place + 2 * COUNT, 1.0, ws)
                us = omega * us
                _add(room, place + 3 * COUNT, cosine, us)
                _add(room, place + 4 * COUNT, sine, us)
                _add(room, place + 5 * COUNT, -omega, wc)
            else:
                write_eight(room, place, read_eight(room, place) + uc)
                write_eight(room, place + COUNT, read_eight(room, place + COUNT) + ws)
                _add(room, place + 2 * COUNT, omega, us)
                _add(room, place + 3 * COUNT, -omega, wc)
                if slopes:
                    _add(room, place + 4 * COUNT, k, us)
                    _add(room, place + 5 * COUNT, k, wc)
                    k_omega = k * omega
                    _add(room, place + 6 * COUNT, k_omega, uc)
                    _add(room, place + 7 * COUNT, k_omega, ws)
    for j in range(n):
        for m in range(width):
            sums[j, m] = total(read_eight(room, (j * width + m) * COUNT))


@kernel
def _add(room, place, weight, term):
    write_eight(room, place, read_eight(room, place) + weight * term)


@kernel
def due(p, t, X, sea):
    """Is the sum in Work.sea to be taken anew: at another time, or because a node has moved by more than `still`?"""
    n, size = X.shape
    moved = 0.0
    for j in range(n):
        square = 0.0
        for axis in range(size):
            way = X[j, axis] - sea[j, PLACES + axis]
            square += way * way
        moved = larger(moved, square)
    return (sea[n, 0] != t) | (sea[n, 1] == 0.0) | (moved > p.still * p.still)


@kernel
def take_sums(tables, at, groups, wheeler, depth, ramp, t, X, sea):
    """The sums of the sea at time t (s) and places X into Work.sea, with the time and the places."""
    n, size = X.shape
    Z = np.empty(n)
    heights(tables, at, groups, wheeler, depth, t, ramp, X, Z)
    field_sums(tables, at, groups, depth, t, X, Z, 2 * size, sea)
    for j in range(n):
        for axis in range(size):
            sea[j, PLACES + axis] = X[j, axis]
    sea[n, 0], sea[n, 1] = t, 1.0


@kernel
def sea_field(p, tables, t, X, F, sea):
    """Water velocity and local acceleration at the nodes, added into F, in a plane and in space.

    X (n, 2) x, z or (n, 3) x, y, z (m); F (n, 4) or (n, 6), velocity (m/s), then its local rate (m/s2); sea (n + 1, 9):
    of Work.
    """
    if due(p, t, X, sea):
        take_sums(tables, p.sea_at, p.sea_n, p.above == WHEELER, p.depth, p.ramp, t, X, sea)
    _add_sums(p, t, X, F, sea)


@kernel
def sea_field_in_lanes(p, tables, t, X, F, sea):
    """As `sea_field` for several runs: each lane that needs them takes its own sums."""
    needed = due(p, t, X, sea)
    for b in range(COUNT):
        if lane_of(needed, b):
            depth, ramp = lane_of(p.depth, b), lane_of(p.ramp, b)
            own, place, sums = in_lane(tables, b), in_lane(X, b), in_lane(sea, b)
            take_sums(own, p.sea_at, p.sea_n, p.above == WHEELER, depth, ramp, lane_of(t, b), place, sums)
    _add_sums(p, t, X, F, sea)


@kernel
def _add_sums(p, t, X, F, sea):
    """Sums of full-grown waves, under their ramp, into F; nothing above still water where the scene says so."""
    size = X.shape[1]
    gain, gain_rate = smooth_start(t, p.ramp)
    for j in range(X.shape[0]):
        wet = 1.0
        if p.above == ZERO:
            wet = where(X[j, size - 1] > p.depth, 0.0, 1.0)
        for i in range(size):
            speed, rate = wet * sea[j, i], wet * sea[j, size + i]
            F[j, i] += gain * speed
            F[j, size + i] += gain * rate + gain_rate * speed


@kernel
def sea_slopes(p, tables, t, X, F, J):
    """J (n, 8): dF/dx (4) and dF/dz (4) of a sea at X (n, 2), by harmonic functions as in `waves.wave_slopes`."""
    sums = np.empty((X.shape[0], 8))
    take_slopes(tables, p.sea_at, p.sea_n, p.above, p.depth, p.ramp, t, X, sums, J)


@kernel
def sea_slopes_in_lanes(p, tables, t, X, F, J):
    """As `sea_slopes` for several runs, one after another."""
    sums = np.empty((X.shape[0], 8))
    for b in range(COUNT):
        depth, ramp = lane_of(p.depth, b), lane_of(p.ramp, b)
        own, places, into = in_lane(tables, b), in_lane(X, b), in_lane(J, b)
        take_slopes(own, p.sea_at, p.sea_n, p.above, depth, ramp, lane_of(t, b), places, sums, into)


@kernel
def take_slopes(tables, at, groups, above, depth, ramp, t, X, sums, J):
    """Slopes of the water of one run, at X (n, 2), into J (n, 8); sums (n, 8): work."""
    n = X.shape[0]
    Z = np.empty(n)
    heights(tables, at, groups, above == WHEELER, depth, t, ramp, X, Z)
    field_sums(tables, at, groups, depth, t, X, Z, 8, sums)
    gain, gain_rate = smooth_start(t, ramp)
    for j in range(n):
        if above == ZERO and X[j, 1] > depth:
            for i in range(8):
                J[j, i] = 0.0
            continue
        U_x, W_x = -gain * sums[j, 4], gain * sums[j, 5]
        A_x = gain * sums[j, 6] - gain_rate * sums[j, 4]
        B_x = gain * sums[j, 7] + gain_rate * sums[j, 5]
        by_x, by_z = 0.0, 1.0 if X[j, 1] > 0.0 else 0.0
        if above == WHEELER:
            surface = surface_sums(tables, at, groups, t, X[j, 0], 0.0)
            stretch = depth / max(depth + gain * surface[0], 1e-3 * depth)
            by_x, by_z = -max(X[j, 1], 0.0) * stretch * stretch / depth * gain * surface[1], by_z * stretch
        J[j, 0], J[j, 4] = U_x + by_x * W_x, by_z * W_x
        J[j, 1], J[j, 5] = W_x - by_x * U_x, -by_z * U_x
        J[j, 2], J[j, 6] = A_x + by_x * B_x, by_z * B_x
        J[j, 3], J[j, 7] = B_x - by_x * A_x, -by_z * A_x
