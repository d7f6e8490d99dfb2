"""The elimination of `spatial.elimination` for a tether without bending: y = (eps, theta2, theta3), v = V, 3 x 3
blocks.

Shear forces, curvatures and the roll of the frame are zero, N = T t. Well posed while the tether is in tension only.
"""

from ..compiled import kernel
from . import columns as col
from .extras import along_by_turn
from .upper import end_condition
from .vectors import dot, mixed, put, put_rows, rows_of, times, vector

P, P_KNOWN, R, R_KNOWN = 0, 9, 12, 21  # columns of E: three columns of P, p, three columns of R, r


@kernel
def _columns(p, row):
    """dN and dq by y as columns."""
    t, n, b = vector(row, col.T_VECTOR), vector(row, col.N_VECTOR), vector(row, col.B_VECTOR)
    T, lam = row[col.TENSION], row[col.STRETCHED]
    less2, less3 = along_by_turn(p, row)
    return (
        (mixed(row[col.SLOPE], t, 0.0, t), mixed(-T, b, -less2, t), mixed(T, n, -less3, t)),
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
def eliminate_unbent(p, tables, stage, Y, work):
    """Fill work.D (n, 12) with the Newton update, zeros for shear, curvature and roll; False where a block is singular.

    Arguments as for `engine.spatial.elimination.eliminate`.
    """
    Q, E, D = work.Q, work.E, work.D
    last = Y.shape[0] - 1
    zero = (0.0, 0.0, 0.0)
    relation = (zero, zero, zero)  # R by columns
    x, y, z = vector(Y[0], col.V)
    r = (-x, -y, -z)
    put_rows(E[0], R, relation)
    put(E[0], R_KNOWN, r)
    for k in range(1, last + 1):
        a = k - 1
        e = 0.5 * tables[p.grid_at + a]
        ec = e * stage.cq
        Qa, Qb = Q[a], Q[k]
        dNa, dqa = _columns(p, Qa)
        dNb, dqb = _columns(p, Qb)
        Ja, Jb = inertia(Qa, e), inertia(Qb, e)
        # momentum A y_a + B y_b = g, with V_a = R y_a + r and V_b from compatibility put in
        opened = mixed(1.0, vector(Y[k], col.V), -1.0, vector(Y[a], col.V))
        stretching = mixed(1.0, vector(Qa, col.Q_T), 1.0, vector(Qb, col.Q_T))
        z = mixed(1.0, r, -1.0, mixed(1.0, opened, -e, stretching))
        load = mixed(1.0, vector(Qa, col.G), 1.0, vector(Qb, col.G))
        known = mixed(1.0, mixed(1.0, vector(Qa, col.N), -1.0, vector(Qb, col.N)), e, load)
        g = mixed(1.0, known, 1.0, mixed(1.0, times(Ja, r), 1.0, times(Jb, z)))
        A0 = _column(relation[0], dqa[0], dNa[0], vector(Qa, col.G_EPS), ec, e, Ja, Jb)
        A1 = _column(relation[1], dqa[1], dNa[1], vector(Qa, col.G_THETA2), ec, e, Ja, Jb)
        A2 = _column(relation[2], dqa[2], dNa[2], vector(Qa, col.G_THETA3), ec, e, Ja, Jb)
        B0 = _column_above(dqb[0], dNb[0], vector(Qb, col.G_EPS), ec, e, Jb)
        B1 = _column_above(dqb[1], dNb[1], vector(Qb, col.G_THETA2), ec, e, Jb)
        B2 = _column_above(dqb[2], dNb[2], vector(Qb, col.G_THETA3), ec, e, Jb)
        i0, i1, i2, det = _inverse((A0, A1, A2))
        if det == 0.0:
            return False
        f = 1.0 / det
        # y_a = P y_b + p, then V_b = R y_b + r
        by_upper = (
            (-f * dot(i0, B0), -f * dot(i1, B0), -f * dot(i2, B0)),
            (-f * dot(i0, B1), -f * dot(i1, B1), -f * dot(i2, B1)),
            (-f * dot(i0, B2), -f * dot(i1, B2), -f * dot(i2, B2)),
        )
        s = (f * dot(i0, g), f * dot(i1, g), f * dot(i2, g))
        put_rows(E[k], P, by_upper)
        put(E[k], P_KNOWN, s)
        on = (
            mixed(1.0, relation[0], ec, dqa[0]),
            mixed(1.0, relation[1], ec, dqa[1]),
            mixed(1.0, relation[2], ec, dqa[2]),
        )
        relation = (
            mixed(1.0, _times(on, by_upper[0]), ec, dqb[0]),
            mixed(1.0, _times(on, by_upper[1]), ec, dqb[1]),
            mixed(1.0, _times(on, by_upper[2]), ec, dqb[2]),
        )
        r = mixed(1.0, _times(on, s), 1.0, z)
        put_rows(E[k], R, relation)
        put(E[k], R_KNOWN, r)
    # upper end, and back substitution
    residual, eN, S = end_condition(p, tables, stage, Y, work)
    dN, _ = _columns(p, Q[last])
    known = times(S, r)
    A = (
        mixed(eN, dN[0], 1.0, times(S, relation[0])),
        mixed(eN, dN[1], 1.0, times(S, relation[1])),
        mixed(eN, dN[2], 1.0, times(S, relation[2])),
    )
    i0, i1, i2, det = _inverse(A)
    if det == 0.0:
        return False
    g = mixed(-1.0 / det, residual, -1.0 / det, known)
    y = (dot(i0, g), dot(i1, g), dot(i2, g))
    for k in range(last, -1, -1):
        row, out = E[k], D[k]
        V = mixed(1.0, _times(rows_of(row, R), y), 1.0, vector(row, R_KNOWN))
        out[col.EPS], out[col.THETA2], out[col.THETA3] = y
        put(out, col.V, V)
        out[col.SHEAR_N] = out[col.SHEAR_B] = out[col.THETA1] = out[col.D_O1] = out[col.D_O2] = out[col.D_O3] = 0.0
        y = mixed(1.0, _times(rows_of(row, P), y), 1.0, vector(row, P_KNOWN))
    return True


@kernel
def inertia(row, e):
    """e dG/dV of a row of Q: three rows."""
    x, y, z = rows_of(row, col.G_V)
    return (e * x[0], e * x[1], e * x[2]), (e * y[0], e * y[1], e * y[2]), (e * z[0], e * z[1], e * z[2])


@kernel
def _column(R, dq, dN, dG, ec, e, Ja, Jb):
    """Coefficients of one unknown of y_a in the momentum equations."""
    V = times(Ja, R)
    above = times(Jb, mixed(1.0, R, ec, dq))
    return mixed(-1.0, mixed(1.0, dN, e, dG), -1.0, mixed(1.0, V, 1.0, above))


@kernel
def _column_above(dq, dN, dG, ec, e, Jb):
    """Coefficients of one unknown of y_b."""
    return mixed(1.0, mixed(1.0, dN, -e, dG), -ec, times(Jb, dq))
