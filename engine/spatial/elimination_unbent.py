"""The elimination of `spatial.elimination` for a tether without bending: y = (eps, theta2, theta3), v = V, 3 x 3
blocks.

Shear forces, curvatures and the roll of the frame are zero, N = T t. Well posed while the tether is in tension only.
"""

from ..compiled import kernel
from . import columns as col
from .extras import along_by_turn
from .upper import end_condition
from .vectors import (
    cofactors,
    minus,
    mixed,
    mixed_rows,
    multiple,
    plus,
    put,
    put_rows,
    rows_of,
    scaled_rows,
    times,
    vector,
)

P, P_KNOWN, R, R_KNOWN = 0, 9, 12, 21  # columns of E: three columns of P, p, three columns of R, r


@kernel
def _columns(p, row):
    """dN and dq by y as columns."""
    t, n, b = rows_of(row, col.T_VECTOR)
    T, lam = row[col.TENSION], row[col.STRETCHED]
    less2, less3 = along_by_turn(p, row)
    return (
        (multiple(row[col.SLOPE], t), mixed(-T, b, -less2, t), mixed(T, n, -less3, t)),
        (t, mixed(-lam, b, 0.0, b), multiple(lam, n)),
    )


@kernel
def _times(R, y):
    """R y for columns R and a tuple y."""
    return mixed(1.0, mixed(y[0], R[0], y[1], R[1]), y[2], R[2])


@kernel
def _times_each(R, P):
    """R P for columns R and P."""
    return _times(R, P[0]), _times(R, P[1]), _times(R, P[2])


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
        Qa, Qb, row = Q[a], Q[k], E[k]
        dNa, dqa = _columns(p, Qa)
        dNb, dqb = _columns(p, Qb)
        Ja, Jb = inertia(Qa, e), inertia(Qb, e)
        # momentum A y_a + B y_b = g, with V_a = R y_a + r and V_b from compatibility put in
        opened = minus(vector(Y[k], col.V), vector(Y[a], col.V))
        stretching = plus(vector(Qa, col.Q_T), vector(Qb, col.Q_T))
        z = minus(r, mixed(1.0, opened, -e, stretching))
        load = plus(vector(Qa, col.G), vector(Qb, col.G))
        known = mixed(1.0, minus(vector(Qa, col.N), vector(Qb, col.N)), e, load)
        g = plus(known, plus(times(Ja, r), times(Jb, z)))
        A0 = _column(relation[0], dqa[0], dNa[0], vector(Qa, col.G_EPS), ec, e, Ja, Jb)
        A1 = _column(relation[1], dqa[1], dNa[1], vector(Qa, col.G_THETA2), ec, e, Ja, Jb)
        A2 = _column(relation[2], dqa[2], dNa[2], vector(Qa, col.G_THETA3), ec, e, Ja, Jb)
        B0 = _column_above(dqb[0], dNb[0], vector(Qb, col.G_EPS), ec, e, Jb)
        B1 = _column_above(dqb[1], dNb[1], vector(Qb, col.G_THETA2), ec, e, Jb)
        B2 = _column_above(dqb[2], dNb[2], vector(Qb, col.G_THETA3), ec, e, Jb)
        inverse, det = cofactors(A0, A1, A2)
        if det == 0.0:
            return False
        f = 1.0 / det
        # y_a = P y_b + p, then V_b = R y_b + r
        by_upper = multiple(-f, times(inverse, B0)), multiple(-f, times(inverse, B1)), multiple(-f, times(inverse, B2))
        s = multiple(f, times(inverse, g))
        put_rows(row, P, by_upper)
        put(row, P_KNOWN, s)
        on = mixed_rows(1.0, relation, ec, dqa)
        relation = mixed_rows(1.0, _times_each(on, by_upper), ec, dqb)
        r = plus(_times(on, s), z)
        put_rows(row, R, relation)
        put(row, R_KNOWN, r)
    # upper end, and back substitution
    residual, eN, S = end_condition(p, tables, stage, Y, work)
    dN, _ = _columns(p, Q[last])
    known = times(S, r)
    by_V = times(S, relation[0]), times(S, relation[1]), times(S, relation[2])
    A0, A1, A2 = mixed_rows(eN, dN, 1.0, by_V)
    inverse, det = cofactors(A0, A1, A2)
    if det == 0.0:
        return False
    g = mixed(-1.0 / det, residual, -1.0 / det, known)
    y = times(inverse, g)
    for k in range(last, -1, -1):
        row, out = E[k], D[k]
        V = plus(_times(rows_of(row, R), y), vector(row, R_KNOWN))
        out[col.EPS], out[col.THETA2], out[col.THETA3] = y
        put(out, col.V, V)
        out[col.SHEAR_N] = out[col.SHEAR_B] = out[col.THETA1] = out[col.D_O1] = out[col.D_O2] = out[col.D_O3] = 0.0
        y = plus(_times(rows_of(row, P), y), vector(row, P_KNOWN))
    return True


@kernel
def inertia(row, e):
    """e dG/dV of a row of Q: three rows."""
    return scaled_rows(e, rows_of(row, col.G_V))


@kernel
def _column(R, dq, dN, dG, ec, e, Ja, Jb):
    """Coefficients of one unknown of y_a in the momentum equations."""
    V = times(Ja, R)
    above = times(Jb, mixed(1.0, R, ec, dq))
    return mixed(-1.0, mixed(1.0, dN, e, dG), -1.0, plus(V, above))


@kernel
def _column_above(dq, dN, dG, ec, e, Jb):
    """Coefficients of one unknown of y_b."""
    return mixed(1.0, mixed(1.0, dN, -e, dG), -ec, times(Jb, dq))
