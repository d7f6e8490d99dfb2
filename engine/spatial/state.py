"""The state in space: Y (n, 13) as in `engine.spatial.node`, conserved C (n, 6) = (q, V) with q = (1+eps) t.

What the shared parts of the engine - Newton's method, steps, march, output - must know of it (`engine.dimensions`).
The frame may roll about t as it likes in C; only Y carries it on.
"""

import math

import numpy as np

from ..arrays import Work
from ..compiled import kernel
from ..physics import sea_sum
from ..physics.tension.kernels import tension
from ..record import PLACE, SPEED, STRAIN, TENSION
from ..simd.elementary import strain_within, within
from . import columns as col
from .extras import node_width
from .node import box_rotation
from .vectors import (
    dot,
    frame,
    least_turn,
    mixed,
    multiple,
    plus,
    put,
    put_quaternion,
    quaternion,
    quaternion_product,
    turned,
    vector,
)


@kernel
def size_of(p):
    """Unknowns and conserved variables of a node."""
    return 13, 6


@kernel
def work_arrays(p, n):
    """Work arrays (`engine.arrays.Work`) of a Newton solve with n nodes."""
    X, F, Q = np.zeros((n, 3)), np.zeros((n, 6)), np.zeros((n, node_width(p)))
    E, D, C_tilde = np.zeros((n, col.BOX_WIDTH)), np.zeros((n, 12)), np.zeros((n, 6))
    return Work(X, F, Q, E, D, C_tilde, np.zeros((n + 1, sea_sum.WIDTH)))


@kernel
def update_size(p, D):
    """Largest entry of a Newton update in the scales of the scene (dimensionless)."""
    size = 0.0
    for k in range(D.shape[0]):
        d = D[k]
        V, theta, turn = vector(d, col.V), vector(d, col.THETA1), vector(d, col.D_O1)
        force, speed = max(abs(d[col.SHEAR_N]), abs(d[col.SHEAR_B])), max(abs(V[0]), abs(V[1]), abs(V[2]))
        angle = max(abs(theta[0]), abs(theta[1]), abs(theta[2]))
        curvature = max(abs(turn[0]), abs(turn[1]), abs(turn[2]))
        strain = abs(d[col.EPS]) * p.per_strain
        size = max(size, strain, force * p.per_force, speed * p.per_speed, angle, curvature * p.per_curvature)
        if not np.isfinite(d[col.EPS] + V[0] + V[1] + V[2] + theta[0] + theta[1] + theta[2]):
            return np.inf
    return size


@kernel
def add_update(p, factor, D, Y):
    """Y moved by factor D: the frame turns, everything else is added. Returns the least strain."""
    least = np.inf
    for k in range(Y.shape[0]):
        d, y = D[k], Y[k]
        for i in range(col.BETA):
            y[i] += factor * d[i]
        turn = multiple(factor, vector(d, col.THETA1))
        put_quaternion(y, col.BETA, turned(quaternion(y, col.BETA), turn))
        for i in range(3):
            y[col.O1 + i] += factor * d[col.D_O1 + i]
        least = min(least, y[col.EPS])
    return least


@kernel
def tidy(p, Y):
    """Euler parameters back to length one: extrapolation and rounding change it."""
    for k in range(Y.shape[0]):
        b0, b1, b2, b3 = quaternion(Y[k], col.BETA)
        f = 1.0 / math.sqrt(b0**2 + b1**2 + b2**2 + b3**2)
        for i in range(4):
            Y[k, col.BETA + i] *= f


@kernel
def conserved(p, Y, C):
    """C (n, 6) of a state Y (n, 13)."""
    for k in range(Y.shape[0]):
        t = frame(quaternion(Y[k], col.BETA))[0]
        for i in range(3):
            C[k, i] = (1.0 + Y[k, col.EPS]) * t[i]
            C[k, col.V + i] = Y[k, col.V + i]


@kernel
def extrapolate(p, alpha_f, Y, C_new, Y_new):
    """From the stage of a one-stage step to its end: Y_new comes in as the stage; eps and t are taken from C_new."""
    for k in range(Y.shape[0]):
        for i in range(col.V, col.O3 + 1):  # not the shear forces (`engine.planar.state`)
            Y_new[k, i] = Y[k, i] + (Y_new[k, i] - Y[k, i]) / alpha_f
    tidy(p, Y_new)
    for k in range(Y.shape[0]):
        q = vector(C_new[k], 0)
        Y_new[k, col.EPS] = math.sqrt(dot(q, q)) - 1.0
        put_quaternion(Y_new[k], col.BETA, _along(quaternion(Y_new[k], col.BETA), q))


