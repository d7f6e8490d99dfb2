"""Tangent dynamics: infinitesimal perturbations carried through the accepted steps of a run (Benettin et al. 1980).

The engine's step is a map of (C, K), the conserved variables and their rates; its derivative needs at each stage one
linear solve with Newton's matrix at the converged state, no new Newton iteration:

    dC~_i = dC + dt sum_(j<i) a_ij dK_j,    J_i dY_i = known(dC~_i),    dK_i = c (dC_i - dC~_i),    c = 1/(a_ii dt)

Newton's matrix leaves out that the water differs from place to place; here it may not be left out. The box rule of
compatibility, summed from the anchor, is the rate of the places, dV = c (dX - dX~) with dX~ the places that dC~ gives.
In the unknown v = c dX = dV + c dX~ in the place of dV compatibility has no known part, and what depends on the place
of a node depends on its v alone. So the water joins the matrix, and one solve is all:

    dG = (dG/dy) dy + (dG/dV + B/c) v + gamma,    B = (dG/dF) dF/dX,    gamma = -dG/dV c dX~ - dG/dV_t c dV~
    dN_b - dN_a - e (dG_a + dG_b) = 0             -> g = e (gamma_a + gamma_b)

with F the velocity and the acceleration of the water; the upper end likewise. That solve is another right-hand side
for the matrix that `planar.elimination.eliminate` has eliminated, one pass up, one down.

After every step the perturbations are made orthonormal (Gram-Schmidt) in the norm of THEORY.md, section 11, summed over
the nodes; the logarithms of their lengths add up to the growth of each period. A loop release leaves dC unchanged; the
periods in which one happens are marked, because another shape of the tether is not a derivative (docs/results.md).

`march` stores the accepted steps in a Trail (`engine.arrays`); of the stages backward Euler uses the last.
"""

import math
from collections import namedtuple

import numpy as np

from ..arrays import Stage, Work
from ..compiled import kernel
from ..dimensions import eliminate, node_quantities, shape
from ..physics import sea_series
from ..physics.submergence import change_of_cap
from ..physics.water import water as flow
from ..physics.water import water_and_slopes
from ..planar import columns as col
from ..planar.elimination import inertia_of_box
from ..planar.extras import beside_drag, known_end, known_force, known_places, node_width, push_by_place
from ..record import BUOY
from ..simd.select import where
from ..spatial.vectors import affine, dot, put, quaternion, rows_of, times, vector

# The stage that is perturbed: t (s), rate c (1/s); moving_water: 1.0 where the water depends on the place of a node,
# else 0.0; Y (n, 6), its rates K (n, 4)
Base = namedtuple("Base", "t rate moving_water Y K")
# What the water does at the nodes: J (n, 8), dF/dx (4) and dF/dz (4); drag (n, 4), xx, xz, zx, zz of -dG/dU_w
Water = namedtuple("Water", "J drag")


@kernel
def tangent_arrays(p, n):
    """Work with room for what `linearise` eliminates, and Water, of n nodes."""
    X, F, Q = np.zeros((n, 2)), np.zeros((n, 4)), np.zeros((n, node_width(p)))
    E, sea = np.zeros((n, col.WITH_INVERSE)), np.zeros((n + 1, sea_series.WIDTH))
    return Work(X, F, Q, E, np.zeros((n, 6)), np.zeros((n, 4)), sea), Water(np.zeros((n, 8)), np.zeros((n, 4)))


