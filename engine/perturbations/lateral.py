"""Lateral perturbations of a planar motion: an infinitesimal one, carried through the accepted steps of a run.

The equations in space are linearised about a motion in the plane x-z; y is across, b = t x n = -y.
By mirror symmetry the lateral unknowns separate from the planar ones. A rotation theta = (theta_t, theta_n, 0) of the
frame (t, n, b) gives dt = theta x t = -theta_n b, dn = theta_t b, and, with V_y, dS_b, dO2 (dO1 = 0: torque-free ends),

    q_y = lam theta_n,   N_y = T theta_n - S theta_t - dS_b,   lam = 1 + eps
    V_y' = q_y,t         N_y' = G_y        EI dO2' - lam^3 dS_b = 0   (terms of EI - GIp are products with O1: none)

Neither strain, speed along t, magnitude of a relative velocity nor position in the plane changes to first order, and
the water does not depend on y. So, from G = m V_t + w0 z + C_t |v_t| v_t t + C_n |v_p| v_p
+ (I - t t')(m_a V_t - R a_w), with C_t, C_n of `engine.physics.drag`, v_p = v - v_t t and its y component
V_y - v_t theta_n,

    G_y = (m + m_a) V_y,t + C_n |v_n| V_y + [C_t |v_t| v_t - C_n |v_n| v_t - t.(m_a V_t - R a_w)] theta_n
    buoy  N_y + (M + M_a) V_y,t + C |v| V_y = 0;   held  V_y = 0;   free  N_y = 0;   all  dO2 = 0
    anchor  V_y = 0, dO2 = 0, theta_t = 0 (the roll gauge)

Rotation across a box. The box in space is psi = 2 log(beta_a* o beta_b) = e (O_a + O_b). About a planar turn alpha,
d psi = J_r^-1 theta_b - J_l^-1 theta_a. With J_l = R(psi) J_r and Theta = theta_t t + theta_n n, the same vector in
fixed axes, this is Theta_b - Theta_a = J_l d psi, and d psi = e (dO2_a + dO2_b) n makes it

    Theta_b - Theta_a = e sinc(alpha/2) n_m (dO2_a + dO2_b),    n_m = n((phi_a + phi_b)/2)

At a node take Theta along t_m and n_m of the box below it, rho and tau (at the anchor along t and n): the first
component is then known from the node below, and no turn alpha < 2 pi makes a pivot vanish. With delta = alpha/2,
theta_n = cos(delta) tau - sin(delta) rho and theta_t = cos(delta) rho + sin(delta) tau.

Elimination as in `planar.elimination`: v = (V_y, dO2, rho) and y = (tau, dS_b). Below a node v = R y + r; rotation
and compatibility give v_b = X y_a + Z y_b + x, momentum and moment y_a = P y_b + p through one 2 x 2 inverse.

Stages, renormalisation and loop releases are those of `tangent`; C = (q_y, V_y). Its length is the root of its energy
about rest (`energy_weights`), which does not swing with the phase as |q_y|^2 + |V_y|^2/speed^2 does: such swings make
the error of a mean over periods (thirty times the error at kA = 0.016). Torsional stiffness has no part in it.
"""

import math

import numpy as np

from ..compiled import by_kind, kernel
from ..physics.drag.kernels import drag_across, drag_along
from ..physics.ends import released
from ..physics.submergence import across_cap
from ..physics.tension.kernels import tension
from ..planar import columns as col
from ..planar.extras import (
    COS_HALF,
    CUBE,
    G_RHO,
    G_TAU,
    G_V,
    N_RHO,
    N_TAU,
    Q_RHO,
    Q_TAU,
    SIN_HALF,
    lateral_inertia,
    more_across,
)
from ..record import BUOY, HELD, lengths_of
from ..simd.elementary import sincos, small_sincos
from ..simd.select import every, larger, where
from ..spatial.vectors import dot, mixed, put, put_rows, rows_of, times, vector
from .tangent import to_length_one

# Columns of H: `engine.planar.extras`
COEFFICIENTS = 10
P, R, WIDTH = 0, 6, 15  # columns of E, in rows of three: (P, p), two rows of y, and (R, r), three of v
QY, VY = 0, 1  # columns of dC, dK


