"""Newton's method for one stage: every time integrator, and statics, call this routine and no other.

Full step; where the update exceeds one in physical scales (strain, force, speed, angle, curvature) it is shortened to
one. Positions, and with them the water, are renewed in each iteration but left out of the Jacobian.
"""

import numpy as np

from ..compiled import kernel
from ..guards import NEWTON_FAILED, NOT_FINITE, OK, STRAIN_BELOW_MINUS_ONE
from .node import node_quantities, shape, water
from .sweep import sweep_bent
from .sweep_unbent import sweep_unbent

QUADRATIC = 2.0  # the update after one of size e is about 0.7 e^2 ... 1.5 e^2 (measured)
PATIENCE = 4  # iterations after which an update must halve, in a step that could as well be shortened

@kernel
def update_size(p, D):
    """Largest entry of a Newton update in the scales of the scene (dimensionless)."""
    size = 0.0
    for k in range(D.shape[0]):
        size = max(
            size,
            abs(D[k, 0]) * p.per_strain,
            abs(D[k, 1]) * p.per_force,
            max(abs(D[k, 2]), abs(D[k, 3])) * p.per_speed,
            abs(D[k, 4]),
            abs(D[k, 5]) * p.per_curvature,
        )
        if not np.isfinite(D[k, 0] + D[k, 2] + D[k, 4]):
            return np.inf
    return size


@kernel
def newton(p, tables, t, in_motion, cq, cv, tolerance, most, Y, C_tilde, X, F, Q, E, D):
    """Solve one stage for Y in place.

    in_motion: 1.0, or 0.0 in statics (a float: Numba would compile True and False apart);
    t (s): when the water is taken;  most: iterations allowed;
    cq, cv (1/s), C_tilde (n, 4): q_t = cq (q - q~), V_t = cv (V - V~);
    X, F, Q, E, D: work arrays; on success Q[:, 5:7] and X belong to the final Y.
    Returns (code, iterations).
    """
    best = np.inf
    for iteration in range(most):
        shape(p, tables, Y, Q, X)
        water(p, tables, t, in_motion, X, F)
        node_quantities(p, tables, cq, cv, in_motion, Y, C_tilde, F, Q)
        if p.bent:
            regular = sweep_bent(p, tables, t, cq, cv, in_motion, Y, C_tilde, F, Q, E, D)
        else:
            regular = sweep_unbent(p, tables, t, cq, cv, in_motion, Y, C_tilde, F, Q, E, D)
        if not regular:
            return NEWTON_FAILED, iteration + 1
        size = update_size(p, D)
        if not np.isfinite(size):
            return NOT_FINITE, iteration + 1
        factor = 1.0 if size <= 1.0 else 1.0 / size
        for k in range(Y.shape[0]):
            for i in range(6):
                Y[k, i] += factor * D[k, i]
            if Y[k, 0] <= -1.0:
                return STRAIN_BELOW_MINUS_ONE, iteration + 1
        if size < tolerance or QUADRATIC * size * size < tolerance:
            shape(p, tables, Y, Q, X)
            return OK, iteration + 1
        if iteration >= PATIENCE and size > 0.5 * best and most <= p.max_newton:
            return NEWTON_FAILED, iteration + 1
        best = min(best, size)
    return NEWTON_FAILED, most
