"""The sweep of `spatial.elimination` for a tether without bending: y = (eps, theta2, theta3), v = V, 3 x 3 blocks.

Shear forces, curvatures and the roll of the frame are zero, N = T t. Well posed while the tether is in tension only.
"""

from ..compiled import kernel
from .node import vector
from .upper import end_condition
from .vectors import dot, mixed, symmetric, times


@kernel
def _columns(row):
    """dN and dq by y as columns."""
    t, n, b = vector(row, 0), vector(row, 14), vector(row, 17)
    T, lam = row[41], row[4]
    return (
        (mixed(row[3], t, 0.0, t), mixed(-T, b, 0.0, b), mixed(T, n, 0.0, n)),
        (t, mixed(-lam, b, 0.0, b), mixed(lam, n, 0.0, n)),
    )


@kernel
def _times(R, y):
    """R y for columns R and a tuple y."""
    return mixed(1.0, mixed(y[0], R[0], y[1], R[1]), y[2], R[2])


@kernel
def _inverse(A):
    """Rows of the inverse of the matrix of columns A, and its determinant (rows not divided by it)."""
    a, b, c = A
    r0 = (b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0])
    r1 = (c[1] * a[2] - c[2] * a[1], c[2] * a[0] - c[0] * a[2], c[0] * a[1] - c[1] * a[0])
    r2 = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    return r0, r1, r2, dot(a, r0)


@kernel
def sweep_unbent(p, tables, t, cq, cv, in_motion, Y, C_tilde, X, F, Q, E, D):
    """Fill D (n, 12) with the Newton update, zeros for shear, curvature and roll; False where a block is singular.

    E (n, 24): columns of P (9), p (3), columns of R (9), r (3).
    """
    last = Y.shape[0] - 1
    zero = (0.0, 0.0, 0.0)
    R = (zero, zero, zero)
    r = (-Y[0, 3], -Y[0, 4], -Y[0, 5])
    _store(E[0], 12, R, r)
    for k in range(1, last + 1):
        a = k - 1
        e = 0.5 * tables[p.grid_at + a]
        ec = e * cq
        Qa, Qb = Q[a], Q[k]
        dNa, dqa = _columns(Qa)
        dNb, dqb = _columns(Qb)
        Ja = (e * Qa[32], e * Qa[33], e * Qa[34], e * Qa[35], e * Qa[36], e * Qa[37])
        Jb = (e * Qb[32], e * Qb[33], e * Qb[34], e * Qb[35], e * Qb[36], e * Qb[37])
        z = (
            r[0] - (Y[k, 3] - Y[a, 3] - e * (Qa[8] + Qb[8])),
            r[1] - (Y[k, 4] - Y[a, 4] - e * (Qa[9] + Qb[9])),
            r[2] - (Y[k, 5] - Y[a, 5] - e * (Qa[10] + Qb[10])),
        )
        known = mixed(
            1.0, mixed(1.0, vector(Qa, 11), -1.0, vector(Qb, 11)), e, mixed(1.0, vector(Qa, 20), 1.0, vector(Qb, 20))
        )
        g = mixed(1.0, known, 1.0, mixed(1.0, symmetric(Ja, r), 1.0, symmetric(Jb, z)))
        A0 = _column(R[0], dqa[0], dNa[0], vector(Qa, 23), ec, e, Ja, Jb)
        A1 = _column(R[1], dqa[1], dNa[1], vector(Qa, 26), ec, e, Ja, Jb)
        A2 = _column(R[2], dqa[2], dNa[2], vector(Qa, 29), ec, e, Ja, Jb)
        B0 = _column_above(dqb[0], dNb[0], vector(Qb, 23), ec, e, Jb)
        B1 = _column_above(dqb[1], dNb[1], vector(Qb, 26), ec, e, Jb)
        B2 = _column_above(dqb[2], dNb[2], vector(Qb, 29), ec, e, Jb)
        i0, i1, i2, det = _inverse((A0, A1, A2))
        if det == 0.0:
            return False
        f = 1.0 / det
        P = (
            (-f * dot(i0, B0), -f * dot(i1, B0), -f * dot(i2, B0)),
            (-f * dot(i0, B1), -f * dot(i1, B1), -f * dot(i2, B1)),
            (-f * dot(i0, B2), -f * dot(i1, B2), -f * dot(i2, B2)),
        )
        s = (f * dot(i0, g), f * dot(i1, g), f * dot(i2, g))
        _store(E[k], 0, P, s)
        on = (mixed(1.0, R[0], ec, dqa[0]), mixed(1.0, R[1], ec, dqa[1]), mixed(1.0, R[2], ec, dqa[2]))
        R = (
            mixed(1.0, _times(on, P[0]), ec, dqb[0]),
            mixed(1.0, _times(on, P[1]), ec, dqb[1]),
            mixed(1.0, _times(on, P[2]), ec, dqb[2]),
        )
        r = mixed(1.0, _times(on, s), 1.0, z)
        _store(E[k], 12, R, r)
    residual, eN, S = end_condition(p, tables, t, cq, cv, in_motion, Y, C_tilde, X, F, Q)
    dN, _ = _columns(Q[last])
    known = times(S, r)
    A = (
        mixed(eN, dN[0], 1.0, times(S, R[0])),
        mixed(eN, dN[1], 1.0, times(S, R[1])),
        mixed(eN, dN[2], 1.0, times(S, R[2])),
    )
    i0, i1, i2, det = _inverse(A)
    if det == 0.0:
        return False
    g = mixed(-1.0 / det, residual, -1.0 / det, known)
    y = (dot(i0, g), dot(i1, g), dot(i2, g))
    for k in range(last, -1, -1):
        row, out = E[k], D[k]
        V = mixed(1.0, _times((vector(row, 12), vector(row, 15), vector(row, 18)), y), 1.0, vector(row, 21))
        out[0], out[7], out[8] = y
        out[3], out[4], out[5] = V
        out[1] = out[2] = out[6] = out[9] = out[10] = out[11] = 0.0
        y = mixed(1.0, _times((vector(row, 0), vector(row, 3), vector(row, 6)), y), 1.0, vector(row, 9))
    return True


@kernel
def _column(R, dq, dN, dG, ec, e, Ja, Jb):
    """Coefficients of one unknown of y_a in the momentum equations."""
    V = symmetric(Ja, R)
    above = symmetric(Jb, mixed(1.0, R, ec, dq))
    return mixed(-1.0, mixed(1.0, dN, e, dG), -1.0, mixed(1.0, V, 1.0, above))


@kernel
def _column_above(dq, dN, dG, ec, e, Jb):
    """Coefficients of one unknown of y_b."""
    return mixed(1.0, mixed(1.0, dN, -e, dG), -ec, symmetric(Jb, dq))


@kernel
def _store(row, at, columns, known):
    """Three columns and a vector into row[at : at + 12]."""
    for j in range(3):
        row[at + j], row[at + 3 + j], row[at + 6 + j] = columns[0][j], columns[1][j], columns[2][j]
        row[at + 9 + j] = known[j]
