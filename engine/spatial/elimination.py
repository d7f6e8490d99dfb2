"""One Newton update of the box equations in space by condensed elimination, at a cost linear in the nodes.

Box between nodes a (lower) and b (upper), half element length e, psi the rotation vector from frame a to frame b;
residuals that Newton drives to zero:

    V_b - V_a - e (q_t,a + q_t,b) = 0                 compatibility      o b   y_b, v_b
    psi - e (o_a + o_b) = 0,  o = (0, O2, O3)         rotation           |
    N_b - N_a - e (G_a + G_b) = 0                     momentum           |  h = 2 e
    EI (O2_b - O2_a) - e (M2_a + M2_b) = 0            moments            |
    EI (O3_b - O3_a) + e (M3_a + M3_b) = 0                               o a   y_a, v_a

A torque that nothing distributes is the same everywhere: O1 is one number for the whole line, zero but where both ends
are clamped, and one more right-hand side there instead of one more unknown: what the frame, which does not roll,
turns between the clamps, and O1 times the length, are the twist given.

Split the unknowns into y = (eps, Sn, Sb, theta2, theta3) and v = (V, O2, O3, theta1). Below node a everything is one
affine relation v_a = R y_a + r + r' dO1; at the anchor V = 0, theta1 = 0 (the roll of the frame is free there: this
fixes it), O2 = O3 = 0, or a clamp. Compatibility and rotation give v_b from (v_a, y_a, y_b):

    d psi = J theta_b - J' theta_a,   J = g + psi x/2 + c psi psi',   g = (a/2) cot(a/2),  c = (1 - g)/a^2,  a = |psi|

momentum and moments give y_a = P y_b + p + p' dO1: a 3 x 3 inverse for (eps, Sn, Sb) and a 2 x 2 one for the angles.
At the upper end one small solve, then back substitution.

A clamp is a rotational spring, so stiff that the end turns by less than a millionth of the turn of its element.

E (n, 77) is laid out in `engine.spatial.rows`; in the row of the anchor, which has no P and p, E[0, 0:6] is y of the
upper end and dO1.

In the paper: eq. (13) torque; eq. (14) bending moment about n; eq. (15) bending moment about b; eq. (16) balance of
moments; eq. (17) compatibility; eq. (18) compatibility, with the tangent; eq. (19) compatibility in the local frame.
"""

from ..compiled import kernel
from ..physics.ends import released
from .box import (
    box_rotation,
    factors,
    jacobian_of_rotation,
    momentum_row,
    nodal_jacobian,
    rotation_rows,
    solve_box,
    solve_box_rows,
)
from .node import vector
from .rows import (
    AT_P,
    AT_PX,
    AT_R,
    AT_RT,
    AT_RX,
    added,
    combined,
    combined3,
    put_row,
    row_dot,
    row_of,
    row_times,
    scaled,
)
from .upper import solve_upper, spring
from .vectors import dot, mixed, symmetric


