"""Positions of the nodes, R_s = (1 + eps) t summed from the anchor, and the water there (`physics.water`).

The paper does not say where it takes the water; its kinematics depend on the position, which depends on every node
below. As in the conservation form, positions are renewed in each Newton iteration and left out of the Jacobian.
"""

import numpy as np

from ..physics.water import water
from .frame import TO_ENGINE, TO_PAPER, rotation
from .line import EULER, Line


def positions(line: Line, Y: np.ndarray) -> np.ndarray:
    """Positions (3, n) of the nodes in the paper's axes, m."""
    q = (1 + Y[0]) * rotation(Y[EULER])[0]
    steps = 0.5 * line.h * (q[:, 1:] + q[:, :-1])
    return np.concatenate([np.zeros((3, 1)), np.cumsum(steps, axis=1)], axis=1)


def water_at(line: Line, t: float, Y: np.ndarray, waves: bool = True) -> np.ndarray:
    """Velocity and local acceleration of the water at the nodes, (6, n), paper's axes. waves: False in statics."""
    n = Y.shape[1]
    X = positions(line, Y)[TO_ENGINE]
    X = np.ascontiguousarray((X if line.spatial else X[[0, 2]]).T)
    F = np.zeros((n, 2 * X.shape[1]))
    water(line.record, line.tables, t, 1.0 if waves else 0.0, X, F)
    if line.spatial:
        return F.T[[*TO_PAPER, *(3 + i for i in TO_PAPER)]]
    zero = np.zeros(n)
    return np.array([F[:, 1], F[:, 0], zero, F[:, 3], F[:, 2], zero])
