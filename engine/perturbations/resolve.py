"""Another right-hand side for the matrix that `planar.elimination.sweep_bent` has eliminated: one pass up, one down.

The tangent dynamics of a stage is linear in the perturbation, with Newton's matrix at the converged state:

    dV_b - dV_a - e (dq_t,a + dq_t,b) = 0, dq_t = cq (dq/dy dy - dq~)      -> c = e cq (dq~_a + dq~_b)
    dN_b - dN_a - e (dG_a + dG_b) = 0, dG = (dG/dy) dy + (dG/dV) dV + gamma -> g = e (gamma_a + gamma_b)

with gamma the change of G that comes from V~ and from the water at the displaced node; curvature and moment have no
known terms. At the upper end `top` is the known part of its residual.
"""

from ..compiled import kernel
from ..planar.elimination import back_substitute


@kernel
def resolve_bent(p, tables, cq, Q, E, dq_tilde, gamma, top_x, top_z, D):
    """Fill D (n, 6) with the perturbation dY; E comes from `sweep_bent` at the same state.

    dq_tilde (n, 2), gamma (n, 2) N/m; top_x, top_z in the units of the end's condition. Overwrites p and r in E.
    """
    n = Q.shape[0]
    r0 = r1 = r2 = 0.0
    E[0, 21] = E[0, 22] = E[0, 23] = 0.0
    for k in range(1, n):
        a = k - 1
        e = 0.5 * tables[p.grid_at + a]
        ec = e * cq
        cx = ec * (dq_tilde[a, 0] + dq_tilde[k, 0])
        cz = ec * (dq_tilde[a, 1] + dq_tilde[k, 1])
        Jxx, Jxz, Jzz = e * Q[k, 15], e * Q[k, 16], e * Q[k, 17]
        Kxx, Kxz, Kzz = e * Q[a, 15] + Jxx, e * Q[a, 16] + Jxz, e * Q[a, 17] + Jzz
        g0 = e * (gamma[a, 0] + gamma[k, 0]) + Kxx * r0 + Kxz * r1 - Jxx * cx - Jxz * cz
        g1 = e * (gamma[a, 1] + gamma[k, 1]) + Kxz * r0 + Kzz * r1 - Jxz * cx - Jzz * cz
        g2 = 2.0 * p.EI * r2
        p0 = E[k, 24] * g0 + E[k, 25] * g1 + E[k, 26] * g2
        p1 = E[k, 27] * g0 + E[k, 28] * g1 + E[k, 29] * g2
        p2 = E[k, 30] * g0 + E[k, 31] * g1 + E[k, 32] * g2
        ca, sa = Q[a, 0], Q[a, 1]
        r0 += (E[a, 12] + ec * ca) * p0 + E[a, 13] * p1 + (E[a, 14] - ec * Q[a, 6]) * p2 - cx
        r1 += (E[a, 15] + ec * sa) * p0 + E[a, 16] * p1 + (E[a, 17] + ec * Q[a, 5]) * p2 - cz
        r2 = -E[a, 18] * p0 - E[a, 19] * p1 - (E[a, 20] + 1.0 / e) * p2 - r2
        E[k, 9], E[k, 10], E[k, 11] = p0, p1, p2
        E[k, 21], E[k, 22], E[k, 23] = r0, r1, r2
    g0 = -top_x - E[0, 24] * r0 - E[0, 25] * r1
    g1 = -top_z - E[0, 26] * r0 - E[0, 27] * r1
    back_substitute(E, g0, g1, -r2, D)
