"""Generalized-alpha for first-order systems: Jansen, Whiting & Hulbert, Comput. Methods Appl. Mech. Engrg 190 (2000).

rho is the spectral radius at infinite frequency: 1 keeps the highest modes (the box rule in time), 0 removes them.

    alpha_m = (3 - rho)/(2 (1 + rho)),  alpha_f = 1/(1 + rho),  gamma = 1/2 + alpha_m - alpha_f:  order 2
"""

ORDER, ADAPTIVE = 2, False
PHASE = 0.25  # rad of an oscillation a step: 100 cycles keep 80 % of it where rho is 0.5


def alphas(rho: float) -> tuple[float, float, float]:
    """(alpha_m, alpha_f, gamma) for the spectral radius rho in [0, 1]."""
    alpha_m = (3 - rho) / (2 * (1 + rho))
    alpha_f = 1 / (1 + rho)
    return alpha_m, alpha_f, 0.5 + alpha_m - alpha_f