@kernel
def _along(beta, q):
    """The frame beta turned the shortest way until its t is along q."""
    return quaternion_product(least_turn(frame(beta)[0], multiple(1.0 / math.sqrt(dot(q, q)), q)), beta)


@kernel
def error_square(p, k, ec, Q):
    """Squared error of node k in scene scales, from the errors `ec` (6,) of its conserved variables."""
    e = vector(ec, 0)
    axial = dot(e, vector(Q[k], col.T_VECTOR))
    across = max(dot(e, e) - axial * axial, 0.0)
    speed = ec[col.V] ** 2 + ec[col.V + 1] ** 2 + ec[col.V + 2] ** 2
    return (axial * p.per_strain) ** 2 + across + speed * p.per_speed**2


@kernel
def largest_turn(p, Y):
    """Largest turn (rad) of the frame between neighbours and the upper node of its element."""
    turn, element = 0.0, 0
    if p.bent == 0:  # the frame then rolls without meaning
        return turn, element
    for k in range(1, Y.shape[0]):
        angle = box_rotation(Y, k - 1, k)[1]
        if angle > turn:
            turn, element = angle, k
    return turn, element


@kernel
def release_loop(p, tables, Y, upper):
    """Change the sign of the Euler parameters from node `upper` up, a turn by 2 pi; new first guesses nearby.

    t, n, b and q stay as they are. Newton starts from the turns of the neighbours and no shear: from the old curvature
    it would find its way back. Returns 0: no turn is held.
    """
    n = Y.shape[0]
    for k in range(upper, n):
        for i in range(4):
            Y[k, col.BETA + i] = -Y[k, col.BETA + i]
    for k in range(max(1, upper - 2), min(n - 1, upper + 2)):
        h = tables[p.grid_at + k - 1] + tables[p.grid_at + k]
        below, above = box_rotation(Y, k - 1, k)[0], box_rotation(Y, k, k + 1)[0]
        Y[k, col.O2], Y[k, col.O3] = (below[1] + above[1]) / h, (below[2] + above[2]) / h
        Y[k, col.SHEAR_N] = Y[k, col.SHEAR_B] = 0.0
    return 0


@kernel
def configuration(p, tables, weights, C0, K0, C1, K1, row):
    """Fill row (n, 6) with x, y, z, strain, tension, speed at one instant within a step (`engine.time.time_loop`).

    Returns the velocity of the last node and the largest distance from the plane of the waves (y = 0 without waves).
    """
    x = (0.0, 0.0, 0.0)
    below = V = x
    cosine, sine = (p.dir_x, p.dir_y) if p.waves else (1.0, 0.0)
    largest = 0.0
    for k in range(C0.shape[0]):
        q = _vector_within(weights, C0, C1, K0, K1, k, 0)
        V = _vector_within(weights, C0, C1, K0, K1, k, col.V)
        if k > 0:
            half = 0.5 * tables[p.grid_at + k - 1]
            x = mixed(1.0, x, half, plus(below, q))
        below = q
        eps = strain_within(weights, C0[k], C1[k], K0[k], K1[k])
        put(row[k], PLACE, x)
        row[k, STRAIN], row[k, TENSION], row[k, SPEED] = eps, tension(eps, p, tables)[0], math.sqrt(dot(V, V))
        largest = max(largest, abs(cosine * x[1] - sine * x[0]))
    return V[0], V[1], V[2], largest


@kernel
def _vector_within(weights, C0, C1, K0, K1, k, at):
    """C[k, at : at + 3] at one instant of a step."""
    return (
        within(weights, C0, C1, K0, K1, k, at),
        within(weights, C0, C1, K0, K1, k, at + 1),
        within(weights, C0, C1, K0, K1, k, at + 2),
    )


@kernel
def last_strain(p, C):
    """Strain of the last node."""
    x, y, z = vector(C[C.shape[0] - 1], 0)
    return math.sqrt(x**2 + y**2 + z**2) - 1.0


@kernel
def shear_force(p, Y, k, q, S):
    """Sn n + Sb b of node k into S (3,), the frame turned the shortest way until its t is along q."""
    _, n, b = frame(_along(quaternion(Y[k], col.BETA), vector(q, 0)))
    put(S, 0, mixed(Y[k, col.SHEAR_N], n, Y[k, col.SHEAR_B], b))
