"""Tangent dynamics: infinitesimal perturbations carried through the accepted steps of a run (Benettin et al. 1980).

The engine's step is a map of (C, K), the conserved variables and their rates; its derivative needs at each stage one
linear solve with Newton's matrix at the converged state (`engine.perturbations.resolve`), no new Newton iteration:

    dC~_i = dC + dt sum_(j<i) a_ij dK_j,    J_i dY_i = known(dC~_i, dF_i),    dK_i = (dC_i - dC~_i)/(a_ii dt)

dF = J dX is the change of the water at the displaced nodes. It depends on dY through the positions dX, which Newton's
matrix leaves out; a fixed-point iteration puts it back, contracting by about the square of wave number times length.
The perturbations are re-orthonormalised (Gram-Schmidt) after every step, in the norm |dq|^2 + |dV|^2/speed^2 summed
over the nodes; the logarithms of their lengths add up to the growth of each period.

A loop release changes neither t, n, q nor V, so C, and with it dC, goes through it unchanged; the backward Euler steps
that follow start from C alone. What the release itself does - another tether shape from one moment to the next - is not
a derivative; the periods in which one happens are marked. What it does to the exponents: docs/findings.md.

`march` stores the accepted steps in a trail: T (m, 3): t, dt, 1 for a step of backward Euler, 2 for one that a
sudden start or a release asked for; Ys (m, s, n, 6) and Ks (m, s, n, 4), stages, of which backward Euler uses the last.
"""

import math

import numpy as np

from ..compiled import kernel
from ..physics.submergence import cap_change
from ..planar import elimination as sweep
from ..planar import node
from ..record import BUOY
from ..simd.elementary import copy_into
from ..simd.select import larger, some, where
from ..time.steps import add_rates, plan_stage
from .resolve import resolve_bent

WATER_ITERATIONS, WATER_TOLERANCE, NUDGE = 8, 1e-7, 1e-6


@kernel
def _nodal_change(p, cv, in_F, dV_tilde, F, Y, Q, dF, gamma):
    """gamma (n, 2): change of G that comes from V~ and the water; in_F 0.0 leaves the water out."""
    for k in range(Y.shape[0]):
        c, s = Q[k, 0], Q[k, 1]
        a, b = dV_tilde[k, 0], dV_tilde[k, 1]
        across = p.ma * cv * (b * c - a * s)
        gx = -p.m * cv * a + across * s
        gz = -p.m * cv * b - across * c
        if in_F > 0.0:
            root = math.sqrt(larger(1.0 + Y[k, 0], 0.0))
            ur, wr = Y[k, 2] - F[k, 0], Y[k, 3] - F[k, 1]
            along = 2.0 * p.ct * root * abs(ur * c + wr * s) * (dF[k, 0] * c + dF[k, 1] * s)
            normal = 2.0 * p.cn * root * abs(wr * c - ur * s) * (dF[k, 1] * c - dF[k, 0] * s)
            normal += p.Rw * (dF[k, 3] * c - dF[k, 2] * s)
            gx -= along * c - normal * s
            gz -= along * s + normal * c
        gamma[k, 0] = gx
        gamma[k, 1] = gz


@kernel
def _top_change(p, cv, dV_tilde, F, Y, dF):
    """Known part of the linearised condition of the upper end (`engine.physics.ends`), last node's rows given."""
    x = -p.M_total * cv * dV_tilde[0]
    z = -p.M_total * cv * dV_tilde[1]
    if p.wet:
        u, w = Y[2] - F[0], Y[3] - F[1]
        speed = math.sqrt(u * u + w * w)
        along = (u * dF[0] + w * dF[1]) / where(speed > 0.0, speed, 1.0)
        x -= p.C_buoy * (speed * dF[0] + u * along)
        z -= p.C_buoy * (speed * dF[1] + w * along)
        x -= p.M_wave * dF[2]
        z -= p.M_wave * dF[3]
    buoy = 1.0 if p.end == BUOY else 0.0
    return buoy * x, buoy * z


@kernel
def water_slopes(p, tables, t, X, X_moved, F_ahead, F_behind, J):
    """J (n, 8): how the water at each node depends on its place, dF/dx (4) and dF/dz (4), by central differences."""
    for axis in range(2):
        for sign in (1.0, -1.0):
            for k in range(X.shape[0]):
                X_moved[k, 0] = X[k, 0] + (sign * NUDGE if axis == 0 else 0.0)
                X_moved[k, 1] = X[k, 1] + (sign * NUDGE if axis == 1 else 0.0)
            node.water(p, tables, t, 1.0, X_moved, F_ahead if sign > 0.0 else F_behind)
        for k in range(X.shape[0]):
            for m in range(4):
                J[k, 4 * axis + m] = (F_ahead[k, m] - F_behind[k, m]) * (0.5 / NUDGE)


