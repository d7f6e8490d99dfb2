"""The planar state: Y (n, 6) = (eps, S, U, W, phi, kappa), conserved C (n, 4) = (q_x, q_z, U, W) with q = (1+eps) t.

What the shared parts of the engine - Newton's method, steps, march, output - must know of it (`engine.dimensions`).
"""

import math

import numpy as np

from ..compiled import kernel
from ..physics.tension import tension
from ..simd.select import finite, larger, smaller, where
from . import elimination as sweep
from . import node
from .elimination import sweep_bent
from .elimination_unbent import sweep_unbent


@kernel
def size_of(p):
    """Unknowns and conserved variables of a node."""
    return 6, 4


@kernel
def work_arrays(p, n):
    """Work arrays of `engine.time.newton` for n nodes: X, F, Q, E, D, and the integrator's C~."""
    X, F, Q = np.zeros((n, 2)), np.zeros((n, 4)), np.zeros((n, node.WIDTH))
    return X, F, Q, np.zeros((n, sweep.WIDTH)), np.zeros((n, 6)), np.zeros((n, 4))


@kernel
def assemble(p, tables, t, in_motion, cq, cv, Y, C_tilde, X, F, Q, E, D):
    """One Newton update into D; returns False where a pivot block is singular. Arguments as for `time.newton`."""
    node.shape(p, tables, Y, Q, X)
    node.water(p, tables, t, in_motion, X, F)
    node.node_quantities(p, tables, cq, cv, in_motion, Y, C_tilde, F, Q)
    if p.bent:
        return sweep_bent(p, tables, t, cq, cv, in_motion, Y, C_tilde, X, F, Q, E, D)
    return sweep_unbent(p, tables, t, cq, cv, in_motion, Y, C_tilde, X, F, Q, E, D)


@kernel
def update_size(p, D):
    """Largest entry of a Newton update in the scales of the scene (dimensionless)."""
    size = total = 0.0
    for k in range(D.shape[0]):
        stretched = larger(abs(D[k, 0]) * p.per_strain, abs(D[k, 1]) * p.per_force)
        moved = larger(abs(D[k, 2]), abs(D[k, 3])) * p.per_speed
        turned = larger(abs(D[k, 4]), abs(D[k, 5]) * p.per_curvature)
        size = larger(size, larger(larger(stretched, moved), turned))
        total += ((D[k, 0] + D[k, 1]) + (D[k, 2] + D[k, 3])) + (D[k, 4] + D[k, 5])
    return where(finite(total), size, np.inf)


@kernel
def add_update(p, factor, D, Y):
    """Y += factor D; returns the least strain."""
    least = np.inf
    for k in range(Y.shape[0]):
        for i in range(6):
            Y[k, i] += factor * D[k, i]
        least = smaller(least, Y[k, 0])
    return least


@kernel
def tidy(p, Y):
    """After an extrapolation: nothing to restore in the plane."""


@kernel
def conserved(p, Y, C):
    """C (n, 4) of a state Y (n, 6)."""
    for k in range(Y.shape[0]):
        lam = 1.0 + Y[k, 0]
        C[k, 0] = lam * math.cos(Y[k, 4])
        C[k, 1] = lam * math.sin(Y[k, 4])
        C[k, 2] = Y[k, 2]
        C[k, 3] = Y[k, 3]


@kernel
def extrapolate(p, alpha_f, Y, C_new, Y_new):
    """From the stage of a one-stage step to its end: Y_new comes in as the stage; eps and t are taken from C_new."""
    for k in range(Y.shape[0]):
        # not the shear force: nothing ties it to its past, and errors of it would alternate for ever
        for i in range(2, 6):
            Y_new[k, i] = Y[k, i] + (Y_new[k, i] - Y[k, i]) / alpha_f
        turn = math.atan2(C_new[k, 1], C_new[k, 0]) - Y_new[k, 4]
        Y_new[k, 4] += turn - 2.0 * math.pi * np.rint(turn / (2.0 * math.pi))
        Y_new[k, 0] = math.sqrt(C_new[k, 0] ** 2 + C_new[k, 1] ** 2) - 1.0


