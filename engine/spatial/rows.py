"""Rows of five numbers, one for each of y = (eps, Sn, Sb, theta2, theta3), as tuples."""

from ..compiled import kernel


@kernel
def scaled(a, x):
    """a x"""
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
