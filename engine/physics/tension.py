"""Tension laws T = f(eps), eq. (20): linear, tanh and tabulated.

A tabulated law is the monotone cubic (Fritsch & Carlson 1980, PCHIP) through its points, so that f' is continuous and
Newton does not chatter at a kink; outside the table it goes on along the end tangents.
The printed tanh law has almost no stiffness in compression: where the scene gives a barrier P_b, T loses
P_b (0.5/lambda - 1)^2 below lambda = 1 + eps = 0.5, smooth there, without bound as lambda -> 0.
`stored` is its integral.
Table layout in `tables`, n knots: [knots (n) | c0 c1 c2 c3 of each of the n - 1 pieces | slope below | slope above].

f' is T' of eq. (29).

In the paper: eq. (20) tension law; eq. (29) slope of the tension law.
"""

import math

import numpy as np

from ..compiled import by_kind, kernel
from ..simd.select import larger, some, where

LINEAR, TANH, TABULATED = 0, 1, 2


def table_of(strain, tension):
    """Polynomial pieces of the tabulated law, in the layout above.

    Parameters
    ----------
    strain : (n,) increasing, dimensionless
    tension : (n,) N
    """
    from scipy.interpolate import PchipInterpolator

    strain = np.asarray(strain, float)
    law = PchipInterpolator(strain, np.asarray(tension, float))
    pieces = law.c[::-1].T.ravel()  # ascending powers, piece by piece
    slopes = law.derivative()(strain[[0, -1]])
    return np.concatenate([strain, pieces, slopes])


@kernel
def _tabulated(eps, tables, at, n):
    last = at + n - 1
    if eps <= tables[at]:
        slope = tables[last + 1 + 4 * (n - 1)]
        return tables[last + 1] + slope * (eps - tables[at]), slope
    if eps >= tables[last]:
        slope = tables[last + 2 + 4 * (n - 1)]
        piece = last + 1 + 4 * (n - 2)
        d = tables[last] - tables[last - 1]
        top = tables[piece] + d * (tables[piece + 1] + d * (tables[piece + 2] + d * tables[piece + 3]))
        return top + slope * (eps - tables[last]), slope
    low, high = at, last
    while high - low > 1:
        mid = (low + high) // 2
        if tables[mid] <= eps:
            low = mid
        else:
            high = mid
    piece = last + 1 + 4 * (low - at)
    d = eps - tables[low]
    value = tables[piece] + d * (tables[piece + 1] + d * (tables[piece + 2] + d * tables[piece + 3]))
    slope = tables[piece + 1] + d * (2.0 * tables[piece + 2] + d * 3.0 * tables[piece + 3])
    return value, slope


@kernel
def _by_table(p, tables, eps):
    return _tabulated(eps, tables, p.law_at, p.law_n)


@kernel
def _no_table(p, tables, eps):
    """In the place of a table where runs share a batch: those with one do not (`engine.simd.machine`)."""
    return eps, eps


tabulated = by_kind(_by_table, _by_table, _no_table)


@kernel
def tension(eps, p, tables):
    """Tension and its derivative at one strain.

    Parameters
    ----------
    eps : float, strain
    p : parameter record (law, p1 ... p5 or table position)
    tables : flat array of all tables of the batch

    Returns
    -------
    T : float, N
    slope : float, N, dT/deps
    """
    T, slope = law_tension(eps, p, tables)
    braced = (eps < -0.5) & (p.barrier > 0.0)
    if some(braced):
        lam = larger(1.0 + eps, 1e-300)
        excess = 0.5 / lam - 1.0
        T = where(braced, T - p.barrier * excess * excess, T)
        slope = where(braced, slope + p.barrier * excess / (lam * lam), slope)
    return T, slope


@kernel
def law_tension(eps, p, tables):
    """`tension` without the barrier."""
    if p.law == LINEAR:
        return p.p1 * eps, p.p1
    if p.law == TANH:
        th = math.tanh(p.p2 * eps + p.p3)
        return p.p1 * th + p.p4 + p.p5 * eps, p.p1 * p.p2 * (1.0 - th * th) + p.p5
    return tabulated(p, tables, eps)


@kernel
def _tabulated_energy(eps, tables, at, n):
    """Integral of the tabulated law from its first knot to eps."""
    last = at + n - 1
    total = 0.0
    if eps <= tables[at]:
        d = eps - tables[at]
        return d * (tables[last + 1] + 0.5 * d * tables[last + 1 + 4 * (n - 1)])
    for i in range(n - 1):
        piece = last + 1 + 4 * i
        d = min(eps, tables[at + i + 1]) - tables[at + i]
        if d <= 0.0:
            return total
        c2, c3 = tables[piece + 2] / 3.0, tables[piece + 3] / 4.0
        total += d * (tables[piece] + d * (0.5 * tables[piece + 1] + d * (c2 + d * c3)))
    d = max(eps - tables[last], 0.0)
    return total + d * (_tabulated(tables[last], tables, at, n)[0] + 0.5 * d * tables[last + 2 + 4 * (n - 1)])


@kernel
def stored(eps, p, tables):
    """Integral of the tension law from no strain to eps, J per metre of unstretched line."""
    barrier = 0.0
    if p.barrier > 0.0 and eps < -0.5:
        lam = max(1.0 + eps, 1e-300)
        barrier = p.barrier * (0.25 / lam + math.log(2.0 * lam) - lam)  # 0 at 0.5
    if p.law == LINEAR:
        return barrier + 0.5 * p.p1 * eps * eps
    if p.law == TANH:
        # ln cosh x = |x| - ln 2 + ln(1 + exp(-2 |x|)) does not overflow
        x, x0 = abs(p.p2 * eps + p.p3), abs(p.p3)
        rise = x - x0 + math.log1p(math.exp(-2.0 * x)) - math.log1p(math.exp(-2.0 * x0))
        return barrier + p.p1 / p.p2 * rise + p.p4 * eps + 0.5 * p.p5 * eps * eps
    at_rest = _tabulated_energy(0.0, tables, p.law_at, p.law_n)
    return barrier + _tabulated_energy(eps, tables, p.law_at, p.law_n) - at_rest
