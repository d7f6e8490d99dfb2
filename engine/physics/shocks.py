"""Internal viscosity that is confined to shocks, for tension laws under which waves steepen.

    T = f(eps) + a m [c_q h^2 |e_t| e_t + c_l c h e_t],   e_t = d eps/dt,   c = sqrt(max(f', 0)/m)

after von Neumann & Richtmyer (1950) and Landshoff (1955), h the spacing of the nodes. The limiter (Christensen 1990)

    a = 1 - max(0, min((r_l + r_r)/2, 2 r_l, 2 r_r, 1)),   r = e_t of a neighbour over e_t here

is zero where e_t varies smoothly, so that order two remains away from shocks. It acts on stretching and on shortening:
laws that are concave steepen when they unload. Within Newton's method it would chatter; a and c are taken from the
step before. Linear and quadratic coefficients (c_l, c_q) = (0.2, 1) are usual.

The limiter looks at means (1, 2, 1)/4, which do not have the node-to-node ripple of the box rule. Of a node and two
neighbours on either side the largest a is taken: where a shock lets a node go, an a that falls from one step to the
next leaves noise of a thousandth of the jump (one neighbour: half of it stays; four: the shock is twice as wide).

The box rule with a step of one element per wave hardly disperses; with much shorter steps the same viscosity lets the
strain ahead of a shock overshoot by a tenth of the jump. On a graded grid the step therefore follows the deformation:
with `solver.courant` it is that number times the shortest element that deforms over the fastest wave
(docs/results.md#the-breaking-line).
"""

import math

import numpy as np

from ..compiled import kernel
from ..planar import columns as planar
from ..spatial import columns as spatial
from .tension.kernels import tension

DEFORMING = 0.01  # of the largest strain rate


@kernel
def shock_tension(rate, stretched, B, L):
    """Viscous tension (N) and its derivative by eps, for e_t = rate * stretched."""
    e_t = rate * stretched
    return (B * abs(e_t) + L) * e_t, (2.0 * B * abs(e_t) + L) * rate


@kernel
def _mean(e_t, k):
    """e_t about node k without the mode that changes sign from node to node; at an end the mean of its element."""
    n = e_t.shape[0]
    if k == 0:
        return 0.5 * (e_t[0] + e_t[1])
    if k == n - 1:
        return 0.5 * (e_t[n - 2] + e_t[n - 1])
    return 0.25 * (e_t[k - 1] + 2.0 * e_t[k] + e_t[k + 1])


@kernel
def _limiter(e_t, k):
    """a of node k alone."""
    n = e_t.shape[0]
    rate = _mean(e_t, k)
    if rate == 0.0:
        return 0.0
    below, above = _mean(e_t, max(k - 1, 1)) / rate, _mean(e_t, min(k + 1, n - 2)) / rate
    return 1.0 - max(0.0, min(0.5 * (below + above), 2.0 * below, 2.0 * above, 1.0))


@kernel
def renew_viscosity(p, tables, half, C, K, e_t, Q):
    """B and L of every node, into their columns of Q, from an accepted state C and its rates K.

    half: the share of the columns of C that is q;  e_t (n,): work.
    """
    n = C.shape[0]
    at = planar.SHOCK_B if half == 2 else spatial.SHOCK_B
    for k in range(n):
        square = product = 0.0
        for i in range(half):
            square += C[k, i] * C[k, i]
            product += C[k, i] * K[k, i]
        length = math.sqrt(square)
        e_t[k] = product / length
        Q[k, at + 1] = math.sqrt(max(tension(length - 1.0, p, tables)[1], 0.0) / p.m)
        Q[k, at] = 0.0
    for k in range(n):
        a = _limiter(e_t, k)
        for j in range(max(k - 2, 0), min(k + 3, n)):
            Q[j, at] = max(Q[j, at], a)
    for k in range(n):
        h = 0.0
        if k > 0:
            h += tables[p.grid_at + k - 1]
        if k < n - 1:
            h += tables[p.grid_at + k]
        h *= 0.5 if 0 < k < n - 1 else 1.0
        a = p.m * h * Q[k, at]
        Q[k, at] = a * h * p.c_quadratic
        Q[k, at + 1] *= a * p.c_linear


@kernel
def deforming_element(p, tables, e_t):
    """Length (m) of the shortest element with a node where |e_t| is at least DEFORMING times the largest."""
    n = e_t.shape[0]
    least = 0.0
    for k in range(n):
        least = max(least, DEFORMING * abs(e_t[k]))
    shortest = np.inf
    for k in range(1, n):
        if max(abs(e_t[k]), abs(e_t[k - 1])) >= least:
            shortest = min(shortest, tables[p.grid_at + k - 1])
    return shortest
