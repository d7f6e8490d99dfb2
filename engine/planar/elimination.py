"""One Newton update of the planar box equations by condensed elimination, at a cost linear in the nodes.

Box between nodes a (lower) and b (upper), half element length e, c0 = cq; residuals that Newton drives to zero:

    V_b - V_a - e (q_t,a + q_t,b) = 0            compatibility          o b   y_b, v_b
    phi_b - phi_a - e (kappa_a + kappa_b) = 0    curvature              |
    N_b - N_a - e (G_a + G_b) = 0                momentum               |  h = 2 e
    EI (kappa_b - kappa_a) + e (M_a + M_b) = 0   moment                 o a   y_a, v_a

Split the unknowns into y = (eps, S, phi) and v = (U, W, kappa). Below node a everything is one affine relation
v_a = R_a y_a + r_a (at the anchor v = 0: R = 0). Compatibility and curvature give v_b from (v_a, y_a, y_b); momentum
and moment then give y_a = P y_b + p through one 3 x 3 inverse, and R_b, r_b follow. At the upper end one 3 x 3 solve,
then back substitution. The inverse is an adjugate over a determinant, one division and no pivot search: row scaling
does not change it, and Newton failures were as rare as with pivoting.

Without bending S and kappa are zero, y = (eps, phi), v = (U, W), and the same steps need a 2 x 2 inverse.

E (n, 24): P (9), p (3), R (9), r (3), row-major; in the row of the anchor, which has no box below, E[0, 0:9] is the
inverse at the upper end. 2 x 2 in the same places without bending. For other right-hand sides of the same matrix
(`resolve_bent`) an E (n, 33) also takes in E[k, 24:33], the inverse of that box, and in E[0, 24:28] Dxx, Dxz, Dzx, Dzz.

In the paper: eq. (15) bending moment about b; eq. (16) balance of moments; eq. (17) compatibility; eq. (18)
compatibility, with the tangent; eq. (19) compatibility in the local frame; eq. (27) box rule: derivative along the
line.
"""

import numpy as np

from ..compiled import kernel
from ..physics.ends import planar_end
from ..physics.submergence import cap_end
from ..simd.select import smaller

WIDTH, WITH_INVERSE = 24, 33