@kernel
def _displaced_water(p, tables, going_on, D, Q, J, dF):
    """dF: water at the nodes displaced by dY minus water where they are, where going_on holds.

    Returns the largest change of dF by this call, and the largest dF.
    """
    x = z = change = largest = 0.0
    for k in range(D.shape[0]):
        if k > 0:
            half, j = 0.5 * tables[p.grid_at + k - 1], k - 1
            x += half * (D[k, 0] * Q[k, 0] - D[k, 4] * Q[k, 6] + D[j, 0] * Q[j, 0] - D[j, 4] * Q[j, 6])
            z += half * (D[k, 0] * Q[k, 1] + D[k, 4] * Q[k, 5] + D[j, 0] * Q[j, 1] + D[j, 4] * Q[j, 5])
        for m in range(4):
            value = J[k, m] * x + J[k, 4 + m] * z
            change = larger(change, abs(value - dF[k, m]))
            largest = larger(largest, abs(value))
            dF[k, m] = where(going_on, value, dF[k, m])
    return change, largest


@kernel
def _displaced_end(p, tables, dC_tilde):
    """dX~ of the last node: by dX = dX~ + dV/rate it moves, the second part of which is in Newton's matrix."""
    x = z = 0.0
    for k in range(1, dC_tilde.shape[0]):
        half = 0.5 * tables[p.grid_at + k - 1]
        x += half * (dC_tilde[k - 1, 0] + dC_tilde[k, 0])
        z += half * (dC_tilde[k - 1, 1] + dC_tilde[k, 1])
    return x, z


@kernel
def tangent_stage(p, tables, t, rate, going_on, moving_water, X, Y, K, dC_tilde, dF, dC, Q, J, F, E, D, gamma):
    """dC (n, 4) of one vector at one stage whose matrix is in E; dF comes in as a first guess and is renewed.

    Both where going_on holds, and there until dF is settled. D (n, 6), gamma (n, 2): work.
    """
    n = Y.shape[0]
    for _ in range(WATER_ITERATIONS):
        _nodal_change(p, rate, moving_water, dC_tilde[:, 2:], F, Y, Q, dF, gamma)
        top_x, top_z = _top_change(p, rate, dC_tilde[n - 1, 2:], F[n - 1], Y[n - 1], dF[n - 1])
        if p.spherical_cap:
            dX_tilde = _displaced_end(p, tables, dC_tilde)
            more_x, more_z = cap_change(
                p, t, rate, X[n - 1], Y[n - 1], K[n - 1], F[n - 1], dC_tilde[n - 1, 2:], dX_tilde, dF[n - 1]
            )
            top_x, top_z = top_x + more_x, top_z + more_z
        resolve_bent(p, tables, rate, Q, E, dC_tilde[:, :2], gamma, top_x, top_z, D)
        for k in range(n):
            dC[k, 0] = where(going_on, D[k, 0] * Q[k, 0] - D[k, 4] * Q[k, 6], dC[k, 0])
            dC[k, 1] = where(going_on, D[k, 0] * Q[k, 1] + D[k, 4] * Q[k, 5], dC[k, 1])
            dC[k, 2] = where(going_on, D[k, 2], dC[k, 2])
            dC[k, 3] = where(going_on, D[k, 3], dC[k, 3])
        if moving_water == 0.0:
            break
        change, largest = _displaced_water(p, tables, going_on, D, Q, J, dF)
        going_on = going_on & (change > WATER_TOLERANCE * largest)
        if not some(going_on):
            break


@kernel
def orthonormalise(weight, here, vectors, rates, lengths):
    """Gram-Schmidt over vectors (k, n, 4) where `here` holds, rates taken along; the length of each before it."""
    count, n = vectors.shape[0], vectors.shape[1]
    for i in range(count):
        for j in range(i):
            product = 0.0
            for k in range(n):
                for m in range(2):
                    product += vectors[i, k, m] * vectors[j, k, m]
                for m in range(2, 4):
                    product += weight * (vectors[i, k, m] * vectors[j, k, m])
            product = where(here, product, 0.0)
            for k in range(n):
                for m in range(4):
                    vectors[i, k, m] -= product * vectors[j, k, m]
                    rates[i, k, m] -= product * rates[j, k, m]
        square = 0.0
        for k in range(n):
            for m in range(2):
                square += vectors[i, k, m] * vectors[i, k, m]
            for m in range(2, 4):
                square += weight * (vectors[i, k, m] * vectors[i, k, m])
        length = math.sqrt(square)
        lengths[i] = length
        scale = where(here & (length > 0.0), 1.0 / length, 1.0)
        for k in range(n):
            for m in range(4):
                vectors[i, k, m] *= scale
                rates[i, k, m] *= scale


