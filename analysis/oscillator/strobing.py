"""One forcing period of eq. (33), exactly: the stroboscopic map, its tangent, and both exponents along an orbit.

The state at a crossing is handed from one closed form to the next by solving for the (x, v) with which the new piece
passes through it. Perturbations go the same way. a g is continuous at g = 0, so the velocity field is the same on both
sides of the switching line, and the saltation matrix, I + (f_after - f_before) n'/(n'f_before), is the identity: the
tangent map has a kink in time and no jump. It is the product of the Phi of the pieces; its determinant over a period is
e^{-mu T}, whatever the path.

Exponents: two tangent vectors are carried along and re-orthonormalised every period by Gram-Schmidt (QR); the exponents
are the mean logarithms of the diagonal of R (Benettin, Galgani, Giorgilli & Strelcyn 1980).
"""

import math

import numpy as np

from analysis.compiled import kernel
from analysis.oscillator.crossings import NONE, first_crossing
from analysis.oscillator.pieces import LIFT, OMEGA, TAUT_COS, TAUT_SIN, motion, piecewise

MOST_PIECES = 4096  # in one period; more than that is a fault, and the state becomes NaN
_LOGARITHM_EVERY = 8


@kernel
def side_of(x, v, theta, k):
    """1 where the tether is taut, or about to be: by g, on the switching line by g', and at rest there by g''."""
    if x != 0.0:
        return 1 if x > 0.0 else 0
    if v != 0.0:
        return 1 if v > 0.0 else 0
    # g'' = F sin + lift at rest; F from the linear response, F = X (1 - omega^2) - Y mu omega, avoided by its sign:
    forcing = k[TAUT_SIN] * (1.0 - k[OMEGA] ** 2) - k[TAUT_COS] * k[0] * k[OMEGA]
    return 1 if forcing * math.sin(theta) + k[LIFT] >= 0.0 else 0


@kernel
def hand_over(a, tau, x, v, d, theta, k, steady):
    """(x, v) of the piece 1 - a that meets the piece a of (x, v) at tau; the tangent vectors d are changed in place."""
    p11, p12, p21, p22, q1, q2 = motion(a, tau, theta, k, steady[a, 0], steady[a, 1])
    b = 1 - a
    r11, r12, r21, r22, s1, s2 = motion(b, tau, theta, k, steady[b, 0], steady[b, 1])
    g, u = p11 * x + p12 * v + q1 - s1, p21 * x + p22 * v + q2 - s2
    det = 1.0 / (r11 * r22 - r12 * r21)
    for column in range(2):
        y, w = d[0, column], d[1, column]
        dg, du = p11 * y + p12 * w, p21 * y + p22 * w
        d[0, column] = det * (r22 * dg - r12 * du)
        d[1, column] = det * (r11 * du - r21 * dg)
    return det * (r22 * g - r12 * u), det * (r11 * u - r21 * g)


@kernel
def one_period(x, v, d, table, log):
    """State one forcing period on; d (2, 2), the tangent vectors in its columns, is carried along in place.

    log (MOST_PIECES, 5): each piece as window, time in the window at which it begins, a, x, v.
    Returns g, g', the number of pieces (0: too many, the state is NaN), and the time spent slack.
    """
    last = len(table.tau) - 1
    end = table.tau[last]
    pieces, slack = 0, 0.0
    for window in range(len(table.steady)):
        theta = table.theta[window]
        a = side_of(x, v, theta, table.constants)
        start = 0.0
        while True:
            if pieces == len(log):
                return math.nan, math.nan, 0, math.nan
            log[pieces, 0], log[pieces, 1], log[pieces, 2], log[pieces, 3], log[pieces, 4] = window, start, a, x, v
            pieces += 1
            crossing = first_crossing(a, start, x, v, window, table)
            if crossing == NONE:
                break
            if a == 0:
                slack += crossing - start
            x, v = hand_over(a, crossing, x, v, d, theta, table.constants, table.steady[window])
            a, start = 1 - a, crossing
        if a == 0:
            slack += end - start
        phi = table.phi[a]
        p11, p12, p21, p22 = phi[0, last], phi[1, last], phi[2, last], phi[3, last]
        for column in range(2):
            y, w = d[0, column], d[1, column]
            d[0, column], d[1, column] = p11 * y + p12 * w, p21 * y + p22 * w
        q = table.q[window, a]
        x, v = p11 * x + p12 * v + q[0, last], p21 * x + p22 * v + q[1, last]
    return x, v, pieces, slack


