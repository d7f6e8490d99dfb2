"""Another right-hand side for the matrix that `planar.elimination.eliminate` has eliminated: one pass up, one
down.

The tangent dynamics of a stage is linear in the perturbation, with Newton's matrix at the converged state:

    dV_b - dV_a - e (dq_t,a + dq_t,b) = 0, dq_t = cq (dq/dy dy - dq~)      -> c = e cq (dq~_a + dq~_b)
    dN_b - dN_a - e (dG_a + dG_b) = 0, dG = (dG/dy) dy + (dG/dV) dV + gamma -> g = e (gamma_a + gamma_b)

with gamma the change of G that comes from V~ and from the water at the displaced node; curvature and moment have no
known terms. At the upper end `top` is the known part of its residual.
"""

from ..compiled import kernel
from ..planar import columns as col
from ..planar.elimination import back_substitute
from ..simd.elementary import put3, row_times, take3


@kernel
def resolve_bent(p, tables, cq, work, dC_tilde, gamma, top_x, top_z):
    """Fill work.D (n, 6) with the perturbation dY; work.E (n, 33) comes from `eliminate` at the same state.

    p, tables: parameters; cq (1/s); dC_tilde (n, 4), of which dq~ counts; gamma (n, 2) N/m; top_x, top_z in the units
    of the end's condition. Overwrites p and r in E.
    """
    Q, E = work.Q, work.E
    n = Q.shape[0]
    r0 = r1 = r2 = 0.0
    put3(E, 0, col.R_KNOWN, 0.0, 0.0, 0.0)
    for k in range(1, n):
        a = k - 1
        e = 0.5 * tables[p.grid_at + a]
        ec = e * cq
        cx = ec * (dC_tilde[a, col.CX] + dC_tilde[k, col.CX])
        cz = ec * (dC_tilde[a, col.CZ] + dC_tilde[k, col.CZ])
        Jxx, Jxz, Jzz = e * Q[k, col.GXX], e * Q[k, col.GXZ], e * Q[k, col.GZZ]
        Kxx, Kxz, Kzz = e * Q[a, col.GXX] + Jxx, e * Q[a, col.GXZ] + Jxz, e * Q[a, col.GZZ] + Jzz
        g0 = e * (gamma[a, 0] + gamma[k, 0]) + Kxx * r0 + Kxz * r1 - Jxx * cx - Jxz * cz
        g1 = e * (gamma[a, 1] + gamma[k, 1]) + Kxz * r0 + Kzz * r1 - Jxz * cx - Jzz * cz
        g2 = 2.0 * p.EI * r2
        # y_a = P y_b + p, then v_b = R_b y_b + r
        p0 = row_times(E, k, col.INVERSE, g0, g1, g2)
        p1 = row_times(E, k, col.INVERSE + 3, g0, g1, g2)
        p2 = row_times(E, k, col.INVERSE + 6, g0, g1, g2)
        Rx0, Rx1, Rx2 = take3(E, a, col.R)
        Rz0, Rz1, Rz2 = take3(E, a, col.R + 3)
        Rk0, Rk1, Rk2 = take3(E, a, col.R + 6)
        ca, sa = Q[a, col.COS], Q[a, col.SIN]
        r0 += (Rx0 + ec * ca) * p0 + Rx1 * p1 + (Rx2 - ec * Q[a, col.QZ]) * p2 - cx
        r1 += (Rz0 + ec * sa) * p0 + Rz1 * p1 + (Rz2 + ec * Q[a, col.QX]) * p2 - cz
        r2 = -Rk0 * p0 - Rk1 * p1 - (Rk2 + 1.0 / e) * p2 - r2
        put3(E, k, col.P_KNOWN, p0, p1, p2)
        put3(E, k, col.R_KNOWN, r0, r1, r2)
    g0 = -top_x - E[0, col.TOP_DXX] * r0 - E[0, col.TOP_DXZ] * r1
    g1 = -top_z - E[0, col.TOP_DZX] * r0 - E[0, col.TOP_DZZ] * r1
    back_substitute(E, g0, g1, -r2, work.D)
