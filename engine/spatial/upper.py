"""Conditions of the upper end in space: its force balance, its two angles and, between clamps, the roll of the frame.

Its unknowns are y = (eps, Sn, Sb, theta2, theta3) there and dO1; v of the end follows from the relation that the sweep
has built, v = R y + r + r' dO1. A clamp is a rotational spring, so stiff that the end turns by less than a millionth of
the turn of its element.
"""

import math

import numpy as np

from ..compiled import kernel
from ..physics.ends import released, upper_end_3d
from ..physics.submergence import cap_end_3d
from ..record import HELD
from ..simd.elementary import smooth_start
from .box import nodal_jacobian
from .node import vector
from .rows import AT_R, AT_RT, AT_RX, row_of
from .vectors import dot, mixed, quaternion_product, relative, times

CLAMP = 1e6


@kernel
def spring(p, tables, element):
    """Stiffness of a clamp over EI (1/m)."""
    return CLAMP / tables[p.grid_at + element]


@kernel
def twist_at(p, t):
    """Twist (rad) that the clamped upper end has been given at time t."""
    return p.twist * smooth_start(t, p.twist_ramp)[0]


@kernel
def _roll_to_go(p, t, length, Y):
    """Turn (rad) about its own tangent by which the upper end exceeds the twist it is given.

    No twist: the frame of the anchor, carried from clamp to clamp (`engine.parameters`).
    """
    last = Y.shape[0] - 1
    carried = quaternion_product((p.carry0, p.carry1, p.carry2, p.carry3), (Y[0, 6], Y[0, 7], Y[0, 8], Y[0, 9]))
    # twist of the frame: what O1 leaves over; as exp(twist/2) it is exact for any number of turns
    twist = 0.5 * (twist_at(p, t) - Y[last, 10] * length)
    target = quaternion_product(carried, (math.cos(twist), math.sin(twist), 0.0, 0.0))
    r = relative(target, (Y[last, 6], Y[last, 7], Y[last, 8], Y[last, 9]))
    return 2.0 * math.atan2(r[1], r[0])


@kernel
def end_condition(p, tables, t, cq, cv, in_motion, Y, C_tilde, X, F, Q):
    """Residual of the upper end (`engine.physics.ends`, `engine.physics.submergence`), e_N, and the rows of D."""
    last = Y.shape[0] - 1
    V, V_tilde = vector(Y[last], 3), vector(C_tilde[last], 3)
    e, eN, S = upper_end_3d(p, tables, t, cv, in_motion, vector(Q[last], 11), V, V_tilde, F[last])
    rows = ((S[0], S[1], S[2]), (S[1], S[3], S[4]), (S[2], S[4], S[5]))
    if p.spherical_cap:
        more, D = cap_end_3d(p, t, cq, cv, in_motion, vector(X[last], 0), V, V_tilde, F[last])
        e = mixed(1.0, e, 1.0, more)
        rows = (
            mixed(1.0, rows[0], 1.0, D[0]),
            mixed(1.0, rows[1], 1.0, D[1]),
            mixed(1.0, rows[2], 1.0, D[2]),
        )
    return e, eN, rows


@kernel
def solve_upper(p, tables, t, cq, cv, in_motion, twisted, Y, C_tilde, X, F, Q, E):
    """Solve the conditions of the upper end for y there, and dO1; both into E[0, 0:6]. False where singular."""
    last = Y.shape[0] - 1
    row, node = E[last], Q[last]
    residual, eN, S = end_condition(p, tables, t, cq, cv, in_motion, Y, C_tilde, X, F, Q)
    count = 6 if twisted else 5
    M = np.zeros((6, 7))
    R1 = row_of(row, AT_R + 25)
    dN, _, roll, _, _ = nodal_jacobian(node, 0.0)
    known = times(S, vector(row, AT_RX))
    tau = times(S, vector(row, AT_RT))
    for j in range(5):
        column = times(S, (row[AT_R + j], row[AT_R + 5 + j], row[AT_R + 10 + j]))
        for i in range(3):
            M[i, j] = column[i]
        M[3, j], M[4, j], M[5, j] = row[AT_R + 15 + j], row[AT_R + 20 + j], R1[j]
    for i in range(3):
        for j in range(5):
            M[i, j] += eN * (dN[j][i] + roll[i] * R1[j])
        M[i, 5] = tau[i] + eN * roll[i] * row[AT_RT + 5]
        M[i, 6] = -residual[i] - known[i] - eN * roll[i] * row[AT_RX + 5]
    M[3, 5], M[4, 5], M[5, 5] = row[AT_RT + 3], row[AT_RT + 4], row[AT_RT + 5]
    M[3, 6], M[4, 6] = -Y[last, 11] - row[AT_RX + 3], -Y[last, 12] - row[AT_RX + 4]
    if p.end == HELD and p.clamp_above and not released(p, t):
        k_rotation = spring(p, tables, last - 1)
        direction = (p.above_x, p.above_y, p.above_z)
        M[3, 3] += k_rotation
        M[4, 4] += k_rotation
        M[3, 6] -= k_rotation * dot(direction, vector(node, 17))
        M[4, 6] += k_rotation * dot(direction, vector(node, 14))
    if twisted:
        length = 0.0
        for k in range(last):
            length += tables[p.grid_at + k]
        M[5, 5] += length
        M[5, 6] = -_roll_to_go(p, t, length, Y) - row[AT_RX + 5]
    else:
        for i in range(6):
            M[i, 5] = M[i, 6]
    if not _eliminated(M, count):
        return False
    for i in range(5):
        E[0, i] = M[i, count]
    E[0, 5] = M[5, count] if twisted else -Y[0, 10]
    return True


@kernel
def _eliminated(M, count):
    """Gauss's elimination with row pivoting; the solution replaces column `count` of M. False where singular."""
    for i in range(count):
        best = i
        for j in range(i + 1, count):
            if abs(M[j, i]) > abs(M[best, i]):
                best = j
        if M[best, i] == 0.0:
            return False
        for m in range(count + 1):
            M[i, m], M[best, m] = M[best, m], M[i, m]
        inverse = 1.0 / M[i, i]
        for j in range(count):
            if j != i:
                f = M[j, i] * inverse
                for m in range(i, count + 1):
                    M[j, m] -= f * M[i, m]
        for m in range(i, count + 1):
            M[i, m] *= inverse
    return True