@kernel
def linearise(p, tables, base, work, water):
    """The matrix of a stage (Base), eliminated, into work.E (n, 33), with the Q, X, F it belongs to, and Water."""
    Y, K, Q, C_tilde, rate = base.Y, base.K, work.Q, work.C_tilde, base.rate
    shape(p, tables, Y, Q, work.X)
    if base.moving_water == 0.0:
        flow(p, tables, base.t, 1.0, work.X, work.F, work.sea)
    else:
        water_and_slopes(p, tables, base.t, work.X, work.F, water.J, work.sea)
    over = 1.0 / rate
    for k in range(Y.shape[0]):
        for m in range(2):
            C_tilde[k, m] = Q[k, col.QX + m] - over * K[k, m]
            C_tilde[k, col.VX + m] = Y[k, col.VX + m] - over * K[k, col.VX + m]
    known_places(p, tables, over, Y, work)
    stage = Stage(base.t, 1.0, rate, rate)
    node_quantities(p, tables, stage, Y, work)
    _add_water(p, tables, base, work, water)
    eliminate(p, tables, stage, Y, work)


@kernel
def _add_water(p, tables, base, work, water):
    """Water; B/c (head of this file) into dG/dV in work.Q, and what is added to D of the upper end into work.E."""
    Q, top, rate, over = work.Q, work.E[0], base.rate, 1.0 / base.rate
    for k in range(Q.shape[0]):
        c, s = Q[k, col.COS], Q[k, col.SIN]
        share, by_velocity, place = beside_drag(p, Q[k])
        ma, drag = share * p.ma, water.drag[k]
        drag[0] = Q[k, col.GXX] - rate * (p.m + ma * s * s) - (by_velocity[0] + place[0])
        drag[1] = Q[k, col.GXZ] + rate * ma * c * s - (by_velocity[1] + place[1])
        drag[2] = Q[k, col.GZX] + rate * ma * c * s - (by_velocity[2] + place[2])
        drag[3] = Q[k, col.GZZ] - rate * (p.m + ma * c * c) - (by_velocity[3] + place[3])
    for m in range(4):
        top[col.TOP_DXX + m] = 0.0
    if base.moving_water == 0.0:
        return
    for k in range(Q.shape[0]):
        c, s = Q[k, col.COS], Q[k, col.SIN]
        xx, xz, zx, zz = quaternion(water.drag[k], 0)
        J, Rw = water.J[k], beside_drag(p, Q[k])[0] * p.Rw
        Ux, Wx, ax, az = J[0], J[1], J[2], J[3]
        Uz, Wz, bx, bz = J[4], J[5], J[6], J[7]
        by_x, by_z = Rw * (az * c - ax * s), Rw * (bz * c - bx * s)
        Q[k, col.GXX] -= over * (xx * Ux + xz * Wx - s * by_x)
        Q[k, col.GXZ] -= over * (xx * Uz + xz * Wz - s * by_z)
        Q[k, col.GZX] -= over * (zx * Ux + zz * Wx + c * by_x)
        Q[k, col.GZZ] -= over * (zx * Uz + zz * Wz + c * by_z)
        push_by_place(p, over, Q[k], J)
    last = Q.shape[0] - 1
    for axis in range(2):
        dF = _water_change(water.J[last], 1.0 - axis, 1.0 * axis)
        x, z = _end_change(p, tables, base, work, (0.0, 0.0), (0.0, 0.0), dF)
        top[col.TOP_DXX + axis], top[col.TOP_DZX + axis] = over * x, over * z


@kernel
def _water_change(J, x, z):
    """Change (4) of the water at a node that is moved by x, z; J (8): its row."""
    return J[0] * x + J[4] * z, J[1] * x + J[5] * z, J[2] * x + J[6] * z, J[3] * x + J[7] * z


