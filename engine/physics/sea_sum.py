"""The waves of a sea (`engine.physics.sea`), summed at the nodes in space, and its surface.

The waves lie side by side, COUNT in a vector. From node to node their exponentials and angles follow by the recurrence
of `engine.physics.waves`; for waves that are short beside an element its polynomials take a half, a quarter ... of the
step, and their results are squared as often. Waves for which this would lose digits are computed anew at every node.

The sum is the whole cost of a sea, and a stage needs it once. Newton's method takes it anew only where a node has moved
so far, `sea_reach` of the record, that the velocity of the water changes by STILL times the tolerance of the method.
With the water held it converges no slower, because its matrix holds the water as well; what it leaves over is as large
as what the tolerance leaves over (some 1e-4 m in a period of the shipped buoy).
"""

import numpy as np

from ..compiled import kernel
from ..record import WHEELER, ZERO
from ..simd.access import lane_of, power_of_two, read_vector, total, vector_at, write_vector
from ..simd.elementary import PIO2_A, PIO2_B, PIO2_C, TWO_OVER_PI, sincos, smooth_start
from ..simd.select import larger, smaller
from ..simd.vector import COUNT
from .sea import AMPLITUDE, COSINE, OMEGA, PHASE, ROW, SINE, SPEED, K
from .waves import SMALL

SUMS, PLACES = 0, 6  # columns of Work.sea in space: sums of the waves at the nodes, and the places they were taken at
TIME, TAKEN = 0, 1  # of the last row of sums: for which time, and 1.0 where they are taken
WIDTH = 9
STEEP, DEEP = 2.0, 600.0  # k times an element, k times the depth: beyond, waves are computed anew at every node
STILL = 3.0  # change of the water's velocity, over the tolerance of Newton's method, that is left out
LN2_A = float.fromhex("0x1.62e42fefa0000p-1")  # ln 2 in two parts; products of the first with whole numbers are exact
LN2_B = 1.6465949582897082e-12


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
def waves_of(tables, at, group):
    """The rows of a group of waves (`engine.physics.sea`), a vector each."""
    first = at + ROW * COUNT * group
    return (
        vector_at(tables, first + COUNT * K), vector_at(tables, first + COUNT * OMEGA),
        vector_at(tables, first + COUNT * PHASE), vector_at(tables, first + COUNT * COSINE),
        vector_at(tables, first + COUNT * SINE), vector_at(tables, first + COUNT * SPEED),
        vector_at(tables, first + COUNT * AMPLITUDE),
    )  # fmt: skip


@kernel
def surface_of_sea(tables, at, groups, ramp, t, x, y):
    """The surface of a sea at x, y (m): eta; its slopes by x, y; second derivatives by xx, xy, yy; eta_t, and the
    slopes of it by x, y. ramp (s): of the waves."""
    eta = eta_x = eta_y = eta_xx = eta_xy = eta_yy = rate = rate_x = rate_y = 0.0 * vector_at(tables, at)
    for group in range(groups):
        k, omega, phase, cosine, sine, _, high = waves_of(tables, at, group)
        kx, ky = k * cosine, k * sine
        s, c = sincos(kx * x + (ky * y + phase_at(omega, phase, t)))
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
    gain, gain_rate = smooth_start(t, ramp)
    height, slope_x, slope_y = total(eta), total(eta_x), total(eta_y)
    return (
        gain * height, gain * slope_x, gain * slope_y, gain * total(eta_xx), gain * total(eta_xy), gain * total(eta_yy),
        gain * total(rate) + gain_rate * height,
        gain * total(rate_x) + gain_rate * slope_x, gain * total(rate_y) + gain_rate * slope_y,
    )  # fmt: skip


@kernel
def heights(p, tables, t, X, Z):
    """Heights (m) at which the field is taken for the places X (n, 3), into Z (n,)."""
    for j in range(X.shape[0]):
        Z[j] = max(X[j, 2], 0.0)
        if p.above == WHEELER:
            eta = surface_of_sea(tables, p.sea_at, p.sea_n, p.ramp, t, X[j, 0], X[j, 1])[0]
            Z[j] *= stretching(p.depth, eta)


