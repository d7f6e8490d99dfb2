"""One Newton update of the planar box equations by condensed elimination, at a cost linear in the nodes.

Box between nodes a = k - 1 (lower) and b = k (upper), half element length e; residuals that Newton drives to zero:

    V_b - V_a - e (q_t,a + q_t,b) = 0            compatibility          o b   y_b, v_b
    phi_b - phi_a - e (kappa_a + kappa_b) = J    curvature              |
    N_b - N_a - e (G_a + G_b) = 0                momentum               |  h = 2 e
    EI (kappa_b - kappa_a) + e (M_a + M_b) = 0   moment                 o a   y_a, v_a

J is 0, except while a loop is released (column TURN of Q). The updates of a node are split into y, of (eps, S, phi),
and v, of (U, W, kappa). The elimination goes up the line, box by box:

1. All that lies below node a is one affine relation v_a = R_a y_a + r_a. At the anchor v = 0, so R = 0.
2. Compatibility and curvature of the box give v_b from v_a, y_a and y_b.
3. Momentum and moment then give y_a = P y_b + p, through one 3 x 3 inverse.
4. Put into 2, this is the relation of node b, v_b = R_b y_b + r_b.

At the upper end one 3 x 3 solve gives y there, and back substitution goes down the line. In the code c, s, f are
cos phi, sin phi, dT/deps of a node; cx, cz and turn are the residuals of compatibility and curvature; R and r belong to
node a until the end of the box, where they become those of b.

Without bending the moment equation is S_a + S_b = 0 (`engine.planar.node`) and the condition of moment at the upper end
S = 0, so that S is zero everywhere, and kappa, which nothing else needs, is put to zero. Well posed while the tether is
in tension only (compression: EI = 0 is ill-posed, Triantafyllou & Howell 1994).

E (n, 24): columns in `engine.planar.columns`. For other right-hand sides of the same matrix
(`engine.perturbations.tangent`) an E (n, 33) also takes in the inverse of every box, and D = (Dxx, Dxz, Dzx, Dzz), to
which is added what it holds in the place of D.

In the paper: eq. (15) bending moment about b; eq. (16) balance of moments; eq. (17) compatibility; eq. (18)
compatibility, with the tangent; eq. (19) compatibility in the local frame; eq. (27) box rule: derivative along the
line.
"""

import numpy as np

from ..compiled import kernel
from ..physics.ends import planar_end
from ..physics.submergence import end_of_cap
from ..simd.select import smaller
from ..spatial.vectors import (
    affine,
    inverted,
    less,
    minus_product,
    pair,
    put,
    put_quaternion,
    put_rows,
    quaternion,
    rows_of,
    times,
    vector,
    vector_times,
)
from . import columns as col
from .extras import force_by_turn


