"""Nodal quantities of the cable in space: everything the box equations need, once per node.

Unknowns Y[k] = (eps, Sn, Sb, U, V, W, b0, b1, b2, b3, O1, O2, O3): strain, shear forces, velocity in fixed axes, Euler
parameters of the local frame t, n, b (eq. 5, 6), and the rotation of the material along the line (eq. 4). A round line
leaves it free how n and b lie in it: this frame turns with t but does not roll about it, and O1 is the twist of the
material against it (a frame that rolls with the material passes one turn an element where GIp is small: with
GIp = EI/10 no grid up to 449 nodes gave the localised buckle of `test_torsion_localised`, and 113 do). q = (1 + eps) t
and N = T t + Sn n + Sb b. Equations (3) in conservation form, (4), and (16) with its factor the right way up:

    N_s = G     G = m V_t + w0 z + a t + P (d + w)      (F_e of (23)-(24) moved to the left side)
    V_s = q_t   b_s = 1/2 b o (0, 0, O2, O3)
    GIp O1_s = 0,   EI O2_s - M2 = 0,   EI O3_s + M3 = 0
    M2 = (1+eps)^3 Sb - GIp O1 O3,   M3 = (1+eps)^3 Sn - GIp O1 O2

    P = I - t t',  v = V - U_w,  v_p = P v,   a = c_t sqrt(1+eps) |v_t| v_t,
    d = c_n sqrt(1+eps) |v_p| v_p,  w = m_a V_t - R dU_w/dt

Newton's increments turn the frame by a rotation vector theta in its own axes: dt = theta3 n - theta2 b. Rates come from
the integrator as q_t = cq (q - q~), V_t = cv (V - V~); `in_motion` as in the plane. Derivatives are complete but for
the water's dependence on position.

Shock viscosity as in the plane (`engine.planar.node`).

Columns of Q (row k is node k):
    0-2 t | 3 dT/deps | 4 1 + eps | 5-7 q | 8-10 q_t | 11-13 N | 14-16 n | 17-19 b | 20-22 G | 23-25 dG/deps
    26-28 dG/dtheta2 | 29-31 dG/dtheta3 | 32-37 dG/dV: xx xy xz yy yz zz | 38 M2 | 39 M3 | 40 (1+eps)^3 | 41 T
    42 B | 43 L

In the paper: eq. (4) derivative along the line in the local frame; eq. (7) strain; eq. (8) velocity; eq. (11)
momentum; eq. (12) momentum in the local frame; eq. (23) weight in water; eq. (24) Morison's force on the line.
"""

import math

from ..compiled import kernel
from ..physics.currents import current_field_3d
from ..physics.sea import sea_field
from ..physics.shocks import shock_tension
from ..physics.tension import tension
from ..physics.waves import wave_field_3d
from .vectors import dot, frame, mixed

WIDTH = 44


@kernel
def put(row, at, a):
    """row[at : at + 3] = a"""
    row[at], row[at + 1], row[at + 2] = a


@kernel
def vector(row, at):
    """(row[at], row[at + 1], row[at + 2])"""
    return row[at], row[at + 1], row[at + 2]


@kernel
def shape(p, tables, Y, Q, X):
    """Frames, q and positions: X[0] is the anchor, and each element adds h times the mean of q."""
    for k in range(Y.shape[0]):
        t, n, b = frame((Y[k, 6], Y[k, 7], Y[k, 8], Y[k, 9]))
        lam = 1.0 + Y[k, 0]
        put(Q[k], 0, t)
        put(Q[k], 14, n)
        put(Q[k], 17, b)
        Q[k, 4] = lam
        put(Q[k], 5, (lam * t[0], lam * t[1], lam * t[2]))
    put(X[0], 0, (0.0, 0.0, 0.0))
    for k in range(1, Y.shape[0]):
        half = 0.5 * tables[p.grid_at + k - 1]
        for i in range(3):
            X[k, i] = X[k - 1, i] + half * (Q[k - 1, 5 + i] + Q[k, 5 + i])


@kernel
def water(p, tables, t, in_motion, X, F):
    """Velocity and acceleration of the water at the nodes, F (n, 6); untouched zeros where there is none."""
    if p.wet == 0:
        return
    for k in range(F.shape[0]):
        for i in range(6):
            F[k, i] = 0.0
    if p.waves and in_motion > 0.0:
        if p.sea_n == 0:
            wave_field_3d(p, t, X, F)
        else:
            sea_field(p, tables, t, X, F)
    if p.current:
        current_field_3d(p, tables, t, X, F)


