"""Eigenvalues of the space-discretised line about an equilibrium, from the kernels that a time step uses.

The stage equation of every integrator is C = C~ + f(C)/c for the conserved variables C = (q, V) and a rate c; its
derivative with respect to C~ is R = c (c - A)^-1 with A = df/dC. The columns of R are Newton updates of the engine for
small changes of C~, so the eigenvalues of A follow from those of R as lambda = c (1 - 1/mu); mu = 0 belongs to what the
box equations do not see. R is taken by central differences, with an error of the square of `CHANGE`.
"""

import numpy as np

from engine.planar import elimination as sweep
from engine.planar import node
from engine.planar.elimination import sweep_bent
from engine.planar.elimination_unbent import sweep_unbent
from engine.planar.node import node_quantities, shape, water

CHANGE = 1e-5


def rates(motion, rate):
    """Eigenvalues lambda (1/s) of small motions about `motion.Y`, those with |lambda| < 1e3 rate, by size.

    rate : c (1/s), of the order of the eigenvalues wanted
    """
    Y, record, tables = motion.Y, motion.record, motion.tables
    n = Y.shape[0]
    X, F, Q = np.zeros((n, 2)), np.zeros((n, 4)), np.zeros((n, node.WIDTH))
    E, D = np.zeros((n, sweep.WIDTH)), np.zeros((n, 6))
    solve = sweep_bent if record["bent"] else sweep_unbent
    shape(record, tables, Y, Q, X)
    water(record, tables, 0.0, 1.0, X, F)
    c, s, lam = np.cos(Y[:, 4]), np.sin(Y[:, 4]), 1 + Y[:, 0]
    rest = np.column_stack([lam * c, lam * s, Y[:, 2], Y[:, 3]])

    def response(C_tilde):
        node_quantities(record, tables, rate, rate, 1.0, Y, C_tilde, F, Q)
        assert solve(record, tables, 0.0, rate, rate, 1.0, Y, C_tilde, X, F, Q, E, D)
        dq = D[:, 0], lam * D[:, 4]
        return np.column_stack([dq[0] * c - dq[1] * s, dq[0] * s + dq[1] * c, D[:, 2], D[:, 3]]).ravel()

    R = np.empty((4 * n, 4 * n))
    for j in range(4 * n):
        change = np.zeros(4 * n)
        change[j] = CHANGE
        change = change.reshape(n, 4)
        R[:, j] = (response(rest + change) - response(rest - change)) / (2 * CHANGE)
    mu = np.linalg.eigvals(R)
    found = rate * (1 - 1 / mu[np.abs(mu) > 1e-3])
    return found[np.argsort(np.abs(found))]


def frequencies(motion, rate):
    """Angular frequencies (rad/s) of the undamped modes, rising: imaginary parts of the eigenvalues above the axis."""
    found = rates(motion, rate)
    return np.sort(found.imag[found.imag > 1e-6 * rate])


def box(k, h):
    """What the box makes of a wave number k: differences over means of exp(iks) give i (2/h) tan(kh/2)."""
    return 2 / h * np.tan(0.5 * k * h)