@kernel
def sweep(p, tables, t, cq, cv, in_motion, Y, C_tilde, X, F, Q, E, D):
    """Fill D (n, 12), increments of eps, Sn, Sb, V, theta, O; returns False where a pivot block is singular."""
    last = Y.shape[0] - 1
    EI, GI, O1 = p.EI, p.GI, Y[0, 10]
    twisted = p.clamp_below and p.clamp_above and not released(p, t)
    zero = (0.0, 0.0, 0.0, 0.0, 0.0)
    Rx = Ry = Rz = R2 = R3 = R1 = zero
    rx, ry, rz, r2, r3, r1 = -Y[0, 3], -Y[0, 4], -Y[0, 5], -Y[0, 11], -Y[0, 12], 0.0
    w2 = w3 = w1 = wx = wy = wz = 0.0  # r': response to dO1
    if p.clamp_below:
        k_rotation = spring(p, tables, 0)
        direction = (p.below_x, p.below_y, p.below_z)
        R2, R3 = (0.0, 0.0, 0.0, k_rotation, 0.0), (0.0, 0.0, 0.0, 0.0, k_rotation)
        r2 += k_rotation * dot(direction, vector(Q[0], 17))
        r3 -= k_rotation * dot(direction, vector(Q[0], 14))
    for k in range(1, last + 1):
        _store_relation(E[k - 1], Rx, Ry, Rz, R2, R3, R1, rx, ry, rz, r2, r3, r1)
        a = k - 1
        e = 0.5 * tables[p.grid_at + a]
        ec, over = e * cq, 1.0 / e
        Qa, Qb = Q[a], Q[k]
        # rotation: theta1, O2, O3 of b
        psi, angle, g = box_rotation(Y, a, k)
        J = jacobian_of_rotation(psi, angle, g)
        left = psi[0], psi[1] - e * (Y[a, 11] + Y[k, 11]), psi[2] - e * (Y[a, 12] + Y[k, 12])
        A1, B1, z1, A2, B2, z2, A3, B3, z3 = rotation_rows(over, J, left, R1, r1, R2, r2, R3, r3)
        # compatibility: V_b = A y_a + B y_b + z
        ta, na, ba, tb, nb, bb = (
            vector(Qa, 0),
            vector(Qa, 14),
            vector(Qa, 17),
            vector(Qb, 0),
            vector(Qb, 14),
            vector(Qb, 17),
        )
        la, lb = ec * Qa[4], ec * Qb[4]
        Ax = added(Rx, (ec * ta[0], 0.0, 0.0, -la * ba[0], la * na[0]))
        Ay = added(Ry, (ec * ta[1], 0.0, 0.0, -la * ba[1], la * na[1]))
        Az = added(Rz, (ec * ta[2], 0.0, 0.0, -la * ba[2], la * na[2]))
        Bx = (ec * tb[0], 0.0, 0.0, -lb * bb[0], lb * nb[0])
        By = (ec * tb[1], 0.0, 0.0, -lb * bb[1], lb * nb[1])
        Bz = (ec * tb[2], 0.0, 0.0, -lb * bb[2], lb * nb[2])
        zx = rx - (Y[k, 3] - Y[a, 3] - e * (Qa[8] + Qb[8]))
        zy = ry - (Y[k, 4] - Y[a, 4] - e * (Qa[9] + Qb[9]))
        zz = rz - (Y[k, 5] - Y[a, 5] - e * (Qa[10] + Qb[10]))
        # momentum: K V_a-part, J V_b-part of e dG/dV
        dNa, Ga, roll_a, dM2a, dM3a = nodal_jacobian(Qa, e)
        dNb, Gb, roll_b, dM2b, dM3b = nodal_jacobian(Qb, e)
        Mx, gx, BMx = momentum_row(
            0,
            e,
            Qa,
            Qb,
            Rx,
            Ry,
            Rz,
            Ax,
            Ay,
            Az,
            Bx,
            By,
            Bz,
            rx,
            ry,
            rz,
            zx,
            zy,
            zz,
            dNa,
            Ga,
            roll_a,
            dNb,
            Gb,
            roll_b,
            R1,
            r1,
            A1,
            B1,
            z1,
        )
        My, gy, BMy = momentum_row(
            1,
            e,
            Qa,
            Qb,
            Rx,
            Ry,
            Rz,
            Ax,
            Ay,
            Az,
            Bx,
            By,
            Bz,
            rx,
            ry,
            rz,
            zx,
            zy,
            zz,
            dNa,
            Ga,
            roll_a,
            dNb,
            Gb,
            roll_b,
            R1,
            r1,
            A1,
            B1,
            z1,
        )
        Mz, gz, BMz = momentum_row(
            2,
            e,
            Qa,
            Qb,
            Rx,
            Ry,
            Rz,
            Ax,
            Ay,
            Az,
            Bx,
            By,
            Bz,
            rx,
            ry,
            rz,
            zx,
            zy,
            zz,
            dNa,
            Ga,
            roll_a,
            dNb,
            Gb,
            roll_b,
            R1,
            r1,
            A1,
            B1,
            z1,
        )
        # moments
        M2 = combined3(EI, A2, -EI, R2, -e, dM2a)
        M3 = combined3(EI, A3, -EI, R3, e, dM3a)
        BM2 = combined(EI, B2, -e, dM2b)
        BM3 = combined(EI, B3, e, dM3b)
        g2 = -EI * (Y[k, 11] - Y[a, 11]) + e * (Qa[38] + Qb[38]) - EI * (z2 - r2)
        g3 = -EI * (Y[k, 12] - Y[a, 12]) - e * (Qa[39] + Qb[39]) - EI * (z3 - r3)
        if O1 != 0.0:
            couple = e * GI * O1
            M2, M3 = combined3(1.0, M2, couple, R3, couple, A3), combined3(1.0, M3, -couple, R2, -couple, A2)
            BM2, BM3 = combined(1.0, BM2, couple, B3), combined(1.0, BM3, -couple, B2)
            g2 -= couple * (r3 + z3)
            g3 += couple * (r2 + z2)
        # y_a = P y_b + p + p' dO1
        solver, sound = factors(Mx, My, Mz, M2, M3)
        if not sound:
            return False
        P = solve_box_rows(solver, BMx, BMy, BMz, BM2, BM3)
        pr = solve_box(solver, gx, gy, gz, g2, g3)
        for i in range(5):
            put_row(E[k], 5 * i, P[i])
        put_row(E[k], AT_P, pr)
        if twisted:
            # the same equations with dO1 for their only known term
            y2 = over * (J[1][0] - J[0][1]) * w1 - w2
            y3 = over * (J[2][0] - J[0][2]) * w1 - w3
            couple = e * GI * O1
            D2 = -e * GI * (Y[a, 12] + Y[k, 12]) - couple * (w3 + y3) - EI * (y2 - w2)
            D3 = e * GI * (Y[a, 11] + Y[k, 11]) + couple * (w2 + y2) - EI * (y3 - w3)
            Ja, Jb = (Qa[32], Qa[33], Qa[34], Qa[35], Qa[36], Qa[37]), (Qb[32], Qb[33], Qb[34], Qb[35], Qb[36], Qb[37])
            w = (wx, wy, wz)
            known = mixed(w1, roll_a, -w1, roll_b)
            known = mixed(1.0, known, e, mixed(1.0, symmetric(Ja, w), 1.0, symmetric(Jb, w)))
            px = solve_box(solver, known[0], known[1], known[2], D2, D3)
            put_row(E[k], AT_PX, px)
            wx, wy, wz = wx + row_dot(Ax, px), wy + row_dot(Ay, px), wz + row_dot(Az, px)
            w2, w3, w1 = y2 + row_dot(A2, px), y3 + row_dot(A3, px), w1 + row_dot(A1, px)
            E[k, AT_RT], E[k, AT_RT + 1], E[k, AT_RT + 2] = wx, wy, wz
            E[k, AT_RT + 3], E[k, AT_RT + 4], E[k, AT_RT + 5] = w2, w3, w1
        Rx, Ry, Rz = added(row_times(Ax, P), Bx), added(row_times(Ay, P), By), added(row_times(Az, P), Bz)
        R2, R3, R1 = added(row_times(A2, P), B2), added(row_times(A3, P), B3), added(row_times(A1, P), B1)
        rx, ry, rz = zx + row_dot(Ax, pr), zy + row_dot(Ay, pr), zz + row_dot(Az, pr)
        r2, r3, r1 = z2 + row_dot(A2, pr), z3 + row_dot(A3, pr), z1 + row_dot(A1, pr)
    _store_relation(E[last], Rx, Ry, Rz, R2, R3, R1, rx, ry, rz, r2, r3, r1)
    sound = solve_upper(p, tables, t, cq, cv, in_motion, twisted, Y, C_tilde, X, F, Q, E)
    return sound and back_substitute(E, twisted, Y, D)


