"""Planar states in space: starts of three-dimensional runs (NumPy, no kernels).

A state in the vertical plane through azimuth a (about z, from x) has t = (cos phi cos a, cos phi sin a, sin phi) and
n horizontal: at phi = a = 0 the frame is (x, y, z). In the plane of x and z b1 and b3 are then exactly zero and remain
so; with n in that plane they would be equal to rounding only, a seed of motion across it.
"""

import math

import numpy as np

from ..planar import columns as planar_col
from . import columns as col
from .vectors import frame_of, product_of

BETA = slice(col.BETA, col.BETA + 4)


def product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Quaternion product of arrays (..., 4)."""
    parts = (np.moveaxis(np.asarray(q, float), -1, 0) for q in (a, b))
    return np.stack(product_of(*parts), axis=-1)


def shortest_rotation(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Quaternion of the shortest rotation that takes the unit vector u into v; about y, or z, where they oppose."""
    scalar, axis = 1.0 + np.dot(u, v), np.cross(u, v)
    if scalar < 1e-12:
        scalar, axis = 0.0, np.cross(u, (1.0, 0.0, 0.0) if abs(u[0]) < 0.9 else (0.0, 1.0, 0.0))
    quaternion = np.array([scalar, *axis])
    return quaternion / np.linalg.norm(quaternion)


def stretch_vectors(Y: np.ndarray) -> np.ndarray:
    """q (n, 2) of a planar state Y (n, 6), (n, 3) of one in space (n, 13)."""
    phi = Y[:, planar_col.PHI]
    tangent = (np.cos(phi), np.sin(phi)) if Y.shape[1] == 6 else frame_of(Y[:, BETA].T)[0]
    return (1 + Y[:, :1]) * np.stack(tangent, axis=1)


def state_in_space(record: np.void, h: np.ndarray, planar: np.ndarray, azimuth: float) -> np.ndarray:
    """State (n, 13) of a planar one (n, 6), with the twist that a clamped upper end has from the start."""
    n = len(planar)
    half = 0.5 * planar[:, planar_col.PHI]
    zero = np.zeros(n)
    beta = np.stack([np.cos(half), zero, -np.sin(half), zero], axis=1)
    if azimuth:
        beta = product(np.array([math.cos(0.5 * azimuth), 0.0, 0.0, math.sin(0.5 * azimuth)]), beta)
    Y = np.zeros((n, 13))
    if record["clamp_below"] and record["clamp_above"] and record["twist_ramp"] == 0:
        Y[:, col.O1] = float(record["twist"]) / np.sum(h)
    Y[:, col.EPS] = planar[:, planar_col.EPS]
    Y[:, col.SHEAR_B] = planar[:, planar_col.SHEAR]
    Y[:, BETA] = beta
    Y[:, col.O2] = -planar[:, planar_col.KAPPA]
    return Y


def turns(Y: np.ndarray) -> np.ndarray:
    """Turn (n - 1,), rad, of the frame of a state (n, 13) from node to node."""
    r = product(Y[:-1, BETA] * [1.0, -1.0, -1.0, -1.0], Y[1:, BETA])
    return 2.0 * np.arctan2(np.linalg.norm(r[:, 1:], axis=1), r[:, 0])


def unwind(Y: np.ndarray) -> None:
    """Take whole turns out of the elements: Euler parameters and their negatives are one frame."""
    beta = Y[:, BETA]
    opposed = np.sum(beta[1:] * beta[:-1], axis=1) < 0.0
    beta[1:] *= np.cumprod(np.where(opposed, -1.0, 1.0))[:, None]


def turn_back(Y: np.ndarray, nodes: np.ndarray) -> None:
    """Turn the frames of some nodes by pi about b: t changes its sign."""
    Y[nodes, BETA] = product(Y[nodes, BETA], np.array([0.0, 0.0, 0.0, 1.0]))
