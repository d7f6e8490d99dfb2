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

Without bending the moment equation is S_a + S_b = 0 (`engine.planar.node`) and the condition of moment at the upper end
S = 0, so that S is zero everywhere, and kappa, which nothing else needs, is put to zero. Well posed while the tether is
in tension only (compression: EI = 0 is ill-posed, Triantafyllou & Howell 1994).

E (n, 24): P, p, R, r, where `engine.planar.columns` says; the row of the anchor, which has no box below, holds the
inverse at the upper end. For other right-hand sides of the same matrix (`engine.perturbations.tangent`) an E (n, 33)
also takes in the inverse of every box, and Dxx, Dxz, Dzx, Dzz.

In the paper: eq. (15) bending moment about b; eq. (16) balance of moments; eq. (17) compatibility; eq. (18)
compatibility, with the tangent; eq. (19) compatibility in the local frame; eq. (27) box rule: derivative along the
line.
"""

import numpy as np

from ..compiled import kernel
from ..physics.ends import planar_end
from ..physics.submergence import cap_end
from ..simd.elementary import put3, row_times, take3
from ..simd.select import smaller
from . import columns as col


@kernel
def eliminate(p, tables, stage, Y, work):
    """Fill work.D (n, 6) with the Newton update; returns False where a pivot block is singular.

    p, tables: parameters (`engine.record`); stage: Stage; Y (n, 6); work: Work, whose Q, F and X belong to Y.
    """
    Q, E, D, cq = work.Q, work.E, work.D, stage.cq
    n = Y.shape[0]
    EI = p.EI
    R00 = R01 = R02 = R10 = R11 = R12 = R20 = R21 = R22 = 0.0
    r0, r1, r2 = -Y[0, col.VX], -Y[0, col.VZ], -Y[0, col.KAPPA]
    for i in range(col.R, col.R_KNOWN):
        E[0, i] = 0.0
    put3(E, 0, col.R_KNOWN, r0, r1, r2)
    least = np.inf  # of the determinants
    for k in range(1, n):
        a = k - 1
        e = 0.5 * tables[p.grid_at + a]
        ec = e * cq
        ca, sa, fa = take3(Q, a, col.COS)
        cb, sb, fb = take3(Q, k, col.COS)
        # compatibility: dV_b = (R_a + Ca) y_a + Cb y_b + ..., with Ca = ec dq/dy
        Ca0, Ca1, Ca2, Ca3 = ec * ca, -ec * Q[a, col.QZ], ec * sa, ec * Q[a, col.QX]  # [x eps, x phi, z eps, z phi]
        Cb0, Cb1, Cb2, Cb3 = ec * cb, -ec * Q[k, col.QZ], ec * sb, ec * Q[k, col.QX]
        cx = Y[k, col.VX] - Y[a, col.VX] - e * (Q[a, col.QX_T] + Q[k, col.QX_T])
        cz = Y[k, col.VZ] - Y[a, col.VZ] - e * (Q[a, col.QZ_T] + Q[k, col.QZ_T])
        # curvature: kappa_b in the same way
        stiff = EI / e
        turn = (Y[k, col.PHI] - Y[a, col.PHI]) / e - (Y[a, col.KAPPA] + Y[k, col.KAPPA])
        # momentum; K = e (dG/dV_a + dG/dV_b), J = e dG/dV_b
        Jxx, Jxz, Jzz = e * Q[k, col.GXX], e * Q[k, col.GXZ], e * Q[k, col.GZZ]
        Kxx, Kxz, Kzz = e * Q[a, col.GXX] + Jxx, e * Q[a, col.GXZ] + Jxz, e * Q[a, col.GZZ] + Jzz
        # A y_a + B y_b = g: momentum along x and z, then moment, with v_a and v_b put in
        A00 = -fa * ca - e * Q[a, col.GX_EPS] - Kxx * R00 - Kxz * R10 - Jxx * Ca0 - Jxz * Ca2
        A01 = sa - Kxx * R01 - Kxz * R11
        A02 = Q[a, col.NZ] - e * Q[a, col.GX_PHI] - Kxx * R02 - Kxz * R12 - Jxx * Ca1 - Jxz * Ca3
        A10 = -fa * sa - e * Q[a, col.GZ_EPS] - Kxz * R00 - Kzz * R10 - Jxz * Ca0 - Jzz * Ca2
        A11 = -ca - Kxz * R01 - Kzz * R11
        A12 = -Q[a, col.NX] - e * Q[a, col.GZ_PHI] - Kxz * R02 - Kzz * R12 - Jxz * Ca1 - Jzz * Ca3
        A20 = e * Q[a, col.M_EPS] - 2.0 * EI * R20
        A21 = e * Q[a, col.M_SHEAR] - 2.0 * EI * R21
        A22 = -stiff - 2.0 * EI * R22
        B00 = fb * cb - e * Q[k, col.GX_EPS] - Jxx * Cb0 - Jxz * Cb2
        B01 = -sb
        B02 = -Q[k, col.NZ] - e * Q[k, col.GX_PHI] - Jxx * Cb1 - Jxz * Cb3
        B10 = fb * sb - e * Q[k, col.GZ_EPS] - Jxz * Cb0 - Jzz * Cb2
        B11 = cb
        B12 = Q[k, col.NX] - e * Q[k, col.GZ_PHI] - Jxz * Cb1 - Jzz * Cb3
        B20 = e * Q[k, col.M_EPS]
        B21 = e * Q[k, col.M_SHEAR]
        B22 = stiff
        g0 = Q[a, col.NX] - Q[k, col.NX] + e * (Q[a, col.GX] + Q[k, col.GX]) + Kxx * r0 + Kxz * r1 - Jxx * cx - Jxz * cz
        g1 = Q[a, col.NZ] - Q[k, col.NZ] + e * (Q[a, col.GZ] + Q[k, col.GZ]) + Kxz * r0 + Kzz * r1 - Jxz * cx - Jzz * cz
        g2 = -EI * (Y[k, col.KAPPA] - Y[a, col.KAPPA]) - e * (Q[a, col.M] + Q[k, col.M]) - EI * turn + 2.0 * EI * r2
        # inverse of A
        (i00, i01, i02), (i10, i11, i12), (i20, i21, i22), det = adjugate(
            (A00, A01, A02), (A10, A11, A12), (A20, A21, A22)
        )
        least = smaller(least, abs(det))
        f = 1.0 / det
        i00, i01, i02, i10, i11, i12 = f * i00, f * i01, f * i02, f * i10, f * i11, f * i12
        i20, i21, i22 = f * i20, f * i21, f * i22
        if E.shape[1] > col.BOX_WIDTH:
            put3(E, k, col.INVERSE, i00, i01, i02)
            put3(E, k, col.INVERSE + 3, i10, i11, i12)
            put3(E, k, col.INVERSE + 6, i20, i21, i22)
        # y_a = P y_b + p
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
        put3(E, k, col.P, P00, P01, P02)
        put3(E, k, col.P + 3, P10, P11, P12)
        put3(E, k, col.P + 6, P20, P21, P22)
        put3(E, k, col.P_KNOWN, p0, p1, p2)
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
        put3(E, k, col.R, R00, R01, R02)
        put3(E, k, col.R + 3, R10, R11, R12)
        put3(E, k, col.R + 6, R20, R21, R22)
        put3(E, k, col.R_KNOWN, r0, r1, r2)
    # upper end (`engine.physics.ends`): e_N dN + D dV = -e, dkappa = -kappa, with v = R y + r put in
    b = n - 1
    t, in_motion, _, cv = stage
    U, W, U_tilde, W_tilde = Y[b, col.VX], Y[b, col.VZ], work.C_tilde[b, col.VX], work.C_tilde[b, col.VZ]
    ex, ez, eN, Dxx, Dxz, Dzz = planar_end(
        p, tables, t, cv, in_motion, Q[b, col.NX], Q[b, col.NZ], U, W, U_tilde, W_tilde, work.F[b]
    )
    Dzx = Dxz
    if p.spherical_cap:
        x, z = work.X[b, 0], work.X[b, 1]
        more = cap_end(p, t, cq, cv, in_motion, x, z, U, W, U_tilde, W_tilde, work.F[b])
        ex, ez, Dxx = ex + more[0], ez + more[1], Dxx + more[2]
        Dxz, Dzx, Dzz = Dxz + more[3], Dzx + more[4], Dzz + more[5]
    c, s, slope = take3(Q, b, col.COS)
    A00 = eN * slope * c + Dxx * R00 + Dxz * R10
    A01 = -eN * s + Dxx * R01 + Dxz * R11
    A02 = -eN * Q[b, col.NZ] + Dxx * R02 + Dxz * R12
    A10 = eN * slope * s + Dzx * R00 + Dzz * R10
    A11 = eN * c + Dzx * R01 + Dzz * R11
    A12 = eN * Q[b, col.NX] + Dzx * R02 + Dzz * R12
    g0 = -ex - Dxx * r0 - Dxz * r1
    g1 = -ez - Dzx * r0 - Dzz * r1
    g2 = -Y[b, col.KAPPA] - r2
    if p.bent == 0:
        R20, R21, R22, g2 = 0.0, 1.0, 0.0, 0.0
    (i00, i01, i02), (i10, i11, i12), (i20, i21, i22), det = adjugate((A00, A01, A02), (A10, A11, A12), (R20, R21, R22))
    least = smaller(least, abs(det))
    f = 1.0 / det
    put3(E, 0, col.TOP, f * i00, f * i01, f * i02)
    put3(E, 0, col.TOP + 3, f * i10, f * i11, f * i12)
    put3(E, 0, col.TOP + 6, f * i20, f * i21, f * i22)
    if E.shape[1] > col.BOX_WIDTH:
        E[0, col.TOP_DXX], E[0, col.TOP_DXZ], E[0, col.TOP_DZX], E[0, col.TOP_DZZ] = Dxx, Dxz, Dzx, Dzz
    back_substitute(E, g0, g1, g2, D)
    if p.bent == 0:
        for k in range(n):
            D[k, col.KAPPA] = 0.0
    return least != 0.0


@kernel
def adjugate(A0, A1, A2):
    """Adjugate (three rows) and determinant of the 3 x 3 matrix with these rows: A times it is the determinant."""
    (A00, A01, A02), (A10, A11, A12), (A20, A21, A22) = A0, A1, A2
    i00, i01, i02 = A11 * A22 - A12 * A21, A02 * A21 - A01 * A22, A01 * A12 - A02 * A11
    i10, i11, i12 = A12 * A20 - A10 * A22, A00 * A22 - A02 * A20, A02 * A10 - A00 * A12
    i20, i21, i22 = A10 * A21 - A11 * A20, A01 * A20 - A00 * A21, A00 * A11 - A01 * A10
    return (i00, i01, i02), (i10, i11, i12), (i20, i21, i22), A00 * i00 + A01 * i10 + A02 * i20


@kernel
def back_substitute(E, g0, g1, g2, D):
    """From the right-hand side at the upper end down the line: y and v of every node, into D."""
    y0 = row_times(E, 0, col.TOP, g0, g1, g2)
    y1 = row_times(E, 0, col.TOP + 3, g0, g1, g2)
    y2 = row_times(E, 0, col.TOP + 6, g0, g1, g2)
    for k in range(E.shape[0] - 1, -1, -1):
        D[k, col.EPS], D[k, col.SHEAR], D[k, col.PHI] = y0, y1, y2
        D[k, col.VX] = row_times(E, k, col.R, y0, y1, y2) + E[k, col.R_KNOWN]
        D[k, col.VZ] = row_times(E, k, col.R + 3, y0, y1, y2) + E[k, col.R_KNOWN + 1]
        D[k, col.KAPPA] = row_times(E, k, col.R + 6, y0, y1, y2) + E[k, col.R_KNOWN + 2]
        y0, y1, y2 = (
            row_times(E, k, col.P, y0, y1, y2) + E[k, col.P_KNOWN],
            row_times(E, k, col.P + 3, y0, y1, y2) + E[k, col.P_KNOWN + 1],
            row_times(E, k, col.P + 6, y0, y1, y2) + E[k, col.P_KNOWN + 2],
        )
