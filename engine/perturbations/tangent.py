"""Tangent dynamics: infinitesimal perturbations carried through the accepted steps of a run (Benettin et al. 1980).

The engine's step is a map of (C, K), the conserved variables and their rates; its derivative needs at each stage one
linear solve with Newton's matrix at the converged state (`resolve_bent`), no new Newton iteration:

    dC~_i = dC + dt sum_(j<i) a_ij dK_j,    J_i dY_i = known(dC~_i, dF_i),    dK_i = (dC_i - dC~_i)/(a_ii dt)

That solve is another right-hand side for the matrix that `planar.elimination.eliminate` has eliminated, one pass up,
one down:

    dV_b - dV_a - e (dq_t,a + dq_t,b) = 0, dq_t = cq (dq/dy dy - dq~)      -> c = e cq (dq~_a + dq~_b)
    dN_b - dN_a - e (dG_a + dG_b) = 0, dG = (dG/dy) dy + (dG/dV) dV + gamma -> g = e (gamma_a + gamma_b)

with gamma the change of G that comes from V~ and from the water at the displaced node; curvature and moment have no
known terms. At the upper end `top` is the known part of its residual.

dF = J dX is the change of the water at the displaced nodes. It depends on dY through the positions dX, which Newton's
matrix leaves out; a fixed-point iteration puts it back, contracting by about the square of wave number times length.
After every step the perturbations are made orthonormal (Gram-Schmidt) in the norm of THEORY.md, section 11, summed over
the nodes; the logarithms of their lengths add up to the growth of each period. A loop release leaves dC unchanged; the
periods in which one happens are marked, because another shape of the tether is not a derivative (docs/findings.md).

`march` stores the accepted steps in a Trail (`engine.arrays`); of the stages backward Euler uses the last.
"""

import math
from collections import namedtuple

from ..arrays import Stage
from ..compiled import kernel
from ..dimensions import eliminate, node_quantities, shape
from ..physics.submergence import change_of_cap
from ..physics.water import water as flow
from ..planar import columns as col
from ..planar.elimination import back_substitute, inertia_of_box
from ..record import BUOY
from ..simd.select import larger, some, where
from ..spatial.vectors import dot, put, rows_of, times

WATER_ITERATIONS, WATER_TOLERANCE, NUDGE = 8, 1e-7, 1e-6
# The stage that is perturbed: t (s), rate (1/s) = 1/(a_ii dt), moving_water: 1.0 where the water depends on the place
# of a node, else 0.0; Y (n, 6), its rates K (n, 4)
Base = namedtuple("Base", "t rate moving_water Y K")
# How the water at the nodes changes: J (n, 8), dF/dx (4) and dF/dz (4); work: gamma (n, 2), the change of G; places
# (n, 2) moved, water (n, 4) ahead of and behind a node
Water = namedtuple("Water", "J gamma X_moved F_ahead F_behind")


@kernel
def _nodal_change(p, base, dC_tilde, work, dF, gamma):
    """gamma (n, 2): change of G that comes from V~ and, where it moves, the water."""
    Y, cv, Q, F = base.Y, base.rate, work.Q, work.F
    for k in range(Y.shape[0]):
        c, s = Q[k, col.COS], Q[k, col.SIN]
        a, b = dC_tilde[k, col.VX], dC_tilde[k, col.VZ]
        across = p.ma * cv * (b * c - a * s)
        gx = -p.m * cv * a + across * s
        gz = -p.m * cv * b - across * c
        if base.moving_water > 0.0:
            root = math.sqrt(larger(1.0 + Y[k, col.EPS], 0.0))
            ur, wr = Y[k, col.VX] - F[k, col.UX], Y[k, col.VZ] - F[k, col.UZ]
            along = 2.0 * p.ct * root * abs(ur * c + wr * s) * (dF[k, col.UX] * c + dF[k, col.UZ] * s)
            normal = 2.0 * p.cn * root * abs(wr * c - ur * s) * (dF[k, col.UZ] * c - dF[k, col.UX] * s)
            normal += p.Rw * (dF[k, col.AZ] * c - dF[k, col.AX] * s)
            gx -= along * c - normal * s
            gz -= along * s + normal * c
        gamma[k, 0] = gx
        gamma[k, 1] = gz


@kernel
def _top_change(p, cv, dC_tilde, F, Y, dF):
    """Known part of the linearised condition of the upper end (`engine.physics.ends`); arguments: last node's rows."""
    x = -p.M_total * cv * dC_tilde[col.VX]
    z = -p.M_total * cv * dC_tilde[col.VZ]
    if p.wet:
        u, w = Y[col.VX] - F[col.UX], Y[col.VZ] - F[col.UZ]
        speed = math.sqrt(u * u + w * w)
        along = (u * dF[col.UX] + w * dF[col.UZ]) / where(speed > 0.0, speed, 1.0)
        x -= p.C_buoy * (speed * dF[col.UX] + u * along)
        z -= p.C_buoy * (speed * dF[col.UZ] + w * along)
        x -= p.M_wave * dF[col.AX]
        z -= p.M_wave * dF[col.AZ]
    buoy = 1.0 if p.end == BUOY else 0.0
    return buoy * x, buoy * z