@kernel
def error_square(p, k, ec, Q):
    """Squared error of node k in scene scales, from the errors `ec` (4,) of its conserved variables."""
    axial = (ec[0] * Q[k, 0] + ec[1] * Q[k, 1]) * p.per_strain
    turned = ec[1] * Q[k, 0] - ec[0] * Q[k, 1]
    speed = (ec[2] * ec[2] + ec[3] * ec[3]) * p.per_speed * p.per_speed
    return axial * axial + turned * turned + speed


@kernel
def largest_turn(p, Y):
    """Largest |phi_k - phi_(k-1)| (rad) and the upper node of its element."""
    turn, element = 0.0, 0
    for k in range(1, Y.shape[0]):
        d = abs(Y[k, 4] - Y[k - 1, 4])
        if d > turn:
            turn, element = d, k
    return turn, element


@kernel
def greatest_turn(Y):
    """Largest |phi_k - phi_(k-1)| (rad) alone."""
    turn = 0.0
    for k in range(1, Y.shape[0]):
        turn = larger(turn, abs(Y[k, 4] - Y[k - 1, 4]))
    return turn


@kernel
def release_loop(p, tables, Y, upper):
    """Shift phi by 2 pi from node `upper` up, against the turn; new first guesses for curvature and shear nearby."""
    n = Y.shape[0]
    shift = -2.0 * math.pi if Y[upper, 4] > Y[upper - 1, 4] else 2.0 * math.pi
    for k in range(upper, n):
        Y[k, 4] += shift
    for k in range(max(1, upper - 2), min(n - 1, upper + 2)):
        h = tables[p.grid_at + k - 1] + tables[p.grid_at + k]
        Y[k, 5] = (Y[k + 1, 4] - Y[k - 1, 4]) / h
        Y[k, 1] = 0.0


@kernel
def configuration(p, tables, weights, C0, K0, C1, K1, row):
    """Fill row (n, 6) with x, y, z, strain, tension, speed at one instant within a step (`engine.time.sampling`).

    Returns the velocity (U, 0, W) of the last node and the largest distance from the plane, 0.
    """
    w0, w1, g0, g1 = weights
    n = C0.shape[0]
    x = z = qx_below = qz_below = U = W = 0.0
    for k in range(n):
        qx = w0 * C0[k, 0] + w1 * C1[k, 0] + g0 * K0[k, 0] + g1 * K1[k, 0]
        qz = w0 * C0[k, 1] + w1 * C1[k, 1] + g0 * K0[k, 1] + g1 * K1[k, 1]
        U = w0 * C0[k, 2] + w1 * C1[k, 2] + g0 * K0[k, 2] + g1 * K1[k, 2]
        W = w0 * C0[k, 3] + w1 * C1[k, 3] + g0 * K0[k, 3] + g1 * K1[k, 3]
        if k > 0:
            half = 0.5 * tables[p.grid_at + k - 1]
            x += half * (qx_below + qx)
            z += half * (qz_below + qz)
        qx_below, qz_below = qx, qz
        eps = math.sqrt(qx * qx + qz * qz) - 1.0
        row[k, 0], row[k, 1], row[k, 2], row[k, 3] = x, 0.0, z, eps
        row[k, 4] = tension(eps, p, tables)[0]
        row[k, 5] = math.sqrt(U * U + W * W)
    return U, 0.0, W, 0.0


@kernel
def last_strain(p, C):
    """Strain of the last node."""
    k = C.shape[0] - 1
    return math.sqrt(C[k, 0] * C[k, 0] + C[k, 1] * C[k, 1]) - 1.0


@kernel
def shear_force(p, Y, k, q, S):
    """S n of node k into S (2,), where n is normal to q."""
    f = Y[k, 1] / math.sqrt(q[0] * q[0] + q[1] * q[1])
    S[0], S[1] = -f * q[1], f * q[0]