@kernel
def linearise(p, tables, t, rate, moving_water, Y, K, X, F, C_tilde, Q, E, J, work):
    """Newton's matrix, eliminated, at a stage Y with rates K: into E (n, 33); Q, F, X and J (n, 8) belong to it.

    work: D (n, 6), places (n, 2), water (n, 4) twice.
    """
    D, X_moved, F_ahead, F_behind = work
    node.shape(p, tables, Y, Q, X)
    node.water(p, tables, t, 1.0, X, F)
    for k in range(Y.shape[0]):
        for m in range(2):
            C_tilde[k, m] = Q[k, 5 + m] - K[k, m] / rate
            C_tilde[k, 2 + m] = Y[k, 2 + m] - K[k, 2 + m] / rate
    node.node_quantities(p, tables, rate, rate, 1.0, Y, C_tilde, F, Q)
    sweep.sweep_bent(p, tables, t, rate, rate, 1.0, Y, C_tilde, X, F, Q, E, D)
    if moving_water > 0.0:
        water_slopes(p, tables, t, X, X_moved, F_ahead, F_behind, J)


@kernel
def carry_stage(
    p, tables, t, rate, a, count, here, moving_water, X, Y, K, v, vectors, dKs, waters, dC_tilde, dCs,
    Q, J, F, E, D, gamma,
):  # fmt: skip
    """Perturbation number v through one linearised stage, where `here` holds: into dCs[v], from vectors[v] and the
    first `count` of dKs[v].
    """
    for k in range(Y.shape[0]):
        for m in range(4):
            dC_tilde[k, m] = vectors[v, k, m]
        add_rates(p, a, count, dKs[v], k, dC_tilde[k])
    tangent_stage(p, tables, t, rate, here, moving_water, X, Y, K, dC_tilde, waters[v], dCs[v], Q, J, F, E, D, gamma)


@kernel
def water_moves(p):
    """1.0 where the water depends on the place of a node, else 0.0."""
    return 1.0 if p.waves or (p.current and p.cur_nx * p.cur_nz > 1) else 0.0


@kernel
def period_of(t, period, periods):
    """Number of the period in which a step that ends at t is counted."""
    return min(int(t / period - 1e-9), periods - 1)


@kernel
def carry(p, tables, period, count, T, trail_Y, trail_K, vectors, rates, waters, growth):
    """Carry perturbations through the first `count` steps of a trail.

    vectors, rates (k, n, 4): dC and dK, orthonormal in C on entry and exit; waters (k, n, 4): first guesses of dF.
    growth (periods, k), nats: what each step adds goes to the period in which it ends (the last, beyond the end).
    """
    number, n, s = vectors.shape[0], vectors.shape[1], trail_Y.shape[1]
    X, F, Q = np.zeros((n, 2)), np.zeros((n, 4)), np.zeros((n, node.WIDTH))
    E, C_tilde, J = np.zeros((n, sweep.WITH_INVERSE)), np.zeros((n, 4)), np.zeros((n, 8))
    D, gamma = np.zeros((n, 6)), np.zeros((n, 2))
    work = (D, np.zeros((n, 2)), np.zeros((n, 4)), np.zeros((n, 4)))
    dCs, dKs, dC_tilde = np.zeros((number, n, 4)), np.zeros((number, s, n, 4)), np.zeros((n, 4))
    a, w, lengths = np.empty(s), np.empty(3), np.empty(number)
    moving_water = water_moves(p)
    for step in range(count):
        t, dt, euler = T[step, 0], T[step, 1], T[step, 2] > 0.0
        for v in range(number):
            copy_into(dKs[v, 0], rates[v])
        for i in range(s - 1 if euler else 1, s):
            rate, after = plan_stage(p, tables, i, euler, dt, 0.0, a, w)
            Y, known = trail_Y[step, i], 0 if euler else i
            linearise(p, tables, t + after, rate, moving_water, Y, trail_K[step, i], X, F, C_tilde, Q, E, J, work)
            for v in range(number):
                carry_stage(
                    p, tables, t + after, rate, a, known, True, moving_water, X, Y, trail_K[step, i], v, vectors, dKs,
                    waters, dC_tilde, dCs, Q, J, F, E, D, gamma,
                )  # fmt: skip
                for k in range(n):
                    for m in range(4):
                        dKs[v, i, k, m] = rate * (dCs[v, k, m] - dC_tilde[k, m])
        for v in range(number):
            copy_into(vectors[v], dCs[v])
            copy_into(rates[v], dKs[v, s - 1])
        orthonormalise(p.per_speed * p.per_speed, True, vectors, rates, lengths)
        for v in range(number):
            growth[period_of(t + dt, period, growth.shape[0]), v] += np.log(lengths[v])
