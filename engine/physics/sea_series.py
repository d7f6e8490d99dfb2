"""A sea in a plane, as a series about a moment and the places of the nodes.

With y = x - i z and its conjugate the waves of a sea (`engine.physics.sea`) are two analytic functions,

    F = sum a_i e^(i(k_i x - omega_i t)) e^(k_i (z - H)),    G = sum a_i e^(i(k_i x - omega_i t)) e^(-k_i (z + H)),
    U = Re(F + G),    W = Im(F - G),    a_i = A_i omega_i e^(i phase_i)/(1 - exp(-2 k_i H)),

and its surface is eta = Re E, E = sum A_i e^(i(k_i x - omega_i t + phase_i)). Each is a series in dt and in i dx + dz,
i dx - dz or i dx:

    F(x + dx, z + dz, t + dt) = sum over m + n <= ORDER of (i dx + dz)^m (-i dt)^n S_mn,
    S_mn = sum over the waves of k^m omega^n F_i/(m! n!)

Rates and slopes are those of the series. The sums S are nearly the whole cost of a sea. Every trial step takes them
once, at its first stage; they serve its other stages and iterations as long as `reach_of` allows, else they are taken
anew. So a run that goes on from a state has the bits of the run that did not stop.

Why not the plain sum in every iteration: with 64 waves it cost two to five times as much as all the rest of a run in a
lane (five with Wheeler's stretching, which needs the surface at every node).

The waves lie side by side, COUNT in a vector, and follow from node to node by recurrence (`engine.physics.sea_sum`). A
run in a lane takes the same sums as a run alone, so that both have the same bits.
"""

import math

import numpy as np

from ..compiled import kernel
from ..record import WHEELER, ZERO
from ..scene.models import Scene
from ..simd.access import in_lane, lane_count, lane_of, read_vector, total, vector_at, write_vector
from ..simd.elementary import sincos, smooth_start
from ..simd.select import larger, where
from ..simd.vector import COUNT
from .sea import AMPLITUDE, OMEGA, ROW, K, rows_of
from .sea_sum import TAKEN, TIME, division_of, exponential, phase_at, raised, stretching, turned, waves_of
from .waves import put_slopes

ORDER = 3
TERMS = (ORDER + 1) * (ORDER + 2) // 2  # S_mn of one function, ordered by m, then n
UPPER, LOWER, SURFACE = 0, 2 * TERMS, 4 * TERMS  # columns of Work.sea: real and imaginary parts of S of F, G and E
PLACE_X, PLACE_Z, HEIGHT = range(6 * TERMS, 6 * TERMS + 3)  # of the series; and where the water of a node is taken now
SQUARE, CUBE = (SURFACE + m * (2 * ORDER + 3 - m) for m in (2, 3))  # S_20, before S_21, and S_30 of the surface
TOP_ETA = 2  # in the last row, after TIME and TAKEN: the surface at the buoy (`put_surface`)
WIDTH = 6 * TERMS + 3
LEFT_OUT = 0.3  # standard deviation of the error of the water's velocity, over the tolerance of Newton's method


def reach_of(scene: Scene, speed_mps: float) -> tuple[float, float]:
    """How far (m) and how long (s) the series of `engine.physics.sea_series` holds to an error of the water's speed.

    Over all phases, and at still water, the standard deviation of the error is less than
    (sum a^2/2 (k rho + omega tau)^(2 ORDER + 2))^(1/2)/ORDER!, where a = A omega, rho is the way from the place of the
    series and tau the time since. That is ORDER + 1 times the first term left out, for the sake of its rate. It stays
    below speed_mps while rho/reach + tau/span <= 1, by Minkowski's inequality.
    """
    rows = rows_of(scene)
    speeds = np.abs(rows[:, AMPLITUDE] * rows[:, OMEGA])

    def most(rates):
        spread = math.sqrt(0.5 * np.sum((speeds * rates ** (ORDER + 1)) ** 2))
        return (math.factorial(ORDER) * speed_mps / max(spread, 1e-300)) ** (1.0 / (ORDER + 1))

    return most(rows[:, K]), most(np.abs(rows[:, OMEGA]))


@kernel
def forget(sea):
    """Let the next sums be taken anew: a trial step begins. sea: of Work."""
    sea[sea.shape[0] - 1, TAKEN] = 0.0


@kernel
def times_plus(factor, value, term):
    """factor value + term, of complex numbers as pairs."""
    re = factor[0] * value[0] - factor[1] * value[1] + term[0]
    im = factor[0] * value[1] + factor[1] * value[0] + term[1]
    return re, im


