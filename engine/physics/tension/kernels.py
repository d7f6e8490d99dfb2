"""The tension laws of this folder, compiled: T and T' of eqs. (20) and (29), and the integral of T.

The printed tanh law has almost no stiffness in compression: where the scene gives a barrier P_b, T loses
P_b (0.5/lambda - 1)^2 below lambda = 1 + eps = 0.5, smooth there, without bound as lambda -> 0.

In the paper: eq. (20) tension law; eq. (29) slope of the tension law.
"""

import math

from ...compiled import kernel
from ...simd.select import larger, some, where
from ..law_choice import of_the_law
from . import LAWS


@kernel
def _code(p):
    return p.law


law_tension, _integral = of_the_law(LAWS, "value", _code), of_the_law(LAWS, "integral", _code)


@kernel
def tension(eps, p, tables):
    """Tension T (N) and its derivative dT/deps (N) at a strain.

    eps: strain; p: parameter record; tables: flat array of all tables.
    """
    T, slope = law_tension(p, tables, eps)
    braced = (eps < -0.5) & (p.barrier > 0.0)
    if some(braced):
        lam = larger(1.0 + eps, 1e-300)
        excess = 0.5 / lam - 1.0
        T = where(braced, T - p.barrier * excess * excess, T)
        slope = where(braced, slope + p.barrier * excess / (lam * lam), slope)
    return T, slope


@kernel
def stored(eps, p, tables):
    """Integral of the tension law from no strain to eps, J per metre of unstretched line."""
    barrier = 0.0
    if p.barrier > 0.0 and eps < -0.5:
        lam = max(1.0 + eps, 1e-300)
        barrier = p.barrier * (0.25 / lam + math.log(2.0 * lam) - lam)  # 0 at 0.5
    return barrier + _integral(p, tables, eps) - _integral(p, tables, 0.0)
