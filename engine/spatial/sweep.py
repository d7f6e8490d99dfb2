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

E (n, 77): P (25) | p (5) | p' (5) | R (30), rows V, O2, O3, theta1 | r (6) | r' (6); in the row of the anchor, which
has no P and p, E[0, 0:6] is y of the upper end and dO1.
"""

import math

import numpy as np

from ..compiled import kernel
from ..elementary import smooth_start
from ..ends import HELD, released, upper_end_3d
from ..vectors import dot, mixed, quaternion_product, relative, rotation_vector, symmetric
from .node import vector
from .rows import added, combined, combined3, put_row, row_dot, row_of, row_times, scaled

WIDTH = 77
_P, _PX, _R, _RX, _RT = 25, 30, 35, 65, 71
CLAMP = 1e6


@kernel
def spring(p, tables, element):
    """Stiffness of a clamp over EI (1/m)."""
    return CLAMP / tables[p.grid_at + element]


@kernel
def box_rotation(Y, a, b):
    """psi of a box, its length (rad), and (a/2) cot(a/2)."""
    return rotation_vector(
        relative((Y[a, 6], Y[a, 7], Y[a, 8], Y[a, 9]), (Y[b, 6], Y[b, 7], Y[b, 8], Y[b, 9]))
    )


@kernel
def nodal_jacobian(row, e):
    """Of one node by y: dN (five 3-vectors), e dG (of eps, theta2, theta3), dN/dtheta1, dM2 and dM3 at fixed O."""
    t, n, b = vector(row, 0), vector(row, 14), vector(row, 17)
    T = row[41]
    N = vector(row, 11)
    Sn, Sb = dot(N, n), dot(N, b)
    dN = mixed(row[3], t, 0.0, t), n, b, mixed(Sb, t, -T, b), mixed(-Sn, t, T, n)
    Ge, G2, G3 = vector(row, 23), vector(row, 26), vector(row, 29)
    lead = 3.0 * row[40] / row[4]
    dM2 = (lead * Sb, 0.0, row[40], 0.0, 0.0)
    dM3 = (lead * Sn, row[40], 0.0, 0.0, 0.0)
    roll = mixed(Sn, b, -Sb, n)  # dN/dtheta1
    return dN, (mixed(e, Ge, 0.0, Ge), mixed(e, G2, 0.0, G2), mixed(e, G3, 0.0, G3)), roll, dM2, dM3


@kernel
def sweep(p, tables, t, cq, cv, in_motion, Y, C_tilde, F, Q, E, D):
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
        # rotation: J, and what is left of its equations
        psi, angle, g = box_rotation(Y, a, k)
        c = (1.0 - g) / (angle * angle) if angle > 1e-3 else 1.0 / 12 + angle * angle / 720
        J11, J22, J33 = g + c * psi[0] * psi[0], g + c * psi[1] * psi[1], g + c * psi[2] * psi[2]
        J12, J21 = c * psi[0] * psi[1] - 0.5 * psi[2], c * psi[0] * psi[1] + 0.5 * psi[2]
        J13, J31 = c * psi[0] * psi[2] + 0.5 * psi[1], c * psi[0] * psi[2] - 0.5 * psi[1]
        J23, J32 = c * psi[1] * psi[2] - 0.5 * psi[0], c * psi[1] * psi[2] + 0.5 * psi[0]
        c1 = psi[0]
        c2 = psi[1] - e * (Y[a, 11] + Y[k, 11])
        c3 = psi[2] - e * (Y[a, 12] + Y[k, 12])
        inverse = 1.0 / J11
        A1 = added(R1, (0.0, 0.0, 0.0, J21 * inverse, J31 * inverse))  # theta1_b = A1 y_a + B1 y_b + z1
        B1 = (0.0, 0.0, 0.0, -J12 * inverse, -J13 * inverse)
        z1 = r1 - c1 * inverse
        A2 = combined3(J21 * over, A1, -J12 * over, R1, -1.0, R2)
        A2 = added(A2, (0.0, 0.0, 0.0, -J22 * over, -J32 * over))
        B2 = added(scaled(J21 * over, B1), (0.0, 0.0, 0.0, J22 * over, J23 * over))
        z2 = over * (J21 * z1 - J12 * r1 + c2) - r2
        A3 = combined3(J31 * over, A1, -J13 * over, R1, -1.0, R3)
        A3 = added(A3, (0.0, 0.0, 0.0, -J23 * over, -J33 * over))
        B3 = added(scaled(J31 * over, B1), (0.0, 0.0, 0.0, J32 * over, J33 * over))
        z3 = over * (J31 * z1 - J13 * r1 + c3) - r3
        # compatibility: V_b = VA y_a + VB y_b + zV
        ta, na, ba, tb, nb, bb = (
            vector(Qa, 0), vector(Qa, 14), vector(Qa, 17), vector(Qb, 0), vector(Qb, 14), vector(Qb, 17)
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
        Mx, gx, BMx = _momentum(0, e, Qa, Qb, Rx, Ry, Rz, Ax, Ay, Az, Bx, By, Bz, rx, ry, rz, zx, zy, zz,
                                dNa, Ga, roll_a, dNb, Gb, roll_b, R1, r1, A1, B1, z1)
        My, gy, BMy = _momentum(1, e, Qa, Qb, Rx, Ry, Rz, Ax, Ay, Az, Bx, By, Bz, rx, ry, rz, zx, zy, zz,
                                dNa, Ga, roll_a, dNb, Gb, roll_b, R1, r1, A1, B1, z1)
        Mz, gz, BMz = _momentum(2, e, Qa, Qb, Rx, Ry, Rz, Ax, Ay, Az, Bx, By, Bz, rx, ry, rz, zx, zy, zz,
                                dNa, Ga, roll_a, dNb, Gb, roll_b, R1, r1, A1, B1, z1)
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
        # y_a = P y_b + ...: elimination of (eps, Sn, Sb), then of the angles
        i00, i01, i02 = My[1] * Mz[2] - My[2] * Mz[1], Mx[2] * Mz[1] - Mx[1] * Mz[2], Mx[1] * My[2] - Mx[2] * My[1]
        i10, i11, i12 = My[2] * Mz[0] - My[0] * Mz[2], Mx[0] * Mz[2] - Mx[2] * Mz[0], Mx[2] * My[0] - Mx[0] * My[2]
        i20, i21, i22 = My[0] * Mz[1] - My[1] * Mz[0], Mx[1] * Mz[0] - Mx[0] * Mz[1], Mx[0] * My[1] - Mx[1] * My[0]
        det = Mx[0] * i00 + Mx[1] * i10 + Mx[2] * i20
        if det == 0.0:
            return False
        f = 1.0 / det
        I0, I1, I2 = (f * i00, f * i01, f * i02), (f * i10, f * i11, f * i12), (f * i20, f * i21, f * i22)
        col3, col4 = (Mx[3], My[3], Mz[3]), (Mx[4], My[4], Mz[4])
        u3, u4 = (dot(I0, col3), dot(I1, col3), dot(I2, col3)), (dot(I0, col4), dot(I1, col4), dot(I2, col4))
        H0, H1, H2 = (
            combined3(I0[0], BMx, I0[1], BMy, I0[2], BMz),
            combined3(I1[0], BMx, I1[1], BMy, I1[2], BMz),
            combined3(I2[0], BMx, I2[1], BMy, I2[2], BMz),
        )
        m2, m3 = (M2[0], M2[1], M2[2]), (M3[0], M3[1], M3[2])
        s33, s34 = M2[3] - dot(m2, u3), M2[4] - dot(m2, u4)
        s43, s44 = M3[3] - dot(m3, u3), M3[4] - dot(m3, u4)
        det = s33 * s44 - s34 * s43
        if det == 0.0:
            return False
        f = 1.0 / det
        s33, s34, s43, s44 = f * s44, -f * s34, -f * s43, f * s33
        H3 = added(BM2, combined3(-m2[0], H0, -m2[1], H1, -m2[2], H2))
        H4 = added(BM3, combined3(-m3[0], H0, -m3[1], H1, -m3[2], H2))
        P3, P4 = combined(-s33, H3, -s34, H4), combined(-s43, H3, -s44, H4)
        P0 = combined3(-1.0, H0, -u3[0], P3, -u4[0], P4)
        P1 = combined3(-1.0, H1, -u3[1], P3, -u4[1], P4)
        P2 = combined3(-1.0, H2, -u3[2], P3, -u4[2], P4)
        P = (P0, P1, P2, P3, P4)
        solver = (I0, I1, I2, m2, m3, u3, u4, (s33, s34, s43, s44))
        pr = _solve_box(solver, gx, gy, gz, g2, g3)
        for i in range(5):
            put_row(E[k], 5 * i, P[i])
        put_row(E[k], _P, pr)
        if twisted:
            # the same equations with dO1 for their only known term
            y2 = over * (J21 - J12) * w1 - w2
            y3 = over * (J31 - J13) * w1 - w3
            couple = e * GI * O1
            D2 = -e * GI * (Y[a, 12] + Y[k, 12]) - couple * (w3 + y3) - EI * (y2 - w2)
            D3 = e * GI * (Y[a, 11] + Y[k, 11]) + couple * (w2 + y2) - EI * (y3 - w3)
            Ja, Jb = (Qa[32], Qa[33], Qa[34], Qa[35], Qa[36], Qa[37]), (Qb[32], Qb[33], Qb[34], Qb[35], Qb[36], Qb[37])
            w = (wx, wy, wz)
            known = mixed(w1, roll_a, -w1, roll_b)
            known = mixed(1.0, known, e, mixed(1.0, symmetric(Ja, w), 1.0, symmetric(Jb, w)))
            px = _solve_box(solver, known[0], known[1], known[2], D2, D3)
            put_row(E[k], _PX, px)
            wx, wy, wz = wx + row_dot(Ax, px), wy + row_dot(Ay, px), wz + row_dot(Az, px)
            w2, w3, w1 = y2 + row_dot(A2, px), y3 + row_dot(A3, px), w1 + row_dot(A1, px)
            E[k, _RT], E[k, _RT + 1], E[k, _RT + 2] = wx, wy, wz
            E[k, _RT + 3], E[k, _RT + 4], E[k, _RT + 5] = w2, w3, w1
        Rx, Ry, Rz = added(row_times(Ax, P), Bx), added(row_times(Ay, P), By), added(row_times(Az, P), Bz)
        R2, R3, R1 = added(row_times(A2, P), B2), added(row_times(A3, P), B3), added(row_times(A1, P), B1)
        rx, ry, rz = zx + row_dot(Ax, pr), zy + row_dot(Ay, pr), zz + row_dot(Az, pr)
        r2, r3, r1 = z2 + row_dot(A2, pr), z3 + row_dot(A3, pr), z1 + row_dot(A1, pr)
    _store_relation(E[last], Rx, Ry, Rz, R2, R3, R1, rx, ry, rz, r2, r3, r1)
    return _upper(p, tables, t, cv, in_motion, twisted, Y, C_tilde, F, Q, E) and back_substitute(E, twisted, Y, D)


@kernel
def _momentum(i, e, Qa, Qb, Rx, Ry, Rz, Ax, Ay, Az, Bx, By, Bz, rx, ry, rz, zx, zy, zz,
              dNa, Ga, roll_a, dNb, Gb, roll_b, R1, r1, A1, B1, z1):
    """Row i of the momentum equations: coefficients of y_a, the known term, coefficients of y_b."""
    if i == 0:
        u, v, w = 32, 33, 34
    elif i == 1:
        u, v, w = 33, 35, 36
    else:
        u, v, w = 34, 36, 37
    ax, ay, az, bx, by, bz = e * Qa[u], e * Qa[v], e * Qa[w], e * Qb[u], e * Qb[v], e * Qb[w]
    row = added(combined3(-ax, Rx, -ay, Ry, -az, Rz), combined3(-bx, Ax, -by, Ay, -bz, Az))
    row = combined3(1.0, row, roll_b[i], A1, -roll_a[i], R1)
    own = (dNa[0][i] + Ga[0][i], dNa[1][i], dNa[2][i], dNa[3][i] + Ga[1][i], dNa[4][i] + Ga[2][i])
    known = Qa[11 + i] - Qb[11 + i] + e * (Qa[20 + i] + Qb[20 + i]) - roll_b[i] * z1 + roll_a[i] * r1
    known += ax * rx + ay * ry + az * rz + bx * zx + by * zy + bz * zz
    above = (dNb[0][i] - Gb[0][i], dNb[1][i], dNb[2][i], dNb[3][i] - Gb[1][i], dNb[4][i] - Gb[2][i])
    above = combined3(1.0, above, roll_b[i], B1, -bx, Bx)
    return combined(1.0, row, -1.0, own), known, combined3(1.0, above, -by, By, -bz, Bz)


@kernel
def _solve_box(solver, gx, gy, gz, g2, g3):
    """y_a for one right-hand side of a box, by the factors that `sweep` has made."""
    I0, I1, I2, m2, m3, u3, u4, S = solver
    g = (gx, gy, gz)
    y0, y1, y2 = dot(I0, g), dot(I1, g), dot(I2, g)
    h3 = g2 - m2[0] * y0 - m2[1] * y1 - m2[2] * y2
    h4 = g3 - m3[0] * y0 - m3[1] * y1 - m3[2] * y2
    y3, y4 = S[0] * h3 + S[1] * h4, S[2] * h3 + S[3] * h4
    return y0 - u3[0] * y3 - u4[0] * y4, y1 - u3[1] * y3 - u4[1] * y4, y2 - u3[2] * y3 - u4[2] * y4, y3, y4


@kernel
def _store_relation(row, Rx, Ry, Rz, R2, R3, R1, rx, ry, rz, r2, r3, r1):
    """R and r of one node into its row of E."""
    put_row(row, _R, Rx)
    put_row(row, _R + 5, Ry)
    put_row(row, _R + 10, Rz)
    put_row(row, _R + 15, R2)
    put_row(row, _R + 20, R3)
    put_row(row, _R + 25, R1)
    row[_RX], row[_RX + 1], row[_RX + 2] = rx, ry, rz
    row[_RX + 3], row[_RX + 4], row[_RX + 5] = r2, r3, r1


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
    carried = quaternion_product(
        (p.carry0, p.carry1, p.carry2, p.carry3), (Y[0, 6], Y[0, 7], Y[0, 8], Y[0, 9])
    )
    # twist of the frame: what O1 leaves over; as exp(twist/2) it is exact for any number of turns
    twist = 0.5 * (twist_at(p, t) - Y[last, 10] * length)
    target = quaternion_product(carried, (math.cos(twist), math.sin(twist), 0.0, 0.0))
    r = relative(target, (Y[last, 6], Y[last, 7], Y[last, 8], Y[last, 9]))
    return 2.0 * math.atan2(r[1], r[0])


@kernel
def _upper(p, tables, t, cv, in_motion, twisted, Y, C_tilde, F, Q, E):
    """Solve the conditions of the upper end for y there, and dO1; both into E[0, 0:6]. False where singular."""
    last = Y.shape[0] - 1
    row, node = E[last], Q[last]
    residual, eN, S = upper_end_3d(
        p, tables, t, cv, in_motion, vector(node, 11), vector(Y[last], 3), vector(C_tilde[last], 3), F[last]
    )
    count = 6 if twisted else 5
    M = np.zeros((6, 7))
    R1 = row_of(row, _R + 25)
    dN, _, roll, _, _ = nodal_jacobian(node, 0.0)
    known = symmetric(S, vector(row, _RX))
    tau = symmetric(S, vector(row, _RT))
    for j in range(5):
        column = symmetric(S, (row[_R + j], row[_R + 5 + j], row[_R + 10 + j]))
        for i in range(3):
            M[i, j] = column[i]
        M[3, j], M[4, j], M[5, j] = row[_R + 15 + j], row[_R + 20 + j], R1[j]
    for i in range(3):
        for j in range(5):
            M[i, j] += eN * (dN[j][i] + roll[i] * R1[j])
        M[i, 5] = tau[i] + eN * roll[i] * row[_RT + 5]
        M[i, 6] = -residual[i] - known[i] - eN * roll[i] * row[_RX + 5]
    M[3, 5], M[4, 5], M[5, 5] = row[_RT + 3], row[_RT + 4], row[_RT + 5]
    M[3, 6], M[4, 6] = -Y[last, 11] - row[_RX + 3], -Y[last, 12] - row[_RX + 4]
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
        M[5, 6] = -_roll_to_go(p, t, length, Y) - row[_RX + 5]
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


@kernel
def back_substitute(E, twisted, Y, D):
    """From y of the upper end and dO1 in E[0, 0:6] down the line: the increments of every node, into D."""
    y = row_of(E[0], 0)
    torque = E[0, 5]
    for k in range(E.shape[0] - 1, -1, -1):
        row, out = E[k], D[k]
        out[0], out[1], out[2], out[7], out[8] = y
        out[3] = row_dot(row_of(row, _R), y) + row[_RX]
        out[4] = row_dot(row_of(row, _R + 5), y) + row[_RX + 1]
        out[5] = row_dot(row_of(row, _R + 10), y) + row[_RX + 2]
        out[10] = row_dot(row_of(row, _R + 15), y) + row[_RX + 3]
        out[11] = row_dot(row_of(row, _R + 20), y) + row[_RX + 4]
        out[6] = row_dot(row_of(row, _R + 25), y) + row[_RX + 5]
        out[9] = torque
        if twisted and k > 0:
            out[3] += torque * row[_RT]
            out[4] += torque * row[_RT + 1]
            out[5] += torque * row[_RT + 2]
            out[10] += torque * row[_RT + 3]
            out[11] += torque * row[_RT + 4]
            out[6] += torque * row[_RT + 5]
        if k > 0:
            y = (
                row_dot(row_of(row, 0), y) + row[_P], row_dot(row_of(row, 5), y) + row[_P + 1],
                row_dot(row_of(row, 10), y) + row[_P + 2], row_dot(row_of(row, 15), y) + row[_P + 3],
                row_dot(row_of(row, 20), y) + row[_P + 4],
            )
            if twisted:
                y = added(y, scaled(torque, row_of(row, _PX)))
    return True