@kernel
def stretching(depth, eta):
    """Wheeler's factor of heights. A trough of the whole sea below the bed has no meaning; rules of the scene keep the
    usual ones above it."""
    return depth / larger(depth + eta, 1e-3 * depth)


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
def field_sums(tables, at, groups, depth, t, X, Z, sums):
    """Sums over the waves, full-grown, at places X (n, 3) with heights Z (n,), into sums (n, .): U, V, W and their
    rates."""
    n, width = X.shape[0], 6
    step = 1.4142135623730951 * longest_step(X, Z)
    room = np.zeros(n * width * COUNT)
    for group in range(groups):
        k, omega, phase, cosine, sine, speed, _ = waves_of(tables, at, group)
        begun = phase_at(omega, phase, t)
        anew, squarings, share = division_of(lane_of(k, COUNT - 1), step, depth)
        k_step = share * k
        up, down, s, c = speed, speed, speed, speed
        for j in range(n - 1, -1, -1):
            if anew or j == n - 1:
                s, c = sincos(k * (cosine * X[j, 0] + sine * X[j, 1]) + begun)
                up, down = speed * exponential(k * (Z[j] - depth)), speed * exponential(-(k * (Z[j] + depth)))
            else:
                dx = (k_step * cosine) * (X[j, 0] - X[j + 1, 0]) + (k_step * sine) * (X[j, 1] - X[j + 1, 1])
                s, c = turned(s, c, dx, squarings)
                up, down = raised(up, down, k_step * (Z[j] - Z[j + 1]), squarings)
            cosh_part, sinh_part = up + down, up - down
            uc, us, ws, wc = cosh_part * c, cosh_part * s, sinh_part * s, sinh_part * c
            place = j * width * COUNT
            _add(room, place, cosine, uc)
            _add(room, place + COUNT, sine, uc)
            _add(room, place + 2 * COUNT, 1.0, ws)
            us = omega * us
            _add(room, place + 3 * COUNT, cosine, us)
            _add(room, place + 4 * COUNT, sine, us)
            _add(room, place + 5 * COUNT, -omega, wc)
    for j in range(n):
        for m in range(width):
            sums[j, m] = total(read_vector(room, (j * width + m) * COUNT))


@kernel
def division_of(shortest, step, depth):
    """How a group of waves goes on by a step (m): whether it is computed anew instead, how often the step is halved,
    and the share of it that is left. shortest: k of its shortest wave."""
    anew = shortest * step > STEEP or shortest * depth > DEEP
    squarings, share = 0, 1.0
    while share * shortest * step > SMALL and not anew:
        squarings, share = squarings + 1, 0.5 * share
    return anew, squarings, share


@kernel
def turned(s, c, angle, squarings):
    """Sine and cosine after a turn by 2^squarings times an angle."""
    ds, dc = angles(angle)
    for _ in range(squarings):
        ds, dc = 2.0 * (ds * dc), 1.0 - 2.0 * ds * ds
    return s * dc + c * ds, c * dc - s * ds


@kernel
def raised(up, down, rise, squarings):
    """up and down times exp and 1/exp of 2^squarings times a rise."""
    e1, e2 = exponentials(rise)
    for _ in range(squarings):
        e1, e2 = e1 * e1, e2 * e2
    return up * e1, down * e2


@kernel
def _add(room, place, weight, term):
    write_vector(room, place, read_vector(room, place) + weight * term)


@kernel
def sea_field(p, tables, t, X, F, sea):
    """Water velocity and local acceleration at the nodes in space, added into F.

    X (n, 3) x, y, z (m); F (n, 6), velocity (m/s), then its local rate (m/s2); sea (n + 1, WIDTH): of Work.
    """
    n = X.shape[0]
    if due(p, t, X, sea):
        Z = np.empty(n)
        heights(p, tables, t, X, Z)
        field_sums(tables, p.sea_at, p.sea_n, p.depth, t, X, Z, sea)
        for j in range(n):
            for axis in range(3):
                sea[j, PLACES + axis] = X[j, axis]
        sea[n, TIME], sea[n, TAKEN] = t, 1.0
    gain, gain_rate = smooth_start(t, p.ramp)
    for j in range(n):
        wet = 0.0 if p.above == ZERO and X[j, 2] > p.depth else 1.0
        for i in range(3):
            speed, rate = wet * sea[j, i], wet * sea[j, 3 + i]
            F[j, i] += gain * speed
            F[j, 3 + i] += gain * rate + gain_rate * speed


@kernel
def due(p, t, X, sea):
    """Is the sum to be taken anew: at another time, or because a node has moved by more than `sea_reach`?"""
    n = X.shape[0]
    moved = 0.0
    for j in range(n):
        square = 0.0
        for axis in range(3):
            way = X[j, axis] - sea[j, PLACES + axis]
            square += way * way
        moved = larger(moved, square)
    return (sea[n, TIME] != t) | (sea[n, TAKEN] == 0.0) | (moved > p.sea_reach * p.sea_reach)
