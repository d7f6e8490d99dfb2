"""Backward Euler: order 1, damps everything. As generalized-alpha with alpha_m = alpha_f = gamma = 1.

Also the engine's starter: it needs no rates from before, so it opens impulsive runs and follows a loop release.
"""

ORDER, ADAPTIVE = 1, False
PHASE = 0.02  # rad of an oscillation a step: a cycle keeps 94 % of it


def alphas(rho: float) -> tuple[float, float, float]:
    """(alpha_m, alpha_f, gamma); rho has no part in this method."""
    return 1.0, 1.0, 1.0