@kernel
def series(row, first, dt, y):
    """Value, rate, slope and rate of the slope of sum y^m (-i dt)^n S_mn, complex numbers as pairs, like y.

    row: of Work.sea; first: column of the series. The slope is by y.
    """
    zero = 0.0 * dt
    value = rate = slope = rising = (zero, zero)
    for m in range(ORDER, -1, -1):
        re = im = re_t = im_t = zero  # sum (-i dt)^n S_mn of this m, and its rate
        for n in range(ORDER - m, -1, -1):
            at = first + 2 * (m * (2 * ORDER + 3 - m) // 2 + n)
            re_t, im_t = dt * im_t + im, -(dt * re_t + re)
            re, im = row[at] + dt * im, row[at + 1] - dt * re
        slope = times_plus(y, slope, value)
        rising = times_plus(y, rising, rate)
        value = times_plus(y, value, (re, im))
        rate = times_plus(y, rate, (re_t, im_t))
    return value, rate, slope, rising


@kernel
def weights_of(k, omega, weights, at):
    """k^m omega^n/(m! n!) of a group of waves, into weights from `at` on, COUNT numbers a term."""
    by_k = 1.0 + 0.0 * k
    for m in range(ORDER + 1):
        weight = by_k
        for n in range(ORDER + 1 - m):
            write_vector(weights, at, weight)
            at += COUNT
            weight = weight * omega * (1.0 / (n + 1))
        by_k = by_k * k * (1.0 / (m + 1))


@kernel
def put_sums(weights, parts, of_part, groups, row, first):
    """Sums over the waves of weights times a real and an imaginary part, for all terms, into a row of Work.sea.

    parts: four vectors a group; of_part: the first of the two that are summed.
    """
    for term in range(TERMS):
        re = im = 0.0 * read_vector(parts, 0)
        for group in range(groups):
            weight = read_vector(weights, (group * TERMS + term) * COUNT)
            at = (4 * group + of_part) * COUNT
            re += weight * read_vector(parts, at)
            im += weight * read_vector(parts, at + COUNT)
        row[first + 2 * term], row[first + 2 * term + 1] = total(re), total(im)


@kernel
def put_phases(tables, at, groups, t, x, phases):
    """Cosine and sine of the phase of every wave at t (s) and x (m), into phases: two vectors a group."""
    for group in range(groups):
        k, omega, phase, _, _, _, _ = waves_of(tables, at, group)
        s, c = sincos(k * x + phase_at(omega, phase, t))
        write_vector(phases, 2 * COUNT * group, c)
        write_vector(phases, 2 * COUNT * group + COUNT, s)


@kernel
def combine(tables, at, few, groups, phases, combined):
    """Real and imaginary parts sum T_mi e^(i phase_i) of few waves (`engine.physics.sea_basis`), two vectors a group.

    at: of the shares T in tables; few, groups: of the few and of all waves; phases: of all waves, as from `put_phases`.
    """
    for wave in range(few * COUNT):
        re = im = 0.0 * read_vector(phases, 0)
        for group in range(groups):
            share = vector_at(tables, at)
            re += share * read_vector(phases, 2 * COUNT * group)
            im += share * read_vector(phases, 2 * COUNT * group + COUNT)
            at += COUNT
        place = 2 * COUNT * (wave // COUNT) + wave % COUNT
        combined[place], combined[place + COUNT] = total(re), total(im)


@kernel
def near_anchor(X, wide, top):
    """Whether all places X (n, 2) lie where few waves stand for all."""
    farthest = highest = 0.0
    for j in range(X.shape[0]):
        farthest, highest = max(farthest, abs(X[j, 0] - X[0, 0])), max(highest, X[j, 1])
    return farthest <= wide and highest <= top


@kernel
def take_series(tables, at, groups, few, region, wheeler, depth, ramp, t, X, sea):
    """The series of a sea about time t (s) and places X (n, 2), into Work.sea.

    at, groups: of all waves; few: groups of the few that stand for them, and their place in tables, behind which the
    shares T are; region: (wide, top) in which they do (`engine.physics.sea_basis`).
    """
    n, anchor_x = X.shape[0], X[0, 0]
    gain = smooth_start(t, ramp)[0]
    phases = np.empty(2 * groups * COUNT)
    put_phases(tables, at, groups, t, anchor_x, phases)
    if few[0] > 0 and near_anchor(X, region[0], region[1]):
        combined, all_groups = np.empty(2 * few[0] * COUNT), groups
        groups, at = few
        combine(tables, at + groups * ROW * COUNT, groups, all_groups, phases, combined)
        phases = combined
    weights = np.empty(groups * TERMS * COUNT)
    # of each group: k, amplitude and speed; sine, cosine, exponential up and down; what is summed
    waves, running, parts = np.empty(3 * groups * COUNT), np.empty(4 * groups * COUNT), np.empty(4 * groups * COUNT)
    for group in range(groups):
        k, omega, _, _, _, speed, amplitude = waves_of(tables, at, group)
        weights_of(k, omega, weights, group * TERMS * COUNT)
        place = 3 * COUNT * group
        write_vector(waves, place, k)
        write_vector(waves, place + COUNT, amplitude)
        write_vector(waves, place + 2 * COUNT, speed)
    for j in range(n - 1, -1, -1):
        x, top = X[j, 0], j == n - 1
        dx = 0.0 if top else x - X[j + 1, 0]
        for group in range(groups):
            wave, place = 3 * COUNT * group, 4 * COUNT * group
            k = read_vector(waves, wave)
            anew, squarings, share = division_of(waves[wave + COUNT - 1], abs(dx), depth)
            if top or anew:
                ds, dc = sincos(k * (x - anchor_x))
                c, s = read_vector(phases, 2 * COUNT * group), read_vector(phases, 2 * COUNT * group + COUNT)
                s, c = s * dc + c * ds, c * dc - s * ds
            else:
                s, c = read_vector(running, place), read_vector(running, place + COUNT)
                s, c = turned(s, c, (share * k) * dx, squarings)
            write_vector(running, place, s)
            write_vector(running, place + COUNT, c)
            if wheeler or top:
                amplitude = read_vector(waves, wave + COUNT)
                write_vector(parts, place, amplitude * c)
                write_vector(parts, place + COUNT, amplitude * s)
        z = max(X[j, 1], 0.0)
        if wheeler or top:
            put_sums(weights, parts, 0, groups, sea[j], SURFACE)
        if wheeler:
            z *= stretching(depth, gain * sea[j, SURFACE])
        dz = 0.0 if top else z - sea[j + 1, PLACE_Z]
        for group in range(groups):
            wave, place = 3 * COUNT * group, 4 * COUNT * group
            k = read_vector(waves, wave)
            anew, squarings, share = division_of(waves[wave + COUNT - 1], abs(dz), depth)
            if top or anew:
                speed = read_vector(waves, wave + 2 * COUNT)
                up, down = speed * exponential(k * (z - depth)), speed * exponential(-(k * (z + depth)))
            else:
                up, down = read_vector(running, place + 2 * COUNT), read_vector(running, place + 3 * COUNT)
                up, down = raised(up, down, (share * k) * dz, squarings)
            s, c = read_vector(running, place), read_vector(running, place + COUNT)
            write_vector(running, place + 2 * COUNT, up)
            write_vector(running, place + 3 * COUNT, down)
            write_vector(parts, place, up * c)
            write_vector(parts, place + COUNT, up * s)
            write_vector(parts, place + 2 * COUNT, down * c)
            write_vector(parts, place + 3 * COUNT, down * s)
        put_sums(weights, parts, 0, groups, sea[j], UPPER)
        put_sums(weights, parts, 2, groups, sea[j], LOWER)
        sea[j, PLACE_X], sea[j, PLACE_Z] = x, z
    sea[n, TIME], sea[n, TAKEN] = t, 1.0


@kernel
def put_heights(p, t, X, sea):
    """Where the water of the nodes is taken, z or Wheeler's stretched height, into Work.sea."""
    n = X.shape[0]
    gain = smooth_start(t, p.ramp)[0]
    for j in range(n):
        height = larger(X[j, 1], 0.0)
        if p.above == WHEELER:
            eta = series(sea[j], SURFACE, t - sea[n, TIME], (0.0, X[j, 0] - sea[j, PLACE_X]))[0][0]
            height = height * stretching(p.depth, gain * eta)
        sea[j, HEIGHT] = height


@kernel
def due(p, t, X, sea):
    """Are the sums to be taken anew: for a new step, or because a node or the time is out of reach?"""
    n = X.shape[0]
    moved = 0.0
    for j in range(n):
        dx, dz = X[j, 0] - sea[j, PLACE_X], sea[j, HEIGHT] - sea[j, PLACE_Z]
        moved = larger(moved, dx * dx + dz * dz)
    near = 1.0 - abs(t - sea[n, TIME]) / p.sea_span
    return (sea[n, TAKEN] == 0.0) | (near < 0.0) | (moved > near * near * (p.sea_reach * p.sea_reach))


@kernel
def sea_in_plane(p, tables, t, X, F, J, sea):
    """Water velocity and local acceleration at the nodes in a plane, added into F. A lane takes its own sums, when it
    needs them.

    X (n, 2) x, z (m); F (n, 4), velocity (m/s), then its local rate (m/s2); J (n, 8): filled with dF/dx (4) and dF/dz
    (4), or None; sea (n + 1, WIDTH): of Work.
    """
    put_heights(p, t, X, sea)
    needed, taken = due(p, t, X, sea), False
    for b in range(lane_count(t)):
        if lane_of(needed, b):
            taken = True
            depth, ramp = lane_of(p.depth, b), lane_of(p.ramp, b)
            own, places, into = in_lane(tables, b), in_lane(X, b), in_lane(sea, b)
            few, region = (p.sea_few, p.sea_few_at), (lane_of(p.sea_wide, b), lane_of(p.sea_top, b))
            wheeler = p.above == WHEELER
            take_series(own, p.sea_at, p.sea_n, few, region, wheeler, depth, ramp, lane_of(t, b), places, into)
    if taken:
        put_heights(p, t, X, sea)
    _add_series(p, t, X, F, J, sea)
    if p.spherical_cap:
        put_surface(p, t, X[X.shape[0] - 1, 0], sea)


@kernel
def put_surface(p, t, x, sea):
    """The surface at the upper end, x (m): eta, eta_x, eta_xx, eta_t and eta_tx, into the last row of Work.sea."""
    last = sea.shape[0] - 1
    row, kept = sea[last - 1], sea[last]
    gain, gain_rate = smooth_start(t, p.ramp)
    dt, dx = t - kept[TIME], x - row[PLACE_X]
    eta, rate, slope, rising = series(row, SURFACE, dt, (0.0, dx))
    curve = 6.0 * dx * row[CUBE + 1] - 2.0 * (row[SQUARE] + dt * row[SQUARE + 3])
    kept[TOP_ETA], kept[TOP_ETA + 1], kept[TOP_ETA + 2] = gain * eta[0], -gain * slope[1], gain * curve
    kept[TOP_ETA + 3] = gain * rate[0] + gain_rate * eta[0]
    kept[TOP_ETA + 4] = -gain * rising[1] - gain_rate * slope[1]


@kernel
def surface_of_series(sea):
    """What `put_surface` has put there."""
    kept = sea[sea.shape[0] - 1]
    return kept[TOP_ETA], kept[TOP_ETA + 1], kept[TOP_ETA + 2], kept[TOP_ETA + 3], kept[TOP_ETA + 4]


@kernel
def wet_share(p, z):
    """1, or 0 above still water where the scene says so."""
    dry = 0.0 if p.above == ZERO else 1.0
    return where(z > p.depth, dry, 1.0)


@kernel
def _add_series(p, t, X, F, J, sea):
    """The field of full-grown waves, under their ramp, into F; its slopes into J."""
    n = X.shape[0]
    gain, gain_rate = smooth_start(t, p.ramp)
    dt = t - sea[n, TIME]
    for j in range(n):
        dx, dz = X[j, 0] - sea[j, PLACE_X], sea[j, HEIGHT] - sea[j, PLACE_Z]
        upper, upper_rate, upper_slope, upper_rising = series(sea[j], UPPER, dt, (dz, dx))
        lower, lower_rate, lower_slope, lower_rising = series(sea[j], LOWER, dt, (-dz, dx))
        wet = wet_share(p, X[j, 1])
        U, W = wet * (upper[0] + lower[0]), wet * (upper[1] - lower[1])
        F[j, 0] += gain * U
        F[j, 1] += gain * W
        F[j, 2] += gain * (wet * (upper_rate[0] + lower_rate[0])) + gain_rate * U
        F[j, 3] += gain * (wet * (upper_rate[1] - lower_rate[1])) + gain_rate * W
        if J is not None:
            full_x, full_z = -wet * (upper_slope[1] + lower_slope[1]), wet * (upper_slope[0] - lower_slope[0])
            U_x, U_z = gain * full_x, gain * full_z
            A_x = gain * (-wet * (upper_rising[1] + lower_rising[1])) + gain_rate * full_x
            A_z = gain * (wet * (upper_rising[0] - lower_rising[0])) + gain_rate * full_z
            by_x, by_z = 0.0, where(X[j, 1] > 0.0, 1.0, 0.0)
            if p.above == WHEELER:
                surface, _, slope, _ = series(sea[j], SURFACE, dt, (0.0, dx))
                stretch = stretching(p.depth, gain * surface[0])
                by_x = larger(X[j, 1], 0.0) * stretch * stretch / p.depth * (gain * slope[1])
                by_z = by_z * stretch
            put_slopes(J[j], by_x, by_z, (U_x, U_z), (A_x, A_z))
