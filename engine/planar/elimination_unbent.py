"""The elimination of `engine.planar.elimination` for a tether without bending: y = (eps, phi), v = (U, W), 2 x 2
blocks.

Well posed while the tether is in tension only (compression: EI = 0 is ill-posed, Triantafyllou & Howell 1994).
"""

import numpy as np

from ..compiled import kernel
from ..simd.select import smaller
from . import columns as col
from .elimination import upper_condition

P, P_KNOWN, R, R_KNOWN = 0, 4, 6, 10  # columns of E: 2 x 2 row by row, and 2, twice


@kernel
def eliminate_unbent(p, tables, stage, Y, work):
    """Fill work.D (n, 6) with the Newton update, zeros for S and kappa; returns False where a block is singular.

    Arguments as for `engine.planar.elimination.eliminate_bent`.
    """
    Q, E, D, cq = work.Q, work.E, work.D, stage.cq
    n = Y.shape[0]
    R00 = R01 = R10 = R11 = 0.0
    r0, r1 = -Y[0, col.VX], -Y[0, col.VZ]
    for i in range(R, R_KNOWN):
        E[0, i] = 0.0
    E[0, R_KNOWN], E[0, R_KNOWN + 1] = r0, r1
    least = np.inf  # of the determinants
    for k in range(1, n):
        a = k - 1
        e = 0.5 * tables[p.grid_at + a]
        ec = e * cq
        ca, sa, fa = Q[a, col.COS], Q[a, col.SIN], Q[a, col.SLOPE]
        cb, sb, fb = Q[k, col.COS], Q[k, col.SIN], Q[k, col.SLOPE]
        # compatibility: dV_b = (R_a + Ca) y_a + Cb y_b + ...
        Ca0, Ca1, Ca2, Ca3 = ec * ca, -ec * Q[a, col.QZ], ec * sa, ec * Q[a, col.QX]
        Cb0, Cb1, Cb2, Cb3 = ec * cb, -ec * Q[k, col.QZ], ec * sb, ec * Q[k, col.QX]
        cx = Y[k, col.VX] - Y[a, col.VX] - e * (Q[a, col.QX_T] + Q[k, col.QX_T])
        cz = Y[k, col.VZ] - Y[a, col.VZ] - e * (Q[a, col.QZ_T] + Q[k, col.QZ_T])
        # momentum, A y_a + B y_b = g; K = e (dG/dV_a + dG/dV_b), J = e dG/dV_b
        Jxx, Jxz, Jzz = e * Q[k, col.GXX], e * Q[k, col.GXZ], e * Q[k, col.GZZ]
        Kxx, Kxz, Kzz = e * Q[a, col.GXX] + Jxx, e * Q[a, col.GXZ] + Jxz, e * Q[a, col.GZZ] + Jzz
        A00 = -fa * ca - e * Q[a, col.GX_EPS] - Kxx * R00 - Kxz * R10 - Jxx * Ca0 - Jxz * Ca2
        A01 = Q[a, col.NZ] - e * Q[a, col.GX_PHI] - Kxx * R01 - Kxz * R11 - Jxx * Ca1 - Jxz * Ca3
        A10 = -fa * sa - e * Q[a, col.GZ_EPS] - Kxz * R00 - Kzz * R10 - Jxz * Ca0 - Jzz * Ca2
        A11 = -Q[a, col.NX] - e * Q[a, col.GZ_PHI] - Kxz * R01 - Kzz * R11 - Jxz * Ca1 - Jzz * Ca3
        B00 = fb * cb - e * Q[k, col.GX_EPS] - Jxx * Cb0 - Jxz * Cb2
        B01 = -Q[k, col.NZ] - e * Q[k, col.GX_PHI] - Jxx * Cb1 - Jxz * Cb3
        B10 = fb * sb - e * Q[k, col.GZ_EPS] - Jxz * Cb0 - Jzz * Cb2
        B11 = Q[k, col.NX] - e * Q[k, col.GZ_PHI] - Jxz * Cb1 - Jzz * Cb3
        g0 = Q[a, col.NX] - Q[k, col.NX] + e * (Q[a, col.GX] + Q[k, col.GX]) + Kxx * r0 + Kxz * r1 - Jxx * cx - Jxz * cz
        g1 = Q[a, col.NZ] - Q[k, col.NZ] + e * (Q[a, col.GZ] + Q[k, col.GZ]) + Kxz * r0 + Kzz * r1 - Jxz * cx - Jzz * cz
        # y_a = P y_b + p
        det = A00 * A11 - A01 * A10
        least = smaller(least, abs(det))
        f = 1.0 / det
        P00, P01 = f * (A01 * B10 - A11 * B00), f * (A01 * B11 - A11 * B01)
        P10, P11 = f * (A10 * B00 - A00 * B10), f * (A10 * B01 - A00 * B11)
        p0, p1 = f * (A11 * g0 - A01 * g1), f * (A00 * g1 - A10 * g0)
        # v_b = R_b y_b + r_b
        X00, X01, X10, X11 = R00 + Ca0, R01 + Ca1, R10 + Ca2, R11 + Ca3
        R00, R01 = X00 * P00 + X01 * P10 + Cb0, X00 * P01 + X01 * P11 + Cb1
        R10, R11 = X10 * P00 + X11 * P10 + Cb2, X10 * P01 + X11 * P11 + Cb3
        r0, r1 = X00 * p0 + X01 * p1 + r0 - cx, X10 * p0 + X11 * p1 + r1 - cz
        E[k, P], E[k, P + 1], E[k, P + 2], E[k, P + 3] = P00, P01, P10, P11
        E[k, P_KNOWN], E[k, P_KNOWN + 1] = p0, p1
        E[k, R], E[k, R + 1], E[k, R + 2], E[k, R + 3] = R00, R01, R10, R11
        E[k, R_KNOWN], E[k, R_KNOWN + 1] = r0, r1
    # upper end, and back substitution
    b = n - 1
    ex, ez, eN, Dxx, Dxz, Dzx, Dzz = upper_condition(p, tables, stage, Y, work)
    A00 = eN * Q[b, col.SLOPE] * Q[b, col.COS] + Dxx * R00 + Dxz * R10
    A01 = -eN * Q[b, col.NZ] + Dxx * R01 + Dxz * R11
    A10 = eN * Q[b, col.SLOPE] * Q[b, col.SIN] + Dzx * R00 + Dzz * R10
    A11 = eN * Q[b, col.NX] + Dzx * R01 + Dzz * R11
    g0 = -ex - Dxx * r0 - Dxz * r1
    g1 = -ez - Dzx * r0 - Dzz * r1
    det = A00 * A11 - A01 * A10
    least = smaller(least, abs(det))
    y0, y1 = (A11 * g0 - A01 * g1) / det, (A00 * g1 - A10 * g0) / det
    for k in range(n - 1, -1, -1):
        D[k, col.EPS], D[k, col.SHEAR], D[k, col.PHI], D[k, col.KAPPA] = y0, 0.0, y1, 0.0
        D[k, col.VX] = E[k, R] * y0 + E[k, R + 1] * y1 + E[k, R_KNOWN]
        D[k, col.VZ] = E[k, R + 2] * y0 + E[k, R + 3] * y1 + E[k, R_KNOWN + 1]
        y0, y1 = (
            E[k, P] * y0 + E[k, P + 1] * y1 + E[k, P_KNOWN],
            E[k, P + 2] * y0 + E[k, P + 3] * y1 + E[k, P_KNOWN + 1],
        )
    return least != 0.0
