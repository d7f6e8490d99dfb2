"""The part of a tension that material damping makes, c e_t, in what a run tells: samples, profiles, extremes, ringing.

The law itself acts in `node_quantities` (`engine.physics.extras`), with the rates of the stage. Output takes the rates
K at both ends of a step, (1 - share) K0 + share K1. A one-stage method has the share 1/2 all along a step, because its
rates alternate about the mean where nothing damps them.
"""

import math

import numpy as np

from ..compiled import by_kind, kernel, of_extras
from ..dimensions import conserved, last_strain
from ..physics.tension.kernels import tension
from ..planar.columns import EPS  # in space the same column
from ..record import TENSION
from ..simd.elementary import within


@of_extras(otherwise=0.0)
def damping_of(p):
    """c (N s) of the line."""
    return p.damping


@of_extras()
def add_damping(p, weights, share, begin, end, row):
    """Add c e_t to the tensions of row (n, 6), at the instant of a step that weights tell; begin, end: (C, K)."""
    if p.damping == 0.0:
        return
    (C0, K0), (C1, K1) = begin, end
    for k in range(C0.shape[0]):
        square = stretching = 0.0
        for i in range(C0.shape[1] // 2):
            q = within(weights, C0, C1, K0, K1, k, i)
            square += q * q
            stretching += q * ((1.0 - share) * K0[k, i] + share * K1[k, i])
        row[k, TENSION] += p.damping * stretching / math.sqrt(square)


@kernel
def _of_strain(p, tables, share, C, K0, K):
    return tension(last_strain(p, C), p, tables)[0]


@kernel
def _of_strain_and_rate(p, tables, share, C, K0, K):
    k, square, stretching = C.shape[0] - 1, 0.0, 0.0
    for i in range(C.shape[1] // 2):
        square += C[k, i] * C[k, i]
        stretching += C[k, i] * ((1.0 - share) * K0[k, i] + share * K[k, i])
    return tension(last_strain(p, C), p, tables)[0] + p.damping * stretching / math.sqrt(square)


# tension of the last node of a state C at the end of a step from the rates K0 to K
top_tension = by_kind(_of_strain, _of_strain, extra=_of_strain_and_rate)


@kernel
def extremes(values):
    """The least and the greatest of some numbers (n,): the methods of arrays take Numba longer to compile."""
    low = high = values[0]
    for i in range(1, values.shape[0]):
        low, high = min(low, values[i]), max(high, values[i])
    return low, high


@kernel
def _by_strains(p, tables, Ys, Ks):
    low, high = extremes(Ys[1:, Ys.shape[1] - 1, EPS])
    return tension(low, p, tables)[0], tension(high, p, tables)[0]


@kernel
def _by_stages(p, tables, Ys, Ks):
    if p.damping == 0.0:
        return _by_strains(p, tables, Ys, Ks)
    last, C = Ys.shape[1] - 1, np.empty((1, Ks.shape[2]))
    low, high = math.inf, -math.inf
    for i in range(1, Ys.shape[0]):
        conserved(p, Ys[i, last:], C)
        T = top_tension(p, tables, 1.0, C, Ks[i, last:], Ks[i, last:])
        low, high = min(low, T), max(high, T)
    return low, high


stage_tensions = by_kind(_by_strains, _by_strains, extra=_by_stages)  # least and greatest at the upper end in a step


@of_extras(otherwise=1.0)
def left_after(p, tables, strain, z, dt):
    """Share of a ringing that the damping of the line leaves after a step in which it turns by z = omega dt.

    exp(-zeta z), zeta = c omega/(2 T').
    """
    slope = max(tension(strain, p, tables)[1], 0.0)
    return math.exp(-0.5 * p.damping * z * z / max(slope * dt, 1e-300))
