"""Linear waves over finite depth, from their formulas."""

import numpy as np


def direct(k, A, depth, t, X, direction=1.0, phase=0.0, omega=2 * np.pi / 5.0):
    """Water velocity and local acceleration (n, 4) at X (n, 2) of a wave along `direction`, 1 or -1, in long doubles;
    quotients as they stand, so kH below some 10000."""
    x, z = np.asarray(X, np.longdouble).T
    k = np.longdouble(k)
    psi = direction * k * x - np.longdouble(omega) * t + phase
    c, s = (f(k * z) / np.sinh(k * depth) * A * omega for f in (np.cosh, np.sinh))
    return np.column_stack(
        [direction * c * np.cos(psi), s * np.sin(psi), direction * omega * c * np.sin(psi), -omega * s * np.cos(psi)]
    )
