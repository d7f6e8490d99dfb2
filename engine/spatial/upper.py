"""Conditions of the upper end in space: its force balance, its two angles and, between clamps, the roll of the frame.

Its unknowns are y = (eps, Sn, Sb, theta2, theta3) there and dO1; v of the end follows from v = R y + r + r' dO1, which
the elimination has built. A clamp is a spring: the end turns by less than a millionth of the turn of its element.
"""

import math

import numpy as np

from ..compiled import kernel
from ..physics.ends import released, upper_end_3d
from ..physics.submergence import cap_end_3d
from ..record import HELD
from ..simd.elementary import smooth_start
from . import columns as col
from .box import nodal_jacobian
from .vectors import dot, plus, quaternion, quaternion_product, relative, row_of, sum_of, times, vector

CLAMP = 1e6  # over the length (m) of the element there: stiffness of a clamp over EI (1/m)


@kernel
def _roll_to_go(p, t, length, Y):
    """Turn (rad) about its own tangent by which the upper end exceeds the twist it is given.

    No twist: the frame of the anchor, carried from clamp to clamp (`engine.parameters`).
    """
    last = Y.shape[0] - 1
    carried = quaternion_product((p.carry0, p.carry1, p.carry2, p.carry3), quaternion(Y[0], col.BETA))
    # twist of the frame: what O1 leaves over; as exp(twist/2) it is exact for any number of turns
    imposed = p.twist * smooth_start(t, p.twist_ramp)[0]
    twist = 0.5 * (imposed - Y[last, col.O1] * length)
    target = quaternion_product(carried, (math.cos(twist), math.sin(twist), 0.0, 0.0))
    r = relative(target, quaternion(Y[last], col.BETA))
    return 2.0 * math.atan2(r[1], r[0])


@kernel
def end_condition(p, tables, stage, Y, work):
    """Residual of the upper end (`engine.physics.ends`, `engine.physics.submergence`), e_N, and the rows of D.

    Arguments as for `engine.spatial.elimination.eliminate`.
    """
    last = Y.shape[0] - 1
    V, V_tilde, F = vector(Y[last], col.V), vector(work.C_tilde[last], col.V), work.F[last]
    e, eN, S = upper_end_3d(p, tables, stage, vector(work.Q[last], col.N), V, V_tilde, F)
    rows = ((S[0], S[1], S[2]), (S[1], S[3], S[4]), (S[2], S[4], S[5]))
    if p.spherical_cap:
        cap, D = cap_end_3d(p, tables, stage, vector(work.X[last], 0), V, V_tilde, F)
        e, rows = plus(e, cap), sum_of(rows, D)
    return e, eN, rows


@kernel
def solve_upper(p, tables, stage, twisted, Y, work):
    """Solve the conditions of the upper end for y there, and dO1; both into the first row of E. False where singular.

    twisted: is the roll of the frame known at both ends? Other arguments as for `end_condition`.
    """
    E = work.E
    last = Y.shape[0] - 1
    row, node = E[last], work.Q[last]
    residual, eN, S = end_condition(p, tables, stage, Y, work)
    count = 6 if twisted else 5
    # three forces, two moments and, where the roll is known, a roll, by y and dO1; column `count`: the right-hand side
    M = np.zeros((6, 7))
    R1 = row_of(row, col.R + col.ROLL)
    at = nodal_jacobian(p, node, 0.0)
    known = times(S, vector(row, col.R_KNOWN))
    tau = times(S, vector(row, col.R_TORQUE))
    for j in range(5):
        column = times(S, (row[col.R + j], row[col.R + 5 + j], row[col.R + 10 + j]))
        for i in range(3):
            M[i, j] = column[i]
        M[3, j], M[4, j], M[5, j] = row[col.R + 15 + j], row[col.R + 20 + j], R1[j]
    for i in range(3):
        for j in range(5):
            M[i, j] += eN * (at.N[j][i] + at.roll[i] * R1[j])
        M[i, 5] = tau[i] + eN * at.roll[i] * row[col.R_TORQUE + 5]
        M[i, count] = -residual[i] - known[i] - eN * at.roll[i] * row[col.R_KNOWN + 5]
    M[3, 5], M[4, 5], M[5, 5] = vector(row, col.R_TORQUE + 3)
    M[3, count], M[4, count] = -Y[last, col.O2] - row[col.R_KNOWN + 3], -Y[last, col.O3] - row[col.R_KNOWN + 4]
    if p.end == HELD and p.clamp_above and not released(p, stage.t):
        k_rotation = CLAMP / tables[p.grid_at + last - 1]
        direction = (p.above_x, p.above_y, p.above_z)
        M[3, 3] += k_rotation
        M[4, 4] += k_rotation
        M[3, count] -= k_rotation * dot(direction, vector(node, col.B_VECTOR))
        M[4, count] += k_rotation * dot(direction, vector(node, col.N_VECTOR))
    if twisted:
        length = 0.0
        for k in range(last):
            length += tables[p.grid_at + k]
        M[5, 5] += length
        M[5, count] = -_roll_to_go(p, stage.t, length, Y) - row[col.R_KNOWN + 5]
    if not _eliminated(M, count):
        return False
    for i in range(5):
        E[0, col.TOP + i] = M[i, count]
    E[0, col.TOP_TORQUE] = M[5, count] if twisted else -Y[0, col.O1]
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
