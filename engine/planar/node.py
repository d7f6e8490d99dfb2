"""Nodal quantities of the planar cable: everything the box equations need, once per node.

Unknowns Y[k] = (eps, S, U, W, phi, kappa): strain, shear force, velocity, angle from the x axis, curvature.
t = (cos phi, sin phi), n = (-sin phi, cos phi), q = (1 + eps) t, N = T t + S n. Equations (3) in conservation form:

    N_s = G        G = m V_t + w0 z + a t + b n          (F_e of (23)-(24) moved to the left side)
    V_s = q_t      phi_s = kappa      EI kappa_s + (1 + eps)^3 S = 0

    a = c_t sqrt(1+eps) |v_t| v_t,   b = c_n sqrt(1+eps) |v_n| v_n + m_a n.V_t - R n.dU_w/dt,   v = V - U_w

Rates come from the integrator as q_t = cq (q - q~), V_t = cv (V - V~). Statics uses the same code with V a
displacement: `in_motion` = 0 keeps it out of the drag, and leaves the waves out. Derivatives are complete but for the
water's dependence on position.

In a scene with shock viscosity T gains B |e_t| e_t + L e_t, e_t = cq (|q| - |q~|), the coefficients B, L kept from
step to step (`engine.shocks`).

Columns of Q (row k is node k):
    0 cos phi | 1 sin phi | 2 dT/deps | 3-4 N | 5-6 q | 7-8 q_t | 9-10 G | 11-12 dG/deps | 13-14 dG/dphi
    15-17 dG/dV: xx, xz, zz | 18 M = (1+eps)^3 S | 19 dM/deps | 20 dM/dS | 21 B | 22 L

In the paper: eq. (7) eps, eq. (8) U and W, eq. (11) and eq. (12) N_s, eq. (18) V_s, eq. (23) w0, eq. (24) a and b.
"""

import math

from ..choose import larger
from ..compiled import kernel
from ..currents import planar_current
from ..elementary import sincos
from ..shocks import shock_tension
from ..tension import tension
from ..waves import wave_field

WIDTH = 23


@kernel
def shape(p, tables, Y, Q, X):
    """Directions, q and positions: X[0] is the anchor, and each element adds h times the mean of q."""
    n = Y.shape[0]
    for k in range(n):
        s, c = sincos(Y[k, 4])
        lam = 1.0 + Y[k, 0]
        Q[k, 0] = c
        Q[k, 1] = s
        Q[k, 5] = lam * c
        Q[k, 6] = lam * s
    X[0, 0] = 0.0
    X[0, 1] = 0.0
    for k in range(1, n):
        half = 0.5 * tables[p.grid_at + k - 1]
        X[k, 0] = X[k - 1, 0] + half * (Q[k - 1, 5] + Q[k, 5])
        X[k, 1] = X[k - 1, 1] + half * (Q[k - 1, 6] + Q[k, 6])


@kernel
def water(p, tables, t, in_motion, X, F):
    """Velocity and acceleration of the water at the nodes, F (n, 4); untouched zeros where there is none."""
    if p.wet == 0:
        return
    for k in range(F.shape[0]):
        for i in range(4):
            F[k, i] = 0.0
    if p.waves and in_motion > 0.0:
        wave_field(p, t, X, F)
    if p.current:
        planar_current(p, tables, t, X, F)


@kernel
def node_quantities(p, tables, cq, cv, in_motion, Y, C_tilde, F, Q):
    """Fill Q (columns in the head of this file) from Y, the integrator's C~ = (q~, V~) and the water F."""
    for k in range(Y.shape[0]):
        eps, S, U, W = Y[k, 0], Y[k, 1], Y[k, 2], Y[k, 3]
        c, s = Q[k, 0], Q[k, 1]
        T, slope = tension(eps, p, tables)
        lam = 1.0 + eps
        if p.viscous:
            before = math.sqrt(C_tilde[k, 0] * C_tilde[k, 0] + C_tilde[k, 1] * C_tilde[k, 1])
            extra, stiffer = shock_tension(in_motion * cq, lam - before, Q[k, 21], Q[k, 22])
            T += extra
            slope += stiffer
        Q[k, 2] = slope
        Q[k, 3] = T * c - S * s
        Q[k, 4] = T * s + S * c
        Q[k, 7] = cq * (Q[k, 5] - C_tilde[k, 0])
        Q[k, 8] = cq * (Q[k, 6] - C_tilde[k, 1])
        ax = cv * (U - C_tilde[k, 2])
        az = cv * (W - C_tilde[k, 3])
        Gx, Gz = p.m * ax, p.m * az + p.w0
        Gxx = p.m * cv
        Gxz = 0.0
        Gzz = Gxx
        Gex = Gez = Gpx = Gpz = 0.0
        if p.wet:
            root = math.sqrt(larger(lam, 0.0))
            ur = in_motion * U - F[k, 0]
            wr = in_motion * W - F[k, 1]
            vt = ur * c + wr * s
            vn = wr * c - ur * s
            kt = 2.0 * p.ct * root * abs(vt)
            kn = 2.0 * p.cn * root * abs(vn)
            a = 0.5 * kt * vt
            b = 0.5 * kn * vn
            half_inverse = 0.5 / lam
            Gex = (a * c - b * s) * half_inverse
            Gez = (a * s + b * c) * half_inverse
            b_phi = p.Rw * (F[k, 2] * c + F[k, 3] * s) - p.ma * (ax * c + az * s) - kn * vt
            b += p.ma * (az * c - ax * s) - p.Rw * (F[k, 3] * c - F[k, 2] * s)
            Gx += a * c - b * s
            Gz += a * s + b * c
            along = kt * vn - b
            across = a + b_phi
            Gpx = along * c - across * s
            Gpz = along * s + across * c
            dt_ = in_motion * kt
            dn = in_motion * kn + p.ma * cv
            Gxx += dt_ * c * c + dn * s * s
            Gxz = (dt_ - dn) * c * s
            Gzz += dt_ * s * s + dn * c * c
        Q[k, 9] = Gx
        Q[k, 10] = Gz
        Q[k, 11] = Gex
        Q[k, 12] = Gez
        Q[k, 13] = Gpx
        Q[k, 14] = Gpz
        Q[k, 15] = Gxx
        Q[k, 16] = Gxz
        Q[k, 17] = Gzz
        if p.bent:
            square = lam * lam
            Q[k, 18] = square * lam * S
            Q[k, 19] = 3.0 * square * S
            Q[k, 20] = square * lam
