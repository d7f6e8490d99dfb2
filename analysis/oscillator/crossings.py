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

A piece begins with g = 0, and there the first test fails however short the interval. It leaves g = 0 to its own side,
and departs from the line to the value g_1 at a time w later by at most M (tau - start)(w - (tau - start))/2, so that

    g_1 on the side of the piece, farther from 0 than M w^2/2                     no second zero up to there

and where this fails (near grazing) the march begins at u/M with u = |g'| at the crossing: g keeps its sign for 2u/M.

The bracketed crossing is found by Newton's method started from the cubic that matches g and g' at both ends; a step out
of the bracket, which shrinks as it goes, is replaced by a bisection. It ends when the error left, M step^2/(2 u), is
below 1e-13.
"""

import math

from analysis.compiled import kernel
from analysis.oscillator.pieces import Piece, curvature_bound, motion

NONE = -1.0
_ROUNDING = 2e-15  # of the terms of g: below, g is rounding error
_TIME_ERROR = 2e-13


@kernel
def state_at(piece, tau):
    """g and g' at tau."""
    a, x, v, theta, k, p0, w0 = piece
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
def bracketed_root(piece, lo, hi, g_lo, v_lo, g_hi, v_hi, curvature):
    """The crossing between lo and hi, where g has opposite signs."""
    tau = lo + (hi - lo) * cubic_guess(g_lo, v_lo, g_hi, v_hi, hi - lo)
    for _ in range(80):
        g, slope = state_at(piece, tau)
        if (g > 0.0) == (g_lo > 0.0):
            lo = tau
        else:
            hi = tau
        step = -g / slope if slope != 0.0 else math.inf
        if curvature * step * step < _TIME_ERROR * abs(slope) or abs(step) < 1e-15 * hi:
            return min(max(tau + step, lo), hi)
        tau += step
        if not lo < tau < hi:
            tau = 0.5 * (lo + hi)
            if tau in (lo, hi):
                return tau
    return tau


@kernel
def search(piece, lo, g_lo, v_lo, end, g_end, v_end, curvature, floor):
    """The first crossing in (lo, end], or NONE; see the head of this file. `curvature` bounds |g''|.

    g_lo, v_lo: state at lo, on the side of the piece up to rounding; g_end, v_end: state at end.
    """
    side = 1.0 if piece.a == 1 else -1.0
    hi, g_hi, v_hi = end, g_end, v_end
    while True:
        bulge = 0.125 * curvature * (hi - lo) ** 2
        crossed = side * g_hi <= 0.0
        hidden = bulge <= floor or hi - lo < 1e-13 * end
        one_way = v_lo * v_hi > 0.0 and abs(v_lo) + abs(v_hi) > curvature * (hi - lo)
        if crossed and one_way and side * g_lo > 0.0:
            return bracketed_root(piece, lo, hi, g_lo, v_lo, g_hi, v_hi, curvature)
        if crossed and hidden:
            return hi
        if not crossed and (hidden or min(side * g_lo, side * g_hi) > bulge):
            width = 2.0 * (hi - lo)
            lo, g_lo, v_lo = hi, g_hi, v_hi
            if lo >= end:
                return NONE
        else:
            width = 0.5 * (hi - lo)
        hi = min(lo + width, end)
        g_hi, v_hi = state_at(piece, hi)


@kernel
def leave(piece, start, end, curvature, floor):
    """`search` after a crossing at `start` that is close to grazing."""
    _, slope = state_at(piece, start)
    clear = abs(slope) / curvature if curvature > 0.0 else math.inf
    lo = min(start + max(clear, 1e-12), end)
    if lo >= end:
        return NONE
    g_lo, v_lo = state_at(piece, lo)
    g_end, v_end = state_at(piece, end)
    return search(piece, lo, g_lo, v_lo, end, g_end, v_end, curvature, floor)


@kernel
def first_crossing(a, start, x, v, window, table):
    """The first crossing of the piece a of (x, v) after `start` and up to the end of the window, or NONE.

    start: 0, or the time of the crossing that began the piece, which itself is not found again.
    Nodes are visited in strides that double while they are clear and halve where they are not.
    """
    k, theta = table.constants, table.theta[window]
    p0, w0 = table.steady[window, a, 0], table.steady[window, a, 1]
    tau, last = table.tau, len(table.tau) - 1
    phi, q = table.phi[a], table.q[window, a]
    if a == 0 and x + max(v, 0.0) * phi[1, last] + table.reach[window] < 0.0:
        return NONE  # slack and too deep to come up within the window
    piece, curvature = Piece(a, x, v, theta, k, p0, w0), curvature_bound(a, x, v, k, p0, w0)
    floor = _ROUNDING * (abs(x) + abs(v) * tau[last] + table.size[window])
    side = 1.0 if a == 1 else -1.0
    j, g = 0, x
    if start > 0.0:
        j = min(int(start / tau[1]) + 1, last)
        g = phi[0, j] * x + phi[1, j] * v + q[0, j]
        if side * g <= 0.5 * curvature * (tau[j] - start) ** 2 and start < tau[j]:
            crossing = leave(piece, start, tau[j], curvature, floor)
            if crossing != NONE:
                return crossing
    bulge = 0.125 * curvature * tau[1] * tau[1]
    stride = 1 if start > 0.0 else 4
    while j < last:
        step = min(stride, last - j)
        i = j + step
        g_next = phi[0, i] * x + phi[1, i] * v + q[0, i]
        if min(side * g, side * g_next) > bulge * (step * step):
            stride = 2 * step
            j, g = i, g_next
        elif step > 1:
            stride = step // 2
        else:
            v_j = phi[2, j] * x + phi[3, j] * v + q[1, j]
            v_i = phi[2, i] * x + phi[3, i] * v + q[1, i]
            crossing = search(piece, tau[j], g, v_j, tau[i], g_next, v_i, curvature, floor)
            if crossing != NONE:
                return crossing
            j, g = i, g_next
    return NONE
