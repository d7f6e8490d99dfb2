"""The state in space: Y (n, 13) as in `engine.spatial.node`, conserved C (n, 6) = (q, V) with q = (1+eps) t.

What the shared parts of the engine - Newton's method, steps, march, output - must know of it (`engine.dimensions`).
The frame may roll about t as it likes in C; only Y carries it on.
"""

import math

import numpy as np

from ..compiled import kernel
from ..physics.tension import tension
from . import node
from .box import box_rotation
from .elimination import sweep
from .elimination_unbent import sweep_unbent
from .rows import WIDTH
from .vectors import dot, frame, least_turn, mixed, quaternion_product, turned


@kernel
def size_of(p):
    """Unknowns and conserved variables of a node."""
    return 13, 6


@kernel
def work_arrays(p, n):
    """Work arrays of `engine.time.newton` for n nodes: X, F, Q, E, D, and the integrator's C~."""
    X, F, Q = np.zeros((n, 3)), np.zeros((n, 6)), np.zeros((n, node.WIDTH))
    return X, F, Q, np.zeros((n, WIDTH)), np.zeros((n, 12)), np.zeros((n, 6))


@kernel
def assemble(p, tables, t, in_motion, cq, cv, Y, C_tilde, X, F, Q, E, D):
    """One Newton update into D; returns False where a pivot block is singular. Arguments as for `time.newton`."""
    node.shape(p, tables, Y, Q, X)
    node.water(p, tables, t, in_motion, X, F)
    node.node_quantities(p, tables, cq, cv, in_motion, Y, C_tilde, F, Q)
    if p.bent:
        return sweep(p, tables, t, cq, cv, in_motion, Y, C_tilde, X, F, Q, E, D)
    return sweep_unbent(p, tables, t, cq, cv, in_motion, Y, C_tilde, X, F, Q, E, D)


@kernel
def update_size(p, D):
    """Largest entry of a Newton update in the scales of the scene (dimensionless)."""
    size = 0.0
    for k in range(D.shape[0]):
        d = D[k]
        force, speed = max(abs(d[1]), abs(d[2])), max(abs(d[3]), abs(d[4]), abs(d[5]))
        angle, curvature = max(abs(d[6]), abs(d[7]), abs(d[8])), max(abs(d[9]), abs(d[10]), abs(d[11]))
        size = max(
            size, abs(d[0]) * p.per_strain, force * p.per_force, speed * p.per_speed, angle, curvature * p.per_curvature
        )
        if not np.isfinite(d[0] + d[3] + d[4] + d[5] + d[6] + d[7] + d[8]):
            return np.inf
    return size


@kernel
def add_update(p, factor, D, Y):
    """Y moved by factor D: the frame turns, everything else is added. Returns the least strain."""
    least = np.inf
    for k in range(Y.shape[0]):
        d = D[k]
        for i in range(6):
            Y[k, i] += factor * d[i]
        q = turned((Y[k, 6], Y[k, 7], Y[k, 8], Y[k, 9]), (factor * d[6], factor * d[7], factor * d[8]))
        Y[k, 6], Y[k, 7], Y[k, 8], Y[k, 9] = q
        for i in range(3):
            Y[k, 10 + i] += factor * d[9 + i]
        least = min(least, Y[k, 0])
    return least


@kernel
def tidy(p, Y):
    """Euler parameters back to length one: extrapolation and rounding change it."""
    for k in range(Y.shape[0]):
        f = 1.0 / math.sqrt(Y[k, 6] ** 2 + Y[k, 7] ** 2 + Y[k, 8] ** 2 + Y[k, 9] ** 2)
        for i in range(6, 10):
            Y[k, i] *= f


@kernel
def conserved(p, Y, C):
    """C (n, 6) of a state Y (n, 13)."""
    for k in range(Y.shape[0]):
        t = frame((Y[k, 6], Y[k, 7], Y[k, 8], Y[k, 9]))[0]
        for i in range(3):
            C[k, i] = (1.0 + Y[k, 0]) * t[i]
            C[k, 3 + i] = Y[k, 3 + i]


@kernel
def extrapolate(p, alpha_f, Y, C_new, Y_new):
    """From the stage of a one-stage step to its end: Y_new comes in as the stage; eps and t are taken from C_new."""
    for k in range(Y.shape[0]):
        for i in range(3, 13):  # not the shear forces (`engine.planar.state`)
            Y_new[k, i] = Y[k, i] + (Y_new[k, i] - Y[k, i]) / alpha_f
    tidy(p, Y_new)
    for k in range(Y.shape[0]):
        q = (C_new[k, 0], C_new[k, 1], C_new[k, 2])
        length = math.sqrt(dot(q, q))
        Y_new[k, 0] = length - 1.0
        beta = (Y_new[k, 6], Y_new[k, 7], Y_new[k, 8], Y_new[k, 9])
        beta = quaternion_product(least_turn(frame(beta)[0], mixed(1.0 / length, q, 0.0, q)), beta)
        Y_new[k, 6], Y_new[k, 7], Y_new[k, 8], Y_new[k, 9] = beta


