"""Vectors of three, quaternions and rows of five as tuples, which Numba keeps in registers.

Quaternions (b0, b1, b2, b3) are the Euler parameters of eq. (5): a frame turned by `a` about the unit vector `e` is
(cos a/2, e sin a/2), the first column of its rotation is the tangent t, then n, then b.

In the paper: eq. (5) Euler parameters; eq. (6) rotation matrix.
"""

import math

from ..compiled import kernel


@kernel
def put(row, at, a):
    """row[at : at + 3] = a"""
    row[at], row[at + 1], row[at + 2] = a


@kernel
def vector(row, at):
    """(row[at], row[at + 1], row[at + 2])"""
    return row[at], row[at + 1], row[at + 2]


@kernel
def pair(row, at):
    """(row[at], row[at + 1])"""
    return row[at], row[at + 1]


@kernel
def quaternion(row, at):
    """(row[at], ..., row[at + 3])"""
    return row[at], row[at + 1], row[at + 2], row[at + 3]


@kernel
def put_quaternion(row, at, q):
    """row[at : at + 4] = q"""
    row[at], row[at + 1], row[at + 2], row[at + 3] = q


def dot_of(a, b):
    """a . b, of numbers or of arrays of them."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


dot = kernel(dot_of)


@kernel
def cross(a, b):
    """a x b"""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@kernel
def multiple(x, a):
    """x a"""
    return x * a[0], x * a[1], x * a[2]


@kernel
def plus(a, b):
    """a + b"""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@kernel
def minus(a, b):
    """a - b"""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@kernel
def mixed(x, a, y, b):
    """x a + y b"""
    return x * a[0] + y * b[0], x * a[1] + y * b[1], x * a[2] + y * b[2]


@kernel
def scaled_rows(x, A):
    """x A, of three vectors."""
    return multiple(x, A[0]), multiple(x, A[1]), multiple(x, A[2])


@kernel
def third_column(a):
    """Rows of the matrix that has a in its third column and else zeros."""
    return (0.0, 0.0, a[0]), (0.0, 0.0, a[1]), (0.0, 0.0, a[2])


@kernel
def mixed_rows(x, A, y, B):
    """x A + y B, of three vectors each."""
    return mixed(x, A[0], y, B[0]), mixed(x, A[1], y, B[1]), mixed(x, A[2], y, B[2])


@kernel
def sum_of(A, B):
    """A + B, of three vectors each."""
    return plus(A[0], B[0]), plus(A[1], B[1]), plus(A[2], B[2])


@kernel
def plus_diagonal(rows, x):
    """The matrix of these three rows plus x times the unit matrix."""
    a, b, c = rows
    return (a[0] + x, a[1], a[2]), (b[0], b[1] + x, b[2]), (c[0], c[1], c[2] + x)


@kernel
def times(rows, a):
    """The matrix of these three rows times a."""
    return dot(rows[0], a), dot(rows[1], a), dot(rows[2], a)


@kernel
def affine(rows, a, b):
    """The matrix of these three rows times a, plus b."""
    return dot(rows[0], a) + b[0], dot(rows[1], a) + b[1], dot(rows[2], a) + b[2]


@kernel
def less(a, x, b, y, c):
    """a - x b - y c"""
    return a[0] - x * b[0] - y * c[0], a[1] - x * b[1] - y * c[1], a[2] - x * b[2] - y * c[2]


@kernel
def vector_times(x, M):
    """x M, M three rows."""
    return (
        x[0] * M[0][0] + x[1] * M[1][0] + x[2] * M[2][0],
        x[0] * M[0][1] + x[1] * M[1][1] + x[2] * M[2][1],
        x[0] * M[0][2] + x[1] * M[1][2] + x[2] * M[2][2],
    )


@kernel
def minus_product(A, B):
    """-A B, both of three rows."""
    x, y, z = vector_times(A[0], B), vector_times(A[1], B), vector_times(A[2], B)
    return (-x[0], -x[1], -x[2]), (-y[0], -y[1], -y[2]), (-z[0], -z[1], -z[2])


@kernel
def cofactors(a, b, c):
    """b x c, c x a, a x b and the determinant a . (b x c): over it, rows of the inverse of a matrix with columns a, b,
    c, columns of that of one with these rows."""
    first = cross(b, c)
    return (first, cross(c, a), cross(a, b)), dot(a, first)


@kernel
def inverted(A0, A1, A2):
    """Inverse (three rows) and determinant of the 3 x 3 matrix with these rows: an adjugate over the determinant."""
    (x, y, z), det = cofactors(A0, A1, A2)
    f = 1.0 / det
    return ((f * x[0], f * y[0], f * z[0]), (f * x[1], f * y[1], f * z[1]), (f * x[2], f * y[2], f * z[2])), det


@kernel
def rows_of(row, at):
    """The three rows of three numbers from row[at] on."""
    return vector(row, at), vector(row, at + 3), vector(row, at + 6)


@kernel
def put_rows(row, at, rows):
    """row[at : at + 9] = three rows of three."""
    put(row, at, rows[0])
    put(row, at + 3, rows[1])
    put(row, at + 6, rows[2])


def product_of(a, b):
    """a o b, of numbers or of arrays of them."""
    return (
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    )


@kernel
def relative(a, b):
    """a* o b: the frame b as seen from the frame a."""
    return quaternion_product((a[0], -a[1], -a[2], -a[3]), b)


def frame_of(q):
    """t, n, b of a unit quaternion of numbers or arrays: rows of C, eq. (6) with C31 = 2 (b1 b3 + b0 b2)."""
    b0, b1, b2, b3 = q
    return (
        (b0 * b0 + b1 * b1 - b2 * b2 - b3 * b3, 2.0 * (b1 * b2 + b0 * b3), 2.0 * (b1 * b3 - b0 * b2)),
        (2.0 * (b1 * b2 - b0 * b3), b0 * b0 - b1 * b1 + b2 * b2 - b3 * b3, 2.0 * (b2 * b3 + b0 * b1)),
        (2.0 * (b1 * b3 + b0 * b2), 2.0 * (b2 * b3 - b0 * b1), b0 * b0 - b1 * b1 - b2 * b2 + b3 * b3),
    )


quaternion_product, frame = kernel(product_of), kernel(frame_of)


@kernel
def rotation_vector(r):
    """Rotation vector psi = angle * axis (rad) of a unit quaternion, the angle a in [0, 2 pi], and (a/2) cot(a/2)."""
    axis = vector(r, 1)
    square = dot(axis, axis)
    if square < 0.01 and r[0] > 0.0:  # a = 2 arcsin(sqrt(square)) as a power series, to rounding
        z = square
        ratio = 2.0 + z * (
            1.0 / 3 + z * (3.0 / 20 + z * (5.0 / 56 + z * (35.0 / 576 + z * (63.0 / 1408 + z * (231.0 / 6656 + z * (
                143.0 / 5120)))))))  # fmt: skip
        angle = ratio * math.sqrt(square)
    else:
        sine = math.sqrt(square)
        angle = 2.0 * math.atan2(sine, r[0])
        ratio = angle / sine
    return multiple(ratio, axis), angle, 0.5 * ratio * r[0]


@kernel
def turned(q, theta):
    """q o exp(theta/2): the frame q turned by the rotation vector theta, given in its own axes (rad)."""
    square = 0.25 * dot(theta, theta)
    if square < 0.01:
        c = 1.0 + square * (-0.5 + square * (1.0 / 24 + square * (-1.0 / 720 + square / 40320)))
        s = 1.0 + square * (-1.0 / 6 + square * (1.0 / 120 + square * (-1.0 / 5040 + square / 362880)))
    else:
        half = math.sqrt(square)
        c, s = math.cos(half), math.sin(half) / half
    s *= 0.5
    return quaternion_product(q, (c, s * theta[0], s * theta[1], s * theta[2]))


@kernel
def least_turn(a, b):
    """Unit quaternion of the shortest rotation that takes the unit vector a into b (any axis where they oppose)."""
    w = 1.0 + dot(a, b)
    x, y, z = cross(a, b)
    if w < 1e-12:
        w = 0.0
        x, y, z = (-a[1], a[0], 0.0) if abs(a[2]) < 0.9 else (0.0, -a[2], a[1])
    norm = 1.0 / math.sqrt(w * w + x * x + y * y + z * z)
    return w * norm, x * norm, y * norm, z * norm


@kernel
def scaled(a, x):
    """a x, rows of five numbers: one for each of y = (eps, Sn, Sb, theta2, theta3)."""
    return a * x[0], a * x[1], a * x[2], a * x[3], a * x[4]


@kernel
def added(x, y):
    """x + y"""
    return x[0] + y[0], x[1] + y[1], x[2] + y[2], x[3] + y[3], x[4] + y[4]


@kernel
def combined(a, x, b, y):
    """a x + b y"""
    return (a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2], a * x[3] + b * y[3], a * x[4] + b * y[4])


@kernel
def combined3(a, x, b, y, c, z):
    """a x + b y + c z"""
    return (
        a * x[0] + b * y[0] + c * z[0],
        a * x[1] + b * y[1] + c * z[1],
        a * x[2] + b * y[2] + c * z[2],
        a * x[3] + b * y[3] + c * z[3],
        a * x[4] + b * y[4] + c * z[4],
    )


@kernel
def row_times(x, P):
    """x P, P five rows."""
    return added(combined3(x[0], P[0], x[1], P[1], x[2], P[2]), combined(x[3], P[3], x[4], P[4]))


@kernel
def row_dot(x, y):
    """x . y"""
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2] + x[3] * y[3] + x[4] * y[4]


@kernel
def row_of(E, at):
    """(E[at], ..., E[at + 4])"""
    return E[at], E[at + 1], E[at + 2], E[at + 3], E[at + 4]


@kernel
def put_row(E, at, x):
    """E[at : at + 5] = x"""
    E[at], E[at + 1], E[at + 2], E[at + 3], E[at + 4] = x
