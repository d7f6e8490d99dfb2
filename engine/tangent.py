"""Tangent dynamics: infinitesimal perturbations carried through the accepted steps of a run (Benettin et al. 1980).

The engine's step is a map of (C, K), the conserved variables and their rates; its derivative needs at each stage one
linear solve with Newton's matrix at the converged state (`engine.planar.resolve`), no new Newton iteration:

    dC~_i = dC + dt sum_(j<i) a_ij dK_j,    J_i dY_i = known(dC~_i, dF_i),    dK_i = (dC_i - dC~_i)/(a_ii dt)

dF is the change of the water at the displaced nodes: it depends on dY through the positions, which Newton's matrix
leaves out; a fixed-point iteration puts it back (it contracts by about the square of wave number times length). The
perturbations are re-orthonormalised (Gram-Schmidt) after every step, in the norm |dq|^2 + |dV|^2/speed^2 summed over
the nodes; the logarithms of their lengths add up to the growth of each period.

A loop release changes neither t, n, q nor V, so C, and with it dC, goes through it unchanged; the backward Euler steps
that follow start from C alone. What the release itself does - another tether shape from one moment to the next - is not
a derivative; the periods in which one happens are marked. What it does to the exponents: docs/findings.md.

`march` stores the accepted steps in a trail: T (m, 3): t, dt, 1 for a step of backward Euler, 2 for one that a
sudden start or a release asked for; Ys (m, s, n, 6) and Ks (m, s, n, 4), stages, of which backward Euler uses the last.
"""

import math

import numpy as np

from .compiled import kernel
from .elementary import copy_into
from .ends import BUOY
from .planar import node, sweep
from .planar.resolve import resolve_bent

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
            root = math.sqrt(max(1.0 + Y[k, 0], 0.0))
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
    """Known part of the linearised condition of the upper end (`engine.ends`), last node's rows given."""
    if p.end != BUOY:
        return 0.0, 0.0
    x = -p.M_total * cv * dV_tilde[0]
    z = -p.M_total * cv * dV_tilde[1]
    if p.wet:
        u, w = Y[2] - F[0], Y[3] - F[1]
        speed = math.sqrt(u * u + w * w)
        if speed > 0.0:
            along = (u * dF[0] + w * dF[1]) / speed
            x -= p.C_buoy * (speed * dF[0] + u * along)
            z -= p.C_buoy * (speed * dF[1] + w * along)
        x -= p.M_wave * dF[2]
        z -= p.M_wave * dF[3]
    return x, z


@kernel
def _displaced_water(p, tables, t, D, Q, X, F_plus, F_minus, dF):
    """dF: water at the nodes displaced by dY minus water where they are, by central differences; returns |dX|."""
    n = D.shape[0]
    X_plus, X_minus = np.zeros((n, 2)), np.zeros((n, 2))
    dX = np.zeros((n, 2))
    size = 0.0
    for k in range(1, n):
        half = 0.5 * tables[p.grid_at + k - 1]
        for j in (k - 1, k):
            dX[k, 0] += half * (D[j, 0] * Q[j, 0] - D[j, 4] * Q[j, 6])
            dX[k, 1] += half * (D[j, 0] * Q[j, 1] + D[j, 4] * Q[j, 5])
        dX[k, 0] += dX[k - 1, 0]
        dX[k, 1] += dX[k - 1, 1]
        size = max(size, abs(dX[k, 0]), abs(dX[k, 1]))
    if size == 0.0:
        size = 1.0
    for k in range(n):
        for m in range(2):
            X_plus[k, m] = X[k, m] + NUDGE / size * dX[k, m]
            X_minus[k, m] = X[k, m] - NUDGE / size * dX[k, m]
    node.water(p, tables, t, 1.0, X_plus, F_plus)
    node.water(p, tables, t, 1.0, X_minus, F_minus)
    change = 0.0
    largest = 0.0
    for k in range(n):
        for m in range(4):
            value = (F_plus[k, m] - F_minus[k, m]) * (0.5 * size / NUDGE)
            change = max(change, abs(value - dF[k, m]))
            largest = max(largest, abs(value))
            dF[k, m] = value
    return change, largest


@kernel
def _tangent_stage(p, tables, t, rate, moving_water, Y, dC_tilde, dF, dC, Q, X, F, E, work):
    """dC (n, 4) of one vector at one stage whose matrix is in E; dF comes in as a first guess and is renewed."""
    D, gamma, F_plus, F_minus = work
    n = Y.shape[0]
    for _ in range(WATER_ITERATIONS):
        _nodal_change(p, rate, moving_water, dC_tilde[:, 2:], F, Y, Q, dF, gamma)
        top_x, top_z = _top_change(p, rate, dC_tilde[n - 1, 2:], F[n - 1], Y[n - 1], dF[n - 1])
        resolve_bent(p, tables, rate, Q, E, dC_tilde[:, :2], gamma, top_x, top_z, D)
        if moving_water == 0.0:
            break
        change, largest = _displaced_water(p, tables, t, D, Q, X, F_plus, F_minus, dF)
        if change <= WATER_TOLERANCE * largest:
            break
    for k in range(n):
        dC[k, 0] = D[k, 0] * Q[k, 0] - D[k, 4] * Q[k, 6]
        dC[k, 1] = D[k, 0] * Q[k, 1] + D[k, 4] * Q[k, 5]
        dC[k, 2] = D[k, 2]
        dC[k, 3] = D[k, 3]


