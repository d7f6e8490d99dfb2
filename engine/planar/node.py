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
step to step (`engine.physics.shocks`).

Columns of Q (row k is node k):
    0 cos phi | 1 sin phi | 2 dT/deps | 3-4 N | 5-6 q | 7-8 q_t | 9-10 G | 11-12 dG/deps | 13-14 dG/dphi
    15-17 dG/dV: xx, xz, zz | 18 M = (1+eps)^3 S | 19 dM/deps | 20 dM/dS | 21 B | 22 L

In the paper: eq. (7) strain; eq. (8) velocity; eq. (11) momentum; eq. (12) momentum in the local frame; eq. (18)
compatibility, with the tangent; eq. (23) weight in water; eq. (24) Morison's force on the line.
"""

import math

from ..compiled import kernel
from ..physics.currents import planar_current
from ..physics.sea import planar_sea
from ..physics.shocks import shock_tension
from ..physics.waves import wave_field
from ..simd.elementary import sincos
from ..simd.select import larger
from .places import count_of_places, place, put, take, tension_at

WIDTH = 23


@kernel
def shape(p, tables, Y, Q, X):
    """Directions, q and positions: X[0] is the anchor, and each element adds h times the mean of q."""
    n = Y.shape[0]
    for j in range(count_of_places(p, n)):
        k = place(p, j, n)
        s, c = sincos(take(Y, k, 4, 1)[0])
        lam = 1.0 + take(Y, k, 0, 1)[0]
        put(Q, k, 0, (c, s))
        put(Q, k, 5, (lam * c, lam * s))
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
        if p.sea_n == 0:
            wave_field(p, t, X, F)
        else:
            planar_sea(p, tables, t, X, F)
    if p.current:
        planar_current(p, tables, t, X, F)


@kernel
def node_quantities(p, tables, cq, cv, in_motion, Y, C_tilde, F, Q):
    """Fill Q (columns in the head of this file) from Y, the integrator's C~ = (q~, V~) and the water F.

    A run alone takes two nodes at a time (`engine.planar.places`).
    """
    n = Y.shape[0]
    for j in range(count_of_places(p, n)):
        k = place(p, j, n)
        eps, S, U, W = take(Y, k, 0, 4)
        qx_tilde, qz_tilde, U_tilde, W_tilde = take(C_tilde, k, 0, 4)
        Uw, Ww, Uw_t, Ww_t = take(F, k, 0, 4)
        c, s = take(Q, k, 0, 2)
        qx, qz = take(Q, k, 5, 2)
        T, slope = tension_at(p, tables, eps)
        lam = 1.0 + eps
        if p.viscous:
            before = math.sqrt(qx_tilde * qx_tilde + qz_tilde * qz_tilde)
            B, L = take(Q, k, 21, 2)
            extra, stiffer = shock_tension(in_motion * cq, lam - before, B, L)
            T += extra
            slope += stiffer
        put(Q, k, 2, (slope, T * c - S * s, T * s + S * c))
        put(Q, k, 7, (cq * (qx - qx_tilde), cq * (qz - qz_tilde)))
        ax = cv * (U - U_tilde)
        az = cv * (W - W_tilde)
        Gx, Gz = p.m * ax, p.m * az + p.w0
        Gxx = p.m * cv
        Gxz = 0.0
        Gzz = Gxx
        Gex = Gez = Gpx = Gpz = 0.0
        if p.wet:
            root = math.sqrt(larger(lam, 0.0))
            ur = in_motion * U - Uw
            wr = in_motion * W - Ww
            vt = ur * c + wr * s
            vn = wr * c - ur * s
            kt = 2.0 * p.ct * root * abs(vt)
            kn = 2.0 * p.cn * root * abs(vn)
            a = 0.5 * kt * vt
            b = 0.5 * kn * vn
            half_inverse = 0.5 / lam
            Gex = (a * c - b * s) * half_inverse
            Gez = (a * s + b * c) * half_inverse
            b_phi = p.Rw * (Uw_t * c + Ww_t * s) - p.ma * (ax * c + az * s) - kn * vt
            b += p.ma * (az * c - ax * s) - p.Rw * (Ww_t * c - Uw_t * s)
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
        put(Q, k, 9, (Gx, Gz, Gex, Gez, Gpx, Gpz, Gxx, Gxz, Gzz))
        if p.bent:
            square = lam * lam
            put(Q, k, 18, (square * lam * S, 3.0 * square * S, square * lam))
