"""One box in space, linearised: what `engine.spatial.elimination` eliminates (its head states the equations)."""

from ..compiled import kernel
from .node import vector
from .rows import added, combined, combined3, scaled
from .vectors import dot, mixed, relative, rotation_vector


@kernel
def box_rotation(Y, a, b):
    """psi of a box, its length (rad), and (a/2) cot(a/2)."""
    return rotation_vector(relative((Y[a, 6], Y[a, 7], Y[a, 8], Y[a, 9]), (Y[b, 6], Y[b, 7], Y[b, 8], Y[b, 9])))


@kernel
def nodal_jacobian(row, e):
    """Of one node by y: dN (five 3-vectors), e dG (of eps, theta2, theta3), dN/dtheta1, dM2 and dM3 at fixed O."""
    t, n, b = vector(row, 0), vector(row, 14), vector(row, 17)
    T = row[41]
    N = vector(row, 11)
    Sn, Sb = dot(N, n), dot(N, b)
    dN = mixed(row[3], t, 0.0, t), n, b, mixed(Sb, t, -T, b), mixed(-Sn, t, T, n)
    Ge, G2, G3 = vector(row, 23), vector(row, 26), vector(row, 29)
    lead = 3.0 * row[40] / row[4]
    dM2 = (lead * Sb, 0.0, row[40], 0.0, 0.0)
    dM3 = (lead * Sn, row[40], 0.0, 0.0, 0.0)
    roll = mixed(Sn, b, -Sb, n)  # dN/dtheta1
    return dN, (mixed(e, Ge, 0.0, Ge), mixed(e, G2, 0.0, G2), mixed(e, G3, 0.0, G3)), roll, dM2, dM3


@kernel
def jacobian_of_rotation(psi, angle, g):
    """J = g + psi x/2 + c psi psi' row by row; c by its series where 1 - g has lost its digits."""
    c = (1.0 - g) / (angle * angle) if angle > 1e-3 else 1.0 / 12 + angle * angle / 720
    x, y, z = psi
    return (
        (g + c * x * x, c * x * y - 0.5 * z, c * x * z + 0.5 * y),
        (c * x * y + 0.5 * z, g + c * y * y, c * y * z - 0.5 * x),
        (c * x * z - 0.5 * y, c * y * z + 0.5 * x, g + c * z * z),
    )


@kernel
def rotation_rows(over, J, left, R1, r1, R2, r2, R3, r3):
    """(theta1, O2, O3)_b = A y_a + B y_b + z from the rotation equations; `over` = 1/e, `left` what is left of them.

    Columns of y are zero but for the angles; theta1 of node a is R1 y_a + r1.
    """
    (J11, J12, J13), (J21, J22, J23), (J31, J32, J33) = J
    inverse = 1.0 / J11
    A1 = added(R1, (0.0, 0.0, 0.0, J21 * inverse, J31 * inverse))
    B1 = (0.0, 0.0, 0.0, -J12 * inverse, -J13 * inverse)
    z1 = r1 - left[0] * inverse
    A2 = combined3(J21 * over, A1, -J12 * over, R1, -1.0, R2)
    A2 = added(A2, (0.0, 0.0, 0.0, -J22 * over, -J32 * over))
    B2 = added(scaled(J21 * over, B1), (0.0, 0.0, 0.0, J22 * over, J23 * over))
    z2 = over * (J21 * z1 - J12 * r1 + left[1]) - r2
    A3 = combined3(J31 * over, A1, -J13 * over, R1, -1.0, R3)
    A3 = added(A3, (0.0, 0.0, 0.0, -J23 * over, -J33 * over))
    B3 = added(scaled(J31 * over, B1), (0.0, 0.0, 0.0, J32 * over, J33 * over))
    z3 = over * (J31 * z1 - J13 * r1 + left[2]) - r3
    return A1, B1, z1, A2, B2, z2, A3, B3, z3