@kernel
def _end_change(p, tables, base, work, dV_tilde, dX_tilde, dF):
    """Known part of the linearised condition of the upper end (`engine.physics.ends`), for changes of V~, X~ (2) and of
    the water (4) there."""
    last = base.Y.shape[0] - 1
    F, Y = work.F[last], base.Y[last]
    x = -p.M_total * base.rate * dV_tilde[0]
    z = -p.M_total * base.rate * dV_tilde[1]
    if p.wet:
        u, w = Y[col.VX] - F[col.UX], Y[col.VZ] - F[col.UZ]
        speed = math.sqrt(u * u + w * w)
        slip_change = (u * dF[col.UX] + w * dF[col.UZ]) / where(speed > 0.0, speed, 1.0)
        x -= p.C_buoy * (speed * dF[col.UX] + u * slip_change)
        z -= p.C_buoy * (speed * dF[col.UZ] + w * slip_change)
        x -= p.M_wave * dF[col.AX]
        z -= p.M_wave * dF[col.AZ]
    buoy = 1.0 if p.end == BUOY else 0.0
    x, z = buoy * x, buoy * z
    if p.spherical_cap:
        cap = change_of_cap(p, base, work.X[last], F, dV_tilde, dX_tilde, dF, work.sea)
        x, z = x + cap[0], z + cap[1]
    return x, z


@kernel
def _known_load(p, rate, row, drag, dC_tilde, x, z):
    """gamma (head of this file) of a node: its rows of Q, drag and dC~; x, z: c dX~."""
    share, by_velocity, _ = beside_drag(p, row)
    xx, xz, zx, zz = (
        drag[0] + by_velocity[0],
        drag[1] + by_velocity[1],
        drag[2] + by_velocity[2],
        drag[3] + by_velocity[3],
    )
    a, b = rate * (dC_tilde[col.VX] + x), rate * (dC_tilde[col.VZ] + z)
    c, s = row[col.COS], row[col.SIN]
    across = share * p.ma * (b * c - a * s)
    return -(xx * x + xz * z + p.m * a - across * s), -(zx * x + zz * z + p.m * b + across * c)


@kernel
def _up_the_line(p, tables, base, work, water, dC_tilde, known_of_box):
    """One pass up: p of every box into known_of_box (n, 3). Returns dy = (deps, dS, dphi) and dV of the upper end."""
    Q, E, rate = work.Q, work.E, base.rate
    n = Q.shape[0]
    r0 = r1 = r2 = x = z = 0.0  # x, z: c dX~
    gx, gz = _known_load(p, rate, Q[0], water.drag[0], dC_tilde[0], x, z)
    nx, nz = known_force(p, rate, Q[0], dC_tilde[0])
    for k in range(1, n):
        a = k - 1
        Qa, row = Q[a], E[k]
        e = 0.5 * tables[p.grid_at + a]
        ec = e * rate
        x += ec * (dC_tilde[a, col.CX] + dC_tilde[k, col.CX])
        z += ec * (dC_tilde[a, col.CZ] + dC_tilde[k, col.CZ])
        gx_below, gz_below, nx_below, nz_below = gx, gz, nx, nz
        gx, gz = _known_load(p, rate, Q[k], water.drag[k], dC_tilde[k], x, z)
        nx, nz = known_force(p, rate, Q[k], dC_tilde[k])
        Kxx, Kxz, Kzx, Kzz = inertia_of_box(e, Qa, Q[k])[0]
        g = (
            e * (gx_below + gx) + Kxx * r0 + Kxz * r1 - (nx - nx_below),
            e * (gz_below + gz) + Kzx * r0 + Kzz * r1 - (nz - nz_below),
            2.0 * p.EI * r2,
        )
        # y_a = P y_b + p, then v_b = R_b y_b + r
        known = times(rows_of(row, col.INVERSE), g)
        Rx, Rz, Rk = rows_of(E[a], col.R)
        r0 += dot((Rx[0] + ec * Qa[col.COS], Rx[1], Rx[2] - ec * Qa[col.QZ]), known)
        r1 += dot((Rz[0] + ec * Qa[col.SIN], Rz[1], Rz[2] + ec * Qa[col.QX]), known)
        r2 = dot((-Rk[0], -Rk[1], -(Rk[2] + 1.0 / e)), known) - r2
        put(known_of_box[k], 0, known)
    last, X, Z = n - 1, x / rate, z / rate
    dV_tilde = dC_tilde[last, col.VX], dC_tilde[last, col.VZ]
    top_x, top_z = _end_change(p, tables, base, work, dV_tilde, (X, Z), _water_change(water.J[last], X, Z))
    more_x, more_z = known_end(p, base.t, nx, nz)
    top_x, top_z = top_x + more_x, top_z + more_z
    Dxx, Dxz, Dzx, Dzz = quaternion(E[0], col.TOP_DXX)
    r0, r1 = r0 - x, r1 - z
    g = -top_x - Dxx * r0 - Dxz * r1, -top_z - Dzx * r0 - Dzz * r1, -r2
    y, (Rx, Rz, _) = times(rows_of(E[0], col.TOP), g), rows_of(E[last], col.R)
    return y, dot(Rx, y) + r0, dot(Rz, y) + r1