@kernel
def node_quantities(p, tables, cq, cv, in_motion, Y, C_tilde, F, Q):
    """Fill Q (columns in the head of this file) from Y, the integrator's C~ = (q~, V~) and the water F."""
    for k in range(Y.shape[0]):
        row = Q[k]
        eps, Sn, Sb = Y[k, 0], Y[k, 1], Y[k, 2]
        T, slope = tension(eps, p, tables)
        t, n, b = vector(row, 0), vector(row, 14), vector(row, 17)
        lam = row[4]
        if p.viscous:
            before = (C_tilde[k, 0], C_tilde[k, 1], C_tilde[k, 2])
            extra, stiffer = shock_tension(in_motion * cq, lam - math.sqrt(dot(before, before)), row[42], row[43])
            T += extra
            slope += stiffer
        row[3], row[41] = slope, T
        for i in range(3):
            row[8 + i] = cq * (row[5 + i] - C_tilde[k, i])
            row[11 + i] = T * t[i] + Sn * n[i] + Sb * b[i]
        A = (cv * (Y[k, 3] - C_tilde[k, 3]), cv * (Y[k, 4] - C_tilde[k, 4]), cv * (Y[k, 5] - C_tilde[k, 5]))
        Gx, Gy, Gz = p.m * A[0], p.m * A[1], p.m * A[2] + p.w0
        Jxx = Jyy = Jzz = p.m * cv
        Jxy = Jxz = Jyz = 0.0
        if p.wet:
            root = math.sqrt(max(lam, 0.0))
            v = (in_motion * Y[k, 3] - F[k, 0], in_motion * Y[k, 4] - F[k, 1], in_motion * Y[k, 5] - F[k, 2])
            vt, vn, vb = dot(v, t), dot(v, n), dot(v, b)
            speed = math.sqrt(vn * vn + vb * vb)
            w = (p.ma * A[0] - p.Rw * F[k, 3], p.ma * A[1] - p.Rw * F[k, 4], p.ma * A[2] - p.Rw * F[k, 5])
            wt, wn, wb = dot(w, t), dot(w, n), dot(w, b)
            ct, cn = p.ct * root, p.cn * root
            along = ct * abs(vt)
            across = cn * speed
            a, dn, db = along * vt, across * vn, across * vb
            # G in the frame: a t + (dn + wn) n + (db + wb) b
            force = mixed(1.0, mixed(a, t, dn + wn, n), db + wb, b)
            Gx += force[0]
            Gy += force[1]
            Gz += force[2]
            half = 0.5 / lam
            drag = mixed(1.0, mixed(half * a, t, half * dn, n), half * db, b)
            put(row, 23, drag)
            # t turns towards d = -b (theta2) and d = n (theta3): v_p loses (v.d) t + v_t d
            inverse = cn / speed if speed > 0.0 else 0.0
            lead = 2.0 * along - across
            turn2 = -vt * vb * inverse
            turn3 = -vt * vn * inverse
            put(row, 26, mixed(1.0, mixed(-lead * vb + wb, t, -turn2 * vn, n), -a + across * vt - turn2 * vb + wt, b))
            put(row, 29, mixed(1.0, mixed(lead * vn - wn, t, a - across * vt + turn3 * vn - wt, n), turn3 * vb, b))
            # dG/dV = Dt tt' + (Dp + m_a cv) P + Ds v_p v_p'
            Dt = 2.0 * in_motion * along
            Dp = in_motion * across + p.ma * cv
            Ds = in_motion * inverse
            Dt -= Dp
            vp = mixed(vn, n, vb, b)
            Jxx += Dp + Dt * t[0] * t[0] + Ds * vp[0] * vp[0]
            Jxy += Dt * t[0] * t[1] + Ds * vp[0] * vp[1]
            Jxz += Dt * t[0] * t[2] + Ds * vp[0] * vp[2]
            Jyy += Dp + Dt * t[1] * t[1] + Ds * vp[1] * vp[1]
            Jyz += Dt * t[1] * t[2] + Ds * vp[1] * vp[2]
            Jzz += Dp + Dt * t[2] * t[2] + Ds * vp[2] * vp[2]
        put(row, 20, (Gx, Gy, Gz))
        put(row, 32, (Jxx, Jxy, Jxz))
        put(row, 35, (Jyy, Jyz, Jzz))
        if p.bent:
            cube = lam * lam * lam
            row[38], row[39], row[40] = cube * Sb, cube * Sn, cube
            if Y[k, 10] != 0.0:
                row[38] -= p.GI * Y[k, 10] * Y[k, 12]
                row[39] -= p.GI * Y[k, 10] * Y[k, 11]