@kernel
def momentum_row(
    i,
    e,
    Qa,
    Qb,
    Rx,
    Ry,
    Rz,
    Ax,
    Ay,
    Az,
    Bx,
    By,
    Bz,
    rx,
    ry,
    rz,
    zx,
    zy,
    zz,
    dNa,
    Ga,
    roll_a,
    dNb,
    Gb,
    roll_b,
    R1,
    r1,
    A1,
    B1,
    z1,
):
    """Row i of the momentum equations: coefficients of y_a, the known term, coefficients of y_b."""
    if i == 0:
        u, v, w = 32, 33, 34
    elif i == 1:
        u, v, w = 33, 35, 36
    else:
        u, v, w = 34, 36, 37
    ax, ay, az, bx, by, bz = e * Qa[u], e * Qa[v], e * Qa[w], e * Qb[u], e * Qb[v], e * Qb[w]
    row = added(combined3(-ax, Rx, -ay, Ry, -az, Rz), combined3(-bx, Ax, -by, Ay, -bz, Az))
    row = combined3(1.0, row, roll_b[i], A1, -roll_a[i], R1)
    own = (dNa[0][i] + Ga[0][i], dNa[1][i], dNa[2][i], dNa[3][i] + Ga[1][i], dNa[4][i] + Ga[2][i])
    known = Qa[11 + i] - Qb[11 + i] + e * (Qa[20 + i] + Qb[20 + i]) - roll_b[i] * z1 + roll_a[i] * r1
    known += ax * rx + ay * ry + az * rz + bx * zx + by * zy + bz * zz
    above = (dNb[0][i] - Gb[0][i], dNb[1][i], dNb[2][i], dNb[3][i] - Gb[1][i], dNb[4][i] - Gb[2][i])
    above = combined3(1.0, above, roll_b[i], B1, -bx, Bx)
    return combined(1.0, row, -1.0, own), known, combined3(1.0, above, -by, By, -bz, Bz)


@kernel
def factors(Mx, My, Mz, M2, M3):
    """What `solve_box` needs of the 5 x 5 matrix with these rows (momentum and moments by y_a); whether there is any.

    Inverse I of the block of (eps, Sn, Sb), a 3 x 3 adjugate; u3, u4 = I times the columns of the angles; inverse of
    the 2 x 2 block that is left for the angles.
    """
    i00, i01, i02 = My[1] * Mz[2] - My[2] * Mz[1], Mx[2] * Mz[1] - Mx[1] * Mz[2], Mx[1] * My[2] - Mx[2] * My[1]
    i10, i11, i12 = My[2] * Mz[0] - My[0] * Mz[2], Mx[0] * Mz[2] - Mx[2] * Mz[0], Mx[2] * My[0] - Mx[0] * My[2]
    i20, i21, i22 = My[0] * Mz[1] - My[1] * Mz[0], Mx[1] * Mz[0] - Mx[0] * Mz[1], Mx[0] * My[1] - Mx[1] * My[0]
    det = Mx[0] * i00 + Mx[1] * i10 + Mx[2] * i20
    sound = det != 0.0
    f = 1.0 / det if sound else 0.0
    I0, I1, I2 = (f * i00, f * i01, f * i02), (f * i10, f * i11, f * i12), (f * i20, f * i21, f * i22)
    col3, col4 = (Mx[3], My[3], Mz[3]), (Mx[4], My[4], Mz[4])
    u3, u4 = (dot(I0, col3), dot(I1, col3), dot(I2, col3)), (dot(I0, col4), dot(I1, col4), dot(I2, col4))
    m2, m3 = (M2[0], M2[1], M2[2]), (M3[0], M3[1], M3[2])
    s33, s34 = M2[3] - dot(m2, u3), M2[4] - dot(m2, u4)
    s43, s44 = M3[3] - dot(m3, u3), M3[4] - dot(m3, u4)
    det = s33 * s44 - s34 * s43
    sound = sound and det != 0.0
    f = 1.0 / det if sound else 0.0
    return (I0, I1, I2, m2, m3, u3, u4, (f * s44, -f * s34, -f * s43, f * s33)), sound


@kernel
def solve_box(solver, gx, gy, gz, g2, g3):
    """y_a for one right-hand side of a box, by its `factors`."""
    I0, I1, I2, m2, m3, u3, u4, S = solver
    g = (gx, gy, gz)
    y0, y1, y2 = dot(I0, g), dot(I1, g), dot(I2, g)
    h3 = g2 - m2[0] * y0 - m2[1] * y1 - m2[2] * y2
    h4 = g3 - m3[0] * y0 - m3[1] * y1 - m3[2] * y2
    y3, y4 = S[0] * h3 + S[1] * h4, S[2] * h3 + S[3] * h4
    return y0 - u3[0] * y3 - u4[0] * y4, y1 - u3[1] * y3 - u4[1] * y4, y2 - u3[2] * y3 - u4[2] * y4, y3, y4


@kernel
def solve_box_rows(solver, BMx, BMy, BMz, BM2, BM3):
    """P of y_a = P y_b: the box solved for the five columns of y_b at once, the sign of their side changed."""
    I0, I1, I2, m2, m3, u3, u4, S = solver
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
