"""Implicit midpoint: the paper's box rule in time, eqs. (25)-(27). It damps nothing, the highest modes included.

As generalized-alpha with alpha_m = alpha_f = gamma = 1/2.

In the paper: eq. (25) box rule: value; eq. (26) box rule: rate; eq. (27) box rule: derivative along the line.
"""

ORDER, ADAPTIVE = 2, False
PHASE = 0.25  # rad of an oscillation a step: it turns by 0.5 % too little


def alphas(rho: float) -> tuple[float, float, float]:
    """(alpha_m, alpha_f, gamma); rho has no part in this method."""
    return 0.5, 0.5, 0.5