@kernel
def eliminate(p, tables, stage, Y, work):
    """Fill work.D (n, 6) with the Newton update; returns False where a pivot block is singular. No D where E is wide.

    p, tables: parameters (`engine.record`); stage: Stage; Y (n, 6); work: Work, whose Q, F and X belong to Y.
    """
    Q, E, D, cq = work.Q, work.E, work.D, stage.cq
    n = Y.shape[0]
    EI = p.EI
    R = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    r = -Y[0, col.VX], -Y[0, col.VZ], -Y[0, col.KAPPA]
    put_rows(E[0], col.R, R)
    put(E[0], col.R_KNOWN, r)
    wide, least = E.shape[1] > col.BOX_WIDTH, np.inf  # least: of the determinants
    for k in range(1, n):
        a = k - 1
        e = 0.5 * tables[p.grid_at + a]
        Ya, Yb, Qa, Qb, row = Y[a], Y[k], Q[a], Q[k], E[k]
        ca, sa, fa = vector(Qa, col.COS)
        cb, sb, fb = vector(Qb, col.COS)
        # compatibility: dV_b = (R_a + Ca) y_a + Cb y_b + r - (cx, cz), with Ca = e cq dq/dy by eps and phi
        Cax, Caz = _of_stretch(Qa, e * cq)
        Cbx, Cbz = _of_stretch(Qb, e * cq)
        # curvature: dkappa_b = (dphi_b - dphi_a)/e - dkappa_a + turn
        stiff = EI / e
        # momentum; K = e (dG/dV_a + dG/dV_b), J = e dG/dV_b
        (Kxx, Kxz, Kzx, Kzz), (Jxx, Jxz, Jzx, Jzz) = inertia_of_box(e, Qa, Qb)
        # A y_a + B y_b = g: momentum along x and z, then moment, with v_a and v_b put in
        (Nz_a, Nx_a), (Nz_b, Nx_b) = force_by_turn(p, Qa), force_by_turn(p, Qb)
        Ax = -fa * ca - e * Qa[col.GX_EPS], sa, Nz_a - e * Qa[col.GX_PHI]
        Az = -fa * sa - e * Qa[col.GZ_EPS], -ca, -Nx_a - e * Qa[col.GZ_PHI]
        Ax = _less_stretch(less(Ax, Kxx, R[0], Kxz, R[1]), Jxx, Cax, Jxz, Caz)
        Az = _less_stretch(less(Az, Kzx, R[0], Kzz, R[1]), Jzx, Cax, Jzz, Caz)
        Ak = (
            e * Qa[col.M_EPS] - 2.0 * EI * R[2][0],
            e * Qa[col.M_SHEAR] - 2.0 * EI * R[2][1],
            -stiff - 2.0 * EI * R[2][2],
        )
        Bx = fb * cb - e * Qb[col.GX_EPS], -sb, -Nz_b - e * Qb[col.GX_PHI]
        Bz = fb * sb - e * Qb[col.GZ_EPS], cb, Nx_b - e * Qb[col.GZ_PHI]
        Bx, Bz = _less_stretch(Bx, Jxx, Cbx, Jxz, Cbz), _less_stretch(Bz, Jzx, Cbx, Jzz, Cbz)
        Bk = e * Qb[col.M_EPS], e * Qb[col.M_SHEAR], stiff
        # y_a = P y_b + p
        inverse, det = inverted(Ax, Az, Ak)
        least = smaller(least, abs(det))
        P = minus_product(inverse, (Bx, Bz, Bk))
        put_rows(row, col.P, P)
        # v_b = R_b y_b + r
        Xx, Xz = _plus_stretch(R[0], Cax), _plus_stretch(R[1], Caz)
        Xk = -R[2][0], -R[2][1], -R[2][2] - 1.0 / e
        Rk = vector_times(Xk, P)
        R = (
            _plus_stretch(vector_times(Xx, P), Cbx),
            _plus_stretch(vector_times(Xz, P), Cbz),
            (Rk[0], Rk[1], Rk[2] + 1.0 / e),
        )
        put_rows(row, col.R, R)
        if wide:
            put_rows(row, col.INVERSE, inverse)
            continue
        cx = Yb[col.VX] - Ya[col.VX] - e * (Qa[col.QX_T] + Qb[col.QX_T])
        cz = Yb[col.VZ] - Ya[col.VZ] - e * (Qa[col.QZ_T] + Qb[col.QZ_T])
        turn = (Yb[col.PHI] - Ya[col.PHI] - Qb[col.TURN]) / e - (Ya[col.KAPPA] + Yb[col.KAPPA])
        g = (
            Qa[col.NX] - Qb[col.NX] + e * (Qa[col.GX] + Qb[col.GX]) + Kxx * r[0] + Kxz * r[1] - Jxx * cx - Jxz * cz,
            Qa[col.NZ] - Qb[col.NZ] + e * (Qa[col.GZ] + Qb[col.GZ]) + Kzx * r[0] + Kzz * r[1] - Jzx * cx - Jzz * cz,
            -EI * (Yb[col.KAPPA] - Ya[col.KAPPA]) - e * (Qa[col.M] + Qb[col.M]) - EI * turn + 2.0 * EI * r[2],
        )
        known = times(inverse, g)
        by_known = times((Xx, Xz, Xk), known)
        r = by_known[0] + r[0] - cx, by_known[1] + r[1] - cz, by_known[2] - r[2] + turn
        put(row, col.P_KNOWN, known)
        put(row, col.R_KNOWN, r)
    # upper end (`engine.physics.ends`): eN dN + D dV = -(ex, ez), dkappa = -kappa, with v = R y + r put in
    b = n - 1
    N, V, V_tilde = pair(Q[b], col.NX), pair(Y[b], col.VX), pair(work.C_tilde[b], col.VX)
    ex, ez, eN, Dxx, Dxz, Dzz = planar_end(p, tables, stage, N, V, V_tilde, work.F[b])
    Dzx = Dxz
    if p.spherical_cap:
        cap = end_of_cap(p, stage, work.X[b], V, V_tilde, work.F[b], work.sea)
        ex, ez, Dxx = ex + cap[0], ez + cap[1], Dxx + cap[2]
        Dxz, Dzx, Dzz = Dxz + cap[3], Dzx + cap[4], Dzz + cap[5]
    if wide:
        by_place = quaternion(E[0], col.TOP_DXX)
        Dxx, Dxz, Dzx, Dzz = Dxx + by_place[0], Dxz + by_place[1], Dzx + by_place[2], Dzz + by_place[3]
        put_quaternion(E[0], col.TOP_DXX, (Dxx, Dxz, Dzx, Dzz))
    c, s, slope = vector(Q[b], col.COS)
    Nz, Nx = force_by_turn(p, Q[b])
    (R00, R01, R02), (R10, R11, R12), Ak = R
    Ax = (
        eN * slope * c + Dxx * R00 + Dxz * R10,
        -eN * s + Dxx * R01 + Dxz * R11,
        -eN * Nz + Dxx * R02 + Dxz * R12,
    )
    Az = (
        eN * slope * s + Dzx * R00 + Dzz * R10,
        eN * c + Dzx * R01 + Dzz * R11,
        eN * Nx + Dzx * R02 + Dzz * R12,
    )
    g2 = -Y[b, col.KAPPA] - r[2]
    if p.bent == 0:
        Ak, g2 = (0.0, 1.0, 0.0), 0.0
    inverse, det = inverted(Ax, Az, Ak)
    least = smaller(least, abs(det))
    put_rows(E[0], col.TOP, inverse)
    if not wide:
        back_substitute(E, (-ex - Dxx * r[0] - Dxz * r[1], -ez - Dzx * r[0] - Dzz * r[1], g2), D)
    if p.bent == 0:
        for k in range(n):
            D[k, col.KAPPA] = 0.0
    return least != 0.0


