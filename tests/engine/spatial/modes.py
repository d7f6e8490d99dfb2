"""Eigenvalues of the space-discretised line in space about an equilibrium: as `tests.engine.modes` in the plane.

R = c (c - A)^-1 is the derivative of the stage equation with respect to C~ = (q~, V~); its columns are Newton updates
of the engine for small changes of C~, turned into changes of (q, V): dq = deps t + (1+eps)(theta3 n - theta2 b).
"""

import numpy as np

from engine.spatial import node
from engine.spatial.elimination import sweep
from engine.spatial.elimination_unbent import sweep_unbent
from engine.spatial.rows import WIDTH
from tests.engine.modes import CHANGE


def rates(motion, rate):
    """Eigenvalues lambda (1/s) of small motions about `motion.Y`, those with |lambda| < 1e3 rate, by size."""
    Y, record, tables = motion.Y, motion.record, motion.tables
    n = len(Y)
    X, F, Q = np.zeros((n, 3)), np.zeros((n, 6)), np.zeros((n, node.WIDTH))
    E, D = np.zeros((n, WIDTH)), np.zeros((n, 12))
    solve = sweep if record["bent"] else sweep_unbent
    node.shape(record, tables, Y, Q, X)
    node.water(record, tables, 0.0, 1.0, X, F)
    lam, t, normal, b = Q[:, 4:5].copy(), Q[:, 0:3].copy(), Q[:, 14:17].copy(), Q[:, 17:20].copy()
    rest = np.concatenate([lam * t, Y[:, 3:6]], 1)

    def response(C_tilde):
        node.node_quantities(record, tables, rate, rate, 1.0, Y, C_tilde, F, Q)
        assert solve(record, tables, 0.0, rate, rate, 1.0, Y, C_tilde, X, F, Q, E, D)
        dq = D[:, :1] * t + lam * (D[:, 8:9] * normal - D[:, 7:8] * b)
        return np.concatenate([dq, D[:, 3:6]], 1).ravel()

    R = np.empty((6 * n, 6 * n))
    for j in range(6 * n):
        change = np.zeros(6 * n)
        change[j] = CHANGE
        change = change.reshape(n, 6)
        R[:, j] = (response(rest + change) - response(rest - change)) / (2 * CHANGE)
    mu = np.linalg.eigvals(R)
    found = rate * (1 - 1 / mu[np.abs(mu) > 1e-3])
    return found[np.argsort(np.abs(found))]


def frequencies(motion, rate):
    """Angular frequencies (rad/s) of the undamped modes, rising; those of a line in rest across each of two planes
    come twice."""
    found = rates(motion, rate)
    return np.sort(found.imag[found.imag > 1e-6 * rate])
