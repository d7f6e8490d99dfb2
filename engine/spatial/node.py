"""Nodal quantities of the cable in space: everything the box equations need, once per node.

Unknowns Y[k] = (eps, Sn, Sb, U, V, W, b0, b1, b2, b3, O1, O2, O3): strain, shear forces, velocity in fixed axes, Euler
parameters of the local frame t, n, b (eq. 5, 6), and the rotation of the material along the line (eq. 4). A round line
leaves it free how n and b lie in it: this frame turns with t but does not roll about it, and O1 is the twist of the
material against it (why: THEORY.md, section 3). q = (1 + eps) t and N = T t + Sn n + Sb b. With z the unit vector
upwards and o the quaternion product, the equations of THEORY.md, section 3, are:

    N_s = G     G = m V_t + w0 z + a t + P (d + w)      (F_e of (23)-(24) moved to the left side)
    V_s = q_t   beta_s = 1/2 beta o (0, 0, O2, O3),  beta = (b0, b1, b2, b3)
    GIp O1_s = 0,   EI O2_s - M2 = 0,   EI O3_s + M3 = 0
    M2 = (1+eps)^3 Sb - GIp O1 O3,   M3 = (1+eps)^3 Sn - GIp O1 O2

    P = I - t t',  v = V - U_w,  v_p = P v,   a = C_t |v_t| v_t,  d = C_n |v_p| v_p  (C: `engine.physics.drag`),
    w = m_a V_t - R dU_w/dt

Newton's increments turn the frame by a rotation vector theta in its own axes: dt = theta3 n - theta2 b. Rates come from
the integrator as q_t = cq (q - q~), V_t = cv (V - V~); `in_motion` as in the plane. Derivatives are complete but for
the water's dependence on position.

Shock viscosity as in the plane (`engine.planar.node`).

Columns of Q: `engine.spatial.columns`.

In the paper: eq. (4) derivative along the line in the local frame; eq. (7) strain; eq. (8) velocity; eq. (11)
momentum; eq. (12) momentum in the local frame; eq. (23) weight in water; eq. (24) Morison's force on the line.
"""

import math

from ..compiled import kernel, of_extras
from ..physics.drag.kernels import drag_across, drag_along
from ..physics.shocks import shock_tension
from ..physics.tension.kernels import tension
from . import columns as col
from .extras import more_loads
from .vectors import (
    dot,
    frame,
    minus,
    mixed,
    multiple,
    plus,
    put,
    put_rows,
    quaternion,
    relative,
    rotation_vector,
    rows_of,
    times,
    vector,
)


@of_extras((0.0, 0.0, 0.0))
def lower_end(p):
    """Place (m) of the anchor."""
    return p.anchor_x, p.anchor_y, p.anchor_z


@kernel
def shape(p, tables, Y, Q, X):
    """Frames and q into Q, positions into X (n, 3): X[0] is the anchor, an element adds h times its mean q."""
    for k in range(Y.shape[0]):
        row = Q[k]
        axes = frame(quaternion(Y[k], col.BETA))
        lam = 1.0 + Y[k, col.EPS]
        put_rows(row, col.T_VECTOR, axes)
        row[col.STRETCHED] = lam
        put(row, col.Q, multiple(lam, axes[0]))
    put(X[0], 0, lower_end(p))
    for k in range(1, Y.shape[0]):
        half = 0.5 * tables[p.grid_at + k - 1]
        for i in range(3):
            X[k, i] = X[k - 1, i] + half * (Q[k - 1, col.Q + i] + Q[k, col.Q + i])


@kernel
def box_rotation(Y, a, b):
    """psi of a box, its length (rad), and (a/2) cot(a/2)."""
    return rotation_vector(relative(quaternion(Y[a], col.BETA), quaternion(Y[b], col.BETA)))


