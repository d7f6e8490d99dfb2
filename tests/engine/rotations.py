"""Euler parameters, rotation matrices and shortest rotations in plain NumPy; complex numbers pass through."""

import numpy as np


def product(a, b):
    """Quaternion product, scalar first, rows (m, 4)."""
    scalar = a[:, :1] * b[:, :1] - np.sum(a[:, 1:] * b[:, 1:], 1, keepdims=True)
    return np.concatenate([scalar, a[:, :1] * b[:, 1:] + b[:, :1] * a[:, 1:] + np.cross(a[:, 1:], b[:, 1:])], 1)


def conjugate(beta):
    return beta * [1.0, -1.0, -1.0, -1.0]


def turned_by(theta):
    """Euler parameters (m, 4) of rotation vectors (m, 3)."""
    angle = np.linalg.norm(theta, axis=1, keepdims=True)
    return np.concatenate([np.cos(angle / 2), np.sinc(angle / (2 * np.pi)) * theta / 2], 1)


def frames(beta):
    """Rows t, n, b (m, 3, 3) of Euler parameters (m, 4): C of eq. (6), as 1 + 2 b0 [b] + 2 [b]^2 transposed."""
    beta = np.asarray(beta)
    vectors = beta[:, 1:]
    cross = np.zeros((len(vectors), 3, 3), vectors.dtype)
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        cross[:, i, j], cross[:, j, i] = -vectors[:, k], vectors[:, k]
    return (np.eye(3) + 2 * beta[:, :1, None] * cross + 2 * cross @ cross).transpose(0, 2, 1)


def shortest(u, v):
    """Euler parameters (1, 4) of the shortest rotation from the unit vector u to v."""
    q = np.array([1 + u @ v, *np.cross(u, v)])
    return (q / np.linalg.norm(q))[None]


def carried(u, v, x):
    """Vectors x (., 3) turned by the shortest rotation from the unit vector u to the unit vectors v (., 3)."""
    axis = np.cross(u, v)
    return x + np.cross(axis, x) + np.cross(axis, np.cross(axis, x)) / (1 + v @ u)[..., None]


def turned(vectors, angle):
    """Vectors (..., 3) turned about the vertical."""
    c, s = np.cos(angle), np.sin(angle)
    return np.asarray(vectors, float) @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
