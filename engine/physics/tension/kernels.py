"""The tension laws of this folder, compiled: T and T' of eqs. (20) and (29), and the integral of T.

The printed tanh law has almost no stiffness in compression: where the scene gives a barrier P_b, T loses
P_b (0.5/lambda - 1)^2 below lambda = 1 + eps = 0.5, smooth there, without bound as lambda -> 0.

In the paper: eq. (20) tension law; eq. (29) slope of the tension law.
"""

import math
from functools import cache

from machine_code.parts import compiled_in_parts

from ...compiled import by_kind, kernel
from ...simd.select import larger, some, where
from . import LAWS

_ALL = tuple(range(len(LAWS)))
_IN_LANES = tuple(code for code in _ALL if LAWS[code].IN_LANES)


@cache
def _of_law(name, code):
    return kernel(getattr(LAWS[code], name))


def _choice(name, codes):
    """A kernel (p, tables, eps) that calls the function `name` of the law p.law; codes: of the laws it may be."""
    code, own = codes[0], _of_law(name, codes[0])
    others = _choice(name, codes[1:]) if codes[1:] else None

    def last(p, tables, eps):
        return own(eps, p, tables)

    def chosen(p, tables, eps):
        if p.law == code:
            return own(eps, p, tables)
        return others(p, tables, eps)

    function = last if others is None else chosen
    # Numba names machine code by this: what two processes keep of two choices must not have one name
    function.__qualname__ = "_".join([name, "of_law", *map(str, codes)])
    return compiled_in_parts(function, None)


_value, _integral = _choice("value", _ALL), _choice("integral", _ALL)
law_tension = by_kind(_value, _value, _choice("value", _IN_LANES))


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
