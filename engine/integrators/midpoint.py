"""Implicit midpoint: the paper's box rule in time, eqs. (25)-(27). It damps nothing, the highest modes included.

As generalized-alpha with alpha_m = alpha_f = gamma = 1/2.
"""

ORDER, ADAPTIVE = 2, False


def alphas(rho):
    """(alpha_m, alpha_f, gamma); rho has no part in this method."""
    return 0.5, 0.5, 0.5
