"""Condensed elimination along one part of the line, and the way back (the algebra: `engine.planar.sweep`).

Written once for a place that is one node or a pair of nodes (`engine.planar.places`).
"""

import numpy as np

from ..choose import smaller
from ..compiled import kernel
from .places import half_box, move, put, take

WIDTH, WITH_INVERSE = 24, 33


@kernel
def eliminate(p, tables, cq, k, d, count, relation, Y, Q, E):
    """From the relation v = R y + r at k (12 numbers, row-major) through `count` boxes on the way d.

    k, d: whole numbers, or pairs of them. Fills the rows of E on the way; returns the relation at the end of it, and
    the least determinant.
    """
    EI = p.EI
    R00, R01, R02, R10, R11, R12, R20, R21, R22, r0, r1, r2 = relation
    least = np.inf
    Y_here, Q_here = take(Y, k, 2, 4), take(Q, k, 0, 21)
    for _ in range(count):
        a, Y_below, Q_below = k, Y_here, Q_here
        k = move(k, d)
        Y_here, Q_here = take(Y, k, 2, 4), take(Q, k, 0, 21)
        Ua, Wa, phi_a, kap_a = Y_below
        Ub, Wb, phi_b, kap_b = Y_here
        (ca, sa, fa, Nxa, Nza, qxa, qza, qta, wta, Gxa, Gza, Gexa, Geza, Gpxa, Gpza, Xa, XZa, Za, Ma, Mea, MSa) = (
            Q_below
        )
        (cb, sb, fb, Nxb, Nzb, qxb, qzb, qtb, wtb, Gxb, Gzb, Gexb, Gezb, Gpxb, Gpzb, Xb, XZb, Zb, Mb, Meb, MSb) = Q_here
        e = half_box(tables, p.grid_at, a, d)
        ec = e * cq
        # compatibility: dV_b = (R_a + Ca) y_a + Cb y_b + ..., with Ca = ec dq/dy
        Ca0, Ca1, Ca2, Ca3 = ec * ca, -ec * qza, ec * sa, ec * qxa  # [x eps, x phi, z eps, z phi]
        Cb0, Cb1, Cb2, Cb3 = ec * cb, -ec * qzb, ec * sb, ec * qxb
        cx = Ub - Ua - e * (qta + qtb)
        cz = Wb - Wa - e * (wta + wtb)
        per_e = 1.0 / e
        stiff = EI * per_e
        turn = (phi_b - phi_a) * per_e - (kap_a + kap_b)
        # momentum; K = e (dG/dV_a + dG/dV_b), J = e dG/dV_b
        Jxx, Jxz, Jzz = e * Xb, e * XZb, e * Zb
        Kxx, Kxz, Kzz = e * Xa + Jxx, e * XZa + Jxz, e * Za + Jzz
        A00 = -fa * ca - e * Gexa - Kxx * R00 - Kxz * R10 - Jxx * Ca0 - Jxz * Ca2
        A01 = sa - Kxx * R01 - Kxz * R11
        A02 = Nza - e * Gpxa - Kxx * R02 - Kxz * R12 - Jxx * Ca1 - Jxz * Ca3
        A10 = -fa * sa - e * Geza - Kxz * R00 - Kzz * R10 - Jxz * Ca0 - Jzz * Ca2
        A11 = -ca - Kxz * R01 - Kzz * R11
        A12 = -Nxa - e * Gpza - Kxz * R02 - Kzz * R12 - Jxz * Ca1 - Jzz * Ca3
        A20 = e * Mea - 2.0 * EI * R20
        A21 = e * MSa - 2.0 * EI * R21
        A22 = -stiff - 2.0 * EI * R22
        B00 = fb * cb - e * Gexb - Jxx * Cb0 - Jxz * Cb2
        B01 = -sb
        B02 = -Nzb - e * Gpxb - Jxx * Cb1 - Jxz * Cb3
        B10 = fb * sb - e * Gezb - Jxz * Cb0 - Jzz * Cb2
        B11 = cb
        B12 = Nxb - e * Gpzb - Jxz * Cb1 - Jzz * Cb3
        B20 = e * Meb
        B21 = e * MSb
        B22 = stiff
        g0 = Nxa - Nxb + e * (Gxa + Gxb) + Kxx * r0 + Kxz * r1 - Jxx * cx - Jxz * cz
        g1 = Nza - Nzb + e * (Gza + Gzb) + Kxz * r0 + Kzz * r1 - Jxz * cx - Jzz * cz
        g2 = -EI * (kap_b - kap_a) - e * (Ma + Mb) - EI * turn + 2.0 * EI * r2
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
            put(E, a, 24, (i00, i01, i02, i10, i11, i12, i20, i21, i22))
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
        put(E, a, 0, (P00, P01, P02, P10, P11, P12, P20, P21, P22, p0, p1, p2))
        put(E, a, 12, (R00, R01, R02, R10, R11, R12, R20, R21, R22, r0, r1, r2))
        # v_b = R_b y_b + r_b
        X00, X01, X02 = R00 + Ca0, R01, R02 + Ca1
        X10, X11, X12 = R10 + Ca2, R11, R12 + Ca3
        X20, X21, X22 = -R20, -R21, -R22 - per_e
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
            X20 * P02 + X21 * P12 + X22 * P22 + per_e,
        )
        r0 = X00 * p0 + X01 * p1 + X02 * p2 + r0 - cx
        r1 = X10 * p0 + X11 * p1 + X12 * p2 + r1 - cz
        r2 = X20 * p0 + X21 * p1 + X22 * p2 - r2 + turn
    return (R00, R01, R02, R10, R11, R12, R20, R21, R22, r0, r1, r2), least


@kernel
def update_node(E, k, y, D):
    """y and v = R y + r of a place, into D."""
    y0, y1, y2 = y
    R00, R01, R02, R10, R11, R12, R20, R21, R22, r0, r1, r2 = take(E, k, 12, 12)
    U = R00 * y0 + R01 * y1 + R02 * y2 + r0
    W = R10 * y0 + R11 * y1 + R12 * y2 + r1
    put(D, k, 0, (y0, y1, U, W, y2, R20 * y0 + R21 * y1 + R22 * y2 + r2))


@kernel
def back_substitute(E, k, d, count, y, D):
    """From y at k through `count` boxes on the way d: the update of the places there, into D; returns the last y."""
    y0, y1, y2 = y
    for _ in range(count):
        k = move(k, d)
        P00, P01, P02, P10, P11, P12, P20, P21, P22, p0, p1, p2 = take(E, k, 0, 12)
        y0, y1, y2 = (
            P00 * y0 + P01 * y1 + P02 * y2 + p0,
            P10 * y0 + P11 * y1 + P12 * y2 + p1,
            P20 * y0 + P21 * y1 + P22 * y2 + p2,
        )
        update_node(E, k, (y0, y1, y2), D)
    return y0, y1, y2
