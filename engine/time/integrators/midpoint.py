"""Implicit midpoint: the paper's box rule in time, eqs. (25)-(27). It damps nothing, the highest modes included.

As generalized-alpha with alpha_m = alpha_f = gamma = 1/2.

In the paper: eq. (25) the value, eq. (26) the rate and eq. (27) the slope at the middle of a box.
"""

ORDER, ADAPTIVE = 2, False


def alphas(rho):
    """(alpha_m, alpha_f, gamma); rho has no part in this method."""
    return 0.5, 0.5, 0.5
