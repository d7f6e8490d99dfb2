"""Energy budget of a dry line, from the very numbers of the accepted steps.

At the stage of a one-stage step (rates K_s at C_s, `time.steps`) the box equations, multiplied by V and N, sum to

    N.V at the upper end = sum over elements of h (N-.q_t- + m V-.V_t- + w0 W-),      - the mean of two nodes,

without error but Newton's. N.q_t at a node is f(eps) e_t + T_v e_t + S.q_t: into strain, into viscosity, of shocks and
of the material, and against the shear forces, which is bending (with the paper's (1+eps)^3 it has no potential where
the strain varies, so its work is kept). What a step takes from the end and does not find again in these or in the
energies

    kinetic sum h m |V-|^2/2 | strain sum h mean(integral of f) | gravity sum h w0 z- | bed, its spring's

is what the scheme dissipates: in time, stage powers times dt less the change of energies (the integrator's damping); in
space, h (N-.q_t- - mean(N.q_t)) (products of means for means of products). Both are small where the solution is
smooth, and belong to the dissipation of a shock where it is not. A bed takes h G-.V- of its load G, of which the nodal
powers of its spring, damper and friction (`engine.physics.bed`) have columns; the rest is the scheme's in space.

Columns of `energies`: time (s), then J; the first four are states, the others have grown since t = 0.
"""

import math

import numpy as np

from ..compiled import kernel
from ..dimensions import shear_force
from ..physics.bed import bed_energy, bed_powers, bed_under
from ..physics.shocks import shock_tension
from ..physics.tension.kernels import stored, tension
from ..planar import columns as planar
from ..spatial import columns as spatial
from .damping import damping_of

TIME, KINETIC, STRAIN, GRAVITY, BED, END_WORK, SHEAR, VISCOUS, BED_DAMPING, FRICTION, SPACE, POWERS = range(12)
WIDTH = 12  # POWERS: stage powers times dt
SUMS = END_WORK  # the running sums are the columns from here on


@kernel
def energies_of(p, tables, C, row):
    """Kinetic, strain and gravity energy of a state C (n, 4 or 6) into a row; gravity from the lower end up."""
    half = C.shape[1] // 2
    kinetic = strain = gravity = bed = below = z = bed_below = 0.0
    floored, anchor_z = bed_under(p)
    for k in range(C.shape[0]):
        square = 0.0
        for i in range(half):
            square += C[k, i] * C[k, i]
        energy = stored(math.sqrt(square) - 1.0, p, tables)
        if k > 0:
            h = tables[p.grid_at + k - 1]
            for i in range(half, 2 * half):
                kinetic += 0.125 * h * p.m * (C[k - 1, i] + C[k, i]) ** 2
            strain += 0.5 * h * (below + energy)
            rise = 0.5 * h * (C[k - 1, half - 1] + C[k, half - 1])
            gravity += h * p.w0 * (z + 0.5 * rise)
            z += rise
            if floored:
                bed_here = bed_energy(p, anchor_z + z)
                bed += 0.5 * h * (bed_below + bed_here)
                bed_below = bed_here
        below = energy
    row[KINETIC], row[STRAIN], row[GRAVITY], row[BED] = kinetic, strain, gravity, bed


