"""The first time at which a piece of eq. (33) crosses g = 0, and why none is missed.

Let |g''| <= M over the window (`pieces.curvature_bound`). Between two times w apart, g departs from the straight line
through its end values by at most M w^2/8. Hence

    both ends on the same side, and the nearer one farther from 0 than M w^2/8    no crossing in between, none at all
    ends on either side, and g' at one end, or at both with one sign, too large
    for M to turn it round within w                                               exactly one crossing: bracketed
    neither                                                                       halve w, the left half first

The march goes from left to right, so what it returns is the first crossing. It halves until M w^2/8 is below the
rounding of g itself (a few 1e-15 of its terms); an excursion past 0 that is still hidden then is less deep than this
rounding, lasts about 1e-7, and changes the motion by less than one rounding, because a g is continuous at 0.
A fixed-step method sees only the ends of its steps and misses double crossings (grazing) without a word.

The bracketed crossing is found by Newton's method started from the cubic that matches g and g' at both ends; a step out
of the bracket, which shrinks as it goes, is replaced by a bisection.
"""

import math

from analysis.compiled import kernel
from analysis.oscillator.pieces import curvature_bound, motion

NONE = -1.0
_ROUNDING = 2e-15


@kernel
def rounding_floor(x, v, size, span):
    """Below this, g of a piece is rounding error."""
    return _ROUNDING * (abs(x) + abs(v) * span + size)


@kernel
def state_at(a, tau, x, v, theta, k, p0, w0):
    """g and g' of the piece a of (x, v) at tau."""
    p11, p12, p21, p22, q1, q2 = motion(a, tau, theta, k, p0, w0)
    return p11 * x + p12 * v + q1, p21 * x + p22 * v + q2


@kernel
def cubic_guess(g0, v0, g1, v1, width):
    """Where the cubic with these end values and slopes is 0, as a share of the width; a start, nothing more."""
    c2 = 3.0 * (g1 - g0) - width * (2.0 * v0 + v1)
    c3 = 2.0 * (g0 - g1) + width * (v0 + v1)
    s = g0 / (g0 - g1)
    for _ in range(3):
        slope = width * v0 + s * (2.0 * c2 + 3.0 * s * c3)
        if slope == 0.0:
            break
        s -= (g0 + s * (width * v0 + s * (c2 + s * c3))) / slope
    return s if 0.0 < s < 1.0 else g0 / (g0 - g1)


@kernel
def bracketed_root(a, lo, hi, g_lo, v_lo, g_hi, v_hi, x, v, theta, k, p0, w0):
    """The crossing between lo and hi, where g has opposite signs."""
    tau = lo + (hi - lo) * cubic_guess(g_lo, v_lo, g_hi, v_hi, hi - lo)
    for _ in range(80):
        g, slope = state_at(a, tau, x, v, theta, k, p0, w0)
        if (g > 0.0) == (g_lo > 0.0):
            lo = tau
        else:
            hi = tau
        step = -g / slope if slope != 0.0 else math.inf
        if abs(step) < 1e-9:  # the step after this one would be 1e-18
            return min(max(tau + step, lo), hi)
        tau += step
        if not lo < tau < hi:
            tau = 0.5 * (lo + hi)
            if tau in (lo, hi):
                return tau
    return tau


@kernel
def search(a, lo, end, g_lo, v_lo, x, v, most, floor, theta, k, p0, w0):
    """The first crossing in (lo, end], or NONE; see the head of this file. `most` bounds |g''|.

    g_lo, v_lo: state at lo, on the side of a up to rounding.
    """
    side = 1.0 if a == 1 else -1.0
    width = end - lo
    while lo < end:
        hi = min(lo + width, end)
        g_hi, v_hi = state_at(a, hi, x, v, theta, k, p0, w0)
        bulge = 0.125 * most * (hi - lo) ** 2
        crossed = side * g_hi <= 0.0
        if not crossed and min(side * g_lo, side * g_hi) > bulge:
            lo, g_lo, v_lo = hi, g_hi, v_hi
            width *= 2.0
            continue
        one_way = v_lo * v_hi > 0.0 and abs(v_lo) + abs(v_hi) > most * (hi - lo)
        if crossed and one_way and side * g_lo > 0.0:
            return bracketed_root(a, lo, hi, g_lo, v_lo, g_hi, v_hi, x, v, theta, k, p0, w0)
        if bulge <= floor or hi - lo < 1e-13 * end:
            if crossed:
                return hi
            lo, g_lo, v_lo = hi, g_hi, v_hi
            width *= 2.0
            continue
        width = 0.5 * (hi - lo)
    return NONE


@kernel
def first_crossing(a, start, x, v, window, table):
    """The first crossing of the piece a of (x, v) after `start` and up to the end of the window, or NONE.

    start: 0, or the time of the crossing that began the piece, which itself is not found again: with |g'| = u there,
    g keeps its sign for at least 2u/M, and the search begins at u/M.
    """
    k, theta = table.constants, table.theta[window]
    p0, w0 = table.steady[window, a, 0], table.steady[window, a, 1]
    tau, last = table.tau, len(table.tau) - 1
    reach = x + max(v, 0.0) * table.phi[0, 1, last] + table.reach[window]
    if a == 0 and reach < 0.0:
        return NONE  # slack and too deep to come up within the window
    most = curvature_bound(a, x, v, k, p0, w0)
    floor = rounding_floor(x, v, table.size[window], tau[last])
    side = 1.0 if a == 1 else -1.0
    j = 0
    g = x + table.q[window, a, 0, 0]
    if start > 0.0:
        _, slope = state_at(a, start, x, v, theta, k, p0, w0)
        lo = min(start + max(abs(slope) / most if most > 0.0 else math.inf, 1e-12), tau[last])
        j = min(math.ceil(lo / tau[1]), last)
        if lo < tau[j]:
            g_lo, v_lo = state_at(a, lo, x, v, theta, k, p0, w0)
            found = search(a, lo, tau[j], g_lo, v_lo, x, v, most, floor, theta, k, p0, w0)
            if found != NONE:
                return found
        g = table.phi[a, 0, j] * x + table.phi[a, 1, j] * v + table.q[window, a, 0, j]
    bulge = 0.125 * most * tau[1] * tau[1]
    p11, p12, q1 = table.phi[a, 0], table.phi[a, 1], table.q[window, a, 0]
    while j < last:
        g_next = p11[j + 1] * x + p12[j + 1] * v + q1[j + 1]
        if min(side * g, side * g_next) <= bulge:
            v_j = table.phi[a, 2, j] * x + table.phi[a, 3, j] * v + table.q[window, a, 1, j]
            found = search(a, tau[j], tau[j + 1], g, v_j, x, v, most, floor, theta, k, p0, w0)
            if found != NONE:
                return found
        g = g_next
        j += 1
    return NONE
