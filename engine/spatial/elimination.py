"""One Newton update of the box equations in space by condensed elimination, at a cost linear in the nodes.

Box between nodes a (lower) and b (upper), half element length e, psi the rotation vector from frame a to frame b;
residuals that Newton drives to zero:

    V_b - V_a - e (q_t,a + q_t,b) = 0                 compatibility      o b   y_b, v_b
    psi - e (o_a + o_b) = 0,  o = (0, O2, O3)         rotation           |
    N_b - N_a - e (G_a + G_b) = 0                     momentum           |  h = 2 e
    EI (O2_b - O2_a) - e (M2_a + M2_b) = 0            moments            |
    EI (O3_b - O3_a) + e (M3_a + M3_b) = 0                               o a   y_a, v_a

Nothing distributes a torque along the line, so it is the same everywhere: O1 is one number for the whole line. It is
zero unless both ends are clamped. Then it is one more right-hand side rather than one more unknown: the twist given is
what the frame, which does not roll, turns between the clamps, plus O1 times the length.

Split the updates into y = (eps, Sn, Sb, theta2, theta3) and v = (V, O2, O3, theta1). Below node a everything is one
affine relation v_a = R y_a + r + r' dO1; at the anchor V = 0, theta1 = 0 (the roll of the frame is free there: this
fixes it), O2 = O3 = 0, or a clamp (`engine.spatial.upper`). Compatibility and rotation give v_b from (v_a, y_a, y_b),
where J' and psi' are transposed (p' and r' are not: they are what one more unit of dO1 adds):

    d psi = J theta_b - J' theta_a,   J = g + psi x/2 + c psi psi',   g = (a/2) cot(a/2),  c = (1 - g)/a^2,  a = |psi|

momentum and moments give y_a = P y_b + p + p' dO1: a 3 x 3 inverse for (eps, Sn, Sb) and a 2 x 2 one for the angles.
At the upper end one small solve, then back substitution.

A line without bending has an elimination of its own (`engine.spatial.elimination_unbent`), at half the cost.

E (n, 77): columns in `engine.spatial.columns`.

In the paper: eq. (13) torque; eq. (14) bending moment about n; eq. (15) bending moment about b; eq. (16) balance of
moments; eq. (17) compatibility; eq. (18) compatibility, with the tangent; eq. (19) compatibility in the local frame.
"""

from ..compiled import kernel
from ..physics.ends import released
from . import columns as col
from .box import Rows, across_box, factors, momentum_row, nodal_jacobian, solve_box, solve_box_rows, turn_of_box
from .elimination_unbent import eliminate_unbent, inertia
from .upper import CLAMP, solve_upper
from .vectors import (
    added,
    combined,
    combined3,
    dot,
    mixed,
    plus,
    put,
    put_row,
    row_dot,
    row_of,
    row_times,
    times,
    vector,
)

V_OF_D = col.V, col.V + 1, col.V + 2, col.D_O2, col.D_O3, col.THETA1  # columns of D where the six of v are


