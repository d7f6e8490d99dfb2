"""One box in space, linearised: what `engine.spatial.elimination` eliminates (its head states the equations)."""

from collections import namedtuple

from ..compiled import kernel
from . import columns as col
from .extras import along_by_turn
from .node import box_rotation
from .vectors import (
    added,
    combined,
    combined3,
    dot,
    inverted,
    minus,
    mixed,
    multiple,
    plus,
    rows_of,
    scaled,
    times,
    vector,
)

# Rows of five numbers, by y, for the six components of v = (V, O2, O3, theta1)
Rows = namedtuple("Rows", "x y z O2 O3 theta1")
# Of one node: dN by y (five 3-vectors), e dG (of eps, theta2, theta3), dN/dtheta1, dM2 and dM3 by y at fixed O
Nodal = namedtuple("Nodal", "N G roll M2 M3")


@kernel
def nodal_jacobian(p, row, e):
    """`Nodal` of a row of Q; e: half the length of the element."""
    t, n, b = rows_of(row, col.T_VECTOR)
    T, cube = row[col.TENSION], row[col.CUBE]
    N = vector(row, col.N)
    Sn, Sb = dot(N, n), dot(N, b)
    less2, less3 = along_by_turn(p, row)
    dN = multiple(row[col.SLOPE], t), n, b, mixed(Sb - less2, t, -T, b), mixed(-Sn - less3, t, T, n)
    lead = 3.0 * cube / row[col.STRETCHED]
    dM2 = (lead * Sb, 0.0, cube, 0.0, 0.0)
    dM3 = (lead * Sn, cube, 0.0, 0.0, 0.0)
    by_turn2, by_turn3 = vector(row, col.G_THETA2), vector(row, col.G_THETA3)
    dG = multiple(e, vector(row, col.G_EPS)), multiple(e, by_turn2), multiple(e, by_turn3)
    return Nodal(dN, dG, mixed(Sn, b, -Sb, n), dM2, dM3)


@kernel
def turn_of_box(Y, a, b):
    """psi and J = g + psi x/2 + c psi psi' row by row, c by its series where 1 - g has lost its digits."""
    psi, angle, g = box_rotation(Y, a, b)
    c = (1.0 - g) / (angle * angle) if angle > 1e-3 else 1.0 / 12 + angle * angle / 720
    x, y, z = psi
    return psi, (
        (g + c * x * x, c * x * y - 0.5 * z, c * x * z + 0.5 * y),
        (c * x * y + 0.5 * z, g + c * y * y, c * y * z - 0.5 * x),
        (c * x * z - 0.5 * y, c * y * z + 0.5 * x, g + c * z * z),
    )


@kernel
def _of_stretch(row, ec):
    """ec dq/dy of a row of Q: three rows, x, y, z."""
    t, n, b = rows_of(row, col.T_VECTOR)
    length = ec * row[col.STRETCHED]
    return (
        (ec * t[0], 0.0, 0.0, -length * b[0], length * n[0]),
        (ec * t[1], 0.0, 0.0, -length * b[1], length * n[1]),
        (ec * t[2], 0.0, 0.0, -length * b[2], length * n[2]),
    )


@kernel
def across_box(Y, Q, k, e, cq, J, psi, R, r):
    """v of node k as v_b = A y_a + B y_b + z, from rotation and compatibility; v_a = R y_a + r.

    e: half the element; J, psi: of its rotation. Returns A and B (Rows) and z, six numbers.
    """
    a = k - 1
    Qa, Qb = Q[a], Q[k]
    x, y, z, r2, r3, r1 = r
    # rotation: its first component has no curvature in it and gives theta1; the others then give O2 and O3
    over, inverse = 1.0 / e, 1.0 / J[0][0]
    missing2, missing3 = psi[1] - e * (Y[a, col.O2] + Y[k, col.O2]), psi[2] - e * (Y[a, col.O3] + Y[k, col.O3])
    A1 = added(R.theta1, (0.0, 0.0, 0.0, J[1][0] * inverse, J[2][0] * inverse))
    B1 = (0.0, 0.0, 0.0, -J[0][1] * inverse, -J[0][2] * inverse)
    z1 = r1 - psi[0] * inverse
    A2, B2, z2 = _curvature_row(1, over, J, A1, B1, z1, R.theta1, r1, R.O2, r2, missing2)
    A3, B3, z3 = _curvature_row(2, over, J, A1, B1, z1, R.theta1, r1, R.O3, r3, missing3)
    # compatibility: V
    Ax, Ay, Az = _of_stretch(Qa, e * cq)
    Ax, Ay, Az = added(R.x, Ax), added(R.y, Ay), added(R.z, Az)
    Bx, By, Bz = _of_stretch(Qb, e * cq)
    stretching, opened = plus(vector(Qa, col.Q_T), vector(Qb, col.Q_T)), minus(vector(Y[k], col.V), vector(Y[a], col.V))
    x, y, z = minus((x, y, z), mixed(-e, stretching, 1.0, opened))
    return Rows(Ax, Ay, Az, A2, A3, A1), Rows(Bx, By, Bz, B2, B3, B1), (x, y, z, z2, z3, z1)