@kernel
def _coefficients(p, tables, base, Q, F, H):
    """Nodal coefficients of the lateral equations, H (n, 10)."""
    Y, K = base.Y, base.K
    for k in range(Y.shape[0]):
        c, s = Q[k, col.COS], Q[k, col.SIN]
        delta = 0.5 * (Y[k, col.PHI] - Y[k - 1, col.PHI]) if k > 0 else 0.0
        sd, cd = small_sincos(delta)
        short = abs(delta) < 0.25
        if not every(short):
            s_long, c_long = sincos(delta)
            sd, cd = where(short, sd, s_long), where(short, cd, c_long)
        lam = 1.0 + Y[k, col.EPS]
        S = Y[k, col.SHEAR]
        T = tension(Y[k, col.EPS], p, tables)[0]
        tilt = 0.0
        across = (p.m + p.ma) * base.rate
        if p.wet:
            root = math.sqrt(larger(lam, 0.0))
            ur, wr = Y[k, col.VX] - F[k, col.UX], Y[k, col.VZ] - F[k, col.UZ]
            vt, vn = ur * c + wr * s, wr * c - ur * s
            C_along = drag_along(p, tables, root, abs(vt))[0]
            kn = drag_across(p, tables, root, abs(vn))[0] * abs(vn)
            across += kn
            tilt = (C_along * abs(vt) - kn) * vt
            tilt -= c * (p.ma * K[k, col.VX] - p.Rw * F[k, col.AX]) + s * (p.ma * K[k, col.VZ] - p.Rw * F[k, col.AZ])
        H[k, SIN_HALF], H[k, COS_HALF] = sd, cd
        H[k, Q_TAU], H[k, Q_RHO] = lam * cd, -lam * sd
        H[k, N_TAU], H[k, N_RHO] = T * cd - S * sd, -T * sd - S * cd
        H[k, G_TAU], H[k, G_RHO] = tilt * cd, -tilt * sd
        H[k, G_V] = across
        H[k, CUBE] = lam * lam * lam


@kernel
def _upper_end(p, t, rate, Y, F, V_tilde):
    """Factors of N_y and V_y in the linearised condition of the upper end (`physics.ends`), and its known part."""
    if p.end == HELD and not released(p, t):
        return 0.0, 1.0, 0.0
    if p.end != BUOY:
        return 1.0, 0.0, 0.0
    return _buoy_end(p, t, rate, Y, F, V_tilde)


@kernel
def _buoy_end(p, t, rate, Y, F, V_tilde):
    u, w = Y[col.VX] - F[col.UX], Y[col.VZ] - F[col.UZ]
    return 1.0, p.M_total * rate + p.C_buoy * math.sqrt(u * u + w * w), -p.M_total * rate * V_tilde


_lateral_end = by_kind(_upper_end, _upper_end, _buoy_end)


@kernel
def _in_above(X0, X1, x, P0, P1):
    """A row of v_b = X y_a + x in y_b, with both rows (P, p) of y_a = P y_b + p."""
    by_tau, by_shear, known = mixed(X0, P0, X1, P1)
    return by_tau, by_shear, known + x