@kernel
def sweep_bent(p, tables, t, cq, cv, in_motion, Y, C_tilde, X, F, Q, E, D):
    """Fill D (n, 6) with the Newton update; returns False where a pivot block is singular."""
    n = Y.shape[0]
    EI = p.EI
    R00 = R01 = R02 = R10 = R11 = R12 = R20 = R21 = R22 = 0.0
    r0, r1, r2 = -Y[0, 2], -Y[0, 3], -Y[0, 5]
    for i in range(12, 21):
        E[0, i] = 0.0
    least = np.inf  # of the determinants
    E[0, 21], E[0, 22], E[0, 23] = r0, r1, r2
    for k in range(1, n):
        a = k - 1
        e = 0.5 * tables[p.grid_at + a]
        ec = e * cq
        ca, sa, fa, cb, sb, fb = Q[a, 0], Q[a, 1], Q[a, 2], Q[k, 0], Q[k, 1], Q[k, 2]
        # compatibility: dV_b = (R_a + Ca) y_a + Cb y_b + ..., with Ca = ec dq/dy
        Ca0, Ca1, Ca2, Ca3 = ec * ca, -ec * Q[a, 6], ec * sa, ec * Q[a, 5]  # [x eps, x phi, z eps, z phi]
        Cb0, Cb1, Cb2, Cb3 = ec * cb, -ec * Q[k, 6], ec * sb, ec * Q[k, 5]
        cx = Y[k, 2] - Y[a, 2] - e * (Q[a, 7] + Q[k, 7])
        cz = Y[k, 3] - Y[a, 3] - e * (Q[a, 8] + Q[k, 8])
        stiff = EI / e
        turn = (Y[k, 4] - Y[a, 4]) / e - (Y[a, 5] + Y[k, 5])
        # momentum; K = e (dG/dV_a + dG/dV_b), J = e dG/dV_b
        Jxx, Jxz, Jzz = e * Q[k, 15], e * Q[k, 16], e * Q[k, 17]
        Kxx, Kxz, Kzz = e * Q[a, 15] + Jxx, e * Q[a, 16] + Jxz, e * Q[a, 17] + Jzz
        A00 = -fa * ca - e * Q[a, 11] - Kxx * R00 - Kxz * R10 - Jxx * Ca0 - Jxz * Ca2
        A01 = sa - Kxx * R01 - Kxz * R11
        A02 = Q[a, 4] - e * Q[a, 13] - Kxx * R02 - Kxz * R12 - Jxx * Ca1 - Jxz * Ca3
        A10 = -fa * sa - e * Q[a, 12] - Kxz * R00 - Kzz * R10 - Jxz * Ca0 - Jzz * Ca2
        A11 = -ca - Kxz * R01 - Kzz * R11
        A12 = -Q[a, 3] - e * Q[a, 14] - Kxz * R02 - Kzz * R12 - Jxz * Ca1 - Jzz * Ca3
        A20 = e * Q[a, 19] - 2.0 * EI * R20
        A21 = e * Q[a, 20] - 2.0 * EI * R21
        A22 = -stiff - 2.0 * EI * R22
        B00 = fb * cb - e * Q[k, 11] - Jxx * Cb0 - Jxz * Cb2
        B01 = -sb
        B02 = -Q[k, 4] - e * Q[k, 13] - Jxx * Cb1 - Jxz * Cb3
        B10 = fb * sb - e * Q[k, 12] - Jxz * Cb0 - Jzz * Cb2
        B11 = cb
        B12 = Q[k, 3] - e * Q[k, 14] - Jxz * Cb1 - Jzz * Cb3
        B20 = e * Q[k, 19]
        B21 = e * Q[k, 20]
        B22 = stiff
        g0 = Q[a, 3] - Q[k, 3] + e * (Q[a, 9] + Q[k, 9]) + Kxx * r0 + Kxz * r1 - Jxx * cx - Jxz * cz
        g1 = Q[a, 4] - Q[k, 4] + e * (Q[a, 10] + Q[k, 10]) + Kxz * r0 + Kzz * r1 - Jxz * cx - Jzz * cz
        g2 = -EI * (Y[k, 5] - Y[a, 5]) - e * (Q[a, 18] + Q[k, 18]) - EI * turn + 2.0 * EI * r2
        # inverse of A
        i00, i01, i02 = A11 * A22 - A12 * A21, A02 * A21 - A01 * A22, A01 * A12 - A02 * A11
        i10, i11, i12 = A12 * A20 - A10 * A22, A00 * A22 - A02 * A20, A02 * A10 - A00 * A12
        i20, i21, i22 = A10 * A21 - A11 * A20, A01 * A20 - A00 * A21, A00 * A11 - A01 * A10
        det = A00 * i00 + A01 * i10 + A02 * i20
        least = smaller(least, abs(det))
        f = 1.0 / det
        i00, i01, i02, i10, i11, i12 = f * i00, f * i01, f * i02, f * i10, f * i11, f * i12
        i20, i21, i22 = f * i20, f * i21, f * i22
        if E.shape[1] > WIDTH:
            E[k, 24], E[k, 25], E[k, 26], E[k, 27], E[k, 28], E[k, 29] = i00, i01, i02, i10, i11, i12
            E[k, 30], E[k, 31], E[k, 32] = i20, i21, i22
        P00 = -(i00 * B00 + i01 * B10 + i02 * B20)
        P01 = -(i00 * B01 + i01 * B11 + i02 * B21)
        P02 = -(i00 * B02 + i01 * B12 + i02 * B22)
        P10 = -(i10 * B00 + i11 * B10 + i12 * B20)
        P11 = -(i10 * B01 + i11 * B11 + i12 * B21)
        P12 = -(i10 * B02 + i11 * B12 + i12 * B22)
        P20 = -(i20 * B00 + i21 * B10 + i22 * B20)
        P21 = -(i20 * B01 + i21 * B11 + i22 * B21)
        P22 = -(i20 * B02 + i21 * B12 + i22 * B22)
        p0 = i00 * g0 + i01 * g1 + i02 * g2
        p1 = i10 * g0 + i11 * g1 + i12 * g2
        p2 = i20 * g0 + i21 * g1 + i22 * g2
        E[k, 0], E[k, 1], E[k, 2], E[k, 3], E[k, 4], E[k, 5] = P00, P01, P02, P10, P11, P12
        E[k, 6], E[k, 7], E[k, 8], E[k, 9], E[k, 10], E[k, 11] = P20, P21, P22, p0, p1, p2
        # v_b = R_b y_b + r_b
        X00, X01, X02 = R00 + Ca0, R01, R02 + Ca1
        X10, X11, X12 = R10 + Ca2, R11, R12 + Ca3
        X20, X21, X22 = -R20, -R21, -R22 - 1.0 / e
        R00, R01, R02 = (
            X00 * P00 + X01 * P10 + X02 * P20 + Cb0,
            X00 * P01 + X01 * P11 + X02 * P21,
            X00 * P02 + X01 * P12 + X02 * P22 + Cb1,
        )
        R10, R11, R12 = (
            X10 * P00 + X11 * P10 + X12 * P20 + Cb2,
            X10 * P01 + X11 * P11 + X12 * P21,
            X10 * P02 + X11 * P12 + X12 * P22 + Cb3,
        )
        R20, R21, R22 = (
            X20 * P00 + X21 * P10 + X22 * P20,
            X20 * P01 + X21 * P11 + X22 * P21,
            X20 * P02 + X21 * P12 + X22 * P22 + 1.0 / e,
        )
        r0 = X00 * p0 + X01 * p1 + X02 * p2 + r0 - cx
        r1 = X10 * p0 + X11 * p1 + X12 * p2 + r1 - cz
        r2 = X20 * p0 + X21 * p1 + X22 * p2 - r2 + turn
        E[k, 12], E[k, 13], E[k, 14], E[k, 15], E[k, 16], E[k, 17] = R00, R01, R02, R10, R11, R12
        E[k, 18], E[k, 19], E[k, 20], E[k, 21], E[k, 22], E[k, 23] = R20, R21, R22, r0, r1, r2
    # upper end: e_N dN + D dV = -e, dkappa = -kappa
    b = n - 1
    ex, ez, eN, Dxx, Dxz, Dzz = planar_end(
        p, tables, t, cv, in_motion, Q[b, 3], Q[b, 4], Y[b, 2], Y[b, 3], C_tilde[b, 2], C_tilde[b, 3], F[b]
    )
    Dzx = Dxz
    if p.spherical_cap:
        more = cap_end(p, t, cq, cv, in_motion, X[b, 0], X[b, 1], Y[b, 2], Y[b, 3], C_tilde[b, 2], C_tilde[b, 3], F[b])
        ex, ez, Dxx = ex + more[0], ez + more[1], Dxx + more[2]
        Dxz, Dzx, Dzz = Dxz + more[3], Dzx + more[4], Dzz + more[5]
    c, s, slope = Q[b, 0], Q[b, 1], Q[b, 2]
    A00 = eN * slope * c + Dxx * R00 + Dxz * R10
    A01 = -eN * s + Dxx * R01 + Dxz * R11
    A02 = -eN * Q[b, 4] + Dxx * R02 + Dxz * R12
    A10 = eN * slope * s + Dzx * R00 + Dzz * R10
    A11 = eN * c + Dzx * R01 + Dzz * R11
    A12 = eN * Q[b, 3] + Dzx * R02 + Dzz * R12
    g0 = -ex - Dxx * r0 - Dxz * r1
    g1 = -ez - Dzx * r0 - Dzz * r1
    g2 = -Y[b, 5] - r2
    i00, i01, i02 = A11 * R22 - A12 * R21, A02 * R21 - A01 * R22, A01 * A12 - A02 * A11
    i10, i11, i12 = A12 * R20 - A10 * R22, A00 * R22 - A02 * R20, A02 * A10 - A00 * A12
    i20, i21, i22 = A10 * R21 - A11 * R20, A01 * R20 - A00 * R21, A00 * A11 - A01 * A10
    det = A00 * i00 + A01 * i10 + A02 * i20
    least = smaller(least, abs(det))
    f = 1.0 / det
    E[0, 0], E[0, 1], E[0, 2], E[0, 3], E[0, 4], E[0, 5] = f * i00, f * i01, f * i02, f * i10, f * i11, f * i12
    E[0, 6], E[0, 7], E[0, 8] = f * i20, f * i21, f * i22
    if E.shape[1] > WIDTH:
        E[0, 24], E[0, 25], E[0, 26], E[0, 27] = Dxx, Dxz, Dzx, Dzz
    back_substitute(E, g0, g1, g2, D)
    return least != 0.0


