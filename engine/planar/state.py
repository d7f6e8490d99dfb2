"""The planar state: Y (n, 6) = (eps, S, U, W, phi, kappa), conserved C (n, 4) = (q_x, q_z, U, W) with q = (1+eps) t.

What the shared parts of the engine - Newton's method, steps, march, output - must know of it (`engine.dimensions`).
"""

import math

import numpy as np

from ..arrays import Work
from ..compiled import kernel
from ..physics import sea_series
from ..physics.tension.kernels import tension
from ..record import PLACE, SPEED, STRAIN, TENSION
from ..simd.elementary import strain_within, within
from ..simd.select import finite, larger, smaller, where
from ..spatial.vectors import pair, put
from . import columns as col
from .extras import node_width


@kernel
def size_of(p):
    """Unknowns and conserved variables of a node."""
    return 6, 4


@kernel
def work_arrays(p, n):
    """Work arrays (`engine.arrays.Work`) of a Newton solve with n nodes."""
    X, F, Q = np.zeros((n, 2)), np.zeros((n, 4)), np.zeros((n, node_width(p)))
    sea = np.zeros((n + 1, sea_series.WIDTH))
    return Work(X, F, Q, np.zeros((n, col.BOX_WIDTH)), np.zeros((n, 6)), np.zeros((n, 4)), sea)


@kernel
def update_size(p, D):
    """Largest entry of a Newton update in the scales of the scene (dimensionless)."""
    size = total = 0.0
    for k in range(D.shape[0]):
        d = D[k]
        stretched = larger(abs(d[col.EPS]) * p.per_strain, abs(d[col.SHEAR]) * p.per_force)
        moved = larger(abs(d[col.VX]), abs(d[col.VZ])) * p.per_speed
        turned = larger(abs(d[col.PHI]), abs(d[col.KAPPA]) * p.per_curvature)
        size = larger(size, larger(larger(stretched, moved), turned))
        total += ((d[col.EPS] + d[col.SHEAR]) + (d[col.VX] + d[col.VZ])) + (d[col.PHI] + d[col.KAPPA])
    return where(finite(total), size, np.inf)


@kernel
def add_update(p, factor, D, Y):
    """Y += factor D; returns the least strain."""
    least = np.inf
    for k in range(Y.shape[0]):
        for i in range(6):
            Y[k, i] += factor * D[k, i]
        least = smaller(least, Y[k, col.EPS])
    return least


@kernel
def tidy(p, Y):
    """After an extrapolation: nothing to restore in the plane."""


@kernel
def conserved(p, Y, C):
    """C (n, 4) of a state Y (n, 6)."""
    for k in range(Y.shape[0]):
        y, c = Y[k], C[k]
        lam = 1.0 + y[col.EPS]
        c[col.CX], c[col.CZ] = lam * math.cos(y[col.PHI]), lam * math.sin(y[col.PHI])
        c[col.VX], c[col.VZ] = y[col.VX], y[col.VZ]


@kernel
def extrapolate(p, alpha_f, Y, C_new, Y_new):
    """From the stage of a one-stage step to its end: Y_new comes in as the stage; eps and t are taken from C_new."""
    for k in range(Y.shape[0]):
        # not the shear force: nothing ties it to its past, and errors of it would alternate for ever
        for i in range(col.VX, col.KAPPA + 1):
            Y_new[k, i] = Y[k, i] + (Y_new[k, i] - Y[k, i]) / alpha_f
        qx, qz = pair(C_new[k], col.CX)
        turn = math.atan2(qz, qx) - Y_new[k, col.PHI]
        Y_new[k, col.PHI] += turn - 2.0 * math.pi * np.rint(turn / (2.0 * math.pi))
        Y_new[k, col.EPS] = math.sqrt(qx**2 + qz**2) - 1.0


@kernel
def error_square(p, k, ec, Q):
    """Squared error of node k in scene scales, from the errors `ec` (4,) of its conserved variables."""
    axial = (ec[col.CX] * Q[k, col.COS] + ec[col.CZ] * Q[k, col.SIN]) * p.per_strain
    turned = ec[col.CZ] * Q[k, col.COS] - ec[col.CX] * Q[k, col.SIN]
    speed = (ec[col.VX] * ec[col.VX] + ec[col.VZ] * ec[col.VZ]) * p.per_speed * p.per_speed
    return axial * axial + turned * turned + speed


@kernel
def largest_turn(p, Y):
    """Largest |phi_k - phi_(k-1)| (rad) and the upper node of its element."""
    turn, element = 0.0, 0.0
    for k in range(1, Y.shape[0]):
        d = abs(Y[k, col.PHI] - Y[k - 1, col.PHI])
        turn, element = larger(turn, d), where(d > turn, float(k), element)
    return turn, element


@kernel
def release_loop(p, tables, Y, upper):
    """Shift phi by 2 pi from node `upper` up, against the turn. Returns `upper` with the sign of the shift."""
    n = Y.shape[0]
    shift = -2.0 * math.pi if Y[upper, col.PHI] > Y[upper - 1, col.PHI] else 2.0 * math.pi
    for k in range(upper, n):
        Y[k, col.PHI] += shift
    return upper if shift > 0.0 else -upper


@kernel
def configuration(p, tables, weights, C0, K0, C1, K1, row):
    """Fill row (n, 6) with x, y, z, strain, tension, speed at one instant within a step (`engine.time.time_loop`).

    Returns the velocity (U, 0, W) of the last node and the largest distance from the plane, 0.
    """
    n = C0.shape[0]
    x = z = qx_below = qz_below = U = W = 0.0
    for k in range(n):
        qx = within(weights, C0, C1, K0, K1, k, col.CX)
        qz = within(weights, C0, C1, K0, K1, k, col.CZ)
        U = within(weights, C0, C1, K0, K1, k, col.VX)
        W = within(weights, C0, C1, K0, K1, k, col.VZ)
        if k > 0:
            half = 0.5 * tables[p.grid_at + k - 1]
            x += half * (qx_below + qx)
            z += half * (qz_below + qz)
        qx_below, qz_below = qx, qz
        eps = strain_within(weights, C0[k], C1[k], K0[k], K1[k])
        put(row[k], PLACE, (x, 0.0, z))
        row[k, STRAIN], row[k, TENSION], row[k, SPEED] = eps, tension(eps, p, tables)[0], math.sqrt(U * U + W * W)
    return U, 0.0, W, 0.0


@kernel
def last_strain(p, C):
    """Strain of the last node."""
    x, z = pair(C[C.shape[0] - 1], col.CX)
    return math.sqrt(x * x + z * z) - 1.0


@kernel
def shear_force(p, Y, k, q, S):
    """S n of node k into S (2,), where n is normal to q."""
    f = Y[k, col.SHEAR] / math.sqrt(q[0] * q[0] + q[1] * q[1])
    S[0], S[1] = -f * q[1], f * q[0]
