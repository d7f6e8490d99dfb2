"""Nodal quantities of the planar cable: everything the box equations need, once per node.

Unknowns Y[k] = (eps, S, U, W, phi, kappa): strain, shear force, velocity, angle from the x axis, curvature.
t = (cos phi, sin phi), n = (-sin phi, cos phi), q = (1 + eps) t, N = T t + S n. With z the unit vector upwards, the
equations of THEORY.md, section 3, are:

    N_s = G        G = m V_t + w0 z + a t + b n          (F_e of (23)-(24) moved to the left side)
    V_s = q_t      phi_s = kappa      EI kappa_s + (1 + eps)^3 S = 0

    a = C_t |v_t| v_t,   b = C_n |v_n| v_n + m_a n.V_t - R n.dU_w/dt,   v = V - U_w   (C: `engine.physics.drag`)

Rates come from the integrator as q_t = cq (q - q~), V_t = cv (V - V~). Statics uses the same code with V a
displacement: `in_motion` = 0 keeps it out of the drag, and leaves the waves out. Derivatives are complete but for the
water's dependence on position.

In a scene with shock viscosity T gains B |e_t| e_t + L e_t, e_t = cq (|q| - |q~|), the coefficients B, L kept from
step to step (`engine.physics.shocks`).

Columns of Q: `engine.planar.columns`.

In the paper: eq. (7) strain; eq. (8) velocity; eq. (11) momentum; eq. (12) momentum in the local frame; eq. (18)
compatibility, with the tangent; eq. (23) weight in water; eq. (24) Morison's force on the line.
"""

import math

from ..compiled import kernel, of_extras
from ..physics.drag.kernels import drag_across, drag_along
from ..physics.shocks import shock_tension
from ..physics.tension.kernels import tension
from ..simd.elementary import sincos
from ..simd.select import larger
from ..spatial.vectors import pair, put_quaternion
from . import columns as col
from .extras import more_loads


@of_extras((0.0, 0.0))
def lower_end(p):
    """Place (m) of the anchor."""
    return p.anchor_x, p.anchor_z


@kernel
def shape(p, tables, Y, Q, X):
    """Directions and q into Q, positions into X (n, 2): X[0] is the anchor, an element adds h times its mean q."""
    for k in range(Y.shape[0]):
        row = Q[k]
        s, c = sincos(Y[k, col.PHI])
        lam = 1.0 + Y[k, col.EPS]
        row[col.COS], row[col.SIN] = c, s
        row[col.QX], row[col.QZ] = lam * c, lam * s
    X[0, 0], X[0, 1] = lower_end(p)
    for k in range(1, Y.shape[0]):
        half = 0.5 * tables[p.grid_at + k - 1]
        X[k, 0] = X[k - 1, 0] + half * (Q[k - 1, col.QX] + Q[k, col.QX])
        X[k, 1] = X[k - 1, 1] + half * (Q[k - 1, col.QZ] + Q[k, col.QZ])


@kernel
def node_quantities(p, tables, stage, Y, work):
    """Fill Q from Y (n, 6), the integrator's C~ = (q~, V~) and the water F; `shape` and `water` have been called.

    p, tables: parameters (`engine.record`); stage: Stage; work: Work, of which C_tilde and F are read.
    """
    _, in_motion, cq, cv = stage
    for k in range(Y.shape[0]):
        row, known, water = work.Q[k], work.C_tilde[k], work.F[k]
        eps, S = Y[k, col.EPS], Y[k, col.SHEAR]
        c, s = pair(row, col.COS)
        lam = 1.0 + eps
        # force in the line, with the viscosity of shocks
        T, slope = tension(eps, p, tables)
        if p.viscous:
            qx, qz = pair(known, col.CX)
            length_before = math.sqrt(qx * qx + qz * qz)
            extra, stiffer = shock_tension(in_motion * cq, lam - length_before, row[col.SHOCK_B], row[col.SHOCK_L])
            T += extra
            slope += stiffer
        row[col.SLOPE] = slope
        row[col.NX], row[col.NZ] = T * c - S * s, T * s + S * c
        # rates of q and V; inertia and weight
        row[col.QX_T] = cq * (row[col.QX] - known[col.CX])
        row[col.QZ_T] = cq * (row[col.QZ] - known[col.CZ])
        ax = cv * (Y[k, col.VX] - known[col.VX])
        az = cv * (Y[k, col.VZ] - known[col.VZ])
        Gx, Gz = p.m * ax, p.m * az + p.w0
        Gxx = p.m * cv  # dGx/dU
        Gxz = 0.0
        Gzz = Gxx
        Gex = Gez = Gpx = Gpz = 0.0  # dG/deps, dG/dphi
        if p.wet:
            # drag a along and b across the line; kt = da/dvt, kn = db/dvn
            root = math.sqrt(larger(lam, 0.0))
            ur = in_motion * Y[k, col.VX] - water[col.UX]
            wr = in_motion * Y[k, col.VZ] - water[col.UZ]
            vt = ur * c + wr * s
            vn = wr * c - ur * s
            C_along, slope_along = drag_along(p, tables, root, abs(vt))
            C_across, slope_across = drag_across(p, tables, root, abs(vn))
            a, kt = C_along * abs(vt) * vt, slope_along * abs(vt)
            b, kn = C_across * abs(vn) * vn, slope_across * abs(vn)
            half_inverse = 0.5 / lam
            Gex = (a * c - b * s) * half_inverse
            Gez = (a * s + b * c) * half_inverse
            # added mass and the pressure gradient act across the line, and turn with it; b_phi = db/dphi
            Uw_t, Ww_t = pair(water, col.AX)
            b_phi = p.Rw * (Uw_t * c + Ww_t * s) - p.ma * (ax * c + az * s) - kn * vt
            b += p.ma * (az * c - ax * s) - p.Rw * (Ww_t * c - Uw_t * s)
            Gx += a * c - b * s
            Gz += a * s + b * c
            turned_t = kt * vn - b
            turned_n = a + b_phi
            Gpx = turned_t * c - turned_n * s
            Gpz = turned_t * s + turned_n * c
            # dG/dV: a tensor with the axes t and n, where it is dt_ (no time) and dn
            dt_ = in_motion * kt
            dn = in_motion * kn + p.ma * cv
            Gxx += dt_ * c * c + dn * s * s
            Gxz = (dt_ - dn) * c * s
            Gzz += dt_ * s * s + dn * c * c
        row[col.GX], row[col.GZ] = Gx, Gz
        row[col.GX_EPS], row[col.GZ_EPS] = Gex, Gez
        row[col.GX_PHI], row[col.GZ_PHI] = Gpx, Gpz
        put_quaternion(row, col.GXX, (Gxx, Gxz, Gxz, Gzz))
        if p.bent:
            square = lam * lam
            row[col.M], row[col.M_EPS], row[col.M_SHEAR] = square * lam * S, 3.0 * square * S, square * lam
        else:  # S_a + S_b = 0
            row[col.M], row[col.M_EPS], row[col.M_SHEAR] = 0.0, 0.0, 1.0
    more_loads(p, tables, stage, Y, work)