@kernel
def back_substitute(E, g0, g1, g2, D):
    """From the right-hand side at the upper end down the line: y and v of every node, into D."""
    y0 = E[0, 0] * g0 + E[0, 1] * g1 + E[0, 2] * g2
    y1 = E[0, 3] * g0 + E[0, 4] * g1 + E[0, 5] * g2
    y2 = E[0, 6] * g0 + E[0, 7] * g1 + E[0, 8] * g2
    for k in range(E.shape[0] - 1, -1, -1):
        D[k, 0], D[k, 1], D[k, 4] = y0, y1, y2
        D[k, 2] = E[k, 12] * y0 + E[k, 13] * y1 + E[k, 14] * y2 + E[k, 21]
        D[k, 3] = E[k, 15] * y0 + E[k, 16] * y1 + E[k, 17] * y2 + E[k, 22]
        D[k, 5] = E[k, 18] * y0 + E[k, 19] * y1 + E[k, 20] * y2 + E[k, 23]
        y0, y1, y2 = (
            E[k, 0] * y0 + E[k, 1] * y1 + E[k, 2] * y2 + E[k, 9],
            E[k, 3] * y0 + E[k, 4] * y1 + E[k, 5] * y2 + E[k, 10],
            E[k, 6] * y0 + E[k, 7] * y1 + E[k, 8] * y2 + E[k, 11],
        )