@kernel
def orthonormalise(d):
    """Gram-Schmidt on the columns of d, in place; returns the diagonal of R."""
    r11 = math.sqrt(d[0, 0] * d[0, 0] + d[1, 0] * d[1, 0])
    r22 = (d[0, 0] * d[1, 1] - d[0, 1] * d[1, 0]) / r11
    e1, e2 = d[0, 0] / r11, d[1, 0] / r11
    d[0, 0], d[1, 0], d[0, 1], d[1, 1] = e1, e2, -e2, e1
    return r11, r22


@kernel
def strobed_orbit(x, v, transient, points, table):
    """The section: (points, 2) states at times transient T, (transient + 1) T, ..."""
    log, d = np.empty((MOST_PIECES, 5)), np.eye(2)
    orbit = np.empty((points, 2))
    for n in range(-transient, points):
        if n >= 0:
            orbit[n, 0], orbit[n, 1] = x, v
        if n < points - 1:
            d[0, 0], d[0, 1], d[1, 0], d[1, 1] = 1.0, 0.0, 0.0, 1.0
            x, v, _, _ = one_period(x, v, d, table, log)
    return orbit


@kernel
def tangent_map(x, v, periods, table):
    """State and tangent matrix (2, 2) after a number of periods."""
    log, d = np.empty((MOST_PIECES, 5)), np.eye(2)
    for _ in range(periods):
        x, v, _, _ = one_period(x, v, d, table, log)
    return x, v, d


@kernel
def growth_along(x, v, transient, blocks, length, table, orbit):
    """Sums of ln R over `blocks` blocks of `length` periods: (blocks, 2); then the end state, slack time and pieces.

    orbit (m, 2): filled with the first m strobed states after the transient.
    """
    log, d = np.empty((MOST_PIECES, 5)), np.eye(2)
    sums = np.zeros((blocks, 2))
    slack_time, pieces_seen = 0.0, 0
    for _ in range(transient):
        x, v, _, _ = one_period(x, v, d, table, log)
        orthonormalise(d)
    for block in range(blocks):
        product1, product2 = 1.0, 1.0
        for n in range(length):
            at = block * length + n
            if at < len(orbit):
                orbit[at, 0], orbit[at, 1] = x, v
            x, v, pieces, slack = one_period(x, v, d, table, log)
            slack_time += slack
            pieces_seen += pieces
            r11, r22 = orthonormalise(d)
            product1 *= r11
            product2 *= r22
            if (n + 1) % _LOGARITHM_EVERY == 0 or n == length - 1:
                sums[block, 0] += math.log(product1)
                sums[block, 1] += math.log(product2)
                product1, product2 = 1.0, 1.0
    return sums, x, v, slack_time, pieces_seen


@kernel
def growth_of_starts(starts, transient, blocks, length, kept, table):
    """`growth_along` from starts (n, 2): sums (n, blocks, 2), section (n, kept, 2), end (n, 2), slack share (n,)."""
    n = len(starts)
    sums, end = np.empty((n, blocks, 2)), np.empty((n, 2))
    section, slack = np.empty((n, kept, 2)), np.empty(n)
    period = 2.0 * math.pi / table.constants[OMEGA]
    for i in range(n):
        result = growth_along(starts[i, 0], starts[i, 1], transient, blocks, length, table, section[i])
        sums[i], end[i, 0], end[i, 1] = result[0], result[1], result[2]
        slack[i] = result[3] / (blocks * length * period)
    return sums, section, end, slack


@kernel
def growth_over_values(parameters, starts, transient, blocks, length, kept):
    """`growth_of_starts` for every row (mu, omega, F, lift, phase) of parameters (p, 5), each from the same starts."""
    p, n = len(parameters), len(starts)
    sums, section = np.empty((p, n, blocks, 2)), np.empty((p, n, kept, 2))
    end, slack = np.empty((p, n, 2)), np.empty((p, n))
    for i in range(p):
        mu, omega, force, lift, phase = parameters[i]
        table = piecewise(mu, omega, force, lift, phase)
        sums[i], section[i], end[i], slack[i] = growth_of_starts(starts, transient, blocks, length, kept, table)
    return sums, section, end, slack