@kernel
def _curvature_row(i, over, J, A1, B1, z1, R1, r1, R, r, missing):
    """Component i (1, 2) of the rotation of a box for its curvature: of `across_box` a row of A and of B, and of z.

    A1, B1, z1: of theta1 of the upper node; R1, r1: of that of the lower one; R, r: of its curvature.
    """
    A = combined3(J[i][0] * over, A1, -J[0][i] * over, R1, -1.0, R)
    A = added(A, (0.0, 0.0, 0.0, -J[1][i] * over, -J[2][i] * over))
    B = added(scaled(J[i][0] * over, B1), (0.0, 0.0, 0.0, J[i][1] * over, J[i][2] * over))
    return A, B, over * (J[i][0] * z1 - J[0][i] * r1 + missing) - r


@kernel
def momentum_row(i, e, Qa, Qb, at_a, at_b, R, r, A, B, z):
    """Row i (0, 1, 2: x, y, z) of the momentum equations: coefficients of y_a, the known term, coefficients of y_b.

    e: half the element; Qa, Qb: rows of Q; at_a, at_b: Nodal; v_a = R y_a + r and v_b = A y_a + B y_b + z.
    """
    ax, ay, az = multiple(e, vector(Qa, col.G_V + 3 * i))
    bx, by, bz = multiple(e, vector(Qb, col.G_V + 3 * i))
    roll_a, roll_b = at_a.roll[i], at_b.roll[i]
    # by y_a through V_a, V_b and the rolls, then directly
    row = added(combined3(-ax, R.x, -ay, R.y, -az, R.z), combined3(-bx, A.x, -by, A.y, -bz, A.z))
    row = combined3(1.0, row, roll_b, A.theta1, -roll_a, R.theta1)
    N, G = at_a.N, at_a.G
    direct = (N[0][i] + G[0][i], N[1][i], N[2][i], N[3][i] + G[1][i], N[4][i] + G[2][i])
    known = Qa[col.N + i] - Qb[col.N + i] + e * (Qa[col.G + i] + Qb[col.G + i]) - roll_b * z[5] + roll_a * r[5]
    known += ax * r[0] + ay * r[1] + az * r[2] + bx * z[0] + by * z[1] + bz * z[2]
    # by y_b
    N, G = at_b.N, at_b.G
    above = (N[0][i] - G[0][i], N[1][i], N[2][i], N[3][i] - G[1][i], N[4][i] - G[2][i])
    above = combined3(1.0, above, roll_b, B.theta1, -bx, B.x)
    return combined(1.0, row, -1.0, direct), known, combined3(1.0, above, -by, B.y, -bz, B.z)


@kernel
def factors(Mx, My, Mz, M2, M3):
    """What `solve_box` needs of the 5 x 5 matrix with these rows (momentum and moments by y_a); whether there is any.

    Inverse I of the block of (eps, Sn, Sb), a 3 x 3 adjugate; u3, u4 = I times the columns of the angles; inverse of
    the 2 x 2 block that is left for the angles.
    """
    inverse, det = inverted(vector(Mx, 0), vector(My, 0), vector(Mz, 0))
    sound = det != 0.0
    u3, u4 = times(inverse, (Mx[3], My[3], Mz[3])), times(inverse, (Mx[4], My[4], Mz[4]))
    m2, m3 = vector(M2, 0), vector(M3, 0)
    s33, s34 = M2[3] - dot(m2, u3), M2[4] - dot(m2, u4)
    s43, s44 = M3[3] - dot(m3, u3), M3[4] - dot(m3, u4)
    det = s33 * s44 - s34 * s43
    sound = sound and det != 0.0
    f = 1.0 / det if sound else 0.0
    return (inverse, m2, m3, u3, u4, (f * s44, -f * s34, -f * s43, f * s33)), sound


@kernel
def solve_box(solver, gx, gy, gz, g2, g3):
    """y_a for one right-hand side of a box, by its `factors`."""
    inverse, m2, m3, u3, u4, S = solver
    y0, y1, y2 = times(inverse, (gx, gy, gz))
    h3 = g2 - m2[0] * y0 - m2[1] * y1 - m2[2] * y2
    h4 = g3 - m3[0] * y0 - m3[1] * y1 - m3[2] * y2
    y3, y4 = S[0] * h3 + S[1] * h4, S[2] * h3 + S[3] * h4
    return y0 - u3[0] * y3 - u4[0] * y4, y1 - u3[1] * y3 - u4[1] * y4, y2 - u3[2] * y3 - u4[2] * y4, y3, y4


@kernel
def solve_box_rows(solver, BMx, BMy, BMz, BM2, BM3):
    """P of y_a = P y_b: the box solved for the five columns of y_b at once, the sign of their side changed."""
    (I0, I1, I2), m2, m3, u3, u4, S = solver
    H0, H1, H2 = (
        combined3(I0[0], BMx, I0[1], BMy, I0[2], BMz),
        combined3(I1[0], BMx, I1[1], BMy, I1[2], BMz),
        combined3(I2[0], BMx, I2[1], BMy, I2[2], BMz),
    )
    H3 = added(BM2, combined3(-m2[0], H0, -m2[1], H1, -m2[2], H2))
    H4 = added(BM3, combined3(-m3[0], H0, -m3[1], H1, -m3[2], H2))
    P3, P4 = combined(-S[0], H3, -S[1], H4), combined(-S[2], H3, -S[3], H4)
    return (
        combined3(-1.0, H0, -u3[0], P3, -u4[0], P4),
        combined3(-1.0, H1, -u3[1], P3, -u4[1], P4),
        combined3(-1.0, H2, -u3[2], P3, -u4[2], P4),
        P3,
        P4,
    )
