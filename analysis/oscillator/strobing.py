"""One forcing period of eq. (33), exactly: the stroboscopic map, its tangent, and both exponents along an orbit.

A motion is a sequence of pieces, taut and slack in turn (`pieces`). At a crossing the motion passes from one closed
form to the next: `hand_over` solves for the (x, v) with which the new piece passes through the state at the crossing.
Perturbations pass in the same way. The force a g is continuous at the switching line g = 0. The velocity field is
therefore the same on both sides of it, and the saltation matrix, I + (f_after - f_before) n'/(n'f_before), is the
identity: the tangent map has a kink in time and no jump. The tangent map is the product of the Phi of the pieces; its
determinant over a period is e^{-mu T}, whatever the path.

Exponents: two tangent vectors are carried along and re-orthonormalised every period by Gram-Schmidt (QR); the exponents
are the mean logarithms of the diagonal of R (Benettin, Galgani, Giorgilli & Strelcyn 1980).
"""

import math

import numpy as np

from analysis.compiled import kernel
from analysis.oscillator.crossings import NONE, first_crossing
from analysis.oscillator.pieces import LIFT, MU, OMEGA, TAUT_COS, TAUT_SIN, motion, piecewise

MOST_PIECES = 4096  # in one period; more are a fault, and the state becomes NaN
_LOGARITHM_EVERY = 8  # periods


@kernel
def side_of(x, v, theta, k):
    """1 where the tether is taut or is about to be, 0 where it is slack or is about to be.

    The sign of g = x decides; where g = 0, the sign of g' = v; where both are 0, the sign of g''.
    """
    if x != 0.0:
        return 1 if x > 0.0 else 0
    if v != 0.0:
        return 1 if v > 0.0 else 0
    # at rest g'' = F sin theta + lift; F follows from the linear response of the taut piece, X cos + Y sin
    forcing = k[TAUT_SIN] * (1.0 - k[OMEGA] ** 2) - k[TAUT_COS] * k[MU] * k[OMEGA]
    return 1 if forcing * math.sin(theta) + k[LIFT] >= 0.0 else 0


@kernel
def hand_over(a, tau, x, v, y, w, z, u, theta, k, steady):
    """(x, v) of the piece 1 - a that has the same state at tau as the piece a of (x, v); then its tangent vectors
    (y, w) and (z, u), for those of the piece a."""
    p11, p12, p21, p22, q1, q2 = motion(a, tau, theta, k, steady[a, 0], steady[a, 1])
    b = 1 - a
    r11, r12, r21, r22, s1, s2 = motion(b, tau, theta, k, steady[b, 0], steady[b, 1])
    det = 1.0 / (r11 * r22 - r12 * r21)
    g, h = p11 * x + p12 * v + q1 - s1, p21 * x + p22 * v + q2 - s2
    # The matrix inverse(Phi_b) Phi_a turns a tangent vector of the piece a into that of the piece b.
    m11, m12 = det * (r22 * p11 - r12 * p21), det * (r22 * p12 - r12 * p22)
    m21, m22 = det * (r11 * p21 - r21 * p11), det * (r11 * p22 - r21 * p12)
    x, v = det * (r22 * g - r12 * h), det * (r11 * h - r21 * g)
    return x, v, m11 * y + m12 * w, m21 * y + m22 * w, m11 * z + m12 * u, m21 * z + m22 * u


@kernel
def one_period(x, v, y, w, z, u, table, log):
    """State (x, v) and two tangent vectors (y, w), (z, u) one forcing period later.

    The tangent vectors are scalars, not an array, because a processor is slow where numbers are written one by one and
    read in pairs (measured: half the speed).
    log (MOST_PIECES, 5): receives a row for each piece: window, time in the window at which it begins, a, x, v.
    Returns x, v, y, w, z, u, the number of pieces (0: too many, the state is NaN), and the time for which the tether
    is slack.
    """
    last = len(table.tau) - 1
    end, k = table.tau[last], table.constants
    pieces, slack = 0, 0.0
    for window in range(len(table.steady)):
        theta = table.theta[window]
        a = side_of(x, v, theta, k)
        start = 0.0
        while True:
            if pieces == len(log):
                return math.nan, math.nan, y, w, z, u, 0, math.nan
            log[pieces, 0], log[pieces, 1], log[pieces, 2], log[pieces, 3], log[pieces, 4] = window, start, a, x, v
            pieces += 1
            crossing = first_crossing(a, start, x, v, window, table)
            if crossing == NONE:
                break
            if a == 0:
                slack += crossing - start
            x, v, y, w, z, u = hand_over(a, crossing, x, v, y, w, z, u, theta, k, table.steady[window])
            a, start = 1 - a, crossing
        if a == 0:
            slack += end - start
        phi, q = table.phi[a], table.q[window, a]
        p11, p12, p21, p22 = phi[0, last], phi[1, last], phi[2, last], phi[3, last]
        y, w = p11 * y + p12 * w, p21 * y + p22 * w
        z, u = p11 * z + p12 * u, p21 * z + p22 * u
        x, v = p11 * x + p12 * v + q[0, last], p21 * x + p22 * v + q[1, last]
    return x, v, y, w, z, u, pieces, slack