@kernel
def inertia_of_box(e, Qa, Qb):
    """K = e (dG/dV_a + dG/dV_b) and J = e dG/dV_b of a box of half length e (m), each as xx, xz, zx, zz."""
    below, above = quaternion(Qa, col.GXX), quaternion(Qb, col.GXX)
    Jxx, Jxz, Jzx, Jzz = e * above[0], e * above[1], e * above[2], e * above[3]
    K = e * below[0] + Jxx, e * below[1] + Jxz, e * below[2] + Jzx, e * below[3] + Jzz
    return K, (Jxx, Jxz, Jzx, Jzz)


@kernel
def _of_stretch(row, ec):
    """ec dq/dy of a node, by eps and phi (q does not depend on S): along x and along z."""
    return (ec * row[col.COS], -ec * row[col.QZ]), (ec * row[col.SIN], ec * row[col.QX])


@kernel
def _plus_stretch(row, C):
    """row + C, where C has no entry for S."""
    return row[0] + C[0], row[1], row[2] + C[1]


@kernel
def _less_stretch(row, Jx, Cx, Jz, Cz):
    """row - Jx Cx - Jz Cz, where C has no entry for S."""
    return row[0] - Jx * Cx[0] - Jz * Cz[0], row[1], row[2] - Jx * Cx[1] - Jz * Cz[1]


@kernel
def back_substitute(E, g, D):
    """From the right-hand side g (3) at the upper end down the line: updates of y and v of every node, into D."""
    y = times(rows_of(E[0], col.TOP), g)
    for k in range(E.shape[0] - 1, -1, -1):
        row, out = E[k], D[k]
        out[col.EPS], out[col.SHEAR], out[col.PHI] = y
        out[col.VX], out[col.VZ], out[col.KAPPA] = affine(rows_of(row, col.R), y, vector(row, col.R_KNOWN))
        y = affine(rows_of(row, col.P), y, vector(row, col.P_KNOWN))  # of the node below; at k = 0 of no meaning