@kernel
def lateral_stage(p, tables, base, work, dC_tilde, H, E, dC):
    """dC (n, 2) = (q_y, V_y) of one stage, q_y,t = rate (q_y - q~_y) and V_y,t likewise, from dC_tilde (n, 2).

    base: Base, the planar stage (`engine.perturbations.tangent`); work: Work, whose X and Q are its places and
    directions (`node.shape`), F and sea the water there. H (n, 10), E (n, 15): work.
    """
    rate, Y, X, Q, F = base.rate, base.Y, work.X, work.Q, work.F
    n = Y.shape[0]
    _coefficients(p, tables, base, Q, F, H)
    more_across(p, base, X, Q, F, H)
    R00 = R01 = R10 = R11 = R20 = R21 = r0 = r1 = r2 = 0.0
    for i in range(WIDTH):
        E[0, i] = 0.0
    for k in range(1, n):
        a = k - 1
        e = 0.5 * tables[p.grid_at + a]
        er = e * rate
        # from the directions of node a to those of node b: half the turn below a and half the turn of this box
        s_b = H[a, SIN_HALF] * H[k, COS_HALF] + H[a, COS_HALF] * H[k, SIN_HALF]
        c_b = H[a, COS_HALF] * H[k, COS_HALF] - H[a, SIN_HALF] * H[k, SIN_HALF]
        half = 0.5 * (Y[k, col.PHI] - Y[a, col.PHI])
        long = abs(half) > 1e-4
        f = where(long, half, 1.0 + half * half / 6.0) / (e * where(long, H[k, SIN_HALF], 1.0))
        # v_b = X y_a + Z y_b + x
        X20, X21, x2 = c_b * R20 + s_b, c_b * R21, c_b * r2
        X10, X11, x1 = f * (s_b * R20 - c_b) - R10, f * s_b * R21 - R11, f * s_b * r2 - r1
        at, ar, bt, br = er * H[a, Q_TAU], er * H[a, Q_RHO], er * H[k, Q_TAU], er * H[k, Q_RHO]
        X00 = R00 + at + ar * R20 + br * X20
        X01 = R01 + ar * R21 + br * X21
        x0 = r0 + ar * r2 + br * x2 - er * (dC_tilde[a, QY] + dC_tilde[k, QY])
        # momentum and moment: A y_a + B y_b = g
        Ja, Jb = e * H[a, G_V], e * H[k, G_V]
        below_t, below_r = H[a, N_TAU] + e * H[a, G_TAU], H[a, N_RHO] + e * H[a, G_RHO]
        above_t, above_r = H[k, N_TAU] - e * H[k, G_TAU], H[k, N_RHO] - e * H[k, G_RHO]
        A00 = above_r * X20 - below_t - below_r * R20 - Ja * R00 - Jb * X00
        A01 = above_r * X21 - below_r * R21 + 1.0 - Ja * R01 - Jb * X01
        A10 = p.EI * (X10 - R10)
        A11 = p.EI * (X11 - R11) - e * H[a, CUBE]
        B00 = above_t - Jb * bt
        B10 = p.EI * f
        B11 = -e * H[k, CUBE]
        inertia, known = lateral_inertia(p, rate, e, Q[a], Q[k], dC_tilde[a, VY], dC_tilde[k, VY])
        g0 = below_r * r2 - above_r * x2 + Ja * r0 + Jb * x0 - inertia * known
        g1 = -p.EI * (x1 - r1)
        d = 1.0 / (A00 * A11 - A01 * A10)
        P0 = d * (A01 * B10 - A11 * B00), d * (A11 + A01 * B11), d * (A11 * g0 - A01 * g1)
        P1 = d * (A10 * B00 - A00 * B10), -d * (A10 + A00 * B11), d * (A00 * g1 - A10 * g0)
        R00, R01, r0 = _in_above(X00, X01, x0, P0, P1)
        R10, R11, r1 = _in_above(X10, X11, x1, P0, P1)
        R20, R21, r2 = _in_above(X20, X21, x2, P0, P1)
        R00, R10 = R00 + bt, R10 + f
        put(E[k], P, P0)
        put(E[k], P + 3, P1)
        put_rows(E[k], R, ((R00, R01, r0), (R10, R11, r1), (R20, R21, r2)))
    b = n - 1
    of_N, of_V, known = _lateral_end(p, base.t, rate, Y[b], F[b], dC_tilde[b, VY])
    if p.spherical_cap:
        cap = across_cap(p, base.t, rate, X[b], Y[b], F[b], dC_tilde[b, VY], work.sea)
        of_V, known = of_V + cap[0], known + cap[1]
    A00 = of_N * (H[b, N_TAU] + H[b, N_RHO] * R20) + of_V * R00
    A01 = of_N * (H[b, N_RHO] * R21 - 1.0) + of_V * R01
    g0 = -known - of_N * H[b, N_RHO] * r2 - of_V * r0
    d = 1.0 / (A00 * R11 - A01 * R10)
    y = d * (R11 * g0 + A01 * r1), -d * (A00 * r1 + R10 * g0), 1.0  # 1.0: for the known parts
    for k in range(n - 1, -1, -1):
        dC[k, VY], _, rho = times(rows_of(E[k], R), y)
        dC[k, QY] = H[k, Q_TAU] * y[0] + H[k, Q_RHO] * rho
        y = dot(vector(E[k], P), y), dot(vector(E[k], P + 3), y), 1.0


def energy_weights(p: np.void, tables: np.ndarray) -> np.ndarray:
    """Weights (n, 2) of q_y^2 and V_y^2: the energy of a lateral perturbation about rest, J.

    1/2 integral of (T/lam) q_y^2 + (m + m_a) V_y^2, and 1/2 (M + M_a) V_y^2 of the buoy. T and lam are the scales of
    the scene (`engine.parameters`), so that slack lines have a length too.
    """
    h = lengths_of(p, tables)
    shares = 0.25 * (np.append(h, 0.0) + np.append(0.0, h))
    load, lam = 20.0 / p["per_force"], 1.0 + 1.0 / p["per_strain"]
    weights = shares[:, None] * np.array([load / lam, p["m"] + p["ma"]])
    if p["end"] == BUOY:
        weights[-1, 1] += 0.5 * p["M_total"]
    return weights


@kernel
def normalise(weights, mask, vector, rates):
    """Bring vector (n, 2) to length one where `mask` holds, rates along; returns its length."""
    square = 0.0
    for k in range(vector.shape[0]):
        for m in range(2):
            square += weights[k, m] * (vector[k, m] * vector[k, m])
    return to_length_one(mask, math.sqrt(square), vector, rates)