@kernel
def next_state(x, v, table, log):
    """The stroboscopic map: state one forcing period later, then number of pieces and slack time as of `one_period`."""
    x, v, _, _, _, _, pieces, slack = one_period(x, v, 1.0, 0.0, 0.0, 1.0, table, log)
    return x, v, pieces, slack


@kernel
def strobed_orbits(starts, transient, points, table):
    """The sections of starts (n, 2): (n, points, 2) states at times transient T, (transient + 1) T, ..."""
    log = np.empty((MOST_PIECES, 5))
    orbits = np.empty((len(starts), points, 2))
    for i in range(len(starts)):
        x, v = starts[i]
        for n in range(-transient, points):
            if n >= 0:
                orbits[i, n, 0], orbits[i, n, 1] = x, v
            if n < points - 1:
                x, v, _, _ = next_state(x, v, table, log)
    return orbits


@kernel
def tangent_map(x, v, table):
    """State and tangent matrix (2, 2) one forcing period later."""
    log = np.empty((MOST_PIECES, 5))
    x, v, y, w, z, u, _, _ = one_period(x, v, 1.0, 0.0, 0.0, 1.0, table, log)
    return x, v, np.array([[y, z], [w, u]])


@kernel
def growth_along(x, v, transient, blocks, length, table, orbit):
    """Growth of two tangent vectors along an orbit, in `blocks` blocks of `length` periods after the transient.

    orbit (m, 2): receives the first m strobed states after the transient.
    Returns the sums of the logarithms of the diagonal of R in each block (blocks, 2), the last x and v, and the time
    after the transient for which the tether is slack.
    """
    log = np.empty((MOST_PIECES, 5))
    sums = np.zeros((blocks, 2))
    slack_time = 0.0
    y, w, z, u = 1.0, 0.0, 0.0, 1.0
    product1, product2 = 1.0, 1.0
    # One logarithm is taken for several periods. Where damping is strong, each period has its own, because the product
    # of several would leave the range of the numbers.
    interval = _LOGARITHM_EVERY if table.constants[MU] * 2.0 * math.pi / table.constants[OMEGA] < 10.0 else 1
    for at in range(-transient, blocks * length):
        if 0 <= at < len(orbit):
            orbit[at, 0], orbit[at, 1] = x, v
        x, v, y, w, z, u, _, slack = one_period(x, v, y, w, z, u, table, log)
        r11 = math.sqrt(y * y + w * w)
        r22 = (y * u - w * z) / r11
        y, w = y / r11, w / r11
        z, u = -w, y
        if at < 0:
            continue
        slack_time += slack
        product1 *= r11
        product2 *= r22
        if (at + 1) % interval == 0 or (at + 1) % length == 0:
            sums[at // length, 0] += math.log(product1)
            sums[at // length, 1] += math.log(product2)
            product1, product2 = 1.0, 1.0
    return sums, x, v, slack_time


@kernel
def growth_over_values(parameters, starts, transient, blocks, length, recorded):
    """`growth_along` for every row (mu, omega, F, lift, phase) of parameters (p, 5), each from the same starts (n, 2).

    recorded: number of strobed states of each orbit that are returned.
    Returns sums (p, n, blocks, 2), section (p, n, recorded, 2), end (p, n, 2) and slack share (p, n).
    """
    p, n = len(parameters), len(starts)
    sums, section = np.empty((p, n, blocks, 2)), np.empty((p, n, recorded, 2))
    end, slack = np.empty((p, n, 2)), np.empty((p, n))
    for j in range(p):
        mu, omega, force, lift, phase = parameters[j]
        table = piecewise(mu, omega, force, lift, phase)
        for i in range(n):
            x, v = starts[i]
            sums[j, i], x, v, slack_time = growth_along(x, v, transient, blocks, length, table, section[j, i])
            end[j, i] = x, v
            slack[j, i] = slack_time / (blocks * length * (2.0 * math.pi / omega))
    return sums, section, end, slack
