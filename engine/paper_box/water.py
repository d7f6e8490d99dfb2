"""Positions of the nodes, R_s = (1 + eps) t summed from the anchor, and the water there (`physics.waves`, `currents`).

The paper does not say where it takes the water; its kinematics depend on the position, which depends on every node
below. As in the conservation form, positions are renewed in each Newton iteration and left out of the Jacobian.
"""

import numpy as np

from ..physics.currents import current_field, current_field_3d
from ..physics.sea import sea_field
from ..physics.waves import wave_field, wave_field_3d
from .frame import TO_ENGINE, TO_PAPER, rotation
from .line import EULER


def positions(line, Y):
    """Positions (3, n) of the nodes in the paper's axes, m."""
    q = (1 + Y[0]) * rotation(Y[EULER])[0]
    steps = 0.5 * line.h * (q[:, 1:] + q[:, :-1])
    return np.concatenate([np.zeros((3, 1)), np.cumsum(steps, axis=1)], axis=1)


def water_at(line, t, Y, waves=True):
    """Velocity and local acceleration of the water at the nodes, (6, n), paper's axes. waves: False in statics."""
    record, tables = line.record, line.tables
    n = Y.shape[1]
    X = positions(line, Y)[TO_ENGINE]
    if line.spatial:
        X, F = np.ascontiguousarray(X.T), np.zeros((n, 6))
        if waves and record["sea_n"]:
            sea_field(record, tables, t, X, F)
        elif waves and record["waves"]:
            wave_field_3d(record, t, X, F)
        if record["current"]:
            current_field_3d(record, tables, t, X, F)
        return F.T[[*TO_PAPER, *(3 + i for i in TO_PAPER)]]
    X, F = np.ascontiguousarray(X[[0, 2]].T), np.zeros((n, 4))
    if waves and record["sea_n"]:
        sea_field(record, tables, t, X, F)
    elif waves and record["waves"]:
        wave_field(record, t, X, F)
    if record["current"]:
        current_field(record, tables, t, X, F)
    zero = np.zeros(n)
    return np.array([F[:, 1], F[:, 0], zero, F[:, 3], F[:, 2], zero])