@kernel
def error_square(p, k, ec, Q):
    """Squared error of node k in scene scales, from the errors `ec` (6,) of its conserved variables."""
    e = (ec[0], ec[1], ec[2])
    axial = dot(e, node.vector(Q[k], 0))
    across = max(dot(e, e) - axial * axial, 0.0)
    speed = ec[3] ** 2 + ec[4] ** 2 + ec[5] ** 2
    return (axial * p.per_strain) ** 2 + across + speed * p.per_speed**2


@kernel
def largest_turn(p, Y):
    """Largest turn (rad) of the frame between neighbours and the upper node of its element."""
    turn, where = 0.0, 0
    if p.bent == 0:  # the frame then rolls without meaning
        return turn, where
    for k in range(1, Y.shape[0]):
        angle = box_rotation(Y, k - 1, k)[1]
        if angle > turn:
            turn, where = angle, k
    return turn, where


@kernel
def release_loop(p, tables, Y, upper):
    """Change the sign of the Euler parameters from node `upper` up, a turn by 2 pi; new first guesses nearby.

    t, n, b and q stay as they are. Newton starts from the turns of the neighbours and no shear: from the old curvature
    it would find its way back.
    """
    n = Y.shape[0]
    for k in range(upper, n):
        for i in range(6, 10):
            Y[k, i] = -Y[k, i]
    for k in range(max(1, upper - 2), min(n - 1, upper + 2)):
        h = tables[p.grid_at + k - 1] + tables[p.grid_at + k]
        below, above = box_rotation(Y, k - 1, k)[0], box_rotation(Y, k, k + 1)[0]
        for i in range(1, 3):
            Y[k, 10 + i] = (below[i] + above[i]) / h
            Y[k, i] = 0.0


@kernel
def configuration(p, tables, weights, C0, K0, C1, K1, row):
    """Fill row (n, 6) with x, y, z, strain, tension, speed at one instant within a step (`engine.time.sampling`).

    Returns the velocity of the last node and the largest distance from the plane of the waves (y = 0 without waves).
    """
    w0, w1, g0, g1 = weights
    x = (0.0, 0.0, 0.0)
    below = V = x
    cosine, sine = (p.dir_x, p.dir_y) if p.waves else (1.0, 0.0)
    largest = 0.0
    for k in range(C0.shape[0]):
        a, b, c, d = C0[k], C1[k], K0[k], K1[k]
        q = (
            w0 * a[0] + w1 * b[0] + g0 * c[0] + g1 * d[0],
            w0 * a[1] + w1 * b[1] + g0 * c[1] + g1 * d[1],
            w0 * a[2] + w1 * b[2] + g0 * c[2] + g1 * d[2],
        )
        V = (
            w0 * a[3] + w1 * b[3] + g0 * c[3] + g1 * d[3],
            w0 * a[4] + w1 * b[4] + g0 * c[4] + g1 * d[4],
            w0 * a[5] + w1 * b[5] + g0 * c[5] + g1 * d[5],
        )
        if k > 0:
            half = 0.5 * tables[p.grid_at + k - 1]
            x = mixed(1.0, x, half, mixed(1.0, below, 1.0, q))
        below = q
        eps = math.sqrt(dot(q, q)) - 1.0
        row[k, 0], row[k, 1], row[k, 2] = x
        row[k, 3], row[k, 4], row[k, 5] = eps, tension(eps, p, tables)[0], math.sqrt(dot(V, V))
        largest = max(largest, abs(cosine * x[1] - sine * x[0]))
    return V[0], V[1], V[2], largest


@kernel
def last_strain(p, C):
    """Strain of the last node."""
    k = C.shape[0] - 1
    return math.sqrt(C[k, 0] ** 2 + C[k, 1] ** 2 + C[k, 2] ** 2) - 1.0


@kernel
def shear_force(p, Y, k, q, S):
    """Sn n + Sb b of node k into S (3,), the frame turned the shortest way until its t is along q."""
    q = (q[0], q[1], q[2])
    length = math.sqrt(dot(q, q))
    beta = (Y[k, 6], Y[k, 7], Y[k, 8], Y[k, 9])
    beta = quaternion_product(least_turn(frame(beta)[0], mixed(1.0 / length, q, 0.0, q)), beta)
    _, n, b = frame(beta)
    S[0], S[1], S[2] = mixed(Y[k, 1], n, Y[k, 2], b)