@kernel
def water_slopes(p, tables, t, X, water):
    """water.J: how the water at the nodes depends on their places X (n, 2), by central differences."""
    J, _, X_moved, F_ahead, F_behind = water
    for axis in range(2):
        for sign in (1.0, -1.0):
            for k in range(X.shape[0]):
                X_moved[k, 0] = X[k, 0] + (sign * NUDGE if axis == 0 else 0.0)
                X_moved[k, 1] = X[k, 1] + (sign * NUDGE if axis == 1 else 0.0)
            flow(p, tables, t, 1.0, X_moved, F_ahead if sign > 0.0 else F_behind)
        for k in range(X.shape[0]):
            for m in range(4):
                J[k, 4 * axis + m] = (F_ahead[k, m] - F_behind[k, m]) * (0.5 / NUDGE)


@kernel
def _displaced_water(p, tables, going_on, work, J, dF):
    """dF: water at the nodes displaced by dY (in work.D) minus water where they are, where going_on holds.

    Returns the largest change of dF by this call, and the largest dF.
    """
    D, Q = work.D, work.Q
    x = z = change = largest = 0.0
    for k in range(D.shape[0]):
        if k > 0:
            half, j = 0.5 * tables[p.grid_at + k - 1], k - 1
            eps, phi, eps_below, phi_below = D[k, col.EPS], D[k, col.PHI], D[j, col.EPS], D[j, col.PHI]
            x += half * (
                eps * Q[k, col.COS] - phi * Q[k, col.QZ] + eps_below * Q[j, col.COS] - phi_below * Q[j, col.QZ]
            )
            z += half * (
                eps * Q[k, col.SIN] + phi * Q[k, col.QX] + eps_below * Q[j, col.SIN] + phi_below * Q[j, col.QX]
            )
        for m in range(4):
            value = J[k, m] * x + J[k, 4 + m] * z
            change = larger(change, abs(value - dF[k, m]))
            largest = larger(largest, abs(value))
            dF[k, m] = where(going_on, value, dF[k, m])
    return change, largest


@kernel
def _displaced_end(p, tables, dC_tilde):
    """dX~ of the last node: it moves by dX = dX~ + dV/rate, and dV/rate is already in Newton's matrix."""
    x = z = 0.0
    for k in range(1, dC_tilde.shape[0]):
        half = 0.5 * tables[p.grid_at + k - 1]
        x += half * (dC_tilde[k - 1, col.CX] + dC_tilde[k, col.CX])
        z += half * (dC_tilde[k - 1, col.CZ] + dC_tilde[k, col.CZ])
    return x, z


@kernel
def resolve_bent(p, tables, cq, work, dC_tilde, gamma, top_x, top_z):
    """Fill work.D (n, 6) with the perturbation dY; work.E (n, 33) comes from `eliminate` at the same state.

    p, tables: parameters; cq (1/s); dC_tilde (n, 4), of which dq~ counts; gamma (n, 2) N/m; top_x, top_z in the units
    of the end's condition. Overwrites p and r in E. "Bent": a line without bending carries no perturbations.
    """
    Q, E = work.Q, work.E
    n = Q.shape[0]
    r0 = r1 = r2 = 0.0
    put(E[0], col.R_KNOWN, (0.0, 0.0, 0.0))
    for k in range(1, n):
        a = k - 1
        Qa, row = Q[a], E[k]
        e = 0.5 * tables[p.grid_at + a]
        ec = e * cq
        cx = ec * (dC_tilde[a, col.CX] + dC_tilde[k, col.CX])
        cz = ec * (dC_tilde[a, col.CZ] + dC_tilde[k, col.CZ])
        (Kxx, Kxz, Kzz), (Jxx, Jxz, Jzz) = inertia_of_box(e, Qa, Q[k])
        g = (
            e * (gamma[a, 0] + gamma[k, 0]) + Kxx * r0 + Kxz * r1 - Jxx * cx - Jxz * cz,
            e * (gamma[a, 1] + gamma[k, 1]) + Kxz * r0 + Kzz * r1 - Jxz * cx - Jzz * cz,
            2.0 * p.EI * r2,
        )
        # y_a = P y_b + p, then v_b = R_b y_b + r
        known = times(rows_of(row, col.INVERSE), g)
        Rx, Rz, Rk = rows_of(E[a], col.R)
        r0 += dot((Rx[0] + ec * Qa[col.COS], Rx[1], Rx[2] - ec * Qa[col.QZ]), known) - cx
        r1 += dot((Rz[0] + ec * Qa[col.SIN], Rz[1], Rz[2] + ec * Qa[col.QX]), known) - cz
        r2 = dot((-Rk[0], -Rk[1], -(Rk[2] + 1.0 / e)), known) - r2
        put(row, col.P_KNOWN, known)
        put(row, col.R_KNOWN, (r0, r1, r2))
    g0 = -top_x - E[0, col.TOP_DXX] * r0 - E[0, col.TOP_DXZ] * r1
    g1 = -top_z - E[0, col.TOP_DZX] * r0 - E[0, col.TOP_DZZ] * r1
    back_substitute(E, (g0, g1, -r2), work.D)