@kernel
def _store_relation(row, Rx, Ry, Rz, R2, R3, R1, rx, ry, rz, r2, r3, r1):
    """R and r of one node into its row of E."""
    put_row(row, AT_R, Rx)
    put_row(row, AT_R + 5, Ry)
    put_row(row, AT_R + 10, Rz)
    put_row(row, AT_R + 15, R2)
    put_row(row, AT_R + 20, R3)
    put_row(row, AT_R + 25, R1)
    row[AT_RX], row[AT_RX + 1], row[AT_RX + 2] = rx, ry, rz
    row[AT_RX + 3], row[AT_RX + 4], row[AT_RX + 5] = r2, r3, r1


@kernel
def back_substitute(E, twisted, Y, D):
    """From y of the upper end and dO1 in E[0, 0:6] down the line: the increments of every node, into D."""
    y = row_of(E[0], 0)
    torque = E[0, 5]
    for k in range(E.shape[0] - 1, -1, -1):
        row, out = E[k], D[k]
        out[0], out[1], out[2], out[7], out[8] = y
        out[3] = row_dot(row_of(row, AT_R), y) + row[AT_RX]
        out[4] = row_dot(row_of(row, AT_R + 5), y) + row[AT_RX + 1]
        out[5] = row_dot(row_of(row, AT_R + 10), y) + row[AT_RX + 2]
        out[10] = row_dot(row_of(row, AT_R + 15), y) + row[AT_RX + 3]
        out[11] = row_dot(row_of(row, AT_R + 20), y) + row[AT_RX + 4]
        out[6] = row_dot(row_of(row, AT_R + 25), y) + row[AT_RX + 5]
        out[9] = torque
        if twisted and k > 0:
            out[3] += torque * row[AT_RT]
            out[4] += torque * row[AT_RT + 1]
            out[5] += torque * row[AT_RT + 2]
            out[10] += torque * row[AT_RT + 3]
            out[11] += torque * row[AT_RT + 4]
            out[6] += torque * row[AT_RT + 5]
        if k > 0:
            y = (
                row_dot(row_of(row, 0), y) + row[AT_P],
                row_dot(row_of(row, 5), y) + row[AT_P + 1],
                row_dot(row_of(row, 10), y) + row[AT_P + 2],
                row_dot(row_of(row, 15), y) + row[AT_P + 3],
                row_dot(row_of(row, 20), y) + row[AT_P + 4],
            )
            if twisted:
                y = added(y, scaled(torque, row_of(row, AT_PX)))
    return True