@kernel
def node_quantities(p, tables, stage, Y, work):
    """Fill Q from Y (n, 13), the integrator's C~ = (q~, V~) and the water F; `shape` and `water` have been called.

    p, tables: parameters (`engine.record`); stage: Stage; work: Work, of which C_tilde and F are read.
    """
    _, in_motion, cq, cv = stage
    for k in range(Y.shape[0]):
        row, known, water = work.Q[k], work.C_tilde[k], work.F[k]
        eps, Sn, Sb = Y[k, col.EPS], Y[k, col.SHEAR_N], Y[k, col.SHEAR_B]
        t, n, b = rows_of(row, col.T_VECTOR)
        lam = row[col.STRETCHED]
        # force in the line, with the viscosity of shocks
        T, slope = tension(eps, p, tables)
        if p.viscous:
            q_before = vector(known, 0)
            stretched = lam - math.sqrt(dot(q_before, q_before))
            extra, stiffer = shock_tension(in_motion * cq, stretched, row[col.SHOCK_B], row[col.SHOCK_L])
            T += extra
            slope += stiffer
        row[col.SLOPE], row[col.TENSION] = slope, T
        for i in range(3):
            row[col.Q_T + i] = cq * (row[col.Q + i] - known[i])
            row[col.N + i] = T * t[i] + Sn * n[i] + Sb * b[i]
        # inertia and weight
        V, V_tilde = vector(Y[k], col.V), vector(known, col.V)
        A = multiple(cv, minus(V, V_tilde))
        G = p.m * A[0], p.m * A[1], p.m * A[2] + p.w0
        Jxx = Jyy = Jzz = p.m * cv
        Jxy = Jxz = Jyz = 0.0
        if p.wet:
            # velocity against the water, and what of the acceleration acts across the line
            root = math.sqrt(max(lam, 0.0))
            v = mixed(in_motion, V, -1.0, vector(water, 0))
            vt, vn, vb = times((t, n, b), v)
            speed = math.sqrt(vn * vn + vb * vb)
            w = mixed(p.ma, A, -p.Rw, vector(water, col.ACCELERATION))
            wt, wn, wb = times((t, n, b), w)
            C_along, slope_along = drag_along(p, tables, root, abs(vt))
            C_across, slope_across = drag_across(p, tables, root, speed)
            secant_t, steeper = C_along * abs(vt), slope_along * abs(vt)
            secant_n = C_across * speed
            a, dn, db = secant_t * vt, secant_n * vn, secant_n * vb
            # G in the frame: a t + (dn + wn) n + (db + wb) b
            G = plus(G, mixed(1.0, mixed(a, t, dn + wn, n), db + wb, b))
            half = 0.5 / lam
            put(row, col.G_EPS, mixed(1.0, mixed(half * a, t, half * dn, n), half * db, b))
            # t turns towards d = -b (theta2) and d = n (theta3): v_p loses (v.d) t + v_t d
            inverse = (slope_across - C_across) / speed if speed > 0.0 else 0.0
            lead = steeper - secant_n
            turn2 = -vt * vb * inverse
            turn3 = -vt * vn * inverse
            by2 = mixed(1.0, mixed(-lead * vb + wb, t, -turn2 * vn, n), -a + secant_n * vt - turn2 * vb + wt, b)
            by3 = mixed(1.0, mixed(lead * vn - wn, t, a - secant_n * vt + turn3 * vn - wt, n), turn3 * vb, b)
            put(row, col.G_THETA2, by2)
            put(row, col.G_THETA3, by3)
            # dG/dV = Dt tt' + (Dp + m_a cv) P + Ds v_p v_p'
            Dt = in_motion * steeper
            Dp = in_motion * secant_n + p.ma * cv
            Ds = in_motion * inverse
            Dt -= Dp
            vp = mixed(vn, n, vb, b)
            Jxx += Dp + Dt * t[0] * t[0] + Ds * vp[0] * vp[0]
            Jxy += Dt * t[0] * t[1] + Ds * vp[0] * vp[1]
            Jxz += Dt * t[0] * t[2] + Ds * vp[0] * vp[2]
            Jyy += Dp + Dt * t[1] * t[1] + Ds * vp[1] * vp[1]
            Jyz += Dt * t[1] * t[2] + Ds * vp[1] * vp[2]
            Jzz += Dp + Dt * t[2] * t[2] + Ds * vp[2] * vp[2]
        put(row, col.G, G)
        put_rows(row, col.G_V, ((Jxx, Jxy, Jxz), (Jxy, Jyy, Jyz), (Jxz, Jyz, Jzz)))
        if p.bent:
            cube = lam * lam * lam
            row[col.M2], row[col.M3], row[col.CUBE] = cube * Sb, cube * Sn, cube
            if Y[k, col.O1] != 0.0:
                row[col.M2] -= p.GI * Y[k, col.O1] * Y[k, col.O3]
                row[col.M3] -= p.GI * Y[k, col.O1] * Y[k, col.O2]
    more_loads(p, tables, stage, Y, work)