@kernel
def tangent_stage(p, tables, base, going_on, dC_tilde, dF, dC, work, water):
    """dC (n, 4) of one perturbation at one stage whose matrix is in work.E; dF (n, 4) comes in as a first guess.

    Both are renewed where going_on holds, and there until dF is settled. dC_tilde (n, 4): what the perturbation makes
    of C~; base: Base; work, water: as `linearise` has left them.
    """
    D, Q, F = work.D, work.Q, work.F
    last = base.Y.shape[0] - 1
    for _ in range(WATER_ITERATIONS):
        _nodal_change(p, base, dC_tilde, work, dF, water.gamma)
        top_x, top_z = _top_change(p, base.rate, dC_tilde[last], F[last], base.Y[last], dF[last])
        if p.spherical_cap:
            dX_tilde = _displaced_end(p, tables, dC_tilde)
            more = change_of_cap(
                p, base.t, base.rate, work.X[last], base.Y[last], base.K[last], F[last], dC_tilde[last, 2:], dX_tilde,
                dF[last],
            )  # fmt: skip
            top_x, top_z = top_x + more[0], top_z + more[1]
        resolve_bent(p, tables, base.rate, work, dC_tilde, water.gamma, top_x, top_z)
        for k in range(last + 1):
            eps, phi = D[k, col.EPS], D[k, col.PHI]
            dC[k, col.CX] = where(going_on, eps * Q[k, col.COS] - phi * Q[k, col.QZ], dC[k, col.CX])
            dC[k, col.CZ] = where(going_on, eps * Q[k, col.SIN] + phi * Q[k, col.QX], dC[k, col.CZ])
            dC[k, col.VX] = where(going_on, D[k, col.VX], dC[k, col.VX])
            dC[k, col.VZ] = where(going_on, D[k, col.VZ], dC[k, col.VZ])
        if base.moving_water == 0.0:
            break
        change, largest = _displaced_water(p, tables, going_on, work, water.J, dF)
        going_on = going_on & (change > WATER_TOLERANCE * largest)
        if not some(going_on):
            break


@kernel
def _inner(weight, a, b):
    """Inner product of two perturbations (n, 4), the velocities with this weight."""
    product = 0.0
    for k in range(a.shape[0]):
        for m in range(2):
            product += a[k, m] * b[k, m]
        for m in range(2, 4):
            product += weight * (a[k, m] * b[k, m])
    return product


@kernel
def to_length_one(here, length, vector, rates):
    """Divide vector (n, m) and its rates by its length where `here` holds and it has one; returns the length."""
    scale = where(here & (length > 0.0), 1.0 / length, 1.0)
    for k in range(vector.shape[0]):
        for m in range(vector.shape[1]):
            vector[k, m] *= scale
            rates[k, m] *= scale
    return length


@kernel
def orthonormalise(weight, here, vectors, rates, lengths):
    """Gram-Schmidt over vectors (k, n, 4) where `here` holds, rates taken along; the length of each before it."""
    count, n = vectors.shape[0], vectors.shape[1]
    for i in range(count):
        for j in range(i):
            product = where(here, _inner(weight, vectors[i], vectors[j]), 0.0)
            for k in range(n):
                for m in range(4):
                    vectors[i, k, m] -= product * vectors[j, k, m]
                    rates[i, k, m] -= product * rates[j, k, m]
        lengths[i] = to_length_one(here, math.sqrt(_inner(weight, vectors[i], vectors[i])), vectors[i], rates[i])


@kernel
def linearise(p, tables, base, work, water):
    """Newton's matrix, eliminated, at a stage (Base), whose C~ = C - K/rate: into work.E (n, 33), with Q, F, X, J."""
    Y, K, Q, C_tilde, rate = base.Y, base.K, work.Q, work.C_tilde, base.rate
    shape(p, tables, Y, Q, work.X)
    flow(p, tables, base.t, 1.0, work.X, work.F)
    for k in range(Y.shape[0]):
        for m in range(2):
            C_tilde[k, m] = Q[k, col.QX + m] - K[k, m] / rate
            C_tilde[k, col.VX + m] = Y[k, col.VX + m] - K[k, col.VX + m] / rate
    stage = Stage(base.t, 1.0, rate, rate)
    node_quantities(p, tables, stage, Y, work)
    eliminate(p, tables, stage, Y, work)
    if base.moving_water > 0.0:
        water_slopes(p, tables, base.t, work.X, water)


@kernel
def water_moves(p):
    """1.0 where the water depends on the place of a node, else 0.0."""
    return 1.0 if p.waves or (p.current and p.cur_nx * p.cur_nz > 1) else 0.0


@kernel
def period_of(t, period, periods):
    """Number of the period in which a step that ends at t is counted."""
    return min(int(t / period - 1e-9), periods - 1)