@kernel
def tangent_stage(p, tables, base, dC_tilde, dC, dK, work, water, known_of_box):
    """dC, dK (n, 4) of one perturbation at a stage that `linearise` has eliminated.

    dC_tilde (n, 4): what the perturbation makes of C~; known_of_box (n, 3): work. Down the line velocities follow from
    the box rule of compatibility, V_a = V_b - e (q_t,a + q_t,b). A line without bending carries no perturbations.
    """
    Q, rate, n = work.Q, base.rate, base.Y.shape[0]
    y, U, W = _up_the_line(p, tables, base, work, water, dC_tilde, known_of_box)
    e = x_above = z_above = 0.0
    for k in range(n - 1, -1, -1):
        row, known, C, K = Q[k], dC_tilde[k], dC[k], dK[k]
        C[col.CX] = y[0] * row[col.COS] - y[2] * row[col.QZ]
        C[col.CZ] = y[0] * row[col.SIN] + y[2] * row[col.QX]
        x, z = rate * (C[col.CX] - known[col.CX]), rate * (C[col.CZ] - known[col.CZ])
        U -= e * (x_above + x)
        W -= e * (z_above + z)
        C[col.VX], C[col.VZ] = U, W
        K[col.CX], K[col.CZ] = x, z
        K[col.VX], K[col.VZ] = rate * (U - known[col.VX]), rate * (W - known[col.VZ])
        x_above, z_above = x, z
        if k > 0:
            e = 0.5 * tables[p.grid_at + k - 1]
            y = affine(rows_of(work.E[k], col.P), y, vector(known_of_box[k], 0))
    for m in (col.VX, col.VZ):  # the anchor does not move
        dC[0, m] = dK[0, m] = 0.0


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
def to_length_one(mask, length, vector, rates):
    """Divide vector (n, m) and its rates by its length where `mask` holds and it has one; returns the length."""
    scale = where(mask & (length > 0.0), 1.0 / length, 1.0)
    for k in range(vector.shape[0]):
        for m in range(vector.shape[1]):
            vector[k, m] *= scale
            rates[k, m] *= scale
    return length


@kernel
def orthonormalise(weight, mask, vectors, rates, lengths):
    """Gram-Schmidt over vectors (k, n, 4) where `mask` holds, rates taken along; the length of each before it."""
    count, n = vectors.shape[0], vectors.shape[1]
    for i in range(count):
        for j in range(i):
            product = where(mask, _inner(weight, vectors[i], vectors[j]), 0.0)
            for k in range(n):
                for m in range(4):
                    vectors[i, k, m] -= product * vectors[j, k, m]
                    rates[i, k, m] -= product * rates[j, k, m]
        lengths[i] = to_length_one(mask, math.sqrt(_inner(weight, vectors[i], vectors[i])), vectors[i], rates[i])


@kernel
def water_moves(p):
    """1.0 where the water depends on the place of a node, else 0.0."""
    return 1.0 if p.waves or (p.current and p.cur_nx * p.cur_nz > 1) else 0.0


@kernel
def period_of(t, period, periods):
    """Number of the period in which a step that ends at t is counted."""
    return min(int(t / period - 1e-9), periods - 1)
