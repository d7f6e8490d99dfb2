"""The sweep of `engine.planar.elimination` for a tether without bending: y = (eps, phi), v = (U, W), 2 x 2 blocks.

Well posed while the tether is in tension only (compression: EI = 0 is ill-posed, Triantafyllou & Howell 1994).
"""

import numpy as np

from ..compiled import kernel
from ..physics.ends import planar_end
from ..physics.submergence import cap_end
from ..simd.select import smaller


@kernel
def sweep_unbent(p, tables, t, cq, cv, in_motion, Y, C_tilde, X, F, Q, E, D):
    """Fill D (n, 6) with the Newton update, zeros for S and kappa; returns False where a block is singular."""
    n = Y.shape[0]
    R00 = R01 = R10 = R11 = 0.0
    r0, r1 = -Y[0, 2], -Y[0, 3]
    for i in range(6, 10):
        E[0, i] = 0.0
    E[0, 10], E[0, 11] = r0, r1
    least = np.inf  # of the determinants
    for k in range(1, n):
        a = k - 1
        e = 0.5 * tables[p.grid_at + a]
        ec = e * cq
        ca, sa, fa, cb, sb, fb = Q[a, 0], Q[a, 1], Q[a, 2], Q[k, 0], Q[k, 1], Q[k, 2]
        Ca0, Ca1, Ca2, Ca3 = ec * ca, -ec * Q[a, 6], ec * sa, ec * Q[a, 5]
        Cb0, Cb1, Cb2, Cb3 = ec * cb, -ec * Q[k, 6], ec * sb, ec * Q[k, 5]
        cx = Y[k, 2] - Y[a, 2] - e * (Q[a, 7] + Q[k, 7])
        cz = Y[k, 3] - Y[a, 3] - e * (Q[a, 8] + Q[k, 8])
        Jxx, Jxz, Jzz = e * Q[k, 15], e * Q[k, 16], e * Q[k, 17]
        Kxx, Kxz, Kzz = e * Q[a, 15] + Jxx, e * Q[a, 16] + Jxz, e * Q[a, 17] + Jzz
        A00 = -fa * ca - e * Q[a, 11] - Kxx * R00 - Kxz * R10 - Jxx * Ca0 - Jxz * Ca2
        A01 = Q[a, 4] - e * Q[a, 13] - Kxx * R01 - Kxz * R11 - Jxx * Ca1 - Jxz * Ca3
        A10 = -fa * sa - e * Q[a, 12] - Kxz * R00 - Kzz * R10 - Jxz * Ca0 - Jzz * Ca2
        A11 = -Q[a, 3] - e * Q[a, 14] - Kxz * R01 - Kzz * R11 - Jxz * Ca1 - Jzz * Ca3
        B00 = fb * cb - e * Q[k, 11] - Jxx * Cb0 - Jxz * Cb2
        B01 = -Q[k, 4] - e * Q[k, 13] - Jxx * Cb1 - Jxz * Cb3
        B10 = fb * sb - e * Q[k, 12] - Jxz * Cb0 - Jzz * Cb2
        B11 = Q[k, 3] - e * Q[k, 14] - Jxz * Cb1 - Jzz * Cb3
        g0 = Q[a, 3] - Q[k, 3] + e * (Q[a, 9] + Q[k, 9]) + Kxx * r0 + Kxz * r1 - Jxx * cx - Jxz * cz
        g1 = Q[a, 4] - Q[k, 4] + e * (Q[a, 10] + Q[k, 10]) + Kxz * r0 + Kzz * r1 - Jxz * cx - Jzz * cz
        det = A00 * A11 - A01 * A10
        least = smaller(least, abs(det))
        f = 1.0 / det
        P00, P01 = f * (A01 * B10 - A11 * B00), f * (A01 * B11 - A11 * B01)
        P10, P11 = f * (A10 * B00 - A00 * B10), f * (A10 * B01 - A00 * B11)
        p0, p1 = f * (A11 * g0 - A01 * g1), f * (A00 * g1 - A10 * g0)
        X00, X01, X10, X11 = R00 + Ca0, R01 + Ca1, R10 + Ca2, R11 + Ca3
        R00, R01 = X00 * P00 + X01 * P10 + Cb0, X00 * P01 + X01 * P11 + Cb1
        R10, R11 = X10 * P00 + X11 * P10 + Cb2, X10 * P01 + X11 * P11 + Cb3
        r0, r1 = X00 * p0 + X01 * p1 + r0 - cx, X10 * p0 + X11 * p1 + r1 - cz
        E[k, 0], E[k, 1], E[k, 2], E[k, 3], E[k, 4], E[k, 5] = P00, P01, P10, P11, p0, p1
        E[k, 6], E[k, 7], E[k, 8], E[k, 9], E[k, 10], E[k, 11] = R00, R01, R10, R11, r0, r1
    b = n - 1
    ex, ez, eN, Dxx, Dxz, Dzz = planar_end(
        p, tables, t, cv, in_motion, Q[b, 3], Q[b, 4], Y[b, 2], Y[b, 3], C_tilde[b, 2], C_tilde[b, 3], F[b]
    )
    Dzx = Dxz
    if p.spherical_cap:
        more = cap_end(p, t, cq, cv, in_motion, X[b, 0], X[b, 1], Y[b, 2], Y[b, 3], C_tilde[b, 2], C_tilde[b, 3], F[b])
        ex, ez, Dxx = ex + more[0], ez + more[1], Dxx + more[2]
        Dxz, Dzx, Dzz = Dxz + more[3], Dzx + more[4], Dzz + more[5]
    A00 = eN * Q[b, 2] * Q[b, 0] + Dxx * R00 + Dxz * R10
    A01 = -eN * Q[b, 4] + Dxx * R01 + Dxz * R11
    A10 = eN * Q[b, 2] * Q[b, 1] + Dzx * R00 + Dzz * R10
    A11 = eN * Q[b, 3] + Dzx * R01 + Dzz * R11
    g0 = -ex - Dxx * r0 - Dxz * r1
    g1 = -ez - Dzx * r0 - Dzz * r1
    det = A00 * A11 - A01 * A10
    least = smaller(least, abs(det))
    y0, y1 = (A11 * g0 - A01 * g1) / det, (A00 * g1 - A10 * g0) / det
    for k in range(n - 1, -1, -1):
        D[k, 0], D[k, 1], D[k, 4], D[k, 5] = y0, 0.0, y1, 0.0
        D[k, 2] = E[k, 6] * y0 + E[k, 7] * y1 + E[k, 10]
        D[k, 3] = E[k, 8] * y0 + E[k, 9] * y1 + E[k, 11]
        y0, y1 = E[k, 0] * y0 + E[k, 1] * y1 + E[k, 4], E[k, 2] * y0 + E[k, 3] * y1 + E[k, 5]
    return least != 0.0
