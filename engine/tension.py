"""Tension laws T = f(eps), eq. (20): linear, tanh and tabulated.

A tabulated law is the monotone cubic (Fritsch & Carlson 1980, PCHIP) through its points, so that f' is continuous and
Newton does not chatter at a kink; outside the table it goes on along the end tangents.
The printed tanh law has almost no stiffness in compression: where the scene gives a barrier P_b, T loses
P_b (0.5/lambda - 1)^2 below lambda = 1 + eps = 0.5, smooth there, without bound as lambda -> 0.
Table layout in `tables`, n knots: [knots (n) | c0 c1 c2 c3 of each of the n - 1 pieces | slope below | slope above].
"""

import math

import numpy as np

from .choose import larger, some, where
from .compiled import by_kind, kernel

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
    """In the place of a table where runs share a batch: those with one do not (`engine.lanes.machine`)."""
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