@kernel
def orthonormalise(weight, vectors, rates, growth):
    """Gram-Schmidt over vectors (k, n, 4), rates taken along; adds the logarithm of each length to growth (k,)."""
    count, n = vectors.shape[0], vectors.shape[1]
    for i in range(count):
        for j in range(i):
            product = 0.0
            for k in range(n):
                for m in range(4):
                    product += vectors[i, k, m] * vectors[j, k, m] * (1.0 if m < 2 else weight)
            for k in range(n):
                for m in range(4):
                    vectors[i, k, m] -= product * vectors[j, k, m]
                    rates[i, k, m] -= product * rates[j, k, m]
        square = 0.0
        for k in range(n):
            for m in range(4):
                square += vectors[i, k, m] ** 2 * (1.0 if m < 2 else weight)
        length = math.sqrt(square)
        growth[i] += math.log(length) if length > 0.0 else -np.inf
        if length > 0.0:
            for k in range(n):
                for m in range(4):
                    vectors[i, k, m] /= length
                    rates[i, k, m] /= length


@kernel
def carry(p, tables, period, count, T, trail_Y, trail_K, vectors, rates, waters, growth):
    """Carry perturbations through the first `count` steps of a trail.

    vectors, rates (k, n, 4): dC and dK, orthonormal in C on entry and exit; waters (k, n, 4): first guesses of dF.
    growth (periods, k), nats: what each step adds goes to the period in which it ends (the last, beyond the end).
    """
    k_vectors, n, s = vectors.shape[0], vectors.shape[1], trail_Y.shape[1]
    X, F, Q = np.zeros((n, 2)), np.zeros((n, 4)), np.zeros((n, node.WIDTH))
    E, D, C_tilde = np.zeros((n, sweep.WITH_INVERSE)), np.zeros((n, 6)), np.zeros((n, 4))
    work = (np.zeros((n, 6)), np.zeros((n, 2)), np.zeros((n, 4)), np.zeros((n, 4)))
    dCs, dKs, dC_tilde = np.zeros((k_vectors, n, 4)), np.zeros((k_vectors, s, n, 4)), np.zeros((n, 4))
    moving_water = 1.0 if p.waves or (p.current and p.cur_nx * p.cur_nz > 1) else 0.0
    for step in range(count):
        t, dt, euler = T[step, 0], T[step, 1], T[step, 2] > 0.0
        for v in range(k_vectors):
            copy_into(dKs[v, 0], rates[v])
        for i in range(s - 1 if euler else 1, s):
            a_ii = 1.0 if euler else tables[p.method_at + s * i + i]
            c_i = 1.0 if euler else tables[p.method_at + s * s + i]
            rate = 1.0 / (a_ii * dt)
            Y, K = trail_Y[step, i], trail_K[step, i]
            node.shape(p, tables, Y, Q, X)
            node.water(p, tables, t + c_i * dt, 1.0, X, F)
            for k in range(n):
                for m in range(4):
                    C_tilde[k, m] = (Q[k, 5 + m] if m < 2 else Y[k, m]) - K[k, m] / rate
            node.node_quantities(p, tables, rate, rate, 1.0, Y, C_tilde, F, Q)
            sweep.sweep_bent(p, tables, t + c_i * dt, rate, rate, 1.0, Y, C_tilde, F, Q, E, D)
            for v in range(k_vectors):
                copy_into(dC_tilde, vectors[v])
                for j in range(0 if euler else i):
                    a = dt * tables[p.method_at + s * i + j]
                    if a != 0.0:
                        for k in range(n):
                            for m in range(4):
                                dC_tilde[k, m] += a * dKs[v, j, k, m]
                _tangent_stage(
                    p, tables, t + c_i * dt, rate, moving_water, Y, dC_tilde, waters[v], dCs[v], Q, X, F, E, work
                )
                for k in range(n):
                    for m in range(4):
                        dKs[v, i, k, m] = rate * (dCs[v, k, m] - dC_tilde[k, m])
        for v in range(k_vectors):
            copy_into(vectors[v], dCs[v])
            copy_into(rates[v], dKs[v, s - 1])
        where = min(int((t + dt) / period - 1e-9), growth.shape[0] - 1)
        orthonormalise(p.per_speed**2, vectors, rates, growth[where])