@kernel
def eliminate(p, tables, stage, Y, work):
    """Fill work.D (n, 12) with the Newton update; returns False where a pivot block is singular.

    p, tables: parameters (`engine.record`); stage: Stage; Y (n, 13); work: Work, whose Q, F and X belong to Y.
    """
    if p.bent == 0:
        return eliminate_unbent(p, tables, stage, Y, work)
    Q, E, cq = work.Q, work.E, stage.cq
    last = Y.shape[0] - 1
    EI, GI, O1 = p.EI, p.GI, Y[0, col.O1]
    twisted = p.clamp_below and p.clamp_above and not released(p, stage.t)
    R, r = _at_anchor(p, tables, Y, Q)
    w, w2, w3, w1 = (0.0, 0.0, 0.0), 0.0, 0.0, 0.0  # r': response to dO1
    for k in range(1, last + 1):
        _store_relation(E[k - 1], R, r)
        a = k - 1
        e = 0.5 * tables[p.grid_at + a]
        over = 1.0 / e
        Qa, Qb, row = Q[a], Q[k], E[k]
        # rotation and compatibility: v_b = A y_a + B y_b + z
        psi, J = turn_of_box(Y, a, k)
        A, B, z = across_box(Y, Q, k, e, cq, J, psi, R, r)
        # momentum, three rows M y_a + BM y_b = g
        at_a, at_b = nodal_jacobian(p, Qa, e), nodal_jacobian(p, Qb, e)
        Mx, gx, BMx = momentum_row(0, e, Qa, Qb, at_a, at_b, R, r, A, B, z)
        My, gy, BMy = momentum_row(1, e, Qa, Qb, at_a, at_b, R, r, A, B, z)
        Mz, gz, BMz = momentum_row(2, e, Qa, Qb, at_a, at_b, R, r, A, B, z)
        # moments, two rows; a torque couples the curvatures
        _, _, _, r2, r3, _ = r
        _, _, _, z2, z3, z1 = z
        M2 = combined3(EI, A.O2, -EI, R.O2, -e, at_a.M2)
        M3 = combined3(EI, A.O3, -EI, R.O3, e, at_a.M3)
        BM2 = combined(EI, B.O2, -e, at_b.M2)
        BM3 = combined(EI, B.O3, e, at_b.M3)
        g2 = -EI * (Y[k, col.O2] - Y[a, col.O2]) + e * (Qa[col.M2] + Qb[col.M2]) - EI * (z2 - r2)
        g3 = -EI * (Y[k, col.O3] - Y[a, col.O3]) - e * (Qa[col.M3] + Qb[col.M3]) - EI * (z3 - r3)
        if O1 != 0.0:
            couple = e * GI * O1
            M2, M3 = combined3(1.0, M2, couple, R.O3, couple, A.O3), combined3(1.0, M3, -couple, R.O2, -couple, A.O2)
            BM2, BM3 = combined(1.0, BM2, couple, B.O3), combined(1.0, BM3, -couple, B.O2)
            g2 -= couple * (r3 + z3)
            g3 += couple * (r2 + z2)
        # y_a = P y_b + p + p' dO1
        solver, sound = factors(Mx, My, Mz, M2, M3)
        if not sound:
            return False
        P = solve_box_rows(solver, BMx, BMy, BMz, BM2, BM3)
        known_a = solve_box(solver, gx, gy, gz, g2, g3)
        for i in range(5):
            put_row(row, col.P + 5 * i, P[i])
        put_row(row, col.P_KNOWN, known_a)
        if twisted:
            # the same equations with dO1 for their only known term
            y2 = over * (J[1][0] - J[0][1]) * w1 - w2
            y3 = over * (J[2][0] - J[0][2]) * w1 - w3
            couple = e * GI * O1
            D2 = -e * GI * (Y[a, col.O3] + Y[k, col.O3]) - couple * (w3 + y3) - EI * (y2 - w2)
            D3 = e * GI * (Y[a, col.O2] + Y[k, col.O2]) + couple * (w2 + y2) - EI * (y3 - w3)
            known = mixed(w1, at_a.roll, -w1, at_b.roll)
            known = mixed(1.0, known, e, plus(times(inertia(Qa, 1.0), w), times(inertia(Qb, 1.0), w)))
            px = solve_box(solver, known[0], known[1], known[2], D2, D3)
            put_row(row, col.P_TORQUE, px)
            w = w[0] + row_dot(A.x, px), w[1] + row_dot(A.y, px), w[2] + row_dot(A.z, px)
            w2, w3, w1 = y2 + row_dot(A.O2, px), y3 + row_dot(A.O3, px), w1 + row_dot(A.theta1, px)
            put(row, col.R_TORQUE, w)
            put(row, col.R_TORQUE + 3, (w2, w3, w1))
        # v_b = R y_b + r
        R = Rows(
            added(row_times(A.x, P), B.x),
            added(row_times(A.y, P), B.y),
            added(row_times(A.z, P), B.z),
            added(row_times(A.O2, P), B.O2),
            added(row_times(A.O3, P), B.O3),
            added(row_times(A.theta1, P), B.theta1),
        )
        r = (
            z[0] + row_dot(A.x, known_a),
            z[1] + row_dot(A.y, known_a),
            z[2] + row_dot(A.z, known_a),
            z2 + row_dot(A.O2, known_a),
            z3 + row_dot(A.O3, known_a),
            z1 + row_dot(A.theta1, known_a),
        )
    _store_relation(E[last], R, r)
    if not solve_upper(p, tables, stage, twisted, Y, work):
        return False
    back_substitute(E, twisted, work.D)
    return True


@kernel
def _at_anchor(p, tables, Y, Q):
    """R (Rows) and r, six numbers, of the anchor: it does not move, and turns freely or against the spring of a
    clamp."""
    zero = (0.0, 0.0, 0.0, 0.0, 0.0)
    R2 = R3 = zero
    r2, r3 = -Y[0, col.O2], -Y[0, col.O3]
    if p.clamp_below:
        k_rotation = CLAMP / tables[p.grid_at]
        direction = (p.below_x, p.below_y, p.below_z)
        R2, R3 = (0.0, 0.0, 0.0, k_rotation, 0.0), (0.0, 0.0, 0.0, 0.0, k_rotation)
        r2 += k_rotation * dot(direction, vector(Q[0], col.B_VECTOR))
        r3 -= k_rotation * dot(direction, vector(Q[0], col.N_VECTOR))
    x, y, z = vector(Y[0], col.V)
    return Rows(zero, zero, zero, R2, R3, zero), (-x, -y, -z, r2, r3, 0.0)


@kernel
def _store_relation(row, R, r):
    """R and r of one node into its row of E."""
    for i in range(6):
        put_row(row, col.R + 5 * i, R[i])
    put(row, col.R_KNOWN, r[:3])
    put(row, col.R_KNOWN + 3, r[3:])


@kernel
def back_substitute(E, twisted, D):
    """From y of the upper end and dO1 in the first row of E down the line: the increments of every node, into D."""
    y = row_of(E[0], col.TOP)
    torque = E[0, col.TOP_TORQUE]
    for k in range(E.shape[0] - 1, -1, -1):
        row, out = E[k], D[k]
        out[col.EPS], out[col.SHEAR_N], out[col.SHEAR_B], out[col.THETA2], out[col.THETA3] = y
        out[col.D_O1] = torque
        for i in range(6):
            out[V_OF_D[i]] = row_dot(row_of(row, col.R + 5 * i), y) + row[col.R_KNOWN + i]
            if twisted and k > 0:
                out[V_OF_D[i]] += torque * row[col.R_TORQUE + i]
        if k > 0:
            y = (
                row_dot(row_of(row, col.P), y) + row[col.P_KNOWN],
                row_dot(row_of(row, col.P + 5), y) + row[col.P_KNOWN + 1],
                row_dot(row_of(row, col.P + 10), y) + row[col.P_KNOWN + 2],
                row_dot(row_of(row, col.P + 15), y) + row[col.P_KNOWN + 3],
                row_dot(row_of(row, col.P + 20), y) + row[col.P_KNOWN + 4],
            )
            if twisted:
                y = combined(1.0, y, torque, row_of(row, col.P_TORQUE))