@kernel
def add_powers(p, tables, dt, alphas, motion, C1, K1, Y, Q, sums):
    """Add one accepted step of dt (s) to sums: END_WORK and what follows it.

    alphas: (alpha_m, alpha_f, gamma) of the step; motion: Motion before it; C1, K1 (n, conserved): after it; Y: the new
    state, whose shear forces are the stage's; Q: nodal quantities, for the viscosity of the step.
    """
    alpha_m, alpha_f, gamma = alphas
    C0, K0 = motion.C, motion.K
    n, half = C0.shape[0], C0.shape[1] // 2
    at = planar.SHOCK_B if half == 2 else spatial.SHOCK_B
    cq = alpha_m / (alpha_f * gamma * dt)
    q, S = np.empty(half), np.empty(half)
    N, rate = np.empty((2, half)), np.empty((2, half))  # of this node and of the one below, in turns
    V, A = np.empty((2, half)), np.empty((2, half))
    shear, viscous, axial = np.zeros(2), np.zeros(2), np.zeros(2)
    bed, taken = np.zeros((2, 3)), np.zeros((2, 3))  # load; powers of its spring, damper and friction
    floored, z = bed_under(p)
    below = 0.0
    for k in range(n):
        a = k % 2
        square = square_before = stretching = 0.0
        for i in range(half):
            q[i] = C0[k, i] + alpha_f * (C1[k, i] - C0[k, i])
            rate[a, i] = K0[k, i] + alpha_m * (K1[k, i] - K0[k, i])
            V[a, i] = C0[k, half + i] + alpha_f * (C1[k, half + i] - C0[k, half + i])
            A[a, i] = K0[k, half + i] + alpha_m * (K1[k, half + i] - K0[k, half + i])
            square += q[i] * q[i]
            square_before += (q[i] - rate[a, i] / cq) ** 2
            stretching += q[i] * rate[a, i]
        length = math.sqrt(square)
        stretching /= length
        T = tension(length - 1.0, p, tables)[0]
        T_v = shock_tension(cq, length - math.sqrt(square_before), Q[k, at], Q[k, at + 1])[0] if p.viscous else 0.0
        T_v += damping_of(p) * stretching
        shear_force(p, Y, k, q, S)
        shear[a] = 0.0
        axial[a], viscous[a] = T * stretching, T_v * stretching
        for i in range(half):
            N[a, i] = (T + T_v) * q[i] / length + S[i]
            shear[a] += S[i] * rate[a, i]
        if floored:
            if k > 0:
                z += 0.5 * tables[p.grid_at + k - 1] * (below + q[half - 1])
            below = q[half - 1]
            U = V[a, 0], V[a, 1] if half == 3 else 0.0, V[a, half - 1]
            load, taken[a, 0], taken[a, 1], taken[a, 2] = bed_powers(p, z, U)
            bed[a, 0], bed[a, 1], bed[a, 2] = load
        if k > 0:
            h = dt * tables[p.grid_at + k - 1]
            means = kinetic = 0.0
            for i in range(half):
                means += 0.25 * (N[0, i] + N[1, i]) * (rate[0, i] + rate[1, i])
                kinetic += 0.25 * p.m * (V[0, i] + V[1, i]) * (A[0, i] + A[1, i])
            sums[SHEAR - SUMS] += 0.5 * h * (shear[0] + shear[1])
            sums[VISCOUS - SUMS] += 0.5 * h * (viscous[0] + viscous[1])
            sums[SPACE - SUMS] += h * (
                means - 0.5 * (axial[0] + axial[1] + viscous[0] + viscous[1] + shear[0] + shear[1])
            )
            lift = 0.5 * p.w0 * (V[0, half - 1] + V[1, half - 1])
            sums[POWERS - SUMS] += h * (0.5 * (axial[0] + axial[1]) + kinetic + lift)
            if floored:
                of_bed = 0.0
                for i, column in enumerate((POWERS, BED_DAMPING, FRICTION)):
                    power = 0.5 * h * (taken[0, i] + taken[1, i])
                    sums[column - SUMS] += power
                    of_bed += power
                of_load = (bed[0, 0] + bed[1, 0]) * (V[0, 0] + V[1, 0])
                of_load += (bed[0, 2] + bed[1, 2]) * (V[0, half - 1] + V[1, half - 1])
                if half == 3:
                    of_load += (bed[0, 1] + bed[1, 1]) * (V[0, 1] + V[1, 1])
                sums[SPACE - SUMS] += 0.25 * h * of_load - of_bed
    last = (n - 1) % 2
    for i in range(half):
        sums[END_WORK - SUMS] += dt * N[last, i] * V[last, i]


@kernel
def store_energies(p, tables, t, C, sums, row):
    """One row of `energies` at time t."""
    row[TIME] = t
    energies_of(p, tables, C, row)
    for i in range(WIDTH - SUMS):
        row[SUMS + i] = sums[i]
